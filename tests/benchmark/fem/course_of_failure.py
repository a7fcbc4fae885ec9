#!/usr/bin/python3
"""The course of Mochikoshi's failure beside the published one, and its strains and pore pressures where something happens.

    course_of_failure.py BIN_FOLDER --output FOLDER [--figure docs/fem_course_of_failure.png] [--limit 2400]

Runs the shipped scene (synthetic motion, 1 m elements, ssp) into FOLDER/shipped_1 unless it is there; the stand-in on 1.2 m
is taken from does_it_fail.py with the same FOLDER. Writes FOLDER/course_of_failure.md and the figure. "Critical depth" is
18.5 m. A whole element is liquefied when the mean r_u of its nodes, in which alternating pressures cancel, is above 0.7. J
are averages of |J_t|/|J_0| over elements with epsilon_q > 3 %; octahedral strain is sqrt(2) epsilon_q and its averages come
from the snapshots. With bbar_1.2 in FOLDER both elements are drawn side by side.
"""
import argparse
import pathlib

import matplotlib
import numpy

import dam_runs

matplotlib.use("Agg")
import matplotlib.collections
import matplotlib.pyplot as plt

CRITICAL_DEPTH = 18.5  # m
PAPER = {  # s
    "liquefied to 12 m": 11.0,
    "a whole element liquefied at 12 m": None,
    "first failure surface": 13.0,
    "liquefied to the critical depth, 18.5 m": 14.75,
    "a whole element liquefied at 18.5 m": None,
    "second failure surface": 14.75,
    "mean epsilon_q > 20 %": 17.5,
    "mean octahedral strain > 20 %": None,
    "mean centre J < 0.97": 20.25,
    "mean least corner J < 0.97": None,
    "entangled": 23.0,
}
SHOWN = ("liquefied to 12 m", "liquefied to the critical depth, 18.5 m", "first failure surface", "second failure surface", "entangled")


def events_of(folder):
    """Time of each event [s] after the motion begins; None where it does not come. 'entangled' is the run's end."""
    t = dam_runs.telemetry_of(folder)
    shots = [(time, dam_runs.Snapshot(file)) for time, file in dam_runs.snapshots_of(folder)]
    depth = [shot.liquefied_below_crest()[1] for _, shot in shots]

    def first_shot(reached):
        return next((time for (time, _), each in zip(shots, reached) if each), None)

    done = dam_runs.record_of(folder)
    first = dam_runs.first_time
    return {"liquefied to 12 m": first(t, t["liquefaction_depth"] >= 12.0),
            "first failure surface": first(t, t["failure_surfaces"] >= 1),
            "liquefied to the critical depth, 18.5 m": first(t, t["liquefaction_depth"] >= CRITICAL_DEPTH),
            "second failure surface": first(t, t["failure_surfaces"] >= 2),
            "mean epsilon_q > 20 %": first(t, t["epsilon_q_avg"] > 0.2),
            "mean octahedral strain > 20 %": first_shot(shot.average_octahedral() > 0.2 for _, shot in shots),
            "a whole element liquefied at 12 m": first_shot(each >= 12.0 for each in depth),
            "a whole element liquefied at 18.5 m": first_shot(each >= CRITICAL_DEPTH for each in depth),
            "mean centre J < 0.97": first(t, t["jacobian_centre_avg"] < 0.97),
            "mean least corner J < 0.97": first(t, t["jacobian_least_avg"] < 0.97),
            "entangled": shots[-1][0] if done["ended"] == dam_runs.ENTANGLED else None}


def strong_shaking(file):
    """Times [s] when 5 % and 95 % of the Arias intensity have come."""
    rows = []
    for line in file.read_text().splitlines():
        words = line.replace(",", " ").split()
        try:
            rows.append([float(word) for word in words[:2]])
        except ValueError:
            continue  # comment or header
    time, acceleration = numpy.array(rows).T
    share = numpy.cumsum(acceleration**2)
    return tuple(float(numpy.interp(level, share / share[-1], time)) for level in (0.05, 0.95))


def table_of(runs):
    """runs: (title, folder, motion file)."""
    shaking = [strong_shaking(file) for _, _, file in runs]
    titles = [f"{title}, s | after 5 % of Arias ({begin:.2f} s)" for (title, _, _), (begin, _) in zip(runs, shaking)]
    lines = ["| event | paper, s | " + " | ".join(titles) + " |", "|---|---|" + "---|---|" * len(runs)]
    events = [events_of(folder) for _, folder, _ in runs]
    for name, theirs in PAPER.items():
        cells = [name, "-" if theirs is None else f"{theirs:g}"]
        for each, (begin, _) in zip(events, shaking):
            time = each[name]
            cells += ["-", "-"] if time is None else [f"{time:.2f}", f"{time - begin:.2f}"]
        lines.append("| " + " | ".join(cells) + " |")
    over = " | ".join(f"{end:.2f} | {end - begin:.2f}" for begin, end in shaking)
    lines.append(f"| strong shaking over (95 % of Arias) | ~13 | {over} |")
    return "\n".join(lines) + "\n"


