"""Figures of results: the report, the verification pages and notebooks draw with these functions.

Needs matplotlib. A figure is data first (chart.py), so that its CSV has what its picture shows.
"""
from .chart import Axis, Chart, Field, Figure, Mark, Series

__all__ = ["Axis", "Chart", "Field", "Figure", "Mark", "Series"]
