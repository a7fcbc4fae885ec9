"""Rows of the transfer: mass, volume and momentum are kept whatever the mesh, or it is refused and named."""
import functools
import shutil

import h5py
import numpy

from rows import Outcome, case, done_well, refused, run, within, worst
from scenes import G, column, elastic, frictional, last_snapshot, points

E = 2e7


def meshed(folder, scene):
    """The FEM's state at rest."""
    done_well("fem_solver", scene, folder / "fem")
    return last_snapshot(folder / "fem")


def transferred(folder, scene, snapshot, *settings):
    """Points, and the ledger's largest relative difference of mass and volume."""
    result = done_well("transfer_tool", scene, folder / "points", "--input", snapshot, *settings)
    lost = max(abs(row["relative_difference"]) for row in result["ledger"] if row["quantity"] in ("mass", "volume"))
    return points(folder / "points/particles.vtkhdf"), lost


def kept(folder, settings=(), least=0, **how):
    scene = column(**how)
    state, lost = transferred(folder, scene, meshed(folder, scene), *settings)
    n = len(state["mass"])
    return worst(within(f"{n} points; mass and volume lost", lost, 1e-12), Outcome("", n >= least))


for name, extreme, how in (
        ("a mesh of one element", "1 element", {"divisions": (1, 1)}),
        ("a model of 1 m", "L 1 m", {"W": 0.5, "H": 1.0, "cell": 0.125}),
        ("a model of 1 km", "L 1000 m", {"W": 500, "H": 1000, "cell": 125}),
        ("soil that is hardly compressible", "nu 0.4999", {"soil": elastic(E, 0.4999)}),
        ("one point per element", "1 point", {"settings": ("--set", "/transfer/points_per_direction=1")})):
    case("transfer", name, extreme, "mass and volume kept to 1e-12")(
        functools.partial(kept, **{"soil": elastic(E)} | how))

case("transfer", "two hundred thousand points", "200,000 points of 12,500 elements", "mass and volume kept to 1e-12", slow=True)(
    functools.partial(kept, soil=elastic(E), W=10, H=12.5, divisions=(100, 125), cell=0.1, least=200000,
                      settings=("--set", "/transfer/points_per_direction=4")))


def folded(snapshot, copy, ratio):
    """The last element's upper right corner pushed in until |J_t| / |J_0| at the neighbouring corners is `ratio`."""
    shutil.copy(snapshot, copy)
    with h5py.File(copy, "r+") as opened:
        quad = opened["breachline/quads"][-1]
        place = opened["breachline/position_0"]
        a, b, c = place[quad[1]], place[quad[2]], place[quad[3]]
        diagonal = (a + c) / 2
        # On the line between its neighbours the corner's own Jacobian is zero.
        target = diagonal + ratio * (b - diagonal)
        displacement = opened["VTKHDF/PointData/displacement"]
        displacement[quad[2], :2] = target - b
        opened["VTKHDF/Points"][quad[2], :2] = target


@case("transfer", "a mesh that is almost entangled", "least corner Jacobian 0.02 of the undeformed one",
      "mass and volume kept to 1e-12, every point's volume positive")
def almost_entangled(folder):
    scene = column(frictional(E, 1e3, 30))
    folded(meshed(folder, scene), folder / "folded.vtkhdf", 0.02)
    state, lost = transferred(folder, scene, folder / "folded.vtkhdf", "--set", "/transfer/largest_momentum_loss=1e-10")
    least = state["volume"].min() / numpy.median(state["volume"])
    return worst(within("mass and volume lost", lost, 1e-12), Outcome(f"least volume {least:.2g} of the median", least > 0))


@case("transfer", "a mesh that is entangled", "least corner Jacobian -0.5 of the undeformed one", "refused, naming the element")
def entangled(folder):
    scene = column(frictional(E, 1e3, 30))
    folded(meshed(folder, scene), folder / "folded.vtkhdf", -0.5)
    done = run("transfer_tool", scene, folder / "points", "--input", folder / "folded.vtkhdf")
    return refused(done, "element")


@case("transfer", "the same, rebuilt", "least corner Jacobian -0.5, entangled: rebuild",
      "mass kept to 1e-12, every point's volume positive")
def rebuilt(folder):
    scene = column(frictional(E, 1e3, 30))
    scene["transfer"]["entangled"] = "rebuild"
    folded(meshed(folder, scene), folder / "folded.vtkhdf", -0.5)
    result = done_well("transfer_tool", scene, folder / "points", "--input", folder / "folded.vtkhdf")
    lost = max(abs(row["relative_difference"]) for row in result["ledger"] if row["quantity"] == "mass")
    least = points(folder / "points/particles.vtkhdf")["volume"].min()
    return worst(within("mass lost", lost, 1e-12), Outcome(f"least volume {least:.2g} m3", least > 0))


@case("transfer", "neighbours a million times stiffer", "E ratio 1e6 across one line of nodes",
      "vertical stress at the points that of the weight above, within that of half an element (6.25 % of the largest)")
def contrast(folder):
    scene = column(elastic(1e6), divisions=(4, 4), H=4.0)
    scene["materials"]["rock"] = elastic(1e12)
    scene["section"]["regions"][0]["polygon"] = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]
    scene["section"]["regions"].append({"name": "rock", "material": "rock", "mesh": {"type": "block", "divisions": [4, 4]},
                                        "polygon": [[0, -4], [4, -4], [4, 0], [0, 0], [0, -4]]})
    for support in scene["fem"]["supports"]:
        support["from"][1] = -4
        if support["name"] == "base":
            support["to"][1] = -4
    scene["mpm"] |= {"floor": {"level": -4}, "domain_y": [-4, 5]}
    state, lost = transferred(folder, scene, meshed(folder, scene))
    depth = 4 - state["place"][:, 1]
    weight = 2000 * G * 8
    error = numpy.abs(state["stress"][:, 1] + 2000 * G * depth).max() / weight
    return worst(within("mass and volume lost", lost, 1e-12), within("stress", error, 0.0625))
