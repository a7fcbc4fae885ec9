"""Mochikoshi with the sizes of its shipped studies, from gravity to motion: frictional equilibrium exists with the last cohesion of
the search, so that every mesh starts with equally good stresses."""
import pathlib
import sys
import tempfile

from phases import check, result, root, run

scene = root / "workflows/scenes/mochikoshi.json"
last_cohesion = 250.0  # [Pa]


def main():
    with tempfile.TemporaryDirectory() as name:
        for size in (None, 2.4):
            here = pathlib.Path(name) / str(size)
            sized = [] if size is None else ["--set", f"/section/element_size={size}"]
            done = run("fem_solver", scene, here, "--set", "/fem/stages/2/duration=0.02", *sized)
            check(f"elements of {size or 'the shipped size'}: it moves", done.returncode == 0, done.stderr[-500:])
            friction = result(here)["geostatic"]["plastic gravity"]["friction"]
            check("friction alone rests", friction["converged"] and abs(friction["cohesion"] - last_cohesion) < 1e-6, friction)


sys.exit(main())
