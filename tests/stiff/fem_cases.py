"""Rows of the FEM beside those that ctest has already (table.py lists them)."""
import functools

import h5py
import numpy

from rows import case, done_well, refused, run, within, worst
from scenes import G, RHO, column, constrained, elastic, frictional, last_snapshot, points

E = 2e7


def settled(folder, scene, H, modulus, g=G):
    """Settlement of a column between walls, pressed by its own weight from the start of a dynamic stage or at once."""
    done_well("fem_solver", scene, folder / "out")
    top = points(last_snapshot(folder / "out"))["displacement"][:, 1].min()
    return abs(top / (-RHO * g * H * H / (2 * modulus)) - 1)


def exact_column(folder, H=8.0, g=G, nu=0.3, divisions=(4, 8), E=E):
    scene = column(elastic(E, nu), W=H / 2, H=H, divisions=divisions, g=g, cell=H / 8)
    return within("settlement", settled(folder, scene, H, constrained(E, nu), g), 1e-6)


for name, extreme, how in (
        ("a column of 1 m", "L 1 m", {"H": 1.0}), ("a column of 1 km", "L 1000 m", {"H": 1000.0, "E": 2e9}),
        ("a column under 10 g", "10 g", {"g": 10 * G}), ("a column under 1e-3 g", "1e-3 g", {"g": 1e-3 * G}),
        ("a dam of one element", "1 element", {"divisions": (1, 1)}),
        ("elements a thousand times wider than high", "aspect 1:1000", {"divisions": (1, 2000)}),
        ("soil that is hardly compressible", "nu 0.49999", {"nu": 0.49999}),
        ("soft as gelatine", "E 1 kPa: it settles by 58 times its height, in small strains", {"E": 1e3})):
    case("FEM", name, extreme, "settlement rho g H^2 / 2 M, within 1e-6", slow="1000" in extreme and "aspect" in extreme)(
        functools.partial(exact_column, **how))


@case("FEM", "level soil without any strength", "c = 0 and phi = 0",
      "it lies still as a liquid does: stress isotropic, settlement rho g H^2 / 2 K")
def liquid(folder):
    nu = 0.45
    soil = frictional(E, 0, 0, nu)
    scene = column(soil, stages=[{"type": "static", "name": "gravity", "laws": "scene"}])
    error = settled(folder, scene, 8.0, E / (3 * (1 - 2 * nu)))
    with h5py.File(last_snapshot(folder / "out")) as opened:
        stress = opened["breachline/gauss/stress"][()]
    shear = numpy.abs(stress[:, 0] - stress[:, 1]).max() / numpy.abs(stress).max()
    return worst(within("settlement", error, 1e-4), within("deviator over pressure", shear, 1e-4))


@case("FEM", "nu of one half", "nu 0.5", "refused: the bulk modulus is infinite")
def incompressible(folder):
    return refused(run("fem_solver", column(elastic(E, 0.5)), folder / "out"), "nu")


@case("FEM", "a stage that takes no time", "duration 0", "refused, naming the stage's duration")
def no_time(folder):
    stages = [{"type": "static", "name": "gravity"}, {"type": "dynamic", "name": "wait", "duration": 0, "time_step": 0.01}]
    return refused(run("fem_solver", column(elastic(E), stages=stages), folder / "out"), "/fem/stages/1/duration")


@case("FEM", "a thousand seconds at rest", "1000 s in steps of 1 s under gravity", "no drift: below 1e-3 mm")
def long_rest(folder):
    soil = frictional(E, 1e3, 35)
    stages = [{"type": "static", "name": "gravity", "laws": "elastic"},
              {"type": "dynamic", "name": "rest", "duration": 1000, "time_step": 1}]
    scene = column(soil, stages=stages)
    scene["fem"] |= {"snapshot_times": [1.0], "telemetry_interval": 10}
    done_well("fem_solver", scene, folder / "out")
    first, *_, last = sorted((folder / "out").glob("snapshot_*.vtkhdf"))
    moved = numpy.abs(points(last)["displacement"] - points(first)["displacement"]).max()
    return within("moved [mm]", 1e3 * moved, 1e-3)


@case("FEM", "steps ten times too large", "10 times a wave's way through an element, load put on at once",
      "damped to the static settlement, within 0.1 %")
def large_steps(folder):
    M, H = constrained(E, 0.3), 8.0
    dt = 10 * (H / 8) / (M / RHO) ** 0.5
    stages = [{"type": "dynamic", "name": "load", "laws": "elastic", "duration": 600 * dt, "time_step": dt}]
    return within("settlement", settled(folder, column(elastic(E), stages=stages), H, M), 1e-3)


@case("FEM", "a heap without any strength", "c = 0 and phi = 0 with a free face 8 m high",
      "no static equilibrium: exit 70 that says so")
def heap_of_liquid(folder):
    scene = column(frictional(E, 0, 0), stages=[{"type": "static", "name": "gravity", "laws": "scene"}])
    scene["fem"]["supports"] = [each for each in scene["fem"]["supports"] if each["name"] != "right"]
    return refused(run("fem_solver", scene, folder / "out"), "no equilibrium")
