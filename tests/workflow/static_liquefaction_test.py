"""The shipped scenes of static liquefaction: loose they fail in motion, dense they stand; and one of them from the FEM to its
deposit, with half the resolution in the runout."""
import json
import pathlib
import sys
import tempfile

from phases import check, result, root, run

scenes = ["static_lift", "static_toe_cut", "static_phreatic_rise"]
dense = ["--set", "/materials/tailings/law/psi_0=-0.05"]


def telemetry(folder):
    return [json.loads(line) for line in (folder / "telemetry.jsonl").read_text().splitlines()]


def fem(name, folder, *arguments):
    done = run("fem_solver", root / f"workflows/scenes/{name}.json", folder, "--set", "/fem/snapshot_interval=1", *arguments)
    check(f"{name} runs", done.returncode == 0, done.stderr[-500:])
    return telemetry(folder)


def fails(name, folder):
    rows = fem(name, folder)
    trigger = [row for row in rows if row["time"] > 1.0]
    before = max(row["crest_displacement"] for row in rows if row["time"] <= 1.0)
    check("before its trigger it stands", before < 1e-3, before)
    check("soil goes past its peak", max(row["past_peak_share"] for row in trigger) > 0.05)
    energy = [row["kinetic_energy"] for row in trigger]
    check("kinetic energy grows", max(energy) > 5e4 and max(energy) > 10 * energy[len(energy) // 4], max(energy))
    check("the crest goes by metres", trigger[-1]["crest_displacement"] > 1.0, trigger[-1]["crest_displacement"])


def stands(name, folder):
    rows = fem(name, folder, *dense)
    check("dense it stands to the end", result(folder)["ended"] == "complete" and rows[-1]["crest_displacement"] < 0.05)
    check("and nothing of it is past its peak", max(row["past_peak_share"] for row in rows) < 1e-3)


def runout(folder, time, *arguments):
    scene = root / "workflows/scenes/static_lift.json"
    coarse = ["--set", "/mpm/cell_size=2", "--set", "/mpm/allow_coarse_cells=true", *arguments]
    snapshot = next(folder.glob(f"snapshot_{time}.*"))
    done = run("transfer_tool", scene, folder / "points", "--input", snapshot, *coarse)
    check("it is transferred", done.returncode == 0, done.stderr[-500:])
    done = run("mpm_solver", scene, folder / "runout", "--input", folder / "points/particles.vtkhdf", *coarse)
    check("it runs out", done.returncode == 0, done.stderr[-500:])
    return result(folder / "points"), result(folder / "runout")["runout"]


def main():
    with tempfile.TemporaryDirectory() as name:
        here = pathlib.Path(name)
        for scene in scenes:
            fails(scene, here / scene)
            stands(scene, here / f"{scene}_dense")
        points, loose = runout(here / "static_lift", 4)
        collapse = points["collapse"]
        check("the transfer says its criterion", "eta / eta_L" in collapse["criterion"], collapse)
        check("and how many points it found",
              0 < collapse["collapsed"] < collapse["past_instability_line"] < collapse["saturated"] < collapse["points_of_norsand"], collapse)
        points, standing = runout(here / "static_lift_dense", 4, *dense)
        check("nothing dense has collapsed", points["collapse"]["collapsed"] == 0, points["collapse"])
        check("the loose dam flows past its toe, the dense one stays behind it", standing < 0 < 10 < loose, (standing, loose))
        # Regions removed by a stage get no points.
        scene = root / "workflows/scenes/static_toe_cut.json"
        snapshot = next((here / "static_toe_cut").glob("snapshot_4.*"))
        done = run("transfer_tool", scene, here / "cut", "--input", snapshot)
        check("a cut section is transferred", done.returncode == 0, done.stderr[-500:])
        regions = {soil["region"]: soil["points"] for soil in result(here / "cut")["soils"]}
        check("without the berm", "berm" not in regions and regions["tailings"] > 0, regions)


sys.exit(main())
