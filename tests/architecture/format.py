"""Every C++ file is formatted as .clang-format says."""
import os
import pathlib
import shutil
import subprocess
import sys

root = pathlib.Path(os.environ["BREACH_ROOT"])

if not shutil.which("clang-format"):
    print("skipped: clang-format is not installed")
    sys.exit(77)
files = [str(f) for folder in ("core", "lem_tool", "fem_solver", "element_bench", "transfer_tool", "mpm_solver", "services", "tests")
         for f in sorted((root / folder).rglob("*.?pp"))]
done = subprocess.run(["clang-format", "--dry-run", "--Werror", *files], capture_output=True, text=True)
print(done.stderr or f"{len(files)} files are formatted")
sys.exit(done.returncode)
