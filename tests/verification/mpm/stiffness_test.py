#!/usr/bin/python3
"""Runouts do not depend on the wave speed: column, flow slope and Mochikoshi, each on four lattices of points, with the speed
that the program chooses, three times as fast, and at full stiffness.

    stiffness_test.py [--json] [SCENE...]   all of them; --json: the table alone, for workflows/verification

Exit 1 where a mean differs from that at full stiffness by more than twice the lattices' scatter."""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

root = pathlib.Path(os.environ["BREACH_ROOT"])
solver = pathlib.Path(os.environ["BREACH_BIN"]) / "mpm_solver"
shifts = ([0, 0], [0.31, 0.12], [0.77, 0.34], [0.14, 0.59])
quick = {
    "column": [],
    "flow_slope": [],
}
changes = quick | {
    "mochikoshi_runout": ["/mpm/cell_size=2.5", "/mpm/cfl=0.8", "/mpm/blending_rate=0.1"],
}


def filled(name, folder):
    """The scene without its FEM: points fill the section."""
    scene = json.loads((root / f"workflows/scenes/{name}.json").read_text())
    scene.pop("fem", None)
    scene.pop("transfer", None)
    scene["mpm"].setdefault("fill_stress", "overburden")
    file = pathlib.Path(folder) / f"{name}.json"
    file.write_text(json.dumps(scene))
    return file


def run(scene, shift, sets):
    with tempfile.TemporaryDirectory() as folder:
        words = [word for each in [*sets, f"/mpm/fill_shift={shift}"] for word in ("--set", each)]
        subprocess.run([solver, scene, "--output", folder, "--progress", "none", *words], check=True, capture_output=True)
        return json.loads((pathlib.Path(folder) / "result.json").read_text())


def row(name, label, scene, scale):
    sets = changes[name] + ([f"/mpm/stiffness_scale={scale}"] if scale else [])
    with ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda shift: run(scene, shift, sets), shifts))
    runouts = [each["runout_beyond_toe"] for each in results]
    return {"scene": name, "stiffness": label, "mean": statistics.mean(runouts), "deviation": statistics.stdev(runouts),
            "mach": max(each["mach"] for each in results), "wave_speed": results[0]["wave_speed"],
            "cpu_seconds": statistics.mean(each["cpu_seconds"] for each in results)}


def rows_of(name):
    with tempfile.TemporaryDirectory() as folder:
        scene = filled(name, folder)
        full = row(name, "full", scene, 1)
        auto = row(name, "auto", scene, None)
        faster = (3.0 * auto["wave_speed"] / full["wave_speed"]) ** 2
        return [auto] + ([row(name, "three times as fast", scene, faster)] if faster < 1.0 else []) + [full]


def main():
    names = [each for each in sys.argv[1:] if not each.startswith("-")] or list(changes)
    rows, wrong = [], []
    for name in names:
        own = rows_of(name)
        full = own[-1]
        for each in own:
            scatter = max(each["deviation"], full["deviation"], 0.01 * abs(full["mean"]))
            each["apart"] = (each["mean"] - full["mean"]) / scatter
            if abs(each["apart"]) > 2.0:
                wrong.append(each)
        rows += own
    if "--json" in sys.argv:
        print(json.dumps(rows))
        return 0
    for each in rows:
        print("{scene:18} {stiffness:20} {mean:7.2f} +- {deviation:5.2f} m, {apart:+.2f} of the scatter, c {wave_speed:6.0f} m/s, "
              "Mach {mach:.3f}, {cpu_seconds:6.1f} CPU s".format(**each))
    for each in wrong:
        print(f"{each['scene']} at {each['stiffness']}: {each['apart']:+.2f} times the lattices' scatter from full stiffness")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
