"""python3-breachline and the report pass mypy's strict checks; and the wheels' rule that typed packages say so."""
import os
import pathlib
import subprocess
import sys
import tempfile

services = pathlib.Path(os.environ["BREACH_ROOT"]) / "services"
if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True).returncode != 0:
    print("skipped: no mypy")
    sys.exit(77)
assert (services / "python/breachline/py.typed").is_file()
with tempfile.TemporaryDirectory() as cache:
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, "python/breachline", "report/breachline_report"],
                          cwd=services, env={**os.environ, "MYPYPATH": "python:report"}, text=True, capture_output=True)
print(done.stdout, done.stderr)
sys.exit(done.returncode)
