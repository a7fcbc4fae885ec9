"""The dam-breach assessment (GISTM 2.3; CDA 2021) of a study over distributions: the page for a regulator, the data behind it, and the chapter of
a study that searches the value that gives a known result."""
from __future__ import annotations

import hashlib
import math
import re

from breachline.plot import Axis, Chart, Figure, Mark, Series
from breachline.plot.uncertainty import envelope_figures, exceedance_figure, tornado_figure

from ..document import Chapter, Document, Json, Table
from ..ended import bounded, entanglements_of
from ..paper import Paper
from ..run import Run, fem, lem
from ..samples import (ends_of, known_of, label_of, percentile_in, percentile_text, percentiles_of, quantities_of, sampled_runouts, value_found,
                       why_no_percentile, words_of)
from ..words import at_least, counted, entry, number, or_dash, rounded
from . import Material
from .flow import history_of

_most_rows = 100  # of a printed table


# ---------------------------------------------------------------- what fails, when, how far


def _safety_of(run: Run) -> str:
    """; factor of safety 0.95 to 1.42 (63 of 64 analyses); empty: none is known."""
    analyses = run.of(lem)
    factors = sorted(factor for each in analyses if (factor := number(each.result, "/factor_of_safety")) is not None)
    if not factors:
        return ""
    if len(analyses) == 1:
        return f"; factor of safety {factors[0]:.3g}" + (f" ({analyses[0].variant})" if analyses[0].variant else "")
    largest = f" to {factors[-1]:.3g}" if len(factors) > 1 else ""
    return f"; factor of safety {factors[0]:.3g}{largest} ({len(factors)} of {len(analyses)} analyses)"


def _what_fails(run: Run) -> str:
    liquefied, end = entry(run.scene, "/transfer/liquefied"), entanglements_of(run.of(fem))
    regions = ", ".join(entry(liquefied, "/regions", []))
    text = run.title + ("" if liquefied is None else "; soil liquefies" + (f" in {regions}" if regions else ""))
    return f"{text}. {end}" if end else text + _safety_of(run) + "."


def _when_it_fails(run: Run) -> str:
    times = sorted(each.time for each in sampled_runouts(run) if each.time is not None)
    if not times:
        return "Not applicable: a static scene. Times below count from the start of the runout."
    last = f" to {times[-1]:.6g}" if times[-1] > times[0] else ""
    return (f"The failing mesh becomes material points at t_T = {times[0]:.6g}{last} s after the beginning of the "
            f"{'shaking' if run.is_shaken else 'dynamic analysis'}. Times below count from t_T.")


def _breach_text(width: Json) -> str:
    """30 m (20 to 50 m): one number, or [low, best, high]."""
    return f"{width[1]:.6g} m ({width[0]:.6g} to {width[2]:.6g} m)" if isinstance(width, list) else f"{width:.6g} m"


def _answers(run: Run) -> Table:
    table = Table("assessment", "How far, when, how deep, how fast", ["what", "p50", "p10", "p90", "rests on"], [],
                  "In brackets: the percentile's 90 % interval. \u2265: a lower bound, soil still moved. At a gauge a sample whose flow never "
                  "came is 0 "
                  "deep and arrives after all others.")
    for name in quantities_of(run.uncertainty):
        quantity = run.uncertainty["quantities"][name]
        table.rows.append([label_of(quantity, name), *(percentile_text(quantity, p) for p in (50, 10, 90)), known_of(quantity)])
    planned = run.uncertainty["samples"]["planned"]

    def add(what: str, pointer: str, absent: float = 0.0, came: str = "") -> None:
        *percentiles, count = percentiles_of(run, pointer, absent)
        table.rows.append([what, *percentiles, f"{count} of {planned} samples{came}"])

    for gauge in entry(run.scene, "/mpm/gauges", []):
        where, at = f"Gauge {gauge['name']} (x = {gauge['x']:.6g} m): ", f"/gauges/{gauge['name']}/"
        add(where + "arrival [s]", at + "arrival_time", math.inf, ": there the flow came")
        add(where + "largest depth [m]", at + "largest_depth")
        add(where + "largest velocity [m/s]", at + "largest_velocity")
    width = entry(run.scene, "/mpm/breach_width")
    for section in entry(run.scene, "/mpm/sections", []):
        where, at = f"Section {section['name']} (x = {section['x']:.6g} m): ", f"/sections/{section['name']}/"
        add(where + "volume passed [m3 per m of width]", at + "volume")
        add(where + "largest discharge [m3/s per m of width]", at + "largest_discharge")
        if width is not None:
            add(f"{where}volume through a breach of {_breach_text(width)} [m3]", at + "breach/volume/1")
            add(f"{where}largest discharge through a breach of {_breach_text(width)} [m3/s]", at + "breach/largest_discharge/1")
    return table


