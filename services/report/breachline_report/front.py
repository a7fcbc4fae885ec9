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
from .run import Phase, Run, fem, lem, mpm, transfer
from .words import at_least, entry, fact, joined, number, or_dash, rounded, with_error

_most_named = 12  # variants or times in a sentence
_most_gauges = 4
_most_fems = 6  # in rows of their own


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


def _certainty(runout: Phase) -> str:
    """Error of the number, if known, and cautions about its result."""
    text = "numerical error not quantified (run an accuracy study, or set \"draws\")" if runout.error is None \
        else f"\u00b1 {runout.error:.2g} m: {runout.error_from}"
    end = how_it_ended(runout)
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


def _runout_rows(run: Run, table: Table) -> None:
    asked, shown = run.of(mpm), run.farthest
    if run.without_transfer:
        table.rows.append(["Variants without a transfer", "-", str(len(run.without_transfer)), run.without_transfer[0].get("reason") or ""])
    if not asked:
        return
    if not shown:
        table.rows.append(["Runout [m]", "no result", f"0 of {len(asked)}", asked[0].fault])
        return
    beyond = "" if shown.runout > 0.0 else "99 % of the soil stays before the toe"
    rest = entry(shown.result, "/at_rest")
    at_rest = sum(entry(each.result, "/at_rest") is True for each in asked)
    end = f"{_of(shown, '/end_time')} s"
    table.rows += _mean_row(run) + [
        ["Runout: 99 % of the mobile soil, from the toe [m]", bounded(shown, with_error(shown.runout, shown.error)),
         range_of(asked, "/runout", True), _certainty(shown)],
        ["Of what passed the toe, 99 % [m]", bounded(shown, _of(shown, "/runout_beyond_toe")), range_of(asked, "/runout_beyond_toe", True), beyond],
        ["Deposit beyond the toe [m3 per m of width]", bounded(shown, _of(shown, "/area_beyond_toe")),
         range_of(asked, "/area_beyond_toe", True), ""],
        ["At rest", "not known" if rest is None else f"yes, after {end}" if rest else f"no: cut off at {end}", f"{at_rest} of {len(asked)}",
         "distances and volumes are lower bounds" if shown.still_moves else ""]]
    unless = ", unless one whose soil still moved would have gone farther" if any_moves(asked) and not shown.still_moves else ""
    table.caption = (f"Governing case: the largest runout of all ({shown.where}){unless}. In the whole run: least to largest, and how many have "
                     "a result. \u2265: a lower bound, the soil still moved.")


def _liquefied(phase: Phase) -> float | None:
    """The factor of safety of the last stage; None: no stages."""
    stages = entry(phase.result, "/stages", [])
    return number(stages[-1], "/factor_of_safety") if stages else None


def _governing_stability(run: Run) -> Phase | None:
    """Of the variant that runs farthest, or the one shared by all; without a runout the one with the least factor."""
    for variant in (run.farthest.variant, "") if run.farthest else ():
        for each in run.of(lem):
            if each.variant == variant and number(each.result, "/factor_of_safety") is not None:
                return each
    return run.least_factor


def _factor_rows(run: Run, table: Table) -> None:
    all_of, shown = run.of(lem), _governing_stability(run)
    if not all_of:
        return
    if not shown:
        table.rows.append(["Factor of safety", "no result", f"0 of {len(all_of)}", all_of[0].fault])
        return
    remarks = ["least of all surfaces"] + [f"{name} {_of(shown, pointer)}" for name, pointer in
                                           (("Bishop", "/bishop/factor_of_safety"), ("Spencer", "/bishop/spencer/factor_of_safety"))
                                           if _of(shown, pointer) != "-"]
    if run.least_factor and run.least_factor is not shown:
        remarks.append(f"{_of(run.least_factor, '/factor_of_safety')} in {run.least_factor.variant}")
    if (end := how_it_ended(shown)) != "well":
        remarks.append(end)
    liquefied = sorted(((factor, each) for each in all_of if (factor := _liquefied(each)) is not None), key=lambda pair: pair[0])
    table.rows.append(["Factor of safety before any layer liquefies" if liquefied else "Factor of safety", _of(shown, "/factor_of_safety"),
                       range_of(all_of, "/factor_of_safety", False), joined(remarks, "; ")])
    if liquefied:
        least, largest = rounded(liquefied[0][0], 3), rounded(liquefied[-1][0], 3)
        elsewhere = "" if liquefied[0][1] is shown else f"; {least} in {liquefied[0][1].variant}"
        table.rows.append(["Factor of safety with every layer liquefied that may", or_dash(_liquefied(shown)),
                           least + (f" to {largest}" if len(liquefied) > 1 else "") + f" ({len(liquefied)} of {len(all_of)})",
                           "residual strengths" + elsewhere])
    if "critical_depth" in shown.result:
        depth = _of(shown, "/depth_at_fs_1")
        table.rows += [["Liquefied depth at which the factor of safety falls to 1 [m]", depth, range_of(all_of, "/depth_at_fs_1", False),
                        "stable with every layer liquefied" if depth == "-" else ""],
                       ["Depth of the critical surface (critical_depth of triggers) [m]", _of(shown, "/critical_depth"),
                        range_of(all_of, "/critical_depth", False), "lowest point of the stage with the least factor of safety"]]


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


def _surface_of(runout: Phase) -> Series:
    """Columns 0 and 3 of profile.csv, x and the surface [m]; without points: no such file."""
    lines = (runout.files / "profile.csv").read_text().splitlines()[1:] if runout.has("profile.csv") else []
    rows = [[float(cell or 0.0) for cell in line.split(",")] for line in lines]
    return Series(f"after, {runout.where}" + (" (still moving)" if runout.still_moves else ""), [row[0] for row in rows], [row[3] for row in rows])


def _overview_of(run: Run) -> Figure:
    """The section before and after the governing runout, with slip surface and phreatic line."""
    farthest, least = run.farthest, run.least_factor
    shown = farthest or least
    scene = shown.scene if shown else run.scene
    before = section_at_rest(scene)
    before.name = "before"
    water = [line for at in ("/fem/water/line", "/lem/water/line", "/transfer/phreatic_line") if isinstance(line := entry(scene, at), list)]
    series = [before] + ([_surface_of(farthest)] if farthest else []) + [line_of(line, "phreatic line") for line in water[:1]]
    if least and (surface := critical_surface(least.scene, least.result)):
        series.append(surface)
    toe = entry(scene, "/mpm/runout/toe")
    marks = [Mark("x", toe[0], "toe"), Mark("x", toe[0] + farthest.runout, f"runout {bounded(farthest, rounded(farthest.runout, 3))} m")] \
        if farthest and toe else []
    return Figure("overview", Chart("The section before and after" if marks else "The section", Axis("x [m]"), Axis("y [m]"),
                                    [each for each in series if len(each.x)], marks, equal=True, least_height=75))


def front_of(run: Run, paper: Paper | None) -> Front:
    found = Table("found", "What comes out", ["quantity", "governing case", "in the whole run", "remark"], sampled_answer(run))
    _runout_rows(run, found)
    _factor_rows(run, found)
    _fem_rows(run, found)
    about = run.study.get("report", {})
    people = [(each, about[each]) for each in ("site", "client", "author", "reviewer", "revision") if each in about]
    return Front(_identity_of(run), people, _headline_of(run), [_overview_of(run)], _asked_of(run),
                 [each for each in (found, _gauges_of(run)) if each.rows], _limits_of(run, paper), about.get("author", ""), about.get("reviewer", ""))
