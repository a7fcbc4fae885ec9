"""Extreme scenes in fem_solver: the right answer, an entangled mesh that says so, or a clear stop (exit
70 that says what, where and when, with the last good state saved). Usage: extreme_test.py CASE; each case is named after what is true."""
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import coarse_slope
from opensees_models import FOUNDATION, TAILINGS, block, scene, sine, write_motion, write_msh
from runs import judge

WEIGHT_OF_WATER = 9810.0


def solver(folder):
    return subprocess.run([f"{os.environ['BREACH_BIN']}/fem_solver", str(folder / "scene.json"), "--output", str(folder / "out"),
                           "--progress", "none"], stderr=subprocess.PIPE, text=True)


class Run:
    """One run in a folder: exit code, facts, fault, last snapshot."""

    def __init__(self, folder):
        out = folder / "out"
        done = solver(folder)
        self.code = done.returncode
        self.out = out
        if self.code not in (0, 70):
            raise SystemExit(done.stderr)
        self.snapshots = sorted(out.glob("snapshot_*.vtkhdf"))
        if self.code == 0:
            self.result = json.loads((out / "result.json").read_text())
            print(f"    done: {self.result['steps']} steps, {self.result['cut_steps']} cut, "
                  f"{self.result['stalled_steps']} stalled, {self.result['cpu_seconds']:.1f} CPU s")
        else:
            self.fault = json.loads((out / "fault.json").read_text())["summary"]
            print(f"    stopped: {self.fault}")

    def point(self, name):
        with h5py.File(self.snapshots[-1]) as opened:
            return opened["VTKHDF/PointData"][name][:]

    def place(self):
        with h5py.File(self.snapshots[-1]) as opened:
            return opened["breachline/position_0"][:]

    def stress(self):
        """Of the first Gauss point of each element: xx, yy, zz, xy."""
        with h5py.File(self.snapshots[-1]) as opened:
            return opened["breachline/gauss/stress"][:]

    def ended_clearly(self):
        """All numbers of the last state are finite; a stop reports when and where, and can be resumed."""
        sound = all(numpy.isfinite(self.point(name)).all() for name in ("displacement", "velocity", "pore_pressure"))
        if self.code == 0:
            return sound
        return sound and "the last good state is at" in self.fault and "element" in self.fault \
            and self.snapshots[-1].name in self.fault and (self.out / "checkpoint.h5").exists()


def elastic(E, nu=0.25, k=1e-5):
    return {"density": 2000, "void_ratio": 0.8, "permeability": [k, k],
            "law": {"type": "linear_elastic", "E_MPa": E / 1e6, "nu": nu}}


def box(folder, materials, regions, W, H, stages, **fem):
    """Regions in a smooth box 0..W x 0..H."""
    supports = [{"name": name, "from": a, "to": b, "fixes": fixes} for name, a, b, fixes in
                (("left", [0, 0], [0, H], "x"), ("right", [W, 0], [W, H], "x"), ("base", [0, 0], [W, 0], "xy"))]
    result = {"format": "breachline-scene/1", "name": "extreme", "gravity": fem.pop("gravity", 9.81), "materials": materials,
              "section": {"regions": regions},
              "fem": {"element": "ssp", "supports": supports, "crest": [W, H], "stages": stages, "force_tolerance": 1e-10,
                      "newmark_beta": 4 / 9, "newmark_gamma": 5 / 6, **fem}}
    (folder / "scene.json").write_text(json.dumps(result))


def wet_rock_a_million_times_stiffer_gives_the_exact_column(folder):
    """5 m of soil on 5 m of rock, E 1e6 and 1e12 Pa, loaded at once: undrained first, then drained."""
    q, M = 1e4, 1e6 * 0.75 / (1.25 * 0.5)
    storage = 0.8 / 1.8 / 2.2e9
    passed = True
    for k, duration in ((1e-12, 100), (1e-2, 1000)):
        box(folder, {"soil": elastic(1e6, k=k), "rock": elastic(1e12, k=k)},
            [block("rock", "rock", [[0, 0], [1, 0], [1, 5], [0, 5]], [1, 10]),
             block("soil", "soil", [[0, 5], [1, 5], [1, 10], [0, 10]], [1, 10])], 1, 10,
            [{"type": "dynamic", "name": "load", "laws": "elastic", "duration": duration, "time_step": duration / 100}],
            gravity=0.0, water={"line": [[0, 10]], "bulk_modulus_MPa": 2200},
            surcharge=[{"from": 0, "to": 1, "pressure_kPa": q / 1e3}])
        run = Run(folder)
        passed &= run.code == 0
        y, p = run.place()[:, 1], run.point("pore_pressure") / q
        if k < 1e-6:
            # The storage matrix of an element is full: the jump at the border decays in the rock by a factor of 14 per node.
            for what, E, there, allowed in (("soil", M, (y > 6.9) & (y < 8.1), 1e-9), ("rock", 1e6 * M, y < 1.6, 1e-7)):
                exact = 1 / (1 + E * storage)
                passed &= judge(f"undrained pressure in the {what} ({exact:.2e}), over the load",
                                numpy.abs(p[there] - exact).max(), allowed)
            rising = numpy.diff([p[y == at].mean() for at in numpy.unique(y[y < 6.1])])
            passed &= judge("fall of the pressure on its way from rock to soil, over the load", max(0, -rising.min()), 1e-7)
        else:
            top = run.point("displacement")[y > 10 - 1e-9][:, 1]
            passed &= judge("drained settlement", abs(top[0] / (-q * 5 / M) - 1), 1e-5)
            passed &= judge("pressure left over the load", numpy.abs(p).max(), 1e-6)
    return passed


