"""What a change of structure must not change: answers of the API, tables and CSVs of shipped studies, the command line's
words, scenes of templates and imports, tables and figures of reports. Without times, ids and versions.

    goldens.py record DIR [STUDY...]   with the programs of BREACH_BIN and the files of BREACH_ROOT
    goldens.py compare DIR DIR         the first before, the second after; numbers are compared by value

Before a change of structure: record twice and compare. After it: record and compare; what differs is listed."""
import csv
import difflib
import hashlib
import html
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from phases import programs, root
from service import Service

studies = ["slope_sweep", "slopes", "column_sweep", "column_draws", "column_aspects", "static_lift", "static_phreatic_rise",
           "static_toe_cut", "flow_slope"]
reports = ["slope_sweep", "slopes", "column_draws", "column_aspects", "static_lift", "flow_slope"]
# Entries that differ between two runs of the same programs.
fleeting = {"id", "run", "task", "tasks", "created", "started", "finished", "seq", "sha256", "version"}
fleeting_parts = re.compile("cpu|wall|seconds|task|memory|_ms$|cost|MB")
# Words of a page or a table: their numbers are in the CSVs, which are compared by value.
number_or_id = re.compile(r"\b\d+\.\d+\.\d+\+[0-9a-f]{8}|\b01[0-9a-z]{24}(-\d+)?|[0-9a-f]{12,}|-?\d[\d.:TZe+-]*|127\.0\.0\.1:\d+")


def lasting(value):
    if isinstance(value, dict):
        return {key: lasting(each) for key, each in value.items() if key not in fleeting and not fleeting_parts.search(key)}
    return [lasting(each) for each in value] if isinstance(value, list) else value


def words_of(text):
    """Lines of words, with a space for what a number or an id is; the same however a page escapes its signs and keeps words together."""
    lines = (re.sub(r"[\s#]+", " ", number_or_id.sub("#", line)).strip() for line in html.unescape(text).splitlines())
    return "\n".join(line for line in lines if line)


class Recorder:
    def __init__(self, folder, service):
        self.folder, self.service = folder, service
        folder.mkdir(parents=True, exist_ok=True)

    def keep(self, name, content):
        text = content if isinstance(content, str) else json.dumps(lasting(content), indent=1, ensure_ascii=False)
        file = self.folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def scenes(self):
        """SHA-256 of the scenes of templates and imports."""
        made = {}
        for template in self.service.call("/v1/templates")["templates"]:
            answer = self.service.post(f"/v1/templates/{template['name']}", {})[1]
            made[template["name"]] = hashlib.sha256(json.dumps(answer, sort_keys=True).encode()).hexdigest()
        with tempfile.TemporaryDirectory() as scratch:
            example, target = root / "services/import/example", pathlib.Path(scratch) / "scene.json"
            for name, words in (("dam.dxf", ["--layers", "TAILINGS=5,10"]), ("dam.dxf", ["--layers", "TAILINGS=5,10", "--with-fem"]),
                                ("faulty.dxf", [])):
                done = subprocess.run([programs / "breach", "import", example / name, "--materials", example / "materials.json", *words,
                                       "--output", target], capture_output=True, text=True)
                made[" ".join([name, *words])] = [done.returncode, hashlib.sha256(target.read_bytes()).hexdigest() if target.exists() else ""]
                target.unlink(missing_ok=True)
        self.keep("scenes.json", made)

    def answers(self):
        for name in ("scene", "study"):
            self.keep(f"api/schema_{name}.json", self.service.call(f"/v1/schema/{name}"))
        examples = self.service.call("/v1/examples")
        self.keep("api/examples.json", examples)
        for each in examples["examples"]:
            self.keep(f"api/example_{each['name']}.json", self.service.call(f"/v1/examples/{each['name']}"))

    def study(self, name):
        run = self.service.submit(root / f"workflows/studies/{name}.json")
        self.service.finish(run)
        at = f"studies/{name}"
        self.keep(f"{at}/run.json", self.service.call(f"/v1/runs/{run}"))
        self.keep(f"{at}/results.json", self.service.call(f"/v1/runs/{run}/results"))
        self.keep(f"{at}/results.csv", self.service.text(f"/v1/runs/{run}/results?format=csv"))
        for words in (["show", run], ["results", run], ["transfers", run]):
            self.keep(f"{at}/breach_{words[0]}.txt", words_of(self.service.breach(*words)))
        if name not in reports:
            return
        with tempfile.TemporaryDirectory() as scratch:
            exported = pathlib.Path(scratch) / "exported"
            self.service.breach("export", run, exported)
            page = pathlib.Path(scratch) / "report.html"
            subprocess.run([programs / "report", exported, "--output", page], check=True, capture_output=True)
            for each in sorted((pathlib.Path(scratch) / "report_files").glob("*.csv")):
                self.keep(f"{at}/report/{each.name}", each.read_text())
            together = re.sub(r'<span class="short">(.*?)</span>', r"\1", page.read_text())
            words = re.sub(r"(?s)<(svg|style|script).*?</\1>|<[^>]+>", "\n", together)
            self.keep(f"{at}/report.txt", words_of(words))


def record(folder, names):
    with tempfile.TemporaryDirectory() as data:
        service = Service(pathlib.Path(data) / "data")
        try:
            recorder = Recorder(folder, service)
            recorder.scenes()
            recorder.answers()
            for name in names or studies:
                recorder.study(name)
                print(f"{name} recorded", flush=True)
        finally:
            service.stop()


def cells(text):
    """Of a CSV, numbers as numbers; columns of CPU and wall time left out."""
    rows = list(csv.reader(text.splitlines()))
    times = {k for k, head in enumerate(rows[0] if rows else []) if re.search(r"cpu|wall|task|seconds|memory", head, re.IGNORECASE)}

    def value(cell):
        try:
            return float(cell)
        except ValueError:
            return number_or_id.sub("#", cell)
    return [[value(cell) for k, cell in enumerate(row) if k not in times] for row in rows]


def same(left, right):
    if isinstance(left, float) and isinstance(right, float):
        return abs(left - right) <= 1e-9 * max(abs(left), abs(right))
    return left == right


def compare(before, after):
    names = sorted({str(each.relative_to(folder)) for folder in (before, after) for each in folder.rglob("*") if each.is_file()})
    different = 0
    for name in names:
        pair = [folder / name for folder in (before, after)]
        if not all(each.exists() for each in pair):
            print(f"{name}: only {'before' if pair[0].exists() else 'after'}")
            different += 1
            continue
        left, right = (each.read_text() for each in pair)
        if name.endswith(".csv"):
            rows = [cells(left), cells(right)]
            if len(rows[0]) == len(rows[1]) and all(len(a) == len(b) and all(map(same, a, b)) for a, b in zip(*rows)):
                continue
        elif left == right:
            continue
        different += 1
        print(f"{name}: differs")
        for line in list(difflib.unified_diff(left.splitlines(), right.splitlines(), lineterm="", n=0))[2:14]:
            print(f"    {line[:160]}")
    print(f"{len(names)} files, {different} differ")
    return different == 0


if __name__ == "__main__":
    if sys.argv[1] == "record":
        record(pathlib.Path(sys.argv[2]), sys.argv[3:])
    else:
        sys.exit(0 if compare(*map(pathlib.Path, sys.argv[2:4])) else 1)
