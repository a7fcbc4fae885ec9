"""Cyclic resistance and undrained strength of the materials from element tests, which belong to no run."""
from breachline.plot.element_tests import element_test_figures

from ..document import Chapter, Document
from ..words import entry
from . import Material


def add(of: Material, document: Document) -> None:
    if not of.choice.element_tests:
        for name, material in entry(of.run.scene, "/materials", {}).items():
            if entry(material, "/law/type") == "pm4sand":
                document.leave_out(f"cyclic resistance and undrained strength of {name}",
                                   "fem_solver element-test computes them; give its folder with --element-tests")
        return
    chapter = Chapter("Soil elements", "One point of soil under the laws of the analysis, by fem_solver element-test: cyclic resistance, undrained "
                      "and drained strength.")
    for each in element_test_figures(of.choice.element_tests):
        if each.name.endswith("_CRR") or "_csr" not in each.name:  # a single cyclic test is a point of its curve of resistance
            if of.paper:
                of.paper.add_points(each)
            chapter.figures.append(each)
    document.add(chapter)
