"""A document as one self-contained HTML page: figures inside, no script, no network."""
from __future__ import annotations

import re
from itertools import accumulate

import jinja2
from markupsafe import Markup, escape

from .clauses import index_of
from .document import Document, Table, is_number
from .words import at_least

_many = 9  # columns of a table that is set small
_wordy = 24  # characters: columns with longer texts of such a table go to a line below each row
_short = 12  # characters: a text that stays on one line
_narrow = 450.0  # [pt]
_reasons_of_front = 520  # characters of the verdict's reasons on the first page; at least one stands there
_longest_word = 18  # characters: a narrow column breaks longer ones


def _classes_of(table: Table) -> list[str]:
    """n: numbers, bounds and blanks alone, right-aligned with their head. With a text among them all are left-aligned, below one another."""
    return ["n" if any(map(is_number, column)) and all(is_number(cell.removeprefix(at_least)) or cell in ("-", "") for cell in column) else ""
            for column in zip(*table.rows)]


def _is_narrow(svg: str) -> bool:
    """Two such figures share a row of a printed page."""
    return float(svg.split(' width="', 1)[1].split("pt", 1)[0]) <= _narrow


def _is_default(row: list[str]) -> bool:
    """Of the annex: every value is a default (inputs.py)."""
    return any(cell.endswith(" *") for cell in row) and all(cell.endswith(" *") or cell == "-" for cell in row[2:])


def _class_of(cell: str, of_column: str) -> str:
    """Marks lower bounds, keeps short texts on one line, and lets long words break."""
    longest = max(map(len, cell.split()), default=0)  # a pointer is one word: browsers do not break it at its slashes
    size = "short" if len(cell) <= _short else "long" if longest > _longest_word else ""
    return " ".join(filter(None, (of_column, "b" if cell.startswith(at_least) else "", size)))


def _unbroken(text: str) -> Markup:
    """With units, the first word of a JSON pointer, corners (x, y) and "phi' = 30" each on one line."""
    spaced = re.sub(r"(?<=\S) = (?=\S)", "\u00a0=\u00a0", re.sub(r"([(\[]-?[\d.]+), (?=-?[\d.]+[)\]])", "\\1,\u00a0", text))
    return Markup(re.sub(r"\[\S+/\S+\]|(?<!\S)/\w+", r'<span class="short">\g<0></span>', str(escape(spaced))))


def _inline(svg: str, title: str) -> Markup:
    """SVG inside HTML needs no prolog and no namespaces, whose addresses would look like network access."""
    text = re.sub(r'\sxmlns(:\w+)?="[^"]*"', "", svg[svg.index("<svg"):])
    label = escape(title)
    return Markup(text.replace("<svg", f'<svg role="img" aria-label="{label}"', 1))


def _wordy_columns(table: Table) -> list[int]:
    """Of a table with many columns those whose texts would make all others narrow."""
    if len(table.columns) < _many:
        return []
    return [k for k in range(1, len(table.columns)) if any(len(row[k]) > _wordy for row in table.rows)]


def as_html(document: Document, folder: str) -> str:
    """folder: with the files of figures and tables, relative to the page, for links; empty: no links."""
    reasons = document.verdict.cautions + document.verdict.notes
    first = max(1, sum(length <= _reasons_of_front for length in accumulate(map(len, reasons))))
    environment = jinja2.Environment(loader=jinja2.PackageLoader("breachline_report", "."), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    environment.tests |= {"default": _is_default, "narrow": _is_narrow}
    return environment.get_template("page.html.j2").render(
        document=document, clauses=index_of(document), front=document.front,
        left_out=[f"{what}: {why}" for what, why in document.left_out], folder=folder,
        class_of=_class_of, classes_of=_classes_of, inline=_inline, unbroken=_unbroken, wordy_columns=_wordy_columns, many=_many,
        reasons=reasons, first_reasons=first)
