"""The first page: the question, the results with their uncertainty, and the limits."""
from __future__ import annotations

from pathlib import Path

from breachline.plot import Axis, Chart, Figure, Mark, Series
from breachline.plot.stability import critical_surface, line_of

from .chapters.assessment import sampled_answer
from .chapters.runout import section_at_rest
from .document import Front, Json, Table
from .ended import any_moves, bounded, how_it_ended, range_of
from .paper import Paper
from .run import Phase, Run, fem, lem, mpm, post_seismic, transfer
from .section import crest_of, phreatic_line, profile_of, top_at
from .words import at_least, entry, joined, number, or_dash, rounded, with_error

_most_named = 12  # variants or times in a sentence
_most_gauges = 4
_most_fems = 6  # in rows of their own
_k_h = "/lem/seismic_coefficient"


# ---------------------------------------------------------------- what was asked


def _motion_of(scene: Json) -> str:
    motion = entry(scene, "/fem/motion")
    if not motion:
        return "under its own weight"
    scaled = f" scaled to {motion['scale_to_pga_g']:.4g} g" if "scale_to_pga_g" in motion else ""
    return f"shaken by {Path(motion['file']).name}{scaled}"


def _transfers_of(run: Run) -> str:
    times = list(dict.fromkeys(f"{each.time:.6g}" for each in run.of(transfer) if each.time is not None))
    triggers = [each.get("name") or each.get("kind", "") for each in run.study.get("triggers", [])]
    when = "none" if not times else joined(times) + " s" if len(times) <= _most_named else f"{len(times)} times from {times[0]} to {times[-1]} s"
    return when + (f" (triggers: {joined(triggers)})" if triggers else "")


def _asks_for_runouts(run: Run) -> bool:
    """A study may contain the FEM alone."""
    return bool(run.study.get("triggers") or run.first(mpm))


def _question_of(run: Run) -> str:
    seconds = sum(stage.get("duration", 0.0) for stage in entry(run.scene, "/fem/stages", []))
    if run.first(fem):
        if not _asks_for_runouts(run):
            return (f"Whether and when does the section fail, {_motion_of(run.scene)}? Finite elements for {seconds:.4g} s; nothing is "
                    "transferred.")
        return (f"How far does the soil run out that fails, {_motion_of(run.scene)}? Finite elements for {seconds:.4g} s; their state becomes "
                f"material points at t_T = {_transfers_of(run)}.")
    if run.first(mpm):
        return ("How far does the soil run out from the given section, with the strengths of the scene? A static scene: no earthquake, no "
                f"finite elements; material points fill the section, with the stress \"{entry(run.scene, '/mpm/fill_stress', 'none')}\" at the "
                "start.")
    return "Does the section stand? Limit equilibrium alone, no runout."


def _asked_of(run: Run) -> list[str]:
    asked = [_question_of(run)]
    if run.first(lem) and run.first(mpm):
        asked.append("Its factor of safety beside it, by limit equilibrium.")
    names = [each["name"] for each in run.study.get("variants", []) if not each.get("made_by")]
    if run.is_back_analysis:
        inverse = run.uncertainty["inverse"]
        asked.append(f"Which {inverse['vary']} gives a {inverse['quantity']} of {inverse['target']:.4g} {inverse['unit']}? Back-analysis over "
                     f"{len(inverse['steps'])} values.")
    elif run.uncertainty:
        asked.append(f"How sure is that? {run.uncertainty['samples']['planned']} samples of {len(run.uncertainty['parameters'])} uncertain "
                     "parameters.")
    if len(names) > 1:
        asked.append(f"{len(names)} variants" + (": " + joined(names) if len(names) <= _most_named else "")
                     + ". The chapter of variants lists their changes.")
    if (draws := run.study.get("draws", 1)) > 1:
        own = ", after a FEM of its own each." if run.study.get("draws_of") == "fem" else "."
        asked.append(f"Each on {draws} lattices of material points{own}")
    if changes := run.study.get("overrides"):
        asked.append(f"The study changes the scene throughout: {joined(changes, '; ')}.")
    return asked


