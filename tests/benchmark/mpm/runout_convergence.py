#!/usr/bin/env python3
"""Is the runout converged? Runs workflows/scenes/mochikoshi_runout.json over cells, points per cell, update order,
Courant number, softening and overlap correction, and writes one row per run with its error and its CPU seconds.

    runout_convergence.py --solver build/bin/mpm_solver --output folder [--quick | --table] [--only NAME,...] [--figure FILE.png]

--quick: the five runs on cells of 5 m and 2.5 m with the usual settings. Runs that the folder holds already are not repeated, so a study can be
stopped and taken up again. E is scaled by 0.03 (one run with the full E checks that)."""
import argparse, csv, glob, json, os, resource, statistics, subprocess, sys, time

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
SCENE = os.path.join(ROOT, "workflows/scenes/mochikoshi_runout.json")
END = 45.0  # s: when the design study looked
# The study's pond: level 30.0 m, of which 2.5 m and 1.25 m are divisors, so that all lattices sample the same head.
POND = "/section/regions/3/polygon=[[-40,23.52],[119.71,23.52],[109,29.4],[110,30],[-40,30],[-40,23.52]]"
MATERIALS = ["embankment_saturated", "embankment"] + [f"liquefied_{k}" for k in range(1, 6)]


def case(h=2.5, points=3, order="usl", cfl=0.4, scale=0.03, overlap=5.0, tolerance=0.1, softens=True, length=2.5, eta=1000.0, shift=0.0,
         kernel="gimp", half_size=0.25, beta=1.0, nonlocal_length=None):
    """Overrides of one run. length None: softening strains as they stand; softens False: residual strengths from the start."""
    left = -40 - shift  # moves every point against the lattice: a jitter that keeps all areas
    sets = [f"/mpm/cell_size={h}", "/mpm/allow_coarse_cells=true", f"/mpm/fill_points={points}", f"/mpm/order={order}", f"/mpm/cfl={cfl}",
            f"/mpm/stiffness_scale={scale}", f"/mpm/overlap_correction/rate={overlap}", f"/mpm/duration={END}",
            f"/mpm/rest_earliest={2 * END}", f"/mpm/snapshot_interval={END}", '/mpm/output/fields=["epsilon_q", "volume"]', f"/mpm/telemetry_interval=1", POND]
    for key, value, usual in (("kernel", kernel, "gimp"), ("gimp_half_size", half_size, 0.25), ("blending_rate", beta, 1.0),
                              ("overlap_correction/tolerance", tolerance, 0.1)):
        if value != usual:
            sets.append(f"/mpm/{key}={value}")
    if left != -40:
        sets.append(f"/mpm/domain_x=[{left},{left + 660}]")
        sets.append("/mpm/floor/friction=" + json.dumps([{"from": left, "to": 220, "coefficient": 0.7},
                                                        {"from": 220, "to": left + 660, "coefficient": 0.35}]))
        for region, ring in pond_to(left).items():
            sets.append(f"/section/regions/{region}/polygon={json.dumps(ring)}")
        sets.remove(POND)
    if length is None:
        sets.append(f"/mpm/softening_length={h}")
    elif length != 2.5:
        sets.append(f"/mpm/softening_length={length}")
    for material in MATERIALS[:2] if nonlocal_length else []:  # the brittle ones
        sets.append(f"/materials/{material}/nonlocal_length={nonlocal_length}")
    for material in MATERIALS:
        if eta != 1000.0:
            sets.append(f"/materials/{material}/viscosity={eta}")
        if not softens:
            sets.append(f"/materials/{material}/law/softening/epsilon_q_start=0")
            sets.append(f"/materials/{material}/law/softening/epsilon_q_end=1e-6")
    return sets


def pond_to(left):
    """Tailings whose far end lies at x = left."""
    scene = json.load(open(SCENE))
    rings = {}
    for k, region in enumerate(scene["section"]["regions"]):
        ring = [[left if x == -40 else x, 30 if (y == 29.4 and k == 3 and x == -40) else y] for x, y in region["polygon"]]
        if k == 3:
            ring = [[left, 23.52], [119.71, 23.52], [109, 29.4], [110, 30], [left, 30], [left, 23.52]]
        if region["name"].startswith("tailings"):
            rings[k] = ring
    return rings


