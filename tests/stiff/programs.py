"""The phase programs on scenes of the catalogue of `breach verify`."""
import json
import os
import pathlib
import subprocess
import tempfile

root = pathlib.Path(os.environ.get("BREACH_ROOT", pathlib.Path(__file__).resolve().parents[2]))
programs = pathlib.Path(os.environ.get("BREACH_BIN", root / "build/release/bin"))
longest = 120  # longest run [s], with a large margin


def scene_of(name):
    return json.loads((root / f"workflows/verification/catalogue/stiff/{name}.json").read_text())


def run(program, scene, output, *arguments):
    file = output.with_suffix(".json")
    file.write_text(json.dumps(scene))
    return subprocess.run([programs / program, file, "--output", output, "--progress", "none", *arguments],
                          capture_output=True, text=True, timeout=longest)


def done_well(program, scene, output, *arguments):
    """The result of a run that must succeed."""
    done = run(program, scene, output, *arguments)
    assert done.returncode == 0, f"{program} ended with {done.returncode}: {done.stderr[-600:]}"
    return json.loads((output / "result.json").read_text())


def refused(done, *words, exit=65):
    assert done.returncode == exit and all(word in done.stderr for word in words), \
        f"exit {done.returncode}, {words} wanted: {done.stderr[-600:]}"


def last_snapshot(folder):
    return sorted(folder.glob("snapshot_*.vtkhdf"))[-1]


def run_tests(tests):
    for test in tests:
        with tempfile.TemporaryDirectory() as folder:
            test(pathlib.Path(folder))
        print(f"ok {test.__name__}", flush=True)
