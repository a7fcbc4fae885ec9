"""Every view of a run shows the rows of the API: CSV, HDF5, the command line, an export read back, and Python."""
import csv
import io
import json
import os
import pathlib
import re
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(os.environ["BREACH_ROOT"]) / "services/python"))
programs = pathlib.Path(os.environ["BREACH_BIN"])


def as_text(value):
    if value is None:
        return ""
    if isinstance(value, list):
        return ";".join(dict.fromkeys(flag["code"] for flag in value))
    return {True: "true", False: "false"}.get(value, value) if isinstance(value, bool) else value


def same(value, text):
    value = as_text(value)
    return float(text) == value if isinstance(value, (int, float)) and text else text == str(value)


def csv_differences(what, text, columns, rows, without):
    lines = list(csv.DictReader(io.StringIO(text)))
    found = []
    if len(lines) != len(rows) + len(without):
        found.append(f"{what}: {len(lines)} lines for {len(rows)} rows and {len(without)} without a transfer")
    for row, line in zip(rows, lines):
        if list(line) != [each["name"] for each in columns]:
            found.append(f"{what}: columns {list(line)}")
        found += [
            f"{what}: {name} of {row['variant']} at {row['transfer_time']} is {text!r} for {row[name]!r}"
            for name, text in line.items()
            if not same(row[name], text)
        ]
    for each, line in zip(without, lines[len(rows) :]):
        if (line["variant"], line["state"], line["reason"], line["runout"]) != (each["variant"], each["state"], each["reason"], ""):
            found.append(f"{what}: {line} for {each}")
    return found


def text_of(dataset):
    value = dataset[()]
    return (
        value.decode()
        if isinstance(value, bytes)
        else value.tobytes().decode()
        if value.dtype.kind in "iu"
        else "".join(each.decode() if isinstance(each, bytes) else each for each in value.ravel().tolist())
    )


def hdf5_differences(what, content, columns, rows, run):
    import h5py

    with h5py.File(io.BytesIO(content)) as file:
        root = file["breachline"]
        found = [] if text_of(root["texts/run"]) == run else [f"{what}: run {text_of(root['texts/run'])}"]
        for column in columns:
            name, wanted = column["name"], [row[column["name"]] for row in rows]
            if column["kind"] == "number":
                data = root["reals"][name]
                got = [None if value != value else value for value in data[()].tolist()]
                unit = data.attrs.get("unit", b"")
                if (unit.decode() if isinstance(unit, bytes) else str(unit)) != column["unit"]:
                    found.append(f"{what}: unit of {name} is {unit!r} for {column['unit']!r}")
            elif column["kind"] == "yes_no":
                got = [None if value < 0 else bool(value) for value in root["integers"][name][()].tolist()]
            else:
                got, wanted = text_of(root["texts"][name]).split("\n")[:-1], [as_text(value) for value in wanted]
            if got != wanted:
                found.append(f"{what}: {name} is {got} for {wanted}")
    return found


def differences(bench, run, folder):
    """Differences of a run's views from GET /v1/runs/{id}/results."""
    import breachline

    service, answer = bench.service, bench.results(run)
    found, at = [], f"/v1/runs/{run}/results?format="
    tables = [("runs", answer["columns"], answer["rows"], answer["without_transfer"])]
    if answer["means"]:
        tables.append(("means", answer["mean_columns"], answer["means"], []))
    for table, columns, rows, without in tables:
        found += csv_differences(f"CSV of {table}", service.text(f"{at}csv&table={table}"), columns, rows, without)
        found += hdf5_differences(f"HDF5 of {table}", bench.content(f"{at}hdf5&table={table}"), columns, rows, run)

    def breach(*words):
        return subprocess.run([programs / "breach", "--server", service.url, *words], capture_output=True, text=True).stdout

    if json.loads(breach("--json", "results", run)) != answer:
        found.append("breach --json results is not the API's answer")
    shown = breach("results", run)
    for row in [row for row in answer["rows"] if row["runout"] is not None]:
        for name in ("runout", "runout_beyond_toe", "runout_largest"):
            if f"{'≥ ' if row['lower_bound'] else ' '}{row[name]:.4g}" not in shown:
                found.append(
                    f"breach results does not show {name} {row[name]} of {row['variant']}, lower bound: {row['lower_bound']}"
                )
    moving = {(row["variant"], row["transfer_time"]) for row in answer["rows"] if row["lower_bound"]}
    for each in [each for each in answer["means"] if each["runout"] is not None]:
        if f" {each['runout']:.4g}" not in shown:
            found.append(f"breach results does not show the mean {each['runout']} of {each['variant']}")
        draws = [name for name in each["questionable_draws"].split("; ") if (name, each["transfer_time"]) in moving]
        if draws and f"≥ {each['runout']:.4g}" not in shown:
            found.append(f"breach results does not mark the mean of {draws} as a lower bound")
    if not moving and "≥" in shown:
        found.append("breach results marks a lower bound where there is none")
    if not re.match(rf"(Result: .*\n)?Verdict: {answer['verdict']['words']}\n", shown):
        found.append(f"breach results begins with {shown[:40]!r}, the verdict is {answer['verdict']['words']}")
    then = ", so there is no runout"
    leads = (f"No transfer{then}: ", f"from {{}}{then}: ", f"({{}}, ...){then}: ", f"{then}; of {{}}: ")
    for stood in {each["stood"] for each in answer["without_transfer"]}:  # the reason of one variant, which is named
        alike = [each for each in answer["without_transfer"] if each["stood"] is stood]
        if not any(lead.format(each["variant"]) + each["reason"] in shown for each in alike for lead in leads):
            found.append(f"breach results gives no reason for variants without a transfer, stood: {stood}")
    export = folder / run
    done = subprocess.run([programs / "breach", "--server", service.url, "export", run, export], capture_output=True, text=True)
    if done.returncode:
        return found + [f"export: {done.stderr}"]
    for what, other in (("Python", breachline.run(run, server=service.url)), ("an export in Python", breachline.run(str(export)))):
        if other.results.rows != answer["rows"]:
            found.append(f"{what}: rows are others")
        if other.results.without_transfer != answer["without_transfer"]:
            found.append(f"{what}: without_transfer is {other.results.without_transfer}")
        if {each.name: each.unit for each in other.results.columns} != {each["name"]: each["unit"] for each in answer["columns"]}:
            found.append(f"{what}: units are others")
        if other.state != bench.service.call(f"/v1/runs/{run}")["state"]:
            found.append(f"{what}: state is {other.state}")
    return found