SHIFTS = {"_shift1": 0.31, "_shift2": 0.77, "_shift3": 1.27}
QUICK = {
    "h5_9": case(h=5.0), "h2.5_4": case(points=2), "h2.5_9": case(), "h2.5_16": case(points=4), "h2.5_9_musl": case(order="musl"),
}
FULL = dict(QUICK, **{
    **{f"h2.5_9{name}": case(shift=shift) for name, shift in SHIFTS.items()},
    **{f"h2.5_16{name}": case(points=4, shift=shift) for name, shift in SHIFTS.items()},
    "h2.5_9_overlap_off": case(overlap=0.0), "h2.5_16_overlap_off": case(points=4, overlap=0.0),
    "h2.5_25": case(points=5), "h2.5_25_overlap_off": case(points=5, overlap=0.0),
    "h2.5_9_overlap_off_shift1": case(overlap=0.0, shift=0.31), "h2.5_16_overlap_off_shift1": case(points=4, overlap=0.0, shift=0.31),
    "h2.5_9_beta0.1": case(beta=0.1), "h2.5_16_beta0.1": case(points=4, beta=0.1),
    "h2.5_9_beta0.1_shift1": case(beta=0.1, shift=0.31), "h2.5_16_beta0.1_shift1": case(points=4, beta=0.1, shift=0.31),
    "h2.5_9_beta0.1_shift2": case(beta=0.1, shift=0.77), "h2.5_9_beta0.1_musl": case(beta=0.1, order="musl"), "h1.25_9_beta0.1_cfl0.8": case(h=1.25, beta=0.1, cfl=0.8),
    "h1.25_16_beta0.1_cfl0.8": case(h=1.25, points=4, beta=0.1, cfl=0.8),
    "h2.5_9_b_spline": case(kernel="b_spline"), "h2.5_16_b_spline": case(points=4, kernel="b_spline"),
    "h2.5_9_half": case(half_size=0.5), "h2.5_16_half": case(points=4, half_size=0.5),
    "h2.5_9_eta3000": case(eta=3000.0), "h2.5_16_eta3000": case(points=4, eta=3000.0),
    **{f"h2.5_{points ** 2}_nonlocal4{name}": case(points=points, nonlocal_length=4, shift=shift)
       for points in (3, 4) for name, shift in {"": 0.0, **SHIFTS}.items()},
    **{f"h1.25_{points ** 2}_nonlocal{length}_cfl0.8{name}": case(h=1.25, points=points, nonlocal_length=length, cfl=0.8, shift=shift)
       for points in (3, 4) for length in (2, 4) for name, shift in {"": 0.0, **SHIFTS}.items()},
    "h2.5_9_soft_off": case(softens=False), "h2.5_16_soft_off": case(softens=False, points=4),
    "h2.5_9_soft_off_musl": case(softens=False, order="musl"),
    "h2.5_9_cfl0.2": case(cfl=0.2), "h2.5_9_cfl0.8": case(cfl=0.8),
    "h2.5_4_cfl0.8": case(points=2, cfl=0.8), "h2.5_16_cfl0.8": case(points=4, cfl=0.8), "h2.5_9_musl_cfl0.8": case(order="musl", cfl=0.8),
    "h2.5_9_eta0": case(eta=0.0), "h2.5_16_eta0": case(points=4, eta=0.0),
    "h2.5_9_full_E": case(scale=1.0),
    "h2.5_16_musl": case(points=4, order="musl"),
    "h1.25_9_cfl0.8": case(h=1.25, cfl=0.8), "h1.25_16_cfl0.8": case(h=1.25, points=4, cfl=0.8),
    "h1.25_9_soft_off_cfl0.8": case(h=1.25, softens=False, cfl=0.8), "h1.25_16_soft_off_cfl0.8": case(h=1.25, points=4, softens=False, cfl=0.8),
    "h5_9_soft_off": case(h=5.0, softens=False), "h0.625_9_soft_off_cfl0.8": case(h=0.625, softens=False, cfl=0.8),
    "h0.625_9_nonlocal2_cfl0.8": case(h=0.625, nonlocal_length=2, cfl=0.8),
    "h1.25_9": case(h=1.25), "h1.25_4": case(h=1.25, points=2),
    "h1.25_9_musl": case(h=1.25, order="musl"),
    "h1.25_9_unscaled": case(h=1.25, length=None),
    "h1.25_9_overlap_off": case(h=1.25, overlap=0.0),
    "h1.25_9_eta0": case(h=1.25, eta=0.0),
})
COLUMNS = ["run", "R_m", "Rd_m", "Rd95_m", "Rd50_m", "front_1m_m", "A0_m2", "overlap", "volume_ratio", "numerical_share", "overlap_energy_share",
           "residual_kinetic_share", "viscous_share", "particles", "steps", "cpu_s", "exit"]


