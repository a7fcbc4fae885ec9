"""Runs a command with a real Slurm on this machine: with_slurm.py COMMAND... (SLURM_CONF and BREACH_REAL_SLURM are set).
Ends with the command's exit code; with 77 when Slurm is not installed."""
import os
import pathlib
import subprocess
import sys
import tempfile

deploy = pathlib.Path(os.environ["BREACH_ROOT"]) / "deploy/slurm"


def main(command):
    with tempfile.TemporaryDirectory(prefix="slurm-", dir="/tmp") as name:
        pathlib.Path(name).chmod(0o755)
        started = subprocess.run([deploy / "start-one-machine", name, "--cpus", "4"], text=True, capture_output=True)
        if started.returncode == 77:
            print("skipped:", started.stderr.strip())
            return 77
        if started.returncode != 0:
            print(started.stderr)
            return 1
        environment = {**os.environ, "SLURM_CONF": f"{name}/slurm.conf", "BREACH_REAL_SLURM": "1"}
        try:
            return subprocess.run(command, env=environment).returncode
        finally:
            subprocess.run([deploy / "stop-one-machine", name])


sys.exit(main(sys.argv[1:]))
