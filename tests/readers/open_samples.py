"""VTK's own vtkHDFReader (which ParaView uses) and h5py read our exchange files: same counts, same values."""
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import h5py
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOHDF import vtkHDFReader
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)


def read_with_vtk(path):
    reader = vtkHDFReader()
    assert reader.CanReadFile(str(path)), f"vtkHDFReader refuses {path}"
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def array(data, name):
    found = data.GetArray(name)
    assert found is not None, f"no array {name}"
    return vtk_to_numpy(found)


def check_mesh(path):
    grid = read_with_vtk(path)
    n = 5
    k = np.arange(2 * (n + 1))
    assert grid.GetNumberOfPoints() == 12 and grid.GetNumberOfCells() == n
    assert all(grid.GetCellType(i) == 9 for i in range(n)), "cells are quads"
    points = vtk_to_numpy(grid.GetPoints().GetData())
    displacement = np.column_stack([0.01 * k, -0.02 * k, 0 * k])
    undeformed = np.column_stack([k % (n + 1), k // (n + 1), 0 * k])
    assert np.allclose(points, undeformed + displacement, rtol=0, atol=1e-15), "displaced places"
    assert np.array_equal(array(grid.GetPointData(), "displacement"), displacement)
    assert np.array_equal(array(grid.GetPointData(), "velocity")[:, 0], 1.0 + k)
    cells = [[grid.GetCell(e).GetPointId(c) for c in range(4)] for e in range(n)]
    assert cells == [[e, e + 1, e + n + 2, e + n + 1] for e in range(n)]
    gauss = np.arange(4 * n).reshape(n, 4).mean(axis=1)
    assert np.allclose(array(grid.GetCellData(), "stress")[:, 0], -1e3 * gauss)
    assert np.allclose(array(grid.GetCellData(), "epsilon_q"), 1e-2 * gauss)
    assert list(array(grid.GetCellData(), "region")) == [0, 0, 0, 1, 1]
    assert array(grid.GetFieldData(), "time")[0] == 1.25

    with h5py.File(path) as file:
        assert file["breachline"].attrs["kind"] == b"mesh_snapshot"
        assert file["breachline"].attrs["version"] == 1
        assert file["breachline/gauss/stress"].attrs["unit"] == b"Pa"
        assert file["breachline/gauss/stress"].fletcher32
        k = np.arange(4.0 * n)
        assert np.array_equal(file["breachline/gauss/stress"][:, 1], -2e3 * k - 1.0 / 3.0)
        assert list(file["breachline/regions"].asstr()) == ["starter dam", "tailings"]
        scene = file["breachline/provenance/scene"].asstr()[0]
        assert scene == '{"name":"Böschung"}', scene


def check_particles(path):
    grid = read_with_vtk(path)
    k = np.arange(9)
    assert grid.GetNumberOfPoints() == 9 and grid.GetNumberOfCells() == 9
    assert grid.GetCellType(0) == 1, "cells are vertices"
    points = vtk_to_numpy(grid.GetPoints().GetData())
    assert np.array_equal(points, np.column_stack([0.25 * k, 10 - 0.125 * k, 0 * k]))
    data = grid.GetPointData()
    assert np.array_equal(array(data, "mass"), 450.0 + k)
    assert np.array_equal(array(data, "stress")[:, 3], 10.0 * k)
    assert np.array_equal(array(data, "region"), k % 2)
    with h5py.File(path) as file:
        assert file["breachline"].attrs["transfer_time"] == 14.75
        assert list(file["breachline/ledger/quantity"].asstr()) == ["mass"]


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], folder], check=True)
    check_mesh(Path(folder) / "mesh.vtkhdf")
    check_particles(Path(folder) / "particles.vtkhdf")
print("vtkHDFReader and h5py read mesh and particles: counts and values agree")
