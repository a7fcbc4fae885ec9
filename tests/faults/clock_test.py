"""The clock of the day is set back and forth by an hour while tasks run, fail and are tried again: nothing is lost, nothing
comes through twice, no wait lasts an hour, durations are of the monotonic clock, and lists and events keep their order.

Needs Debian's faketime (else skipped). The clock's file says how far it is off; times of files stay the true ones, as on a
file server that has a clock of its own.
"""
import collections
import itertools
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

from service import Service, programs, root, study, until

library = next(pathlib.Path("/usr/lib").glob("*/faketime/libfaketimeMT.so.1"), None)
on_slurm = ("--executor", "slurm", "--slurm-poll", "0.2", "--slurm-grace", "2", "--slurm-command-limit", "20")
attempts_wanted = {"mpm_steps=15": 1, "crash=1 mpm_steps=5": 2}  # of the MPM, by the scene's title


class Clock:
    """Sets the clock to another hour repeatedly: now and then, and in a rush, also between two readings."""

    def __init__(self, folder):
        self.file, self.stop = folder / "clock", threading.Event()
        self.set("+0")
        self.thread = threading.Thread(target=self.swing)

    def set(self, offset):
        draft = self.file.with_suffix(".new")
        draft.write_text(offset + "\n")
        draft.rename(self.file)

    def swing(self):
        for rest in itertools.cycle([0.4] * 2 + [0.005] * 80):
            for offset in ("+1h", "-1h"):
                if self.stop.wait(rest):
                    return
                self.set(offset)

    def __enter__(self):
        self.thread.start()
        return self

    def __exit__(self, *_):
        self.stop.set()
        self.thread.join()

    def environment(self):
        return {"LD_PRELOAD": str(library), "FAKETIME_TIMESTAMP_FILE": str(self.file), "FAKETIME_NO_CACHE": "1",
                "FAKETIME_DONT_FAKE_MONOTONIC": "1", "DONT_FAKE_MONOTONIC": "1", "NO_FAKE_STAT": "1",
                "ASAN_OPTIONS": os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0"}  # wants to be loaded first


def the_clock_is_off(service, clock):
    """Checks that the clock is off; otherwise nothing is tested."""
    seen = set()
    for offset in ("+1h", "-1h"):
        clock.set(offset)
        run = service.submit(study([0.5], "fem_steps=1 mpm_steps=1"))
        seen.add(service.ask(f"/v1/runs/{run}")[2]["created"][:13])
    assert len(seen) == 2, seen


def expect_whole(service, run, title):
    end = service.wait_for_end(run, 120)
    assert end["state"] == "succeeded", (title, end["state"], end["message"])
    for task in end["tasks"]:
        wanted = attempts_wanted.get(title, 1) if task["phase"] == "mpm_solver" else 1
        # A lost one was claimed when the service was killed, and never started.
        began = [each for each in task["attempts"] if each["state"] != "lost"]
        assert len(began) == wanted, (title, task["label"], task["attempts"])
        for attempt in began:
            if attempt["wall_seconds"] is not None:
                assert 0 <= attempt["wall_seconds"] < 1800, attempt


def expect_order(service, runs):
    listed, cursor = [], ""
    while cursor is not None:
        page = service.ask("/v1/runs?limit=2" + (f"&cursor={cursor}" if cursor else ""))[2]
        listed += [each["id"] for each in page["runs"]]
        cursor = page["next"]
    assert sorted(listed) == sorted(runs), "each run once in the pages"
    events, after = [], 0
    while batch := service.ask(f"/v1/events?after={after}")[2]["events"]:
        events += batch
        after = batch[-1]["seq"]
    numbers = [each["seq"] for each in events]
    assert numbers == sorted(set(numbers))
    moved = collections.defaultdict(lambda: None)  # each transition starts at the end of the one before
    for each in events:
        detail = each["detail"]
        if each["kind"] == "task":
            assert moved[each["task"]] in (None, detail["from"]), each
            moved[each["task"]] = detail["to"]


def expect_no_hour_of_waiting(metrics):
    values = dict(line.rsplit(" ", 1) for line in metrics.splitlines() if line[:1] != "#")
    name = "breachline_queue_wait_seconds"
    assert 0 < float(values[f"{name}_count"]), metrics
    assert values[f'{name}_bucket{{le="600"}}'] == values[f"{name}_count"], metrics


def fake_slurm(folder):
    """Commands and nodes of the fake Slurm have the true clock: Python cannot sleep under libfaketime 0.9.10."""
    (folder / "commands").mkdir()
    for name in ("sbatch", "squeue", "scancel"):
        command = folder / "commands" / name
        command.write_text(f'#!/bin/sh\nunset LD_PRELOAD\nexec {root}/tests/slurm/fake/{name} "$@"\n')
        command.chmod(0o755)
    return {"PATH": f"{folder}/commands:{os.environ['PATH']}", "FAKE_SLURM": str(folder / "slurm")}


def swings(folder, *arguments):
    clock = Clock(folder)
    before = dict(os.environ)
    os.environ.update({**fake_slurm(folder), **clock.environment()})
    try:
        with Service(folder, "--slots", "3", *arguments) as service:
            the_clock_is_off(service, clock)
            first = [each["id"] for each in service.ask("/v1/runs")[2]["runs"]]
            runs = {}
            with clock:
                for title in [*attempts_wanted] * 2:
                    runs[service.submit(study([0.5, 1.0], title))] = title
                time.sleep(1)
                service.end(signal.SIGKILL)
            with Service(folder, "--slots", "3", *arguments) as again:
                with Clock(folder):
                    for run, title in runs.items():
                        expect_whole(again, run, title)
                    for run in first:
                        expect_whole(again, run, "")
                    expect_order(again, [*first, *runs])
                last = again.submit(study([0.5], "last"))  # some wait while the clock is stable, and are counted
                expect_whole(again, last, "last")
                metrics = again.ask("/metrics")[2].decode()
                assert not [line for line in metrics.splitlines() if line[:1] != "#" and " -" in line], metrics
                expect_no_hour_of_waiting(metrics)
    finally:
        os.environ.clear()
        os.environ.update(before)
    came_through = collections.Counter((folder / "ledger").read_text().split())
    assert set(came_through.values()) == {1}, came_through.most_common(3)
    checked = subprocess.run([programs / "breachline", "check", "--data", folder / "data"], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr
    print(f"{len(first) + len(runs)} runs, {len(came_through)} results, each once:", *(arguments[:2] or ["local pool"]))


def retry_does_not_wait_for_the_old_hour(folder):
    """A retry is due at a time of day; the clock is set back by two hours before that, and stays."""
    clock = Clock(folder)
    clock.set("+1h")
    before = dict(os.environ)
    os.environ.update(clock.environment())
    try:
        with Service(folder, "--retry-delay", "3") as service:
            run = service.submit(study([0.5], "crash=1 mpm_steps=5"))
            until(lambda: "retry_wait" in [task["state"] for task in service.ask(f"/v1/runs/{run}")[2]["tasks"]])
            clock.set("-1h")
            expect_whole(service, run, "crash=1 mpm_steps=5")
    finally:
        os.environ.clear()
        os.environ.update(before)
    print("a retry is not put off by a clock that is set back")


def main():
    if library is None:
        print("skipped: no libfaketime here (Debian's package faketime)")
        return 77
    for arguments in ((), on_slurm):
        with tempfile.TemporaryDirectory() as name:
            swings(pathlib.Path(name), *arguments)
    with tempfile.TemporaryDirectory() as name:
        retry_does_not_wait_for_the_old_hour(pathlib.Path(name))
    return 0


sys.exit(main())
