"""What a study must come to, from its document alone: written from the documentation, never from the orchestrator's sources.
Where the documentation leaves something open (where a lattice is moved to), the document is the stored one."""
import copy
import math
import statistics

import known
from stand_in import changed

averaged = [
    "runout",
    "runout_beyond_toe",
    "runout_largest",
    "area_beyond_toe",
    "volume_ratio",
    "numerical_share",
    "overlap",
    "cpu_seconds",
    "kinetic_share",
    "end_time",
]


def scene_of(study, variant):
    return changed(copy.deepcopy(study["scene"]), study.get("overrides", []) + variant.get("overrides", []))


def variants_of(study):
    """(own variant, name, number of the repeat) in the order of the rows."""
    draws = study.get("draws", 1)
    for own in study.get("variants") or [{"name": ""}]:
        for number in range(draws):
            name = own["name"]
            if number > 0 and draws > 1 or not name and draws > 1:
                name = f"{name}_d{number + 1}" if name else f"d{number + 1}"
            yield own, name, number


def runout(scene, time, shift):
    """(state, reason, numbers) of a row."""
    whole = added = 0
    if time is not None:
        whole, how, when = known.fem(scene)
        if time > when and how == "entangled":
            return "not_reached", f"the FEM ended entangled at {when:g} s, before {time:g} s", None
        if time > when:
            return "skipped", f" failed before it gave snapshot_{time:.6f}.vtkhdf", None
        added = known.transfer(scene)
        if added is None:
            return "failed", "no neighbours", None
    result = known.mpm(scene, time, whole, added, shift)
    if result is None:
        return "failed", "the points have left the grid", None
    return "questionable" if result["questionable"] else "succeeded", "", result


def flags_of_fem(scene):
    return ["entangled"] if "fem" in scene and known.fem(scene)[1] == "entangled" else []


def row(study, scene, variant, time, shift):
    state, reason, result = runout(scene, time, shift)
    found = {
        "variant": variant,
        "transfer_time": time,
        "state": state,
        "reason": reason,
        "trigger": "" if time is None else "at_time",
        "questionable": None,
        "lower_bound": None,
    }
    found["factor_of_safety"] = known.lem(scene) if "lem" in scene and study.get("stability", True) else None
    found |= dict.fromkeys([*averaged, "at_rest", "ended"])
    if result:
        found |= {name: result.get(name) for name in averaged if name != "numerical_share"}
        found |= {
            "numerical_share": 0.01,
            "at_rest": result["at_rest"],
            "ended": result["ended"],
            "questionable": result["questionable"],
            "lower_bound": not result["at_rest"],
        }
        found["flags"] = sorted([flag["code"] for flag in result["flags"]] + (flags_of_fem(scene) if time is not None else []))
    return found


def mean(rows, draws):
    """Mean of a variant at one time over its repeats."""
    done = [each for each in rows if each["runout"] is not None]
    missing = [f"{each['variant']}: {each['state']}" for each in rows if each["runout"] is None]
    doubtful = [each["variant"] for each in done if each["questionable"]]
    state = "partial" if missing and done else rows[0]["state"] if missing else "questionable" if doubtful else "succeeded"
    found = {
        "transfer_time": rows[0]["transfer_time"],
        "state": state,
        "draws": draws,
        "draws_done": len(done),
        "missing_draws": "; ".join(missing),
        "questionable_draws": "; ".join(doubtful),
        "lower_bound": any(each["lower_bound"] for each in done) if done else None,
    }
    for name in averaged:
        values = [each[name] for each in done if each[name] is not None]
        found[name] = statistics.fmean(values) if values else None
        found[name + "_deviation"] = statistics.stdev(values) if len(values) > 1 else None
    return found


def same_results(study, rows):
    """Groups of variants with equal numbers wherever both have ended, at one time at least."""
    numbers = {}
    for each in rows:
        if each["runout"] is not None:
            numbers.setdefault(each["variant"], {})[each["transfer_time"]] = [
                each[name] for name in [*averaged, "factor_of_safety"]
            ]
    groups = []
    for name in [name for _, name, _ in variants_of(study)]:
        for group in groups:
            if all(
                (both := numbers.get(name, {}).keys() & numbers.get(other, {}).keys())
                and all(numbers[name][t] == numbers[other][t] for t in both)
                for other in group
            ):
                group.append(name)
                break
        else:
            groups.append([name])
    return [group for group in groups if len(group) > 1]


