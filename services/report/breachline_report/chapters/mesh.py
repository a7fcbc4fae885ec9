"""Contours of epsilon_q and r_u and the deformed mesh at chosen snapshots of the FEM."""
from __future__ import annotations

from pathlib import Path

from breachline.frames import read
from breachline.plot import Axis, Chart, Figure
from breachline.plot.mesh import borders_of, colour_range, edges_of, element_epsilon_q, element_r_u, on_deformed_mesh

from ..document import Chapter, Document
from ..run import fem
from . import Material


def _chosen(files: list[tuple[float, Path]], times: list[float]) -> list[tuple[float, Path]]:
    """Nearest to the requested times; without any, four over the run with its end."""
    if times:
        picked = [min(files, key=lambda each: abs(each[0] - time)) for time in times]
    else:
        wanted = min(4, len(files))
        picked = [files[k * len(files) // wanted - 1] for k in range(1, wanted + 1)]
    return list(dict.fromkeys(picked))


def _figure(time: float, name: str, title: str, caption: str) -> Figure:
    return Figure(f"{name}_{time:.10g}s", Chart(f"{title} at {time:.6g} s", Axis("x [m]"), Axis("y [m]"), equal=True), caption)


def add(of: Material, document: Document) -> None:
    phase = of.run.shown(fem)
    files = phase.snapshots() if phase else []
    if not phase or not files:
        document.leave_out("contours of epsilon_q and r_u, deformed meshes", "the FEM left no snapshot" if phase else "the run has no FEM")
        return
    meshes = [(time, read(file)) for time, file in _chosen(files, of.choice.snapshot_times)]
    chapter = Chapter("Strain, pore pressure and mesh", of.run.which_of_several(phase, "finite element analyses")
                      + f"{len(meshes)} of {len(files)} snapshots; colours have one scale for all times of a quantity.")
    strains = colour_range(element_epsilon_q(meshes[-1][1]))
    wet = [(time, mesh, r_u) for time, mesh in meshes if (r_u := element_r_u(mesh)) is not None]
    fields = [("epsilon_q", "epsilon_q [%]", time, mesh, element_epsilon_q(mesh), strains) for time, mesh in meshes] \
        + [("r_u", "r_u [-]", time, mesh, r_u, (0.0, 1.0)) for time, mesh, r_u in wet]
    for name, label, time, mesh, values, limits in fields:
        figure = _figure(time, name, label, "Element averages on the mesh where it has moved to; displacements are not exaggerated.")
        figure.chart.field = on_deformed_mesh(mesh, values, label, limits)
        figure.chart.series = [borders_of(mesh)]
        chapter.figures.append(figure)
    if not wet:
        document.leave_out("contours of r_u", "the mesh carries no pore pressure: dry")
    for time, mesh in meshes:
        quads = 0 if mesh.quads is None else len(mesh.quads)
        figure = _figure(time, "mesh", "Deformed mesh", f"{quads} elements; displacements are not exaggerated.")
        figure.chart.series = [edges_of(mesh)]
        chapter.figures.append(figure)
    document.add(chapter)
