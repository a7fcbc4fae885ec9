"""What one service does with a hundred thousand tasks: sweeps of 5,000 transfer times each, of phases that return at once.

    scale.py [--tasks N] [--slots N] [--until SECONDS] [--data DIR] [-- further words for breachline serve]

Prints time, memory and database size of the submission, answers' times while all of it is queued, a restart after kill -9,
then the rate at which tasks come through, until all have or --until is over, and a restart at that point. On a Slurm of one
machine:

    with_slurm.py python3 scale.py --tasks 2000 -- --executor slurm --slots 400 --slurm-poll 2

The exit code says whether anything was lost or failed, never whether it was fast.
"""
import argparse
import json
import os
import pathlib
import signal
import statistics
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "faults"))
from service import Service, root  # noqa: E402

points = 5000


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tasks", type=int, default=100_000)
    parser.add_argument("--slots", default="4")
    parser.add_argument("--until", type=float, default=1e9, help="seconds of running, at most")
    parser.add_argument("--data", help="parent of the data folder")
    parser.add_argument("more", nargs="*", help="for breachline serve")
    return parser.parse_args()


def study(number, times):
    scene = json.loads((root / "workflows/scenes/column.json").read_text())
    scene["title"] = "fem_steps=1 mpm_steps=0"
    return {"format": "breachline-study/1", "name": f"sweep-{number}", "scene": scene, "stability": False, "reuse": False,
            "overrides": ["/fem/stages/1/duration=2"], "transfer_times": [round(0.0004 * i, 4) for i in range(1, times + 1)]}


class Watch:
    """CPU time [s] of the service, and of ended child processes."""

    def __init__(self, service):
        self.service = service
        self.spent = self.spent_below = 0.0

    def figures(self):
        process = pathlib.Path(f"/proc/{self.service.process.pid}")
        fields = process.joinpath("stat").read_text().rpartition(")")[2].split()
        tick = os.sysconf("SC_CLK_TCK")
        own, below = ((int(fields[i]) + int(fields[i + 1])) / tick for i in (11, 13))
        resident = next(int(line.split()[1]) for line in process.joinpath("status").read_text().splitlines()
                        if line.startswith("VmRSS"))
        answer = own - self.spent, below - self.spent_below, resident / 1024
        self.spent, self.spent_below = own, below
        return answer


def submit(service, wanted):
    status, _, body = service.ask("/v1/runs", wanted, timeout=600)
    assert status == 202, (status, body)
    return body["id"]


def database_megabytes(data):
    return sum(each.stat().st_size for each in data.glob("breachline.sqlite*")) / 1e6


def timed_answers(service, run):
    for what, path in {"list of 100 runs": "/v1/runs", "one run's page of 100 tasks": f"/v1/runs/{run}/tasks?limit=100",
                       "its 100 rows of results": f"/v1/runs/{run}/results?limit=100", "the metrics": "/metrics",
                       "all its rows of results": f"/v1/runs/{run}/results", "the whole run": f"/v1/runs/{run}"}.items():
        seconds = []
        for _ in range(5):
            began = time.perf_counter()
            status, _, _ = service.ask(path, timeout=600)
            seconds.append(time.perf_counter() - began)
            assert status == 200, (path, status)
        print(f"   {what:30} {1000 * statistics.median(seconds):8.1f} ms", flush=True)


def started(folder, chosen, why):
    began = time.perf_counter()
    service = Service(folder, "--slots", chosen.slots, *chosen.more)
    print(f"-- {why}: listening after {time.perf_counter() - began:.2f} s, load average {os.getloadavg()[0]:.1f}", flush=True)
    return service


def done_in(service, runs):
    bodies = [body for body in service.ask("/v1/runs?limit=500", timeout=600)[2]["runs"] if body["id"] in runs]
    return sum(body["tasks_done"] for body in bodies), all(body["finished"] for body in bodies), bodies


def watch_until_done(service, watch, runs, total, limit):
    began = last = time.monotonic()
    done = before = done_in(service, runs)[0]
    watch.figures()
    over = False
    print(f"   {'seconds':>8} {'done':>8} {'tasks/s':>8} {'own CPU':>8} {'below':>8} {'memory MB':>10} {'database MB':>11}")
    while not over and time.monotonic() - began < limit:
        time.sleep(min(30, max(2, limit / 10)))
        done, over, _ = done_in(service, runs)
        now = time.monotonic()
        own, below, memory = watch.figures()
        count = max(done - before, 1)
        print(f"   {now - began:8.0f} {done:8} {(done - before) / (now - last):8.1f} {1000 * own / count:5.1f} ms "
              f"{1000 * below / count:5.1f} ms {memory:10.0f} {database_megabytes(service.data):11.0f}", flush=True)
        before, last = done, now
    print(f"-- {done} of {total} tasks done", flush=True)
    return over


def main():
    chosen = options()
    faults = []
    with tempfile.TemporaryDirectory(prefix="breach-scale-", dir=chosen.data, ignore_cleanup_errors=True) as name:
        folder = pathlib.Path(name)
        (folder / "gate").touch()  # the first FEM waits, so all stays queued
        service = started(folder, chosen, "an empty service")
        watch = Watch(service)
        watch.figures()
        runs, left, began = [], chosen.tasks, time.perf_counter()
        while left > 1:
            times = min(points, left // 2)
            runs.append(submit(service, study(len(runs), times)))
            left -= 2 * times
        took = time.perf_counter() - began
        total = sum(body["tasks_total"] for body in done_in(service, runs)[2])
        own, _, memory = watch.figures()
        print(f"-- {total} tasks in {len(runs)} sweeps submitted in {took:.1f} s, {own:.1f} s of CPU; memory {memory:.0f} MB, "
              f"database {database_megabytes(service.data):.0f} MB", flush=True)
        timed_answers(service, runs[-1])
        print(f"   memory then {watch.figures()[2]:.0f} MB", flush=True)
        service.end(signal.SIGKILL)
        (folder / "gate").unlink()
        service = started(folder, chosen, "after kill -9 with all of it queued")
        over = watch_until_done(service, Watch(service), runs, total, chosen.until)
        timed_answers(service, runs[0])
        service.end(signal.SIGKILL)
        service = started(folder, chosen, "after kill -9 " + ("with all of it done" if over else "in the middle"))
        _, _, bodies = done_in(service, runs)
        faults += [f"{body['id']}: {body['state']} {body['message']}" for body in bodies if body["tasks_failed"]]
        faults += [f"{run}: lost" for run in runs if run not in {body["id"] for body in bodies}]
        for each in runs:
            service.ask(f"/v1/runs/{each}/cancel", b"")
        service.end(signal.SIGTERM)
        files = sum(len(names) for _, _, names in os.walk(folder / "data"))
        print(f"-- {files} files, database {database_megabytes(folder / 'data'):.0f} MB, {len(faults)} faults")
    for each in faults[:10]:
        print(each)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
