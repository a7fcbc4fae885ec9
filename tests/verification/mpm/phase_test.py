"""mpm_solver as a program: outputs, resume after SIGTERM with the same bits, a grid too small, a duration
too short, a run until rest, a group without points."""
import glob, json, os, signal, subprocess, sys, tempfile, time

import h5py
import numpy as np

ROOT, BIN = os.environ["BREACH_ROOT"], os.environ["BREACH_BIN"]
SOLVER = os.path.join(BIN, "mpm_solver")
COLUMN = os.path.join(ROOT, "workflows/scenes/column.json")
SHORT = ["--set", "/mpm/duration=2", "--set", "/mpm/cell_size=0.5", "--set", "/mpm/snapshot_interval=0.5",
         "--set", '/mpm/gauges=[{"name": "foot", "x": 12}, {"name": "far", "x": 50}]']


def run(folder, *more, scene=COLUMN):
    return subprocess.run([SOLVER, scene, "--output", folder, "--progress", "none", *more], capture_output=True, text=True)


def arrays(path):
    found = {}
    with h5py.File(path) as file:
        def keep(name, item):
            if isinstance(item, h5py.Dataset) and item.dtype.kind in "if" and "provenance" not in name.lower():
                found[name] = item[()]
        file.visititems(keep)
    return found


def same(a, b):
    one, other = arrays(a), arrays(b)
    assert one.keys() == other.keys(), (a, b)
    for name in one:
        assert one[name].tobytes() == other[name].tobytes(), f"{name} differs between {a} and {b}"


def telemetry(folder):
    with open(os.path.join(folder, "telemetry.jsonl")) as file:
        return [json.loads(line) for line in file]


def series(folder):
    """Time and name of each frame in ParaView's series file."""
    with open(os.path.join(folder, "frames.vtkhdf.series")) as file:
        document = json.load(file)
    assert document["file-series-version"] == "1.0", document
    listed = [(each["time"], each["name"]) for each in document["files"]]
    assert listed == sorted(listed) and all(os.path.exists(os.path.join(folder, name)) for _, name in listed), listed
    return listed


def drawn(path):
    """As in a frame: single precision."""
    data = arrays(path)
    velocity = data["VTKHDF/PointData/velocity"].astype(np.float64)
    return (data["VTKHDF/Points"].astype(np.float32), data["VTKHDF/PointData/epsilon_q"].astype(np.float32),
            data["VTKHDF/PointData/region"]), np.hypot(velocity[:, 0], velocity[:, 1]).astype(np.float32)


def check_frames(folder):
    """The last frame and the final state have the same time and the same data."""
    frame, final = os.path.join(folder, "particles_2.000000.vtkhdf"), os.path.join(folder, "final.vtkhdf")
    (one, speed), (other, speed_there) = drawn(frame), drawn(final)
    assert all(np.array_equal(a, b) for a, b in zip(one, other)), "what is drawn of single and of double precision"
    assert np.all(np.abs(speed - speed_there) <= 2.4e-7 * speed_there), "two units in the last place of a float"
    with h5py.File(frame) as file:
        assert file["breachline"].attrs["kind"] == b"particle_frame"
        assert set(file["VTKHDF/PointData"]) == {"velocity", "epsilon_q", "region"}, "r_u only where points have one"
        points = file["VTKHDF/Points"]
        assert points.dtype == np.float32 and points.shuffle and points.compression == "gzip" and points.fletcher32
        size = os.path.getsize(frame) / len(points)
    assert size < 70, f"{size:.0f} bytes per point"
    print(f"frames: {size:.1f} bytes per point; positions, epsilon_q and regions drawn as from double precision")


def test_fields_that_are_asked_for(scratch):
    folder = os.path.join(scratch, "fields")
    few = ["--set", "/mpm/duration=0.02", "--set", "/mpm/cell_size=2"]
    asked = run(folder, *few, "--set", '/mpm/output/fields=["stress", "mass"]')
    assert asked.returncode == 0, asked.stderr
    frame = os.path.join(folder, "particles_0.000000.vtkhdf")
    with h5py.File(frame) as file:
        assert set(file["VTKHDF/PointData"]) == {"stress", "mass", "region"}
    refused = run(os.path.join(scratch, "unknown"), *few, "--set", '/mpm/output/fields=["colour"]')
    assert refused.returncode == 65 and "/mpm/output/fields/0" in refused.stderr and "epsilon_q" in refused.stderr, refused.stderr
    looked_at = run(os.path.join(scratch, "again"), *few, "--input", frame)
    assert looked_at.returncode == 65 and "final.vtkhdf" in looked_at.stderr, looked_at.stderr
    # Another run into the same folder: older frames are not included.
    assert run(folder, *few, "--set", "/mpm/snapshot_interval=0.01").returncode == 0 and len(series(folder)) == 3
    assert run(folder, *few).returncode == 0
    assert series(folder) == [(0.0, "particles_0.000000.vtkhdf")]