# ---------------------------------------------------------------- what comes out


def _of(phase: Phase, pointer: str) -> str:
    value = number(phase.result, pointer)
    return "-" if value is None else rounded(value, 3)


def _but_warnings(phase: Phase) -> str:
    """How it ended; the verdict has the warnings."""
    return how_it_ended(phase).split("; warnings", 1)[0]


def _certainty(runout: Phase) -> str:
    """Error of the number, if known, and cautions about its result."""
    text = "numerical error not quantified (run an accuracy study, or set \"draws\")" if runout.error is None \
        else f"\u00b1 {runout.error:.2g} m: {runout.error_from}"
    end = _but_warnings(runout)
    return text if end == "well" else f"{text}; {end}"


def _mean_row(run: Run) -> list[list[str]]:
    """With repeats: the largest of the means."""
    known = [each for each in run.means if number(each, "/runout") is not None]
    if not known:
        return []
    mean = max(known, key=lambda each: float(each["runout"]))
    error, caution = number(mean, "/runout_error"), mean.get("missing_draws", "") + mean.get("questionable_draws", "")
    return [[f"Runout, mean of {mean['draws_done']:.4g} repeats" + (f", {mean['variant']}" if mean["variant"] else "") + " [m]",
             (at_least if any_moves(run.draws_of(mean)) else "") + with_error(mean["runout"], error), "-",
             ("numerical error not quantified" if error is None else f"\u00b1 {error:.2g} m (nine of ten)")
             + (f"; not whole or questionable: {caution}" if caution else "")]]


def _through_the_breach(shown: Phase, width: Json) -> list[list[str]]:
    """Volume and discharge of the breach's width."""
    def row(what: str, per_metre: float | None, unit: str, lacking: str) -> list[str]:
        if per_metre is None:
            return [what, "-", "-", lacking]
        low, best, high = (rounded(per_metre * width[key], 3) for key in ("low", "best", "high"))
        by_width = f" ({rounded(width['low'], 3)} to {rounded(width['high'], 3)} m: {low} to {high} {unit})" if width["high"] > width["low"] else ""
        return [what, bounded(shown, best), "-", f"{bounded(shown, rounded(per_metre, 3))} per m, {rounded(width['best'], 3)} m wide{by_width}"]

    toe, sections = shown.scene["mpm"]["runout"]["toe"][0], entry(shown.result, "/sections", {}).values()
    nearest = min(sections, key=lambda each: abs(float(each["x"] - toe)), default=None)
    at = f" past x = {nearest['x']:.6g} m" if nearest else ""
    released = row("Released past the toe [m3]", number(shown.result, "/area_beyond_toe"), "m3", "the runout does not say")
    released[3] += f", {width['from']}"
    return [released, row(f"Peak discharge{at} [m3/s]", number(nearest, "/largest_discharge"), "m3/s",
                          "a section at the toe (/mpm/sections) gives it")]


def _runout_rows(run: Run, table: Table, width: Json) -> None:
    asked, shown = run.of(mpm), run.farthest
    if run.without_transfer:
        table.rows.append(["Variants without a transfer", "-", str(len(run.without_transfer)), run.without_transfer[0].get("reason") or ""])
    if not asked:
        return
    if not shown:
        table.rows.append(["Runout [m]", "no result", f"0 of {len(asked)}", asked[0].fault])
        return
    beyond = "" if shown.runout > 0.0 else "99 % of the soil stays before the toe"
    rest, reach = entry(shown.result, "/at_rest"), number(shown.result, "/runout_beyond_toe")
    at_rest = sum(entry(each.result, "/at_rest") is True for each in asked)
    end = f"{_of(shown, '/end_time')} s"
    table.rows += _mean_row(run) + [
        ["Reach: 99 % of what passed the toe [m]", bounded(shown, _of(shown, "/runout_beyond_toe") if reach is None
                                                                     else with_error(reach, shown.error)),
         range_of(asked, "/runout_beyond_toe", True), _certainty(shown)],
        ["Runout: 99 % of mobile soil, from the toe [m]", bounded(shown, with_error(shown.runout, shown.error)),
         range_of(asked, "/runout", True), beyond],
        *_through_the_breach(shown, width),
        ["At rest", "not known" if rest is None else f"yes, after {end}" if rest else f"no: cut off at {end}", f"{at_rest} of {len(asked)}",
         "distances and volumes are lower bounds" if shown.still_moves else ""]]
    unless = ", unless one whose soil still moved would have gone farther" if any_moves(asked) and not shown.still_moves else ""
    table.caption = (f"Governing case: the largest runout of all ({shown.where}){unless}. In the whole run: least to largest, and how many have "
                     "a result." + (" \u2265: a lower bound, the soil still moved." if any_moves(asked) else ""))


