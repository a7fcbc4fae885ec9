"""A study of several motions, by real programs on coarse elements: what the service finds is what its FEMs say, and the command
line, the export, the report and Python show it."""
import json
import shutil
import pathlib
import subprocess
import sys
import tempfile

from phases import check, programs, root
from service import Service

sys.path.insert(0, str(root / "services/python"))
import breachline

PEAKS = (0.05, 0.15, 0.3)  # g
COARSE = ["/section/element_size=5", "/fem/stages/2/time_step=0.01", "/fem/stages/2/duration=5.5", "/mpm/cell_size=5", "/mpm/allow_coarse_cells=true",
          "/mpm/duration=2"]


def study(folder):
    done = subprocess.run([programs / "breach", "motion", root / "workflows/motions", "--scene", root / "workflows/scenes/mochikoshi.json",
                           "--pga-g", ",".join(map(str, PEAKS))], capture_output=True, text=True)
    check("the study is written", done.returncode == 0, done.stderr)
    made = json.loads(done.stdout)
    check("four records at three peaks", len(made["variants"]) == 12, len(made["variants"]))
    made["variants"] = [each for each in made["variants"] if each["name"].startswith(("synthetic_5", "synthetic_15", "synthetic_30", "synthetic_short"))]
    made |= {"overrides": COARSE, "transfer_times": [5], "triggers": [], "stability": False}
    file = folder / "study.json"
    file.write_text(json.dumps(made))
    return file


def long_names(folder):
    """Each variant has a name of its own where records share a long one."""
    records = folder / "records"
    records.mkdir()
    record = next((root / "workflows/motions").glob("*.csv"))
    for end in ("east", "north", "up"):
        shutil.copy(record, records / f"a_station_with_a_very_long_name_of_1978_{end}.csv")
    done = subprocess.run([programs / "breach", "motion", records, "--scene", root / "workflows/scenes/mochikoshi.json", "--pga-g", "0.1,0.3"],
                          capture_output=True, text=True)
    names = [each["name"] for each in json.loads(done.stdout)["variants"]]
    check("six names, each once and at most 32 letters long", len(set(names)) == 6 and max(map(len, names)) <= 32, names)


def main(folder):
    long_names(folder)
    service = Service(folder / "data", "--slots", "2")
    try:
        run = service.submit(study(folder))
        ended = service.finish(run)
        check("it ends", ended["state"] in ("succeeded", "questionable"), ended["message"])
        found = service.call(f"/v1/runs/{run}/motions")
        rows = {row["variant"]: row for row in found["rows"]}
        check("a row for each FEM", len(rows) == 6, list(rows))
        for task in (each for each in ended["tasks"] if each["phase"] == "fem_solver"):
            row, result = rows[task["variant"]], task["result"]
            check(f"{task['variant']}: the FEM's own facts", row["liquefaction_depth"] == result["largest_liquefaction_depth"] and
                  row["pgv"] == result["motions"]["input"]["pgv"], row)
            largest = max((each["runout_beyond_toe"] for each in service.rows(run) if each["variant"] == task["variant"]), default=None)
            check(f"{task['variant']}: its runout", row["runout"] == largest, (row["runout"], largest))
        depths = [rows[f"synthetic_{round(100 * peak)}"]["liquefaction_depth"] for peak in PEAKS]
        check("a stronger motion liquefies deeper", depths[0] < depths[-1] and depths == sorted(depths), depths)
        told = service.breach("motion", "--of", run)
        check("the command line says the same", all(each in told for each in found["sentences"]), told)
        service.breach("export", run, folder / "run")
        kept = json.loads((folder / "run/motions.json").read_text())
        check("the export holds it", kept == found)
        check("Python has it, from both", breachline.run(run, service.url).motions == found == breachline.run(folder / "run").motions)
        subprocess.run([programs / "report", folder / "run", "--output", folder / "page.html"], check=True, capture_output=True)
        page = (folder / "page.html").read_text()
        check("the report over REST has it", found["sentences"][0] in service.text(f"/v1/runs/{run}/report"))
        check("the report has it", "Several motions" in page and found["sentences"][0] in page)
    finally:
        service.stop()


with tempfile.TemporaryDirectory() as name:
    main(pathlib.Path(name))