def test_outputs_and_resume(scratch):
    whole, stopped = os.path.join(scratch, "whole"), os.path.join(scratch, "stopped")
    first = run(whole, *SHORT)
    assert first.returncode == 0, first.stderr
    names = {os.path.basename(f) for f in glob.glob(whole + "/*")}
    for name in ("result.json", "telemetry.jsonl", "history.h5", "profile.csv", "final.vtkhdf", "particles_0.000000.vtkhdf", "particles_1.500000.vtkhdf"):
        assert name in names, names
    result = json.load(open(os.path.join(whole, "result.json")))
    for key in ("runout", "runout_beyond_toe", "runout_largest", "at_rest", "energy", "volume_ratio", "overlap", "steps",
                "dt_min", "dt_max", "particle_steps_per_second", "particles"):
        assert key in result, key
    for key in ("runout_beyond_toe_95", "runout_beyond_toe_50", "runout_front", "area_beyond_toe"):
        assert key in result, key
    foot, far = result["gauges"]["foot"], result["gauges"]["far"]
    assert 0.0 < foot["arrival_time"] < 2.0 and foot["largest_depth"] > 1.0 and foot["largest_velocity"] > 1.0, foot
    assert far["arrival_time"] is None and far["largest_depth"] == 0.0, far
    lines = telemetry(whole)
    history = arrays(os.path.join(whole, "history.h5"))
    depth = next(value for name, value in history.items() if name.endswith("gauge.foot.depth"))
    assert [line["gauge.foot.depth"] for line in lines] == list(depth)
    profiles = next(value for name, value in history.items() if name.endswith("profile.depths"))
    places = next(value for name, value in history.items() if name.endswith("profile.x"))
    widths = np.full(len(places), 0.5)
    widths[[0, -1]] = 0.25
    areas = profiles.reshape(-1, len(places)) @ widths
    assert abs(areas[0] - 200.0) < 1e-6 and np.all(abs(areas / 200.0 - 1.0) < 0.02), areas  # 10 m x 20 m of sand
    table = np.genfromtxt(os.path.join(whole, "profile.csv"), delimiter=",", names=True)
    assert np.array_equal(table["x_m"], places) and abs(table["depth_m"] @ widths / 200.0 - 1.0) < 0.02
    assert np.allclose(table["ground_m"], 0) and np.all(table["surface_m"] >= 0)
    deep = table["depth_m"] > 3
    assert np.all(abs(table["surface_m"] / table["depth_m"] - 1)[deep] < 0.25), table["surface_m"] / table["depth_m"]
    # 2 s are too short, which is reported
    assert result["at_rest"] is False and result["ended"] == "duration" and result["end_time"] == 2.0, result
    assert 0.05 < result["kinetic_share"] < 0.5 and result["rest"]["moving"], result
    assert result["questionable"] is True
    assert [each["code"] for each in result["flags"]] == ["short_runout", "still_moving", "overlap", "upstream_wall"], result["flags"]
    message = result["flags"][1]["message"]
    assert f"still moving at 2 s with {100 * result['kinetic_share']:.3g} % of the released energy" in message, message
    for words in (f"runout {result['runout']:.2f} m", f"beyond the toe {result['runout_beyond_toe']:.2f} m", "STILL MOVING", "volume ratio",
                  "numerical share", "overlap", "flags: short_runout (warning), still_moving (questionable)"):
        assert words in first.stderr, (words, first.stderr)
    check_frames(whole)
    assert series(whole) == [(t, f"particles_{t:.6f}.vtkhdf") for t in (0.0, 0.5, 1.0, 1.5, 2.0)], series(whole)
    began = time.monotonic()
    child = subprocess.Popen([SOLVER, COLUMN, "--output", stopped, "--progress", "none", *SHORT], stderr=subprocess.DEVNULL)
    while child.poll() is None and len(glob.glob(stopped + "/particles_*")) < 2:
        time.sleep(0.01)
    child.send_signal(signal.SIGTERM)
    assert child.wait() == 143, child.returncode
    assert os.path.exists(os.path.join(stopped, "checkpoint.h5"))
    assert 2 <= len(series(stopped)) < 5, series(stopped)
    with h5py.File(os.path.join(stopped, "checkpoint.h5")) as file:
        spent = file["breachline/provenance"].attrs
        before = {each: float(np.squeeze(spent[each])) for each in ("wall_seconds", "cpu_seconds")}
    again = run(stopped, *SHORT, "--resume")
    assert again.returncode == 0, again.stderr
    elapsed = time.monotonic() - began
    after = json.load(open(os.path.join(stopped, "result.json")))
    cpu = "cpu_seconds"
    assert after[cpu] > before[cpu] > 0.1 * result[cpu], (before, after, result[cpu])
    assert 0.5 * result[cpu] < after[cpu] < 3.0 * result[cpu], (after[cpu], result[cpu])
    assert before["wall_seconds"] + 0.5 * (after[cpu] - before[cpu]) < after["wall_seconds"] < elapsed, (before, after, elapsed)
    same(os.path.join(whole, "final.vtkhdf"), os.path.join(stopped, "final.vtkhdf"))
    same(os.path.join(whole, "history.h5"), os.path.join(stopped, "history.h5"))
    assert telemetry(whole) == telemetry(stopped) and series(whole) == series(stopped)
    print("resume after SIGTERM: final.vtkhdf, history.h5 and telemetry have the same bits; its seconds are of both processes")


