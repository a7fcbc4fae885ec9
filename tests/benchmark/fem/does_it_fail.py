#!/usr/bin/python3
"""Does the Mochikoshi section fail, whatever the element and its size? The shipped scene with the stand-in motion (San
Fernando 1971 at LA Hollywood Storage, N-S, from ../shared/motions, scaled to 0.3 g); without ../shared the synthetic one.

    does_it_fail.py BIN_FOLDER --output FOLDER [--rows ssp_2.4,bbar_2.4] [--limit 2400] [--figure docs/fem_does_it_fail.png]

A row that FOLDER holds is not repeated; one that met the limit of CPU seconds goes on when the limit is larger. Rows after
the six change one thing on 2.4 m: the motion, the hourglass stiffness, the pressure stabilisation. Writes does_it_fail.md
there, the figure and a .csv beside it.

Verdict. fails: a failure surface reaches from ground to ground and the crest's mean speed over the last second is above
0.1 m/s, be it that the mesh has given up or that the whole duration is done, 2 s after strong shaking. rest: the whole
duration is done and that speed is below 0.01 m/s. undecided: everything else. The second surface has a column of its own.
"""
import argparse
import csv
import pathlib

import matplotlib

import dam_runs

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROWS = {f"{element}_{size:g}": {"fem__element": element, "section__element_size": size}
        for size in (2.4, 1.2, 0.6) for element in ("ssp", "bbar")}
ROWS |= {f"ssp_2.4_{change}": ROWS["ssp_2.4"] | settings for change, settings in {
    "synthetic": {"fem__motion__file": str(dam_runs.MOTIONS["synthetic"])},
    "elastic": {"fem__hourglass": "elastic"},
    "alpha_1": {"fem__water__pressure_stabilisation": 1.0},
}.items()}
END = 15.0  # s; strong shaking of the stand-in is over at 13.0 s
LOOKED_AT = (6.0, 7.0, 8.0, 10.0, 13.0)  # s
FAST, AT_REST = 0.1, 0.01  # m/s


def run_row(program, folder, row, motion, limit):
    settings = {"fem__motion__file": str(motion), "fem__stages__2__duration": END, "fem__snapshot_interval": 0.1} | ROWS[row]
    return dam_runs.run_dam(program, folder, settings, limit)


def speed_at_end(telemetry):
    """Mean speed of the crest over the last second [m/s]."""
    end = telemetry["time"][-1]
    return (telemetry["crest_displacement"][-1] - dam_runs.at(telemetry, "crest_displacement", max(0.0, end - 1.0))) / min(1.0, end)


def verdict_of(ended, telemetry):
    speed = speed_at_end(telemetry)
    cut = telemetry["failure_surfaces"].max() >= 1
    if cut and ended != dam_runs.STOPPED and speed > FAST:
        return "fails"
    if ended == dam_runs.DURATION and abs(speed) < AT_REST:
        return "rest"
    return "undecided"


def facts_of(folder, name):
    done = dam_runs.record_of(folder)
    telemetry = dam_runs.telemetry_of(folder)
    last = dam_runs.Snapshot(dam_runs.snapshots_of(folder)[-1][1])
    row = {"row": name, "elements": len(last.quads)}
    for time in LOOKED_AT:
        row[f"crest_at_{time:g}_s_m"] = dam_runs.at(telemetry, "crest_displacement", time)
    row["depth_12_m_s"] = dam_runs.first_time(telemetry, telemetry["liquefaction_depth"] >= 12.0)
    row["first_surface_s"] = dam_runs.first_time(telemetry, telemetry["failure_surfaces"] >= 1)
    row["second_surface_s"] = dam_runs.first_time(telemetry, telemetry["failure_surfaces"] >= 2)
    row["end_s"] = float(telemetry["time"][-1])
    row["ended"] = done["ended"]
    row["crest_at_end_m"] = float(telemetry["crest_displacement"][-1])
    row["crest_speed_at_end_m_s"] = float(speed_at_end(telemetry))
    row["verdict"] = verdict_of(done["ended"], telemetry)
    row["hourglass_band_mean_kPa"] = row["hourglass_largest_kPa"] = None
    row["liquefied_share_at_end"], row["element_depth_at_end_m"] = last.liquefied_below_crest()
    row["checkerboard_at_first_surface_kPa"] = None
    if row["first_surface_s"] is not None:
        then = dam_runs.Snapshot(dam_runs.snapshot_at(folder, row["first_surface_s"])[1])
        row["checkerboard_at_first_surface_kPa"] = then.checkerboard() / 1e3
    stress = dam_runs.hourglass_stress(folder, last)
    if stress is not None:
        soft = (last.epsilon_q > 0.1) & (last.region == last.regions.index("tailings"))
        row["hourglass_largest_kPa"] = float(stress[soft].max() / 1e3) if soft.any() else None
        row["hourglass_band_mean_kPa"] = float(stress[soft].mean() / 1e3) if soft.any() else None
    row["cpu_s"] = done["cpu_seconds"]
    return row


def text_of(value):
    if value is None:
        return "-"
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def write_tables(folder, csv_file, rows):
    with open(csv_file, "w", newline="") as out:
        table = csv.DictWriter(out, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows({key: text_of(value) for key, value in row.items()} for row in rows)
    lines = ["| " + " | ".join(key.replace("_", " ") for key in rows[0]) + " |", "|---" * len(rows[0]) + "|"]
    lines += ["| " + " | ".join(text_of(value) for value in row.values()) + " |" for row in rows]
    (folder / "does_it_fail.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines), flush=True)


def draw(folders, figure):
    """Crest displacement against time; a cross where the mesh gave up."""
    plot, axis = plt.subplots(figsize=(9, 4.6), constrained_layout=True)
    for k, (name, folder) in enumerate(folders.items()):
        t = dam_runs.telemetry_of(folder)
        style = "--" if name.startswith("bbar") else ":" if name.count("_") > 1 else "-"
        axis.plot(t["time"], t["crest_displacement"], style, color=f"C{k}", lw=1.5, label=name)
        if dam_runs.record_of(folder)["ended"] == dam_runs.ENTANGLED:
            axis.plot(t["time"][-1], t["crest_displacement"][-1], "x", color=f"C{k}")
    axis.set(xlim=(0, END), ylim=(0, 6), xlabel="time [s]", ylabel="crest displacement [m]")
    axis.grid(alpha=0.3)
    axis.legend(fontsize=8)
    axis.set_title("Mochikoshi section (calibrated), stand-in motion unless named; x: the mesh gave up", fontsize=9)
    plot.savefig(figure, dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--rows", default=",".join(ROWS))
    parser.add_argument("--limit", type=float, default=2400.0, help="CPU seconds per row")
    parser.add_argument("--figure", type=pathlib.Path, default=dam_runs.ROOT / "docs/fem_does_it_fail.png")
    options = parser.parse_args()
    motion, title = dam_runs.STAND_IN, "stand-in"
    if not motion.exists():
        print(f"{motion} is not there: the synthetic motion takes its place")
        motion, title = dam_runs.MOTIONS["synthetic"], "synthetic"
    wanted = options.rows.split(",")
    for row in ROWS:
        if row in wanted:
            run_row(options.bin / "fem_solver", options.output / title / row, row, motion, options.limit)
    folders = {row: options.output / title / row for row in ROWS}
    folders = {row: folder for row, folder in folders.items() if (folder / "run.json").exists()}
    write_tables(options.output, options.figure.with_suffix(".csv"), [facts_of(folder, row) for row, folder in folders.items()])
    draw(folders, options.figure)


if __name__ == "__main__":
    main()
