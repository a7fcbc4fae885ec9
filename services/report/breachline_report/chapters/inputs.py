"""The section, its soils and its water; and the annex with every entry that the run's phases read, defaults marked."""
from __future__ import annotations

import json
import re
from dataclasses import dataclass
from functools import cached_property

from ..document import Chapter, Document, Json, Table
from ..run import Run, ask
from ..words import entry, number, rounded
from . import Material

_about_marks = "* default value, left out of the scene or equal to it."
_abreast = 5  # materials side by side on a portrait page
_many_digits = 10  # a number with more is derived from others
#: An entry goes to the first group that it is below; the last groups take the rest of a phase.
_groups = [
    ("water", "Water", ("/lem/water", "/lem/piezometric_lines", "/lem/pore_pressure_ratios", "/lem/undrained", "/lem/liquefaction", "/fem/water",
                        "/fem/liquefaction", "/transfer/phreatic_line", "/transfer/liquefied")),
    ("boundary", "Boundary and loads", ("/fem/supports", "/fem/base", "/fem/free_field", "/fem/surcharge", "/lem/surcharge",
                                        "/mpm/left", "/mpm/right", "/mpm/floor", "/mpm/terrain", "/mpm/domain_x", "/mpm/domain_y")),
    ("motion", "Motion and stages", ("/fem/motion", "/fem/stages", "/lem/seismic_coefficient", "/mpm/shaking")),
    ("settings_lem", "Limit equilibrium: all other settings", ("/lem",)),
    ("settings_fem", "Finite elements: all other settings", ("/fem",)),
    ("settings_transfer", "Transfer: all other settings", ("/transfer",)),
    ("settings_mpm", "Material points: all other settings", ("/mpm",)),
    ("settings_scene", "Of the whole scene", ("",))]


def _is_below(pointer: str, top: str) -> bool:
    return pointer == top or pointer.startswith(top + "/")


def _plain(value: Json) -> str:
    return rounded(value, 7) if isinstance(value, float) and len(str(value)) > _many_digits else json.dumps(value, ensure_ascii=False)


@dataclass
class Entry:
    pointer: str  #: "/mpm/floor/level"
    value: Json
    unit: str
    what: str  #: the schema's description
    default: bool  #: the program's own value

    @property
    def text(self) -> str:
        """With a star where it is the default; page.py sets those rows in one paragraph."""
        return (self.value if isinstance(self.value, str) else _plain(self.value)) + (" *" if self.default else "")

    @property
    def words(self) -> str:
        """The description's first clause that names no phase and no value, and the unit."""
        clauses = [each.strip() for each in re.split(r"[;:,()]|\. |\.$", self.what)]
        named = [each for each in clauses if len(each) > 4 and not re.match("fem|mpm|lem", each) and each != self.value]
        return (named[0] if named else "") + (f" [{self.unit}]" if self.unit else "")


class Inputs:
    """What the service's program says of the scene; asked once for both chapters."""

    def __init__(self, run: Run) -> None:
        self.run, self.scene = run, run.scene

    @cached_property
    def _said(self) -> Json:
        overrides = self.run.study.get("overrides", [])
        return ask("inputs", self.run.folder, {"scene": self.scene, "set": [each.split("=")[0] for each in overrides]})

    @property
    def drawing(self) -> str:
        return self._said["drawing"] or ""

    @property
    def breach_width(self) -> Json:
        """{"low", "best", "high", "from"}; None: the scene has no runout."""
        return self._said["breach_width"]

    @cached_property
    def entries(self) -> list[Entry]:
        """Without notes, which have a table, and without the transfer's where nothing is transferred: every completed scene has them."""
        found = [Entry(**each) for each in self._said["entries"] if not each["pointer"].endswith("/notes")]
        return [each for each in found if not (self.run.is_static and _is_below(each.pointer, "/transfer"))]

    def below(self, top: str) -> list[tuple[str, Entry]]:
        return [(each.pointer.removeprefix(top), each) for each in self.entries if each.pointer.startswith(top)]


def _number(value: Json, digits: int = 4) -> str:
    return rounded(value, digits) if isinstance(value, (int, float)) and not isinstance(value, bool) else "-"


def strength_of(of: Json) -> str:
    """drained c' = 5 kPa, phi' = 30 deg; s_u = 0.22 sigma'_v0; "-": the law has no strength."""
    kind = of.get("type", "")

    def value(key: str) -> str:
        return _number(of.get(key, 0.0), 3)

    if kind in ("effective", "mohr_coulomb"):
        return f"c' = {value('c_kPa')} kPa, phi' = {value('phi_deg')} deg" if of.get("phi_deg") else f"s_u = {value('c_kPa')} kPa"
    known = {"undrained": f"s_u = {value('s_u_kPa')} kPa", "undrained_ratio": f"s_u = {value('ratio')} sigma'_v0",
             "undrained_by_depth": f"s_u = {value('at_ground_kPa')} kPa + {value('per_metre_kPa')} kPa/m of depth",
             "relation": f"s_r by {of.get('relation', '')}", "norsand": f"psi_0 = {value('psi_0')}",
             "pm4sand": f"D_R = {value('D_R')}, G_0 = {value('G_0')}, h_po = {value('h_po')}"}
    return known.get(kind, f"s_u by {kind[10:]}" if kind.startswith("undrained") else "-")


