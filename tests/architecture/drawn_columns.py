"""Columns drawn by dashboard and report, or used by the transfer's advice, are written by a phase, in the unit of the table of
columns."""
import os
import pathlib
import re
import sys

root = pathlib.Path(os.environ["BREACH_ROOT"])
# written beside the columns of the tables: mpm_solver/run.cpp
beside = {"front": "m"}
of_expressions = {"growth", "rate", "and", "or", "not", "min", "max", "abs"}


def columns():
    """name -> units; the FEM and the MPM may share a name."""
    found = {name: {unit} for name, unit in beside.items()}
    table = (root / "core/telemetry/columns.cpp").read_text()
    rows = (root / "mpm_solver/measure/history.hpp").read_text()
    for pattern, text in ((r'Column\{"(\w+)",\s*"([^"]+)"', table), (r'visit\("(\w+)",\s*"([^"]+)"', rows)):
        for name, unit in re.findall(pattern, text):
            found.setdefault(name, set()).add(unit)
    return found


def panels():
    """(field, unit) drawn together by the dashboard."""
    text = (root / "services/web/static/panels.js").read_text()
    for unit, fields in re.findall(r'unit: "([^"]*)",\s*fields: \{([^}]*)\}', text):
        for field in re.findall(r"(\w+):", fields):
            yield field, unit or "1"


def curves():
    text = (root / "services/report/breachline_report/chapters/shaking.py").read_text()
    return re.findall(r'(?<=[\[ ])\("([a-z_A-Z]+)", f?"', text)


def conditions():
    text = (root / "transfer_tool/advice.cpp").read_text()
    for condition in re.findall(r'KnownSign\{"[^"]*",\s*"([^"]*)"\}', text):
        yield from set(re.findall(r"[a-z_]\w*", condition)) - of_expressions


def main():
    known = columns()
    drawn, curved, asked = list(panels()), list(curves()), list(conditions())
    faults = [f"panels.js draws {field}, which no phase writes" for field, _ in drawn if field not in known]
    faults += [f"panels.js draws {field} in {unit}; it is in {known[field]}" for field, unit in drawn
               if field in known and unit not in known[field]]
    faults += [f"shaking.py draws {field}, which no phase writes" for field in curved if field not in known]
    faults += [f"advice.cpp asks for {field}, which no phase writes" for field in asked if field not in known]
    print("\n".join(faults) or f"{len(drawn)} fields of panels, {len(curved)} of the report and {len(asked)} of the advice are columns")
    return 1 if faults or len(drawn) < 20 or len(curved) < 10 or len(asked) < 7 else 0


if __name__ == "__main__":
    sys.exit(main())
