"""Rows of the chain: FEM, transfer and MPM one after the other, with nothing mended between them."""
import functools
import math
import pathlib
import tempfile

import h5py
import numpy

from rows import Outcome, case, done_well, within, worst
from scenes import (G, RHO, column, dam_break, elastic, farthest_move, frictional, last_snapshot, points, region,
                    sand)


def chain(folder, scene, change=None):
    """The MPM's result. change(snapshot) may alter the FEM's last state."""
    done_well("fem_solver", scene, folder / "fem")
    snapshot = last_snapshot(folder / "fem")
    if change:
        change(snapshot)
    done_well("transfer_tool", scene, folder / "points", "--input", snapshot)
    return done_well("mpm_solver", scene, folder / "mpm", "--input", folder / "points/particles.vtkhdf")


def mass_lost(folder, mass):
    return within("mass lost", abs(points(folder / "mpm/final.vtkhdf")["mass"].sum() / mass - 1), 1e-12)


@functools.lru_cache
def usual_runout():
    with tempfile.TemporaryDirectory() as name:
        return chain(pathlib.Path(name), dam_break(sand(c=0.005)))["runout"] / 10


def scaled_chain(folder, L=10.0, g=G):
    result = chain(folder, dam_break(sand(L, g, c=0.005), L, g))
    return worst(within("runout over L against that of 10 m under g", abs(result["runout"] / L / usual_runout() - 1), 2e-3),
                 mass_lost(folder, RHO * L * L / 2))


for name, extreme, how in (("a dam of 1 m", "L 1 m", {"L": 1.0}), ("a dam of 1 km", "L 1000 m", {"L": 1000.0}),
                           ("a dam under 10 g", "10 g", {"g": 10 * G}), ("a dam under 1e-3 g", "1e-3 g", {"g": 1e-3 * G})):
    case("chain", name, extreme, "FEM, transfer and MPM in proportion: runout / L within 0.2 %, mass to 1e-12")(
        functools.partial(scaled_chain, **how))


def rests(folder, allowed, seconds=2.0, mass=RHO * 32, points_per_cell=None, **how):
    """A column that the FEM has settled lies still in the MPM. allowed: of its height."""
    scene = column(**how, duration=seconds)
    if points_per_cell:
        scene["transfer"]["points_per_cell"] = points_per_cell
    scene["mpm"]["rest_earliest"] = 10 * seconds
    chain(folder, scene)
    H = scene["fem"]["crest"][1]
    moved = farthest_move(folder / "points/particles.vtkhdf", folder / "mpm/final.vtkhdf")
    return worst(within("farthest move over the height", moved / H, allowed), mass_lost(folder, mass))


for name, extreme, how in (
        ("soil that is hardly compressible", "nu 0.4999", {"soil": elastic(2e7, 0.4999)}),
        ("a dam of one element", "1 element of 8 m, cut for cells of 1 m",
         {"soil": elastic(2e7), "divisions": (1, 1), "points_per_cell": 4}),
        ("a transfer at once", "0 s after gravity", {"soil": elastic(2e7)})):
    case("chain", name, extreme, "what rests in the FEM rests in the MPM: within 0.1 % of the height in 2 s, mass to 1e-12")(
        functools.partial(rests, allowed=1e-3, **how))


@case("chain", "one element that is not cut for the cells", "4 points of 8 m2 each in cells of 1 m",
      "such points are no body: the result is questionable by its overlap")
def scattered(folder):
    result = chain(folder, column(elastic(2e7), divisions=(1, 1), duration=2.0))
    codes = [flag["code"] for flag in result["flags"] if flag["severity"] == "questionable"]
    return Outcome("questionable: " + ", ".join(codes), "overlap" in codes, "refusal")


@case("chain", "a pool of soil without strength", "c = 0 and phi = 0 from FEM to MPM", "within 0.5 % of the height in 2 s, mass to 1e-12")
def pool(folder):
    return rests(folder, 5e-3, soil=frictional(2e7, 0, 0, 0.45),
                 stages=[{"type": "static", "name": "gravity", "laws": "scene"}])


@case("chain", "rock a million times stiffer below soil", "E ratio 1e6", "within 0.5 % of the height in 0.2 s, mass to 1e-12")
def contrast(folder):
    scene = column(elastic(1e6), divisions=(4, 4), H=4.0, duration=0.2)
    scene["materials"]["rock"] = elastic(1e12)
    scene["section"]["regions"].append(region("rock", "rock", [[0, -4], [4, -4], [4, 0], [0, 0], [0, -4]], [4, 4]))
    for support in scene["fem"]["supports"]:
        support["from"][1] = -4
        if support["name"] == "base":
            support["to"][1] = -4
    scene["mpm"] |= {"floor": {"level": -4}, "domain_y": [-4, 5], "rest_earliest": 10}
    chain(folder, scene)
    moved = farthest_move(folder / "points/particles.vtkhdf", folder / "mpm/final.vtkhdf")
    return worst(within("farthest move over the height", moved / 4, 5e-3), mass_lost(folder, RHO * 32))


@case("chain", "everything liquefied at the transfer", "r_u = 1 at every node, 0 s after gravity",
      "all of the layer's mass has the residual strength and runs; none is lost")
def all_liquefied(folder):
    scene = dam_break(frictional(1e7, 1e4, 30), until=1.0)
    law = {"type": "mohr_coulomb", "E_MPa": 10, "nu": 0.3, "c_kPa": 2, "phi_deg": 0}
    scene["materials"]["soil"] |= {"void_ratio": 0.8, "permeability": [1e-6, 1e-6]}
    scene["fem"] |= {"element": "ssp", "water": {"line": [[0, 10]]}}
    scene["materials"]["residual"] = {"density": RHO, "law": law}
    scene["transfer"]["liquefied"] = {"regions": ["dam"], "layers": [{"sigma_v0_kPa": [0, 1000], "material": "residual"}]}

    def liquefy(snapshot):
        with h5py.File(snapshot, "r+") as opened:
            data = opened["VTKHDF/PointData"]
            data["sigma_v0"][...] = numpy.maximum(data["sigma_v0"][()], 1.0)
            data["pore_pressure"][...] = data["pore_pressure_0"][()] + data["sigma_v0"][()]
    result = chain(folder, scene, liquefy)
    with h5py.File(folder / "points/particles.vtkhdf") as opened:
        soils = [name.decode() for name in opened["breachline/materials_of_regions"][()]]
        of_point = opened["VTKHDF/PointData/region"][()]
        mass = opened["VTKHDF/PointData/mass"][()]
    liquefied = mass[numpy.array(soils)[of_point] == "residual"].sum() / mass.sum()
    return worst(within("share that did not liquefy", 1 - liquefied, 0.0), mass_lost(folder, RHO * 50),
                 Outcome(f"runout {result['runout']:.2f} m in {math.sqrt(10 / G):.1f} s", result["runout"] > 1))
