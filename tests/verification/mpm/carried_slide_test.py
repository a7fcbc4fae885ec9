"""A block on a slope whose friction can hold it: the flag carried_slide where stress waves carry it, none once its advice is
followed, none where it stands or slides as Coulomb says; the plan prints the damping in force. The scene is an input from outside
(block_near_critical/block14_F105.json, issue 61)."""
import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SOLVER = Path(os.environ["BREACH_BIN"]) / "mpm_solver"
SCENE = Path(__file__).parent / "block_near_critical.json"


def run(*sets):
    with tempfile.TemporaryDirectory() as folder:
        options = [each for one in sets for each in ("--set", one)]
        done = subprocess.run([SOLVER, SCENE, "--output", folder, "--progress", "none", *options], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        result = json.loads((Path(folder) / "result.json").read_text())
    return result, [flag for flag in result["flags"] if flag["code"] == "carried_slide"]


def check(what, holds, told=""):
    print(f"    {'ok ' if holds else 'BAD'} {what} {told}")
    return bool(holds)


def friction(factor):
    return f"/mpm/floor/friction/0/coefficient={factor * math.tan(math.radians(14))}"


def main():
    carried, flags = run()
    sound = check("a block that waves carry is questionable", len(flags) == 1 and flags[0]["severity"] == "questionable", carried["runout"])
    advised = re.findall(r"--set (\S+)", flags[0]["message"] if flags else "")
    stood, left = run(*advised)
    sound &= check("with the settings that the flag names it stands", advised and not left and stood["at_rest"] and stood["runout"] < -0.17,
                   f"{advised}: {stood['runout']}")
    result, flags = run(friction(1.10))
    sound &= check("one that stands has no flag", not flags and result["runout"] < -0.17, result["runout"])
    result, flags = run(friction(0.9), "/mpm/longest_duration=3")
    sound &= check("one that slides as Coulomb says has none", not flags and result["runout"] > 0.5, result["runout"])

    def plan(*options):
        text = subprocess.run([SOLVER, SCENE, "--plan", *options], capture_output=True, text=True, check=True).stdout
        return next(line for line in text.splitlines() if "damping of what does not yield" in line)

    for ratio in ("0.1", "0.5"):
        line = plan("--set", f"/mpm/damping_ratio={ratio}")
        sound &= check(f"the plan prints what is in force of {ratio}", f"0.0065 instead of {ratio}" in line and "cells of 0.25 m" in line, line)
    line = plan("--set", "/mpm/damping_ratio=0.005")
    sound &= check("and a ratio that is", " 0.005 of critical" in line and "instead" not in line, line)
    return 0 if sound else 1


sys.exit(main())
