#!/usr/bin/python3
"""Error against CPU seconds on the shipped Mochikoshi scene (synthetic motion): element size, time step, tolerance and
Newmark's damping, one dial at a time from 2.4 m, 2e-3 s, 1e-5, gamma = 5/6.

    error_against_time.py BIN_FOLDER --output FOLDER [--rows NAME,...] [--figure docs/fem_error_against_time.png]

Looked at 3.0 s, before anything below the crest is liquefied, and at 4.5 s, while the mesh is still good. Sizes are judged
by the finest mesh, all else by the run with the shortest step and the smallest tolerance on 2.4 m, so that the two errors
stay apart. Runs that FOLDER holds are not repeated. Writes fem_error_against_time.csv beside the figure.
"""
import argparse
import csv
import pathlib

import matplotlib
import numpy

import dam_runs

matplotlib.use("Agg")
import matplotlib.pyplot as plt

EARLY, TIME = 3.0, 4.5  # s
SIZE, STEP, TOLERANCE, GAMMA = 2.4, 2e-3, 1e-5, 5 / 6
TIGHTEST = "tightest"


def settings(size=SIZE, step=STEP, tolerance=TOLERANCE, gamma=GAMMA, step_error=0.0):
    """beta = (gamma + 1/2)^2 / 4 damps the highest frequencies most for its gamma."""
    stage = {"type": "dynamic", "name": "shaking", "duration": TIME, "time_step": step}
    return {"section__element_size": size, "fem__stages__2": stage, "fem__force_tolerance": tolerance,
            "fem__newmark_gamma": gamma, "fem__newmark_beta": (gamma + 0.5) ** 2 / 4, "fem__largest_step_error": step_error,
            "fem__snapshot_interval": 0}


DIALS = {
    "element size [m]": {"h 5": settings(size=5.0), "h 3.5": settings(size=3.5), "h 2.4": settings(),
                         "h 1.7": settings(size=1.7), "h 1.2": settings(size=1.2)},
    "time step [ms]": {"dt 8": settings(step=8e-3), "dt 4": settings(step=4e-3), "h 2.4": settings(),
                       "dt 1": settings(step=1e-3)},
    "tolerance": {"tol 1e-3": settings(tolerance=1e-3), "tol 1e-4": settings(tolerance=1e-4), "h 2.4": settings(),
                  "tol 1e-6": settings(tolerance=1e-6)},
    "Newmark gamma": {"gamma 0.5": settings(gamma=0.5), "gamma 0.6": settings(gamma=0.6), "h 2.4": settings()},
    "step from its error [m]": {"error 1e-4": settings(step=1e-2, step_error=1e-4), "error 1e-5": settings(step=1e-2, step_error=1e-5)},
}
FINEST = "h 1.2"
REFERENCE = {TIGHTEST: settings(step=5e-4, tolerance=1e-6)}


def runs_wanted():
    wanted = {}
    for dial in DIALS.values():
        wanted.update(dial)
    return wanted | REFERENCE


def facts_of(folder):
    done = dam_runs.record_of(folder)
    telemetry = dam_runs.telemetry_of(folder)
    return {"crest_early_m": dam_runs.at(telemetry, "crest_displacement", EARLY),
            "crest_m": dam_runs.at(telemetry, "crest_displacement", TIME),
            "depth_m": dam_runs.at(telemetry, "liquefaction_depth", TIME),
            "excess_kPa": float(dam_runs.at(telemetry, "excess_pressure_avg", TIME) / 1e3),
            "depth_12_m_s": dam_runs.first_time(telemetry, telemetry["liquefaction_depth"] >= 12.0),
            "least_jacobian": float(telemetry["jacobian_least_min"].min()), "cpu_s": done["cpu_seconds"]}


