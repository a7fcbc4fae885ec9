"""Figures of a whole run, for notebooks and pages: one call each."""
from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

from ..frames import Frame
from ..run import Run
from .chart import Axis, Certainty, Chart, Figure, Series
from .points import stride_of


def runouts(run: Run) -> Figure:
    """Runout against transfer time, one line per variant, with what is known of each value: its error, a lower bound, questionable.
    Of a study without transfers the runout of each variant."""
    rows = [row for row in run.results if row.get("runout") is not None]
    title, y = f"Runout of {run.name}", Axis("runout [m]")
    if not rows or any(row.get("transfer_time") is not None for row in rows):
        return Figure("runout_against_transfer_time", Chart(title, Axis("transfer time t_T [s]"), y, runout_series(rows)))
    names = [str(row.get("variant") or run.name) for row in rows]
    series = [replace(each, style="points") for each in runout_series({**row, "variant": "", "transfer_time": k} for k, row in enumerate(rows))]
    return Figure("runout_of_variants", Chart(title, Axis("variant", names=names), y, series))


def runout_series(rows: Iterable[dict[str, Any]]) -> list[Series]:
    """rows: of a run's results or means; those without a runout or a transfer time are left out."""
    by_variant: dict[str, list[dict[str, Any]]] = {}
    for row in rows:
        if row.get("runout") is not None and row.get("transfer_time") is not None:
            by_variant.setdefault(row.get("variant") or "", []).append(row)
    series = []
    for variant, own in by_variant.items():
        own.sort(key=lambda row: float(row["transfer_time"]))
        errors = [float("nan") if row.get("runout_error") is None else row["runout_error"] for row in own]
        series.append(Series(variant or "runout", [row["transfer_time"] for row in own], [row["runout"] for row in own], "line_and_points",
                             [_certainty(row) for row in own], error=errors if any(each == each for each in errors) else ()))
    return series


def moved(frames: Sequence[Frame]) -> Figure:
    """The material points of the first and of the last frame."""
    series = []
    for each in (frames[0], frames[-1]):
        picked = each.position[::stride_of(each)]
        series.append(Series(f"at {each.time:.4g} s", picked[:, 0], picked[:, 1], "dots"))
    return Figure("moved", Chart("Material points, first and last", Axis("x [m]"), Axis("y [m]"), series, equal=True))


def _certainty(row: dict[str, Any]) -> Certainty:
    return "lower bound" if row.get("lower_bound") else "questionable" if row.get("questionable") else "certain"
