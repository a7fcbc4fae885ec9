"""From the transfer to the deposit: points at t_T, runout against t_T, final geometries."""
from __future__ import annotations

import math

from breachline.frames import Frame, read
from breachline.plot import Axis, Chart, Figure, Series
from breachline.plot.points import points_by_material, points_by_strain
from breachline.plot.transfer import compare, layers_of

from ..document import Chapter, Document, Json
from ..ended import any_moves, bounded, certainty_of
from ..measures import Window
from ..run import Phase, Run, fem, mpm, transfer
from ..words import number, with_error
from . import Material

runout_figure = "runout_against_transfer_time"
_of_means = ("99th percentile of the mobile soil's distance beyond the toe, by mass: mean over the repeats, each on a lattice of points of its "
             "own; the band is the standard deviation of one repeat. Hollow with an arrow: soil of a repeat still moved, the mean is a lower "
             "bound; hollow and dashed: a repeat has no result, or one that is questionable (table of means).")
_of_runs = ("99th percentile of the mobile soil's distance beyond the toe, by mass; negative while it lies before the toe. Hollow with an arrow: "
            "the soil still moved, the runout is a lower bound; hollow and dashed: questionable (table of flags). Where an accuracy study, "
            "repeats or the neighbours in transfer time tell the error of one run, it is drawn as a band.")


def section_at_rest(scene: Json) -> Series:
    corners = [(a, b) for region in scene["section"]["regions"] for a, b in zip(region["polygon"], region["polygon"][1:] + region["polygon"][:1])]
    return Series("section at rest", [point[0] for pair in corners for point in pair], [point[1] for pair in corners for point in pair], "segments")


def _curves_of_means(run: Run) -> list[Series]:
    """Mean and scatter of the repeats, one curve per variant."""
    curves = []
    for variant in dict.fromkeys(each["variant"] for each in run.means):
        known = [each for each in run.means if each["variant"] == variant and number(each, "/runout") is not None]
        whole = [each["missing_draws"] == "" and each["questionable_draws"] == "" for each in known]
        deviations = [number(each, "/runout_deviation") for each in known]
        curves.append(Series(variant or "mean of the repeats", [each["transfer_time"] for each in known], [each["runout"] for each in known],
                             "line_and_points", ["lower bound" if any_moves(run.draws_of(each)) else "certain" if sound else "questionable"
                                                 for each, sound in zip(known, whole)],
                             [math.nan if each is None else each for each in deviations]))
    return [each for each in curves if len(each.x)]


def _curves_of_runs(run: Run) -> list[Series]:
    """One curve per variant, with the certainty of each runout."""
    curves = []
    for variant in run.variants:
        shown = [each for each in run.runouts_of(variant) if each.time is not None]
        certainty = [certainty_of(each) for each in shown]
        error = [math.nan if each.error is None else each.error for each in shown]
        curves.append(Series(variant or "runout", [each.time or 0.0 for each in shown], [each.runout for each in shown], "line_and_points",
                             [] if set(certainty) <= {"certain"} else certainty, [] if all(map(math.isnan, error)) else error))
    return [each for each in curves if len(each.x)]


def runout_curves(run: Run) -> list[Series]:
    return _curves_of_means(run) if run.means else _curves_of_runs(run)


def chosen_runouts(of: Material) -> list[Phase]:
    """Runouts shown in detail, of the variant with the largest: those nearest to the requested transfer times; without such times, the
    largest and the one nearest to half of it. For a static scene, with one runout per variant, of all."""
    run, far = of.run, of.run.farthest
    shown = [each for variant in run.variants for each in run.runouts_of(variant)] if run.is_static else run.runouts_of(far.variant) if far else []
    if not shown:
        return []
    if of.choice.transfer_times:
        picked = [_nearest_in_time(shown, time) for time in of.choice.transfer_times]
    else:
        farthest = max(shown, key=lambda each: each.runout)
        picked = [min(shown, key=lambda each: abs(each.runout - 0.5 * farthest.runout)), farthest]
    return list(dict.fromkeys(picked))


