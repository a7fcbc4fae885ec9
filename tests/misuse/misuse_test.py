"""Every wrong scene, study and motion of the table is caught, with its words, where it should be: nothing that is wrong ends as
plain "succeeded", and nothing that the files tell is found after a task has started. All interfaces agree: what a plan refuses or warns
of is in the cost (`submit --dry-run`) and in the drawing, and the cost refuses what a submission refuses.

    misuse_test.py [--table FILE]     prints the table; writes it as Markdown"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time

from cases import cases
from studies import studies

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "workflow"))
from phases import programs, root  # noqa: E402
from service import Service  # noqa: E402


class Row:
    def __init__(self, name, kind, wanted):
        self.name, self.kind, self.wanted = name, kind, wanted
        self.stage = self.outcome = "nowhere"
        self.message = ""
        self.milliseconds = 0.0
        self.complaints = []


def asked(phase, scene, *arguments):
    began = time.perf_counter()
    done = subprocess.run([str(programs / phase), str(scene), *map(str, arguments)], capture_output=True, text=True, timeout=240)
    return done, 1000 * (time.perf_counter() - began)


def one_line(text, pattern):
    """The line that matches, or the first."""
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    found = next((k for k, line in enumerate(lines) if re.search(pattern, line, re.I)), 0)
    return " ".join(lines[found:found + 2])[:220] if lines else ""


def is_refused_by_schema(validator, document):
    return validator is not None and next(validator.iter_errors(document), None) is not None


def pairs(faults):
    return sorted((fault["pointer"], fault["cause"]) for fault in faults)


def said_of_scene(case, document, service):
    """The service's complaints about a study with this scene."""
    study = {"format": "breachline-study/1", "name": "wrong", "title": "A wrong scene", "scene": document}
    if "fem" in document:
        study["transfer_times"] = [0.1]
    status, cost = service.post("/v1/cost", study)
    told = "\n".join(f'{f["pointer"]}: {f["cause"]} {f["remedy"]}' for f in cost.get("faults", [])) + \
        "\n".join(f'{w["pointer"]}: {w["message"]}' for w in cost.get("warnings", []))
    complaints = []
    if not re.search(f"{case.text}|the path is relative", told, re.I | re.S):
        complaints.append(f"POST /v1/cost (HTTP {status}) does not say {case.text}: {told[:300]}")
    drawn, picture = service.post("/v1/draw", study)
    if drawn == 200:
        marks = len(re.findall(r'data-(?:cause|warning)="', picture))
        if marks != min(20, len(cost.get("faults", []))) + min(20, len(cost.get("warnings", []))) and status == 200:
            complaints.append(f"POST /v1/draw marks {marks} of {len(cost.get('warnings', []))} warnings")
    if status == 422:
        again, refusal = service.post("/v1/runs", study)
        if again != 422 or pairs(refusal["faults"]) != pairs(cost["faults"]):
            complaints.append(f"POST /v1/runs (HTTP {again}) and POST /v1/cost refuse for different reasons")
    return complaints


def judge_scene(case, bases, folder, validator, service):
    row = Row(case.name, "motion" if case.motion is not None else "scene", case.outcome)
    scene = folder / "scene.json"
    document = case.scene(bases)
    if case.motion is not None:
        (folder / "record.csv").write_text(case.motion)
        document["fem"]["motion"]["file"] = str(folder / "record.csv")
    scene.write_text(json.dumps(document))
    if not case.run:
        row.complaints = said_of_scene(case, document, service)
    done, row.milliseconds = asked("fem_solver", scene, "--check")
    if done.returncode == 65:
        row.stage, row.outcome = ("schema" if is_refused_by_schema(validator, document) else "check"), "refused"
        row.message = done.stderr
        return row
    if done.returncode != 0:
        row.outcome, row.message = f"exit {done.returncode}", done.stderr
        return row
    done, row.milliseconds = asked("fem_solver", scene, "--plan")
    warnings = "\n".join(line for line in done.stdout.splitlines() if line.startswith("warning"))
    if re.search(case.text, warnings, re.I):
        row.stage, row.outcome, row.message = "plan", "warned", warnings
        return row
    if case.run:
        done, row.milliseconds = asked(case.run, scene, "--output", folder / "out", "--progress", "none")
        if done.returncode != 0:
            row.stage, row.outcome, row.message = "run", f"exit {done.returncode}", done.stderr
            return row
        result = json.loads((folder / "out/result.json").read_text())
        flags = [flag for flag in result["flags"] if flag["code"] == case.code]
        if flags:
            row.stage, row.outcome, row.message = "result", "flagged", flags[0]["message"]
    return row