def _factor(phase: Phase) -> float | None:
    return number(phase.result, "/factor_of_safety")


def _liquefied(phase: Phase) -> float | None:
    """The factor of safety of the last stage; None: no stages."""
    stages = entry(phase.result, "/stages", [])
    return number(stages[-1], "/factor_of_safety") if stages else None


def _remark_on(factors: list[tuple[float, Phase]]) -> str:
    """Where the least is, what other methods give there, and the range of all."""
    shown = factors[0][1]
    parts = [shown.variant] * bool(shown.variant) + [f"{name} {_of(shown, pointer)}" for name, pointer in (
        ("Bishop", "/bishop/factor_of_safety"), ("Spencer", "/bishop/spencer/factor_of_safety"))
        if factors[0][0] == _factor(shown) and _of(shown, pointer) != "-"]
    if k_h := number(shown.scene, _k_h):
        parts.append(f"k_h = {k_h:.3g}")
    if len(factors) > 1:
        parts.append(f"up to {rounded(factors[-1][0], 3)} in {factors[-1][1].variant or factors[-1][1].label}")
    if (end := _but_warnings(shown)) != "well":
        parts.append(end)
    return joined(parts, "; ")


def _stability_of(run: Run) -> Table:
    """The least factor of safety of each case beside its criterion."""
    criteria, tilted = entry(run.study, "/report/criteria", {}), [each for each in run.of(lem) if number(each.scene, _k_h)]
    built = [each for each in run.of(lem) if each not in tilted]
    table = Table("stability", "Does it stand?", ["factor of safety", "least", "criterion", "met", "remark"], [],
                  f"Criteria (/report/criteria of the study): {criteria['source']}." if "source" in criteria else "")
    for name, key, phases, factor_of, needs in (
            ("as built", "as_built", built, _factor, "\"stability\" of the study"),
            ("pseudo-static", "pseudo_static", tilted, _factor, "a variant with /lem/seismic_coefficient"),
            ("after the shaking", "post_seismic", run.of(post_seismic), _factor, "\"post_seismic\" of the study"),
            ("liquefied, every layer that may", "liquefied", built, _liquefied, "/lem/liquefaction of the scene")):
        factors = sorted(((factor, each) for each in phases if (factor := factor_of(each)) is not None), key=lambda pair: pair[0])
        wanted = number(criteria, "/" + key)
        table.rows.append([name, or_dash(factors[0][0] if factors else None), or_dash(wanted),
                           ("yes" if factors[0][0] >= wanted else "no") if factors and wanted else "-",
                           _remark_on(factors) if factors else next((each.fault for each in phases if each.fault), f"not analysed: needs {needs}")])
    return table if run.of(lem) or run.of(post_seismic) else Table("stability", "", [])


def _fem_rows(run: Run, table: Table) -> None:
    fems = run.of(fem)
    if len(fems) > _most_fems:
        odd = [each for each in fems if how_it_ended(each) != "well"]
        remark = f"largest displacement {range_of(fems, '/largest_displacement', False)} m"
        if odd:
            remark += f"; {len(odd)} not simply well, the first ({odd[0].variant}): {how_it_ended(odd[0])}"
        table.rows.append([f"Finite elements end [s], {len(fems)} of them", "-", range_of(fems, "/end_time", False), remark])
        return
    for each in fems:
        end = how_it_ended(each)
        table.rows.append(["Finite elements end" + (f" ({each.variant})" if each.variant else ""),
                           f"{_of(each, '/end_time')} s" if each.result else "no result", "-",
                           f"largest displacement {_of(each, '/largest_displacement')} m" if end == "well" else end])


