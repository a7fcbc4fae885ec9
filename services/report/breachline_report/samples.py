"""What the samples of a study over distributions say, as the service found it (uncertainty.json)."""
from __future__ import annotations

import math

from .document import Json
from .run import Phase, Run, mpm
from .words import at_least, entry, number, or_dash, rounded

_words = {"runout": "Runout: 99 % of the mobile soil, from the toe", "runout_beyond_toe": "Of what passed the toe, 99 %",
          "runout_largest": "Farthest point", "area_beyond_toe": "Deposit beyond the toe, per metre of width",
          "factor_of_safety": "Factor of safety, nothing liquefied", "factor_of_safety_liquefied": "Factor of safety, every layer liquefied that may"}


def quantities_of(answer: Json) -> list[str]:
    """The one requested first, then the others."""
    return sorted(map(str, answer["quantities"]), key=lambda name: bool(name != answer["quantity"]))


def label_of(quantity: Json, name: str) -> str:
    unit = quantity["unit"]
    return _words.get(name, name) + (f" [{unit}]" if unit and unit != "1" else "")


def words_of(name: str) -> str:
    return _words.get(name, name)


def percentile_in(quantity: Json, p: float) -> Json:
    """{"p", "value", "low", "high"}; None: too few samples."""
    found = quantity["percentiles"]
    return next((each for each in found if each["p"] == p and each.get("value") is not None), None) if isinstance(found, list) else None


def why_no_percentile(quantity: Json, p: float) -> str:
    found = quantity["percentiles"]
    if isinstance(found, dict):
        return str(found.get("refused", "not known"))
    needs = [f", {each['needs']} are needed" for each in quantity.get("percentiles_lacking", []) if each["p"] == p]
    return f"{quantity['count']} samples are not enough" + "".join(needs)


def percentile_text(quantity: Json, p: float) -> str:
    """38.5 (32.6 to 45.5), each marked where it is a lower bound; without a percentile, the reason."""
    found = percentile_in(quantity, p)
    if not found:
        return why_no_percentile(quantity, p)
    value, low, high = (marked(quantity, found[key]) for key in ("value", "low", "high"))
    return f"{value} ({low} to {high})"


def marked(quantity: Json, value: float) -> str:
    bound = number(quantity, "/bound_from")
    return (at_least if bound is not None and value >= bound else "") + rounded(value, 3)


def known_of(quantity: Json) -> str:
    return f"{quantity['count']} of {quantity['of']} samples"


def sampled_runouts(run: Run) -> list[Phase]:
    """With a result, in the order of the samples."""
    by_variant = {each.variant: each for each in run.of(mpm) if each.result}
    return [by_variant[row["sample"]] for row in run.uncertainty["rows"] if row["sample"] in by_variant]


def percentiles_of(run: Run, pointer: str, absent: float) -> list[str]:
    """p50, p10 and p90 of an entry of the samples' results, and how many have it. A missing entry counts as `absent`: infinity for a
    time, 0 for a depth, which grows while soil moves. So every sample with a runout counts, and the service has said of the runout which
    percentiles that number of samples allows."""
    runouts = sampled_runouts(run)
    of_runout = entry(run.uncertainty, "/quantities/runout", {"percentiles": {"refused": "no sample has a runout"}})
    found = [number(each.result, pointer) for each in runouts]
    values = sorted(absent if each is None else each for each in found)
    moving = [absent if value is None else value for value, each in zip(found, runouts) if each.still_moves and math.isfinite(absent)]
    texts = []
    for p in (50.0, 10.0, 90.0):
        if not percentile_in(of_runout, p):
            texts.append(why_no_percentile(of_runout, p))
            continue
        place = (len(values) - 1) * p / 100.0
        low, high = values[math.floor(place)], values[math.ceil(place)]
        value = low if low == high else low + (place - math.floor(place)) * (high - low)
        texts.append("not by the end" if not math.isfinite(value) else (at_least if moving and min(moving) <= value else "") + rounded(value, 3))
    return texts + [str(sum(each is not None for each in found))]


def value_found(inverse: Json) -> str:
    """Of a back-analysis; marked where nearby results are lower bounds."""
    return {"at_least": at_least, "at_most": "\u2264 "}.get(inverse["bound"], "") + or_dash(inverse["value"])


def ends_of(each: Json, low: str, high: str) -> str:
    """0.1 to 0.3; "-" if they are not numbers."""
    return "-" if each.get(low) is None else f"{each[low]:.2g} to {each[high]:.2g}"
