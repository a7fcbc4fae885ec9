"""fem_solver --profile names every kind of work, its parts are nearly the whole, and without it nothing is printed."""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import coarse_slope
from runs import judge

KINDS = ("assembly", "law", "factor", "solve", "output", "other", "whole")


def run(folder, *more):
    command = [f"{os.environ['BREACH_BIN']}/fem_solver", str(folder / "scene.json"), "--output", str(folder / "out"),
               "--progress", "none", *more]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=True)
    return done.stdout, json.loads((folder / "out/result.json").read_text())


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        coarse_slope.write(folder, duration=1.0)
        silent, plain = run(folder)
        table, result = run(folder, "--profile")
    print(table, end="")
    spent = {kind: float(seconds) for kind, seconds in re.findall(r"^(\w+) +([\d.]+) +[\d.]+ %$", table, re.M)}
    steps, iterations, each = re.search(r"^(\d+) steps, (\d+) iterations, ([\d.]+) s per step$", table, re.M).groups()
    passed = silent == "" and tuple(spent) == KINDS and int(steps) == result["steps"]
    passed &= int(iterations) == result["iterations"] == plain["iterations"]
    passed &= judge("printed parts and other against the whole, over it",
                    abs(sum(spent.values()) / spent["whole"] - 2.0), 0.01)
    # Reading, meshing, prediction and start-up belong to no kind.
    passed &= judge("other over the whole", spent["other"] / spent["whole"], 0.2)
    passed &= judge("whole against seconds per step, over the whole",
                    abs(float(each) * int(steps) / spent["whole"] - 1.0), 0.01)
    passed &= judge("CPU seconds of the process less the whole, over it",
                    abs(result["cpu_seconds"] / spent["whole"] - 1.0), 0.1)
    print(f"    CPU seconds with --profile over without: {result['cpu_seconds'] / plain['cpu_seconds']:.3f}")
    return 0 if passed else 1


sys.exit(main())
