"""largest_step_error bounds the answer's error: an elastic column shaken by a pulse, the step left to the dial. The error
of one step goes with dt^3 and that of the answer with dt^2, so the answer's error should follow dial^(2/3)."""
import json
import math
import os
import pathlib
import sys
import tempfile

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from opensees_models import block, write_motion
from runs import judge, run

DIALS = (1e-4, 1e-5, 1e-6, 1e-7)
AMPLITUDE, LENGTH = 0.1, 2.5  # of the velocity [m/s], of the record [s]


def write(folder):
    def ricker(t):
        a = (2 * math.pi * (t - 0.6)) ** 2

        return AMPLITUDE * (1 - 2 * a) * math.exp(-a)
    write_motion(folder / "motion.csv", 1e-3, [ricker(1e-3 * k) for k in range(round(LENGTH * 1e3) + 1)])
    soil = {"density": 1900, "law": {"type": "linear_elastic", "E_MPa": 200, "nu": 0.3}}
    sides = [{"name": f"x{x}", "from": [x, 0], "to": [x, 20], "fixes": "y"} for x in (0, 1)]
    scene = {"format": "breachline-scene/1", "name": "step_error", "gravity": 0, "materials": {"soil": soil},
             "section": {"regions": [block("soil", "soil", [[0, 0], [1, 0], [1, 20], [0, 20]], [1, 20])]},
             "fem": {"element": "ssp", "supports": sides + [{"name": "base", "from": [0, 0], "to": [1, 0], "fixes": "xy"}],
                     "base": {"density": 2400, "V_s": 760}, "motion": {"file": "motion.csv"}, "crest": [0, 20],
                     "newmark_beta": 0.25, "newmark_gamma": 0.5, "force_tolerance": 1e-10, "telemetry_interval": 0,
                     "stages": [{"type": "dynamic", "name": "pulse", "laws": "elastic", "duration": LENGTH,
                                 "time_step": 0.1, "least_time_step": 1e-6}]}}
    (folder / "scene.json").write_text(json.dumps(scene))


def main():
    solver = f"{os.environ['BREACH_BIN']}/fem_solver"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        write(folder)

        def crest(output, **overrides):
            result, lines = run(solver, folder / "scene.json", folder / output, **overrides)
            return result, numpy.array([[line["time"], line["crest_dx"]] for line in lines])
        _, fine = crest("fine", fem__stages__0__time_step=2e-4)
        errors = []
        for dial in DIALS:
            result, history = crest(f"dial_{dial}", fem__largest_step_error=dial)
            errors.append(numpy.abs(history[:, 1] - numpy.interp(history[:, 0], fine[:, 0], fine[:, 1])).max())
            print(f"    largest_step_error {dial:.0e} m: {result['steps']:5d} steps, {result['cut_steps']:2d} cut, "
                  f"error of the crest {errors[-1]:.2e} m")
    powers = numpy.diff(numpy.log10(errors)) / numpy.diff(numpy.log10(DIALS))
    print(f"    powers of the dial: {', '.join(f'{power:.2f}' for power in powers)}")
    passed = judge("power of the dial over three decades against 2/3",
                   abs(math.log10(errors[0] / errors[-1]) / 3 - 2 / 3), 0.15)
    # Steps are halved and doubled, so a single decade may deviate.
    passed &= judge("2/3 less the least power of a decade", 2 / 3 - powers.min(), 0.35)
    return 0 if passed & judge("error with the finest dial, over the crest's travel", errors[-1] / 0.016, 2e-3) else 1


sys.exit(main())
