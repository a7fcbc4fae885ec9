"""The earthquake goes on in the runout: a block on a weak layer slides on ground that shakes. The FEM goes through the whole
earthquake; the MPM takes over in its middle. Both must end at the same place on the ground. And what cannot be shaken is refused."""
import json
import math
import pathlib
import shutil
import sys
import tempfile

import h5py
import numpy

from phases import check, result, run

transfer_time, end = 0.75, 3.0
start, period, rise, forwards, cycles = 0.2, 0.5, 0.1, 1.2 * 9.81, 3


def motion(file):
    """Velocity of outcropping rock: a saw, forwards at 1.2 g, back at 0.3 g, so that what slides does so one way."""
    dt = 0.005
    peak = forwards * rise
    lines = ["time_s,velocity_m_s"]
    for k in range(int(round((start + cycles * period + 0.3) / dt)) + 1):
        t = k * dt - start
        within = t % period if 0 < t < cycles * period else 0.0
        v = peak * within / rise if within < rise else peak * (period - within) / (period - rise)
        lines.append(f"{k * dt:.6f},{v:.10g}")
    file.write_text("\n".join(lines) + "\n")


def box(name, material, x0, y0, x1, y1, divisions):
    return {"name": name, "material": material, "polygon": [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]],
            "mesh": {"type": "block", "divisions": divisions}}


def cohesive(E, nu, c):
    return {"type": "mohr_coulomb", "E_MPa": E, "nu": nu, "c_kPa": c, "phi_deg": 0}


def scene_of(folder):
    motion(folder / "motion.csv")
    scene = {
        "format": "breachline-scene/1", "name": "block_on_weak_layer",
        "materials": {
            # Soil that shears beside elastic soil drags points of it along, within a quarter of a cell: all of it yields here,
            # the neighbours slightly later than the layer.
            "ground": {"density": 2200, "law": cohesive(1000, 0.25, 35)}, "block": {"density": 2000, "law": cohesive(100, 0.25, 35)},
            # light, so that all of it yields at once and no band depends on elements or cells; stiff enough at its free ends
            "layer": {"density": 400, "law": cohesive(30, 0.3, 28)}},
        "section": {"regions": [box("ground", "ground", -20, 0, 20, 2, [40, 2]), box("layer", "layer", -10, 2, 10, 3, [20, 2]),
                                box("block", "block", -10, 3, 10, 5, [20, 2])]},
        "fem": {"element": "bbar", "supports": [{"name": "base", "from": [-20, 0], "to": [20, 0], "fixes": "xy"}],
                "base": {"density": 2500, "V_s": 3000}, "motion": {"file": "motion.csv"}, "free_field": {"width": 1},
                "stages": [{"type": "static", "name": "gravity", "laws": "elastic"},
                           {"type": "dynamic", "name": "shaking", "duration": end, "time_step": 0.005}],
                "crest": [0, 5], "snapshot_times": [transfer_time], "telemetry_interval": 0.05},
        "transfer": {"points_per_direction": 4},
        "mpm": {"cell_size": 0.5, "domain_x": [-20.5, 20.5], "domain_y": [0, 8], "right": "roller", "floor": {"level": 0},
                "duration": end - transfer_time, "damping_ratio": 0, "tension_share": 0, "runout": {"toe": [10, 2], "regions": ["block"]}, "shaking": "on",
                "telemetry_interval": 0.05, "snapshot_interval": 10}}
    file = folder / "scene.json"
    file.write_text(json.dumps(scene))
    return file


def on_the_ground(snapshot):
    """Mean displacement of the block minus that of the base [m]."""
    with h5py.File(snapshot) as file:
        place, u = file["breachline/position_0"][()], file["VTKHDF/PointData/displacement"][()]
    rows = [u[abs(place[:, 1] - y) < 0.01, 0].mean() for y in (3.0, 4.0, 5.0)]
    return rows @ numpy.array([0.25, 0.5, 0.25]) - u[place[:, 1] < 0.01, 0].mean()


def slide(folder):
    """Mean displacement of the block's points [m]; files keep the points' order."""
    frames = []
    for name in ("particles_0.000000.vtkhdf", "final.vtkhdf"):
        with h5py.File(folder / name) as file:
            frames.append(file["VTKHDF/Points"][()])
    block = frames[0][:, 1] > 3.0
    return (frames[1] - frames[0])[block, 0].mean()


