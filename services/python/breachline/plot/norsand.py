"""Figures of a calibration of NorSand: measured values beside the law's, critical state line, dilatancy."""
from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..faults import BreachlineError
from ..frames import Array
from .chart import Axis, Chart, Figure, Series

Curves = Mapping[str, Array]  #: columns of an archive of element tests [SI]
Shown = tuple[str, float]  #: a column, and the axis' unit in SI

_HOW = "Dots are measured, lines are the law with the calibrated parameters."


def curve_column(curves: Curves, name: str, unit: float) -> Array:
    """unit: the figure's unit in SI."""
    if name not in curves:
        raise BreachlineError(f"element_tests.h5: has no column {name}; run fem_solver element-test (or calibrate) again")
    return curves[name] / unit


def norsand_figures(calibration: dict[str, Any], curves: Curves) -> list[Figure]:
    """calibration: result.json's `norsand_calibration`; curves: the archive beside it."""
    tests, parameters = dict(sorted(calibration["tests"].items())), calibration["parameters"]
    value = {name: each["value"] for name, each in parameters.items()}
    strain, q, p = Axis("axial strain, logarithmic [%]"), Axis("q [kPa]"), Axis("p′ [kPa]")
    epsilon_1, in_q, in_p = ("strain", 0.01), ("q", 1e3), ("p", 1e3)
    drained = {name: each for name, each in tests.items() if each["boundary"] == "drained_compression"}
    undrained = {name: each for name, each in tests.items() if name not in drained}
    figures = []
    for name, which, title, x, y, along, up in (
            ("drained_stress_strain", drained, "Drained compression", strain, q, epsilon_1, in_q),
            ("drained_volume", drained, "Drained compression: volume", strain, Axis("volume strain, contraction positive [%]"),
             epsilon_1, ("epsilon_v", 0.01)),
            ("undrained_stress_strain", undrained, "Undrained compression", strain, q, epsilon_1, in_q),
            ("undrained_pore_pressure", undrained, "Undrained compression: excess pore pressure", strain, Axis("u [kPa]"), epsilon_1, ("u", 1e3)),
            ("stress_paths", tests, "Stress paths", p, q, in_p, in_q)):
        if which:
            figures.append(Figure(name, Chart(title, x, y, _curves_of(which, curves, along, up)), _HOW))
    states = Chart("State paths and critical state line", Axis("p′ [kPa]", logarithmic=True), Axis("void ratio e [-]"),
                   _curves_of(tests, curves, in_p, ("e", 1.0)) + _critical_state(tests, parameters))
    figures.append(Figure("critical_state_line", states, _HOW + " Ends of tests are means over the last 15 % of their strain; where one is still "
                          "on its way, the law's own end is, too."))
    # D_min and psi are measured; the law's peaks are near chi_tc psi, not on it.
    figures += _peaks(tests, "psi", "D_min", (0.0, value["chi_tc"]), "The line is D_min = chi_tc psi.",
                      "dilatancy", Chart("Dilatancy against state", Axis("ψ at the peak [-]"), Axis("D_min [-]")))
    figures += _peaks(tests, "D_min", "eta", (value["M_tc"], value["N"] - 1.0), "The line is eta = M_tc - (1 - N) D_min.",
                      "stress_dilatancy", Chart("Stress ratio against dilatancy", Axis("D_min [-]"), Axis("largest q/p′ [-]")))
    return figures


def _curves_of(tests: Mapping[str, Any], curves: Curves, x: Shown, y: Shown) -> list[Series]:
    """Both curves of each test, the measured one as dots."""
    series: list[Series] = []
    for name, test in tests.items():
        measured = len(series)
        for kind in ("measured", "computed") if test["computed"] else ("measured",):
            along, up = (curve_column(curves, f"{name}.{kind}.{column}", unit) for column, unit in (x, y))
            series.append(Series(f"{name}, {kind}", along, up, "dots") if kind == "measured" else Series(f"{name}, {kind}", along, up, like=measured))
    return series


def _critical_state(tests: Mapping[str, Any], parameters: dict[str, Any]) -> list[Series]:
    """Ends of the tests over the critical state line; filled: tests that define the line."""
    p, e = ([test["end"][each] for test in tests.values()] for each in ("p_kPa", "e"))
    along = [0.5 * min(p), 2.0 * max(p)]
    line = [parameters["Gamma"]["value"] - parameters["lambda"]["value"] * float(np.log(each)) for each in along]
    return [Series("critical state line", along, line),
            Series("ends of tests (hollow: not of the line)", p, e, "points",
                   ["certain" if name in parameters["Gamma"]["tests"] else "questionable" for name in tests])]


def _peaks(tests: Mapping[str, Any], x: str, y: str, line: tuple[float, float], caption: str, name: str, chart: Chart) -> list[Figure]:
    """Peaks, and a straight line y = a + b x over their range, from 0."""
    peaks = [test["peak"] for test in tests.values() if test["peak"] is not None]
    if not peaks:
        return []
    along = [each[x] for each in peaks]
    ends = [min(0.0, *along), max(0.0, *along)]
    chart.series = [Series("peaks of drained tests", along, [each[y] for each in peaks], "points"),
                    Series("as calibrated", ends, [line[0] + line[1] * each for each in ends])]
    return [Figure(name, chart, caption)]
