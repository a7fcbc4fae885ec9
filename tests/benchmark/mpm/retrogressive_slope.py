#!/usr/bin/env python3
"""Does a slope that fails block by block run out as far with any cells? A 45-degree slope of softening clay, 5 m high, on a
floor that holds it (c 20 to 4 kPa over epsilon_q 0 to 10 %, phi 1 degree, E 1 MPa, nu 0.33, g 10), by the local law with
strains scaled by the cell and by the nonlocal one (l = 0.32 m, reference length 0.2 m). A row per run.

    retrogressive_slope.py --solver build/release/bin/mpm_solver [--output folder] [--cells 0.2,0.1,0.05] [--points 2,3]
                           [--law nonlocal] [--set /mpm/overlap_correction/rate=5 ...] [--within 0.03]

--within: exits with 1 if a run failed or its Rd is farther than this from the mean of its law. Runs that the folder holds already
are not repeated, so other settings want another folder; without one nothing is kept."""
import argparse
import concurrent.futures
import csv
import json
import os
import subprocess
import sys
import tempfile

import numpy

LENGTH, REFERENCE = 0.32, 0.2  # m
CREST, TOE, HEIGHT = 20.0, 25.0, 5.0


def scene_of(h, points, nonlocal_length):
    clay = {"density": 2000, "law": {"type": "mohr_coulomb", "E_MPa": 1, "nu": 0.33, "c_kPa": 20, "phi_deg": 1,
                                     "softening": {"epsilon_q_start": 0, "epsilon_q_end": 0.1, "c_residual_kPa": 4,
                                                   "phi_residual_deg": 1}}}
    if nonlocal_length:
        clay["nonlocal_length"] = nonlocal_length
    return {"format": "breachline-scene/1", "name": "retrogressive_slope", "gravity": 10.0, "materials": {"clay": clay},
            "section": {"regions": [{"name": "slope", "material": "clay",
                                     "polygon": [[0, 0], [TOE, 0], [CREST, HEIGHT], [0, HEIGHT], [0, 0]]}]},
            "mpm": {"cell_size": h, "domain_x": [0, 60], "domain_y": [0, 7], "floor": {"level": 0}, "fill_points": points,
                    "fill_stress": "overburden", "softening_length": REFERENCE, "cfl": 0.5, "duration": 12,
                    "rest_earliest": 24, "snapshot_interval": 1, "telemetry_interval": 0.1, "runout": {"toe": [TOE, 0], "front_depth": 0.2}}}


def blocks_in(folder):
    """Troughs of the deposit's surface deeper than a tenth of the height, and the end of the undisturbed ground."""
    with open(os.path.join(folder, "profile.csv")) as stream:
        rows = list(csv.DictReader(stream))
    x = numpy.array([float(row["x_m"]) for row in rows])
    depth = numpy.array([float(row["depth_m"]) for row in rows])
    stands = x[depth > 0.97 * HEIGHT].max(initial=0.0)
    top, troughs, low = depth[0], 0, None
    for d in depth:
        if low is None:
            if d < top - 0.1 * HEIGHT:
                low = d
            top = max(top, d) if d > top else top
        elif d > low + 0.1 * HEIGHT:
            troughs, top, low = troughs + 1, d, None
        else:
            low = min(low, d)
    return troughs, stands


def run(solver, folder, settings, h, points, nonlocal_length):
    name = f"h{h:g}_{points ** 2}_{'nonlocal' if nonlocal_length else 'local'}"
    out = os.path.join(folder, name)
    kept = os.path.join(out, "row.json")
    if os.path.exists(kept):
        return json.load(open(kept))
    os.makedirs(out, exist_ok=True)
    scene = os.path.join(out, "given.json")
    json.dump(scene_of(h, points, nonlocal_length), open(scene, "w"))
    done = subprocess.run([solver, scene, "--output", out, "--progress", "none", *(word for each in settings for word in ("--set", each))],
                          capture_output=True, text=True)
    row = {"run": name, "exit": done.returncode}
    if done.returncode:
        row["why"] = done.stderr.strip().split("\n")[-1]
    else:
        result = json.load(open(os.path.join(out, "result.json")))
        troughs, stands = blocks_in(out)
        row.update(Rd_m=result["runout_beyond_toe"], Rd95_m=result["runout_beyond_toe_95"], stands_to_m=stands, troughs=troughs,
                   kinetic_left=result["energy"]["kinetic"]["share"], numerical=result["energy"]["numerical"]["share"],
                   put_in=result["energy"]["overlap_correction"]["share"], overlap=result["overlap"], particles=result["particles"], steps=result["steps"], cpu_s=result["cpu_seconds"])
    json.dump(row, open(kept, "w"))
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--solver", required=True)
    parser.add_argument("--output")
    parser.add_argument("--cells", default="0.2,0.1,0.05")
    parser.add_argument("--points", default="2,3")
    parser.add_argument("--law", choices=["local", "nonlocal"])
    parser.add_argument("--within", type=float)
    parser.add_argument("--set", action="append", default=[], dest="settings")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    cases = [(float(h), int(points), length) for length in (None, LENGTH) for h in options.cells.split(",")
             for points in options.points.split(",") if not length or float(h) <= length / 1.3]
    if options.law:
        cases = [case for case in cases if bool(case[2]) == (options.law == "nonlocal")]
    with tempfile.TemporaryDirectory() as passing, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        rows = list(pool.map(lambda case: run(options.solver, options.output or passing, options.settings, *case), cases))
    shown = ["run", "Rd_m", "Rd95_m", "stands_to_m", "troughs", "kinetic_left", "numerical", "put_in", "overlap", "particles", "steps", "cpu_s", "why"]
    print(" | ".join(f"{name:>18}" if name == "run" else f"{name:>12}" for name in shown))
    for row in rows:
        print(" | ".join(f"{row.get(name, ''):>18}" if name == "run" else f"{row.get(name, ''):>12.5g}"
                         if isinstance(row.get(name), float) else f"{row.get(name, ''):>12}" for name in shown))
    held = not any(row["exit"] for row in rows)
    for kind in ("_local", "_nonlocal"):
        far = [row["Rd_m"] for row in rows if row["run"].endswith(kind) and not row["exit"]]
        if far:
            mean = sum(far) / len(far)
            print(f"{kind[1:]}: Rd {mean:.2f} m, {100 * (min(far) / mean - 1):+.1f} to {100 * (max(far) / mean - 1):+.1f} %")
            held = held and max(mean - min(far), max(far) - mean) <= (options.within or 1e9) * mean
    return 0 if held else 1


if __name__ == "__main__":
    sys.exit(main())
