"""fem_solver killed by SIGKILL in the middle of shaking wet PM4Sand, and resumed: every dataset of history and last
snapshot, and every line of telemetry, equal to those of an undisturbed run. So with another number of threads."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import coarse_slope
import runs

SOLVER = f"{os.environ['BREACH_BIN']}/fem_solver"
END = 2.0


def command(scene, output, *more):
    return [SOLVER, str(scene), "--output", str(output), "--progress", "none", *more]


def run(scene, output, *more):
    subprocess.run(command(scene, output, *more), stderr=subprocess.DEVNULL, check=True)


def lines_of(output):
    file = output / "telemetry.jsonl"
    return file.read_bytes().count(b"\n") if file.exists() else 0


def kill_after_checkpoint(scene, output):
    """Kills some steps after the checkpoint, so that work is lost. Returns the telemetry lines at the checkpoint and at the end."""
    process = subprocess.Popen(command(scene, output), stderr=subprocess.DEVNULL)
    while not (output / "checkpoint.h5").exists() and process.poll() is None:
        time.sleep(0.002)
    at_checkpoint = lines_of(output)
    while lines_of(output) < at_checkpoint + 10 and process.poll() is None:
        time.sleep(0.002)
    process.send_signal(signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL, "the run ended before it was killed"
    return at_checkpoint, lines_of(output)


def compare(what, one, two):
    """Datasets that differ."""
    print(f"    {what}:")
    return runs.differences(one, two, ("history.h5", f"snapshot_{END:.6f}.vtkhdf"))


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene = coarse_slope.write(folder, duration=END, telemetry_interval=0.0, snapshot_times=[0.8])
        whole, killed, threads = (folder / each for each in ("whole", "killed", "threads"))
        run(scene, whole)
        first, last = kill_after_checkpoint(scene, killed)
        assert not (killed / "result.json").exists()
        with h5py.File(killed / "checkpoint.h5") as file:
            spent = float(np.squeeze(file["breachline/provenance"].attrs["cpu_seconds"]))
        run(scene, killed, "--resume")
        said = json.loads((killed / "result.json").read_text())["cpu_seconds"]
        print(f"    {said:.2f} CPU s, of which {spent:.2f} until the checkpoint")
        assert said > spent + 0.05, "seconds of both processes"
        print(f"    killed with {last} lines of telemetry, {first} when its checkpoint appeared, {lines_of(whole)} in all")
        assert first < last < lines_of(whole)
        wrong = compare("killed and resumed", whole, killed)
        run(scene, threads, "--threads", "3")
        wrong += compare("--threads 3", whole, threads)
    return 1 if wrong else 0


sys.exit(main())
