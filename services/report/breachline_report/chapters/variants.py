"""The changes of each variant of a study, and their effect: one row per variant."""
from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from statistics import median

from breachline.plot import Axis, Chart, Figure, Mark, Series

from ..document import Chapter, Document, Json, Table
from ..ended import any_moves, bounded, certainty_of, how_it_ended, how_they_ended
from ..measures import Plateau, Window, plateau_of, window_of
from ..run import Phase, Run, fem, lem, mpm
from ..words import at_least, fact, number, rounded
from . import Material

_materials = "/materials/"


def changes_of(overrides: Sequence[str]) -> str:
    """/materials/{a, b}/viscosity=0; /mpm/cell_size=1: the same entry of several materials is one change."""
    groups: dict[str, list[tuple[str, str]]] = {}  # entry -> material and value
    for each in overrides:
        pointer, value = each.split("=", 1)
        name, slash, rest = pointer.removeprefix(_materials).partition("/")
        of_material = pointer.startswith(_materials) and slash
        groups.setdefault(slash + rest if of_material else pointer, []).append((name if of_material else "", value))
    texts = []
    for what, found in groups.items():
        names, values = [name for name, _ in found], list(dict.fromkeys(value for _, value in found))
        if len(values) > 1:
            values = [value for _, value in found]
        whose = (_materials + (names[0] if len(names) == 1 else "{" + ", ".join(names) + "}")) if names[0] else ""
        texts.append(f"{whose}{what}={', '.join(values)}")
    return "; ".join(texts) or "nothing"


def _listed(run: Run) -> list[Json]:
    return list(run.study.get("variants", []))


def _median_of(plateau: Plateau | None, pointer: str) -> float | None:
    values = [value for each in plateau.runouts if (value := number(each.result, pointer)) is not None] if plateau else []
    return median(values) if values else None


def _or_dash(value: float | None) -> str:
    return "-" if value is None else rounded(value, 4)


def _row(run: Run, variant: Json, reference: float | None) -> list[str]:
    name, plateau = variant["name"], plateau_of(run, variant["name"])
    bound, runout = bool(plateau and any_moves(plateau.runouts)), _median_of(plateau, "/runout")
    runouts = [each for each in run.of(mpm) if each.variant == name]
    phase, window, end = run.of_variant(fem, name), Window(), "-"
    if phase and phase.telemetry:
        window, end = window_of(run, phase), how_it_ended(phase)
        end = f"at {fact(phase.result, '/end_time')} s" if end == "well" else end

    def distance(value: float | None) -> str:
        return (at_least if bound and value is not None else "") + _or_dash(value)

    comparable = (runout or 0.0) > 0.0 and (reference or 0.0) > 0.0 and not bound
    return [name, changes_of(variant.get("overrides", [])), f"{sum(bool(each.result) for each in runouts)} of {len(runouts)}",
            f"{plateau.first:.6g} to {plateau.last:.6g}" if plateau else "-", distance(runout),
            rounded(100.0 * ((runout or 0.0) / (reference or 1.0) - 1.0), 3) if comparable else "-",
            distance(_median_of(plateau, "/runout_beyond_toe")), distance(_median_of(plateau, "/runout_beyond_toe_95")),
            _or_dash(window.lower), _or_dash(window.upper), end, rounded(sum(number(each.result, "/cpu_seconds") or 0.0 for each in runouts), 3),
            how_they_ended(runouts)]


# ---------------------------------------------------------------- static scenes


def _own(run: Run, program: str, variant: str) -> Phase | None:
    return next((each for each in run.of(program) if each.variant in (variant, "") and each.result), None)


def _static_table(run: Run) -> Table:
    """One row per variant, without transfer time, window and FEM."""
    flows, judged = bool(run.first(mpm)), bool(run.first(lem))
    table = Table("variants", "One thing changed at a time", ["variant", "changed"] + ["factor of safety"] * judged
                  + ["runout [m]", "against the first [%]", "area beyond toe [m2]", "at rest", "end [s]"] * flows + ["how it ended"], [],
                  "Runout: 99 % of the mobile soil, from the toe; negative: before it. \u2265: the soil still moved, a lower bound and compared "
                  "with nothing." if flows else "")
    first = _own(run, mpm, _listed(run)[0]["name"])
    for variant in _listed(run):
        name = variant["name"]
        stability, runout = _own(run, lem, name), _own(run, mpm, name)
        row = [name, changes_of(variant.get("overrides", []))]
        if judged:
            row.append(fact(stability.result if stability else None, "/factor_of_safety"))
        if flows and runout:
            comparable = first and first is not runout and min(first.runout, runout.runout) > 0.0 and not first.still_moves and not runout.still_moves
            row += [bounded(runout, fact(runout.result, "/runout")),
                    rounded(100.0 * (runout.runout / first.runout - 1.0), 3) if first and comparable else "-",
                    bounded(runout, fact(runout.result, "/area_beyond_toe")), fact(runout.result, "/at_rest"), fact(runout.result, "/end_time")]
        elif flows:
            row += ["-"] * 5
        table.rows.append(row + ["; ".join(f"{each.program.split('_')[0]}: {how_it_ended(each)}" for each in run.phases
                                           if each.variant in (name, ""))])
    return table


