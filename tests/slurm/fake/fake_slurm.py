#!/usr/bin/python3
"""A Slurm for tests: sbatch, squeue and scancel (links to this file) over a folder, $FAKE_SLURM. Jobs run as processes.

Files in the folder make it misbehave for as long as they are there:
    down         no command reaches the controller
    hang         commands give no answer at all
    drained      no job starts
    refuse       sbatch refuses for good
    quota        number of jobs that may be in the queue; sbatch refuses what would be more
    lose_answer  sbatch takes the job but says that it timed out (once)
    drop         sbatch says that it timed out and takes nothing (once)
    forget       the controller loses its memory and gives its numbers again (once); what runs goes on
"""
import ctypes
import fcntl
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

folder = pathlib.Path(os.environ["FAKE_SLURM"])
jobs = folder / "jobs"


class Locked:
    """One command at a time."""

    def __enter__(self):
        jobs.mkdir(parents=True, exist_ok=True)
        self.file = open(folder / "lock", "w")
        fcntl.flock(self.file, fcntl.LOCK_EX)
        if take("forget"):
            for each in jobs.iterdir():
                each.unlink()

    def __exit__(self, *_):
        self.file.close()


def take(name):
    try:
        (folder / name).unlink()
        return True
    except FileNotFoundError:
        return False


def fail(what):
    print(what, file=sys.stderr)
    sys.exit(1)


def read(path):
    return json.loads(path.read_text())


def write(path, job):
    draft = path.with_suffix(".new")
    draft.write_text(json.dumps(job))
    draft.rename(path)


def all_jobs():
    return [read(each) for each in sorted(jobs.glob("*.json"))]


def options(words):
    found, rest = {}, []
    for word in words:
        if word.startswith("--"):
            name, _, value = word[2:].partition("=")
            found[name] = value
        else:
            rest.append(word)
    return found, rest


def sbatch(words):
    wanted, _ = options(words)
    script = sys.stdin.read()
    with (folder / "asked").open("a") as asked:
        asked.write(json.dumps(wanted) + "\n")
    if (folder / "refuse").exists():
        fail("sbatch: error: Batch job submission failed: Invalid account or account/partition combination specified")
    if take("drop"):
        fail("sbatch: error: Batch job submission failed: Socket timed out on send/recv operation")
    with Locked():
        number = max([job["number"] for job in all_jobs()], default=0) + 1
        match = re.fullmatch(r"0-(\d+)(?:%(\d+))?", wanted.get("array", ""))
        indices = range(int(match[1]) + 1) if match else [None]
        if (folder / "quota").exists():
            queued = sum(job["state"] in ("PENDING", "RUNNING") for job in all_jobs())
            if queued + len(indices) > int((folder / "quota").read_text()):
                fail("sbatch: error: QOSMaxSubmitJobPerUserLimit\n"
                     "sbatch: error: Batch job submission failed: Job violates accounting/QOS policy "
                     "(job submit limit, user's size and/or time limits)")
        throttle = int(match[2]) if match and match[2] else 0
        for index in indices:
            path = jobs / f"{number:06}_{index or 0:04}.json"
            start_runner(path, {"number": number, "index": index, "name": wanted["job-name"]}, script, throttle)
            while not path.exists():
                time.sleep(0.002)
    if take("lose_answer"):
        fail("sbatch: error: Batch job submission failed: Socket timed out on send/recv operation")
    print(number)


def start_runner(path, job, script, throttle):
    """A process that outlives the command, as slurmd would. It makes the job itself: a command that is killed on its way
    leaves no job without a runner."""
    if os.fork():
        return
    os.setsid()
    nothing = os.open(os.devnull, os.O_RDWR)
    for descriptor in range(3):
        os.dup2(nothing, descriptor)
    os.closerange(3, 256)
    lives = open(folder / "runners", "a+")  # locked while a runner lives, which writes to the folder
    fcntl.lockf(lives, fcntl.LOCK_SH)
    write(path, {**job, "state": "PENDING", "pid": 0})
    ctypes.CDLL(None).prctl(36, 1)  # PR_SET_CHILD_SUBREAPER
    try:
        run(path, job["number"], job["index"], script, throttle)
    finally:
        os._exit(0)


def end_what_is_left():
    """A job ends with everything that it started, as slurmstepd sees to it: orphans have become our children."""
    children = pathlib.Path(f"/proc/self/task/{os.getpid()}/children")
    while left := children.read_text().split():
        for each in left:
            os.kill(int(each), signal.SIGKILL)
        for _ in left:
            os.wait()


def may_start(path, number, throttle):
    if (folder / "drained").exists():
        return False
    running = sum(job["number"] == number and job["state"] == "RUNNING" for job in all_jobs())
    return throttle == 0 or running < throttle


def run(path, number, index, script, throttle):
    name = read(path)["name"]

    def ours():
        """A forgotten job is not ours any more, even if its number was reused."""
        return path.exists() and read(path)["name"] == name

    while True:
        with Locked():
            if not ours() or read(path)["state"] != "PENDING":
                return
            if may_start(path, number, throttle):
                environment = {**os.environ, **({} if index is None else {"SLURM_ARRAY_TASK_ID": str(index)})}
                process = subprocess.Popen(["/bin/sh"], stdin=subprocess.PIPE, env=environment, start_new_session=True)
                write(path, {**read(path), "state": "RUNNING", "pid": process.pid})
                break
        time.sleep(0.05)
    process.stdin.write(script.encode())
    process.stdin.close()
    code = process.wait()
    end_what_is_left()
    with Locked():
        if ours() and read(path)["state"] == "RUNNING":
            write(path, {**read(path), "state": "COMPLETED" if code == 0 else "FAILED"})


def squeue(words):
    wanted, _ = options(words)
    assert wanted["format"] == "%F %K %T %j %r" and wanted["states"] == "all" and "array" in wanted, wanted
    with Locked():
        for job in all_jobs():
            print(job["number"], "N/A" if job["index"] is None else job["index"], job["state"], job["name"],
                  "Resources" if job["state"] == "PENDING" else "None")


def scancel(words):
    wanted, rest = options(words)
    number, _, index = rest[0].partition("_")
    with Locked():
        for path in jobs.glob(f"{int(number):06}_{int(index or 0):04}.json"):
            job = read(path)
            if job["name"] != wanted["name"] or job["state"] not in ("PENDING", "RUNNING"):
                continue
            if job["pid"]:
                os.killpg(job["pid"], signal.SIGTERM)
            write(path, {**job, "state": "CANCELLED"})


def main():
    folder.mkdir(parents=True, exist_ok=True)
    if (folder / "hang").exists():
        time.sleep(600)
    if (folder / "down").exists():
        fail("slurm_load_jobs error: Unable to contact slurm controller (connect failure)")
    command = pathlib.Path(sys.argv[0]).name
    {"sbatch": sbatch, "squeue": squeue, "scancel": scancel}[command](sys.argv[1:])


main()
