"""Running the phase executables in tests."""
import json
import os
import pathlib
import subprocess

root = pathlib.Path(os.environ["BREACH_ROOT"])
programs = pathlib.Path(os.environ["BREACH_BIN"])

# The column at a quarter of its resolution: seconds instead of half a minute.
coarse_column = ["--set", "/section/regions/0/mesh/divisions=[5,10]", "--set", "/mpm/cell_size=2",
                 "--set", "/mpm/duration=8"]

# Mochikoshi at a quarter of its resolution, as in mochikoshi_quarter.json.
quarter = json.loads((root / "workflows/studies/mochikoshi_quarter.json").read_text())["overrides"]


def run(phase, scene, output, *arguments):
    return subprocess.run([str(programs / phase), str(scene), "--output", str(output), *map(str, arguments)],
                          capture_output=True, text=True, timeout=240)


def result(folder):
    return json.loads((folder / "result.json").read_text())


def check(what, condition, detail=""):
    assert condition, f"{what}: {detail}"
    print(f"ok: {what}")
