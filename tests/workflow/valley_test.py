"""The valley at a quarter of the FEM's resolution: one FEM, two grounds. Soil that leaves the dam runs farther down a slope than
on the flat, none is lost, and the report shows both on one scale beside the case history."""
import csv
import json
import os
import pathlib
import re
import subprocess
import tempfile

from phases import check, programs, quarter, result, root
from service import Service


def report_of(service, run, folder):
    service.breach("export", run, folder / "run")
    page = folder / "valley.html"
    done = subprocess.run([programs / "report", folder / "run", "--output", page], capture_output=True, text=True)
    check("the report is written without an option", done.returncode == 0, done.stderr)
    return page


def ends_of_grounds(file):
    """Last point of each ground in a figure's data: x and y."""
    ends = {}
    with open(file, newline="") as stream:
        for name, x, y in list(csv.reader(stream))[1:]:
            if name.startswith("ground, "):
                ends[name] = (float(x), float(y))
    return ends


# Cells of 5 m, the quarter's own, are as thick as the dam's crest: whether soil passes the lower dam is then random.
fine_cells = ["/mpm/cell_size=2.5", "/mpm/stiffness_scale=0.03", "/mpm/duration=25"]


def main(folder):
    service = Service(folder / "data", "--slots", str(os.cpu_count()))
    try:
        run = service.submit(root / "workflows/studies/mochikoshi_valley.json", *quarter, *fine_cells)
        ended = service.finish(run)
        rows = {row["variant"]: row for row in service.rows(run)}
        for row in rows.values():
            print(f"{row['variant']}: {row['state']}, runout {row['runout']} m, volume ratio {row['volume_ratio']}, "
                  f"{row['cpu_seconds']} s CPU {row['reason']}")
        check("the study succeeds", ended["state"] in ("succeeded", "questionable"), ended["message"])
        phases = [task["phase"] for task in ended["tasks"]]
        check("both grounds share one FEM", phases.count("fem_solver") == 1 and phases.count("mpm_solver") == 2, phases)
        flat, sloping = rows["flat"], rows["sloping"]
        check("soil runs farther down the slope", sloping["runout_beyond_toe"] > 1.2 * flat["runout_beyond_toe"] > 0)

        page = report_of(service, run, folder)
        tasks = folder / "run/tasks"
        for name in ("flat", "sloping"):
            (mpm,), (transfer,) = tasks.glob(f"mpm_*_{name}"), tasks.glob(f"transfer_*_{name}")
            check(f"no point of {name} is lost", result(mpm)["particles"] == result(transfer)["points"])
        files = page.parent / "valley_files"
        grounds = [ends_of_grounds(files / f"ground_{name}.csv") for name in ("flat", "sloping")]
        check("both pictures show both grounds on one scale", grounds[0] == grounds[1] and len(grounds[0]) == 2, grounds)
        x, y = grounds[0]["ground, sloping"]
        check("the valley falls by 20 %", abs(y / (x - 221) + 0.2) < 1e-9, (x, y))
        html = page.read_text()
        check("the case history stands beside them", re.search("(>|&gt;) 800<", html) and 'id="ground"' in html)
        check("the motion is the one that was applied", 'id="motion_acceleration"' in html)
        check("nothing of the page comes from elsewhere", not re.search(r"https?:|\ssrc=|<script|url\((?!#)|<link", html))
    finally:
        service.stop()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
