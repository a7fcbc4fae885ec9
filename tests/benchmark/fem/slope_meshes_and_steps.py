#!/usr/bin/python3
"""Error against run time of fem_solver on the slope scene: element size and time step against seconds and crest motion.

    slope_meshes_and_steps.py BIN_FOLDER [--time 1.5] [--peak]

Softening is explicit and local, so shear bands are one element wide and the mesh columns do not converge: that is a known
limit and the table shows it. --peak takes the softening away: then both directions must converge.
"""
import argparse
import json
import pathlib
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCENE = ROOT / "workflows/scenes/slope.json"
MESHES = [(1.0, [60, 4], [30, 10]), (0.667, [90, 6], [45, 15]), (0.5, [120, 8], [60, 20])]
TIME_STEPS = [0.02, 0.01, 0.005]


def run(program, mesh, time_step, end, peak):
    _, base, slope = mesh
    overrides = [
        f"/section/regions/0/mesh/divisions={json.dumps(base)}",
        f"/section/regions/1/mesh/divisions={json.dumps(slope)}",
        f"/fem/stages/1/time_step={time_step}",
        f"/fem/stages/1/duration={end}",
    ]
    if peak:
        law = json.loads(SCENE.read_text())["materials"]["slope_soil"]["law"]
        law.pop("softening")
        law["c_kPa"] = 9
        overrides.append("/materials/slope_soil/law=" + json.dumps(law))
    with tempfile.TemporaryDirectory() as folder:
        command = [str(program), str(SCENE), "--output", folder, "--progress", "none"]
        for each in overrides:
            command += ["--set", each]
        done = subprocess.run(command, stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            return None, done.stderr.strip().splitlines()[-1]
        result = json.loads((pathlib.Path(folder) / "result.json").read_text())
        lines = (pathlib.Path(folder) / "telemetry.jsonl").read_text().splitlines()
        return result, json.loads(lines[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--time", type=float, default=1.5)
    parser.add_argument("--quick", action="store_true", help="two meshes, two steps")
    parser.add_argument("--peak", action="store_true", help="perfectly plastic, c = 9 kPa")
    arguments = parser.parse_args()
    rows = []
    meshes, time_steps = (MESHES[:2], TIME_STEPS[:2]) if arguments.quick else (MESHES, TIME_STEPS)
    for mesh in meshes:
        for time_step in time_steps:
            result, last = run(arguments.bin / "fem_solver", mesh, time_step, arguments.time, arguments.peak)
            rows.append((mesh[0], time_step, result, last))
    finest = rows[-1][3]["crest_displacement"]
    print(f"crest displacement at {arguments.time} s")
    print(" h [m]  dt [s]  elements  unknowns  iterations  factorisations  CPU [s]  crest [m]  to finest")
    for h, time_step, result, last in rows:
        if result is None:
            print(f"{h:6.3f}  {time_step:6.3f}  {last}")
            continue
        crest = last["crest_displacement"]
        print(f"{h:6.3f}  {time_step:6.3f}  {result['elements']:8d}  {result['unknowns']:8d}  "
              f"{result['iterations']:10d}  {result['factorisations']:14d}  {result['cpu_seconds']:7.2f}  "
              f"{crest:9.4f}  {100 * (crest / finest - 1):+8.1f} %")


if __name__ == "__main__":
    main()
