"""Figures of transfer_tool: vertical effective stress, pore pressure ratio and liquefied layers on the mesh (before) and on the points
(after), with the same colours."""
from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..frames import Array, Frame, read
from .chart import Axis, Chart, Figure
from .folder import SCENE, contents_of, read_json, write_figures
from .mesh import borders_of, element_r_u, largest_excess_pressure, on_deformed_mesh
from .points import on_points

PARTICLES = "particles.vtkhdf"


@dataclass
class LayerColours:
    """Layers by initial vertical effective stress."""

    r_u: float = 0.7  #: liquefied above this
    ever: bool = False  #: at any time so far; else at the transfer
    ends: list[float] = field(default_factory=list)  #: of each layer [Pa]
    materials: list[str] = field(default_factory=list)  #: of each layer


@dataclass
class BeforeAndAfter:
    before: Figure
    after: Figure


def layers_of(scene: dict[str, Any]) -> LayerColours:
    """The layers of a completed scene; empty when nothing liquefies in it."""
    layers, liquefied = LayerColours(), scene["transfer"].get("liquefied")
    if not liquefied:
        return layers
    layers.r_u, layers.ever = liquefied["r_u"], liquefied.get("when", "at_transfer") == "ever"  # older results lack it
    for number, layer in enumerate(liquefied["layers"], 1):
        layers.ends.append(1e3 * layer["sigma_v0_kPa"][1])
        layers.materials.append(layer["material"] if "material" in layer else f"{liquefied['residual_strength']['like']}_{number}")
    return layers


def compare(mesh: Frame, points: Frame, layers: LayerColours) -> list[BeforeAndAfter]:
    """sigma'_v always; r_u where the points have it; layers where there are any. On the mesh, layers are elements with mean r_u above the
    threshold, by their initial stress. On the points, layers are the materials after the transfer, which also cover soil above such elements."""
    stress = -1e-3 * mesh["stress"][:, 1]
    most = 50.0 * max(1.0, np.ceil(stress.max(initial=0.0) / 50.0))
    pairs = [_pair("sigma_v", "vertical effective stress", "σ′v [kPa]", most, mesh, stress, points, _sigma_v(points))]
    r_u = element_r_u(mesh)
    if r_u is None or "r_u" not in points.fields:
        return pairs
    pairs.append(_pair("r_u", "excess pore pressure ratio", "r_u [-]", 1.0, mesh, r_u, points, points["r_u"]))
    if layers.ends:
        numbers = {material: float(number) for number, material in reversed(list(enumerate(layers.materials, 1)))}
        pairs.append(_pair("liquefied", "liquefied layers", "layer by σ′v0 (0: not liquefied)", len(layers.ends), mesh, _layer_numbers(mesh, layers),
                           points, np.array([numbers.get(each, 0.0) for each in points.materials])[points["region"]]))
    return pairs


def side_by_side(pairs: list[BeforeAndAfter]) -> str:
    """All pairs in one SVG, before on the left and after on the right."""
    rows, width, y = [], 0.0, 0.0
    for pair in pairs:
        x = height = 0.0
        for svg in (pair.before.svg(), pair.after.svg()):
            own_width, own_height = (float(each) for each in re.findall(r'viewBox="0 0 ([0-9.]+) ([0-9.]+)"', svg)[0])
            rows.append(re.sub(r'width="[^"]*" height="[^"]*"', f'x="{x:.2f}" y="{y:.2f}" width="{own_width}" height="{own_height}"', svg, count=1))
            x, height = x + own_width, max(height, own_height)
        width, y = max(width, x), y + height
    size = f'viewBox="0 0 {width:.2f} {y:.2f}" width="{width:.2f}pt" height="{y:.2f}pt"'
    return f'<svg xmlns="http://www.w3.org/2000/svg" {size}>\n' + "".join(rows) + "</svg>\n"


def write_transfer_figures(folder: Path, output: Path) -> None:
    """Writes each figure, and all of them as before_and_after.svg. folder: contains particles.vtkhdf and scene.completed.json. The snapshot is
    looked up at its recorded path, else beside the particles. Raises OSError or BreachlineError."""
    points, scene = read(folder / PARTICLES), read_json(folder / SCENE)
    with contents_of(folder / SCENE, "give a folder of transfer_tool"):
        pairs = compare(_snapshot_of(folder, points), points, layers_of(scene))
    write_figures(output, [each for pair in pairs for each in (pair.before, pair.after)])
    (output / "before_and_after.svg").write_text(side_by_side(pairs), encoding="utf-8")


def _sigma_v(points: Frame) -> Array:
    """Vertical effective stress, compression positive [kPa]: subtracts the pore pressure from total stress. Buoyant stress is shown as
    it is: less the excess pressure."""
    stress = points["stress"][:, 1]
    if "pore_pressure" in points.fields:
        total = np.array([each == "total" for each in points.stress_of_regions] or [False] * len(points.regions))
        stress = stress + points["pore_pressure"] * total[points["region"]]
    return np.asarray(-1e-3 * stress)


def _layer_numbers(mesh: Frame, layers: LayerColours) -> Array:
    """From 1; 0: not liquefied."""
    assert mesh.quads is not None
    r_u = element_r_u(mesh, largest_excess_pressure(mesh) if layers.ever else None)
    layer = np.searchsorted(layers.ends, mesh["sigma_v0"][mesh.quads].mean(axis=1), side="right")
    return np.where(np.asarray(r_u) > layers.r_u, np.minimum(layer, len(layers.ends) - 1) + 1.0, 0.0)


def _pair(name: str, title: str, label: str, most: float, mesh: Frame, on_mesh: Array, points: Frame, at_points: Array) -> BeforeAndAfter:
    def figure(when: str, words: str, coloured: Any) -> Figure:
        return Figure(f"{name}_{when}", Chart(f"{title}, {words}", Axis("x [m]"), Axis("y [m]"), [borders_of(mesh)], equal=True, field=coloured))

    return BeforeAndAfter(figure("before", "before (mesh)", on_deformed_mesh(mesh, on_mesh, label, (0.0, most))),
                          figure("after", "after (points)", on_points(points, at_points, label, (0.0, most))))


def _snapshot_of(folder: Path, points: Frame) -> Frame:
    """The snapshot from which the particles were made."""
    for path, digest in points.inputs:
        for file in (Path(path), folder / path, folder / Path(path).name, folder.parent / path):
            if file.is_file() and hashlib.sha256(file.read_bytes()).hexdigest() == digest:
                return read(file)
    wanted = points.inputs[0][0] if points.inputs else "the snapshot"
    raise OSError(f"{wanted}, from which {folder / PARTICLES} was made, is not there any more; put it into {folder}")
