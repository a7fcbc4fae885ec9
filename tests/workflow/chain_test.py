"""From scene to runout by the three phases as a user would call them; every file opens in VTK's own reader and holds
what the phases say it holds."""
import pathlib
import tempfile

import h5py
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

from phases import check, coarse_column, result, root, run

scene = root / "workflows/scenes/column.json"
times = [0.15, 0.3, 0.6]
weight = 1800 * 200  # kg per metre


def open_in_vtk(file):
    reader = vtk.vtkHDFReader()
    check(f"VTK can read {file.name}", reader.CanReadFile(str(file)) == 1)
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def arrays(attributes):
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i))
            for i in range(attributes.GetNumberOfArrays())}


def main(folder):
    done = run("fem_solver", scene, folder / "fem", *coarse_column, "--set", f"/fem/snapshot_times={times}")
    check("fem_solver ends well", done.returncode == 0, done.stderr[-2000:])
    for t in times:
        snapshot = folder / f"fem/snapshot_{t:.6f}.vtkhdf"
        grid = open_in_vtk(snapshot)
        check("the mesh has 5 x 10 quads", grid.GetNumberOfCells() == 50 and grid.GetNumberOfPoints() == 66)

        done = run("transfer_tool", scene, folder / f"transfer_{t}", *coarse_column, "--input", snapshot)
        check(f"transfer_tool ends well at t = {t}", done.returncode == 0, done.stderr[-2000:])
        particles = folder / f"transfer_{t}/particles.vtkhdf"
        cloud = open_in_vtk(particles)
        check("four points per element", cloud.GetNumberOfPoints() == 200)
        mass = arrays(cloud.GetPointData())["mass"].sum()
        check(f"mass conserved to 1e-12: {mass / weight - 1:.1e}", abs(mass / weight - 1) < 1e-12)

    done = run("mpm_solver", scene, folder / "mpm", *coarse_column, "--input", particles)
    check("mpm_solver ends well", done.returncode == 0, done.stderr[-2000:])
    final = open_in_vtk(folder / "mpm/final.vtkhdf")
    points = vtk_to_numpy(final.GetPoints().GetData())
    mass_p = arrays(final.GetPointData())["mass"]
    check("no mass is lost in the runout", abs(mass_p.sum() / weight - 1) < 1e-12)
    # the runout by its definition, from the file alone: mass-weighted 99th percentile of x beyond the toe at x = 10 m
    order = numpy.argsort(points[:, 0])
    share = numpy.cumsum(mass_p[order]) / mass_p.sum()
    runout = points[order, 0][numpy.searchsorted(share, 0.99)] - 10
    stated = result(folder / "mpm")["runout"]
    check(f"runout from the file {runout:.3f} m is the stated one {stated:.3f} m", abs(runout - stated) < 0.25)
    check("the column has run out", stated > 5)

    with h5py.File(folder / "mpm/final.vtkhdf") as file:
        check("VTKHDF version 1.0 with our group beside it",
              list(file["VTKHDF"].attrs["Version"]) == [1, 0] and "breachline" in file)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
