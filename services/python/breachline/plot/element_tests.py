"""Figures of fem_solver element-test: curves of each test, CRR curves, undrained strength."""
from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import h5py  # type: ignore[import]

from ..faults import BreachlineError
from ..frames import Array
from .chart import Axis, Chart, Figure, Series
from .folder import RESULT, contents_of, read_json
from .norsand import Curves, curve_column, norsand_figures

ELEMENT_TESTS = "element_tests.h5"


def element_test_figures(folder: Path) -> list[Figure]:
    """folder: contains result.json and element_tests.h5. Raises OSError or BreachlineError."""
    result, curves = read_json(folder / RESULT), read_curves(folder / ELEMENT_TESTS)
    figures: list[Figure] = []
    with contents_of(folder / RESULT, "give a folder of element-test"):
        if "norsand_calibration" in result:
            return norsand_figures(result["norsand_calibration"], curves)
        for test, rows in sorted(result["tests"].items()):
            if not rows or "amplitude" in rows[0]:
                continue
            together = [_curve_of(test, row) for row in rows if "CSR" not in row]
            for name in (_curve_of(test, row) for row in rows if "CSR" in row):
                figures += _curves(curves, name, [name])
            figures += _curves(curves, test, together) if together else _crr(test, rows)
    return figures


def read_curves(path: Path) -> Curves:
    """The columns of an archive of element tests [SI], by name."""
    if not path.is_file():
        raise OSError(f"{path}: is not there; give a folder of element-test")
    try:
        with h5py.File(path) as file:
            columns: dict[str, Array] = {name: data[()] for name, data in file["breachline/reals"].items()}
    except (OSError, KeyError) as cause:
        raise BreachlineError(f"{path}: not a whole archive of element tests ({cause}); run the tests again") from cause
    return columns


def _curve_of(test: str, row: dict[str, Any]) -> str:
    """The name under which the bench stored a test's curve."""
    return f"{test}_sv{row['sigma_v_kPa']:.6g}kPa" + (f"_csr{row['CSR']:.6g}" if "CSR" in row else "")


def _curves(curves: Curves, page: str, names: Sequence[str]) -> list[Figure]:
    """Stress-strain, stress path and pore pressure of the curves of one page."""
    strain = Chart(f"{page}: stress-strain", Axis("strain [%]"), Axis("shear stress [kPa]"))
    path = Chart(f"{page}: stress path", Axis("σ′v [kPa]"), Axis("shear stress [kPa]"))
    pore = Chart(f"{page}: pore pressure ratio", Axis("strain [%]"), Axis("r_u [-]"))
    for each in names:
        epsilon, tau = curve_column(curves, f"{each}.strain", 0.01), curve_column(curves, f"{each}.response", 1e3)
        strain.series.append(Series(each, epsilon, tau))
        path.series.append(Series(each, curve_column(curves, f"{each}.sigma_yy", 1e3), tau))
        pore.series.append(Series(each, epsilon, curve_column(curves, f"{each}.r_u", 1.0)))
    return [Figure(f"{page}_stress_strain", strain), Figure(f"{page}_stress_path", path), Figure(f"{page}_pore_pressure", pore)]


def _crr(test: str, rows: Sequence[dict[str, Any]]) -> list[Figure]:
    """CSR against the cycles to the strain limit; tests that did not reach it have no point."""
    by_stress: dict[float, list[tuple[float, float]]] = {}
    for row in rows:
        if row["N_strain_limit"] is not None:
            by_stress.setdefault(row["sigma_v_kPa"], []).append((row["N_strain_limit"], row["CSR"]))
    series = [Series(f"σ′v0 = {stress:.6g} kPa", [N for N, _ in places], [CSR for _, CSR in places], "line_and_points")
              for stress, places in sorted(by_stress.items())]
    chart = Chart(f"{test}: cyclic resistance", Axis("cycles to the strain limit [-]", logarithmic=True), Axis("CSR [-]"), series)
    return [Figure(f"{test}_CRR", chart)] if series else []
