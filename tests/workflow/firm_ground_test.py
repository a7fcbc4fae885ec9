"""After a transfer too, firm ground does not hold back the sliding soil: nine points per cell run as far as four, whose domains end at
the ground's top automatically, and runs with cells that share the top are warned."""
import json
import pathlib
import tempfile

from phases import check, result, root, run

SLOPE = root / "workflows/scenes/slope.json"
# Weak soil without softening, in the terms of the accuracy study: no band depends on the cells.
STUDY = json.loads((root / "workflows/accuracy/slope_flow.json").read_text())
WEAK = [word for each in STUDY["accuracy"]["base"] if each.startswith("/materials/") for word in ("--set", each)]
MOMENT = 0.8  # s


def runout(folder, snapshot, points, shift):
    name = f"{points}_{shift[0]}"
    cells = [*WEAK, "--set", "/mpm/cell_size=1.25", "--set", f"/transfer/points_per_cell={points}", "--set", f"/transfer/point_shift={shift}"]
    moved = run("transfer_tool", SLOPE, folder / f"points_{name}", "--input", snapshot, *cells)
    assert moved.returncode == 0, moved.stderr
    ended = run("mpm_solver", SLOPE, folder / f"flow_{name}", "--input", folder / f"points_{name}" / "particles.vtkhdf", *cells)
    assert ended.returncode == 0, ended.stderr
    return result(folder / f"flow_{name}")["runout_beyond_toe"]


def main(folder):
    shaken = run("fem_solver", SLOPE, folder / "fem", *WEAK, "--set", f"/fem/snapshot_times=[{MOMENT}]")
    assert shaken.returncode == 0, shaken.stderr
    snapshot = folder / "fem" / f"snapshot_{MOMENT:.6f}.vtkhdf"
    four = runout(folder, snapshot, 4, [0, 0])
    for shift in ([0, 0], [0.3, 0.3], [0.6, 0.8]):
        nine = runout(folder, snapshot, 9, shift)
        check(f"nine points moved by {shift} run {nine:.1f} m, four {four:.1f} m", abs(nine / four - 1) < 0.15)

    plan = run("mpm_solver", SLOPE, folder / "plan", "--plan")
    check("the plan names the ground", "base_soil at 0 m" in plan.stdout + plan.stderr, plan.stdout + plan.stderr)
    shared = run("mpm_solver", SLOPE, folder / "shared", "--check", "--set", "/mpm/cell_size=0.8")
    said = shared.stdout + shared.stderr
    check("the plan names cells that fit under a top within a cell", "0.25 of a cell above a line" in said and "--set /mpm/cell_size=0.714285714 or --set /mpm/cell_size=0.833333333" in said, said)


with tempfile.TemporaryDirectory() as scratch:
    main(pathlib.Path(scratch))
