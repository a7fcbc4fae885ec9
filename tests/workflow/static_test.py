"""The shipped study of a scene without a FEM, by the real service: a factor of safety and a runout for every variant, in its
table, its report and its database; what needs a FEM is refused."""
import csv
import json
import os
import pathlib
import re
import subprocess
import tempfile

from phases import check, programs, root
from service import Service


def report_of(service, run, folder):
    service.breach("export", run, folder / "run")
    page = folder / "report.html"
    done = subprocess.run([programs / "report", folder / "run", "--output", page], capture_output=True, text=True)
    check("the report is written", done.returncode == 0, done.stderr)
    return page.read_text(), page.parent / "report_files"


def records(file):
    with open(file, newline="") as stream:
        return list(csv.DictReader(stream))


def empty_chapters(html):
    return [each for each in re.findall(r"<section[^>]*><h2 id=.*?</section>", html, re.S) if "<figure" not in each and "<table" not in each]


def with_points(service, folder):
    run = service.submit(root / "workflows/studies/flow_slope.json")
    ended = service.finish(run)
    check("the study ends well; the short section is flagged", "4 of 5 runouts flagged upstream_wall" in ended["message"], ended)
    rows = service.rows(run)
    check("every variant has its runout and its factor of safety", len(rows) == 5 and all(
        row["transfer_time"] is None and row["transfer_task"] is None and row["runout"] is not None and row["factor_of_safety"] > 0
        for row in rows), rows)
    by_strength = [(row["factor_of_safety"], row["runout"]) for row in rows]
    check("more strength is more safety and less runout", by_strength == sorted(by_strength, key=lambda each: (each[0], -each[1]))
          and all(a[1] > b[1] for a, b in zip(by_strength, by_strength[1:])), by_strength)
    check("what stands by its factor of safety does not pass the toe, what fails by far does",
          by_strength[-1][0] > 1 > by_strength[0][0] and by_strength[-1][1] <= 0 < by_strength[0][1], by_strength)
    table = service.breach("results", run)
    check("the table for people has no column that is empty", "FS" in table and "t_T" not in table, table)
    check("the sweep has its points", service.call(f"/v1/sweeps/{run}")["points_total"] == 5)

    status, answer = service.post(f"/v1/runs/{run}/triggers", {"kind": "manual"})
    check("no trigger watches what is not there", status == 409 and answer["type"] == "/problems/no-fem", answer)
    status, answer = service.post(f"/v1/sweeps/{run}/extend", {"transfer_times": [1.0]})
    check("no transfer is added", status == 422 and answer["faults"][0]["pointer"] == "/transfer_times", answer)

    html, files = report_of(service, run, folder)
    check("no chapter is empty", not empty_chapters(html), empty_chapters(html))
    check("none is about a FEM or a transfer", not re.search(r"<h2[^>]*>\d+ (Shaking|Transfer|Motion|Strain)", html))
    shown = {row["variant"]: (float(row["factor of safety"]), float(row["runout [m]"])) for row in records(files / "variants.csv")}
    for row in rows:
        fs, runout = shown[row["variant"]]
        check(f"{row['variant']}: the report has the database's numbers",
              abs(fs / row["factor_of_safety"] - 1) < 1e-3 and abs(runout - row["runout"]) < 5e-3 * max(1, abs(row["runout"])), shown)
    curve = records(files / "runout_against_parameter.csv")
    check("the runout is drawn against the strength that the variants change",
          [float(each["c_kPa"]) for each in curve] == [4, 6, 9, 13, 24], curve)


def without_points(service, folder):
    study = json.loads((root / "workflows/studies/flow_slope.json").read_text())
    study["scene"] = json.loads((root / "workflows/scenes/flow_slope.json").read_text())
    del study["scene"]["mpm"]
    (folder / "study.json").write_text(json.dumps(study))
    run = service.submit(folder / "study.json")
    check("a stability analysis alone succeeds", service.finish(run)["state"] == "succeeded")
    rows = service.rows(run)
    check("it has a row for every variant", [row["variant"] for row in rows] == [each["name"] for each in study["variants"]] and
          all(row["factor_of_safety"] > 0 and row["runout"] is None and row["state"] == "succeeded" for row in rows), rows)
    html, _ = report_of(service, run, folder)
    check("its report has no empty chapter and no runout", not empty_chapters(html) and not re.search(r"<h2[^>]*>\d+ Runout", html))


def main(folder):
    service = Service(folder / "data", "--slots", str(os.cpu_count()))
    try:
        for part in (with_points, without_points):
            (folder / part.__name__).mkdir()
            part(service, folder / part.__name__)
    finally:
        service.stop()


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
