"""How phases ended, in words, and which of their numbers are lower bounds."""
from __future__ import annotations

from collections.abc import Sequence

from breachline.plot.chart import Certainty

from .document import Json, Table, Verdict
from .run import Phase, Run, fem
from .words import at_least, capital, entry, number, rounded


def any_moves(runouts: Sequence[Phase]) -> bool:
    """Their largest distance is a lower bound."""
    return any(each.still_moves for each in runouts)


def certainty_of(runout: Phase) -> Certainty:
    return "lower bound" if runout.still_moves else "questionable" if runout.questionable else "certain"


def bounded(runout: Phase, distance: str) -> str:
    """A distance of this runout, marked when it is a lower bound."""
    return at_least + distance if distance != "-" and runout.still_moves else distance


def _listed(flags: Sequence[Json], severity: str) -> str:
    return ", ".join(dict.fromkeys(each["code"].replace("_", " ") for each in flags if each["severity"] == severity))


def is_entangled(phase: Phase) -> bool:
    return bool(entry(phase.result, "/ended") == "entangled")


def entangled_at(phase: Phase) -> float | None:
    """[s]; None: it did not, or the time is not known."""
    if not is_entangled(phase):
        return None
    time = number(phase.result, "/entanglement/time")
    return number(phase.result, "/end_time") if time is None else time


def _facts(phase: Phase, *named: tuple[str, str, float, str]) -> str:
    found = [(name, number(phase.result, "/entanglement/" + key), scale, unit) for key, name, scale, unit in named]
    return ", ".join(f"{name}{value * scale:.4g}{unit}" for name, value, scale, unit in found if value is not None)


def _is_corner(phase: Phase) -> bool:
    return bool(entry(phase.result, "/entanglement/kind") == "corner")


def _where(phase: Phase) -> str:
    """entangled at 6.7 s in element 212 (region tailings, x = 34.1 m, y = 12 m), in the failure's band"""
    time, element = entangled_at(phase), entry(phase.result, "/entanglement/element")
    region = entry(phase.result, "/entanglement/region")
    place = ", ".join(filter(None, [region and f"region {region}", _facts(phase, ("x", "x = ", 1, " m"), ("y", "y = ", 1, " m"))]))
    kind = {"corner": ", at one bad corner, not in a failure's band", "band": ", in the failure's band"}
    return ("entangled" + (f" at {time:.6g} s" if time is not None else "") + (f" in element {element}" if element is not None else "")
            + (f" ({place})" if place else "") + kind.get(entry(phase.result, "/entanglement/kind", ""), ""))


def entanglement_of(phase: Phase) -> str:
    """In sentences; empty: the mesh did not entangle."""
    if not is_entangled(phase):
        return ""
    then = _facts(phase, ("mean_epsilon_q", "mean epsilon_q there ", 100, " %"), ("failure_surfaces", "failure surfaces ", 1, ""))
    return (f"The mesh {_where(phase)}" + (f"; then: {then}" if then else "") + ". "
            + ("That is the mesh's doing and not the section's failure: refine it there." if _is_corner(phase)
               else "So ends the FEM of a section that fails; it is no fault."))


def entanglements_of(fems: Sequence[Phase]) -> str:
    """The same for one; of several their number and times."""
    if len(fems) == 1:
        return entanglement_of(fems[0])
    entangled = [each for each in fems if is_entangled(each)]
    if not entangled:
        return ""
    times = sorted({time for each in entangled if (time := entangled_at(each)) is not None})
    text = f"{len(entangled)} of {len(fems)} meshes entangled"
    if times:
        text += f", at {times[0]:.6g} s" if len(times) == 1 else f", from {times[0]:.6g} to {times[-1]:.6g} s"
    corners = sum(map(_is_corner, entangled))
    return text + (f"; {corners} of them at one bad corner, which is the mesh's doing and not the section's failure." if corners else ".")


def how_it_ended(phase: Phase) -> str:
    """well; well, with warnings; questionable: still moving; entangled ...; or why there is no result."""
    if phase.fault:
        return phase.fault
    parts = [_where(phase)] if is_entangled(phase) else []
    if phase.questionable:
        parts.append("questionable: " + _listed(phase.flags, "questionable"))
    warnings = _listed([each for each in phase.flags if not each["code"].startswith("entangled")], "warning")
    return "; ".join((parts or ["well"]) + (["warnings: " + warnings] if warnings else []))


def how_they_ended(runouts: Sequence[Phase]) -> str:
    """well; 3 of 8 questionable: still moving; the fault of the first without a result."""
    if not runouts:
        return "none"
    faults = [each.fault for each in runouts if each.fault]
    doubtful = [each for each in runouts if each.questionable]
    if faults or not doubtful:
        return faults[0] if faults else "well"
    flags = [flag for each in doubtful for flag in each.flags]
    return f"{len(doubtful)} of {len(runouts)} questionable: " + _listed(flags, "questionable")


def verdict_of(run: Run) -> Verdict:
    """The service's, with place and time of each mesh that entangled."""
    found = entry(run.results, "/verdict") or run.about["verdict"]
    verdict = Verdict(found["words"], found["usable"] != "no")
    for each in found["reasons"]:
        if not each["code"].startswith("entangled"):
            (verdict.notes if each["usable"] in ("yes", "with_remarks") else verdict.cautions).append(each["text"])
    for each in run.of(fem):
        if end := entanglement_of(each):
            (verdict.cautions if _is_corner(each) else verdict.notes).append((capital(each.variant) + ": " if each.variant else "") + end)
    if not verdict.cautions and not verdict.notes:
        verdict.notes.append("No phase of this run raised a flag.")
    return verdict


def flag_table(run: Run) -> Table:
    phases: dict[tuple[str, ...], list[str]] = {}  # with the same flag
    for each in run.phases:
        for flag in each.flags:
            phases.setdefault((flag["code"].replace("_", " "), flag["severity"], flag["message"], flag.get("pointer") or "-"), []).append(each.label)
    return Table("flags", "Flags", ["flag", "severity", "what", "entry of the scene", "runs"],
                 [[*flag, ", ".join(labels)] for flag, labels in phases.items()],
                 "questionable: a number of that result is a bound or cannot be relied on. warning: the result holds, but is less certain.")


def range_of(phases: Sequence[Phase], pointer: str, grows: bool, digits: int = 3) -> str:
    """3 to 12.5 (8 of 9): least and largest over the phases that have it. grows: the largest is a lower bound while any soil moves."""
    known = sorted(((value, each) for each in phases if (value := number(each.result, pointer)) is not None), key=lambda pair: pair[0])
    count = f" ({len(known)} of {len(phases)})"
    if not known:
        return "-" + count
    largest = (at_least if grows and any_moves(phases) else "") + rounded(known[-1][0], digits)
    if len(known) == 1:
        return largest + count
    return (at_least if grows and known[0][1].still_moves else "") + f"{known[0][0]:.{digits}g} to {largest}" + count
