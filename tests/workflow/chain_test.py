"""From scene to runout by the three phases as a user would call them; every file opens in VTK's own reader and holds
what the phases say it holds."""
import json
import pathlib
import sys
import tempfile

import h5py
import numpy

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

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


def motion(folder):
    """Places of the points of each file that the folder's series names, and the times that it gives them."""
    files = json.loads((folder / "frames.vtkhdf.series").read_text())["files"]
    places = [vtk_to_numpy(open_in_vtk(folder / each["name"]).GetPoints().GetData()) for each in files]
    return [each["time"] for each in files], places


def arrays(attributes):
    return {attributes.GetArrayName(i): vtk_to_numpy(attributes.GetArray(i))
            for i in range(attributes.GetNumberOfArrays())}


def main(folder):
    done = run("fem_solver", scene, folder / "fem", *coarse_column, "--set", f"/fem/snapshot_times={times}")
    check("fem_solver ends well", done.returncode == 0, done.stderr[-2000:])
    at, places = motion(folder / "fem")
    check(f"the series of the snapshots holds the times that were asked for, {at}", set(times) <= set(at) and at == sorted(at))
    check("the mesh moves through its series", numpy.abs(places[-1] - places[0]).max() > 1e-4)
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
    at, places = motion(folder / "mpm")
    check("the series of the runout is one frame per second", at == [float(t) for t in range(9)][:len(at)] and len(at) > 3, at)
    check("the soil runs out through its series", (places[-1] - places[0])[:, 0].max() > 5)
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