def permeability_1e_12_beside_1_gives_the_exact_seepage(folder):
    """Upward flow under a gradient of 0.2, tight and open soil side by side: p and sigma'_v are linear in both."""
    box(folder, {"tight": elastic(1e7, k=1e-12), "open": elastic(1e7, k=1.0)},
        [block("tight", "tight", [[0, 0], [5, 0], [5, 10], [0, 10]], [5, 10]),
         block("open", "open", [[5, 0], [10, 0], [10, 10], [5, 10]], [5, 10])], 10, 10,
        [{"type": "static", "name": "gravity", "permeability": "scene"},
         {"type": "dynamic", "name": "rest", "laws": "elastic", "duration": 10, "time_step": 0.1}],
        water={"line": [[0, 10]], "boundaries": [{"name": "below", "from": [0, 0], "to": [10, 0], "level": 12}]})
    run = Run(folder)
    depth = 10 - run.place()[:, 1]
    passed = run.code == 0
    passed &= judge("p against 1.2 rho_f g depth, over the largest",
                    numpy.abs(run.point("pore_pressure") - 1.2 * WEIGHT_OF_WATER * depth).max() / 117720, 1e-8)
    rows = numpy.sort(-run.stress()[:, 1])
    exact = numpy.sort(numpy.repeat((2.0 - 1.2) * WEIGHT_OF_WATER * (numpy.arange(10) + 0.5), 10))
    passed &= judge("sigma'_v against (rho - 1.2 rho_f) g depth, over the largest", numpy.abs(rows - exact).max() / exact[-1], 1e-7)
    passed &= judge("displacement in 10 s of rest [m]", numpy.abs(run.point("displacement")).max(), 1e-8)
    return passed


def level_tailings(folder, motion, duration, time_step, stages=None, **fem):
    """10 m of tailings on 4 m of foundation over rock, wet to the ground, between free-field columns."""
    write_motion(folder / "motion.csv", 5e-3, motion)
    regions = [block("foundation", "foundation", [[0, -4], [12, -4], [12, 0], [0, 0]], [4, 2]),
               block("tailings", "tailings", [[0, 0], [12, 0], [12, 10], [0, 10]], [4, 8])]
    result = scene("level_tailings", {"tailings": TAILINGS, "foundation": FOUNDATION}, regions,
                   [{"name": "base", "from": [0, -4], "to": [12, -4], "fixes": "xy"}], [[0, 10], [12, 10]], "motion.csv",
                   [6, 10], duration, time_step=time_step, free_field={"width": 3}, **fem)
    if stages:
        result["fem"]["stages"] = stages + result["fem"]["stages"][-1:]
    return result


def tailings_liquefied_from_the_start_stay_so_and_carry_no_more(folder):
    """Quicksand: upward seepage carries the whole weight of the tailings before the shaking begins."""
    result = level_tailings(folder, sine(2.0, 0.5, 5e-3), 2.0, 5e-3, force_tolerance=1e-5)
    density = TAILINGS["density"] / 1000
    result["fem"]["water"]["boundaries"] = [{"name": "spring", "from": [-9, 0], "to": [21, 0], "level": 10 * density}]
    result["fem"]["stages"][0]["permeability"] = "scene"
    (folder / "scene.json").write_text(json.dumps(result))
    run = Run(folder)
    y = run.place()[:, 1]
    weight = 10 * density * WEIGHT_OF_WATER
    p_0, u = run.point("pore_pressure_0"), run.point("displacement")
    # Sheared sand may dilate and regain a little stress.
    tailings = y > 1e-9
    passed = run.ended_clearly()
    passed &= judge("p_0 against the weight above, over the whole",
                    numpy.abs(p_0 - density * WEIGHT_OF_WATER * (10 - y))[tailings].max() / weight, 1e-6)
    passed &= judge("largest effective stress after shaking, over the weight", numpy.abs(run.stress()[8:]).max() / weight, 0.1)
    v_0 = 0.3 * 9.81 / (4 * math.pi)
    passed &= judge("largest displacement over the base's travel", numpy.abs(u).max() / (v_0 / (2 * math.pi)), 1.0)
    return passed


