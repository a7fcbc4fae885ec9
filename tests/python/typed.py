"""python3-breachline passes mypy's strict checks, and the wheels' rule that typed packages say so."""
import os
import pathlib
import subprocess
import sys
import tempfile

package = pathlib.Path(os.environ["BREACH_ROOT"]) / "services/python/breachline"
if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True).returncode != 0:
    print("skipped: no mypy")
    sys.exit(77)
assert (package / "py.typed").is_file()
with tempfile.TemporaryDirectory() as cache:
    done = subprocess.run([sys.executable, "-m", "mypy", "--strict", "--cache-dir", cache, str(package)], text=True, capture_output=True)
print(done.stdout, done.stderr)
sys.exit(done.returncode)
