"""The methods of the phases that ran, with their sources."""
from ..document import Chapter, Document, Table
from ..run import fem, lem, mpm
from ..words import entry
from . import Material

_of_program = {
    lem: ["limit equilibrium",
          "Method of slices in plane strain. Bishop's simplified method on circles, also cut off at a weak layer or at firm ground; Spencer's on "
          "surfaces of straight pieces. The surface with the least factor of safety is searched for; liquefied layers then take their residual "
          "strength from the top down.",
          "Bishop (1955), Geotechnique 5(1), 7-17. Spencer (1967), Geotechnique 17(1), 11-26."],
    fem: ["finite elements",
          "Quadrilaterals in plane strain that couple the displacement of the soil with the pressure of its water (u-p), integrated in time by "
          "Newmark's method; a compliant base absorbs outgoing waves, columns of free soil hold the sides.",
          "Zienkiewicz & Shiomi (1984), Int. J. Numer. Anal. Meth. Geomech. 8(1), 71-96. McGann, Arduino & Mackenzie-Helnwein (2012), Acta "
          "Geotechnica 7, 297-311. Lysmer & Kuhlemeyer (1969), J. Eng. Mech. Div. 95(4), 859-877."],
    mpm: ["runout",
          "Generalised interpolation material point method in plane strain, explicit in time; Mohr-Coulomb in total stress, softening with shear "
          "strain; friction on the ground.",
          "Bardenhagen & Kober (2004), CMES 5(6), 477-495. Sordo, Rathje & Kumar (2024)."]}
_of_law = {
    "pm4sand": ["sand under shaking", "PM4Sand, a plasticity model for sand that liquefies",
                "Boulanger & Ziotopoulou (2017), PM4Sand version 3.1, UCD/CGM-17/01."],
    "norsand": ["sand, critical state", "NorSand, by the distance from the critical state line", "Jefferies (1993), Geotechnique 43(1), 91-103."]}
_of_transfer = ["transfer",
                "At the transfer time the whole state of the mesh becomes material points: mass, velocity and strain by the elements' shape "
                "functions, stress by interpolation between integration points of the same region.",
                "Sordo, Rathje & Kumar (2024), arXiv 2412.08040."]


def add(of: Material, document: Document) -> None:
    table = Table("methods", "What was computed how", ["part", "method", "source"])
    for program, row in _of_program.items():
        phase = of.run.first(program)
        if not phase:
            continue
        table.rows.append(row)
        if program == fem:
            laws = {entry(each, "/law/type") for each in entry(phase.scene, "/materials", {}).values()}
            table.rows += [row for law, row in _of_law.items() if law in laws] + [_of_transfer]
    table.rows.append(["verification", "Each program is compared with closed forms, published tables and independent programs; breach verify repeats "
                       "that on this machine.", "docs/verification/comparisons.md"])
    document.add(Chapter("Method, references and verification", tables=[table]))
