#!/usr/bin/python3
"""When the dam's events come, by element size, hourglass stiffness and stiffness damping a_K: docs/mochikoshi_fem.md (f).

    hourglass_and_damping.py BIN_FOLDER --output FOLDER [--sizes 2.4 1.2] [--damping 0 2e-3] [--limit CPU_SECONDS] [--kinematics updated_lagrangian]

The shipped scene, 25 s asked for, going on past entanglement (not on a moving mesh, which ends there). Runs are kept in FOLDER: asked again, it computes
only what is missing, and prints the table of all that is there.
"""
import argparse
import pathlib

import dam_runs

A_K = [0.0, 5e-4, 1e-3, 2e-3]
CREST = [1.0, 2.5, 5.0]


def settings_of(size, hourglass, a_k, kinematics):
    settings = {"section__element_size": size, "fem__hourglass": hourglass, "fem__rayleigh_stiffness": a_k,
                "fem__stages__2__duration": 25}
    if kinematics == "small_strain":
        settings["fem__at_entanglement"] = "go_on"
    else:
        settings["fem__kinematics"] = kinematics
    return settings


def text(time, digits=2):
    return "never" if time is None else f"{time:.{digits}f}"


def row_of(folder, size, hourglass, a_k, done):
    telemetry = dam_runs.telemetry_of(folder)

    def first(reached):
        return text(dam_runs.first_time(telemetry, reached))

    crest = telemetry["crest_displacement"]
    energy = telemetry["kinetic_energy"]
    end = "" if done["ended"] != dam_runs.STOPPED else f" (stopped at {telemetry['time'][-1]:.1f})"
    return [f"{size:g}", f"{hourglass}, {a_k:g}", first(telemetry["failure_surfaces"] >= 1), first(telemetry["epsilon_q_avg"] > 0.2),
            first(telemetry["jacobian_centre_avg"] < 0.97), first(telemetry["jacobian_ratio_min"] < 0.01),
            " / ".join(first(crest > each) for each in CREST), f"{crest[-1]:.1f}{end}",
            f"{energy.max() / 1e6:.1f} at {telemetry['time'][energy.argmax()]:.1f}", f"{done['cpu_seconds']:.0f}"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--sizes", type=float, nargs="+", default=[2.4])
    parser.add_argument("--hourglass", nargs="+", default=["current", "elastic"])
    parser.add_argument("--damping", type=float, nargs="+", default=A_K, help="a_K, s")
    parser.add_argument("--limit", type=float, default=1200.0, help="CPU seconds of one run")
    parser.add_argument("--kinematics", default="small_strain")
    chosen = parser.parse_args()
    print("| elements, m | hourglass, a_K s | first surface | mean epsilon_q > 20 % | mean centre J < 0.97 | folds | crest 1 / 2.5 / 5 m at "
          "| crest at the end, m | kinetic energy at most, MJ per m, at s | CPU s |")
    print("|" + "---|" * 10)
    for size in chosen.sizes:
        for hourglass in chosen.hourglass:
            for a_k in chosen.damping:
                folder = chosen.output / f"{size:g}_{hourglass}_{a_k:g}_{chosen.kinematics}"
                done = dam_runs.run_dam(chosen.bin / "fem_solver", folder, settings_of(size, hourglass, a_k, chosen.kinematics), chosen.limit)
                print("| " + " | ".join(row_of(folder, size, hourglass, a_k, done)) + " |", flush=True)


if __name__ == "__main__":
    main()
