"""fem_solver gives the same bits on one thread and on three: PM4Sand, water, free-field columns, viscosity, on enough elements
that a zone is cut into several ranges."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy

ROOT = pathlib.Path(os.environ["BREACH_ROOT"])
DURATION = 0.6  # s
SETTINGS = ["/section/element_size=2.4", "/fem/stages/2/time_step=0.005", f"/fem/stages/2/duration={DURATION}", "/materials/tailings/viscosity=1000",
            "/fem/motion/scale_to_pga_g=1"]


def arrays(file):
    found = {}
    with h5py.File(file) as opened:
        def note(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
                found[name] = item[()]
        opened.visititems(note)
    return found


def shaken(folder, threads):
    sets = [word for each in SETTINGS for word in ("--set", each)]
    command = [f"{os.environ['BREACH_BIN']}/fem_solver", str(ROOT / "workflows/scenes/mochikoshi.json"), "--output", str(folder),
               "--progress", "none", "--threads", str(threads), *sets]
    done = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise SystemExit(done.stderr.strip().splitlines()[-1])
    result = json.loads((folder / "result.json").read_text())
    return arrays(folder / f"snapshot_{DURATION:.6f}.vtkhdf"), (folder / "telemetry.jsonl").read_text(), result


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        one, lines_of_one, result = shaken(folder / "one", 1)
        three, lines_of_three, _ = shaken(folder / "three", 3)
    largest = max(numpy.abs(values).max() for key, values in one.items() if key.endswith("displacement"))
    print(f"    {result['elements']} elements, {result['steps']} steps, crest {result['crest']['displacement']:.4f} m, "
          f"viscosity took {result['viscous_dissipation']:.1f} J; {len(one)} arrays")
    differ = [key for key in one if not numpy.array_equal(one[key], three[key])]
    same = not differ and one.keys() == three.keys() and lines_of_one == lines_of_three
    print(f"    arrays that differ: {differ or 'none'}; telemetry {'the same' if lines_of_one == lines_of_three else 'differs'}")
    return 0 if same and largest > 0.0 and result["viscous_dissipation"] > 0.0 else 1


sys.exit(main())
