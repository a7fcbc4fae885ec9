"""Phases on random small scenes: a change that cannot matter leaves the answer as it is, a scaled problem has the scaled answer,
more strength is not less safe, and a scene with one slip is refused with the slip's pointer.

    phases_test.py GROUP [--seed S] [--scenes N] [--scene K] [--checks NAME,...] [--shrink] [--keep DIR]

GROUP: lem, mpm, fem, chain or slips. A failure prints the command that repeats it alone. --shrink: hypothesis looks for the
smallest scene that fails the --checks (minutes)."""
import argparse
import os
import pathlib
import random
import shutil
import sys
import tempfile
import time
import traceback
import warnings

from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis import strategies as st

import scenes
import slips
import transformations as change
from answers import bits_that_differ, farthest_apart, numbers_of, run, run_with_stops

warnings.simplefilter("ignore")  # of hypothesis, about examples that are drawn twice


class Differs(AssertionError):
    pass


def claim(holds, what):
    if not holds:
        raise Differs(what)


def claim_same_bits(one, other, names_differ=False):
    claim(one.code == other.code, f"{one.said()}, and then {other.said()}")
    if one.code == 0:
        found = list(bits_that_differ(one, other, names_differ))
        claim(not found, f"{len(found)} differ: " + "; ".join(found[:4]))


def claim_close(one, other, allowed, mirrored=False, leave_out="none of them"):
    claim(one.code == other.code, f"{one.said()}, and then {other.said()}")
    if one.code != 0:
        return
    numbers, others = numbers_of(one), numbers_of(other, mirrored)
    names = [name for name in numbers if name in others and not name.startswith(leave_out)]
    if one.phase == "lem_tool" and allowed > 0:
        allowed += search_error(one) + search_error(other)
        if not same_search(one, other):
            names.remove("log F")
    claim_near(numbers, others, names, allowed)


def search_error(answer):
    """Of the factor and of Bishop's."""
    return max(facts.get("search_error", 0.0) for facts in (answer.result, answer.result["bishop"]))


def codes(answer):
    return [flag["code"] for flag in answer.result["flags"]]


def same_search(one, other):
    """Whether both have the same kinds of surfaces.

    Which layers are thin and weak, and whether a polyline is valid, goes by thresholds."""
    kinds = ("composite", "non_circular")
    invalid = ["kinked_without_friction" in codes(each) for each in (one, other)]
    return invalid[0] == invalid[1] and all((name in one.result) == (name in other.result) for name in kinds)


def claim_near(numbers, others, names, allowed):
    apart, name, before, after = farthest_apart(numbers, others, names)
    largest[0] = max(largest[0], apart)
    claim(apart <= allowed, f"{name}: {before:.9g}, and then {after:.9g} (apart {apart:.2g}, allowed {allowed:.1g})")


largest = [0.0]


# --------------------------------------------------------------------------------- one scene, one way to ask it otherwise

def check_change(phase, scene, base, alter, generator, folder):
    other = alter(scene, generator)
    if other is None:
        return False
    answer = run(phase, other, folder / "other")
    name = alter.__name__
    if name in change.EXACT[phase]:
        claim_same_bits(base, answer, names_differ=name in ("renamed", "reordered"))
    else:
        # An untouched layer that settles under its own weight contributes to the energies.
        claim_close(base, answer, change.allowed(phase, name, scene), name == "mirrored",
                    leave_out="energy" if name == "with_untouched_layer" else "none of them")
    return True


def check_threads(phase, scene, base, generator, folder):
    claim_same_bits(base, run(phase, scene, folder / "other", "--threads", generator.choice([2, 3, 5])))
    return True


def check_set(phase, scene, base, generator, folder):
    other, arguments = change.set_by_flag(scene, generator)
    claim_same_bits(base, run(phase, other, folder / "other", *arguments))
    return True


def check_stops(phase, scene, base, generator, folder):
    """Stopped at any step, at most three times, and resumed. The clock decides where it stops, not the seed."""
    answer, stops = run_with_stops(phase, scene, folder / "other", [generator.choice([0, 0.002, 0.01]) for _ in range(3)])
    claim_same_bits(base, answer)
    return stops > 0


def check_snapshots(phase, scene, base, generator, folder):
    """Snapshots where steps end: the FEM's at multiples of its step, the MPM's of a given step.

    Elsewhere the MPM cuts its steps to meet them (mpm_solver/simulation.cpp, next_step), which is another run within the error of a
    step."""
    other = change.copy.deepcopy(scene)
    if phase == "fem_solver":
        stage = scene["fem"]["stages"][-1]
        steps = round(stage["duration"] / stage["time_step"])
        chosen = generator.sample(range(1, steps + 1), min(3, steps))
        other["fem"]["snapshot_times"] = sorted(stage["time_step"] * k for k in chosen)
    elif "time_step" in scene["mpm"]:
        other["mpm"]["snapshot_interval"] = scene["mpm"]["duration"] / generator.choice([2, 4])
    else:
        return False
    claim_same_bits(base, run(phase, other, folder / "other"))
    return True


