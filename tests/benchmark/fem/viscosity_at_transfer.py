#!/usr/bin/python3
"""Does the same soil gain the same energy before and after the transfer, and by which viscosity? docs/mochikoshi_fem.md (j).

    viscosity_at_transfer.py BIN_FOLDER --output FOLDER [--size 2.4]

The shipped scene to 6.5 s, with viscosity in its tailings and dams, transferred at 5 and 5.5 s; runouts of 0.75 s with another viscosity, the ground
shaking on or not. Prints kinetic energy in MJ per m. Runs are kept in FOLDER: asked again, it computes only what is missing.
"""
import argparse
import pathlib
import subprocess

import dam_runs

TIMES = [5.0, 5.5]
ETAS = [0, 1000, 10000]  # Pa s
LATER = [0.0, 0.25, 0.5, 0.75]
IN_FEM = ["tailings", "embankment"]
IN_MPM = ["embankment_saturated", "embankment_unsaturated", "tailings_not_liquefied"] + [f"liquefied_{i}" for i in range(1, 6)]


def viscous(soils, eta):
    return {f"materials__{soil}__viscosity": eta for soil in soils}


def listed(folder, name, times, scale=1.0, between=" | "):
    telemetry = dam_runs.telemetry_of(folder)
    return between.join(f"{dam_runs.at(telemetry, name, each) / scale:.2f}" for each in times)


def phase(program, output, settings, given):
    if not (output / "result.json").exists():
        subprocess.run([program, dam_runs.SCENE, "--output", output, "--input", given, "--progress", "none"] + dam_runs.overrides_of(settings),
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return output


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--output", type=pathlib.Path, required=True)
    parser.add_argument("--size", type=float, default=2.4)
    chosen = parser.parse_args()
    mesh = {"section__element_size": chosen.size, "fem__stages__2__duration": 6.5, "fem__snapshot_times": TIMES, "fem__snapshot_interval": 100}
    print("| t_T s | who goes on | eta before, Pa s | eta after | at t_T | " + " | ".join(f"+ {each:g} s" for each in LATER[1:]) + " |")
    print("|" + "---|" * (5 + len(LATER) - 1))
    for eta in ETAS:
        fem = chosen.output / f"fem_{eta}"
        dam_runs.run_dam(chosen.bin / "fem_solver", fem, mesh | viscous(IN_FEM, eta))
        for t_T in TIMES:
            times = [t_T + each for each in LATER]
            crest = listed(fem, "crest_displacement", times, between=", ")
            print(f"| {t_T:g} | FEM (crest {crest} m) | {eta} | {eta} | {listed(fem, 'kinetic_energy', times, 1e6)} |", flush=True)
            if eta == ETAS[-1]:
                continue
            points = phase(chosen.bin / "transfer_tool", chosen.output / f"transfer_{eta}_{t_T:g}", mesh, fem / f"snapshot_{t_T:.6f}.vtkhdf")
            for after in ETAS[:2]:
                for shaking in ("on", "off"):
                    settings = mesh | viscous(IN_MPM, after) | {"mpm__duration": 0.75, "mpm__telemetry_interval": 0.05, "mpm__shaking": shaking}
                    runout = phase(chosen.bin / "mpm_solver", chosen.output / f"mpm_{eta}_{t_T:g}_{after}_{shaking}", settings,
                                   points / "particles.vtkhdf")
                    print(f"| {t_T:g} | MPM, shaking {shaking} | {eta} | {after} | {listed(runout, 'kinetic_energy', LATER, 1e6)} |",
                          flush=True)


if __name__ == "__main__":
    main()