def test_grid_too_small(scratch):
    folder = os.path.join(scratch, "small")
    ended = run(folder, "--set", "/mpm/domain_x=[0,15]", "--set", "/mpm/floor/friction=[]")
    assert ended.returncode == 70, (ended.returncode, ended.stderr)
    assert "right end of the grid" in ended.stderr and "t = " in ended.stderr, ended.stderr
    assert os.path.exists(os.path.join(folder, "last_good.vtkhdf"))
    assert not os.path.exists(os.path.join(folder, "result.json"))
    print("grid too small: exit 70, says where and when, last good state saved")


def test_until_rest(scratch):
    folder = os.path.join(scratch, "rest")
    ended = run(folder, "--set", "/mpm/cell_size=2", "--until-rest")
    assert ended.returncode == 0, ended.stderr
    result = json.load(open(os.path.join(folder, "result.json")))
    assert result["at_rest"] is True and result["ended"] == "at_rest" and result["rest"]["moving"] is None, result
    assert result["kinetic_share"] < 0.005 and "still_moving" not in [each["code"] for each in result["flags"]], result["flags"]
    assert f"at rest at {result['end_time']:.2f} s" in ended.stderr and "STILL MOVING" not in ended.stderr, ended.stderr
    assert result["provenance"]["overrides"][-1] == "/mpm/duration=until_rest"
    cut = os.path.join(scratch, "cut")
    ended = run(cut, "--set", "/mpm/cell_size=2", "--until-rest", "--set", "/mpm/longest_duration=1.5")
    bounded = json.load(open(os.path.join(cut, "result.json")))
    assert ended.returncode == 0 and bounded["ended"] == "duration" and bounded["end_time"] == 1.5, bounded
    assert "--set /mpm/longest_duration=3" in ended.stderr, ended.stderr
    print(f"until rest: at {result['end_time']:.2f} s of at most {result['rest']['longest_duration']:.0f} s; a bound that is too short is named")


def test_coarse_cells(scratch):
    sizes = ["--set", "/mpm/cell_size=6", "--set", "/mpm/domain_x=[0,60]", "--set", "/mpm/domain_y=[0,24]"]
    refused = run(os.path.join(scratch, "refused"), *sizes)
    assert refused.returncode == 65 and "/mpm/cell_size" in refused.stderr and "--set /mpm/cell_size=" in refused.stderr, refused.stderr
    folder = os.path.join(scratch, "coarse")
    taken = run(folder, *sizes, "--set", "/mpm/allow_coarse_cells=true", "--set", "/mpm/duration=0.5")
    assert taken.returncode == 0, taken.stderr
    flags = {each["code"]: each["severity"] for each in json.load(open(os.path.join(folder, "result.json")))["flags"]}
    assert flags["coarse_cells"] == "questionable", flags
    print("fewer than two cells across the column: refused, and questionable where the scene allows it")


