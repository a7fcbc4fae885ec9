"""What a major version promises (CHANGELOG.md, "What 1.x keeps") is still there: entries of scenes and studies, the REST API,
command lines, columns of the database, and files of an export. promised.json beside this file lists it.

    promises.py           says what is gone
    promises.py --fresh   says, too, what is new and not yet listed (a release lists all it has)
    promises.py --write   adds what is new to promised.json; of another major version, writes it anew

BREACH_ROOT is the source, BREACH_BIN the folder of the programs."""
import csv
import functools
import json
import os
import pathlib
import re
import sqlite3
import subprocess
import sys
import tempfile

import h5py

root, programs = (pathlib.Path(os.environ[name]) for name in ("BREACH_ROOT", "BREACH_BIN"))
listed_file = pathlib.Path(__file__).with_name("promised.json")
lower_bounds, upper_bounds = ("minimum", "exclusiveMinimum", "minItems", "minLength"), ("maximum", "exclusiveMaximum", "maxItems", "maxLength")


def said(*command):
    return subprocess.run(list(map(str, command)), text=True, capture_output=True, timeout=120, check=True).stdout


def resolved(schema, document):
    while "$ref" in schema:
        schema = functools.reduce(lambda part, word: part[word], schema["$ref"].removeprefix("#/").split("/"), document)
    return schema


def entries(schema, document, path="", found=None, optional=False):
    """Each entry of a JSON document: its types, values and bounds, and whether it may be left out. Alternatives of one entry
    have the value of their "type" in brackets; alternatives without one are merged. Patterns are not listed."""
    found = {} if found is None else found
    schema = resolved(schema, document)
    if base := schema.get("extends"):
        entries(document["components"]["schemas"][base], document, path, found, optional)
    for choice in schema.get("oneOf", ()):
        kind = resolved(choice, document).get("properties", {}).get("type", {})
        kind = kind.get("const") or "".join(kind.get("enum", [])[:1])
        entries(choice, document, path + (f"[{kind}]" if kind else ""), found, optional)
    entry = found.setdefault(path, {"optional": optional})
    if kind := schema.get("type"):
        entry["types"] = sorted({*entry.get("types", ()), *([kind] if isinstance(kind, str) else kind)})
    if values := schema.get("enum", [schema["const"]] if "const" in schema else []):
        entry["values"] = sorted({*entry.get("values", ()), *map(json.dumps, values)})
    entry.update({bound: schema[bound] for bound in lower_bounds + upper_bounds if bound in schema})
    for name, each in schema.get("properties", {}).items():
        entries(each, document, f"{path}/{name}", found, name not in schema.get("required", ()))
    for key in ("items", "additionalProperties"):
        if isinstance(schema.get(key), dict):
            entries(schema[key], document, f"{path}/*", found, True)
    return found


def documents():
    folder = root / "workflows/schema"
    return {file.name.split(".")[0]: entries(schema := json.loads(file.read_text()), schema) for file in sorted(folder.glob("*.schema.json"))}


def api():
    document = json.loads((root / "services/orchestrator/http/openapi.json").read_text())
    requests, answers = {}, {}
    for path, methods in document["paths"].items():
        if not path.startswith("/v1/"):
            continue
        for method, call in methods.items():
            name = f"{method.upper()} {path}"
            requests[name], answers[name] = {}, {}
            for each in call.get("parameters", ()):
                entries(each["schema"], document, "?" + each["name"], requests[name], not each.get("required", False))
            entries(call.get("requestBody", {}).get("json", {}), document, "", requests[name])
            for status, answer in call["responses"].items():
                entries(answer.get("json", {}), document, status, answers[name])
            requests[name] = {path: entry for path, entry in requests[name].items() if path or "types" in entry}
    return {"requests": requests, "answers": answers}


def commands():
    options = re.compile(r"^  (?:-\w, ?)?(--[a-z][\w-]*)", re.M)
    found = {}
    for name in ("breachline", "breach", "lem_tool", "fem_solver", "transfer_tool", "mpm_solver", "report"):
        text = said(programs / name, "--help")
        found[name] = options.findall(text)
        words = re.findall(r"^  ([a-z][\w-]*) ", text.partition("Subcommands:")[2], re.M)
        for word in words if name != "fem_solver" else ("element-test", "calibrate"):
            found[f"{name} {word}"] = options.findall(said(programs / name, word, "--help"))
    return {name: sorted(set(each)) for name, each in found.items()}


def database(file):
    """The columns that docs/reference/files.md names; of sweep_means, which has too many to name, all."""
    rows = (root / "docs/reference/files.md").read_text().partition("| table or view |")[2].partition("\n\n")[0].splitlines()[2:]
    found = {}
    with sqlite3.connect(f"file:{file}?mode=ro", uri=True) as connection:
        for row in rows:
            for table in re.findall(r"`(\w+)`", row.split("|")[1]):
                columns = [each[1] for each in connection.execute(f"PRAGMA table_info({table})")]
                found[table] = [each for each in columns if f"`{each}`" in row or table == "sweep_means"]
    return found


def datasets(file):
    found = []

    def note(name, each):
        if isinstance(each, h5py.Dataset) and "provenance" not in name:
            shape = "".join(f" x {size}" for size in each.shape[1:])
            found.append(f"{name} {each.dtype.kind}{shape} {each.attrs.get('unit', b'').decode()}".strip())
    with h5py.File(file) as opened:
        opened.visititems(note)
    return found