def run(name, sets, solver, folder):
    out = os.path.join(folder, name)
    row_file = os.path.join(out, "row.json")
    if os.path.exists(row_file):
        return json.load(open(row_file))
    command = [solver, SCENE, "--output", out, "--progress", "none"]
    for each in sets:
        command += ["--set", each]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    ended = subprocess.run(command, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    row = {"run": name, "exit": ended.returncode, "cpu_s": round(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 1)}
    if ended.returncode:
        row["why"] = ended.stderr.strip().split("\n")[-1]
        print(name, row["why"], file=sys.stderr)
    else:
        result = json.load(open(os.path.join(out, "result.json")))
        result = result.get("result", result)
        share = {key: value.get("share", 0.0) for key, value in result["energy"].items()}
        row.update(R_m=result["runout"], Rd_m=result["runout_beyond_toe"], Rd95_m=result["runout_beyond_toe_95"],
                   Rd50_m=result["runout_beyond_toe_50"], front_1m_m=result["runout_front"], A0_m2=result["area_beyond_toe"],
                   overlap=result["overlap"], volume_ratio=result["volume_ratio"], numerical_share=share["numerical"],
                   overlap_energy_share=share["overlap_correction"], residual_kinetic_share=share["kinetic"],
                   viscous_share=share["viscous"], particles=result["particles"], steps=result["steps"])
    os.makedirs(out, exist_ok=True)
    json.dump(row, open(row_file, "w"))
    return row


def text_of(value):
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def write_table(rows, file):
    with open(file, "w", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(COLUMNS)
        for row in rows:
            table.writerow([text_of(row.get(column, "")) for column in COLUMNS])


def print_table(rows):
    shown = ["run", "R_m", "Rd_m", "Rd95_m", "front_1m_m", "A0_m2", "overlap", "numerical_share", "residual_kinetic_share", "cpu_s"]
    print(" | ".join(f"{name:>22}" if name == "run" else f"{name:>10.10}" for name in shown))
    for row in rows:
        print(" | ".join(f"{row['run']:>22}" if name == "run" else f"{text_of(row.get(name, '')):>10}" for name in shown))


def deposit(folder, name):
    with open(os.path.join(folder, name, "profile.csv")) as stream:
        rows = list(csv.DictReader(stream))
    return [float(r["x_m"]) for r in rows], [float(r["depth_m"]) for r in rows]


OTHER_PHYSICS = ("_eta", "soft_off", "unscaled", "nonlocal")  # another question, not another way to answer the same
OTHER_SCHEMES = ("h5", "_4", "overlap_off", "b_spline", "half", "beta")  # settings that are tried, not trusted
COLOURS = {"4": "C1", "9": "C0", "16": "C3", "25": "C2"}
MARKS = {"h5": "o", "h2.5": "s", "h1.25": "D"}


def trusted(rows):
    """Runs that answer the same question with sensible settings: their mean is the best there is to compare with."""
    return [row for row in rows if row["exit"] == 0 and not any(word in row["run"] for word in OTHER_PHYSICS + OTHER_SCHEMES)]


def draw(rows, folder, file):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(13, 4.8))
    same = {row["run"]: row for row in rows if row["exit"] == 0 and not any(word in row["run"] for word in OTHER_PHYSICS)}
    for name in ("h5_9", "h2.5_9", "h2.5_16", "h1.25_9_cfl0.8", "h1.25_16_cfl0.8"):
        if name in same:
            left.plot(*deposit(folder, name), label=name, lw=1.2)
    left.set(xlim=(-40, 400), xlabel="x (m); toe at 220 m", ylabel="depth of the deposit (m)", title=f"t = {END:g} s")
    left.legend(fontsize=8)
    distances = [row["Rd_m"] for row in trusted(rows)]
    if len(distances) > 1:
        mean, scatter = statistics.mean(distances), statistics.stdev(distances)
        print(f"{len(distances)} runs: Rd {mean:.1f} m, standard deviation {100 * scatter / mean:.1f} %, from {min(distances):.1f} to {max(distances):.1f}")
        for name, row in same.items():
            cells, points = name.split("_")[:2]
            right.semilogx(row["cpu_s"], 100 * (row["Rd_m"] / mean - 1), MARKS.get(cells, "x"), color=COLOURS.get(points, "k"), ms=5)
            right.annotate("_".join(name.split("_")[2:]), (row["cpu_s"], 100 * (row["Rd_m"] / mean - 1)), fontsize=6, xytext=(4, 2),
                           textcoords="offset points")
        right.axhspan(-100 * scatter / mean, 100 * scatter / mean, color="0.92", zorder=0)
        for label, mark in MARKS.items():
            right.plot([], [], mark, color="0.4", label=f"cells of {label[1:]} m")
        for points, colour in COLOURS.items():
            right.plot([], [], ".", color=colour, label=f"{points} points")
        right.legend(fontsize=7, loc="lower right")
        right.set(xlabel="CPU seconds", ylabel="error of Rd (%), against the mean of the trusted runs", ylim=(-45, 15),
                  title=f"Rd {mean:.0f} m; grey: one standard deviation, {100 * scatter / mean:.1f} %")
    figure.tight_layout()
    figure.savefig(file)


def rows_in(folder):
    return [json.load(open(file)) for file in sorted(glob.glob(os.path.join(folder, "*", "row.json")))]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--solver", default=os.path.join(ROOT, "build/bin/mpm_solver"))
    parser.add_argument("--output", required=True)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--only", default="")
    parser.add_argument("--table", action="store_true", help="no runs: table and figure of what the folder holds")
    parser.add_argument("--figure", default="")
    options = parser.parse_args()
    cases = QUICK if options.quick else FULL
    wanted = options.only.split(",") if options.only else list(cases)
    os.makedirs(options.output, exist_ok=True)
    rows = rows_in(options.output) if options.table else [run(name, cases[name], options.solver, options.output) for name in wanted]
    write_table(rows, os.path.join(options.output, "runout_convergence.csv"))
    print_table(rows)
    draw(rows, options.output, options.figure or os.path.join(options.output, "runout_convergence.png"))


if __name__ == "__main__":
    main()
