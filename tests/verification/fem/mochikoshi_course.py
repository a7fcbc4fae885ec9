"""The course of the calibrated Mochikoshi section after it liquefies, beside OpenSees' histories f24, x35 and y35 that were
kept back until ours had been run. Its law hardens spuriously under long increments, so later than
5 s ours moves more with the same elastic stabilisation; and with next to none (y35) both slide away.
Skipped where ../shared is not there."""
import csv
import os
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import opensees_models
from runs import judge, run

REFERENCE = pathlib.Path(os.environ["BREACH_SHARED"]) / "reference/opensees_mochikoshi"
END = 10.0  # s


def crest_of_opensees(name):
    with open(REFERENCE / f"{name}_history.csv") as rows:
        return {round(float(row["t"]), 2): float(row["crest_u"]) for row in csv.DictReader(rows)}


def crest_here(mesh, size, hourglass):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        opensees_models.mochikoshi(folder, REFERENCE, mesh, size, hourglass=hourglass, duration=END, telemetry_interval=0.05)
        result, lines = run(f"{os.environ['BREACH_BIN']}/fem_solver", folder / "scene.json", folder / "out")
    print(f"    {mesh}, {hourglass}: {result['cpu_seconds']:.1f} CPU s to {result['end_time']} s, {result['ended']}")
    return {round(line["time"], 2): line["crest_displacement"] for line in lines}


def printed(ours, theirs):
    for t in (2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0):
        print(f"    {t:4.1f} s  {ours[t]:7.3f} m here, {theirs[t]:7.3f} m in OpenSees" if t in ours and t in theirs else f"    {t:4.1f} s  -")


def elastic(name, mesh, size):
    ours, theirs = crest_here(mesh, size, "elastic"), crest_of_opensees(name)
    printed(ours, theirs)
    # The histories are of its scheme 4, whose crest lies 8 % under that of scheme 5 at 5 s on mesh24.
    before = max(abs(ours[t] / theirs[t] - 1.0) for t in (2.0, 3.0, 4.0, 5.0))
    passed = judge(f"{name}: crest to 5 s, relative", before, 0.15)
    passed &= judge(f"{name}: crest at 8 s, relative", abs(ours[8.0] / theirs[8.0] - 1.0), 0.25)
    return passed & judge(f"{name}: ours moves more at {END:g} s, OpenSees' over ours", theirs[END] / ours[END], 1.0)


def slides():
    ours, theirs = crest_here("mesh35", 3.5, "current"), crest_of_opensees("y35")
    printed(ours, theirs)
    before = max(abs(ours[t] / theirs[t] - 1.0) for t in (2.0, 3.0, 4.0, 5.0))
    passed = judge("y35: crest to 5 s, relative", before, 0.15)
    # Its hourglass stiffness stays at 5 % of the elastic one; ours follows the soil. Both run away.
    last = max(ours)
    speed = (ours[last] - ours[round(last - 1.0, 2)], theirs[END] - theirs[END - 1.0])
    print(f"    over the last second ours moves {speed[0]:.2f} m (to {last} s), OpenSees' {speed[1]:.2f} m (to {END} s)")
    return passed & judge("y35: 0.3 m/s over the speed of either at its end", 0.3 / min(speed), 1.0)


CASES = {"f24": lambda: elastic("f24", "mesh24", 2.4), "x35": lambda: elastic("x35", "mesh35", 3.5), "y35": slides}


def main():
    if not REFERENCE.exists():
        print(f"skipped: {REFERENCE} is not there")
        return 77
    return 0 if CASES[sys.argv[1]]() else 1


sys.exit(main())
