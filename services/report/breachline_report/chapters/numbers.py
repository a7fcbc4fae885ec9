"""All numbers of the run with their settings, errors and costs."""
from __future__ import annotations

from collections.abc import Sequence

from ..document import Chapter, Document, Json, Table
from ..ended import any_moves, bounded, flag_table, how_it_ended
from ..run import Phase, Run, fem, lem, mpm, transfer
from ..words import at_least, entry, fact, number, rounded, with_error
from . import Material

Column = tuple[str, str]  # heading, and the number's place in result.json
_distances = ("/runout", "/runout_beyond_toe", "/runout_largest", "/runout_front")
_grows = (*_distances, "/area_beyond_toe")
_unit = {"/largest_yield_excess": 1e3, "/kinetic_share": 0.01}

_columns: dict[str, tuple[str, list[Column], str]] = {
    lem: ("Limit equilibrium",
          [("FS", "/factor_of_safety"), ("FS Bishop", "/bishop/factor_of_safety"), ("FS Spencer", "/bishop/spencer/factor_of_safety"),
           ("FS Ordinary", "/bishop/ordinary/factor_of_safety"), ("critical depth [m]", "/critical_depth"),
           ("depth at FS = 1 [m]", "/depth_at_fs_1"), ("slices", "/slices")],
          "FS is the least valid factor of all surfaces analysed; Bishop, Spencer and Ordinary are on Bishop's critical circle. Error: that of the "
          "number of slices. The difference between Bishop and Spencer shows that of the method."),
    fem: ("Finite elements",
          [("end [s]", "/end_time"), ("steps", "/steps"), ("cut steps", "/cut_steps"), ("elements", "/elements"),
           ("shortest edge [m]", "/mesh/shortest_edge"), ("largest displacement [m]", "/largest_displacement"),
           ("error: hourglass energy / internal work", "/hourglass/energy_over_internal_work")], ""),
    transfer: ("Transfers", [("error: largest stress outside the yield surface [kPa]", "/largest_yield_excess")], ""),
    mpm: ("Runouts",
          [("runout [m]", "/runout"), ("beyond toe [m]", "/runout_beyond_toe"), ("farthest point [m]", "/runout_largest"),
           ("front [m]", "/runout_front"), ("area beyond toe [m2]", "/area_beyond_toe"), ("at rest", "/at_rest"),
           ("in motion / released [%]", "/kinetic_share"), ("end [s]", "/end_time"), ("points", "/particles"),
           ("error: numerical energy / released", "/energy/numerical/share"), ("error: volume / initial", "/volume_ratio"),
           ("error: overlap", "/overlap")],
          "Errors: share of the released energy that the scheme took (positive) or made; mean volume over initial volume; share of soil that lies in "
          "other soil. Front: the farthest place where the soil is /mpm/runout/front_depth deep (1 m unless the scene says so). \u2265: a lower "
          "bound, the soil still moved."),
}


def _asked_overrides(run: Run, phase: Phase) -> Sequence[str] | None:
    """A task's overrides according to the study, for its variant or the first variant it serves: its result may come from another run's task
    with that task's overrides. None: not known."""
    variants = run.study.get("variants", [])
    if not phase.task or not run.study:
        return None
    if not variants:
        return None if phase.variant else []
    of = variants[0] if not phase.variant else next((each for each in variants if each["name"] == phase.variant), None)
    return list(of.get("overrides", [])) if of else None


def _settings_of(run: Run, phase: Phase) -> str:
    """The phase's overrides, without those that only set output times."""
    if not phase.result:
        return "not known: no result.json"
    overrides = _asked_overrides(run, phase)
    if overrides is None:
        overrides = entry(phase.result, "/provenance/overrides", [])
    text = "; ".join(each for each in overrides if not each.startswith("/fem/snapshot_")) or "as in the scene"
    return text if len(text) <= 120 else text[:120] + " ... (whole: Variants)"


def _cell(phase: Phase, pointer: str) -> str:
    """With the digits that the runout's error allows."""
    value = number(phase.result, pointer)
    if pointer in _distances and value is not None and phase.error is not None:
        return bounded(phase, with_error(value, phase.error))
    text = fact(phase.result, pointer, _unit.get(pointer, 1.0))
    return bounded(phase, text) if pointer in _grows else text