# ---------------------------------------------------------------- assumptions and limits


def _distribution(parameter: Json) -> str:
    if parameter["kind"] == "numerical":
        return "the lattice of material points: the method's own scatter"
    distribution = parameter.get("distribution")
    if not distribution:
        return "one of several, by their weights"
    return ", ".join([distribution["type"].replace("_", " ")]
                     + [f"{key} {value:.6g}" for key, value in sorted(distribution.items()) if isinstance(value, (int, float))])


def _assumptions(run: Run) -> Table:
    table = Table("assessment_parameters", "What is taken as uncertain", ["parameter", "sets", "distribution", "only between",
                                                                          "asked rank correlation"], [],
                  "All else is as the scene says (chapter of inputs), as if it were known.")
    for each in run.uncertainty["parameters"]:
        entries, between = each.get("entries") or [], each.get("between")
        sets = ("a factor on " if each["kind"] == "factor" else "") + ", ".join(entries[:3]) \
            + (f" and {len(entries) - 3} more" if len(entries) > 3 else "")
        table.rows.append([each["name"], sets if entries else "-", _distribution(each),
                           f"{between[0]:.6g} and {between[1]:.6g}" if between else "-",
                           ", ".join(f"{other} {value:.6g}" for other, value in (each.get("asked_correlation") or {}).items()) or "-"])
    return table


def cases_of(run: Run) -> Table:
    liquefies = entry(run.scene, "/transfer/liquefied") is not None
    keeps = not liquefies and not run.is_static
    which = "" if liquefies or keeps else ("Whether this static scene is 2A or 2B depends on whether its strengths are those of liquefied soil, "
                                           "which "
                                           "the scene does not state. ")
    return Table("assessment_cases", "Which cases of CDA (2021) this can answer", ["case", "free pond at the breach", "tailings liquefy", "covered",
                                                                                   "because"],
                 [["1A", "yes", "yes", "no", "a pond that erodes the breach and carries tailings away is not in the model"],
                  ["1B", "yes", "no", "no", "the same: erosion by water is the process, and it is absent"],
                  ["2A", "no", "yes", "yes: this run" if liquefies else "yes",
                   "liquefied soil flows until its residual strength and viscosity stop it"],
                  ["2B", "no", "no", "yes: this run" if keeps else "yes", "a slope that fails and slumps with the strength that it keeps"]],
                 which + "Canadian Dam Association (2021), Technical Bulletin: Tailings Dam Breach Analysis. A dam with a pond needs an analysis "
                         "of its "
                 "release beside this one. Nor is there a channel or a valley that narrows: plane strain, so that no flow spreads or is confined "
                 "sideways, and volumes are per metre of width.")


# ---------------------------------------------------------------- error, cost, origin


