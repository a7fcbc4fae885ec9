"""Figures of a study over distributions, from the service's statistics."""
from __future__ import annotations

import math
from typing import Any

import numpy as np

from .chart import Axis, Chart, Figure, Mark, Series

Document = dict[str, Any]

_ALONG_X = {"largest_depth": "Largest depth", "largest_velocity": "Largest depth-averaged velocity",
            "largest_momentum_flux": "Largest momentum flux h v2", "arrival": "First arrival", "time_of_peak": "Time of the largest depth", "final_depth": "Final deposit"}


def exceedance_figure(quantity: Document, label: str, bound_from: float | None) -> Figure:
    """The exceedance probability as steps, with its band. label: of the quantity, with its unit; bound_from: least value of a sample that still
    moved at its end."""
    steps, before = [], None
    for each in quantity["exceedance"]:
        if before:
            steps.append((each["value"], before))  # the share is constant up to the next value
        steps.append((each["value"], each))
        before = each
    low, y, high = ([at[key] for _, at in steps] for key in ("low", "probability", "high"))
    curve = Series(f"{quantity['count']} of {quantity['of']} samples", [x for x, _ in steps], y, low=low, high=high)
    # With 90 % confidence at most this share of all values is above the largest of n samples.
    beyond = 100.0 * (1.0 - 0.1 ** (1.0 / quantity["count"]))
    figure = Figure("exceedance", Chart("Probability of more", Axis(label), Axis("probability of more [-]"), [curve]),
                    "Share of the samples that exceed a value, with its 90 % interval. Larger values are possible: up to "
                    f"{beyond:.2g} % of them may lie beyond the largest sample (90 % confidence).")
    if bound_from is not None:
        figure.chart.marks.append(Mark("x", bound_from, "from here a lower bound"))
        figure.caption += " From the mark on the curve is a lower bound: samples were stopped there while their soil still moved."
    return figure


def tornado_figure(quantity: Document, label: str) -> Figure | None:
    """One bar per parameter, the longest on top. None: the surrogate was refused."""
    tornado = quantity["tornado"]
    if "refused" in tornado:
        return None
    middle = tornado["at_median"]
    bars = sorted(tornado["bars"], key=lambda bar: float(np.ptp([bar["p10"], bar["p90"], middle])))
    at = np.repeat(np.arange(len(bars)), 2)
    series = [Series(f"parameter at its {key}", [x for bar in bars for x in (middle, bar[key])], at, "bars")
              for key in ("p10", "p90")]
    return Figure("tornado", Chart("One parameter at a time", Axis(label), Axis("", names=[bar["parameter"] for bar in bars]), series,
                                   [Mark("x", middle, "all at their medians")]),
                  f"From a surrogate fitted to the samples, Q2 = {tornado['q2']:.2g} by cross-validation: each parameter from its p10 to its p90, "
                  "the others at their medians. It is the surrogate's answer, not a run's.")


def envelope_figures(envelopes: Document) -> list[Figure]:
    """p50 along x between p10 and p90; one figure per quantity of envelopes.json that has a number."""
    figures = []
    for quantity, words in _ALONG_X.items():
        band = envelopes["bands"].get(quantity)
        if band is None:
            continue
        x = envelopes["x"]
        series = [each for each in (_median_of(x, band), _percentile(x, band, "p10"), _percentile(x, band, "p90")) if len(each.x)]
        if not series:
            continue
        came = (". One that the flow never came to arrives after all others, so that a percentile ends where too few came; "
                f"at the far end {min(band['rests_on'])} did."
                if band["unit"] == "s" else "; where the flow of a sample never came it is 0 there.")
        figures.append(Figure(f"envelope_{quantity}", Chart(f"{words} along x", Axis("x [m]"), Axis(f"{words} [{band['unit']}]"), series),
                              f"Over {envelopes['samples']} samples" + _without_envelope(envelopes) + came))
    return figures


def _without_envelope(envelopes: Document) -> str:
    """" of 64", and that the other samples are excluded; "": there are no others."""
    others = len(envelopes.get("left_out") or [])
    return f" of {envelopes['samples'] + others} (the percentiles leave out the others, such as dams that did not fail)" if others else ""


def _percentile(x: list[float], band: Document, name: str) -> Series:
    known = [(at, value) for at, value in zip(x, band[name]) if value is not None]
    return Series(name, [at for at, _ in known], [value for _, value in known])


def _median_of(x: list[float], band: Document) -> Series:
    """p50 where it exists. The line ends where it is missing: the flow does not arrive in half of the samples."""
    series = _percentile(x, band, "p50")
    series.name = "p50, between p10 and p90"
    ends = [(low, high) if low is not None and high is not None else (math.nan, math.nan)
            for low, high, p50 in zip(band["p10"], band["p90"], band["p50"]) if p50 is not None]
    series.low, series.high = [low for low, _ in ends], [high for _, high in ends]
    return series
