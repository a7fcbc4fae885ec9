"""The slope scene with the real phases: a criterion that fires live, and `bisect` against the uniform sweep over the
same snapshots. Prints how many MPM runs each needs, and the edges that each finds; they must agree.

    BREACH_ROOT=... BREACH_BIN=... python3 bisect_on_slope.py [tolerance_s]      (default 0.1 s)
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
binaries = pathlib.Path(os.environ["BREACH_BIN"])
tolerance = float(sys.argv[1]) if len(sys.argv) > 1 else 0.1
share, first, last = 0.75, 0.5, 2.8


def ask(url, body=None):
    data = None if body is None else json.dumps(body).encode()
    request = urllib.request.Request(url, data, {"Content-Type": "application/json"})
    with urllib.request.urlopen(request, timeout=60) as answer:
        return json.load(answer)


def run_study(url, triggers, times=None):
    scene = json.loads((root / "workflows/scenes/slope.json").read_text())
    study = {"format": "breachline-study/1", "name": "bisect-slope", "scene": scene, "stability": False,
             "triggers": triggers}
    if times:
        study["transfer_times"] = times
    run = ask(f"{url}/v1/runs", study)["id"]
    while True:
        state = ask(f"{url}/v1/runs/{run}")
        if state["finished"]:
            break
        time.sleep(0.5)
    if state["state"] not in ("succeeded", "partial"):
        raise SystemExit(f"run {run}: {state['state']}: {state['message']}")
    return ask(f"{url}/v1/runs/{run}/triggers")["triggers"], ask(f"{url}/v1/runs/{run}/results")["rows"]


def plateau(rows):
    """Edges by the uniform sweep: outermost times of the plateau around the largest runout."""
    table = sorted((row["transfer_time"], row["runout"]) for row in rows if row["runout"] is not None)
    level = share * max(runout for _, runout in table)
    top = max(range(len(table)), key=lambda i: table[i][1])
    low = top
    while low > 0 and table[low - 1][1] >= level:
        low -= 1
    high = top
    while high + 1 < len(table) and table[high + 1][1] >= level:
        high += 1
    return table[low][0], table[high][0]


def main():
    with tempfile.TemporaryDirectory() as folder:
        service = subprocess.Popen([binaries / "breachline", "serve", "--data", folder, "--port", "0"],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        try:
            url = json.loads(service.stdout.readline())["url"]
            [live], _ = run_study(url, [{"kind": "criterion", "name": "distorted", "when": "jacobian_least_avg < 0.97",
                                         "hold_s": 0.05, "within_s": 1.0}])
            print(f"criterion: {live['state']} {live['reason']}")
            for firing in live["firings"]:
                print(f"  met at {firing['wanted_time']:.3f} s, snapshot at {firing['transfer_time']:.3f} s, written after "
                      f"{firing['snapshot_ms']} ms, transfer started after {firing['start_ms']} ms")
            [found], rows = run_study(url, [{"kind": "bisect", "share": share, "tolerance_s": tolerance, "from": first,
                                             "to": last}])
            edges = found["result"]
            print(f"bisect: {edges['runs']} MPM runs, plateau {edges['lower']['on']} ... {edges['upper']['on']} s, "
                  f"runout {edges['largest_runout']:.2f} m at {edges['largest_at']} s", flush=True)
            # Every snapshot, by a second trigger on an equal FEM with as many seeds as snapshots.
            count = edges["uniform_runs"]
            [_], all_rows = run_study(url, [{"kind": "bisect", "share": share, "tolerance_s": tolerance, "from": first,
                                             "to": last, "seeds": min(100, count)}])
            uniform = plateau(all_rows)
            print(f"uniform sweep: {len(all_rows)} MPM runs, plateau {uniform[0]} ... {uniform[1]} s")
            for row in all_rows:
                print(f"  {row['transfer_time']:.3f} s  {row['runout']} m")
            same = abs(uniform[0] - edges["lower"]["on"]) < 1e-6 and abs(uniform[1] - edges["upper"]["on"]) < 1e-6
            print("same edges" if same else "DIFFERENT EDGES")
            return 0 if same and live["state"] == "fired" and edges["runs"] < len(all_rows) == count else 1
        finally:
            service.terminate()
            service.wait()


if __name__ == "__main__":
    sys.exit(main())
