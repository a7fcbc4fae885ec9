"""Every view of a run shows the headline, the verdict, the lower bounds and the sentences of its findings, and every warning of its
submission: API, CSV, `breach results`, `breach show`, `breach runs`, Python and the report. Of random runs, and of every shipped
scene and template. Their phases are this file itself under their names: they copy the files of one real run and write random results.

    views_agree_test.py RUNS | shipped"""
import csv
import hashlib
import html
import io
import json
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import warnings

phase = pathlib.Path(sys.argv[0]).name
flags_of_phases = {
    "lem_tool": [("bound_raises_factor", "warning"), ("methods_differ", "questionable")],
    "fem_solver": [("far_crest", "warning"), ("entangled_corner", "questionable"), ("implausible", "warning")],
    "transfer_tool": [("liquefied_gap", "questionable"), ("liquefied_gap", "warning")],
    "mpm_solver": [("numerical_share", "questionable"), ("implausible", "warning"), ("coarse_cells", "warning"), ("overlap", "questionable")],
}


def result_of(chance):
    result = {"phase": phase, "cpu_seconds": 0.1,
              "flags": [{"code": code, "severity": severity, "message": f"what {code} says", "pointer": ""}
                        for code, severity in flags_of_phases[phase] if chance.random() < 0.12]}
    if phase == "lem_tool":
        result["factor_of_safety"] = round(chance.uniform(0.8, 1.8), 3)
    if phase == "fem_solver":
        result |= {"ended": "complete", "end_time": 3.0}
        if chance.random() < 0.5:
            result["milestones"] = {"liquefied": {"depth": 8.0, "time": round(chance.uniform(0.0, 0.7), 2)}}
    if phase == "mpm_solver":
        rests = chance.random() < 0.7
        result |= {"stood": rests and chance.random() < 0.3, "runout": round(chance.uniform(1, 200), 2), "runout_beyond_toe": round(chance.uniform(1, 200), 2), "at_rest": rests,
                   "runout_largest": 210.0, "area_beyond_toe": 33.5, "depth_beyond_toe": round(chance.uniform(0.1, 9), 2), "volume_ratio": 1.0, "end_time": 9.0, "energy": {"numerical": {"share": 0.01}}}
        if not rests:
            result["flags"].append({"code": "still_moving", "severity": "questionable", "message": "it still moves", "pointer": "/mpm/duration"})
    result["questionable"] = any(flag["severity"] == "questionable" for flag in result["flags"])
    return result


def play():
    """The interface of a phase (docs/reference/architecture.md), with a random result."""
    if "--version" in sys.argv:
        return print(f"{phase} 0\nnumerics 1")
    if "--plan" in sys.argv:
        return print("nothing")
    scene = json.loads(pathlib.Path(sys.argv[1]).read_text())
    output = pathlib.Path(sys.argv[sys.argv.index("--output") + 1])
    shutil.copytree(pathlib.Path(sys.argv[0]).parents[1] / "real" / phase, output, dirs_exist_ok=True,
                    ignore=shutil.ignore_patterns("result.json"))
    overrides = [sys.argv[i + 1] for i, word in enumerate(sys.argv) if word == "--set"]
    chance = random.Random(hashlib.sha256(json.dumps([scene["title"], phase, sorted(overrides), str(output.name)]).encode()).hexdigest())
    (output / "scene.completed.json").write_text(json.dumps(scene))
    if chance.random() < 0.03:
        (output / "fault.json").write_text(json.dumps({"exit_code": 70, "summary": f"{phase} broke down"}))
        sys.exit(70)
    for each in overrides:
        if each.startswith("/fem/snapshot_times="):
            for time in json.loads(each.split("=", 1)[1]):
                if time != 0.5:
                    shutil.copy(output / "snapshot_0.500000.vtkhdf", output / f"snapshot_{time:.6f}.vtkhdf")
    result = result_of(chance)
    if "--input" in sys.argv:
        source = pathlib.Path(sys.argv[sys.argv.index("--input") + 1])
        result["provenance"] = {"inputs": [{"path": str(source), "sha256": hashlib.sha256(source.read_bytes()).hexdigest()}]}
    (output / "result.json").write_text(json.dumps(result))
    print(json.dumps({"event": "result", "result": result}), flush=True)


if phase in flags_of_phases:
    play()
    sys.exit(0)

from phases import programs, root  # noqa: E402
from service import Service  # noqa: E402

sys.path.insert(0, str(root / "services/python"))
import breachline  # noqa: E402


