"""Each column of results has a pointer into the MPM's result.json, SQL or a computation, and a row with its unit in
docs/reference/results.md; nothing there is no column."""
import os
import pathlib
import re
import sys

root = pathlib.Path(os.environ["BREACH_ROOT"])
columns_in = "services/orchestrator/records/result_columns.cpp"
views = "services/orchestrator/store/views.cpp"
page = "docs/reference/results.md"


def part(file, begin, end):
    return re.search(rf"{begin}.*?{end}", (root / file).read_text(), re.DOTALL)[0]


def main():
    columns = re.findall(r'ResultColumn\{\s*"(\w+)",\s*"([^"]*)",\s*[\w:]+,\s*"([^"]*)"', (root / columns_in).read_text())
    units = {name: unit for name, _, unit in columns}
    by_sql = set(re.findall(r'^    \{"(\w+)",', part(views, "own_columns{", r"\n};"), re.M))
    computed = set(re.findall(r'"(\w+)"', part(views, "worked_out{", "};")))
    faults = [f'{columns_in}: {name} has {"a pointer as well as" if pointer else "no pointer and not"} one entry in own_columns or worked_out of {views}'
              for name, pointer, _ in columns if bool(pointer) + (name in by_sql) + (name in computed) != 1]
    faults += [f"{views} works out {name}, which is no column of {columns_in}" for name in sorted((by_sql | computed) - units.keys())]
    rows = re.findall(r"^\| (`.*?) \| (.*?) ?\|", part(page, "\n## Columns\n", "\n## "), re.M)
    explained = {name: unit for names, unit in rows for name in re.findall(r"`(\w+)`", names)}
    faults += [f"{page} explains {name}, which is no column of {columns_in}" for name in explained if name not in units]
    faults += [f"{page} has no row for {name}: {columns_in}" for name in units if name not in explained]
    faults += [f'{page} has {name} in "{explained[name]}"; {columns_in} in "{unit}"' for name, unit in units.items()
               if explained.get(name, unit) != unit]
    print("\n".join(faults) or f"{len(columns)} columns of results are worked out and explained")
    return 1 if faults or len(columns) < 25 else 0


if __name__ == "__main__":
    sys.exit(main())
