"""The slope's sweep over transfer times, once on the local pool and once on Slurm: the same table, number for number.

    sweep_on_both.py COUNT [OVERRIDE...]     with BREACH_REAL_SLURM set (with_slurm.py) on it, else on the fake
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import urllib.request

root = pathlib.Path(os.environ["BREACH_ROOT"])
programs = pathlib.Path(os.environ["BREACH_BIN"])
count, overrides = int(sys.argv[1]), sys.argv[2:]
first, last = 0.4, 2.6  # of the slope's three dynamic seconds


def study():
    scene = json.loads((root / "workflows/scenes/slope.json").read_text())
    times = [round(first + (last - first) * i / (count - 1), 6) for i in range(count)]
    return {"format": "breachline-study/1", "name": "slope-sweep", "scene": scene, "transfer_times": times,
            "overrides": overrides, "stability": False}


def ask(url, body=None):
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(url, data, {"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=60) as answer:
        return json.load(answer)


def sweep(folder, *arguments, **environment):
    service = subprocess.Popen([programs / "breachline", "serve", "--data", folder, "--port", "0", "--bin", programs,
                                *arguments],
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                               env={**os.environ, **environment})
    try:
        url = json.loads(service.stdout.readline())["url"]
        began = time.monotonic()
        run = ask(f"{url}/v1/sweeps", study())["id"]
        while (state := ask(f"{url}/v1/sweeps/{run}"))["finished"] is None:
            time.sleep(0.3)
        assert state["state"] in ("succeeded", "questionable"), state  # either state is possible, depending on the scene
        rows = ask(f"{url}/v1/sweeps/{run}/results")["rows"]
        print(f"{' '.join(arguments) or 'local pool'}: {len(rows)} transfer times in {time.monotonic() - began:.1f} s, "
              f"{sum(row['cpu_seconds'] for row in rows):.1f} s CPU in the MPM", flush=True)
        return rows
    finally:
        service.terminate()
        service.wait(60)
        service.stdout.close()


def facts(rows):
    """Without ids and CPU time, which differ between executions."""
    return [{key: value for key, value in row.items() if not key.endswith("_task") and key != "cpu_seconds"}
            for row in rows]


def main():
    slurm, environment = ["--executor", "slurm", "--slots", "8", "--slurm-poll", "1"], {}
    with tempfile.TemporaryDirectory(prefix="breach-", dir="/tmp") as name:
        pathlib.Path(name).chmod(0o755)
        if "BREACH_REAL_SLURM" not in os.environ:
            environment = {"PATH": f"{root}/tests/slurm/fake:{os.environ['PATH']}", "FAKE_SLURM": f"{name}/slurm"}
            print("no Slurm: the fake one")
        here = facts(sweep(f"{name}/local"))
        there = facts(sweep(f"{name}/slurm-data", *slurm, **environment))
        assert len(here) == count and here == there, [pair for pair in zip(here, there) if pair[0] != pair[1]]
        for row in here:
            print(f"t_T = {row['transfer_time']:.3f} s   runout {row['runout']:.4f} m")
        print("the same on both, to the last digit")


main()
