"""A document as one self-contained HTML page: figures inside, no script, no network."""
from __future__ import annotations

import re

import jinja2
from markupsafe import Markup, escape

from .document import Document, Table, is_number
from .words import at_least

_many = 9  # columns of a table that is set small
_wordy = 24  # characters: columns with longer texts of such a table go to a line below each row


def _class_of(cell: str) -> str:
    """Right-aligns numbers, also with a mark, marks lower bounds, and lets long texts break."""
    if is_number(cell.removesuffix(" *")):
        return "n"
    return "n b" if cell.startswith(at_least) else "long" if len(cell) > 12 else ""


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
    environment = jinja2.Environment(loader=jinja2.PackageLoader("breachline_report", "."), autoescape=True, trim_blocks=True, lstrip_blocks=True,
                                     undefined=jinja2.StrictUndefined)
    return environment.get_template("page.html.j2").render(
        document=document, front=document.front, left_out=[f"{what}: {why}" for what, why in document.left_out], folder=folder,
        class_of=_class_of, inline=_inline, wordy_columns=_wordy_columns, many=_many)
