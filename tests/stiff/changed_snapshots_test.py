#!/usr/bin/python3
"""Transfers of FEM states that no scene produces: folded elements, everything liquefied. Unmodified scenes are in the catalogue."""
import shutil

import h5py
import numpy
from programs import done_well, last_snapshot, refused, run, run_tests, scene_of

G, RHO = 9.81, 2000.0


def points(file):
    with h5py.File(file) as opened:
        return {name: data[()] for name, data in opened["VTKHDF/PointData"].items()} | {"place": opened["VTKHDF/Points"][:, :2]}


def at_rest(folder, scene):
    done_well("fem_solver", scene, folder / "fem")
    return last_snapshot(folder / "fem")


def lost(result, *quantities):
    return max(abs(row["relative_difference"]) for row in result["ledger"] if row["quantity"] in quantities)


def folded(folder, ratio):
    """The last element's upper right corner pushed in until |J_t| / |J_0| at the neighbouring corners is `ratio`."""
    scene = scene_of("column")
    scene["materials"]["soil"]["law"] |= {"type": "mohr_coulomb", "c_kPa": 1, "phi_deg": 30}
    file = folder / "folded.vtkhdf"
    shutil.copy(at_rest(folder, scene), file)
    with h5py.File(file, "r+") as opened:
        quad = opened["breachline/quads"][-1]
        place = opened["breachline/position_0"]
        a, b, c = place[quad[1]], place[quad[2]], place[quad[3]]
        diagonal = (a + c) / 2
        # On the line between its neighbours the corner's own Jacobian is zero.
        target = diagonal + ratio * (b - diagonal)
        opened["VTKHDF/PointData/displacement"][quad[2], :2] = target - b
        opened["VTKHDF/Points"][quad[2], :2] = target
    return scene, file


def an_almost_entangled_mesh_keeps_mass_and_volume(folder):
    scene, file = folded(folder, 0.02)
    result = done_well("transfer_tool", scene, folder / "points", "--input", file, "--set", "/transfer/largest_momentum_loss=1e-10")
    assert lost(result, "mass", "volume") < 1e-12
    assert points(folder / "points/particles.vtkhdf")["volume"].min() > 0


def an_entangled_mesh_is_refused_with_its_element(folder):
    scene, file = folded(folder, -0.5)
    refused(run("transfer_tool", scene, folder / "points", "--input", file), "element", exit=70)


def an_entangled_mesh_can_be_rebuilt(folder):
    scene, file = folded(folder, -0.5)
    scene["transfer"]["entangled"] = "rebuild"
    assert lost(done_well("transfer_tool", scene, folder / "points", "--input", file), "mass") < 1e-12
    assert points(folder / "points/particles.vtkhdf")["volume"].min() > 0


def rock_a_million_times_stiffer_leaves_the_weight_in_the_stress(folder):
    scene = scene_of("column_on_rock")
    result = done_well("transfer_tool", scene, folder / "points", "--input", at_rest(folder, scene))
    state = points(folder / "points/particles.vtkhdf")
    error = numpy.abs(state["stress"][:, 1] + RHO * G * (4 - state["place"][:, 1])).max() / (RHO * G * 8)
    assert lost(result, "mass", "volume") < 1e-12 and error < 0.0625, f"half an element's weight is 0.0625: {error}"


def one_element_not_cut_for_the_cells_is_questionable(folder):
    scene = scene_of("column_to_rest")
    scene["section"]["regions"][0]["mesh"]["divisions"] = [1, 1]
    done_well("transfer_tool", scene, folder / "points", "--input", at_rest(folder, scene))
    result = done_well("mpm_solver", scene, folder / "mpm", "--input", folder / "points/particles.vtkhdf")
    assert "overlap" in [flag["code"] for flag in result["flags"] if flag["severity"] == "questionable"], result["flags"]


def soil_that_is_all_liquefied_has_the_residual_strength_and_runs(folder):
    scene = scene_of("chain_dam")
    scene["materials"]["soil"] |= {"void_ratio": 0.8, "permeability": [1e-6, 1e-6]}
    scene["materials"]["soil"]["law"] |= {"E_MPa": 10, "c_kPa": 10}
    scene["materials"]["residual"] = {"density": RHO, "law": scene["materials"]["soil"]["law"] | {"c_kPa": 2, "phi_deg": 0}}
    scene["fem"] |= {"element": "ssp", "water": {"line": [[0, 10]]}}
    scene["transfer"]["liquefied"] = {"regions": ["dam"], "layers": [{"sigma_v0_kPa": [0, 1000], "material": "residual"}]}
    snapshot = at_rest(folder, scene)
    with h5py.File(snapshot, "r+") as opened:
        data = opened["VTKHDF/PointData"]
        data["sigma_v0"][...] = numpy.maximum(data["sigma_v0"][()], 1.0)
        data["pore_pressure"][...] = data["pore_pressure_0"][()] + data["sigma_v0"][()]
    done_well("transfer_tool", scene, folder / "points", "--input", snapshot)
    result = done_well("mpm_solver", scene, folder / "mpm", "--input", folder / "points/particles.vtkhdf")
    with h5py.File(folder / "points/particles.vtkhdf") as opened:
        soils = [name.decode() for name in opened["breachline/materials_of_regions"][()]]
        assert all(soils[region] == "residual" for region in opened["VTKHDF/PointData/region"][()])
    assert abs(points(folder / "mpm/final.vtkhdf")["mass"].sum() / (RHO * 50) - 1) < 1e-12
    assert result["runout"] > 1, result["runout"]


if __name__ == "__main__":
    run_tests((an_almost_entangled_mesh_keeps_mass_and_volume, an_entangled_mesh_is_refused_with_its_element,
               an_entangled_mesh_can_be_rebuilt, rock_a_million_times_stiffer_leaves_the_weight_in_the_stress,
               one_element_not_cut_for_the_cells_is_questionable, soil_that_is_all_liquefied_has_the_residual_strength_and_runs))