def _gauges_of(run: Run) -> Table:
    """Arrival, depth and velocity of the governing runout at each gauge."""
    table = Table("front_gauges", "At the gauges", ["quantity"], [],
                  "Of the governing case. Arrival: time since the soil began to move; -: the flow did not arrive.")
    shown = run.farthest
    gauges = [each for each in entry(shown.scene, "/mpm/gauges", []) if entry(shown.result, "/gauges/" + each["name"])] if shown else []
    if not shown or not gauges:
        return table
    table.columns += [f"{each['name']}, x = {each['x']:.6g} m" for each in gauges[:_most_gauges]]
    for what, key, grows in (("arrival [s]", "arrival_time", False), ("largest depth [m]", "largest_depth", True),
                             ("largest velocity [m/s]", "largest_velocity", True)):
        found = [_of(shown, f"/gauges/{each['name']}/{key}") for each in gauges[:_most_gauges]]
        table.rows.append([what] + [bounded(shown, text) if grows else text for text in found])
    return table


# ---------------------------------------------------------------- limits


def _limit_at_transfer(run: Run) -> str:
    """Changes after the transfer that the runouts leave out; variants may differ."""
    runouts = run.of(mpm)
    shaken = sum(entry(each.scene, "/mpm/shaking") == "on" for each in runouts)
    if not run.is_shaken:
        rest = "."
    elif shaken == 0:
        rest = ", and the shaking ends with it."
    elif shaken == len(runouts):
        rest = "; the ground shakes on."
    else:
        rest = f"; the ground shakes on in {shaken} of {len(runouts)} runouts (/mpm/shaking), in the others the shaking ends with the transfer."
    return "Nothing liquefies after the transfer" + rest


def _limits_of(run: Run, paper: Paper | None) -> list[str]:
    asks, limits = _asks_for_runouts(run), []
    if asks and not run.uncertainty:
        limits.append("No uncertainty was computed: strengths, viscosity and motion are taken as the scene says them, as if they were known. A "
                      "study with \"uncertainty\" gives percentiles.")
    limits.append("Plane strain: all results are per metre of width. A breach of finite width spreads and drains otherwise.")
    if not run.first(fem) and not run.first(mpm):
        limits.append("Limit equilibrium: no deformation, and no surface but those that were searched.")
    if asks:
        limits += ["No mixing with water: nothing is diluted, and no free water flows along.",
                   "No pore pressure builds up or drains in the runout: strength is that at the transfer, reduced by softening.",
                   _limit_at_transfer(run) if run.first(fem) else "Static: whether and when the section fails is not asked."]
    return limits + (paper.remarks if paper else [])


def _identity_of(run: Run) -> str:
    """Run 01, flow-slope. Scene flow_slope, computed by Breachline 0.9.0, finished 2026-11-22 13:15 UTC."""
    text = (f"Run {run.about['id']}, {run.name}. " if run.about.get("id") else "") + f"Scene {run.scene['name']}"
    versions = [version for each in run.phases if (version := entry(each.result, "/provenance/version"))]
    if versions:
        text += f", computed by Breachline {versions[0]}"
    if finished := run.about.get("finished"):
        text += f", finished {finished[:10]} {finished[11:16]} UTC"
    return text + "."


def _headline_of(run: Run) -> str:
    """Flows at least 37.3 m beyond the toe; FS 0.912 as built; governing case: t_T = 13 s, soft; 1 of 2 runouts without a result."""
    text, governs = str(run.about["headline"]["text"]), run.farthest or run.least_factor
    if governs and (governs.variant or governs.time is not None):
        text += f"; governing case: {governs.where}"
    missing = sum(not each.result for each in run.of(mpm))
    if run.farthest and missing:
        text += f"; {missing} of {len(run.of(mpm))} runouts without a result"
    return text[:1].upper() + text[1:] + "." if text else ""