def judge_study(name, study, text, service):
    row = Row(name, "study", "refused")
    began = time.perf_counter()
    status, answer = service.post("/v1/runs", study)
    row.milliseconds = 1000 * (time.perf_counter() - began)
    if status == 422 or status == 400:
        row.stage, row.outcome = "submit", "refused"
        row.message = "\n".join(f'{f["pointer"]}: {f["cause"]} {f["remedy"]}' for f in answer.get("faults", [])) or json.dumps(answer)
        again, cost = service.post("/v1/cost", study)
        is_scene = study["format"].startswith("breachline-scene")  # the cost of a scene can be requested
        if not is_scene and (again != status or pairs(cost["faults"]) != pairs(answer["faults"])):
            row.complaints = [f"POST /v1/cost answers {again} where POST /v1/runs answers {status}: {json.dumps(cost)[:300]}"]
    else:
        row.outcome, row.message = f"HTTP {status}", json.dumps(answer)
    return row


def markdown(rows):
    lines = ["| what is wrong | of | caught in | outcome | message | ms |", "|---|---|---|---|---|---|"]
    for row, pattern in rows:
        message = one_line(row.message, pattern).replace("|", "\\|")
        lines.append(f"| {row.name} | {row.kind} | {row.stage} | {row.outcome} | {message} | {row.milliseconds:.0f} |")
    return "\n".join(lines) + "\n"


def main(folder):
    try:
        import jsonschema
        validator = jsonschema.Draft202012Validator(json.loads((root / "workflows/schema/scene.schema.json").read_text()))
    except ImportError:
        validator = None
    bases = {}
    for name in sorted({case.base for case in cases}):
        file = root / f"workflows/scenes/{name}.json"
        bases[name] = json.loads(file.read_text())
        motion = bases[name].get("fem", {}).get("motion")
        if motion:
            motion["file"] = str((file.parent / motion["file"]).resolve())
        sound = folder / f"{name}.json"
        sound.write_text(json.dumps(bases[name]))
        done, _ = asked("fem_solver", sound, "--check")
        assert done.returncode == 0, f"the shipped scene {name} itself is refused: {done.stderr}"

    rows = []
    service = Service(folder / "data")
    try:
        for case in cases:
            with tempfile.TemporaryDirectory(dir=folder) as place:
                rows.append((judge_scene(case, bases, pathlib.Path(place), validator, service), case.text))
        for name, study, text in studies(bases):
            rows.append((judge_study(name, study, text, service), text))
        runs = service.call("/v1/runs")["runs"]
    finally:
        service.stop()

    table = markdown(rows)
    print(table)
    if "--table" in sys.argv:
        pathlib.Path(sys.argv[sys.argv.index("--table") + 1]).write_text(table)
    faults = [f"{row.name}: wanted {row.wanted}, came to {row.outcome} ({row.stage}): {row.message[:300]}"
              for row, _ in rows if row.outcome not in row.wanted.split("|")]
    faults += [f"{row.name}: the message does not say {pattern}: {row.message[:400]}"
               for row, pattern in rows if row.outcome in row.wanted.split("|") and not re.search(pattern, row.message, re.I | re.S)]
    faults += [f"{row.name}: known from the files, found when it ran" for row, _ in rows if row.stage == "run"]
    faults += [f"{row.name}: {complaint}" for row, _ in rows for complaint in row.complaints]
    if runs:
        faults.append(f"{len(runs)} wrong studies were accepted")
    print(f"{len(rows)} cases, {len(faults)} not as they should be")
    print("\n".join(faults))
    return 1 if faults or len(rows) < 60 else 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        sys.exit(main(pathlib.Path(name)))
