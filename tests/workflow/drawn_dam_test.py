"""A drawn dam that an earthquake shakes: `breach import --with-fem` writes scene, study and motion, every phase plans them, and the FEM
shakes the dam. What the FEM cannot shake is refused, and no file is written over."""
import json
import pathlib
import subprocess
import tempfile

from phases import check, programs, run

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


def imported(folder, output, *words, end=-8):
    (folder / "dam.csv").write_text(DRAWING.format(end=end))
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


with tempfile.TemporaryDirectory() as scratch:
    main(pathlib.Path(scratch))
