"""Flow downstream: deposit, arrival, depth and velocity at gauges, the envelope along x, and what passed sections."""
from __future__ import annotations

import csv

import h5py  # type: ignore[import]
from breachline.plot import Axis, Chart, Figure, Mark, Series

from ..document import Chapter, Document, Table
from ..ended import bounded
from ..run import Phase, Run, mpm
from ..words import entry, fact
from . import Material
from .runout import chosen_runouts

_slurry = ("The material is a tailings slurry, not water: volumes are of soil with its pore water as it lay in the dam, and free water of a pond is "
           "not in them. Route it with a rheology of its own.")


def _time_label(runout: Phase) -> str:
    return "time since transfer [s]" if runout.time is not None else "time [s]"


def _toe_of(runout: Phase) -> Mark:
    return Mark("x", runout.scene["mpm"]["runout"]["toe"][0], "toe")


def _courses(runout: Phase, places: str, kind: str, quantity: str) -> list[Series]:
    """Telemetry at every gauge or section of the scene."""
    found = []
    for each in entry(runout.scene, "/mpm/" + places, []):
        times, values = runout.course(f"{kind}.{each['name']}.{quantity}")
        if times:
            found.append(Series(f"{each['name']} (x = {each['x']:.6g} m)", times, values))
    return found


def _gauge_figure(runout: Phase, quantity: str, label: str) -> Figure:
    return Figure(f"gauge_{quantity}_{runout.file_word}", Chart(f"Gauges: {quantity}, {runout.where}", Axis(_time_label(runout)), Axis(label),
                                                               _courses(runout, "gauges", "gauge", quantity)),
                  "Mean over a cell each way: of the depth of mobile soil, and of its horizontal velocity by mass.")


def _gauge_table(run: Run) -> Table:
    """Arrival and largest values at every gauge, for every runout."""
    table = Table("gauges", "Gauges", ["t_T [s]", "variant", "gauge", "x [m]", "arrival [s]", "largest depth [m]", "at [s]",
                                       "largest velocity [m/s]"], [],
                  "Arrival: first time at which the flow is as deep as the gauge's arrival_depth, in seconds since the transfer; - when it never "
                  "is, or was not yet where the soil still moved at the end. \u2265: a lower bound, the soil still moved.")
    for each in run.of(mpm):
        for name, seen in entry(each.result, "/gauges", {}).items():
            table.rows.append([each.columns[1], each.variant, name, fact(seen, "/x", digits=6), fact(seen, "/arrival_time"),
                               bounded(each, fact(seen, "/largest_depth")), fact(seen, "/time_of_largest_depth"),
                               bounded(each, fact(seen, "/largest_velocity"))])
    return table


def history_of(runout: Phase, name: str, x: str, y: str) -> list[Series]:
    """A series of two arrays of history.h5; empty: one is missing."""
    if not runout.has("history.h5"):
        return []
    with h5py.File(runout.files / "history.h5") as file:
        reals = file["breachline/reals"]
        return [Series(name, list(reals[x][()]), list(reals[y][()]))] if x in reals and y in reals else []


def add(of: Material, document: Document) -> None:
    runouts = chosen_runouts(of)
    if not runouts:
        document.leave_out("gauges and deposit profile", "the run has no runout")
        return
    deposit = Figure("deposit_profile", Chart("Depth of the deposit", Axis("x [m]"), Axis("depth of mobile soil [m]"),
                                              marks=[_toe_of(runouts[0])]), "At the end of the runout.")
    for each in runouts:
        name = each.where + (" (still moving)" if each.still_moves else "")
        deposit.chart.series += history_of(each, name, "envelope.x", "envelope.final_depth")
    if not deposit.chart.series:
        document.leave_out("deposit profile", "the runouts kept no envelope")
    table = _gauge_table(of.run)
    if not table.rows:
        document.leave_out("arrival, depth and velocity at gauges", "the scene has no gauges (/mpm/gauges)")
    document.add(Chapter("Flow and deposit", "", [deposit] + [_gauge_figure(each, quantity, label) for each in runouts for quantity, label in
                                                              (("depth", "flow depth [m]"), ("velocity", "velocity [m/s]"))], [table]))


