#!/usr/bin/python3
"""What a scene does not need: instructions per step and bytes with every feature on, and with one at a time off.

    what_is_left_out.py      prints the tables of docs/verification/what_is_left_out.md (workflows/verification/write)

Instructions are counted by valgrind's cachegrind without its caches: they do not hang on the machine's load. Per step: a run of
twice the steps less a run of them, so that reading, meshing and the first matrix drop out. Bytes are those of --plan --measure."""
import copy
import json
import math
import os
import pathlib
import re
import subprocess
import tempfile

root = pathlib.Path(os.environ.get("BREACH_ROOT", pathlib.Path(__file__).resolve().parents[3]))
programs = pathlib.Path(os.environ.get("BREACH_BIN", root / "build/release/bin"))


def rectangle(x0, y0, x1, y1):
    return [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]]


def mpm_scene(folder):
    """Sand 10 m x 10 m on a slope of 1:10 with all that the MPM knows but shaking, which wants a FEM's files, in cells of 0.5 m: 1,600 points."""
    softening = {"epsilon_q_start": 0.01, "epsilon_q_end": 1.0, "c_residual_kPa": 0.5, "phi_residual_deg": 10}
    law = {"type": "mohr_coulomb", "E_MPa": 20, "nu": 0.3, "c_kPa": 5, "phi_deg": 30, "softening": softening}
    return {"format": "breachline-scene/1", "name": "all-on", "materials": {"sand": {"density": 1800, "viscosity": 1000, "nonlocal_length": 0.8, "law": law}},
            "section": {"regions": [{"name": "heap", "material": "sand", "polygon": rectangle(5, 6, 15, 16)}]},
            "mpm": {"cell_size": 0.5, "domain_x": [0, 40], "domain_y": [0, 20], "left": "open",
                    "terrain": [[0, 6.4], [40, 2.4]], "water": {"line": [[0, 8], [40, 8]]},
                    "floor": {"level": 0, "friction": [{"from": 0, "to": 20, "coefficient": 0.5}, {"from": 20, "to": 40, "coefficient": 0.3}]},
                    "anti_locking": "on", "gap_room": True, "overlap_correction": {"rate": 5, "tolerance": 0.1},
                    "gauges": [{"name": f"gauge{k}", "x": 16 + 4 * k} for k in range(5)], "softening_length": 0.5,
                    "time_step": 0.0005, "duration": 0.008, "snapshot_interval": 100, "telemetry_interval": 0.002,
                    "rest_earliest": 100, "checkpoint_interval": 1000, "runout": {"toe": [15, 6]}}}


def fem_scene(folder):
    """A wet bench of Mohr-Coulomb soil that softens, on an absorbing base between free-field columns, shaken."""
    lines = ["time_s,acceleration_g"] + [f"{0.005 * k:.3f},{0.1 * math.sin(12.6 * 0.005 * k):.6f}" for k in range(200)]
    (folder / "motion.csv").write_text("\n".join(lines) + "\n")
    softening = {"epsilon_q_start": 0.01, "epsilon_q_end": 1.0, "c_residual_kPa": 5, "phi_residual_deg": 25}
    law = {"type": "mohr_coulomb", "E_MPa": 50, "nu": 0.3, "c_kPa": 20, "phi_deg": 35, "softening": softening}
    soil = {"density": 2000, "viscosity": 1000, "void_ratio": 0.8, "permeability": [1e-6, 1e-6], "law": law}
    region = {"name": "bench", "material": "soil", "polygon": rectangle(0, 0, 20, 10), "mesh": {"type": "block", "divisions": [20, 10]}}
    return {"format": "breachline-scene/1", "name": "all-on", "materials": {"soil": soil}, "section": {"regions": [region]},
            "fem": {"element": "ssp", "crest": [10, 10],
                    "supports": [{"name": "base", "from": [0, 0], "to": [20, 0], "fixes": "xy"}],
                    "water": {"line": [[0, 9]]}, "base": {"density": 2300, "V_s": 760}, "free_field": {"width": 2},
                    "motion": {"file": str(folder / "motion.csv")}, "rayleigh_mass": 0.1, "rayleigh_stiffness": 0.001,
                    "surcharge": [{"from": 5, "to": 15, "pressure_kPa": 5}],
                    "liquefaction": {"regions": ["bench"], "x": [0, 20], "level": 10},
                    "telemetry_interval": 0.005,
                    "stages": [{"type": "static", "name": "gravity", "laws": "elastic"},
                               {"type": "dynamic", "name": "shaking", "duration": 0.03, "time_step": 0.005}]}}


def without(*keys):
    def change(scene):
        inner = scene
        for key in keys[:-1]:
            inner = inner[key]
        inner.pop(keys[-1], None)
    return change


def having(value, *keys):
    def change(scene):
        inner = scene
        for key in keys[:-1]:
            inner = inner[key]
        inner[keys[-1]] = value
    return change


def all_of(*changes):
    def change(scene):
        for each in changes:
            each(scene)
    return change


def on_rollers(scene):
    scene["fem"]["supports"] += [{"name": "left", "from": [0, 0], "to": [0, 10], "fixes": "x"},
                                 {"name": "right", "from": [20, 0], "to": [20, 10], "fixes": "x"}]