def _error(run: Run, name: str) -> Table:
    """The spread of results beside the error of one run, and the cost of the samples."""
    quantity, runouts = run.uncertainty["quantities"][name], sampled_runouts(run)
    low, high = percentile_in(quantity, 10), percentile_in(quantity, 90)
    known = [(each.error, each.error_from) for each in runouts if each.error is not None]
    cpu = sum(number(each.result, "/cpu_seconds") or 0.0 for each in runouts)
    why_not = next((each.error_from for each in runouts if each.error_from), "no accuracy study of an equal scene (breach accuracy)")
    unit = label_of(quantity, name).removeprefix(words_of(name))
    return Table("assessment_error", "Error against run time", ["what", "value", "from"], [
        [f"spread of {name}, p10 to p90{unit}", rounded(high["value"] - low["value"], 3) if low and high else "not known",
         "the samples" if low and high else why_no_percentile(quantity, 90)],
        ["largest known error of one runout [m]", rounded(max(error for error, _ in known), 2) if known else "not known",
         f"{len(known)} of {len(runouts)} samples: {known[-1][1]}" if known else why_not],
        ["CPU seconds of one sample's runout, mean", rounded(cpu / len(runouts), 3) if runouts else "-",
         "the results, also of those taken from an earlier run"],
        ["CPU seconds of all samples' runouts", rounded(cpu, 4), "the same"]],
        "An error of the numerics as large as the spread over the parameters would make the spread meaningless.")


def _origin(run: Run) -> Table:
    table = Table("assessment_origin", "Where every number comes from", ["what", "which"], [],
                  "Of each sample the export holds settings, logs and files with their SHA-256 (tasks/).")
    if run.about.get("id"):
        table.rows.append(["run", f"{run.about['id']}, {run.name}"])
    versions: dict[str, set[str]] = {}
    for each in run.phases:
        if each.result:
            versions.setdefault(each.program, set()).add(str(entry(each.result, "/provenance/version", "not known")))
    table.rows += [[program, "; ".join(sorted(known))] for program, known in sorted(versions.items())]
    table.rows.append(["samples", f"{run.uncertainty.get('sampling') or 'not known'}, seed {run.uncertainty.get('seed', 'not known')}"])
    table.rows += [[f"{name}, SHA-256", hashlib.sha256((run.folder / name).read_bytes()).hexdigest()] for name in
                   ("study.json", "uncertainty.json", "envelopes.json", "results.json") if (run.folder / name).is_file()]
    return table


def _page(run: Run, name: str) -> Chapter:
    samples, parameters = run.uncertainty["samples"], run.uncertainty["parameters"]
    return Chapter("Dam-breach assessment", f"From {samples['done']} of {counted(samples['planned'], 'sample')} of "
                   f"{counted(len(parameters), 'uncertain parameter')}.", tables=[
                       Table("assessment_what", "What fails, and when", ["question", "answer"],
                             [["What fails", _what_fails(run)], ["When", _when_it_fails(run)]]),
                       _answers(run), _assumptions(run), _error(run, name), _origin(run)],
                   cautions=run.uncertainty["cautions"]
                   + ["Percentiles are over the parameters named below, as they are distributed there, and over nothing else. They leave out what "
                      "the "
                      "model leaves out (table of CDA's cases)."])


# ---------------------------------------------------------------- the data behind it


def _published(paper: Paper | None, name: str) -> list[Mark]:
    if not paper or not name.startswith("runout"):
        return []
    observed = re.search(r"[0-9.]+", paper.case_history_runout_m)
    return [Mark("x", each["value"], f"published: {each['value']:.6g} m") for each in paper.values if each["key"] == "plateau_runout:softened"] \
        + ([Mark("x", float(observed[0]), f"observed: {paper.case_history_runout_m} m")] if observed else [])


