"""Figures of lem_tool: factor of safety against liquefied depth and time, section and critical surfaces."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..frames import Array
from .chart import Axis, Chart, Figure, Mark, Series
from .folder import RESULT, SCENE, contents_of, read_json

Document = dict[str, Any]


def stability_figures(folder: Path) -> list[Figure]:
    """folder: contains result.json and scene.completed.json. Raises OSError or BreachlineError."""
    result, scene = read_json(folder / RESULT), read_json(folder / SCENE)
    with contents_of(folder, "give a folder of lem_tool"):
        return [_section_with_surfaces(scene, result)] + ([_safety_against_depth(result)] if "stages" in result else []) + \
            ([_safety_against_time(result)] if len(result.get("after_shaking", [])) > 1 else [])


def line_of(points: Sequence[Sequence[float]], name: str) -> Series:
    """Through [[x, y], ...]."""
    return Series(name, [float(each[0]) for each in points], [float(each[1]) for each in points])


def critical_surface(scene: Document, result: Document | None) -> Series | None:
    """None: the result has no critical surface."""
    return _answer(result, _floor_of(scene), _with_factor("slip surface", result)) if result and "circle" in result else None


def _floor_of(scene: Document) -> Any:
    return (scene.get("lem") or {}).get("floor") or []


def _safety_against_depth(result: Document) -> Figure:
    stages, critical = result["stages"], result["critical_depth"]
    curve = Series("least", [each["liquefied_depth"] for each in stages], [each["factor_of_safety"] for each in stages], "line_and_points")
    return Figure("safety_against_depth", Chart("Factor of safety against liquefied depth", Axis("liquefied depth [m]"), Axis("factor of safety [-]"),
                                                [curve], [Mark("y", 1.0, "FS = 1"), Mark("x", critical, f"critical {critical:.3g} m")]))


def _safety_against_time(result: Document) -> Figure:
    rows = result["after_shaking"]
    curve = Series("least", [each["time"] for each in rows], [each["factor_of_safety"] for each in rows], "line_and_points")
    return Figure("safety_against_time", Chart("Factor of safety with the strengths of the snapshots", Axis("time since the shaking began [s]"),
                                               Axis("factor of safety [-]"), [curve], [Mark("y", 1.0, "FS = 1")]))


def _above(floor: Any, arc: Array) -> Array:
    """The surface with the floor in place of the arc below it. Where both meet, and at the floor's kinks, it has corners. arc: [n, 2]."""
    if not floor:
        return arc
    turned = arc[0, 0] > arc[-1, 0]
    x, y = (arc[::-1] if turned else arc).T
    kinks, levels = np.array(floor, float).T
    places = np.union1d(x, kinks[(kinks > x[0]) & (kinks < x[-1])])
    over = np.interp(places, x, y) - np.interp(places, kinks, levels)
    meets = np.flatnonzero(over[:-1] * over[1:] < 0.0)
    crossings = places[meets] + np.diff(places)[meets] * over[meets] / (over[meets] - over[meets + 1])
    places = np.union1d(places[np.isin(places, x) | (over <= 0.0)], crossings)
    line = np.stack([places, np.maximum(np.interp(places, x, y), np.interp(places, kinks, levels))], axis=1)
    return np.asarray(line[::-1] if turned else line)


def _answer(facts: Document, floor: Any, name: str) -> Series:
    """The lower arc between the surface's ends, 60 chords; follows the floor where that is higher."""
    centre, radius = np.array(facts["circle"]["center"], float), facts["circle"]["radius"]
    ends = np.clip([(facts[end][0] - centre[0]) / radius for end in ("entry", "exit")], -1.0, 1.0)
    first, last = -np.arccos(ends)
    angle = np.linspace(first, last, 61)  # an end on the floor has the angle of the arc below it
    arc = centre + radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return Series(name, *_above(facts.get("floor", floor), arc).T)


def _with_factor(name: str, facts: Document) -> str:
    return f"{name}, FS {round(facts['factor_of_safety'], 3):.6g}"


def _other_kinds(facts: Document, floor: Any) -> list[Series]:
    """The other kinds of surface that were analysed."""
    answer, others = facts.get("surface", "circle"), []
    for key, surface, words in (("bishop", "circle", "circle"), ("composite", "composite", "along weak layer")):
        if facts.get(key) and surface != answer:
            others.append(_answer(facts[key], floor, _with_factor(words, facts[key])))
    for key, words in (("non_circular", "non-circular"), ("given_polyline", "given polyline")):
        if facts.get(key):
            others.append(line_of(facts[key]["points"], _with_factor(words, facts[key])))
    return others


def _clipped(ring: Array, inside: Array) -> Array:
    """The part of a polygon where `inside` [corners] is positive."""
    following, then = np.roll(ring, -1, axis=0), np.roll(inside, -1)
    cut = [p + (q - p) * (a / (a - b)) if a * b < 0.0 else None for p, q, a, b in zip(ring, following, inside, then)]
    kept = [corner for p, a, other in zip(ring, inside, cut) for corner in ([p] if a >= 0.0 else []) + ([other] if other is not None else [])]
    return np.array(kept).reshape(-1, 2)


def _section_with_surfaces(scene: Document, result: Document) -> Figure:
    """Shows only the part where soil slides, so that one scale suffices."""
    floor, stages = _floor_of(scene), result.get("stages") or []
    surfaces = [_answer(result, floor, "critical")] if not stages and "circle" in result else []
    for stage in stages:
        if "circle" not in stage:
            continue
        surface = _answer(stage, floor, _with_factor(f"{stage['liquefied_depth']:.3g} m liquefied", stage))
        last = surfaces[-1] if surfaces else Series("", [], [])
        if not (np.array_equal(surface.x, last.x) and np.array_equal(surface.y, last.y)):  # a deeper layer may not change it
            surfaces.append(surface)
    surfaces += _other_kinds(stages[0] if stages else result, floor)

    low, high = (min(min(each.x) for each in surfaces), max(max(each.x) for each in surfaces)) if surfaces else (-1e9, 1e9)
    low, high = low - 0.25 * (high - low), high + 0.25 * (high - low)
    series = []
    for region in scene["section"]["regions"]:
        ring = np.array(region["polygon"], float)[:-1]
        ring = _clipped(ring, ring[:, 0] - low)
        ring = _clipped(ring, high - ring[:, 0])
        if len(ring):
            series.append(Series(region["name"], ring[:, 0], ring[:, 1], "area"))
    if water := ((scene.get("lem") or {}).get("water") or {}).get("line"):
        x, y = np.array(water, float).T
        places = np.union1d(x[(x > low) & (x < high)], np.clip([low, high], x[0], x[-1]))
        series.append(Series("phreatic line", places, np.interp(places, x, y)))
    return Figure("section_with_critical_surfaces",
                  Chart("Section and critical surfaces", Axis("x [m]"), Axis("y [m]"), series + surfaces, equal=True))
