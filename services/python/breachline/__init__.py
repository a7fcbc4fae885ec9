"""Reads runs of Breachline into numpy: results, frames, comparisons.

    import breachline as breach
    run = breach.run("latest")           # from a service, or breach.run("slope-run/") from an exported folder
    run.results["runout"]                # [m], one value per row
    run.frames()[-1]["epsilon_q"]        # of every material point at the last frame
    run = breach.submit(breach.template("upstream_dam", height=20)).wait()
"""
from .faults import BreachlineError, Unreachable
from .frames import Frame, Frames
from .run import Run, Task, run, runs, submit, template
from .table import Column, Comparison, Table

__all__ = ["BreachlineError", "Column", "Comparison", "Frame", "Frames", "Run", "Table", "Task", "Unreachable", "run", "runs", "submit", "template"]