def _table_of(of: Material, program: str) -> Table:
    run, (title, columns, caption) = of.run, _columns[program]
    phases = run.of(program)
    if program == fem and any(entry(each, "/law/softening") for each in entry(run.scene, "/materials", {}).values()):
        caption = ("Softening is local: a shear band is one element wide, so the time of failure depends on the mesh; only runs with other element "
                   "sizes measure that error.")
    table = Table(f"numbers_{program}", title, ["run", "t_T [s]", "variant", *(head for head, _ in columns), "settings", "CPU [s]", "how it ended"])
    for each in phases:
        table.rows.append(each.columns + [_cell(each, pointer) for _, pointer in columns]
                          + [_settings_of(run, each), fact(each.result, "/cpu_seconds", digits=3), how_it_ended(each)])
    for note in of.paper.notes if of.paper and phases else []:
        if note["table"] == table.name and entry(phases[0].result, note["entry"]) == note["value"]:
            caption += " " + note["text"]
    table.caption = caption
    return table


def _ledger(run: Run) -> Table:
    """Relative differences in the transfers' ledgers over the whole section: one row per transfer, one column per quantity."""
    table = Table("numbers_transfer_ledger", "What the transfers lost or made", ["run", "t_T [s]"], [],
                  "Relative differences, points minus mesh, over the whole section: the transfer's error. What is of the nodes was the FEM's lumped "
                  "mass times its nodal velocity; its kinetic energy counts velocities that change within an element as they are at its corners.")
    for each in run.of(transfer):
        kept = {row["quantity"]: row["relative_difference"] for row in entry(each.result, "/ledger", []) if row.get("region") == "total"}
        if kept:
            table.columns += list(kept) if not table.rows else []
            table.rows.append(each.columns[:2] + [rounded(kept[name], 2) if name in kept else "-" for name in table.columns[2:]])
    return table


def _means(run: Run) -> Table:
    """Mean and scatter of every runout of a study with repeats."""
    table = Table("numbers_means", "Means over the repeats", ["t_T [s]", "variant", "repeats", "runout [m]", "beyond the toe [m]", "farthest [m]",
                                                              "mean runout is off by [m]", "not as it should be"], [],
                  "Mean +- standard deviation of one repeat. A repeat is the same setting on another lattice of points. Off by: nine of ten such "
                  "means, by Student's distribution for so few repeats, with the bias where an accuracy study tells it. \u2265: a lower bound, "
                  "soil of "
                  "a repeat still moved.")
    for mean in run.means:
        bound = at_least if any_moves(run.draws_of(mean)) else ""
        error, cautions = number(mean, "/runout_error"), [words + mean[key] for key, words in (
            ("missing_draws", "without a result: "), ("questionable_draws", "questionable: ")) if mean[key]]
        table.rows.append([fact(mean, "/transfer_time", digits=6), mean["variant"] or "all", f"{mean['draws_done']:.4g} of {mean['draws']:.4g}",
                           *(bound + text if text != "-" else text for text in (_scatter(mean, key) for key in (
                               "runout", "runout_beyond_toe", "runout_largest"))),
                           "no estimate" if error is None else rounded(error, 2), "; ".join(cautions) or "-"])
    return table


def _scatter(mean: Json, key: str) -> str:
    value, deviation = number(mean, "/" + key), number(mean, f"/{key}_deviation")
    return "-" if value is None else with_error(value, deviation, 4) + ("" if deviation is None else f" +- {deviation:.2g}")


def _errors(run: Run) -> Table:
    """From an accuracy study, the run's repeats, or neighbouring transfer times."""
    return Table("numbers_runout_error", "How far the runouts are off",
                 ["run", "t_T [s]", "variant", "runout [m]", "error of one run [m]", "from"],
                 [each.columns + [_cell(each, "/runout"), "no estimate" if each.error is None else rounded(each.error, 2), each.error_from]
                  for each in run.of(mpm) if each.error_from],
                 "The error of a setting (bias and scatter against a reference) comes from an accuracy study of the same scene at the same setting; "
                 "repeats, and neighbours in transfer time, tell the scatter alone.")


def add(of: Material, document: Document) -> None:
    run = of.run
    document.add(Chapter("Numbers", tables=([of.measures.comparison(of.paper)] if of.paper else [])
                         + [_table_of(of, lem), _table_of(of, fem), _table_of(of, transfer), _ledger(run), _table_of(of, mpm), _means(run),
                            _errors(run), flag_table(run)]))
