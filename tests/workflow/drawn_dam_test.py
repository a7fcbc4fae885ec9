"""A drawn dam that an earthquake shakes: `breach import --with-fem` writes scene, study and motion, every phase plans them, and the FEM
shakes the dam. What the FEM cannot shake is refused, and no file is written over. `--liquefied` writes a study that runs to its factors of safety
and its runouts; REST answers the same, and refuses the same."""
import json
import pathlib
import subprocess
import tempfile

from phases import check, programs, run
from service import Service

SOIL = {"type": "mohr_coulomb", "E_MPa": 40, "nu": 0.3}
MATERIALS = {"ground": {"density": 2100, "law": {**SOIL, "c_kPa": 30, "phi_deg": 36}},
             "dam": {"density": 1950, "law": {**SOIL, "c_kPa": 8, "phi_deg": 34}},
             "tailings": {"density": 1850, "law": {**SOIL, "c_kPa": 1, "phi_deg": 30}}}
# With an end at -8 the lower edge is level.
DRAWING = """region,x,y
ground,-60,-8\nground,50,{end}\nground,50,0\nground,0,0\nground,-36,0\nground,-60,0\n
dam,-36,0\ndam,0,0\ndam,-24,12\ndam,-28,12\n
tailings,-60,0\ntailings,-36,0\ntailings,-28,12\ntailings,-60,11.5\n
phreatic,-60,10\nphreatic,-28,9\nphreatic,0,0\nphreatic,50,0\n"""
COARSE = ["--set", "/section/element_size=3", "--set", "/fem/free_field/width=3", "--set", "/fem/stages/1/duration=0.1"]


def imported(folder, output, *words, end=-8, drawing=DRAWING):
    (folder / "dam.csv").write_text(drawing.format(end=end))
    (folder / "materials.json").write_text(json.dumps({"materials": MATERIALS}))
    return subprocess.run([str(programs / "breach"), "import", str(folder / "dam.csv"), "--materials", str(folder / "materials.json"),
                           "--output", str(output), *words], capture_output=True, text=True, timeout=60)


def main(folder):
    scene = folder / "scene.json"
    refused = imported(folder, scene, "--with-fem", "--layers", "tailings=4", end=-5)
    check("a base that is not level is refused", refused.returncode == 65 and "the lower edge is not level: ground ends at (" in refused.stderr
          and "draw the ground down to (" in refused.stderr, refused.stderr)
    refused = imported(folder, scene, "--with-fem")
    check("so are tailings without layers", refused.returncode == 65 and "the regions are ground, dam, tailings" in refused.stderr, refused.stderr)
    check("and nothing is written", not scene.exists() and not (folder / "motion.csv").exists())

    done = imported(folder, scene, "--with-fem", "--layers", "tailings=4", "--pga", "0.2")
    check("a drawn dam gets an earthquake", done.returncode == 0, done.stderr)
    check("in three files", {pathlib.Path(line).name for line in done.stdout.split()} == {"scene.json", "study.json", "motion.csv"}, done.stdout)
    study = json.loads((folder / "study.json").read_text())
    check("whose study names the scene", study["scene"] == "scene.json" and study["transfer_times"] == [3.2, 4.8, 6.4, 8.0], study)
    again = imported(folder, scene, "--with-fem", "--layers", "tailings=4")
    check("no file is written over", again.returncode == 65 and "motion.csv" in again.stderr and "--force" in again.stderr, again.stderr)

    for phase, expected in (("lem_tool", "on        liquefied layers"), ("fem_solver", "on        absorbing base"),
                            ("fem_solver", "on        free-field columns"), ("mpm_solver", "on        law of tailings_runout")):
        plan = run(phase, scene, folder / "plan", "--plan")
        check(f"{phase} plans: {expected.split('  ')[-1]}", plan.returncode == 0 and expected in plan.stdout + plan.stderr, plan.stdout + plan.stderr)

    shaken = run("fem_solver", scene, folder / "fem", *COARSE)
    check("the FEM shakes it", shaken.returncode == 0, shaken.stderr)
    check("by the motion that was asked for", "PGA 0.2 g" in shaken.stderr, shaken.stderr)
    check("to its end", (folder / "fem/snapshot_0.100000.vtkhdf").exists(), shaken.stderr)
    moved = run("transfer_tool", scene, folder / "points", "--input", folder / "fem/snapshot_0.100000.vtkhdf", *COARSE)
    check("and the transfer takes its mesh", moved.returncode == 0, moved.stderr)
    flow = run("mpm_solver", scene, folder / "flow", "--input", folder / "points/particles.vtkhdf", "--set", "/mpm/duration=0.05", *COARSE)
    check("as the runout takes its points", flow.returncode == 0, flow.stderr)