def _hydrographs(run: Run, name: str) -> list[Figure]:
    """Discharge at every section of the samples whose result lies nearest to p50 and to p90."""
    figures = []
    samples = [(value, each) for each in sampled_runouts(run) if (value := number(each.result, "/" + name)) is not None]
    for p in (50, 90):
        wanted = percentile_in(run.uncertainty["quantities"][name], p)
        if not wanted or not samples:
            continue
        value, nearest = min(samples, key=lambda pair: abs(pair[0] - float(wanted["value"])))
        found = [series for each in entry(run.scene, "/mpm/sections", [])
                 for series in history_of(nearest, each["name"], "time", f"section.{each['name']}.discharge")]
        figures.append(Figure(
            f"hydrographs_p{p}", Chart(f"Discharge at the sections, sample nearest to p{p}", Axis("time [s]"),
                                       Axis("discharge [m3/s per m of width]"), found),
            f"Sample {nearest.variant}, with {name} of {bounded(nearest, rounded(value, 4))}: one run, no envelope. The hydrograph of a "
            f"percentile of "
            "the runout is not the percentile of the hydrographs."))
    return figures


def _percentiles(run: Run) -> Table:
    table = Table("assessment_percentiles", "Percentiles",
                  ["quantity", "samples", "mean", "standard deviation", "p5", "p10", "p50", "p90", "p95"], [],
                  "In brackets: 90 % intervals. Mean and standard deviation of distances that are lower bounds in part are too small.")
    for name in quantities_of(run.uncertainty):
        quantity = run.uncertainty["quantities"][name]
        bound = at_least if quantity.get("bound_from") is not None else ""
        table.rows.append([label_of(quantity, name), f"{quantity['count']} of {quantity['of']}", bound + or_dash(quantity["mean"]),
                           or_dash(quantity["sd"]), *(percentile_text(quantity, p) for p in (5, 10, 50, 90, 95))])
    return table


def _importance(quantity: Json, name: str) -> Table:
    found = quantity["importance"] if isinstance(quantity["importance"], list) else []
    return Table("assessment_importance", f"What decides {name}", ["parameter", "rank correlation", "its interval", "partial", "share of the "
                                                                                                                               "variance",
                                                                   "its interval"],
                 [[each["parameter"], or_dash(each.get("rank_correlation"), 2), ends_of(each, "low", "high"),
                   or_dash(each.get("partial_rank_correlation"), 2), or_dash(each.get("first_order"), 2),
                   ends_of(each, "first_order_low", "first_order_high")] for each in found],
                 "An interval that contains 0: the parameter may have no effect. The share is what the parameter explains alone. Options of a "
                 "choice and "
                 "lattices have no order, and so no rank correlation.")


def _samples(run: Run, name: str) -> Table:
    parameters = [each["name"] for each in run.uncertainty["parameters"]]
    grows = run.uncertainty["quantities"][name].get("bound_from") is not None
    moving = {each.variant for each in sampled_runouts(run) if each.still_moves and grows}
    table = Table("assessment_samples", "The samples", ["sample", "state", *parameters, name])
    for row in run.uncertainty["rows"]:
        value = or_dash(entry(row, f"/results/{name}"), 4)
        drawn = [row["values"].get(each) for each in parameters]
        table.rows.append([row["sample"], row["state"], *(each if isinstance(each, str) else or_dash(each, 4) for each in drawn),
                           (at_least if row["sample"] in moving and value != "-" else "") + value])
    return table


def _basis(of: Material, name: str, document: Document) -> Chapter:
    run, quantity = of.run, of.run.uncertainty["quantities"][name]
    label = label_of(quantity, name)
    exceedance, tornado = exceedance_figure(quantity, label, quantity.get("bound_from")), tornado_figure(quantity, label)
    exceedance.chart.marks += _published(of.paper, name)
    figures = [exceedance] + ([tornado] if tornado else [])
    if not tornado:
        document.leave_out("tornado: one parameter at a time", quantity["tornado"]["refused"])
    if run.envelopes:
        figures += envelope_figures(run.envelopes)
    else:
        document.leave_out("depth, velocity and arrival along x over the samples", "the folder has no envelopes.json")
    tables = [_percentiles(run), _importance(quantity, name), Table(
        "assessment_left_out", "Samples without a result", ["sample", "state", "why"],
        [[each["sample"], each["state"], each.get("reason") or "-"] for each in run.uncertainty["samples"]["left_out"]])]
    if len(run.uncertainty["rows"]) <= _most_rows:
        tables.append(_samples(run, name))
    else:
        document.leave_out("the table of all samples", f"it has more than {_most_rows} rows; they stand in uncertainty.json")
    return Chapter("Basis of the assessment", "", figures + _hydrographs(run, name), tables)


