"""deploy/slurm/start-one-machine gives a Slurm in which an array runs to its end, never more tasks at once than its
throttle allows, a running job can be cancelled, and stop-one-machine leaves no process behind."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

deploy = pathlib.Path(os.environ["BREACH_ROOT"]) / "deploy/slurm"
tasks, throttle = 6, 2


def call(*command, **options):
    return subprocess.run(command, text=True, capture_output=True, timeout=60, **options)


def processes_of(folder):
    found = []
    for cmdline in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            text = cmdline.read_bytes().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if text.startswith(("munged", "slurm")) and str(folder) in text:
            found.append(f"{cmdline.parent.name}: {text}")
    return found


def submit(environment, script, *options):
    done = call("sbatch", "--parsable", "--no-requeue", *options, input=script, env=environment)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def jobs(environment, job):
    listed = json.loads(call("squeue", "--json", env=environment).stdout)["jobs"]
    return [each for each in listed if str(job) in (str(each["job_id"]), str(each["array_job_id"]))]


def wait_until(question, seconds, what):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if question():
            return
        time.sleep(0.1)
    raise AssertionError(f"not within {seconds} s: {what}")


def array_keeps_its_throttle(folder, environment):
    script = f"""#!/bin/bash
date +%s.%N >{folder}/began_$SLURM_ARRAY_TASK_ID
sleep 0.3
date +%s.%N >{folder}/ended_$SLURM_ARRAY_TASK_ID
exit $(( SLURM_ARRAY_TASK_ID == 3 ? 70 : 0 ))
"""
    job = submit(environment, script, f"--array=1-{tasks}%{throttle}", "--output=/dev/null")
    ended = ("COMPLETED", "FAILED")
    wait_until(lambda: sum(each["job_state"] in ended for each in jobs(environment, job)) == tasks, 60,
               "the array is done")
    codes = {int(each["array_task_id"]): each["exit_code"] for each in jobs(environment, job)}
    assert codes == {i: 70 << 8 if i == 3 else 0 for i in range(1, tasks + 1)}, codes
    marks = [(float((folder / f"{mark}_{i}").read_text()), step)
             for i in range(1, tasks + 1) for mark, step in (("began", 1), ("ended", -1))]
    at_once = most = 0
    for _, step in sorted(marks):
        at_once += step
        most = max(most, at_once)
    print(f"array of {tasks}%{throttle}: all ended, at most {most} at once, exit code 70 reported as 70")
    assert most <= throttle


def cancel_ends_a_job(folder, environment):
    script = f"#!/bin/bash\necho $$ >{folder}/pid\nexec sleep 300\n"
    job = submit(environment, script, "--output=/dev/null")
    wait_until(lambda: (folder / "pid").exists() and (folder / "pid").read_text().strip(), 20, "the job runs")
    pid = (folder / "pid").read_text().strip()
    assert call("scancel", job, env=environment).returncode == 0
    wait_until(lambda: not pathlib.Path("/proc", pid).exists(), 20, "the job's process is gone")
    wait_until(lambda: jobs(environment, job)[0]["job_state"] == "CANCELLED", 20, "the job reads CANCELLED")
    print("scancel: process gone, job reads CANCELLED")


def main():
    with tempfile.TemporaryDirectory(prefix="slurm-", dir="/tmp") as name:
        folder = pathlib.Path(name)
        folder.chmod(0o755)
        began = time.monotonic()
        started = call(deploy / "start-one-machine", name)
        if started.returncode == 77:
            print("skipped:", started.stderr.strip())
            return 77
        assert started.returncode == 0, started.stderr
        print(f"started in {time.monotonic() - began:.1f} s")
        try:
            assert started.stdout.strip() == f"export SLURM_CONF={name}/slurm.conf", started.stdout
            environment = {**os.environ, "SLURM_CONF": f"{name}/slurm.conf"}
            again = call(deploy / "start-one-machine", name)
            assert again.returncode == 1 and "runs there already" in again.stderr, again
            array_keeps_its_throttle(folder, environment)
            cancel_ends_a_job(folder, environment)
        finally:
            stopped = call(deploy / "stop-one-machine", name)
        assert stopped.returncode == 0, stopped.stderr
        assert not processes_of(name), processes_of(name)
        print(f"stopped, nothing left, after {time.monotonic() - began:.1f} s in all")
    return 0


if __name__ == "__main__":
    sys.exit(main())