def verdict(study, scenes, rows, without):
    """How far the results can be used (docs/reference/results.md)."""
    factors = [known.lem(each) for each in scenes] if "lem" in study["scene"] and study.get("stability", True) else []
    falls = [each < 1 for each in factors if each is not None] if not study.get("known_failure") else []
    missing = [each["variant"] for each in without] + [
        name
        for name in {each["variant"] for each in rows}
        if all(each["state"] == "not_reached" for each in rows if each["variant"] == name)
    ]
    if falls and all(falls) or missing and all(each["runout"] is None for each in rows):
        return "no"
    if any(falls) or any(each["questionable"] for each in rows) or missing:
        return "questionable"
    if None in factors or any(each["state"] in ("failed", "skipped") for each in rows) or any(breaks_down(each) for each in scenes):
        return "in_part"
    return "with_remarks" if any(each.get("flags") for each in rows) or same_results(study, rows) else "yes"


def with_warnings(usable, warnings):
    """The verdict with the warnings of the submission."""
    from_best = ["yes", "with_remarks", "in_part", "questionable", "no"]
    worth = ["no" if each["code"] == "implausible" else "with_remarks" for each in warnings]
    return max([usable, *worth], key=from_best.index)


def breaks_down(scene):
    return "fem" in scene and known.fem(scene)[1] == "breakdown"


def state(study, scenes, rows):
    """State of the run."""
    lems = [known.lem(each) for each in scenes] if "lem" in study["scene"] and study.get("stability", True) else []
    broken = None in lems or any(each["state"] in ("failed", "skipped") for each in rows) or any(map(breaks_down, scenes))
    if broken:
        return "partial" if any(each["runout"] is not None for each in rows) else "failed"
    if all(each["state"] == "not_reached" for each in rows):  # also without rows
        return "partial"
    return "questionable" if any(each["questionable"] for each in rows) else "succeeded"


def transfers_of(study, scene):
    """(time, its trigger: None for one of several, whether the trigger's condition was met)"""
    if "fem" not in scene:
        return [(None, "")], False
    made = {time: "at_time" for time in study.get("transfer_times", [])}
    met = False
    for trigger in study.get("triggers", []):
        time, was_met = fired(trigger, scene)
        met = met or was_met
        if time is not None:
            made[time] = None if time in made else trigger["name"]
    return sorted(made.items()), met


def without_transfer(scene, variant, met):
    how = known.fem(scene)[1]
    return {"variant": variant, "state": "failed" if how == "breakdown" else "not_reached", "stood": how == "complete" and not met}


def answer(study, moved):
    """`moved`: overrides of each variant by name, as stored, which say where draws have their lattices and steps."""
    rows, means, scenes, without = [], [], [], []
    for own, name, _ in variants_of(study):
        scene = scene_of(study, {"overrides": moved.get(name, own.get("overrides", []))})
        scenes.append(scene)
        shift = (scene["transfer"] if "fem" in scene else scene["mpm"]).get(
            "point_shift" if "fem" in scene else "fill_shift", [0, 0]
        )[0]
        made, met = transfers_of(study, scene)
        for time, by in made:
            rows.append({**row(study, scene, name, time, shift), "trigger": by})
        if not made:
            without.append(without_transfer(scene, name, met))
    if study.get("draws", 1) > 1:
        for own in study.get("variants") or [{"name": ""}]:
            names = [name for each, name, _ in variants_of(study) if each["name"] == own["name"]]
            for time in sorted({each["transfer_time"] for each in rows if each["variant"] in names}, key=lambda time: time or 0):
                of = [each for each in rows if each["variant"] in names and each["transfer_time"] == time]
                means.append({"variant": own["name"], **mean(of, study["draws"])})
    return {
        "rows": rows,
        "means": means,
        "state": state(study, scenes, rows),
        "verdict": verdict(study, scenes, rows, without),
        "same_results": same_results(study, rows),
        "without_transfer": without,
        **counts(scenes, rows),
    }


def counts(scenes, rows):
    """Number of results per flag code, and of questionable results."""
    fems = {known.fem(each)[0]: known.fem(each)[1] for each in scenes if "fem" in each}
    found = {"entangled": sum(how == "entangled" for how in fems.values())}
    for code in ("still_moving", "overlap"):
        found[code] = sum(code in each.get("flags", []) for each in rows)
    return {
        "flag_counts": {code: count for code, count in found.items() if count},
        "questionable": sum(each["questionable"] is True for each in rows),
        "fems": len(fems),
    }


def differs(wanted, got):
    if isinstance(wanted, float) and isinstance(got, (int, float)) and not isinstance(got, bool):
        return not math.isclose(wanted, got, rel_tol=1e-9, abs_tol=1e-9)
    return wanted != got


