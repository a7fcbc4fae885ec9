"""A chart as data, and its data as CSV. draw.py draws it with matplotlib; nothing here knows soils or files."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from numpy.typing import NDArray

Style = Literal["line", "points", "line_and_points", "area", "segments", "dots", "bars"]
#: Of a point's value. "lower bound" is drawn with an arrow upwards, "questionable" hollow and dashed.
Certainty = Literal["certain", "lower bound", "questionable"]
Numbers = Sequence[float] | NDArray[Any]


@dataclass
class Axis:
    label: str  #: with its unit: "shear strain [%]"
    logarithmic: bool = False
    names: list[str] = field(default_factory=list)  #: of the values 0, 1, 2, ...
    shown: tuple[float, float] | None = None  #: the rest is cut off; for x only; None: all


@dataclass
class Series:
    """segments and bars join the points 0-1, 2-3, ..."""

    name: str
    x: Numbers
    y: Numbers
    style: Style = "line"
    certainty: Sequence[Certainty] = ()  #: of each point; empty: all are certain
    error: Numbers = ()  #: up and down in y; NaN: unknown; empty: no error bars
    low: Numbers = ()  #: range in y of each point; NaN: unknown; empty: no ranges
    high: Numbers = ()
    like: int | None = None  #: earlier series with the same colour (computed beside measured); it has no entry in the legend


@dataclass
class Field:
    """Polygons (or, with one corner each, dots) coloured by a value."""

    label: str  #: of the value, with its unit
    corners: int  #: of each polygon
    x: Numbers  #: [n * corners], corner after corner
    y: Numbers
    value: Numbers  #: [n]
    low: float  #: of the colours; values outside have the colour of the nearer end
    high: float


@dataclass
class Mark:
    """A line across the chart at one value."""

    at: Literal["x", "y"]
    value: float
    label: str


@dataclass
class Chart:
    title: str
    x: Axis
    y: Axis
    series: list[Series] = field(default_factory=list)
    marks: list[Mark] = field(default_factory=list)
    equal: bool = False  #: a unit of x is as long as one of y; heights of a flat one are exaggerated by a whole number, which y states
    least_height: float = 150  #: of the axes of an equal one [px], which the exaggeration reaches
    field: Field | None = None  #: drawn beneath the series


@dataclass
class Figure:
    name: str  #: file name without extension
    chart: Chart
    caption: str = ""

    def __repr__(self) -> str:
        return f"Figure({self.name}: {self.chart.title})"

    def _repr_png_(self) -> bytes:
        """Shown by a notebook, which keeps it: of a cloud a small one."""
        return self.png(dots_per_inch=96)

    def svg(self) -> str:
        """Self-contained. Raises ValueError for numbers that cannot be drawn."""
        from .draw import as_svg

        return as_svg(self.chart)

    def png(self, dots_per_inch: int = 192) -> bytes:
        """The same; two dots for each of the SVG's pixels unless given otherwise."""
        from .draw import as_png

        return as_png(self.chart, dots_per_inch)

    def csv(self) -> str:
        """As the files of a report have it: series, x, y and what else is known, one row per point; or each polygon of the field."""
        from .draw import as_csv

        return as_csv(self.chart)