STRENGTH = "tailings=0.05,CPTu 2024"
# The dam is raised upstream, on the tailings.
UPSTREAM = DRAWING.replace("-36,0", "-14,0")


def sent(service, liquefied):
    """(status, answer) of POST /v1/import."""
    body = {"file": "dam.csv", "drawing": UPSTREAM.format(end=-8), "materials": MATERIALS, "liquefied": [liquefied]}
    return service.post("/v1/import", body)


def at_rest(folder):
    scene = folder / "new/folder/scene.json"
    service = Service(folder / "data")
    try:
        for wrong in ("tailings", "tailings=0.05", "slimes=0.05,CPTu 2024", "dam=,CPTu 2024"):
            refused = imported(folder, scene, "--liquefied", wrong, drawing=UPSTREAM)
            status, answer = sent(service, wrong)
            check(f"{wrong}: both doors refuse", refused.returncode == 65 and status == 422, (refused.stderr, answer))
            for fault in answer["faults"]:
                check("in the same words", all(fault[part] in refused.stderr for part in ("pointer", "cause", "remedy")), (refused.stderr, fault))
        check("and nothing is written", not scene.exists())

        done = imported(folder, scene, "--liquefied", STRENGTH, drawing=UPSTREAM)
        check("a drawn dam liquefies, in a folder that the command makes", done.returncode == 0, done.stderr)
        check("without a warning of what the import chose", "cell_size: " not in done.stderr, done.stderr)
        document, study = json.loads(scene.read_text()), json.loads((scene.parent / "study.json").read_text())
        status, answer = sent(service, STRENGTH)
        check("REST gives the same scene and study", status == 200 and answer["scene"] == document
              and {**answer["study"], "scene": "scene.json"} == study, answer)
        corners = [point for region in document["section"]["regions"] for point in region["polygon"]]
        check("the crest is where it is drawn", [-24.0, 12.0] in corners and max(y for _, y in corners) == 12.0, corners)
        run_id = service.submit(scene.parent / "study.json", "/mpm/cell_size=1", "/mpm/floor/level=-10", "/mpm/domain_y=[-10,14]")
        answer = service.finish(run_id)
        rows = {row["variant"]: row for row in service.rows(run_id)}
        check("both variants run", set(rows) == {"liquefied", "undrained_peak"}, rows)
        for name, row in rows.items():
            check(f"{name}: stability before and after, and the runout",
                  row["factor_of_safety"] > row["factor_of_safety_liquefied"] > 0 and "runout" in row, row)
        check("the liquefied dam runs farther", rows["liquefied"]["runout"] > rows["undrained_peak"]["runout"], rows)
        check("flags are of the size of the cells and of the drawing's upstream end",
              set(answer["flag_counts"]) <= {"coarse_cells", "thin_deposit", "upstream_wall"}, answer["flag_counts"])
    finally:
        service.stop()


with tempfile.TemporaryDirectory() as scratch:
    main(pathlib.Path(scratch))
with tempfile.TemporaryDirectory() as scratch:
    at_rest(pathlib.Path(scratch))
