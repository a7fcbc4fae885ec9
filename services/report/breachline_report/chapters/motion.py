"""The motion applied by the FEM, its intensity, and what a study of several motions found."""
from __future__ import annotations

import math
from pathlib import Path
from statistics import NormalDist

import numpy as np
from breachline.plot import Axis, Chart, Figure, Mark, Series
from numpy.typing import NDArray

from ..document import Chapter, Document, Json, Table
from ..run import Phase, fem
from ..words import at_least, entry, number, rounded
from . import Material

_g = 9.80665  # [m/s2]
_measures = {"pga_g": "PGA [g]", "pgv": "PGV [m/s]", "pgd": "PGD [m]", "arias": "Arias intensity [m/s]", "strong_duration": "D5-95 [s]",
             "cav": "CAV [m/s]", "masi": "MASI [m/s]"}
Values = NDArray[np.float64]


def _read(file: Path) -> tuple[str, Values, Values]:
    """motion.csv of the FEM: its heading, times [s] and values in SI."""
    lines = [line for line in file.read_text().splitlines() if line and not line.startswith("#")]
    columns = np.array([[float(cell) for cell in line.split(",")] for line in lines[1:]])
    return lines[0], columns[:, 0], columns[:, 1] * (_g if lines[0].endswith("_g") else 1.0)


def _integral(time: Values, values: Values) -> Values:
    return np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(time))])


def _figure(name: str, title: str, label: str, time: Values, values: Values) -> Figure:
    return Figure(name, Chart(title, Axis("time [s]"), Axis(label), [Series(title, time.tolist(), values.tolist())]),
                  "From below the mesh, horizontal.")


def _facts(time: Values, a: Values, v: Values, arias: Values) -> str:
    begin, end = (float(np.interp(share * arias[-1], arias, time)) for share in (0.05, 0.95))
    return (f"PGA {np.abs(a).max() / _g:.3g} g, PGV {100 * np.abs(v).max():.3g} cm/s, Arias intensity {arias[-1]:.3g} m/s, strong shaking (5 to "
            f"95 % of it) from {begin:.3g} to {end:.3g} s.")


def _end_within(time: Values, phase: Phase) -> float | None:
    """The FEM's end [s] if the record is longer; without a result the end of its telemetry."""
    end = number(phase.result, "/end_time") if phase.result else phase.telemetry[-1]["time"] if phase.telemetry else None
    return end if end is not None and len(time) > 1 and end < time[-1] - 0.5 * (time[1] - time[0]) else None


def _spectra(motions: Json) -> Figure:
    series = [Series(place, found["spectrum"]["period"], [each / _g for each in found["spectrum"]["acceleration"]])
              for place, found in motions.items()]
    return Figure("motion_spectra", Chart("Response spectra", Axis("period [s]", logarithmic=True), Axis("pseudo-acceleration, 5 % [g]"), series),
                  "Horizontal, of 5 % damping.")


def add(of: Material, document: Document) -> None:
    phase, what = of.run.shown(fem), "acceleration, velocity and Arias intensity of the motion"
    wanted = entry(phase.scene, "/fem/motion") if phase else None
    if not phase or not wanted:
        document.leave_out(what, "the scene has no motion (/fem/motion)")
        return
    if not phase.has("motion.csv"):
        document.leave_out(what, "the FEM's folder does not hold motion.csv")
        return
    heading, time, values = _read(phase.files / "motion.csv")
    name, end = Path(wanted["file"]).name, _end_within(time, phase)
    chapter = Chapter("Motion")
    if "velocity" in heading:
        chapter.text = f"{name}, a velocity: PGV {100 * np.abs(values).max():.3g} cm/s."
        if end is not None:
            chapter.text += f" That is of the whole record; the finite elements ended at {end:.6g} s."
        chapter.figures = [_figure("motion_velocity", "Velocity", "velocity [cm/s]", time, 100 * values)]
        document.leave_out("acceleration and Arias intensity of the motion", "the scene gives its velocity")
    else:
        v, arias = _integral(time, values), _integral(time, values ** 2 * math.pi / (2 * _g))
        chapter.text = f"{name}, as the FEM took it: {_facts(time, values, v, arias)}"
        if end is not None:
            felt = time <= end + 1e-9
            chapter.text += (f" That is of the whole record. The finite elements ended at {end:.6g} s: until then PGA "
                             f"{np.abs(values[felt]).max() / _g:.3g} g")
            chapter.text += (f" and {100 * arias[felt][-1] / arias[-1]:.3g} % of the Arias intensity" if arias[-1] > 0 else "") + "."
        chapter.figures = [_figure("motion_acceleration", "Acceleration", "acceleration [g]", time, values / _g),
                           _figure("motion_velocity", "Velocity", "velocity [cm/s]", time, 100 * v),
                           _figure("motion_arias", "Arias intensity", "Arias intensity [m/s]", time, arias)]
    if end is not None:
        for each in chapter.figures:
            each.chart.marks.append(Mark("x", end, "finite elements end"))
    if motions := entry(phase.result, "/motions"):
        chapter.tables.append(Table("motions", "What the motion is measured by", ["", *motions],
                                    [[title] + [rounded(found[key], 3) for found in motions.values()] for key, title in _measures.items()],
                                    "PGD with the baseline corrected; MASI: integral of the 5 % pseudo-acceleration over periods of 0.1 to 2 s. "
                                    "The crest's is until the analysis ended."))
        chapter.figures.append(_spectra(motions))
    document.add(chapter)


