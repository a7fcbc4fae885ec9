#!/usr/bin/python3
"""Speed anchor: the slope of ../shared/reference/opensees/tcl/slope2d.tcl, 4,400 elements of PM4Sand under water, 400
steps of 2e-3 s. CPU seconds per step by kind of work and the crest's motion for several tolerances.

    liquefying_slope.py BIN_FOLDER [--duration 0.8]

OpenSees 3.8 on the same model (README of the reference): 0.746 CPU s per step with increments below 1e-4, 3.66
iterations per step. Seconds by kind are wall seconds, scaled here to the CPU seconds of the run.
"""
import argparse
import pathlib
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve()
sys.path.insert(0, str(HERE.parents[2] / "verification/fem"))
import opensees_models
from runs import run

OPENSEES = 0.746  # CPU s per step


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("--duration", type=float, default=0.8)
    options = parser.parse_args()
    steps = round(options.duration / 2e-3)
    kinds = ("assembly", "law", "factor", "solve", "output")
    print(f"{'tolerance':>9} {'CPU s/step':>10} {'OpenSees/':>9} {' '.join(f'{kind:>8}' for kind in kinds)} {'it/step':>7} {'matrices':>8} {'cut':>4} "
          f"{'stalled':>7} {'crest u_x, u_y [m]':>20}")
    for tolerance in (1e-4, 1e-5):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            opensees_models.slope(folder, duration=options.duration, force_tolerance=tolerance, telemetry_interval=0.05)
            result, lines = run(options.bin / "fem_solver", folder / "scene.json", folder / "out")
        seconds = result["seconds"]
        share = result["cpu_seconds"] / sum(seconds.values()) / steps
        spent = " ".join(f"{seconds[kind] * share:8.4f}" for kind in kinds)
        per_step = result["cpu_seconds"] / steps
        print(f"{tolerance:9.0e} {per_step:10.4f} {OPENSEES / per_step:9.1f} {spent} {result['iterations'] / steps:7.2f} "
              f"{result['factorisations']:8d} {result['cut_steps']:4d} {result['stalled_steps']:7d} "
              f"{lines[-1]['crest_dx']:10.5f} {lines[-1]['crest_dy']:9.5f}", flush=True)


main()