# Feature, what switches it off, and what its being off leaves behind in a step.
COMPILED, PER_STEP, PER_NODE = "nothing: another loop is compiled without it", "one test per step", "one test per node in use"
MPM = {
    "nonlocal softening": (without("materials", "sand", "nonlocal_length"), PER_STEP),
    "softening": (all_of(without("materials", "sand", "law", "softening"), without("materials", "sand", "nonlocal_length")), COMPILED),
    "viscosity and damping": (all_of(without("materials", "sand", "viscosity"), having(0, "mpm", "damping_ratio")), COMPILED),
    "anti-locking": (having("off", "mpm", "anti_locking"), COMPILED),
    "tension (gap closure)": (having(False, "mpm", "gap_closure"), COMPILED),
    "gaps held to their room": (having(False, "mpm", "gap_room"), PER_STEP),
    "overlap correction": (without("mpm", "overlap_correction"), PER_STEP),
    "standing water": (without("mpm", "water"), COMPILED),
    "terrain": (all_of(without("mpm", "terrain"), having(4.0, "mpm", "floor", "level"), having([4, 20], "mpm", "domain_y")), PER_NODE),
    "friction zones": (having([], "mpm", "floor", "friction"), PER_NODE),
    "gauges": (having([], "mpm", "gauges"), "nothing between two looks"),
    "telemetry": (having(100, "mpm", "telemetry_interval"), PER_STEP),
}
FEM = {
    "water": (all_of(without("fem", "water"), without("fem", "liquefaction")), "no unknowns; one test per element's assembly"),
    "softening": (without("materials", "soil", "law", "softening"), "one test per zone and step"),
    "viscosity": (without("materials", "soil", "viscosity"), "one test per assembly"),
    "plasticity": (having({"type": "linear_elastic", "E_MPa": 50, "nu": 0.3}, "materials", "soil", "law"), "another law's loop per zone"),
    "free field": (all_of(without("fem", "free_field"), on_rollers), "no unknowns"),
    "dashpots and motion": (all_of(without("fem", "base"), without("fem", "motion")), PER_STEP),
    "Rayleigh damping": (all_of(without("fem", "rayleigh_mass"), without("fem", "rayleigh_stiffness")), "two tests per assembly"),
    "surcharge": (without("fem", "surcharge"), "nothing: a constant force"),
    "watch of liquefaction": (without("fem", "liquefaction"), "one test per telemetry line"),
    "telemetry": (having(100, "fem", "telemetry_interval"), PER_STEP),
}


def instructions(program, scene, folder):
    """Of one whole run."""
    file = folder / "scene.json"
    file.write_text(json.dumps(scene))
    done = subprocess.run(["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null",
                           str(programs / program), str(file), "--output", str(folder / "out"), "--progress", "none"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{program} ended with {done.returncode}: {done.stderr[-800:]}")
    result = json.loads((folder / "out/result.json").read_text())
    return int(re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)[1].replace(",", "")), result["steps"]


def longer(program, scene):
    twice = copy.deepcopy(scene)
    if program == "mpm_solver":
        twice["mpm"]["duration"] *= 2
    else:
        twice["fem"]["stages"][1]["duration"] *= 2
    return twice


def per_step(program, scene, folder):
    few, steps = instructions(program, scene, folder)
    many, more_steps = instructions(program, longer(program, scene), folder)
    return (many - few) / (more_steps - steps)


def memory(program, scene, folder):
    """Counts and bytes of --plan --measure."""
    file = folder / "scene.json"
    file.write_text(json.dumps(scene))
    done = subprocess.run([str(programs / program), str(file), "--plan", "--measure"], capture_output=True, text=True, check=True)
    found = {what.strip(): float(number) for what, number in re.findall(r"^cost      (.{34})\s*(\d+)(?: bytes)?$", done.stdout, re.M)}
    return found, sum(number for what, number in found.items() if what.startswith("memory"))


def rows(program, base, features, size):
    """Name, instructions per step, those of off over on, bytes, what off leaves."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene = base(folder)
        on = per_step(program, scene, folder)
        counts, bytes_on = memory(program, scene, folder)
        yield "everything on", on, 1.0, bytes_on / counts[size], "", counts
        for feature, (switch_off, leaves) in features.items():
            less = copy.deepcopy(scene)
            switch_off(less)
            counts, some = memory(program, less, folder)
            count = per_step(program, less, folder)
            yield f"without {feature}", count, count / on, some / counts[size], leaves, counts


def section(title, program, base, features, size):
    lines = [f"## {title}", "", f"| | instructions per step | of all on | bytes per {size} | being off leaves |", "|---|---|---|---|---|"]
    least, tests = math.inf, 0.0
    for name, count, share, some, leaves, counts in rows(program, base, features, size.replace("element", "elements").replace("point", "points")):
        lines.append(f"| {name} | {count:,.0f} | {100 * share:.1f} % | {some:,.0f} | {leaves} |")
        least = min(least, count)
        # MPM: floor and terrain are asked for at every node. FEM: as if every feature were asked for in every element.
        places = 2 * counts["nodes in use"] if "nodes in use" in counts else len(features) * counts["elements"]
        tests = max(tests, len(features) + places)
    lines += ["", f"Tests that are left when all is off: at most {tests:,.0f} per step, at three instructions each (load, compare, jump) "
              f"{100 * 3 * tests / least:.2f} % of the cheapest step above.", ""]
    return lines


def main():
    print("\n".join(section("MPM: 1,600 points, a step of 0.5 ms", "mpm_solver", mpm_scene, MPM, "point") +
                    section("FEM: 200 elements and two columns, a step of 5 ms", "fem_solver", fem_scene, FEM, "element")))


if __name__ == "__main__":
    main()
