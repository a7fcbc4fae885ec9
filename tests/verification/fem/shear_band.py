"""A shear band in plane compression on four meshes: soil that softens over a nonlocal_length, with a weaker corner that starts the band.
Force over displacement and the band's width must not depend on the mesh."""
import json
import math
import os
import pathlib
import sys
import tempfile

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from opensees_models import block
from runs import datasets, judge, run

WIDTH, HEIGHT, WEAK = 1.0, 1.5, 0.125  # of the body and its weak corner [m]
LENGTH = 0.1                           # nonlocal_length [m]
END, STEPS = 0.06, 240                 # way of the platen [m]


def soil(c, length):
    law = {"type": "mohr_coulomb", "E_MPa": 50, "nu": 0.3, "c_kPa": c, "phi_deg": 0, "psi_deg": 0,
           "softening": {"epsilon_q_start": 0, "epsilon_q_end": 0.2, "c_residual_kPa": c / 2, "phi_residual_deg": 0}}
    return {"density": 2000, "law": law, **({"nonlocal_length": length} if length else {})}


def scene(elements, length, kind="bbar", steps=STEPS):
    n = round(WEAK * elements)
    across, up = elements - n, round(HEIGHT * elements) - n
    regions = [block("weak", "weak", [[0, 0], [WEAK, 0], [WEAK, WEAK], [0, WEAK]], [n, n]),
               block("beside", "soil", [[WEAK, 0], [WIDTH, 0], [WIDTH, WEAK], [WEAK, WEAK]], [across, n]),
               block("above", "soil", [[0, WEAK], [WIDTH, WEAK], [WIDTH, HEIGHT], [0, HEIGHT]], [elements, up])]
    drive = {"load_steps": steps, "displace": [{"name": "platen", "from": [0, HEIGHT], "to": [WIDTH, HEIGHT], "y": -END}]}
    return {"format": "breachline-scene/1", "name": "shear_band", "gravity": 0,
            "materials": {"soil": soil(50, length), "weak": soil(48, length)},
            "section": {"regions": regions},
            "fem": {"element": kind, "crest": [WIDTH, HEIGHT], "largest_iterations": 100,
                    "supports": [{"name": "left", "from": [0, 0], "to": [0, HEIGHT], "fixes": "x"},
                                 {"name": "base", "from": [0, 0], "to": [WIDTH, 0], "fixes": "y"}],
                    "stages": [{"type": "static", "name": "drive", "laws": "scene", **drive}]}}


def band(elements, length, kind, steps=STEPS):
    """Displacements [m], forces [kN/m], effective width [m], CPU seconds."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.json").write_text(json.dumps(scene(elements, length, kind, steps)))
        result, _ = run(f"{os.environ['BREACH_BIN']}/fem_solver", folder / "scene.json", folder / "out")
        shot = datasets(next((folder / "out").glob("*.vtkhdf")))
    path = result["geostatic"]["drive"]["displaced"]["platen"]
    k = next(shot[key] for key in shot if key.endswith("gauss/epsilon_q_plastic")).ravel()
    width = k.sum() ** 2 / (k ** 2).sum() / k.size * WIDTH * HEIGHT / (WIDTH * math.sqrt(2))
    return (numpy.array([END * step["load"] for step in path]), numpy.array([-step["force_y"] / 1e3 for step in path]), width,
            result["cpu_seconds"], result["cut_steps"], k.max())


if __name__ == "__main__":
    for kind in sys.argv[3].split(","):
        for n in map(int, sys.argv[1].split(",")):
            d, f, w, cpu, cut, most = band(n, float(sys.argv[2]), kind, int(sys.argv[4]))
            at = numpy.interp(numpy.array([0.004, 0.01, 0.02, 0.03, 0.04, 0.06]), d, f)
            print(kind, n, "peak %.2f" % f.max(), "F", " ".join("%.2f" % x for x in at), "width %.4f most %.3f cpu %.1f cut %d" % (w, most, cpu, cut), flush=True)