def random_study(number):
    chance = random.Random(number)
    scene = json.loads((root / "workflows/scenes/slope.json").read_text())
    scene["title"] = f"random run {number}"
    study = {"format": "breachline-study/1", "name": f"random-{number}", "title": scene["title"], "scene": scene, "reuse": False,
             "known_failure": chance.random() < 0.1}
    if chance.random() < 0.4:
        scene.pop("fem")
        scene["transfer"] = {"mapping": scene["transfer"]["mapping"]} if "mapping" in scene.get("transfer", {}) else scene.get("transfer", {})
    else:
        study["transfer_times"] = sorted(chance.sample([0.1, 0.2, 0.3, 0.5, 0.7], chance.randint(1, 3)))
    if chance.random() < 0.4:
        study["variants"] = [{"name": name, "overrides": [f"/lem/slices={slices}", f"/mpm/cfl={cfl}"]}
                             for name, slices, cfl in [("a", 31, 0.31), ("b", 33, 0.33), ("c", 35, 0.35)][:chance.randint(2, 3)]]
    return study


def plain(text):
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", text)))


def compare(service, run, folder, by_program=True):
    """Differences of a run's views from its findings. by_program: the report is that of an export, and over REST it is the same."""
    faults = []

    def hold(what, condition):
        if not condition:
            faults.append(f"{run}: {what}")

    head = service.call(f"/v1/runs/{run}")
    answer = service.call(f"/v1/runs/{run}/results")
    verdict = answer["verdict"]
    own = [reason for reason in verdict["reasons"] if reason["code"] != "same_results"]  # known only for the whole table
    hold("the run's verdict is not that of its results", head["verdict"]["reasons"] == own)
    listed = next(each for each in service.call("/v1/runs?limit=500")["runs"] if each["id"] == run)
    hold("the list's verdict is not that of the run", listed["verdict"] == head["verdict"])
    hold("the list's governing result is not that of the run", [listed[each] for each in ("governing", "stability")] ==
         [head[each] for each in ("governing", "stability")])

    for each in head["warnings"]:
        hold(f"the verdict does not have the warning: {each['message']}",
             any(reason["code"] == each["code"] and each["message"].rstrip(".") in reason["text"] for reason in verdict["reasons"]))
    hold("the list's headline is not that of the run", listed["headline"] == head["headline"])
    in_python = breachline.run(run, service.url)
    hold(f"Python says {in_python!r}", in_python.headline == head["headline"]["text"] and in_python.verdict == verdict["words"])
    hold(f"Python's reasons are {in_python.reasons}", in_python.reasons == [reason["text"] for reason in own])

    rows = answer["rows"]
    in_csv = list(csv.DictReader(io.StringIO(service.text(f"/v1/runs/{run}/results?format=csv"))))
    for row, line in zip(rows, in_csv):
        bound = {None: "", True: "true", False: "false"}[row["lower_bound"]]
        hold(f"lower_bound of {row['mpm_task']} in CSV is {line['lower_bound']}", line["lower_bound"] == bound)
        codes = list(dict.fromkeys(flag["code"] for flag in row["flags"] or []))
        hold(f"flags of {row['mpm_task']} in CSV are {line['flags']}", line["flags"] == ";".join(codes))
        if row["runout"] is not None:
            moving = row["at_rest"] is False or "still_moving" in codes
            hold(f"{row['mpm_task']}: lower_bound {row['lower_bound']}", row["lower_bound"] == moving)

    ran = [row for row in rows if row["runout"] is not None]
    farthest = max(ran, key=lambda row: row["runout"], default=None)
    if ran:
        hold(f"{head['governing']} governs, not {farthest}", {name: farthest[name] for name in ("variant", "transfer_time", "runout",
             "lower_bound", "depth_beyond_toe")} | {"task": farthest["mpm_task"], "farthest": farthest["runout_beyond_toe"],
             "error": farthest["runout_error"]} == head["governing"])

    result = f"Result: {head['headline']['text']}\n" if head["headline"]["text"] else ""
    for words, flagged in [(("results", run), rows), (("show", run), head["tasks"])]:
        shown = subprocess.run([programs / "breach", "--server", service.url, *words], capture_output=True, text=True).stdout
        hold(f"`breach {words[0]}` does not begin with the verdict", f"{result}Verdict: {verdict['words']}\n" in shown)
        flags = [flag for each in flagged for flag in each["flags"] or []]
        for reason in (verdict["reasons"] if words[0] == "results" else own):
            explained = any(flag["code"] == reason["code"] and flag["message"] in reason["text"] for flag in flags)
            hold(f"`breach {words[0]}` does not say: {reason['text']}", explained or reason["text"] in shown)
    shown = subprocess.run([programs / "breach", "--server", service.url, "results", run], capture_output=True, text=True).stdout
    grows = {column["name"] for column in answer["columns"] if column["grows"]}
    hold(f"what grows is {grows}", grows == {"runout", "runout_beyond_toe", "runout_largest", "area_beyond_toe"})
    bounds = sum(row["lower_bound"] is True for row in rows)
    hold(f"`breach results` marks {shown.count('≥')} lower bounds of {bounds} rows", (shown.count("≥") >= bounds) if bounds else "≥" not in shown)

    page = service.text(f"/v1/runs/{run}/report")
    if by_program:
        export = folder / run
        done = subprocess.run([programs / "breach", "--server", service.url, "export", run, export], capture_output=True, text=True)
        hold(f"export: {done.stderr}", done.returncode == 0)
        done = subprocess.run([programs / "report", export, "--output", export / "report.html", "--alone"], capture_output=True, text=True)
        hold(f"report: {done.stderr}", done.returncode == 0)
        hold("the report over REST is another", done.returncode == 0 and (export / "report.html").read_text() == page)
    if ran:
        hold("the report is about another runout", f"Governing case: the largest runout of all ({'t_T = ' if farthest['transfer_time'] else ''}" in page)
    if head["headline"]["text"]:
        first = plain(re.search(r'<p class="headline">.*?</p>', page, re.S).group(0)).strip().lower()
        outcome, *factors = head["headline"]["text"].lower().split("; ")
        hold(f"the report's headline is \"{first}\" for \"{outcome}\"", first.startswith(outcome) and all(each in first for each in factors))
    heading = plain(" ".join(re.findall(r'<section[^>]*class="verdict.*?</section>', page, re.S)))
    hold(f"the report's verdict is not \"{verdict['words']}\": {heading[:90]}", f"checks: {verdict['words']}" in heading)
    for reason in verdict["reasons"]:
        hold(f"the report does not say: {reason['text']}", reason["code"].startswith("entangled") or reason["text"] in heading)
    return faults


