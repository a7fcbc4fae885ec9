"""Figures of results: the report, the verification pages and notebooks draw with these functions.

    from breachline import plot
    plot.runouts(run)                     # shown by a notebook
    plot.points_by_strain(run.frames()[-1], "strain", "Strain at the end").svg()

Needs matplotlib. A figure is data first (chart.py), so that its CSV has what its picture shows.
"""
from .chart import Axis, Certainty, Chart, Field, Figure, Mark, Series
from .draw import as_csv, as_png, as_svg, quoted
from .element_tests import element_test_figures
from .folder import read_json, write_figures
from .mesh import borders_of, colour_range, edges_of, element_epsilon_q, element_r_u, on_deformed_mesh
from .norsand import curve_column, norsand_figures
from .points import points_by_material, points_by_strain
from .runs import moved, runout_series, runouts
from .stability import critical_surface, line_of, stability_figures
from .transfer import BeforeAndAfter, LayerColours, compare, layers_of, side_by_side, write_transfer_figures
from .uncertainty import envelope_figures, exceedance_figure, tornado_figure

__all__ = [
    "Axis", "BeforeAndAfter", "Certainty", "Chart", "Field", "Figure", "LayerColours", "Mark", "Series", "as_csv", "as_png", "as_svg", "borders_of",
    "colour_range", "compare", "critical_surface", "curve_column", "edges_of", "element_epsilon_q", "element_r_u", "element_test_figures",
    "envelope_figures", "exceedance_figure", "layers_of", "line_of", "moved", "norsand_figures", "on_deformed_mesh", "points_by_material", "points_by_strain",
    "quoted", "read_json", "runout_series", "runouts", "side_by_side", "stability_figures", "tornado_figure", "write_figures", "write_transfer_figures"]