def sand_without_motion_does_not_drift_in_100_s(folder):
    result = level_tailings(folder, [0.0, 0.0], 100.0, 0.1, force_tolerance=1e-8)
    (folder / "scene.json").write_text(json.dumps(result))
    run = Run(folder)
    moved = numpy.abs(run.point("displacement")).max()
    pressure = numpy.abs(run.point("pore_pressure") - run.point("pore_pressure_0")).max()
    passed = run.code == 0
    passed &= judge("displacement after 100 s [m]", moved, 1e-6)
    return passed & judge("change of pressure [Pa] (largest 1.4e5)", pressure, 10.0)


def three_g_on_liquefying_sand_end_clearly(folder):
    coarse_slope.write(folder, duration=2.0, strength=10.0)
    return Run(folder).ended_clearly()


SOFTEST = {  # extreme values that each law's schema allows
    "mohr_coulomb": {"type": "mohr_coulomb", "E_MPa": 0.001, "nu": 0.3, "c_kPa": 1, "phi_deg": 20},
    "elastic": {"type": "linear_elastic", "E_MPa": 0.001, "nu": 0.3},
    "pm4sand": TAILINGS["law"] | {"D_R": 0.01, "G_0": 0.01},
}


def seam_under_a_slope(folder):
    """The lowest row of the tailings, below the pond and at the embankment's foot."""
    result = json.loads(coarse_slope.write(folder, duration=1.0).read_text())
    foundation, _, embankment = result["section"]["regions"]
    embankment["polygon"] = [[24, 0], [48, 0], [28, 8], [24, 8], [24, 2], [24, 0]]
    embankment["mesh"]["corners"] = [[24, 0], [48, 0], [28, 8], [24, 8]]
    result["section"]["regions"] = [foundation, block("seam", "seam", [[0, 0], [24, 0], [24, 2], [0, 2]], [8, 1]),
                                    block("tailings", "tailings", [[0, 2], [24, 2], [24, 8], [0, 8]], [8, 3]), embankment]
    return result


def seam_under_level_ground(folder):
    result = level_tailings(folder, sine(1.0, 0.5, 5e-3), 1.0, 5e-3, force_tolerance=1e-5)
    result["section"]["regions"] = [
        result["section"]["regions"][0], block("seam", "seam", [[0, 0], [12, 0], [12, 1.25], [0, 1.25]], [4, 1]),
        block("tailings", "tailings", [[0, 1.25], [12, 1.25], [12, 10], [0, 10]], [4, 7])]
    return result


def a_one_element_seam_of_the_softest_soil_ends_clearly(folder):
    """Finite numbers, or a stop that names the element; under level ground, which needs no stiffness, always finite numbers."""
    passed, finite = True, 0
    for make in (seam_under_level_ground, seam_under_a_slope):
        for name, law in SOFTEST.items():
            result = make(folder)
            result["materials"]["seam"] = TAILINGS | {"law": law}
            (folder / "scene.json").write_text(json.dumps(result))
            shutil.rmtree(folder / "out", ignore_errors=True)
            print(f"    {make.__name__}, {name}:")
            run = Run(folder)
            passed &= run.ended_clearly()
            if run.code == 0:
                finite += make is seam_under_level_ground
                print(f"    ended {run.result['ended']}, largest displacement {numpy.abs(run.point('displacement')).max():.3g} m")
    return passed and finite == len(SOFTEST)


def a_folded_quad_of_a_mesh_file_is_refused_by_its_name(folder):
    """Two squares side by side; the second one with crossing sides, then with a repeated node."""
    nodes = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 0.0), (2.0, 1.0)]
    box(folder, {"soil": elastic(1e7)}, [block("soil", "soil", [[0, 0], [2, 0], [2, 1], [0, 1]], [2, 1])], 2, 1,
        [{"type": "static", "name": "gravity"}], msh_file="soil.msh")
    passed = True
    for second, said in (((1, 4, 5, 2), None), ((1, 5, 4, 2), "element 2 near (1.5"), ((1, 4, 4, 2), "element 2 names node 5 twice")):
        write_msh(folder / "soil.msh", nodes, [(0, 1, 2, 3), second], [0, 0], ["soil"])
        done = solver(folder)
        passed &= done.returncode == 0 if said is None else done.returncode == 65 and said in done.stderr
        print(f"    exit {done.returncode}: {done.stderr.strip().splitlines()[-1] if done.returncode else 'sound'}")
    return passed