def check_lem_monotony(alter, scene, base, generator, folder):
    """Bishop's factor of every circle grows with strength and falls with pore pressure and shaking; so does the least of them,
    within what the descents leave."""
    other = alter(scene, generator)
    if other is None or base.code != 0:
        return False
    answer = run("lem_tool", other, folder / "other")
    claim(answer.code == 0, answer.said())
    # More friction then lowers the factor, as N' is negative there.
    if alter is change.stronger and "no_tension_crack" in codes(base) + codes(answer):
        return False
    before, after = numbers_of(base), numbers_of(answer)
    # Stronger soil around a layer makes it a weak one, along which lem_tool then searches, too (lem_tool/weak_layers.cpp): a phi of
    # 27 instead of 25 degrees around a layer of 24.2 lowered a factor from 1.2946 to 1.2920.
    allowed = change.SEARCH + search_error(base) + search_error(answer)
    for name in before if same_search(base, answer) else ["log F of Bishop"]:
        claim(after[name] >= before[name] - allowed, f"{name}: {before[name]:.6g}, and {alter.__name__} {after[name]:.6g}")
    return True


def check_mpm_monotony(scene, base, generator, folder):
    """A stronger soil runs no farther than the weaker one on any of four lattices, plus the scatter between these."""
    if base.code != 0:
        return False
    weak = [base]
    for k, shift in enumerate(([0.5, 0], [0, 0.5], [0.5, 0.5])):
        other = change.copy.deepcopy(scene)
        other["mpm"]["fill_shift"] = shift
        weak.append(run("mpm_solver", other, folder / f"lattice_{k}"))
    strong = run("mpm_solver", change.stronger(scene, generator), folder / "other")
    ways = [each.result["runout"] for each in weak if each.code == 0]
    claim(strong.code == 0, strong.said())
    most = 2 * max(ways) - min(ways)
    claim(strong.result["runout"] <= most, f"runout {min(ways):.4g} to {max(ways):.4g} m, stronger {strong.result['runout']:.4g} m")
    return True


def as_check(phase, alter):
    def check(scene, base, generator, folder):
        return check_change(phase, scene, base, alter, generator, folder)
    return check


def bound(check, phase):
    return lambda scene, base, generator, folder: check(phase, scene, base, generator, folder)


def checks_of(phase):
    checks = {alter.__name__: as_check(phase, alter) for alter in change.changes_of(phase)}
    checks["threads"], checks["set"] = bound(check_threads, phase), bound(check_set, phase)
    if phase == "lem_tool":
        for alter in (change.stronger, change.drier, change.less_shaken):
            checks[alter.__name__] = lambda *what, alter=alter: check_lem_monotony(alter, *what)
    else:
        checks["stops"], checks["snapshots"] = bound(check_stops, phase), bound(check_snapshots, phase)
    if phase == "mpm_solver":
        checks["stronger"] = check_mpm_monotony
    return checks


# ------------------------------------------------------------------------------------------------------------ the groups

def turn(names, at_once, number):
    """Checks of this scene, distributed evenly over the scenes."""
    return [names[(at_once * number + k) % len(names)] for k in range(min(at_once, len(names)))]


class Group:
    """A scene and three of the checks."""

    def __init__(self, phase, strategy, wanted):
        self.phase, self.checks = phase, checks_of(phase)
        self.names, self.at_once, self.strategy = wanted or sorted(self.checks), 3, strategy

    def check(self, scene, number, folder, fail):
        base = run(self.phase, scene, folder / "base")
        counts["refused" if base.code == 65 else "broke down" if base.code == 70 else "ran"] += 1
        if base.code not in (0, 65, 70) or "internal fault" in base.stderr:
            fail("base", base.said())
        for name in turn(self.names, self.at_once, number):
            largest[0] = 0.0
            try:
                did = self.checks[name](scene, base, random.Random(number), folder / name)
            except Differs as failure:
                fail(name, str(failure))
                continue
            tally = done.setdefault(name, [0, 0.0])
            tally[0] += bool(did)
            tally[1] = max(tally[1], largest[0])


class Chain:
    """A FEM's last snapshot through the transfer: for the scene and the changed scene, each with its own FEM."""

    def __init__(self, wanted):
        self.changes = {each.__name__: each for each in change.changes_of("transfer_tool")}
        self.names, self.at_once, self.strategy = wanted or sorted(self.changes), 2, scenes.chain_scenes()

    @staticmethod
    def points(scene, folder):
        fem = run("fem_solver", scene, folder / "fem")
        if fem.code != 0:
            return fem
        return run("transfer_tool", scene, folder / "points", "--input", sorted(fem.folder.glob("snapshot_*.vtkhdf"))[-1])

    def check(self, scene, number, folder, fail):
        base = self.points(scene, folder / "base")
        counts["refused" if base.code == 65 else "broke down" if base.code == 70 else "ran"] += 1
        for name in turn(self.names, self.at_once, number):
            largest[0] = 0.0
            other = self.changes[name](scene, random.Random(number))
            if other is None:
                continue
            try:
                answer = self.points(other, folder / name)
                if isinstance(other, str):
                    answer.scene = scene
                if name in change.EXACT["transfer_tool"]:
                    claim_same_bits(base, answer, names_differ=name in ("renamed", "reordered"))
                else:
                    claim_close(base, answer, change.allowed("transfer_tool", name, scene), name == "mirrored")
            except Differs as failure:
                fail(name, str(failure))
                continue
            tally = done.setdefault(name, [0, 0.0])
            tally[0] += 1
            tally[1] = max(tally[1], largest[0])


