"""The clauses of GISTM and CDA that the report serves, and where: by names of its tables and figures."""
from __future__ import annotations

from .document import Document

_gistm, _cda = "GISTM (2020)", "CDA (2021)"
_clauses = [
    (f"{_gistm} 2.3", "breach analysis: reach, arrival, depth and velocity, deposit",
     ["found", "front_gauges", "volume_balance", "gauges", "sections"]),
    (f"{_gistm} 4.4", "design criteria stated", ["stability"]),
    (f"{_gistm} 4.5", "factors of safety against criteria", ["stability", "numbers_lem_tool"]),
    (f"{_gistm} 4.6", "brittle failure, whatever the trigger", ["brittle_soils", "safety_against_depth"]),
    (f"{_gistm} 4.8", "basis of design: assumptions and sources", ["soils", "assumptions", "methods"]),
    (f"{_gistm} 5.4", "credible failure modes", ["failure_modes"]),
    (f"{_cda}, cases", "which breach this is: 1A to 2B", ["assessment_cases"]),
    (f"{_cda}, outflow", "released volume and hydrograph", ["volume_balance", "sections"]),
    (f"{_cda}, uncertainty", "sensitivity or samples", ["sensitivity", "tornado", "assessment"])]


def index_of(document: Document) -> list[tuple[str, str, list[tuple[str, str]]]]:
    """Clause, subject, and name and title of each place; no place: this report does not answer it."""
    titles = {each.name: each.title for each in document.tables} | {each.name: each.chart.title for each in document.figures}
    return [(clause, subject, [(name, titles[name]) for name in places if name in titles]) for clause, subject, places in _clauses]
