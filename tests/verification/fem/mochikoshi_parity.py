"""The calibrated Mochikoshi section on OpenSees' own mesh with its elastic stabilisation: crest and mean excess pore
pressure against OpenSees to 5 s. Skipped where ../shared is not there."""
import csv
import math
import os
import pathlib
import sys
import tempfile

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import opensees_models
from runs import judge, run

REFERENCE = pathlib.Path(os.environ["BREACH_SHARED"]) / "reference/opensees_mochikoshi"
MEAN_EXCESS = 43.4  # kPa at 5 s, the README of the reference, scheme 5


def mean_excess(file):
    with h5py.File(file) as snapshot:
        nodes = snapshot["VTKHDF/PointData"]
        p, p_0 = nodes["pore_pressure"][:] / 1e3, nodes["pore_pressure_0"][:] / 1e3
    return float(numpy.mean((p - p_0)[p_0 > 1.0]))


def main():
    if not REFERENCE.exists():
        print(f"skipped: {REFERENCE} is not there")
        return 77
    with open(REFERENCE / "s5_24_history.csv") as rows:
        theirs = {round(float(row["t"]), 2): row for row in csv.DictReader(rows)}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        opensees_models.mochikoshi(folder, REFERENCE, hourglass="elastic", snapshot_times=[5.0],
                                   telemetry_interval=0.05, force_tolerance=1e-5)
        result, lines = run(f"{os.environ['BREACH_BIN']}/fem_solver", folder / "scene.json", folder / "out")
        excess = mean_excess(folder / "out/snapshot_5.000000.vtkhdf")
    ours = {round(line["time"], 2): line for line in lines}
    largest, worst = 0.0, 0.0
    print("       t      crest here            OpenSees   [m]")
    for t in sorted(ours.keys() & theirs.keys()):
        u = (ours[t]["crest_dx"], ours[t]["crest_dy"])
        v = (float(theirs[t]["crest_ux"]), float(theirs[t]["crest_uy"]))
        largest = max(largest, math.hypot(*v))
        worst = max(worst, abs(math.hypot(*u) - math.hypot(*v)))
        if abs(t * 2 - round(t * 2)) < 1e-9:
            print(f"    {t:4.1f}  {u[0]:8.4f} {u[1]:8.4f}  {v[0]:8.4f} {v[1]:8.4f}")
    print(f"    {result['cpu_seconds']:.1f} CPU s, {result['steps']} steps, stress bias {result['stress_bias']}")
    print(f"    mean excess pressure over wet nodes at 5 s: {excess:.2f} kPa, OpenSees {MEAN_EXCESS}")
    passed = judge("crest displacement to 5 s, over its largest", worst / largest, 0.05)
    passed &= judge("mean excess pressure at 5 s", abs(excess / MEAN_EXCESS - 1.0), 0.05)
    return 0 if passed else 1


sys.exit(main())