def real_run(folder):
    """The outputs of each phase of the slope, by program."""
    scene = root / "workflows/scenes/slope.json"
    for name, *more in [("lem_tool",), ("fem_solver", "--set", "/fem/snapshot_times=[0.5]"),
                        ("transfer_tool", "--input", folder / "fem_solver/snapshot_0.500000.vtkhdf"),
                        ("mpm_solver", "--input", folder / "transfer_tool/particles.vtkhdf", "--set", "/mpm/duration=1")]:
        subprocess.run([programs / name, scene, "--output", folder / name, "--progress", "none", *more], check=True, capture_output=True)


def shipped_studies(service, folder):
    """Of each shipped scene and each template, as files."""
    for file in sorted((root / "workflows/scenes").glob("*.json")):
        scene = json.loads(file.read_text())
        study = {"format": "breachline-study/1", "name": file.stem.replace("_", "-"), "scene": str(file)}
        if "fem" in scene and "mpm" in scene:
            study["transfer_times"] = [0.5]
        (folder / file.name).write_text(json.dumps(study))
        yield folder / file.name
    for template in service.call("/v1/templates")["templates"]:
        subprocess.run([programs / "breach", "--server", service.url, "new", template["name"], "--output", folder / template["name"]],
                       check=True, capture_output=True)
        yield folder / template["name"] / "study.json"


def submitted_by_python(service, run):
    """Whether Python warns of what the service warned of."""
    study = service.call(f"/v1/runs/{run}")["study"]
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        again = breachline.submit(study, service.url).cancel()
    told = [str(each.message) for each in caught]
    return all(any(flag["message"] in text for text in told) for flag in again.about["warnings"])


def main(asked, folder):
    bin_folder = folder / "bin"
    bin_folder.mkdir()
    for name in flags_of_phases:
        (bin_folder / name).write_text(f"#!/bin/sh\nexec {sys.executable} {bin_folder}/of/{name} \"$@\"\n")
        (bin_folder / name).chmod(0o755)
        (bin_folder / "of").mkdir(exist_ok=True)
        (bin_folder / "of" / name).symlink_to(pathlib.Path(__file__).resolve())
    real_run(folder / "bin/real")
    service = Service(folder / "data", "--bin", str(bin_folder), "--slots", "4", "--tries", "1")
    faults, verdicts = [], {}
    try:
        if asked == "shipped":
            runs = [service.submit(file) for file in shipped_studies(service, folder)]
            faults += [f"{run}: Python drops warnings of the submission" for run in runs if not submitted_by_python(service, run)]
        else:
            runs = [service.call("/v1/runs", random_study(number))["id"] for number in range(int(asked))]
        for run in runs:
            end = service.finish(run, every=0.1)
            verdicts[end["verdict"]["usable"]] = verdicts.get(end["verdict"]["usable"], 0) + 1
            faults += compare(service, run, folder, by_program=asked != "shipped")
    finally:
        service.stop()
    print(f"{len(runs)} runs: {verdicts}")
    print("\n".join(faults[:40]))
    return 1 if faults or len(verdicts) < (2 if len(runs) < 100 else 4) else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        sys.exit(main(sys.argv[1], pathlib.Path(name)))