def test_group_without_points(scratch):
    scene = json.load(open(COLUMN))
    name, material = next(iter(scene["materials"].items()))
    brittle = json.loads(json.dumps(material))
    brittle["law"]["softening"] = {"epsilon_q_start": 0.01, "epsilon_q_end": 0.1, "c_residual_kPa": 0, "phi_residual_deg": 10}
    brittle["nonlocal_length"] = 4
    scene["mpm"]["softening_length"] = scene["mpm"]["cell_size"]
    for at in (name, "spare"):
        file = os.path.join(scratch, f"{at}.json")
        json.dump({**scene, "materials": {**scene["materials"], at: brittle}}, open(file, "w"))
        ended = run(os.path.join(scratch, at), "--set", "/mpm/duration=0.02", scene=file)
        assert ended.returncode == 0, (ended.returncode, ended.stderr)
    print("a length in the softening of a material that no region has changes nothing")


def test_terrain(scratch):
    deeper = ["--set", "/mpm/domain_y=[-10,24]", "--set", "/mpm/floor/level=-10"]
    folder = os.path.join(scratch, "terrain")
    ended = run(folder, *deeper, "--set", "/mpm/terrain=[[0,0],[12,0],[30,-6],[60,-6]]", "--set", "/mpm/duration=3")
    assert ended.returncode == 0, ended.stderr
    table = np.genfromtxt(os.path.join(folder, "profile.csv"), delimiter=",", names=True)
    assert np.allclose(np.interp([0, 12, 21, 30, 60], table["x_m"], table["ground_m"]), [0, 0, -3, -6, -6])
    points = arrays(os.path.join(folder, "final.vtkhdf"))
    place = next(value for name, value in points.items() if name.split("/")[-1] == "Points")
    ground = np.interp(place[:, 0], [0, 12, 30, 60], [0, 0, -6, -6])
    assert np.min(place[:, 1] - ground) > -0.5, np.min(place[:, 1] - ground)  # half a cell
    buried = run(os.path.join(scratch, "buried"), *deeper, "--set", "/mpm/terrain=[[0,1],[60,0]]")
    assert buried.returncode == 65 and "/mpm/terrain" in buried.stderr, (buried.returncode, buried.stderr)
    print(f"terrain: deepest point {np.min(place[:, 1] - ground):+.3f} m from the ground; a section in the ground is refused with exit 65")


def test_firm_ground(scratch):
    """Soil slides on firm ground as on a rough floor: the ground's domains end at its top, for every lattice."""
    on_ground = os.path.join(ROOT, "workflows/scenes/flow_slope.json")
    without = json.load(open(on_ground))
    without["section"]["regions"] = [each for each in without["section"]["regions"] if each["name"] == "slope"]
    del without["materials"]["firm_ground"], without["lem"]
    without["mpm"].update(domain_y=[0, 12], floor={"level": 0})
    on_floor = os.path.join(scratch, "on_floor.json")
    json.dump(without, open(on_floor, "w"))

    def runout(name, scene, *more):
        folder = os.path.join(scratch, name)
        ended = run(folder, *more, scene=scene)
        assert ended.returncode == 0, ended.stderr
        return json.load(open(os.path.join(folder, "result.json")))["runout_beyond_toe"]

    floor = runout("floor", on_floor)
    for number, shift in enumerate(([0, 0], [0.3, 0.3], [0.8, 0.7])):
        ground = runout(f"ground_{number}", on_ground, "--set", f"/mpm/fill_shift={shift}")
        print(f"runout on firm ground {ground:.1f} m, lattice moved by {shift}, on a floor that holds {floor:.1f} m")
        assert abs(ground / floor - 1) < 0.05, (shift, ground, floor)


if __name__ == "__main__":
    if not os.path.exists(SOLVER):
        print("mpm_solver is not built")
        sys.exit(77)
    with tempfile.TemporaryDirectory() as scratch:
        test_outputs_and_resume(scratch)
        test_fields_that_are_asked_for(scratch)
        test_grid_too_small(scratch)
        test_until_rest(scratch)
        test_coarse_cells(scratch)
        test_group_without_points(scratch)
        test_terrain(scratch)
        test_firm_ground(scratch)
