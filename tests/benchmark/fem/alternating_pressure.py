#!/usr/bin/python3
"""Excess pore pressure at the nodes of the failing band, with one-point and with full integrals of the pressure.

    alternating_pressure.py BIN_FOLDER --output FOLDER [--figure docs/fem_alternating_pressure.png] [--time 6] [--limit 600]

Runs workflows/scenes/mochikoshi.json on 2.4 m elements (synthetic motion) twice into FOLDER, unless the runs are there, and
draws nodal excess pressure side by side, unsmoothed, with the rms of its alternating part in the wet tailings below the dam.
Writes a table beside the runs: that rms every half second, with the crest.
"""
import argparse
import pathlib

import matplotlib
import numpy

import dam_runs
from course_of_failure import outline_of

matplotlib.use("Agg")
import matplotlib.collections
import matplotlib.pyplot as plt

TITLES = {"one_point": "one-point integrals (OpenSees' element, ours before)", "full": "full integrals, the alternating part held"}


def run_of(program, folder, integration, end, limit):
    settings = {"section__element_size": 2.4, "fem__stages__2__duration": end, "fem__snapshot_interval": 0.25,
                "fem__water__pressure_integration": integration}
    dam_runs.run_dam(program, folder / integration, settings, limit)
    return folder / integration


def table_of(folders):
    lines = ["| time, s | " + " | ".join(f"{name}: rms kPa | crest, m" for name in folders) + " |", "|---|" + "---|---|" * len(folders)]
    telemetry = {name: dam_runs.telemetry_of(folder) for name, folder in folders.items()}
    for time in numpy.arange(3.0, max(each["time"][-1] for each in telemetry.values()) + 1e-6, 0.5):
        cells = [f"{time:g}"]
        for name, folder in folders.items():
            taken, file = dam_runs.snapshot_at(folder, time)
            moved = dam_runs.at(telemetry[name], "crest_displacement", time)
            known = moved is not None and abs(taken - time) < 0.05
            cells += [f"{dam_runs.Snapshot(file).checkerboard() / 1e3:.1f}", f"{moved:.2f}"] if known else ["-", "-"]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def draw(folders, time, figure):
    """Each element as four triangles around its middle, so that what alternates between its corners is seen as it is."""
    plot, axes = plt.subplots(1, len(folders), figsize=(15, 4.2), constrained_layout=True)
    for axis, (name, folder) in zip(axes, folders.items()):
        taken, file = dam_runs.snapshot_at(folder, time)
        shot = dam_runs.Snapshot(file)
        position = shot.position_0 + shot.displacement
        middle = len(position) + numpy.arange(len(shot.quads))
        places = numpy.vstack([position, position[shot.quads].mean(axis=1)])
        excess = numpy.concatenate([shot.excess, shot.excess[shot.quads].mean(axis=1)]) / 1e3
        triangles = numpy.concatenate([numpy.column_stack([shot.quads[:, k], shot.quads[:, (k + 1) % 4], middle]) for k in range(4)])
        colours = axis.tripcolor(*places.T, triangles, excess, shading="gouraud", cmap="RdYlBu_r", vmin=-50, vmax=200)
        axis.add_collection(matplotlib.collections.PolyCollection(position[shot.quads], facecolors="none", edgecolors="0.5", linewidths=0.2))
        axis.add_collection(matplotlib.collections.LineCollection(position[outline_of(shot)], colors="0.2", linewidths=0.8))
        axis.set(xlim=(90, 165), ylim=(-1, 32), aspect="equal", xlabel="x [m]")
        axis.set_title(f"{TITLES[name]}\n{taken:.2f} s, alternating part {shot.checkerboard() / 1e3:.1f} kPa rms", fontsize=10, loc="left")
    axes[0].set_ylabel("y [m]")
    plot.colorbar(colours, ax=axes, shrink=0.8, label="excess pore pressure at the nodes [kPa]")
    plot.suptitle("Mochikoshi section (calibrated, no survey), synthetic motion, ssp, 2.4 m; deformed to scale", fontsize=10)
    plot.savefig(figure, dpi=75, pil_kwargs={"optimize": True})


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--figure", type=pathlib.Path, default=dam_runs.ROOT / "docs/fem_alternating_pressure.png")
    parser.add_argument("--time", type=float, default=6.0, help="of the figure [s]")
    parser.add_argument("--limit", type=float, default=600.0, help="CPU seconds of each run")
    options = parser.parse_args()
    folders = {name: run_of(options.bin / "fem_solver", options.output, name, max(options.time, 7.0), options.limit) for name in TITLES}
    table = table_of(folders)
    (options.output / "alternating_pressure.md").write_text(table)
    print(table)
    draw(folders, options.time, options.figure)


if __name__ == "__main__":
    main()