# ---------------------------------------------------------------- several motions


def _with_interval(found: Json, value: str) -> str:
    return f"{found[value]:.3g} ({found['low']:.3g} to {found['high']:.3g})" if found else "-"


def _title(measure: Json) -> str:
    return f"{measure['title']} [{measure['unit']}]"


def _onset(found: Json) -> Figure:
    known = [row for row in found["rows"] if row["runout"] is not None]
    points = Series("motions", [row["liquefaction_depth"] for row in known], [row["runout"] for row in known], "points",
                    ["lower bound" if row["lower_bound"] else "certain" for row in known])
    marks = [Mark("x", found[key]["depth"], words) for key, words in (("onset", "soil passes the toe"), ("saturation", "90 % of the largest"))
             if found[key]]
    return Figure("runout_against_liquefied_depth", Chart("Runout against liquefied depth", Axis("liquefied depth [m]"),
                                                          Axis("runout past the toe [m]"), [points], marks), "One point per motion.")


def _fragility(found: Json) -> list[Figure]:
    """For the measure that correlates best with the liquefied depth; empty: it has no curve."""
    for each in found["measures"]:
        curve = each["fragility"]
        if each["name"] == found["best"] and "refused" not in curve:
            places = [0.1 * k - 3.0 for k in range(61)]
            known = [row for row in found["rows"] if row["runout"] is not None]
            line = Series("lognormal", [curve["median"] * math.exp(curve["beta"] * z) for z in places], [NormalDist().cdf(z) for z in places])
            points = Series("motions: past the toe or not", [row[each["name"]] for row in known],
                            [float(row["runout"] > 0) for row in known], "points")
            return [Figure("fragility", Chart("Fragility", Axis(_title(each)), Axis("probability that soil passes the toe"), [line, points]),
                           "Of these motions, which are no sample of the site's earthquakes.")]
    return []


def add_several(of: Material, document: Document) -> None:
    found = of.run.motions
    if not found:
        return
    measures = Table("motion_measures", "Which measure goes with what", ["measure", "with liquefied depth", "with runout", "half past the toe at"], [
        [_title(each), _with_interval(each["with_depth"], "value"), _with_interval(each["with_runout"], "value"),
         each["fragility"].get("refused") or _with_interval(each["fragility"], "median")] for each in found["measures"]],
        "Rank correlation with its 90 % interval; median of the lognormal fragility curve, with its interval, or why there is none.")
    rows = Table("motions_of_study", "The motions", ["variant", "liquefied depth [m]", "runout past the toe [m]", *map(_title, found["measures"])], [
        [row["variant"], rounded(row["liquefaction_depth"], 3),
         "-" if row["runout"] is None else (at_least if row["lower_bound"] else "") + rounded(row["runout"], 3),
         *(rounded(row[each["name"]], 3) for each in found["measures"])] for row in found["rows"]])
    document.add(Chapter("Several motions", " ".join(found["sentences"]), [_onset(found), *_fragility(found)], [measures, rows]))
