"""Levels of the section before and after a runout: ground, crest and pond. The first page and the chapter of volumes ask for them."""
from __future__ import annotations

from dataclasses import dataclass

from .document import Json
from .run import Phase
from .words import entry

_pond_is_within = 0.1  # of the dam's height: a phreatic line so near to the ground at the upstream end is a pond's


def top_at(scene: Json, x: float) -> float | None:
    """Level of the section at rest [m]; None: there is no soil."""
    levels = []
    for region in scene["section"]["regions"]:
        ring = region["polygon"]
        for (x_0, y_0), (x_1, y_1) in zip(ring, ring[1:] + ring[:1]):
            if min(x_0, x_1) <= x <= max(x_0, x_1):
                levels += [y_0, y_1] if x_0 == x_1 else [y_0 + (y_1 - y_0) * (x - x_0) / (x_1 - x_0)]
    return max(levels, default=None)


def profile_of(runout: Phase) -> list[tuple[float, float, float]]:
    """x, ground and surface [m] at the end; empty: the runout had no points."""
    lines = (runout.files / "profile.csv").read_text().splitlines()[1:] if runout.has("profile.csv") else []
    rows = [[float(cell or 0.0) for cell in line.split(",")] for line in lines]
    return [(row[0], row[1], row[3]) for row in rows]


def phreatic_line(scene: Json) -> list[tuple[float, float]]:
    return next((line for at in ("/fem/water/line", "/lem/water/line", "/transfer/phreatic_line")
                 if isinstance(line := entry(scene, at), list)), [])


@dataclass
class Crest:
    """The highest ground between pond and toe [m]."""

    before: float
    after: float
    pond: float | None  #: level; None: the phreatic line begins below the ground


def crest_of(runout: Phase) -> Crest | None:
    """None: the runout left no profile, or no soil upstream of its toe."""
    scene, toe, profile = runout.scene, runout.scene["mpm"]["runout"]["toe"], profile_of(runout)
    tops = [(x, top) for x, _, _ in profile if x <= toe[0] and (top := top_at(scene, x)) is not None]
    if not tops:
        return None
    height = max(top for _, top in tops) - toe[1]
    pond, edge = None, tops[0][0]
    if line := phreatic_line(scene):
        first = top_at(scene, max(line[0][0], edge))
        if first is not None and first - line[0][1] < _pond_is_within * height:
            pond = float(line[0][1])
            edge = next((x for x, top in tops if top > pond + 1e-6), edge)
    return Crest(max(top for x, top in tops if x >= edge), max(surface for x, _, surface in profile if x >= edge), pond)
