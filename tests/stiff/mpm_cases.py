"""Rows of the MPM beside those that ctest has already (table.py lists them)."""
import functools
import math
import pathlib
import tempfile

import numpy

from rows import Outcome, case, done_well, refused, run, within, worst
from scenes import G, RHO, column, dam_break, document, elastic, farthest_move, frictional, points, region, sand


def start_and_end(folder):
    frames = sorted(folder.glob("particles_*.vtkhdf"))
    return frames[0], folder / "final.vtkhdf"


@functools.lru_cache
def usual_runout():
    """Runout over L of the 10 m dam under g."""
    with tempfile.TemporaryDirectory() as name:
        return done_well("mpm_solver", dam_break(sand()), pathlib.Path(name) / "out")["runout"] / 10.0


def scaled_runout(folder, L=10.0, g=G):
    result = done_well("mpm_solver", dam_break(sand(L, g), L, g), folder / "out")
    return worst(within("runout over L against that of 10 m under g", abs(result["runout"] / L / usual_runout() - 1), 1e-3),
                 Outcome(f"volume ratio {result['volume_ratio']:.3f}", 0.8 < result["volume_ratio"] < 1.3))


for name, extreme, how in (("a dam of 1 m that breaks", "L 1 m", {"L": 1.0}), ("a dam of 1 km that breaks", "L 1000 m", {"L": 1000.0}),
                           ("a dam that breaks under 10 g", "10 g", {"g": 10 * G}),
                           ("a dam that breaks under 1e-3 g", "1e-3 g", {"g": 1e-3 * G})):
    case("MPM", name, extreme, "the same motion in proportion (Froude): runout / L within 0.1 %")(
        functools.partial(scaled_runout, **how))


def soundness(result, volume=1.3):
    return worst(within("energy made by the scheme, of what is released", max(-result["energy"]["numerical"]["share"], 0.0), 0.2),
                 Outcome(f"volume ratio {result['volume_ratio']:.3f}", 1 / volume < result["volume_ratio"] < volume))


def whole(folder, **mpm):
    soil = mpm.pop("soil", None) or sand(c=0.005)
    return soundness(done_well("mpm_solver", dam_break(soil, **mpm), folder / "out"))


for name, extreme, how in (
        ("soil that is hardly compressible", "nu 0.4999", {"soil": sand(nu=0.4999, c=0.005), "until": 1.0}),
        ("a liquid", "c = 0 and phi = 0", {"soil": sand(nu=0.45, phi=0.0)}),
        ("one point per cell", "1 point", {"fill_points": 1}),
        ("soil of one cell", "1 cell across the dam", {"cells": 2, "fill_points": 2})):
    case("MPM", name, extreme, "at most 20 % of the released energy made, volume within 0.77 to 1.3")(
        functools.partial(whole, **how))


@case("MPM", "the front of a liquid", "c = 0, phi = 0, no friction", "never faster than Ritter's 2 sqrt(g H)")
def ritter(folder):
    scene = dam_break(sand(nu=0.45, phi=0.0), until=1.5)
    scene["mpm"]["floor"]["friction"] = [{"from": 0, "to": 60, "coefficient": 0}]
    done_well("mpm_solver", scene, folder / "out")
    x = numpy.percentile(points(folder / "out/final.vtkhdf")["place"][:, 0], 99) - 5
    front = x / (2 * math.sqrt(G * 10) * 1.5 * math.sqrt(10 / G))
    return within("way of the front over 2 sqrt(g H) t", front, 1.0)


@case("MPM", "a run that takes no time", "duration 0", "refused, naming the duration")
def no_time(folder):
    return refused(run("mpm_solver", dam_break(sand()) | {}, folder / "out", "--set", "/mpm/duration=0"), "/mpm/duration")


@case("MPM", "a thousand seconds at rest", "1000 s under gravity, from the weight above", "no drift: below 1 mm of 8 m")
def long_rest(folder):
    scene = column(elastic(5e6, 1 / 3), duration=1000.0, fill_stress="overburden", rest_earliest=1001)
    scene["mpm"]["telemetry_interval"] = 1.0
    done_well("mpm_solver", scene, folder / "out")
    start, end = start_and_end(folder / "out")
    # What the weight's own discretisation moves in the first second is no drift.
    scene["mpm"] |= {"duration": 1.0, "snapshot_interval": 1.0}
    done_well("mpm_solver", scene, folder / "short")
    settles = farthest_move(start, folder / "short/final.vtkhdf")
    drifts = farthest_move(folder / "short/final.vtkhdf", end)
    return worst(within("moved from 1 s to 1000 s [mm]", 1e3 * drifts, 1.0),
                 Outcome(f"in the first second {1e3 * settles:.2g} mm", True))


@case("MPM", "steps ten times too large", "10 times the Courant step", "the guard ends it: exit 70, where and when")
def large_steps(folder):
    scene = dam_break(sand(c=0.005))
    usual = done_well("mpm_solver", scene, folder / "usual")["dt_max"]
    return refused(run("mpm_solver", scene, folder / "out", "--set", f"/mpm/time_step={10 * usual / 0.4:.9g}"), "breakdown", "t =")