# ---------------------------------------------------------------- what leaves the model


def _envelope_figures(runout: Phase) -> list[Figure]:
    """Depths, velocity, times; nothing without an envelope."""
    if not runout.has("envelope.csv"):
        return []
    rows = list(csv.DictReader((runout.files / "envelope.csv").read_text().splitlines()))

    def along(name: str, shown: str) -> Series:
        known = [(float(row["x_m"]), float(row[name])) for row in rows if row[name]]
        return Series(shown, [x for x, _ in known], [value for _, value in known])

    def figure(word: str, what: str, label: str, series: list[Series], caption: str) -> Figure:
        return Figure(f"envelope_{word}_{runout.file_word}",
                      Chart(f"{what}, {runout.where}", Axis("x [m]"), Axis(label), series, [_toe_of(runout)]), caption)

    return [figure("depth", "Largest depth and deposit", "flow depth [m]",
                   [along("largest_depth_m", "largest"), along("final_depth_m", "at the end")],
                   "Mean over a cell each way, of mobile soil; fewer than three points there are grains and no flow."),
            figure("velocity", "Largest velocity", "depth-averaged velocity [m/s]", [along("largest_velocity_m_per_s", "largest")], "Either way."),
            figure("times", "Arrival and time of the peak", _time_label(runout), [along("arrival_s", "arrival"), along("time_of_peak_s", "deepest")],
                   "Nothing is drawn where the flow never came; 0 where soil lay already. Arrival: depth of /mpm/envelope/arrival_depth.")]


def _section_table(run: Run) -> Table:
    table = Table("sections", "Sections", ["run", "t_T [s]", "variant", "section", "x [m]", "largest discharge [m2/s]", "at [s]", "passed [m2]",
                                           "mass [kg/m]", "closure", "breach [m]", "largest discharge [m3/s]", "passed [m3]"], [],
                  "Per metre of width, net towards +x, as volume in place; breach: its likeliest width, and discharge and volume for it. Closure: "
                  "volume that the momentum carried past the section, less the volume that came to rest beyond it, over all that moved. "
                  "\u2265: a lower bound, the soil still moved.")
    for each in run.of(mpm):
        for name, seen in entry(each.result, "/sections", {}).items():
            discharge, volume, mass, of_breach, through = (bounded(each, fact(seen, at)) for at in (
                "/largest_discharge", "/volume", "/mass", "/breach/largest_discharge/1", "/breach/volume/1"))
            table.rows.append([*each.columns[:2], each.variant, name, fact(seen, "/x", digits=6), discharge,
                               fact(seen, "/time_of_largest_discharge"), volume, mass, fact(seen, "/closure", digits=2),
                               fact(seen, "/breach/width/1"), of_breach, through])
    return table


def add_outflow(of: Material, document: Document) -> None:
    runouts = chosen_runouts(of)
    if not runouts:
        return  # noted by add
    envelopes = [figure for each in runouts for figure in _envelope_figures(each)]
    if not envelopes:
        document.leave_out("envelope along x", "the runouts kept no envelope.csv")
    hydrographs = [Figure(f"hydrograph_{each.file_word}", Chart(f"Hydrographs, {each.where}", Axis(_time_label(each)),
                                                                Axis("discharge per metre of width [m2/s]"),
                                                                _courses(each, "sections", "section", "discharge")),
                          f"Mean from one telemetry line to the next, towards +x. {_slurry}") for each in runouts]
    table = _section_table(of.run)
    if not table.rows:
        document.leave_out("hydrographs", "the scene has no sections (/mpm/sections)")
    document.add(Chapter("What leaves the model", "", envelopes + hydrographs, [table]))