def draw_epsilon_q(axis, shot, position):
    patches = matplotlib.collections.PolyCollection(position[shot.quads], array=100 * shot.epsilon_q, cmap="inferno_r",
                                                    edgecolors="face", linewidths=0.1)
    return axis.add_collection(patches)


def draw_r_u(axis, shot, position):
    triangles = numpy.concatenate([shot.quads[:, [0, 1, 2]], shot.quads[:, [0, 2, 3]]])
    return axis.tripcolor(*position.T, triangles, numpy.clip(shot.r_u, 0, 1), shading="gouraud", cmap="viridis", vmin=0, vmax=1)


def outline_of(shot):
    """Edges between regions or with nothing beyond, as pairs of nodes."""
    seen = {}
    for e, quad in enumerate(shot.quads):
        for a, b in zip(quad, numpy.roll(quad, -1)):
            seen.setdefault((min(a, b), max(a, b)), []).append(shot.region[e])
    return [edge for edge, regions in seen.items() if len(regions) == 1 or regions[0] != regions[1]]


def draw(rows, largest_strain, title, figure):
    """rows: (label, Snapshot), epsilon_q on the left up to `largest_strain` [%] and r_u on the right."""
    plot, axes = plt.subplots(len(rows), 2, figsize=(15, 2.0 * len(rows) + 0.3), constrained_layout=True, squeeze=False)
    for pair, (label, shot) in zip(axes, rows):
        position = shot.position_0 + shot.displacement
        for axis, paint in zip(pair, (draw_epsilon_q, draw_r_u)):
            colours = paint(axis, shot, position)
            if paint is draw_epsilon_q:
                colours.set_clim(0, largest_strain)
            axis.add_collection(matplotlib.collections.LineCollection(position[outline_of(shot)], colors="0.35", linewidths=0.5))
            axis.set(xlim=(50, 225), ylim=(-5, 33), aspect="equal")
            plot.colorbar(colours, ax=axis, shrink=0.75, label="epsilon_q [%]" if paint is draw_epsilon_q else "r_u [-]")
        pair[0].set_title(label, fontsize=9, loc="left")
    plot.suptitle(title, fontsize=10)
    plot.savefig(figure, dpi=75, pil_kwargs={"optimize": True})


def rows_of_events(folder):
    """Events that come at one time share a row."""
    events, shown = events_of(folder), {}
    for name in SHOWN:
        if events[name] is not None:
            shown.setdefault(events[name], []).append(name)
    rows = []
    for time, names in sorted(shown.items()):
        taken, file = dam_runs.snapshot_at(folder, time)
        rows.append((f"{', '.join(names)}: {time:.2f} s (shown at {taken:.2f} s)", dam_runs.Snapshot(file)))
    return rows


def rows_of_elements(folders):
    """Every element of the same mesh at the last time that all of them have."""
    last = min(dam_runs.snapshots_of(folder)[-1][0] for folder in folders)
    return [(f"{folder.name}, {time:.2f} s", dam_runs.Snapshot(file)) for folder in folders
            for time, file in [dam_runs.snapshot_at(folder, last)]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--figure", type=pathlib.Path, default=dam_runs.ROOT / "docs/fem_course_of_failure.png")
    parser.add_argument("--limit", type=float, default=2400.0, help="CPU seconds")
    options = parser.parse_args()
    shipped = options.output / "shipped_1"
    dam_runs.run_dam(options.bin / "fem_solver", shipped, {"fem__snapshot_interval": 0.1}, options.limit)
    runs = [("shipped scene, 1 m, synthetic motion", shipped, dam_runs.MOTIONS["synthetic"])]
    stand_in = options.output / "stand-in/ssp_1.2"
    if (stand_in / "run.json").exists():
        runs.append(("1.2 m, stand-in", stand_in, dam_runs.STAND_IN))
    table = table_of(runs)
    (options.output / "course_of_failure.md").write_text(table)
    print(table)
    section = "Mochikoshi section (calibrated, no survey)"
    draw(rows_of_events(shipped), 40, f"{section}, synthetic motion, ssp, 1 m; deformed to scale", options.figure)
    pair = [options.output / "stand-in" / row for row in ("ssp_1.2", "bbar_1.2")]
    if all((folder / "run.json").exists() for folder in pair):
        figure = options.figure.with_name(options.figure.stem + "_elements.png")
        draw(rows_of_elements(pair), 20, f"{section}, stand-in motion, both elements on 1.2 m; deformed to scale", figure)


if __name__ == "__main__":
    main()
