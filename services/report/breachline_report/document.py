"""The content of a report before it is written: chapters of figures and tables, and what is left out."""
from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, field
from typing import Any

from breachline.plot import Figure

Json = Any  #: a parsed document
_longest_name = 180  # [bytes]: endings, and a folder for them, need some of 255
_number = re.compile(r"-?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")


def is_number(text: str) -> bool:
    return _number.fullmatch(text) is not None


def as_file_name(name: str) -> str:
    """Shortened to what file systems take, still one for each name."""
    plain = name.replace("/", "_")
    if len(plain.encode()) <= _longest_name:
        return plain
    return plain.encode()[:_longest_name].decode(errors="ignore") + "_" + hashlib.sha256(name.encode()).hexdigest()[:8]


@dataclass
class Table:
    name: str  #: of its CSV file
    title: str
    columns: list[str]
    rows: list[list[str]] = field(default_factory=list)
    caption: str = ""

    def csv(self) -> str:
        """Heads first; every cell that is not a number is quoted."""
        lines = []
        for row in [self.columns, *self.rows]:
            if len(row) != len(self.columns):
                raise ValueError(f"a row of {self.name} has {len(row)} cells")
            lines.append(",".join(cell if is_number(cell) else '"' + cell.replace('"', '""') + '"' for cell in row) + "\n")
        return "".join(lines)


@dataclass
class Chapter:
    title: str
    text: str = ""
    figures: list[Figure] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)
    drawing: str = ""  #: SVG above everything else, not numbered
    cautions: list[str] = field(default_factory=list)  #: shown first, below the text


@dataclass
class Verdict:
    """Cautions to read before the numbers, in sentences."""

    words: str = ""  #: "questionable"
    usable: bool = True  #: False: no number is usable
    cautions: list[str] = field(default_factory=list)  #: a number is a bound, is wrong or cannot be trusted
    notes: list[str] = field(default_factory=list)


@dataclass
class Front:
    """The first page, for signature: the question, the result, and its limits."""

    identity: str = ""
    people: list[tuple[str, str]] = field(default_factory=list)  #: "client" and the name
    headline: str = ""
    pictures: list[Figure] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)
    tables: list[Table] = field(default_factory=list)
    limits: list[str] = field(default_factory=list)
    author: str = ""
    reviewer: str = ""


@dataclass
class Document:
    title: str
    front: Front = field(default_factory=Front)
    verdict: Verdict = field(default_factory=Verdict)
    chapters: list[Chapter] = field(default_factory=list)
    left_out: list[tuple[str, str]] = field(default_factory=list)  #: what a full report has and this one lacks, and why

    drawn: dict[str, str] = field(default_factory=dict)

    def svg(self, figure: Figure) -> str:
        """Drawn once, for its file and for the page."""
        if figure.name not in self.drawn:
            self.drawn[figure.name] = figure.svg()
        return self.drawn[figure.name]

    @property
    def figures(self) -> list[Figure]:
        return self.front.pictures + [each for chapter in self.chapters for each in chapter.figures]

    @property
    def tables(self) -> list[Table]:
        return self.front.tables + [each for chapter in self.chapters for each in chapter.tables]

    def leave_out(self, what: str, why: str) -> None:
        self.left_out.append((what, why))

    def add(self, chapter: Chapter) -> None:
        """Without its empty tables and figures, and only if something is left. Names of variants may be no names of files. Raises ValueError
        for a name given before: one file would replace another."""
        new: list[Figure | Table] = [*chapter.figures, *chapter.tables]
        for each in new:
            each.name = as_file_name(each.name)
        chapter.tables = [each for each in chapter.tables if each.rows]
        chapter.figures = [each for each in chapter.figures if each.chart.series or each.chart.field]
        names = [each.name for each in self.figures + chapter.figures] + [each.name for each in self.tables + chapter.tables]
        if twice := [name for name in names if names.count(name) > 1]:
            raise ValueError(f'"{twice[0]}" names two figures or tables of the report; give gauges, variants or companion runs names that differ '
                             "in more than signs which file names cannot have")
        if chapter.tables or chapter.figures or chapter.drawing:
            self.chapters.append(chapter)