# ---------------------------------------------------------------- before and after


def _shown_part(runout: Phase) -> tuple[float, float] | None:
    """Where the ground changed by a tenth of the dam's height, and what the soil reached, with a margin; None: all."""
    crest, toe = crest_of(runout), runout.scene["mpm"]["runout"]["toe"]
    if not crest:
        return None
    height = crest.before - toe[1]
    changed = [x for x, _, surface in profile_of(runout) if abs(surface - (top_at(runout.scene, x) or surface)) > 0.1 * height]
    upstream = min(x for x, _, _ in profile_of(runout))
    return max(min([*changed, toe[0] - 5.0 * height]) - height, upstream), toe[0] + max(runout.result["runout_largest"], 0.0) + height


def _picture(name: str, title: str, across: Axis, series: list[Series], marks: list[Mark]) -> Figure:
    return Figure(name, Chart(title, across, Axis("y [m]"), [each for each in series if len(each.x)], marks, equal=True, least_height=60))


def _pictures_of(run: Run) -> list[Figure]:
    """The section before the governing runout, with slip surface and phreatic line, and after it, in one scale."""
    farthest, least = run.farthest, run.least_factor
    shown = farthest or least
    scene = shown.scene if shown else run.scene
    across = Axis("x [m]" if not farthest else "", shown=_shown_part(farthest) if farthest else None)
    toe = entry(scene, "/mpm/runout/toe") if farthest else None
    marks = [Mark("x", toe[0], "toe")] if toe else []
    profile = [row for row in profile_of(farthest) if not across.shown or row[0] <= across.shown[1]] if farthest else []
    outline, pieces = section_at_rest(scene), [row for pair in zip(profile, profile[1:]) for row in pair]
    ground = Series("ground", [x for x, _, _ in pieces], [y for _, y, _ in pieces], "segments")
    regions = [Series(each["name"], [x for x, _ in each["polygon"]], [y for _, y in each["polygon"]], "area") for each in scene["section"]["regions"]]
    lines = [line_of(line, "phreatic line")] if (line := phreatic_line(scene)) else []
    if least and (surface := critical_surface(least.scene, least.result)):
        lines.append(surface)
    figures = [_picture("section_before", "Before" if farthest else "The section", across, [*regions, *lines, ground], marks)]
    if farthest and profile:
        soil = Series("soil", [x for x, _, _ in profile] + [x for x, _, _ in profile[::-1]],
                      [surface for _, _, surface in profile] + [ground for _, ground, _ in profile[::-1]], "area")
        reach = number(farthest.result, "/runout_beyond_toe") or 0.0
        far = [Mark("x", toe[0] + reach, f"reach {bounded(farthest, rounded(reach, 3))} m")] if toe and reach > 0.0 else []
        figures.append(_picture("section_after", f"After, {farthest.where}" + (" (still moving)" if farthest.still_moves else ""), across,
                                [soil, outline, ground], marks + far))
    return figures


def front_of(run: Run, paper: Paper | None, width: Json) -> Front:
    """width: of the breach, as the service's program states it; None: the scene has no runout."""
    found = Table("found", "What comes out", ["quantity", "governing case", "in the whole run", "remark"], sampled_answer(run))
    _runout_rows(run, found, width)
    _fem_rows(run, found)
    about = run.study.get("report", {})
    people = [(words, about[each]) for each, words in (("client", "client"), ("site", "dam"), ("revision", "revision"), ("author", "author"),
                                                       ("reviewer", "reviewer")) if each in about]
    return Front(_identity_of(run), people, _headline_of(run), _pictures_of(run), _asked_of(run),
                 [each for each in (_stability_of(run), found, _gauges_of(run)) if each.rows], _limits_of(run, paper), about.get("author", ""),
                 about.get("reviewer", ""))
