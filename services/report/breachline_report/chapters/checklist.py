"""Questions of a reviewer of a deformation analysis (after Boulanger & Beaty 2016 and USSD 2022), answered from the run."""
from __future__ import annotations

from ..document import Chapter, Document, Table
from ..run import Phase, Run, fem, lem
from ..words import entry, fact, number
from . import Material


def _three(phase: Phase, pointer: str) -> str:
    return fact(phase.result, pointer, digits=3)


def _flagged(run: Run, *codes: str) -> str:
    """Flags of the phases with one of these codes."""
    said = dict.fromkeys(flag["code"] for each in run.phases for flag in each.flags if flag["code"] in codes)
    return "; flagged: " + ", ".join(said) if said else ""


def _laws(run: Run) -> str:
    by_law: dict[str, list[str]] = {}
    for name, material in entry(run.scene, "/materials", {}).items():
        by_law.setdefault(str(entry(material, "/law/type", "none")), []).append(name)
    return "; ".join(f"{law} ({', '.join(names)})" for law, names in sorted(by_law.items()))


def _stability(run: Run, phase: Phase | None) -> str:
    if not phase or not phase.result:
        return ""
    critical = f", critical depth {_three(phase, '/critical_depth')} m" if number(phase.result, "/critical_depth") is not None else ""
    return (f"factor of safety {_three(phase, '/factor_of_safety')} before anything liquefies{critical}" + _flagged(run, "bound_raises_factor"))


def _mesh(phase: Phase) -> str:
    return (f"{fact(phase.result, '/elements')} elements {entry(phase.scene, '/fem/element')}, edges of {_three(phase, '/mesh/shortest_edge')} to "
            f"{_three(phase, '/mesh/longest_edge')} m, smallest angle {_three(phase, '/mesh/smallest_angle_deg')} degrees" if phase.result else "")


def _boundaries(run: Run, phase: Phase) -> str:
    base = entry(phase.scene, "/fem/base")
    return (("free-field columns" if isinstance(entry(phase.scene, "/fem/free_field"), dict) else "held edges") + " at the sides; "
            + (f"below, rock of V_s {base['V_s']} m/s with dashpots" if isinstance(base, dict) else "a held base")
            + _flagged(run, "upstream_wall", "reached_wall", "free_upstream_end"))


def _damping(run: Run, phase: Phase) -> str:
    wanted = entry(phase.scene, "/fem/damping")
    share = f"; in the failing soil it carries {_three(phase, '/viscous_share')} of what the soil does" \
        if number(phase.result, "/viscous_share") is not None else ""
    return (f"Rayleigh, ratio {wanted.get('ratio')} at {wanted.get('frequency_Hz')} Hz" if isinstance(wanted, dict)
            else f"stiffness-proportional, beta {entry(phase.scene, '/fem/rayleigh_stiffness')} s") + share + _flagged(run, "viscous_band")


def _initial_stress(phase: Phase) -> str:
    return "; ".join(f"{name}: K {fact(stage, '/K_average', digits=3)} on average, out of balance {fact(stage, '/out_of_balance', digits=3)}"
                     for name, stage in entry(phase.result, "/geostatic", {}).items())


def _water(phase: Phase) -> str:
    if not isinstance(entry(phase.scene, "/fem/water"), dict):
        return "dry"
    depth = f"; liquefied to {_three(phase, '/largest_liquefaction_depth')} m" \
        if number(phase.result, "/largest_liquefaction_depth") is not None else ""
    return f"pressure and displacement together, {fact(phase.result, '/pressure_unknowns')} pressures{depth}"


def _motion(run: Run, phase: Phase | None) -> str:
    motion = entry(phase.result, "/motion") if phase else None
    if not phase or not motion:
        return "" if run.is_static else "none"
    files = {entry(each.scene, "/fem/motion/file") for each in run.of(fem)} - {None}
    return f"{motion['file']}: PGA {_three(phase, '/motion/pga_g')} g, PGV {_three(phase, '/motion/pgv')} m/s; {len(files)} record(s) in the run"


def _softening(run: Run) -> str:
    lengths = [f"{name} {material['nonlocal_length']} m" for name, material in entry(run.scene, "/materials", {}).items()
               if number(material, "/nonlocal_length") is not None]
    return (", ".join(lengths) or "nothing: bands are as wide as a cell") + _flagged(run, "local_softening", "wide_band")


def _transfer(run: Run) -> str:
    if run.is_static:
        return ""
    times = run.study.get("transfer_times", [])
    named = [each.get("name") or each.get("kind", "") for each in run.study.get("triggers", [])] + ([f"{len(times)} given times"] if times else [])
    return "; ".join(named) or "not known: the run has no study"


def _runout(run: Run, phase: Phase) -> str:
    return (f"cells of {entry(phase.scene, '/mpm/cell_size')} m, {fact(phase.result, '/particles')} points; overlap {_three(phase, '/overlap')}, "
            f"energy that the scheme took {_three(phase, '/energy/numerical/share')} of what was released"
            + _flagged(run, "coarse_cells", "thin_deposit", "overlap", "overlap_work", "numerical_share"))


def _error(phase: Phase) -> str:
    if phase.error is None:
        return "no estimate" + (f": {phase.error_from}" if phase.error_from else "")
    return f"{phase.error:.2g} m, from {phase.error_from}"


def add(of: Material, document: Document) -> None:
    run, mesh, runout = of.run, of.run.shown(fem), of.run.farthest
    answers = [
        ("Which laws do the soils have?", _laws(run)),
        ("Does limit equilibrium agree that it can fail?", _stability(run, run.first(lem))),
        ("How fine is the mesh?", mesh and _mesh(mesh)),
        ("What are the boundaries at the sides and below?", mesh and _boundaries(run, mesh)),
        ("What damps, and how much does it carry?", mesh and _damping(run, mesh)),
        ("What are the initial stresses?", mesh and _initial_stress(mesh)),
        ("Does pore water flow?", mesh and _water(mesh)),
        ("Was the soil calibrated on elements?", "see the chapter on element tests" if of.choice.element_tests
         else "not shown here: --element-tests FOLDER adds the laboratory's curves"),
        ("Which motion, and how many?", _motion(run, mesh)),
        ("What gives softening its length?", _softening(run)),
        ("Why was it transferred when it was?", _transfer(run)),
        ("How fine is the runout, and what does its scheme take?", runout and _runout(run, runout)),
        ("How far may the runout be off?", runout and _error(runout)),
        ("What is left out?", "a plane section: no third dimension, no channel; no mixing with water on the way; no consolidation while it flows; no "
                              "water that flows along")]
    document.add(Chapter("What a reviewer asks", tables=[Table(
        "checklist", "Questions and answers", ["question", "answer of this run"],
        [[question, answer] for question, answer in answers if answer]
        + [["Not modelled in this run", " ".join(question for question, answer in answers if not answer)]] * any(not answer for _, answer in answers),
        "After the subjects of Boulanger & Beaty (2016) and USSD (2022). Of several analyses, the one that is shown; of runouts, the farthest.")]))
