"""Limit equilibrium: section, critical surfaces, factor of safety against liquefied depth and against time."""
from breachline.plot.stability import stability_figures

from ..document import Chapter, Document
from ..run import lem, post_seismic
from . import Material


def add(of: Material, document: Document) -> None:
    _add_built(of, document)
    shaken = of.run.shown(post_seismic)
    if not shaken or not shaken.result:
        document.leave_out("factor of safety after the shaking",
                           f"post_seismic: {shaken.fault}" if shaken else "the study has no \"post_seismic\"")
        return
    chapter = Chapter("Stability after the shaking", of.run.which_of_several(shaken, "post-seismic stability analyses"),
                      stability_figures(shaken.files))
    for each in chapter.figures:
        each.caption = "Factor of safety with the strengths of each snapshot: residual where the soil has liquefied, those of the runout elsewhere." \
            if each.name == "safety_against_time" else "The critical surface with the strengths of the last snapshot."
        each.name += "_after_shaking"
    document.add(chapter)


def _add_built(of: Material, document: Document) -> None:
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
