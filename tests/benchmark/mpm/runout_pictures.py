#!/usr/bin/env python3
"""The same slide on cells of three sizes, side by side: deposits of runs that runout_convergence.py left in a folder,
every point a square of its own size in the colour of its material, and below each the equivalent shear strain.

    runout_pictures.py --runs folder [--names h5_9,h2.5_9,h1.25_9] [--time 45] --figure FILE.png"""
import argparse, glob, json, os
import h5py, matplotlib, numpy
matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
SCENE = json.load(open(os.path.join(ROOT, "workflows/scenes/mochikoshi_runout.json")))
TOE = 220.0
COLOURS = ["#5b3a1a", "#d68910", "#909497", "#aed6f1", "#5dade2", "#2e86c1", "#1b4f72", "#a93226", "#7d6608"]


def snapshot(folder, time):
    """The frame at `time`, the last one when time is None."""
    if time is None:
        return os.path.join(folder, "final.vtkhdf")
    frames = glob.glob(os.path.join(folder, "particles_*.vtkhdf"))
    return min(frames, key=lambda file: abs(float(os.path.basename(file)[10:-7]) - time))


def points_of(file):
    with h5py.File(file) as f:
        data = f["VTKHDF/PointData"]
        names = [name.decode() for name in f["/breachline/regions"][:]] if "/breachline/regions" in f else None
        return f["VTKHDF/Points"][:, :2], data["volume"][:], data["region"][:], data["epsilon_q"][:], names


def draw(axes, x, volume, values, **style):
    half = 0.5 * numpy.sqrt(numpy.minimum(volume, 4 * numpy.median(volume)))[:, None]  # spray is not drawn as wide as it flew
    corners = numpy.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    squares = PolyCollection(x[:, None, :] + half[:, :, None] * corners, edgecolors="none", **style)
    if values is not None:
        squares.set_array(values)
    axes.add_collection(squares)
    return squares


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--runs", required=True)
    parser.add_argument("--names", default="h5_9,h2.5_9,h1.25_9")
    parser.add_argument("--time", type=float)
    parser.add_argument("--figure", required=True)
    options = parser.parse_args()
    names = options.names.split(",")
    figure, grid = plt.subplots(2, len(names), figsize=(7 * len(names), 5.2), sharex=True, sharey=True, constrained_layout=True)
    for name, (above, below) in zip(names, grid.T):
        folder = os.path.join(options.runs, name)
        x, volume, region, epsilon_q, regions = points_of(snapshot(folder, options.time))
        row = json.load(open(os.path.join(folder, "row.json")))
        draw(above, x, volume, None, facecolors=[COLOURS[r % len(COLOURS)] for r in region])
        strain = draw(below, x, volume, numpy.minimum(epsilon_q, 20.0), cmap="magma_r", clim=(0, 20))
        above.set_title(f"cells of {name.split('_')[0][1:]} m: {len(x):,} points, Rd {row['Rd_m']:.0f} m, Rd95 {row['Rd95_m']:.0f} m, {row['cpu_s']:.0f} CPU s", fontsize=11)
        for axes in (above, below):
            axes.axvline(TOE, color="k", lw=0.6, ls=":")
            axes.set(xlim=(-45, TOE + 150), ylim=(-2, 36))
        below.set_xlabel("x (m); dotted: toe")
    if regions:
        for k, region_name in enumerate(regions):
            grid[0, 0].plot([], [], "s", color=COLOURS[k % len(COLOURS)], label=region_name)
        grid[0, 0].legend(fontsize=6, ncol=3, loc="upper right")
    for axes in grid[:, 0]:
        axes.set_ylabel("y (m)")
    figure.colorbar(strain, ax=grid[1, :], label="epsilon_q (-), cut at 20", shrink=0.9)
    figure.savefig(options.figure, dpi=110)


if __name__ == "__main__":
    main()