@case("MPM", "two hundred thousand points", "200,000 points, 60 steps", "mass kept; under its own weight it lies still, below 1 mm/s", slow=True)
def many_points(folder):
    scene = document("many", {"soil": frictional(2e7, 1e3, 30)}, [region("soil", "soil", [[0, 0], [10, 0], [10, 12.5], [0, 12.5], [0, 0]])],
                     mpm={"cell_size": 0.1, "domain_x": [0, 10], "domain_y": [0, 15], "right": "roller", "floor": {"level": 0}, "fill_points": 4,
                          "duration": 0.02, "snapshot_interval": 0.02, "fill_stress": "overburden", "runout": {"toe": [10, 0]}})
    result = done_well("mpm_solver", scene, folder / "out")
    mass = points(folder / "out/final.vtkhdf")["mass"].sum()
    v = numpy.abs(points(folder / "out/final.vtkhdf")["velocity"]).max()
    return worst(within(f"{result['particles']} points, {result['steps']} steps; mass", abs(mass / (RHO * 125) - 1), 1e-12),
                 within("largest speed [mm/s]", 1e3 * v, 1.0), Outcome("", result["particles"] == 200000))


@case("MPM", "neighbours a million times stiffer", "E ratio 1e6 in one cell", "no energy made (at most 1 %), points in their order of height")
def contrast(folder):
    scene = column(elastic(1e10, 0.3), duration=0.1, fill_stress="overburden")
    scene["materials"]["soft"] = elastic(1e4, 0.3)
    scene["materials"]["soft"]["density"] = 300
    scene["section"]["regions"] = [region("hard", "soil", [[0, 0], [4, 0], [4, 4.5], [0, 4.5], [0, 0]]),
                                   region("soft", "soft", [[0, 4.5], [4, 4.5], [4, 5], [0, 5], [0, 4.5]])]
    del scene["fem"], scene["transfer"]
    result = done_well("mpm_solver", scene, folder / "out")
    energy = result["energy"]
    final = points(folder / "out/final.vtkhdf")
    hard, soft = (final["place"][final["region"] == k, 1] for k in (0, 1))
    made = max(-energy["numerical"]["J"], 0.0) / (RHO * G * 18 * 4.5)
    return worst(within("energy made over weight x height", made, 0.01),
                 Outcome(f"soft from {soft.min():.2f} m up, hard to {hard.max():.2f} m", soft.min() > hard.max() - 0.5))


def valley_scene(mu, gap_room):
    """A wedge of sand high on one side of a valley whose slopes are 60 degrees; in 16 s friction brings it to rest."""
    scene = document("valley", {"soil": frictional(5e6, 1e3, 30)},
                     [region("heap", "soil", [[1.2, 16.0], [5.0, 9.3], [5.0, 16.0], [1.2, 16.0]])],
                     mpm={"cell_size": 0.25, "domain_x": [0, 30], "domain_y": [0, 30], "left": "open", "fill_points": 3,
                          "floor": {"level": 0, "friction": [{"from": 0, "to": 30, "coefficient": mu}]},
                          "terrain": [[0, 17.8], [10, 0.5], [20, 17.8]], "duration": 16, "rest_earliest": 20,
                          "snapshot_interval": 16, "runout": {"toe": [5, 9]}})
    if not gap_room:
        scene["mpm"]["gap_room"] = False
    scene["materials"]["soil"]["density"] = 1800
    return scene


def valley(folder, mu, gap_room):
    result = done_well("mpm_solver", valley_scene(mu, gap_room), folder / "out")
    flagged = any(flag["code"] == "volume_ratio" for flag in result["flags"])
    ratio = result["volume_ratio"]
    said = f"volume ratio {ratio:.3f}" + (", flagged as questionable" if flagged else "")
    return Outcome(said, 0.8 < ratio < 1.3 or (flagged and not gap_room), f"{0.3 / max(ratio - 1, 1e-9):.3g}")


for mu in (0.3, 5.0):
    case("MPM", f"a valley of 60 degrees, friction {mu:g}", "ground of 60 degrees, splash at 12 m/s",
         "at rest the sand has its own volume, within 0.8 to 1.3 (gaps held to their room, as steep ground has it)")(
        functools.partial(valley, mu=mu, gap_room=True))
case("MPM", "the same with friction 5 and without gap_room", "ground of 60 degrees, splash at 12 m/s",
     "its own volume, within 0.8 to 1.3, or flagged")(functools.partial(valley, mu=5.0, gap_room=False))


@case("MPM", "the same without any friction", "ground of 60 degrees, 12 m/s into the corner",
      "no point a cell deep in the ground: the guard ends it with exit 70, where and when")
def frictionless_valley(folder):
    return refused(run("mpm_solver", valley_scene(0.0, True), folder / "out"), "sank into the terrain", "t =")


@case("MPM", "the same with friction 10", "coefficient 10, an angle of 84 degrees", "refused: ground that holds the soil has no friction zones")
def hardly_friction(folder):
    return refused(run("mpm_solver", dam_break(sand()), folder / "out", "--set", "/mpm/floor/friction/0/coefficient=10"), "coefficient")
