"""fem_solver stopped within a drained static stage whose water rises, killed by SIGKILL after it went on, stopped again within
an undrained one in which a plate is pushed, and resumed: every dataset of history and last snapshot, every line of telemetry and the
facts of the stages equal to those of an undisturbed run."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import runs

SOLVER = f"{os.environ['BREACH_BIN']}/fem_solver"
SIDE, ROWS, END = 6.0, 6, 0.02


def scene():
    law = dict(type="norsand", Gamma=0.9, **{"lambda": 0.02}, M_tc=1.2, N=0.3, chi_tc=3.5, H_0=300, G_ref_MPa=30, m=1.0,
               nu=0.15, K_0=0.7, psi_0_profile={"by": "depth", "points": [[1, 0.02], [5, 0.05]]})
    corners = [[0, 0], [SIDE, 0], [SIDE, SIDE], [0, SIDE], [0, 0]]
    scene_laws = {"type": "static", "laws": "scene"}
    return {
        "format": "breachline-scene/1", "name": "stages", "gravity": 9.81,
        "materials": {"soil": {"density": 2000, "void_ratio": 0.8, "permeability": [1e-6, 1e-6], "law": law}},
        "section": {"regions": [{"name": "block", "material": "soil", "polygon": corners,
                                 "mesh": {"type": "block", "divisions": [ROWS, ROWS]}}]},
        "fem": {
            "element": "ssp", "crest": [SIDE, SIDE], "largest_iterations": 100, "water": {"line": [[0, 2]]},
            "supports": [{"name": "left", "from": [0, 0], "to": [0, SIDE], "fixes": "x"},
                         {"name": "right", "from": [SIDE, 0], "to": [SIDE, SIDE], "fixes": "x"},
                         {"name": "base", "from": [0, 0], "to": [SIDE, 0], "fixes": "xy"}],
            "stages": [{"type": "static", "name": "gravity"},
                       {"name": "law", **scene_laws},
                       {"name": "rise", "load_steps": 100, "phreatic_line": [[0, 4.5]], **scene_laws},
                       {"name": "push", "load_steps": 100, "undrained": ["block"],
                        "displace": [{"name": "plate", "from": [2, SIDE], "to": [4, SIDE], "y": -0.0005}], **scene_laws},
                       {"type": "dynamic", "name": "run", "duration": END, "time_step": 0.002, "ramp": 0.01}]}}


def command(scene_file, output, *more):
    return [SOLVER, str(scene_file), "--output", str(output), "--progress", "none", *more]


def signalled(stage, number, scene_file, output, *more):
    """Sends the signal after the stage's tenth load step."""
    process = subprocess.Popen(command(scene_file, output, *more), stderr=subprocess.PIPE, text=True)
    within, steps = False, 0
    for line in process.stderr:
        within = within or line.rstrip().endswith(f"stage {stage}") or more == ("--resume",) and "goes on at" in line
        steps += within and "of gravity in" in line
        if steps == 10:
            process.send_signal(number)
            break
    process.stderr.read()
    return process.wait()


def stop_in(stage, number, scene_file, output, *more):
    """The same; repeats from its beginning if the stage ended before the signal (on a busy machine)."""
    before = output.with_name("before")
    if output.exists():
        shutil.copytree(output, before)
    for _ in range(20):
        code = signalled(stage, number, scene_file, output, *more)
        if code != 0:
            break
        shutil.rmtree(output)
        if before.exists():
            shutil.copytree(before, output)
    shutil.rmtree(before, ignore_errors=True)
    return code


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene_file = folder / "scene.json"
        scene_file.write_text(json.dumps(scene()))
        whole, stopped = folder / "whole", folder / "stopped"
        subprocess.run(command(scene_file, whole), stderr=subprocess.DEVNULL, check=True)
        assert stop_in("rise", signal.SIGTERM, scene_file, stopped) == 143
        assert stop_in("rise", signal.SIGKILL, scene_file, stopped, "--resume") == -signal.SIGKILL
        assert stop_in("push", signal.SIGTERM, scene_file, stopped, "--resume", "--threads", "2") == 143
        assert not (stopped / "result.json").exists()
        subprocess.run(command(scene_file, stopped, "--resume"), stderr=subprocess.DEVNULL, check=True)
        wrong = runs.differences(whole, stopped, ("history.h5", f"snapshot_{END:.6f}.vtkhdf"))
        facts = [json.loads((each / "result.json").read_text())["geostatic"] for each in (whole, stopped)]
        if facts[0] != facts[1]:
            wrong.append("geostatic")
        print(f"    stopped, killed and stopped within stages: {len(wrong)} differ {wrong}")
        assert len(facts[0]["push"]["displaced"]["plate"]) == 100
    return 1 if wrong else 0


sys.exit(main())
