"""A slightly waisted layer is sheared between rough plates until a band forms at its waist. Soil that softens over a nonlocal_length has
the same band on four meshes: force over the plate's way, and width. Without a length the band follows the mesh."""
import json
import os
import pathlib
import sys
import tempfile

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from opensees_models import block
from runs import datasets, judge, run

WIDTH, HEIGHT, WAIST = 2.0, 8.0, 0.03     # of the layer; each side is narrower by the waist at half its height [m]
LENGTH = 0.5                              # nonlocal_length [m]
END, STEPS = 0.25, 250                    # way of the upper plate [m]
PEAK, RESIDUAL, STRAIN = 50.0, 25.0, 0.1  # c [kPa], epsilon_q from peak to residual
BAND = 2.7 * LENGTH                       # as band_in_nonlocal_lengths_of_fem in core/scene/scene.hpp [m]
WAYS = numpy.linspace(0.01, END, 25)      # at which forces are compared [m]


def soil(length):
    law = {"type": "mohr_coulomb", "E_MPa": 50, "nu": 0.3, "c_kPa": PEAK, "phi_deg": 0, "psi_deg": 0, "tension_cutoff_kPa": 500,
           "softening": {"epsilon_q_start": 0, "epsilon_q_end": STRAIN, "c_residual_kPa": RESIDUAL, "phi_residual_deg": 0}}
    return {"density": 2000, "law": law, **({"nonlocal_length": length} if length else {})}


def scene(rows, length, kind):
    """rows: elements per metre."""
    right = [[WIDTH, 0], [WIDTH - WAIST, HEIGHT / 2], [WIDTH, HEIGHT]]
    left = [[0, HEIGHT], [WAIST, HEIGHT / 2], [0, 0]]
    layer = block("layer", "soil", right + left, [round(WIDTH * rows), round(HEIGHT * rows)])
    layer["mesh"]["corners"] = [[0, 0], [WIDTH, 0], [WIDTH, HEIGHT], [0, HEIGHT]]
    plate = {"name": "plate", "from": [0, HEIGHT], "to": [WIDTH, HEIGHT], "x": END, "y": 0}
    sides = [{"name": f"side {k}", "from": side[0], "to": side[1], "fixes": "y"}
             for k, side in enumerate((right[:2], right[1:], left[:2], left[1:]))]
    base = {"name": "base", "from": [0, 0], "to": [WIDTH, 0], "fixes": "xy"}
    return {"format": "breachline-scene/1", "name": "shear_band", "gravity": 0, "materials": {"soil": soil(length)},
            "section": {"regions": [layer]},
            "fem": {"element": kind, "crest": [WIDTH, HEIGHT], "largest_iterations": 30, "force_tolerance": 1e-4, "supports": [base, *sides],
                    "stages": [{"type": "static", "name": "shear", "laws": "scene", "load_steps": STEPS, "displace": [plate]}]}}


def sheared(rows, length, kind):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.json").write_text(json.dumps(scene(rows, length, kind)))
        result, _ = run(f"{os.environ['BREACH_BIN']}/fem_solver", folder / "scene.json", folder / "out")
        shot = datasets(next((folder / "out").glob("*.vtkhdf")))
    path = result["geostatic"]["shear"]["displaced"]["plate"]
    way = numpy.array([END * step["load"] for step in path])
    force = numpy.array([step["force_x"] / 1e3 / WIDTH for step in path])
    k = next(shot[key] for key in shot if key.endswith("gauss/epsilon_q_plastic")).reshape(round(HEIGHT * rows), -1).mean(1)
    width = k.sum() / k.max() / rows
    print(f"    {kind}, {f'length {length} m' if length else 'no length'}, elements of {1 / rows:.3f} m: peak {force.max():.2f} kPa, "
          f"{numpy.interp(0.1, way, force):.2f} after 0.1 m, {force[-1]:.2f} at the end; band {width:.3f} m; {result['cpu_seconds']:.1f} CPU s")
    return numpy.interp(WAYS, way, force), width


def main():
    passed = True
    meshes = [sheared(rows, LENGTH, "bbar") for rows in (3, 4, 5, 6)]  # 1.5 to 3 elements per length
    finest = meshes[-1]
    for k, (force, width) in enumerate(meshes[:-1]):
        allowed = 0.03
        passed &= judge(f"mesh {k + 1}: force against the finest, of its peak", abs(force - finest[0]).max() / finest[0].max(), allowed)
        passed &= judge(f"mesh {k + 1}: width of the band against the finest", abs(width / finest[1] - 1), 0.1)
    passed &= judge("width of the finest against that of the scaling, 2.7 lengths", abs(finest[1] / BAND - 1), 0.05)
    single = sheared(4, LENGTH, "ssp")
    passed &= judge("single points: force against the finest, of its peak", abs(single[0] - finest[0]).max() / finest[0].max(), 0.03)
    local = [sheared(rows, None, "bbar") for rows in (2, 4)]
    return 0 if passed & judge("without a length: width on half the elements, over that before", local[1][1] / local[0][1], 0.6) else 1


if __name__ == "__main__":
    sys.exit(main())