def export():
    """What the files of an exported run hold: members, columns, datasets. And the database that the run was in."""
    found = {}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        study = folder / "study.json"
        study.write_text(json.dumps({
            "format": "breachline-study/1", "name": "column", "scene": str(root / "workflows/scenes/column.json"), "transfer_times": [0.1],
            "overrides": ["/fem/stages/1/duration=0.2", "/mpm/duration=0.5", "/mpm/cell_size=2"]}))
        with subprocess.Popen([programs / "breachline", "serve", "--data", folder / "data", "--port", "0"], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True) as service:
            try:
                breach = (programs / "breach", "--server", json.loads(service.stdout.readline())["url"])
                run = said(*breach, "submit", study, "--watch").splitlines()[0]
                said(*breach, "export", run, folder / "export")
            finally:
                service.terminate()
        for file in sorted((folder / "export").rglob("*")):
            place = str(file.relative_to(folder / "export"))
            if file.is_dir() or file.name == "checkpoint.h5":
                continue
            if file.suffix in (".h5", ".vtkhdf"):
                found[place] = datasets(file)
            elif file.suffix == ".csv":
                found[place] = next(csv.reader(line for line in file.open() if not line.startswith("#")))
            elif file.suffix == ".json" and isinstance(content := json.loads(file.read_text()), dict):
                found[place] = sorted(content)
            else:
                found[place] = []
        return found, database(folder / "data/breachline.sqlite")


def promised_now():
    files, tables = export()
    return {"documents": documents(), "api": api(), "commands": commands(), "database": tables, "export": files}


def narrower(old, new):
    """Whether an entry of a request accepts less than before."""
    return (old["optional"] and not new["optional"] or not set(old.get("types", ())) <= set(new.get("types", old.get("types", ())))
            or "values" in new and not set(old.get("values", ["any other"])) <= set(new["values"])
            or any(bound in new and new[bound] > old.get(bound, float("-inf")) for bound in lower_bounds)
            or any(bound in new and new[bound] < old.get(bound, float("inf")) for bound in upper_bounds))


def looser(old, new):
    """Whether an entry of an answer may be absent or of another type than before."""
    return new["optional"] and not old["optional"] or not set(new.get("types", ())) <= set(old.get("types", new.get("types", ())))


def is_asked_for(name, entry, old):
    """Whether a new entry is required where none could be given before; another alternative of an entry is not."""
    return entry.get("optional") is False and not name.endswith("]") and (name.startswith("?") or name.rpartition("/")[0] in old)


def broken(old, new, where=()):
    """Parts of `old` that no longer hold."""
    if isinstance(old, list):
        yield from (" ".join(where) + f": {each} is gone" for each in old if each not in new)
    elif "optional" in old and isinstance(old["optional"], bool):
        worse = looser if "answers" in where else narrower
        if worse(old, new):
            yield " ".join(where) + f": was {old} and is {new}"
    else:
        for name, each in old.items():
            if name in new:
                yield from broken(each, new[name], (*where, name))
            else:
                yield " ".join((*where, name)) + " is gone"
        for name, each in new.items():
            if name not in old and "answers" not in where and isinstance(each, dict) and is_asked_for(name, each, old):
                yield " ".join((*where, name)) + " is new and required"


def merged(old, new):
    """The old promises and the new ones."""
    if isinstance(old, list):
        return old + [each for each in new if each not in old]
    if isinstance(old, dict) and not isinstance(old.get("optional"), bool):
        return {name: merged(old[name], new.get(name, old[name])) if name in old else new[name] for name in sorted({*old, *new})}
    return old


def as_text(promises, depth=0):
    """JSON with a line for each thing that is promised."""
    if isinstance(promises, list):
        return json.dumps(sorted(promises))
    if not isinstance(promises, dict) or isinstance(promises.get("optional"), bool):
        return json.dumps(promises)
    indent = " " * depth
    return "{\n" + ",\n".join(f"{indent} {json.dumps(name)}: {as_text(each, depth + 1)}" for name, each in sorted(promises.items())) + f"\n{indent}}}"


def main():
    major = re.search(r"^project\(Breachline VERSION (\d+)", (root / "CMakeLists.txt").read_text(), re.M)[1]
    now = promised_now()
    listed = json.loads(listed_file.read_text()) if listed_file.exists() else {}
    if listed.get("major") != major and "--write" in sys.argv:
        listed = {"major": major, **{name: {} for name in now}}
    if listed.get("major") != major:
        sys.exit(f"{listed_file} has the promises of version {listed.get('major')}, this is version {major}: promises.py --write")
    old = {name: listed[name] for name in now}
    if gone := list(broken(old, now)):
        print(*gone, sep="\n")
        sys.exit(f"Version {major} promises these {len(gone)} (CHANGELOG.md, \"What {major}.x keeps\"). Keep them, or raise the major version.")
    whole = merged(old, now)
    if "--write" in sys.argv:
        listed_file.write_text(as_text({"major": major, **whole}) + "\n")
    elif "--fresh" in sys.argv and whole != old:
        sys.exit(f"{listed_file} does not list everything that this version has: run promises.py --write and commit it.")


if __name__ == "__main__":
    main()