def rows_of(facts):
    rows = []
    for dial, variants in DIALS.items():
        against = FINEST if dial.startswith("element size") else TIGHTEST
        for name in variants:
            if name not in facts or against not in facts or name == against:
                continue
            fact, truth = facts[name], facts[against]
            rows.append({"dial": dial, "run": name, "judged_by": against, **fact,
                         "crest_early_error_percent": 100 * (fact["crest_early_m"] / truth["crest_early_m"] - 1),
                         "crest_error_percent": 100 * (fact["crest_m"] / truth["crest_m"] - 1),
                         "depth_error_m": fact["depth_m"] - truth["depth_m"],
                         "excess_error_percent": 100 * (fact["excess_kPa"] / truth["excess_kPa"] - 1)})
    return rows


def draw(rows, facts, figure):
    """Errors with their sign on a linear scale: after liquefaction they scatter, and the logarithm of scatter looks like a law."""
    panels = [("crest_early_error_percent", f"crest displacement at {EARLY:g} s, error [%]"),
              ("crest_error_percent", f"crest displacement at {TIME:g} s, error [%]"),
              ("excess_error_percent", f"mean excess pressure at {TIME:g} s, error [%]"),
              ("depth_error_m", f"liquefaction depth at {TIME:g} s, error [m]")]
    plot, axes = plt.subplots(2, 2, figsize=(13, 8.5), constrained_layout=True)
    for axis, (column, label) in zip(axes.flat, panels):
        axis.axhline(0, color="0.5", lw=0.8)
        for k, (dial, marker) in enumerate(zip(DIALS, "osD^v")):
            mine = [row for row in rows if row["dial"] == dial]
            axis.plot([row["cpu_s"] for row in mine], [row[column] for row in mine], marker + "-", color=f"C{k}", label=dial, lw=0.8)
            for row in mine:
                shared = row["run"] == "h 2.4" and not dial.startswith("element size")
                if not shared:
                    axis.annotate(row["run"].split()[1], (row["cpu_s"], row[column]), textcoords="offset points", xytext=(5, 4),
                                  fontsize=8, color=f"C{k}")
        axis.set(xscale="log", xlabel=f"CPU seconds of the run to {TIME:g} s", ylabel=label)
        ticks = [3, 5, 10, 20]
        axis.set_xticks(ticks, [str(tick) for tick in ticks])
        axis.minorticks_off()
        axis.grid(True, alpha=0.3)
    axes[0, 0].legend(fontsize=8)
    finest, tightest = (f"({facts[name]['cpu_s']:.0f} CPU s)" for name in (FINEST, TIGHTEST))
    plot.suptitle(f"Mochikoshi section (calibrated), synthetic motion. Element size judged by {FINEST} m {finest}; "
                  f"all else, on 2.4 m, by 0.5 ms and 1e-6 {tightest}", fontsize=10)
    plot.savefig(figure, dpi=80)


def scatter_of(facts):
    """Mean and standard deviation of the crest [m] over all runs on 2.4 m, whatever their dials say."""
    crests = [fact["crest_m"] for name, fact in facts.items() if not name.startswith("h ") or name == "h 2.4"]
    return len(crests), float(numpy.mean(crests)), float(numpy.std(crests, ddof=1))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--rows", help="only these runs, by name; default all")
    parser.add_argument("--figure", type=pathlib.Path, default=dam_runs.ROOT / "docs/fem_error_against_time.png")
    options = parser.parse_args()
    wanted = runs_wanted()
    chosen = options.rows.split(",") if options.rows is not None else list(wanted)
    facts = {}
    for name, each in wanted.items():
        folder = options.output / name.replace(" ", "_")
        if name in chosen:
            dam_runs.run_dam(options.bin / "fem_solver", folder, each)
        if (folder / "run.json").exists():
            facts[name] = facts_of(folder)
            print(f"{name:>10}", *(f"{key} {value:.5g}" for key, value in facts[name].items() if value is not None), flush=True)
    rows = rows_of(facts)
    if not rows:
        return
    with open(options.figure.with_suffix(".csv"), "w", newline="") as out:
        table = csv.DictWriter(out, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows({key: f"{value:.5g}" if isinstance(value, float) else value for key, value in row.items()} for row in rows)
    print("%d runs on 2.4 m: crest at 4.5 s %.3f m, standard deviation %.3f m" % scatter_of(facts))
    draw(rows, facts, options.figure)


if __name__ == "__main__":
    main()
