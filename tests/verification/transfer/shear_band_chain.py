"""A shear band of soil that softens over a nonlocal_length goes from the FEM through the transfer into the MPM: the soil is as soft after as
before, and softens on as in the FEM."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy

root, programs = pathlib.Path(os.environ["BREACH_ROOT"]), pathlib.Path(os.environ["BREACH_BIN"])
sys.path.insert(0, str(root / "tests/verification/fem"))
from runs import datasets, judge

STUDY = root / "workflows/accuracy/fem_softening.json"
TRANSFER, END = 0.4, 0.6     # times of the transfer and of the comparison [s]
BEGINS, ENDS = 0.01, 0.12    # epsilon_q of the study's softening
SLOPE = 1                    # number of its region
settings = [*json.loads(STUDY.read_text())["accuracy"]["base"], f"/fem/snapshot_times=[{TRANSFER}]", f"/fem/stages/1/duration={END}",
            f"/mpm/duration={END - TRANSFER}"]


def run(phase, folder, *arguments):
    command = [programs / phase, root / "workflows/scenes/slope.json", "--output", folder / phase, "--progress", "none", *arguments]
    for each in settings:
        command += ["--set", each]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    return folder / phase


def softened(epsilon_q, area):
    """Area of the slope, weighted by the share of its strength that is lost [m2]."""
    return float((numpy.clip((epsilon_q - BEGINS) / (ENDS - BEGINS), 0, 1) * area).sum())


def of_mesh(file):
    shot = datasets(file)
    x = shot["breachline/position_0"][shot["breachline/quads"]][..., :2]
    area = 0.5 * (x[..., 0] * numpy.roll(x[..., 1], -1, 1) - x[..., 1] * numpy.roll(x[..., 0], -1, 1)).sum(1)
    here = shot["VTKHDF/CellData/region"] == SLOPE
    epsilon_q = shot["breachline/gauss/epsilon_q_plastic"].reshape(len(area), -1)
    return softened(epsilon_q[here], area[here, None] / epsilon_q.shape[1])


def of_points(file):
    points = datasets(file)
    here = points["VTKHDF/PointData/region"] == SLOPE
    return softened(points["VTKHDF/PointData/epsilon_q_plastic"][here], points["VTKHDF/PointData/volume"][here])


def main(folder):
    fem = run("fem_solver", folder)
    points = run("transfer_tool", folder, "--input", fem / f"snapshot_{TRANSFER:.6f}.vtkhdf") / "particles.vtkhdf"
    final = run("mpm_solver", folder, "--input", points) / "final.vtkhdf"
    before, on = of_mesh(fem / f"snapshot_{TRANSFER:.6f}.vtkhdf"), of_mesh(fem / f"snapshot_{END:.6f}.vtkhdf")
    after, end = of_points(points), of_points(final)
    print(f"    softened area: FEM {before:.3f} m2, points {after:.3f} m2; {END - TRANSFER:.1f} s later FEM {on:.2f} m2, MPM {end:.2f} m2")
    passed = judge("softened area of the points against the mesh", abs(after / before - 1), 0.005)
    passed &= judge("its growth has begun: area before over that after", before / on, 0.6)
    # Its bands are 2.5 lengths wide and not 2.7, and its cells and stiffness are others.
    return 0 if passed & judge("softened area at the end, MPM against FEM", abs(end / on - 1), 0.15) else 1


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        sys.exit(main(pathlib.Path(name)))
