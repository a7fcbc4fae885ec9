"""ParaView's own file series reader plays the series that mpm_solver leaves: times in seconds, points that move. Wants
Debian's python3-paraview, which a machine with python3-vtk9 does not have."""
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    from paraview import servermanager, simple
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

scene = pathlib.Path(os.environ["BREACH_ROOT"]) / "workflows/scenes/column.json"
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([pathlib.Path(os.environ["BREACH_BIN"]) / "mpm_solver", scene, "--output", folder, "--progress", "none", "--set", "/mpm/duration=1",
                    "--set", "/mpm/snapshot_interval=0.25", "--set", "/mpm/cell_size=2"], check=True, stderr=subprocess.DEVNULL)
    reader = simple.VTKHDFReader(FileName=[str(pathlib.Path(folder) / "frames.vtkhdf.series")])
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    assert times == [0.0, 0.25, 0.5, 0.75, 1.0], times
    fronts = []
    for time in times:
        reader.UpdatePipeline(time)
        points = servermanager.Fetch(reader)
        assert points.GetPointData().GetArray("epsilon_q") and points.GetPointData().GetArray("velocity")
        fronts.append(max(points.GetPoint(k)[0] for k in range(points.GetNumberOfPoints())))
    assert fronts == sorted(fronts) and fronts[-1] > fronts[0] + 1.0, fronts
    print(f"ParaView {simple.GetParaViewVersion()}: {len(times)} times, the front goes from {fronts[0]:.2f} to {fronts[-1]:.2f} m")