# ---------------------------------------------------------------- back-analysis


def _unit_of(inverse: Json) -> str:
    return f" [{inverse['unit']}]" if inverse["unit"] not in ("", "1") else ""


def _back_analysis(run: Run) -> Chapter:
    """Which value of a parameter gives a known result."""
    inverse = run.uncertainty["inverse"]
    label, steps = words_of(inverse["quantity"]) + _unit_of(inverse), inverse["steps"]
    known = [each for each in steps if each["result"] is not None]
    values = [each["value"] for each in known]
    means = Series("mean of the lattices, from the least to the largest", values, [each["result"] for each in known], "line_and_points",
                   ["lower bound" if each["lower_bounds"] else "certain" for each in known],
                   low=[min(each["results"]) for each in known], high=[max(each["results"]) for each in known])
    marks = [Mark("y", inverse["target"], "asked")] + ([Mark("x", inverse["value"], value_found(inverse))] if inverse["value"] is not None else [])
    figure = Figure("back_analysis", Chart("Result against the value", Axis(inverse["vary"], bool(values) and values[0] > 0.0), Axis(label),
                                           [means] if known else [], marks), "Dashed: the target. All other parameters have their medians.")
    table = Table("back_analysis_steps", "Values that were run", [inverse["vary"], label, "of its lattices", "lower bounds", "state"], [
        [or_dash(each["value"], 4), (at_least if each["lower_bounds"] else "") + or_dash(each["result"], 4),
         "; ".join(or_dash(result, 4) for result in each["results"]) or "-", f"{each['lower_bounds']} of {len(each['results'])}", each["state"]]
        for each in steps])
    return Chapter("Back-analysis", " ".join(run.uncertainty["sentences"]), [figure], [table], cautions=[
        "The value makes this model give the result: it holds what the model leaves out (see the limits on the first page), and is no strength "
        "that was "
        f"measured. Only {inverse['vary']} was moved; another parameter moved as well gives another value."])


def add(of: Material, document: Document) -> None:
    run = of.run
    if not run.uncertainty:
        if "uncertainty" in run.study:
            document.leave_out("dam-breach assessment", "the folder has no uncertainty.json: export the run again")
    elif run.is_back_analysis:
        document.add(_back_analysis(run))
    elif names := quantities_of(run.uncertainty):
        document.add(_page(run, names[0]))
        document.add(_basis(of, names[0], document))
    else:
        document.leave_out("dam-breach assessment", "no sample has a result")


def sampled_answer(run: Run) -> list[list[str]]:
    """The first page's row from the samples; none for any other run."""
    if run.is_back_analysis:
        inverse = run.uncertainty["inverse"]
        return [[f"{inverse['vary']} for {words_of(inverse['quantity'])} of {inverse['target']:.4g} {inverse['unit']}", value_found(inverse),
                 f"{or_dash(inverse['low'])} to {or_dash(inverse['high'])}", "by the scatter of lattices alone; chapter \"Back-analysis\""]]
    if not run.uncertainty or not quantities_of(run.uncertainty):
        return []
    name = quantities_of(run.uncertainty)[0]
    quantity = run.uncertainty["quantities"][name]
    return [[f"{label_of(quantity, name)}, over the samples", f"p50: {percentile_text(quantity, 50)}",
             f"p10: {percentile_text(quantity, 10)}; p90: {percentile_text(quantity, 90)}",
             f"{known_of(quantity)}; chapter \"Dam-breach assessment\""]]