def compare(folder, scene):
    done = run("fem_solver", scene, folder / "fem")
    check("fem_solver ends well", done.returncode == 0, done.stderr[-2000:])
    ground = result(folder / "fem")["base_motion"]
    check(f"the free ground is the mesh's base to {ground['largest_difference_to_mesh']:.1e} of the peak velocity",
          ground["largest_difference_to_mesh"] < 0.02, ground)
    at_transfer, at_end = folder / f"fem/snapshot_{transfer_time:.6f}.vtkhdf", folder / f"fem/snapshot_{end:.6f}.vtkhdf"
    slid_in_fem = on_the_ground(at_end) - on_the_ground(at_transfer)
    done = run("transfer_tool", scene, folder / "points", "--input", at_transfer)
    check("transfer_tool ends well", done.returncode == 0, done.stderr[-2000:])
    slid = {}
    for shaking in ("on", "off"):
        done = run("mpm_solver", scene, folder / shaking, "--input", folder / "points/particles.vtkhdf", "--set", f"/mpm/shaking={shaking}")
        check(f"mpm_solver ends well with shaking {shaking}", done.returncode == 0, done.stderr[-2000:])
        slid[shaking] = slide(folder / shaking)
    print(f"from {transfer_time} s to {end} s the block slides {slid_in_fem:.4f} m in the FEM, {slid['on']:.4f} m in the MPM on shaken "
          f"ground, {slid['off']:.4f} m on ground at rest")
    check("the block slides, and the MPM's slide is the FEM's within 5 %",
          abs(slid_in_fem) > 0.02 and abs(slid["on"] / slid_in_fem - 1) < 0.05, slid)
    check("ground at rest gives another slide", abs(slid["off"] / slid_in_fem - 1) > 0.2, slid)
    energy, facts = result(folder / "on")["energy"], result(folder / "on")["shaking"]
    check("the shaking's work is in the ledger", energy["shaking"]["J"] != 0.0 and "shaking" not in result(folder / "off"), energy)
    check(f"and closes it to {energy['numerical']['J'] / abs(energy['shaking']['J']):+.1e} of that work",
          abs(energy["numerical"]["J"]) < 0.2 * abs(energy["shaking"]["J"]), energy)
    check("it says until when", abs(facts["until"] - (end - transfer_time)) < 1e-9 and facts["peak_acceleration"] > 5.0, facts)


def refuse(folder, scene):
    particles = folder / "points/particles.vtkhdf"
    bare = folder / "bare.vtkhdf"
    shutil.copy(particles, bare)
    with h5py.File(bare, "a") as file:
        del file["breachline/base_motion"]
    done = run("mpm_solver", scene, folder / "bare", "--input", bare)
    check("points without a base motion are refused by name", done.returncode == 65 and "/breachline/base_motion" in done.stderr and
          "/fem/free_field" in done.stderr, done.stderr)
    done = run("mpm_solver", scene, folder / "bare", "--input", bare, "--set", "/mpm/shaking=off", "--set", "/mpm/duration=0.01")
    check("and taken when nothing is shaken", done.returncode == 0, done.stderr)
    done = run("mpm_solver", scene, folder / "filled")
    check("a filled section is refused", done.returncode == 65 and "/mpm/shaking" in done.stderr, done.stderr)
    document = json.loads(scene.read_text())
    del document["fem"]["free_field"]
    (folder / "bound.json").write_text(json.dumps(document))
    done = run("fem_solver", folder / "bound.json", folder / "bound")
    check("a scene whose FEM cannot tell is refused before it runs", done.returncode == 65 and "/mpm/shaking" in done.stderr and
          "free_field" in done.stderr, done.stderr)
    with h5py.File(bare, "a") as file:
        motion = file["breachline"].create_group("base_motion")
        motion.attrs["time_step"] = 0.005
        motion["velocity"] = numpy.zeros(100)
    done = run("mpm_solver", scene, folder / "over", "--input", bare, "--set", "/mpm/duration=0.01")
    check("an earthquake that is over before the transfer is told", done.returncode == 0 and "over 0.25 s before" in done.stderr or
          "over 0.26 s before" in done.stderr, done.stderr)
    with h5py.File(bare, "a") as file:
        del file["breachline/base_motion/velocity"]
        file["breachline/base_motion/velocity"] = 0.05 * numpy.sin(numpy.arange(181) / 20)
    done = run("mpm_solver", scene, folder / "ends", "--input", bare, "--set", "/mpm/duration=0.2")
    check("ground that comes to rest before the runout's end is told", done.returncode == 0 and
          "until 0.15 s, and rests after that" in done.stderr and result(folder / "ends")["end_time"] == 0.2, done.stderr)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(name)
        scene = scene_of(folder)
        compare(folder, scene)
        refuse(folder, scene)