def _one_parameter(variants: list[Json]) -> tuple[str, list[float]] | None:
    """The one entry that every variant sets to a different number."""
    entries, values = set(), []
    for each in variants:
        if len(each.get("overrides", [])) != 1:
            return None
        pointer, text = each["overrides"][0].split("=", 1)
        try:
            value = json.loads(text)
        except ValueError:
            return None
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            return None
        entries.add(pointer)
        values.append(float(value))
    return (entries.pop(), values) if len(entries) == 1 else None


def _against(run: Run, parameter: tuple[str, list[float]], program: str, pointer: str, name: str, title: str, label: str) -> Figure:
    """A number of each variant's result against the changed parameter."""
    known = [(value, found, number(found.result, pointer)) for value, each in zip(parameter[1], _listed(run))
             if (found := _own(run, program, each["name"])) and number(found.result, pointer) is not None]
    certainty = [certainty_of(found) for _, found, _ in known]
    series = Series(title, [value for value, _, _ in known], [result or 0.0 for _, _, result in known], "line_and_points",
                    [] if set(certainty) <= {"certain"} else certainty)
    return Figure(name, Chart(title, Axis(parameter[0].rsplit("/", 1)[-1]), Axis(label), [series] if known else []),
                  f"Against {parameter[0]}, which alone the variants change.")


# ---------------------------------------------------------------- sensitivity


def _largest_reach(run: Run, variant: str) -> float | None:
    return max((reach for each in run.runouts_of(variant) if (reach := number(each.result, "/runout_beyond_toe")) is not None), default=None)


def _least_factor(run: Run, variant: str) -> float | None:
    found = _own(run, lem, variant)
    return number(found.result, "/factor_of_safety") if found else None


def _sensitivity(run: Run, value_of: Callable[[Run, str], float | None], name: str, title: str, label: str) -> Figure:
    """A tornado: one bar per group of entries that variants change, the longest on top, from the variant that changes nothing."""
    figure = Figure(name, Chart(title, Axis(label), Axis("")),
                    "Each bar: the variants that change the same entries, from the one that changes nothing.")
    written = [each for each in _listed(run) if not each.get("made_by")]
    base = next((each["name"] for each in written if not each.get("overrides")), "")
    middle = value_of(run, base) if base else None
    groups: dict[frozenset[str], dict[str, float]] = {}  # by the entries: variants with their values
    for each in written:
        if each["name"] != base and (value := value_of(run, each["name"])) is not None:
            groups.setdefault(frozenset(text.split("=", 1)[0] for text in each["overrides"]), {})[each["name"]] = value
    if middle is None or len(groups) < 2:
        return figure
    bars = [(min(middle, *found.values()), max(middle, *found.values()), ", ".join(found)) for found in groups.values()]
    bars.sort(key=lambda bar: bar[1] - bar[0])
    figure.chart.y.names = [names for _, _, names in bars]
    at = [k for k in range(len(bars)) for _ in (0, 1)]
    figure.chart.series = [Series(words, [x for bar in bars for x in (middle, (bar[0], bar[1])[end])], at, "bars")
                           for end, words in enumerate(("least", "largest"))]
    figure.chart.marks = [Mark("x", middle, base)]
    return figure


def add(of: Material, document: Document) -> None:
    run, variants = of.run, _listed(of.run)
    if len(variants) < 2 or run.uncertainty:  # samples have their own chapter
        return
    tornados = [_sensitivity(run, _largest_reach, "sensitivity", "What decides the reach", "reach: 99 % of what passed the toe [m]"),
                _sensitivity(run, _least_factor, "sensitivity_of_safety", "What decides the factor of safety", "factor of safety [-]")]
    if run.is_static:
        parameter = _one_parameter(variants)
        document.add(Chapter("Variants", "", [
            _against(run, parameter, mpm, "/runout", "runout_against_parameter", "Runout", "runout [m]"),
            _against(run, parameter, lem, "/factor_of_safety", "safety_against_parameter", "Factor of safety", "factor of safety [-]"),
        ] if parameter else tornados, [_static_table(run)]))
        return
    first = plateau_of(run, variants[0]["name"])
    reference = None if first and any_moves(first.runouts) else _median_of(first, "/runout")
    document.add(Chapter("Variants", "", tornados, [Table(
        "variants", "One thing changed at a time",
        ["variant", "changed", "runouts", "plateau t_T [s]", "runout [m]", "against the first [%]", "beyond toe, 99 % [m]", "beyond toe, 95 % [m]",
         "window opens [s]", "window closes [s]", "FEM ended", "CPU of runouts [s]", "how the runouts ended"],
        [_row(run, each, reference) for each in variants],
        "Runout and distances beyond the toe: medians over the plateau, the transfer times around the largest runout that give at least 75 % of "
        "it; variants that share a FEM share its edges; one that closes before it opens is none. - where nothing ran past the toe. \u2265: soil of "
        "a runout behind it still moved, so it is a lower bound and compared with nothing.")]))