def _nearest_in_time(phases: list[Phase], time: float) -> Phase:
    return min(phases, key=lambda each: abs((each.time or 0.0) - time))


# ---------------------------------------------------------------- the transfer


def _before_and_after(of: Material, shown: Phase, points: Frame, chapter: Chapter, document: Document) -> None:
    """From the snapshot of the run's FEM; without it notes why."""
    source = of.run.source_of(shown) or of.run.of_variant(fem, shown.variant)
    for time, file in source.snapshots() if source else []:
        if shown.time is not None and abs(time - shown.time) <= 1e-6:
            for pair in compare(read(file), points, layers_of(shown.scene)):
                chapter.figures += [pair.before, pair.after]
            if "r_u" not in points.fields:
                document.leave_out("liquefied zone before and after the transfer", "the points carry no r_u: dry")
            return
    document.leave_out("fields before and after the transfer", f"the run has no snapshot at {shown.where}")


def add_transfer(of: Material, document: Document) -> None:
    done = [each for each in of.run.of(transfer) if each.has("particles.vtkhdf")]
    if not done:
        document.leave_out("material points at t_T", "the run has no transfer")
        return
    shown = done[-1]
    if runouts := chosen_runouts(of):
        source = of.run.source_of(runouts[-1])
        shown = source if source and source in done else _nearest_in_time(done, runouts[-1].time or 0.0)
    points = read(shown.files / "particles.vtkhdf")
    chapter = Chapter("Transfer", f"What the mesh handed to the material points ({shown.where}).",
                      [points_by_material(points, "points_at_transfer", f"Material points at {shown.where}"),
                       points_by_strain(points, "points_at_transfer_epsilon_q", f"epsilon_q of the points at {shown.where}")])
    _before_and_after(of, shown, points, chapter, document)
    document.add(chapter)


# ---------------------------------------------------------------- the runout


def _window_text(window: Window) -> str:
    if window.lower is None:
        return ""
    if window.is_none:
        return (f"By its criteria there is no window of transfer times: the mesh is too distorted from {window.upper:.6g} s on, and the failure is "
                f"developed at {window.lower:.6g} s.")
    closes = "stays open to the end of the FEM." if window.upper is None else f"closes at {window.upper:.6g} s."
    return f"The window of transfer times opens at {window.lower:.6g} s and {closes}"


def add(of: Material, document: Document) -> None:
    run, runouts = of.run, chosen_runouts(of)
    if not runouts:
        asked = run.first(mpm)
        document.leave_out("runout against transfer time, final geometries",
                           f"no runout ended well: {asked.fault}" if asked else "the run has no runout")
        return
    window = of.measures.window
    chapter = Chapter("Runout", _window_text(window))
    if not run.is_static:
        against = Figure(runout_figure, Chart("Runout against transfer time", Axis("transfer time t_T [s]"), Axis("runout [m]"), runout_curves(run),
                                              window.marks()), _of_means if run.means else _of_runs)
        if of.paper:
            of.paper.add_points(against)
        chapter.figures.append(against)
    for each in runouts:
        if not each.has("final.vtkhdf"):
            document.leave_out(f"final geometry, {each.where}", "the runout's folder has no final.vtkhdf")
            continue
        points = read(each.files / "final.vtkhdf")
        geometry = points_by_material(points, f"final_geometry_{each.file_word}", f"Final geometry, {each.where}")
        geometry.chart.series.append(section_at_rest(each.scene))
        bound = ", a lower bound: the soil still moved" if each.still_moves else ""
        geometry.caption += f" Runout {bounded(each, with_error(each.runout, each.error))} m{bound}; lines: the section at rest."
        chapter.figures += [geometry, points_by_strain(points, f"final_epsilon_q_{each.file_word}", f"epsilon_q of the deposit, {each.where}")]
    document.add(chapter)
