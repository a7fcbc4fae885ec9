#!/usr/bin/python3
"""How far forecasts are off: what the cost of ten studies is said to be before their first run and after it, and what the run took.

    forecasts.py [STUDY...]     of workflows/studies; without names the ten that docs/reference/capacity.md has first

Exit 1 where fewer than 8 of 10 first forecasts, or 9 of 10 after a run, are within a factor of 2 of the CPU seconds."""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

root = pathlib.Path(os.environ["BREACH_ROOT"])
sys.path.insert(0, str(root / "tests/workflow"))
from service import Service  # noqa: E402

QUICK = ["flow_slope", "column_sweep", "column_aspects", "slopes", "slope_sweep", "static_lift", "static_toe_cut", "static_phreatic_rise",
         "merriespruit", "column_draws"]


def likeliest(between):
    return math.sqrt(between[0] * between[1])


def forecast(service, study):
    cost = json.loads(service.breach("submit", study, "--dry-run", "--json"))
    return likeliest(cost["cpu_seconds"]), likeliest(cost["wall_seconds"])


def cpu_seconds(service, run):
    tasks, after = [], ""
    while after is not None:
        answer = service.call(f"/v1/runs/{run}/tasks" + (f"?after={after}" if after else ""))
        tasks += answer["tasks"]
        after = answer["next"]
    return sum((task["result"] or {}).get("cpu_seconds", 0.0) for task in tasks if task["state"] == "succeeded")


def main():
    names = sys.argv[1:] or QUICK
    first, known = [], []
    print("| study | said, CPU s | measured | said, s by the clock | measured | off | off after the run |\n|---|---|---|---|---|---|---|")
    for name in names:
        study = root / f"workflows/studies/{name}.json"
        with tempfile.TemporaryDirectory() as folder:
            service = Service(pathlib.Path(folder))
            try:
                said, said_wall = forecast(service, study)
                began = time.monotonic()
                run = service.submit(study)
                service.finish(run)
                wall, spent = time.monotonic() - began, cpu_seconds(service, run)
                again, _ = forecast(service, study)
            finally:
                service.stop()
        first.append(spent / said)
        known.append(spent / again)
        print(f"| {name} | {said:.1f} | {spent:.1f} | {said_wall:.1f} | {wall:.1f} | {first[-1]:.2f} | {known[-1]:.2f} |", flush=True)
    within = [sum(0.5 <= each <= 2.0 for each in those) / len(those) for those in (first, known)]
    print(f"within a factor of 2: {within[0]:.0%} before the first run, {within[1]:.0%} after it")
    return 0 if within[0] >= 0.8 and within[1] >= 0.9 else 1


if __name__ == "__main__":
    sys.exit(main())
