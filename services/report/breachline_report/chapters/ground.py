"""Variants that run out over different ground, side by side at one scale."""
from __future__ import annotations

from breachline.frames import read
from breachline.plot import Series
from breachline.plot.points import points_by_material

from ..document import Chapter, Document, Json, Table
from ..ended import bounded
from ..paper import Paper
from ..run import Phase, Run
from ..words import entry, fact
from . import Material
from .runout import section_at_rest


def _terrain(runout: Phase) -> Json:
    return entry(runout.scene, "/mpm/terrain")


def _one_per_ground(run: Run) -> list[Phase]:
    """The longest runout on each ground, in the order of the grounds' first variants."""
    found: dict[str, Phase] = {}
    for variant in run.variants:
        for each in run.runouts_of(variant):
            key = str(_terrain(each))
            if key not in found or each.runout > found[key].runout:
                found[key] = each
    return list(found.values())


def _ground_of(runout: Phase, low: float, high: float) -> Series:
    """Between two x; without terrain the level floor."""
    terrain, name = _terrain(runout), f"ground, {runout.variant}"
    if not terrain:
        return Series(name, [low, high], [runout.scene["mpm"]["floor"]["level"]] * 2)
    last = max((k for k in range(len(terrain) - 1) if terrain[k][0] < high), default=0)

    def level(k: int, x: float) -> float:
        (x_0, y_0), (x_1, y_1) = terrain[k], terrain[k + 1]
        return float(y_0 + (y_1 - y_0) * (x - x_0) / (x_1 - x_0))

    points = [(low, level(0, low))] + [(x, y) for x, y in terrain if low < x < high] + [(high, level(last, high))]
    return Series(name, [x for x, _ in points], [y for _, y in points])


def _shown_by(runouts: list[Phase]) -> tuple[float, float]:
    """From the grid's left end to slightly beyond the farthest point of all runouts."""
    settings = runouts[0].scene["mpm"]
    toe = settings["runout"]["toe"][0]
    return settings["domain_x"][0], max(toe + 1.15 * max(each.result["runout_largest"], 0.0) for each in runouts)


def _table(runouts: list[Phase], paper: Paper | None) -> Table:
    table = Table("ground", "Runout by ground", ["quantity", *(each.where for each in runouts)]
                  + (["case history, valley of about 20 %"] if paper else []), [],
                  "Arrival: seconds since the transfer; - when the flow never gets there, or had not yet. \u2265: a lower bound, the soil still "
                  "moved.")
    rows = [("runout [m]", "/runout", True), ("beyond the toe, 99 % [m]", "/runout_beyond_toe", True),
            ("beyond the toe, 95 % [m]", "/runout_beyond_toe_95", True), ("farthest point [m]", "/runout_largest", True),
            ("at rest", "/at_rest", False), ("end [s]", "/end_time", False)]
    for each in entry(runouts[0].scene, "/mpm/gauges", []):
        place, at = f"{each['name']} (x = {each['x']:.6g} m)", f"/gauges/{each['name']}"
        rows += [(f"arrival at {place} [s]", at + "/arrival_time", False), (f"largest depth at {place} [m]", at + "/largest_depth", True)]
    for what, pointer, grows in rows:
        cells = [bounded(each, fact(each.result, pointer)) if grows else fact(each.result, pointer) for each in runouts]
        table.rows.append([what, *cells] + ([paper.case_history_runout_m if pointer == "/runout" else ""] if paper else []))
    return table


def add(of: Material, document: Document) -> None:
    runouts = [each for each in _one_per_ground(of.run) if each.has("final.vtkhdf")]
    if len(runouts) < 2:
        return
    low, high = _shown_by(runouts)
    chapter = Chapter("The ground below the dam", "The same state on different ground, the longest runout on each, drawn on one scale.")
    for each in runouts:
        figure = points_by_material(read(each.files / "final.vtkhdf"), f"ground_{each.variant}", f"Final geometry, {each.where}")
        figure.chart.series += [_ground_of(other, low, high) for other in runouts] + [section_at_rest(each.scene)]
        figure.caption += f" Runout {bounded(each, fact(each.result, '/runout'))} m; lines: the section at rest and the ground of each variant."
        chapter.figures.append(figure)
    chapter.tables.append(_table(runouts, of.paper))
    document.add(chapter)
