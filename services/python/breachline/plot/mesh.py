"""A FEM snapshot: values on the deformed mesh, its borders and its edges."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..frames import Array, Frame
from .chart import Field, Series


def element_epsilon_q(mesh: Frame) -> Array:
    """Means of epsilon_q = sqrt(2/3 e:e) over each element's Gauss points [%]."""
    return 100.0 * mesh["epsilon_q"]


def element_r_u(mesh: Frame, excess: Array | None = None) -> Array | None:
    """r_u = (u - u_0) / sigma'_v0, averaged over an element's nodes [-]; None for a dry mesh. Elements without vertical stress count as 0.
    excess: [nodes] u - u_0 [Pa] in place of the frame's."""
    if mesh.quads is None or "sigma_v0" not in mesh.fields:
        return None
    if excess is None:
        excess = mesh["pore_pressure"] - mesh["pore_pressure_0"]
    rise, sigma = excess[mesh.quads].sum(axis=1), mesh["sigma_v0"][mesh.quads].sum(axis=1)  # values that alternate between corners cancel
    return np.divide(rise, sigma, out=np.zeros(len(rise)), where=sigma > 0.0)


def largest_excess_pressure(mesh: Frame) -> Array:
    """Largest u - u_0 of each node since the shaking began [Pa]: the stored one and the present one, which is smoothed as in
    core/mechanics/excess_pressure.hpp (means of the elements around a node, weighted by area)."""
    assert mesh.quads is not None
    corners = (mesh.position - mesh["displacement"])[mesh.quads]
    a, b = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    wet = (mesh["pore_pressure_0"][mesh.quads] != 0.0).any(axis=1)
    area = np.where(wet, 0.5 * np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), 0.0)
    mean = (mesh["pore_pressure"] - mesh["pore_pressure_0"])[mesh.quads].mean(axis=1)
    total, weight = (np.bincount(mesh.quads.ravel(), np.repeat(each, 4), len(mesh.position)) for each in (area * mean, area))
    present = np.divide(total, weight, out=np.zeros(len(total)), where=weight > 0.0)
    return np.maximum(present, mesh.fields.get("excess_pressure_max", present))


def on_deformed_mesh(mesh: Frame, value: Sequence[float] | Array, label: str, colours: tuple[float, float]) -> Field:
    """The elements in their deformed places, coloured by `value`. colours: their range."""
    corners = mesh.position[mesh.quads].reshape(-1, 2)
    return Field(label, 4, corners[:, 0], corners[:, 1], value, *colours)


def edges_of(mesh: Frame) -> Series:
    """Edges of the deformed mesh as segments."""
    return _segments(mesh, "mesh", _edges(mesh)[0])


def borders_of(mesh: Frame) -> Series:
    """Only the edges between regions and on the outside."""
    edges, of_element, count = _edges(mesh)
    region = np.repeat(mesh["region"], 4)
    low, high = np.full(len(edges), np.inf), np.full(len(edges), -np.inf)
    np.minimum.at(low, of_element, region)
    np.maximum.at(high, of_element, region)
    return _segments(mesh, "borders of regions", edges[(count == 1) | (low != high)])


def _edges(mesh: Frame) -> Any:
    """Each edge once, the edge of each side of the elements, and the number of elements at an edge."""
    assert mesh.quads is not None
    sides = np.sort(np.stack([mesh.quads, np.roll(mesh.quads, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    return np.unique(sides, axis=0, return_inverse=True, return_counts=True)


def _segments(mesh: Frame, name: str, edges: Array) -> Series:
    ends = mesh.position[edges.ravel()]
    return Series(name, ends[:, 0], ends[:, 1], "segments")


def colour_range(values: Sequence[float] | Array) -> tuple[float, float]:
    """From 0 to a round number above 99 % of the values."""
    high = float(np.sort(values)[(len(values) - 1) * 99 // 100]) if len(values) else 0.0
    if high <= 0.0:
        return 0.0, 1.0
    power = 10.0 ** np.floor(np.log10(high))
    return 0.0, float(next((fold * power for fold in (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8) if high <= fold * power), 10 * power))
