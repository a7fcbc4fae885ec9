"""The FEM's measurements against time, with the thresholds of the transfer window."""
from __future__ import annotations

from dataclasses import dataclass, field

from breachline.plot import Axis, Chart, Figure, Mark, Series

from ..document import Chapter, Document, Json
from ..ended import entanglement_of
from ..run import fem
from ..words import entry, number
from . import Material


@dataclass
class Plan:
    """One figure of telemetry, without fields that no line has."""

    name: str
    title: str
    label: str
    unit: float  #: of the label in SI
    curves: list[tuple[str, str]]  #: field and name
    caption: str
    missing: str = "the FEM's telemetry does not hold it"
    needs: str = ""  #: entry of the scene that gives the values a meaning
    marks: list[Mark] = field(default_factory=list)


def _liquefaction_caption(asked: Json) -> str:
    """The place where the scene looks for liquefaction."""
    level, regions, x = number(asked, "/level"), entry(asked, "/regions", []), entry(asked, "/x")
    return ("Depth of the deepest liquefied node" + (f" below y = {level:.6g} m" if level is not None else "")
            + (f" in {', '.join(regions)}" if regions else "") + (f" between x = {x[0]:.6g} and {x[1]:.6g} m" if x else "") + " (/fem/liquefaction).")


def _plans(settings: Json) -> list[Plan]:
    r_u = number(settings, "/liquefaction/r_u")
    threshold = "the threshold" if r_u is None else f"{r_u:.6g}"
    return [
        Plan("crest_displacement", "Displacement of the crest", "displacement [m]", 1.0,
             [("crest_displacement", "magnitude"), ("crest_dx", "downstream (x)"), ("crest_dy", "up (y)")],
             "Displacement of the node nearest to /fem/crest since the first dynamic stage began."),
        Plan("liquefaction_depth", "Liquefaction depth", "depth [m]", 1.0, [("liquefaction_depth", f"deepest r_u > {threshold}")],
             _liquefaction_caption(entry(settings, "/liquefaction", {})), "nothing can liquefy: the scene is dry or gives no /fem/liquefaction",
             "/fem/liquefaction"),
        Plan("kinetic_energy", "Kinetic energy", "kinetic energy [kJ]", 1e3, [("kinetic_energy", "kinetic energy")],
             "Of the whole mesh, for its thickness."),
        Plan("failure_surfaces", "Failure surfaces", "number [-]", 1.0, [("failure_surfaces", "failure surfaces")],
             "Bands of strained elements that cut the section from ground to ground.", "the scene asks for none (/fem/failure_surfaces)"),
        Plan("pore_pressure_ratio", "Largest pore pressure ratio", "r_u [-]", 1.0, [("r_u_max", "largest r_u")],
             "Largest r_u = (u - u_0) / sigma'_v0 of the watched nodes (/fem/liquefaction).",
             "the scene is dry, or watches nothing (/fem/liquefaction)", "/fem/liquefaction",
             [] if r_u is None else [Mark("y", r_u, f"liquefied: {threshold}")]),
        Plan("jacobian_average", "Distortion of strained elements", "|J_t| / |J_0| [-]", 1.0,
             [("jacobian_centre_avg", "average, centres (area)"), ("jacobian_least_avg", "average, worst corners"),
              ("jacobian_least_min", "least corner of all")],
             "Averages over the elements whose epsilon_q exceeds /fem/strain_threshold. The centre's ratio is the change of area and blind to shear; "
             "the worst corner's is not."),
        Plan("epsilon_q_average", "Strain of strained elements", "epsilon_q,avg [%]", 0.01, [("epsilon_q_avg", "average")],
             "Volume average of epsilon_q = sqrt(2/3 e:e) over the elements whose epsilon_q exceeds /fem/strain_threshold."),
    ]


def _timeline(of: Material) -> Figure:
    """Times of events, in the run and in the paper."""
    events = of.paper.values if of.paper else [{"key": "window_lower", "what": "window of transfer times opens"},
                                               {"key": "window_upper", "what": "window closes"}, {"key": "time_entangled", "what": "mesh entangles"}]
    figure = Figure("timeline", Chart("What happens when", Axis("time [s]"), Axis("", names=["here"] + (["paper"] if of.paper else []))),
                    "By the telemetry.")
    for each in events:
        if each["key"].startswith(("time_", "window_")):
            here = of.measures.get(each["key"])
            points = ([(here.value, 0.0)] if here else []) + ([(each["value"], 1.0)] if of.paper else [])
            if points:
                figure.chart.series.append(Series(each["what"], [x for x, _ in points], [y for _, y in points], "points"))
    return figure


def add(of: Material, document: Document) -> None:
    phase = of.run.shown(fem)
    if not phase or not phase.telemetry:
        document.leave_out("courses of crest, energy, strain and distortion",
                           f"the FEM ended before its first line of telemetry: {phase.fault}" if phase
                           else "the run has no FEM: its points fill the section")
        return
    end = f"The FEM ended early: {phase.fault}" if phase.fault else entanglement_of(phase)
    chapter = Chapter("Motion and failure", of.run.which_of_several(phase, "finite element analyses") + end, [_timeline(of)])
    for plan in _plans(entry(phase.scene, "/fem", {})):
        needed = not plan.needs or entry(phase.scene, plan.needs) is not None
        courses = [(name, phase.course(key, plan.unit)) for key, name in plan.curves if needed]
        series = [Series(name, *course) for name, course in courses if course[0]]
        if not series:
            document.leave_out(plan.title, plan.missing)
            continue
        limits = dict.fromkeys(each["value"] / plan.unit for each in of.measures.found["thresholds"]
                               if each["field"] in [key for key, _ in plan.curves])
        figure = Figure(plan.name, Chart(plan.title, Axis("time [s]"), Axis(plan.label), series,
                                         plan.marks + [Mark("y", value, f"threshold {value:.6g}") for value in limits]
                                         + of.measures.window.marks()), plan.caption)
        if of.paper:
            of.paper.add_points(figure)
        chapter.figures.append(figure)
    document.add(chapter)
