"""Limit equilibrium: section, critical surfaces, factor of safety against liquefied depth."""
from breachline.plot.stability import stability_figures

from ..document import Chapter, Document
from ..run import lem
from . import Material


def add(of: Material, document: Document) -> None:
    phase = of.run.shown(lem)
    if not phase or not phase.result:
        document.leave_out("section and critical surfaces, factor of safety against liquefied depth",
                           f"lem_tool: {phase.fault}" if phase
                           else "the run has no limit equilibrium (the study's \"stability\", the scene's /lem)")
        return
    chapter = Chapter("Stability", of.run.which_of_several(phase, "stability analyses"), stability_figures(phase.files))
    for each in chapter.figures:
        if of.paper:
            of.paper.add_points(each)
        each.caption = "Factor of safety of the critical surface while layers liquefy from the top down." if each.name == "safety_against_depth" \
            else "The critical surface of each stage, and of the other kinds before any layer liquefies."
    if "stages" not in phase.result:
        document.leave_out("factor of safety against liquefied depth", "the scene liquefies no layers (/lem/liquefaction)")
    document.add(chapter)
