"""Material points: coloured by material or by a value."""
from __future__ import annotations

import numpy as np

from ..frames import Array, Frame
from .chart import Axis, Chart, Field, Figure, Series
from .mesh import colour_range

MOST_POINTS = 15_000  # more are slow and look the same


def points_by_material(points: Frame, name: str, title: str) -> Figure:
    """One colour per material. Draws at most about 15,000 points, evenly picked, as the caption says; the data contain the drawn points."""
    figure = _figure(points, name, title)
    picked = slice(None, None, stride_of(points))
    of_point = np.array(points.materials)[points["region"][picked]]
    for material in sorted(set(of_point)):
        own = points.position[picked][of_point == material]
        figure.chart.series.append(Series(str(material), own[:, 0], own[:, 1], "dots"))
    return figure


def points_by_strain(points: Frame, name: str, title: str) -> Figure:
    """Coloured by epsilon_q [%], otherwise the same."""
    figure = _figure(points, name, title)
    strain = 100.0 * points["epsilon_q"]
    figure.chart.field = on_points(points, strain, "epsilon_q [%]", colour_range(strain[::stride_of(points)]))
    return figure


def on_points(points: Frame, value: Array, label: str, colours: tuple[float, float]) -> Field:
    """Evenly picked points where there are too many."""
    picked = slice(None, None, stride_of(points))
    return Field(label, 1, points.position[picked, 0], points.position[picked, 1], value[picked], *colours)


def stride_of(points: Frame) -> int:
    return max(1, -(-len(points.position) // MOST_POINTS))


def _figure(points: Frame, name: str, title: str) -> Figure:
    stride = stride_of(points)
    caption = f"{len(points.position)} material points" + (f", one in {stride} drawn" if stride > 1 else "") + "."
    return Figure(name, Chart(title, Axis("x [m]"), Axis("y [m]"), equal=True), caption)
