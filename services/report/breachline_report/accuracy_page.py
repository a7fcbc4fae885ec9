"""Accuracy studies as a page of the manual: error against CPU seconds, the table and its recommendation. `report accuracy` writes it."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from breachline.faults import BreachlineError
from breachline.plot import Axis, Chart, Figure, Mark, Series, read_json, write_figures
from breachline.plot.folder import contents_of

Document = dict[str, Any]

_HEAD = """# Error against run time

Written by `report accuracy`. CPU seconds are of one run through all its phases.

*Error* is that of the mean over the repeats (on moved lattices of points, or of the FEM with other steps and residuals). *Of a run* is the \
error of one run: with the error of the reference, that of the base on the other ladders, and the scatter. *Order*, *limit* and *grid convergence \
index* are given only where three rungs converge monotonically and by more than the noise. `*`: on the Pareto front; `~`: within the noise; `?`: \
a run is questionable, so the setting is not recommended. *Repeats for* an error: repeats whose mean is within it nine times in ten (Student's \
interval for the mean of new repeats, and the bias); `-`: more than 20.
"""


def write_accuracy_page(files: Sequence[Path], page: Path) -> None:
    """files: what `breach accuracy --of RUN --json` printed. Writes the page (Markdown) and a folder of its name with the figures. Raises OSError or
    BreachlineError."""
    tables = {file.stem: _table_in(file) for file in files}
    with contents_of(page, "write the tables anew with this version"):
        write_figures(page.parent / page.stem, [figure for name, table in tables.items() if (figure := error_against_time(name, table)).chart.series])
        page.write_text(accuracy_page(tables, page.stem), encoding="utf-8")


def error_against_time(name: str, table: Document) -> Figure:
    """Error of one run against CPU seconds, log-log: one line per ladder, the Pareto front and the requested error. Without series when no row
    has an error. name: of the table's file, and of the figure."""
    placed = [row for row in table["rows"] if (row["error_of_a_run"] or 0) > 0 and (row["cpu_seconds"] or 0) > 0]

    def line(words: str, rows: list[Document]) -> Series:
        return Series(words, [row["cpu_seconds"] for row in rows], [100 * row["error_of_a_run"] for row in rows])

    series = []
    for ladder in table["ladders"]:
        own = [row for row in placed if row["ladder"] == ladder["name"]]
        if own:
            series.append(line(ladder["name"], own))
            series[-1].style, series[-1].certainty = "line_and_points", ["questionable" if row["questionable"] else "certain" for row in own]
    chart = Chart(f"{name}: {_quantity_of(table)}", Axis("CPU seconds of one run", logarithmic=True),
                  Axis("error of one run [%]", logarithmic=True), series)
    if series:
        front = sorted((row for row in placed if row["on_pareto_front"]), key=lambda row: float(row["cpu_seconds"]))
        if len(front) > 1:
            series.append(line("Pareto front", front))
        asked = 100 * table["asked_error"]
        chart.marks.append(Mark("y", asked, f"asked: {asked:.3g} %"))
    return Figure(name, chart)


def accuracy_page(tables: dict[str, Document], figures: str) -> str:
    """Markdown. figures: their folder, relative to the page."""
    return _HEAD + "".join(_section_of(name, table, figures) for name, table in tables.items())


def _table_in(file: Path) -> Document:
    table = read_json(file)
    if not isinstance(table, dict) or "recommendation" not in table:
        raise BreachlineError(f"{file}: is no table of an accuracy study; write it with breach accuracy --of RUN --json")
    return table


def _number(value: float | None, digits: int = 4) -> str:
    return "-" if value is None else f"{value:.{digits}g}"


def _percent(share: float | None) -> str:
    return "-" if share is None else _number(100 * share, 2 if 100 * share < 99.5 else 4) + " %"


def _code(words: Sequence[str]) -> str:
    return " ".join(f"`{each}`" for each in words)


def _quantity_of(table: Document) -> str:
    return (str(table["quantity"]) + ("" if table["time"] is None else f" at {_number(table['time'])} s")
            + ("" if table["transfer_time"] is None else f", transfer at {_number(table['transfer_time'])} s"))


def _row_of(row: Document) -> list[str]:
    mean = row["mean_within_asked"] or {"draws": None, "cpu_seconds": None}
    marks = "*" * row["on_pareto_front"] + "~" * row["below_noise"] + "?" * row["questionable"]
    return [row["ladder"], _code(row["setting"]), _number(row["value"]), _number(row["standard_deviation"], 2), _number(row["draws"]),
            _percent(row["error"]), _percent(row["error_of_a_run"]), _number(row["cpu_seconds"], 3), _number(row["wall_seconds"], 3),
            _number(row["peak_memory_MB"], 3), _number(mean["draws"], 3), _number(mean["cpu_seconds"], 3),
            " ".join(filter(None, [_code([marks] if marks else []), row["reason"]]))]


def _section_of(name: str, table: Document, figures: str) -> str:
    unit = "-" if table["unit"] == "1" else table["unit"]
    heads = ["ladder", "setting", f"{table['quantity']} [{unit}]", "+-", "repeats", "error", "of a run", "CPU s", "wall s", "MB",
             f"repeats for {_percent(table['asked_error'])}", "their CPU s", ""]
    lines = [f"\n## {name}\n", f"{_quantity_of(table)}; errors relative to {table['reference']}."
             + (f" All rungs: {_code(table['base'])}." if table["base"] else "") + "\n",
             *("| " + " | ".join(cells) + " |" for cells in [heads, ["---"] * len(heads), *map(_row_of, table["rows"])]), "",
             *(f"- {each['name']}: {each['message']}" for each in table["ladders"]), f"\n**{table['recommendation']}**"]
    if error_against_time(name, table).chart.series:
        lines.append(f"\n![error against CPU seconds]({figures}/{name}.svg)")
    return "\n".join(lines) + "\n"