class Slips:
    """A valid scene with one error: exit 65, and a fault at its pointer."""

    def __init__(self, _):
        phases = {"lem_tool": scenes.lem_scenes(), "mpm_solver": scenes.mpm_scenes(), "fem_solver": scenes.fem_scenes()}
        self.names, self.at_once = [], 0
        self.strategy = st.sampled_from(sorted(phases)).flatmap(lambda phase: st.tuples(st.just(phase), phases[phase]))

    def check(self, case, number, folder, fail):
        phase, scene = case
        kind, wrong, pointers = slips.slipped(scene, random.Random(number))
        answer = run(phase, wrong, folder / "wrong")
        counts["refused" if answer.code == 65 else f"exit {answer.code}"] += 1
        found = [each["pointer"] for each in answer.faults]
        if answer.code != 65 or not set(found) & set(pointers):
            fail(kind, f"a slip at {' or '.join(pointers)}: {answer.said()}")
        done.setdefault(kind, [0, 0.0])[0] += 1


GROUPS = {"lem": lambda wanted: Group("lem_tool", scenes.lem_scenes(), wanted),
          "mpm": lambda wanted: Group("mpm_solver", scenes.mpm_scenes(), wanted),
          "fem": lambda wanted: Group("fem_solver", scenes.fem_scenes(), wanted), "chain": Chain, "slips": Slips}
done = {}


class Counts(dict):
    def __missing__(self, key):
        return 0


counts = Counts()


def main(arguments=None):
    options = argparse.ArgumentParser()
    options.add_argument("group", choices=sorted(GROUPS))
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--scenes", type=int, default=50)
    options.add_argument("--scene", type=int, help="only this one of them")
    options.add_argument("--checks", default="", help="only these: names of the printed table")
    options.add_argument("--shrink", action="store_true", help="look for the smallest scene that fails; with --checks")
    options.add_argument("--keep", help="folder for the scenes and runs of failures")
    asked = options.parse_args(arguments)
    if asked.shrink and not asked.checks:
        options.error("--shrink needs --checks: of which check the smallest scene is wanted")
    wanted = sorted(filter(None, asked.checks.split(",")))
    group, began, failures, number = GROUPS[asked.group](wanted), time.monotonic(), [], 0
    print(f"{asked.group}: {asked.scenes} scenes of seed {asked.seed}", flush=True)

    @seed(asked.seed)
    @settings(max_examples=asked.scenes, deadline=None, database=None, print_blob=False, suppress_health_check=list(HealthCheck),
              phases=[Phase.generate, Phase.shrink] if asked.shrink else [Phase.generate], report_multiple_bugs=False)
    @given(group.strategy)
    def each(case):
        nonlocal number
        number += 1
        if asked.scene not in (None, number) and not asked.shrink:
            return
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)

            def fail(what, why):
                if asked.shrink:
                    raise Differs(f"{what}: {why}")
                failures.append(what)
                print(f"FAILED scene {number}, {what}: {why}\n  repeat: BREACH_BIN={os.environ['BREACH_BIN']} "
                      f"BREACH_ROOT={os.environ['BREACH_ROOT']} /usr/bin/python3 {sys.argv[0]} {asked.group} --seed {asked.seed} "
                      f"--scenes {asked.scenes}{f' --checks {asked.checks}' * bool(wanted)} --scene {number}", flush=True)
                if asked.keep:
                    shutil.copytree(folder, pathlib.Path(asked.keep) / f"{asked.group}_{asked.seed}_{number}", dirs_exist_ok=True)
            # The smallest scene is used for all checks.
            group.at_once = len(group.names) if asked.shrink else group.at_once
            group.check(case, 1 if asked.shrink else number, folder, fail)

    try:
        each()
    except Differs:
        traceback.print_exc()
        return 1
    for name in sorted(done):
        print(f"  {name}: {done[name][0]}" + (f", at most {done[name][1]:.2g} apart" if done[name][1] else ""))
    cpu = os.times()
    print(f"{number} scenes ({', '.join(f'{count} {what}' for what, count in sorted(counts.items()))}), {len(failures)} failures, "
          f"{time.monotonic() - began:.0f} s, {cpu.user + cpu.system + cpu.children_user + cpu.children_system:.0f} CPU s")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