def differences(wanted, run, results, extended=False):
    """Differences of a run from the answer. An extended one may have computed a FEM again."""
    found = []
    for what, table in (("row", "rows"), ("mean", "means")):
        shown = {(each["variant"], each["transfer_time"]): each for each in results[table]}
        asked = {(each["variant"], each["transfer_time"]): each for each in wanted[table]}
        if list(shown) != list(asked) or len(results[table]) != len(shown):
            found.append(f"{table} are {list(shown)} for {list(asked)}")
        for key in shown.keys() & asked.keys():
            for name, value in asked[key].items():
                got = shown[key][name]
                if name == "trigger" and value is None:
                    continue
                if name == "flags":
                    got = sorted(flag["code"] for flag in got or [])
                if differs(value, got) and not (name == "reason" and value.startswith(" failed") and str(got).endswith(value)):
                    found.append(f"{what} {key}: {name} is {got!r} for {value!r}")
    listed = [{name: each[name] for name in ("variant", "state", "stood")} for each in results["without_transfer"]]
    if listed != wanted["without_transfer"]:
        found.append(f"without_transfer is {listed} for {wanted['without_transfer']}")
    for name in ("flag_counts", "questionable"):
        if run[name] != wanted[name] and not (extended and name == "flag_counts"):
            found.append(f"{name} is {run[name]} for {wanted[name]}")
    fems = sum(task["phase"] == "fem_solver" for task in run["tasks"])
    if fems != wanted["fems"] and not extended:
        found.append(f"{fems} FEMs for {wanted['fems']}")
    if results["same_results"] != wanted["same_results"]:
        found.append(f"same_results is {results['same_results']} for {wanted['same_results']}")
    if run["state"] != wanted["state"]:
        found.append(f"the run is {run['state']} for {wanted['state']}")
    usable = with_warnings(wanted["verdict"], run["warnings"])
    if results["verdict"]["usable"] != usable:
        found.append(
            f"the verdict is {results['verdict']['usable']} for {usable}: "
            f"{[reason['text'] for reason in results['verdict']['reasons']]}"
        )
    return found


# Triggers ------------------------------------------------------------------------------------------------------------------------


def spans(condition, scene, lines):
    """(first line, last line) of each interval in which "FIELD > NUMBER" is true."""
    whole = known.fem(scene)[0]
    field, limit = condition.split(" > ")
    value = {
        "time": lambda time: time,
        "crest_displacement": lambda time: known.crest(whole, time),
        "kinetic_energy": lambda time: known.energy(whole, time),
    }[field]
    found = []
    for k, time in enumerate(lines):
        if value(time) <= float(limit):
            continue
        begun = k and found and found[-1][1] == lines[k - 1]
        found[-1:] = [(found[-1][0], time)] if begun else [*found[-1:], (time, time)]
    return found


def fired(trigger, scene):
    """(transfer time or None, whether the condition was met) for a FEM."""
    lines = [round(k * known.step, 6) for k in range(1, round(known.fem(scene)[2] / known.step) + 1)]
    interval = trigger["snapshot_interval_s"]
    snapshots = [time for time in lines if abs(time / interval - round(time / interval)) < 1e-6]
    hold = trigger.get("hold_s", 0) - 1e-9

    def lasting(condition):
        return [(begin, end) for begin, end in spans(condition, scene, lines) if end - begin >= hold]

    condition = trigger["when"] if trigger["kind"] == "criterion" else trigger["lower"]
    lower = next((begin for begin, _ in lasting(condition)), None)
    if lower is None:  # may still have been true at the FEM's end
        return None, any(end == lines[-1] for _, end in spans(condition, scene, lines))

    latest = 0.05 * known.end + 1e-9  # a later snapshot does not count

    if trigger["kind"] == "criterion":
        wanted = next(t for t in lines if t >= lower + hold)
        return next((t for t in snapshots if wanted <= t <= wanted + latest), None), True
    upper = next((begin for begin, end in lasting(trigger["upper"]) if end >= lower), None)
    if upper is not None and upper <= lower:
        return None, True  # no window
    between = [t for t in snapshots if lower <= t and (upper is None or t < upper)]
    end = snapshots[-1] if upper is None and snapshots else upper  # the FEM's end closes a window without an upper edge
    pick = trigger.get("pick", "midpoint")
    if not between:
        return None, True
    if pick == "last_before":
        return next((t for t in reversed(between) if t < end), None), True
    wanted = lower if pick == "first" else (lower + end) / 2
    near = between[0] if pick == "first" else min(between, key=lambda t: (round(abs(t - wanted), 6), t))  # the earlier of two
    return near if near <= wanted + latest else None, True
