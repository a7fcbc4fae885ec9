"""Brittle soils with the runs that assume them triggered, and the credible failure modes: analysed, screened, or not modelled."""
from __future__ import annotations

from ..document import Chapter, Document, Json, Table
from ..run import Phase, Run, fem, lem, mpm, post_seismic
from ..words import entry, joined, number, or_dash, rounded
from . import Material
from .assessment import cases_of
from .inputs import residual_of, strength_of


def _material_of(scene: Json, region: str) -> str:
    return next((str(each["material"]) for each in scene["section"]["regions"] if each["name"] == region), "")


def _layers(run: Run) -> dict[str, float | None]:
    """Materials of the layers that may liquefy, with their residual strength [kPa]; None: the material has it."""
    return {_material_of(phase.scene, each["region"]): number(each, "/residual_strength_kPa") or None
            for phase in run.of(lem)[:1] for each in entry(phase.scene, "/lem/liquefaction", [])}


def _undrained_peak(run: Run, material: str) -> float | None:
    """[kPa] of the stability analyses that fail it undrained."""
    found = [strength for phase in run.of(lem) for each in entry(phase.scene, "/lem/undrained", [])
             if _material_of(phase.scene, each["region"]) == material and (strength := number(each, "/strength_kPa"))]
    return max(found, default=None)


def _begins_weak(scene: Json, name: str, residual: float | None) -> bool:
    """The runout begins with the residual strength."""
    soil = scene["materials"].get(name, {})
    if residual is None:
        return bool(entry(soil, "/strength/residual")) and entry(soil, "/strength/residual") == entry(soil, "/strength/peak")
    return number(soil, "/law/c_kPa") == residual and not number(soil, "/law/phi_deg")


def _brittle(run: Run) -> Table:
    table = Table("brittle_soils", "Brittle soils, and the runs that assume them triggered",
                  ["soil", "before", "after", "brittleness", "triggered in"], [],
                  "Brittleness: share of the undrained peak strength that is lost (Bishop 1967). Triggered: the runout begins with the strength "
                  "after, whatever the trigger (GISTM 4.6). Softens: the runout finds where.")
    layers = _layers(run)
    for name, soil in entry(run.scene, "/materials", {}).items():
        residual, peak = layers.get(name), _undrained_peak(run, name)
        after = residual_of(soil) if residual is None else f"s_u = {residual:.3g} kPa"
        if after == "-":
            continue
        begun = [each.variant or each.label for each in run.of(mpm) if name in layers and _begins_weak(each.scene, name, residual)]
        drained = entry(soil, "/limit_strength") if name in layers else None
        before = {"type": "mohr_coulomb", **drained} if drained else entry(soil, "/strength/peak") or soil["law"]
        table.rows.append([name, f"s_u = {peak:.3g} kPa" if peak else strength_of(before), after,
                           or_dash(1.0 - residual / peak if peak and residual else None, 2),
                           joined(begun) or ("softens with strain" if run.of(mpm) and name not in layers else "no runout")])
    return table


def _least(phases: list[Phase]) -> str:
    factors = [factor for each in phases if (factor := number(each.result, "/factor_of_safety")) is not None]
    return f"least factor of safety {rounded(min(factors), 3)}" if factors else ""


def _modes(run: Run, brittle: Table) -> Table:
    """A mode is analysed where the run has an answer to it."""
    stability, water = run.of(lem), "no water flows or erodes in the model"
    tilted = [each for each in stability if number(each.scene, "/lem/seismic_coefficient")]
    layered = [each for each in stability if entry(each.scene, "/lem/floor") or entry(each.result, "/non_circular")]
    triggered = [row[4] for row in brittle.rows if row[4] not in ("softens with strain", "no runout")]
    rows = [("sliding of the dam and its foundation", _least(stability), "needs \"stability\" of the study"),
            ("sliding along a thin weak layer", _least(layered), "circular surfaces only; /lem/floor or /lem/non_circular follows a layer"),
            ("static liquefaction", f"runouts that begin with it: {triggered[0]}" if triggered and run.is_static else "",
             "no soil begins with its residual strength"),
            ("earthquake, pseudo-static", _least(tilted), "needs a variant with /lem/seismic_coefficient"),
            ("liquefaction by an earthquake", (_least(run.of(post_seismic)) or "finite elements under shaking") if run.is_shaken else "",
             "the study has no motion"),
            ("overtopping", "", f"{water}; see the freeboard left, in Released volume"),
            ("internal erosion and piping", "", water),
            ("erosion of the breach by the pond", "", water)]
    return Table("failure_modes", "Credible failure modes", ["mode", "status", "result, or why not"],
                 [[mode, "analysed" if found else "not analysed", found or why] for mode, found, why in rows],
                 "Whether a mode that is not analysed is credible at this site, its engineer says.")


def add(of: Material, document: Document) -> None:
    brittle = _brittle(of.run)
    if of.run.of(lem) or of.run.of(fem) or of.run.of(mpm):
        document.add(Chapter("Failure modes", tables=[_modes(of.run, brittle), brittle, *([cases_of(of.run)] if of.run.first(mpm) else [])]))