def _in_motion(soil: Json) -> str:
    """", in motion s_u = 0.122 sigma'_v0"; "" without a strength of dynamic stages."""
    own = entry(soil, "/dynamic_strength", {})
    return f", in motion s_u = {_number(own['ratio'] * own.get('factor', 1.0), 3)} sigma'_v0" if own else ""


def residual_of(soil: Json) -> str:
    if profile := entry(soil, "/strength/residual"):
        return strength_of(profile)
    softening = entry(soil, "/law/softening")
    return strength_of({"type": "mohr_coulomb", "c_kPa": softening.get("c_residual_kPa", 0.0),
                      "phi_deg": softening.get("phi_residual_deg", soil["law"].get("phi_deg", 0.0))}) if softening else "-"


def _used(run: Run, name: str) -> str:
    """The strengths that the run's phases used, where they differ: 8.7 to 29.4 kPa."""
    found = {value for each in run.phases if (value := number(each.scene, f"/materials/{name}/law/c_kPa")) is not None}
    return f"{min(found):.3g} to {max(found):.3g} kPa" if len(found) > 1 else "-"


def _notes_of(part: Json) -> list[str]:
    notes = part.get("notes", [])
    return notes if isinstance(notes, list) else [notes]


def _soils(run: Run) -> Table:
    """One row per soil of a region or of the transfer."""
    return Table("soils", "Soils, with the source of their values",
                 ["soil", "law", "density [kg/m3]", "strength", "after softening", "c in the run", "E [MPa]", "nu", "permeability [m/s]", "source"],
                 [[name, soil["law"].get("type", "").replace("_", " "), _number(soil.get("density")),
                   strength_of(entry(soil, "/strength/peak") or soil["law"]) + _in_motion(soil), residual_of(soil), _used(run, name),
                   _number(soil["law"].get("E_MPa")), _number(soil["law"].get("nu")), _number(entry(soil, "/permeability/0"), 3),
                   "; ".join(_notes_of(soil)) or "the scene does not say: add \"notes\" to the material"]
                  for name, soil in entry(run.scene, "/materials", {}).items()],
                 "Strength before failure, and what the soil softens to. c in the run: least and largest over its variants. The annex has every "
                 "entry.")


def _notes(scene: Json) -> Table:
    parts = [("scene", scene)] + [(title, entry(scene, key, {})) for key, title in (
        ("/lem", "limit equilibrium"), ("/fem", "finite elements"), ("/transfer", "transfer"), ("/mpm", "runout"))]
    return Table("assumptions", "Notes of the scene", ["of", "note"], [[name, each] for name, part in parts for each in _notes_of(part)])


def add(inputs: Inputs, document: Document) -> None:
    document.add(Chapter("Inputs", "The table of variants lists their changes, the annex every entry.",
                         tables=[_soils(inputs.run), _notes(inputs.scene)], drawing=inputs.drawing))


# ---------------------------------------------------------------- annex


def _area(polygon: Json) -> float:
    """By the shoelace formula [m2]."""
    return 0.5 * abs(sum(float(a[0] * b[1] - b[0] * a[1]) for a, b in zip(polygon, polygon[1:] + polygon[:1])))


def _regions(inputs: Inputs) -> Table:
    table = Table("section", "Regions", ["region", "material", "area [m2]", "corners (x, y) [m]", "mesh"])
    for k, region in enumerate(inputs.scene["section"]["regions"]):
        mesh = [f"{key} {each.text}" for key, each in inputs.below(f"/section/regions/{k}/") if key not in ("name", "material", "polygon")]
        table.rows.append([region.get("name", "-"), region.get("material", "-"), rounded(_area(region["polygon"]), 6),
                           " ".join(f"({round(x, 2):.9g}, {round(y, 2):.9g})" for x, y in region["polygon"]), "; ".join(mesh) or "-"])
    return table


def _materials(inputs: Inputs) -> list[Table]:
    """Side by side, one row per entry that one of them has."""
    names = list(entry(inputs.scene, "/materials", {}))
    tables: list[Table] = []
    for first in range(0, len(names), _abreast):
        shown = names[first:first + _abreast]
        rows: dict[str, list[str]] = {}
        for k, name in enumerate(shown):
            for key, each in inputs.below(f"/materials/{name}/"):
                rows.setdefault(key, [key, each.words] + ["-"] * len(shown))[2 + k] = each.text
        page = len(tables) + 1
        tables.append(Table("materials" if page == 1 else f"materials_{page}", "Materials" if page == 1 else "Materials, continued",
                            ["entry of the material", "in words", *shown], list(rows.values()), _about_marks))
    return tables


def add_annex(inputs: Inputs, document: Document) -> None:
    by_group: dict[str, list[list[str]]] = {name: [] for name, _, _ in _groups}
    for each in inputs.entries:
        if not _is_below(each.pointer, "/materials") and not _is_below(each.pointer, "/section/regions"):
            group = next(name for name, _, tops in _groups if any(_is_below(each.pointer, top) for top in tops))
            by_group[group].append([each.pointer, each.words, each.text])
    defaults = sum(each.default for each in inputs.entries)
    document.add(Chapter("Annex: the scene, entry by entry", f"{len(inputs.entries)} entries, {defaults} of them at the program's own value (*).",
                         tables=[_regions(inputs), *_materials(inputs)]
                         + [Table(name, title, ["entry of the scene", "in words", "value"], by_group[name]) for name, title, _ in _groups]))