def a_length_below_the_elements_of_a_mesh_file_has_a_flag(folder):
    """Elements of 1 m; the check of the scene does not read the file."""
    nodes = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (2.0, 0.0), (2.0, 1.0)]
    softening = {"epsilon_q_start": 0.01, "epsilon_q_end": 1, "c_residual_kPa": 5, "phi_residual_deg": 20}
    law = {"type": "mohr_coulomb", "E_MPa": 10, "nu": 0.3, "c_kPa": 50, "phi_deg": 20, "softening": softening}
    passed = True
    for length, severity in ((0.9, "questionable"), (1.5, "warning"), (1.7, None)):
        box(folder, {"soil": {"density": 1800, "law": law, "nonlocal_length": length}},
            [block("soil", "soil", [[0, 0], [2, 0], [2, 1], [0, 1]], [2, 1])], 2, 1, [{"type": "static", "name": "gravity"}], msh_file="soil.msh")
        write_msh(folder / "soil.msh", nodes, [(0, 1, 2, 3), (1, 4, 5, 2)], [0, 0], ["soil"])
        found = {each["code"]: each for each in Run(folder).result["flags"]}.get("short_nonlocal_length")
        passed &= (found and found["severity"]) == severity
        print(f"    {length} m: {found}")
    return passed


def steps_a_hundred_times_too_large_are_cut_or_end_clearly(folder):
    """0.43 s, most of a period of the shaking, instead of 5e-3 s."""
    file = coarse_slope.write(folder, duration=2.0)
    result = json.loads(file.read_text())
    result["fem"]["stages"][-1] |= {"time_step": 0.43, "least_time_step": 0.43 / 1024}
    file.write_text(json.dumps(result))
    run = Run(folder)
    moved = numpy.abs(run.point("displacement")).max()
    coarse_slope.write(folder, duration=2.0)
    usual = numpy.abs(Run(folder).point("displacement")).max()
    print(f"    largest displacement {moved:.3f} m, with the usual steps {usual:.3f} m")
    return run.ended_clearly() and moved < 5.0 * usual


def a_wet_mesh_that_entangles_ends_with_its_last_good_state(folder):
    """A 20 m face of weak wet soil: it must fail, with a usable last state."""
    law = {"type": "mohr_coulomb", "E_MPa": 20, "nu": 0.3, "c_kPa": 1, "phi_deg": 30}
    soil = {"density": 2000, "void_ratio": 0.8, "permeability": [1e-6, 1e-6], "law": law}
    box(folder, {"soil": soil}, [block("soil", "soil", [[0, 0], [10, 0], [10, 20], [0, 20]], [10, 20])], 10, 20,
        [{"type": "static", "name": "gravity"},
         {"type": "dynamic", "name": "failure", "duration": 5.0, "time_step": 0.005}],
        force_tolerance=1e-6, water={"line": [[0, 14], [10, 4]]})
    file = folder / "scene.json"
    result = json.loads(file.read_text())
    del result["fem"]["supports"][1]
    result["fem"]["snapshot_times"] = [0.2]
    file.write_text(json.dumps(result))
    run = Run(folder)
    x = run.place() + run.point("displacement")[:, :2]
    with h5py.File(run.snapshots[-1]) as opened:
        corners = x[opened["breachline/quads"][:]]
    edges = [numpy.roll(corners, -k, axis=1) - corners for k in (1, 3)]
    least = (edges[0][..., 0] * edges[1][..., 1] - edges[0][..., 1] * edges[1][..., 0]).min()
    print(f"    least corner area of the last state {least:.3g} m2 of 1")
    lines = (run.out / "telemetry.jsonl").read_text().splitlines()
    assert all(json.loads(line) for line in lines)
    entanglement = run.result["entanglement"]
    print(f"    {run.result['ended']} at {run.result['end_time']} s: {entanglement}")
    return run.code == 0 and run.result["ended"] == "entangled" and entanglement["kind"] == "band" and run.ended_clearly() \
        and least > 0.0 and len(run.snapshots) >= 2


def main():
    case = globals()[sys.argv[1]]
    with tempfile.TemporaryDirectory() as name:
        return 0 if case(pathlib.Path(name)) else 1


sys.exit(main())
