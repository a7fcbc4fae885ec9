"""The volumes of the governing runout by soil, and what is left of the crest above the pond."""
from __future__ import annotations

import numpy as np
from breachline.frames import Array, Frame, read

from ..document import Chapter, Document, Json, Table
from ..ended import bounded
from ..run import Phase
from ..section import crest_of
from ..words import rounded
from . import Material


def _first_frame(runout: Phase) -> Frame | None:
    """None: it wrote no frames."""
    files = sorted(runout.files.glob("particles_*.vtkhdf"), key=lambda file: float(file.stem.split("_")[1]))
    return read(files[0]) if files else None


def _balance(runout: Phase, before: Frame, width: Json) -> Table:
    """Frames keep the order of their points, so that each has a displacement."""
    after, cell = read(runout.files / "final.vtkhdf"), float(runout.scene["mpm"]["cell_size"])
    table = Table("volume_balance", "Volume balance", ["soil", "in the section", "moved", "of it within the toe", "of it beyond the toe"], [],
                  f"m3 per m of width, at the density before. Moved: by more than a cell, {cell:.3g} m; soils that did not are left out. "
                  "\u2265: a lower bound, the soil still moved.")
    volume, beyond = after["volume_0"], after.position[:, 0] > runout.scene["mpm"]["runout"]["toe"][0]
    moved = np.hypot(*(after.position - before.position).T) > cell
    material = np.array(after.materials)[after["region"]]

    def row(name: str, of: Array, times: float = 1.0) -> list[str]:
        whole, all_moved, within, past = (times * float(volume[of & part].sum()) for part in (of, moved, moved & ~beyond, moved & beyond))
        return [name, rounded(whole, 3), *(bounded(runout, rounded(each, 3)) for each in (all_moved, within, past))]

    every = np.ones(len(volume), bool)
    table.rows = [row(str(name), material == name) for name in dict.fromkeys(material) if moved[material == name].any()] + [row("all soils", every)]
    if width:
        table.rows.append(row(f"all soils, through a breach of {rounded(width['best'], 3)} m [m3]", every, width["best"]))
    table.caption += f" {len(before.position) - len(after.position)} of {len(before.position)} points left the model."
    return table


def _crest(runout: Phase) -> Table:
    table = Table("crest", "Crest and freeboard", ["level [m]", "before", "after", "lost"], [],
                  "Crest: the highest ground between pond and toe. Freeboard: crest above the pond; below 0 the pond would flow over what is left, "
                  "which is not modelled.")
    found = crest_of(runout)
    if not found:
        return table
    table.rows.append(["crest", *(rounded(each, 3) for each in (found.before, found.after, found.before - found.after))])
    table.rows.append(["freeboard above the pond", "-", "-", "the phreatic line shows no pond at the upstream end"] if found.pond is None else
                      [f"freeboard above the pond at {found.pond:.4g}", rounded(found.before - found.pond, 3), rounded(found.after - found.pond, 3),
                       rounded(found.before - found.after, 3)])
    return table


def add(of: Material, document: Document, width: Json) -> None:
    runout = of.run.farthest
    before = _first_frame(runout) if runout and runout.has("final.vtkhdf") else None
    if not runout or not before:
        document.leave_out("volume balance", "the governing runout has no frames (/mpm/snapshot_interval)" if runout else "the run has no runout")
        return
    document.add(Chapter("Released volume", f"Of the governing case: {runout.where}.", tables=[_balance(runout, before, width), _crest(runout)]))
