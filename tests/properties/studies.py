"""Random studies for the properties, as Hypothesis strategies. A case is plain JSON: {"study": ..., "disturbances": [...], ...}.
Studies are small (at most about a dozen tasks), for their number matters more than their size."""
import copy
import json
import os
import pathlib

from hypothesis import strategies as st

import known

root = pathlib.Path(os.environ["BREACH_ROOT"])
times = [0.3, 0.5, 0.9, 1.2, 1.6]

without_memory = "/fem/newmark_beta=0.45"

# One change each, and the first phase that reads it. known.py defines the effect.
changes = {
    "lem_tool": ["/lem/slices=31", "/lem/slices=13"],
    "fem_solver": [
        "/fem/newmark_beta=0.4",
        without_memory,
        "/fem/least_jacobian_ratio=0.006",
        "/fem/least_jacobian_ratio=0.012",
        "/fem/largest_iterations=10",
        "/fem/largest_iterations=4",
        '/fem/surcharge/-={"from":2,"to":4,"pressure_kPa":1}',
    ],
    "transfer_tool": ["/transfer/neighbours=20", "/transfer/neighbours=13", '/transfer/stress="effective"'],
    "mpm_solver": [
        "/mpm/cfl=0.3",
        "/mpm/cfl=0.5",
        "/mpm/cfl=0.6",
        "/mpm/cfl=0.7",
        "/mpm/rest_body_share=0.01",
        "/mpm/rest_body_share=0.02",
        "/mpm/cell_size=2",
        "/mpm/damping_ratio=0.2",
        '/mpm/runout/regions/-="base"',
    ],
    "all": ["/materials/base_soil/density=2100", "/gravity=9.7"],
}

disturbances = ["extend", "extend_at_once", "twin", "warm", "remove", "pause", "cancel", "kill", "retry", "rename"]


def scene(has_fem=True, salt=0):
    """The shipped slope on a coarse mesh. `salt` makes it a scene that the cache has not seen."""
    made = json.loads((root / "workflows/scenes/slope.json").read_text())
    base, slope = made["section"]["regions"]
    base["mesh"]["divisions"], slope["mesh"]["divisions"] = [12, 2], [6, 4]
    made["fem"]["stages"][1] |= {"duration": 2.0, "time_step": 0.05}
    made["mpm"]["allow_coarse_cells"] = True
    made["materials"]["base_soil"]["density"] = 2000 + salt / 1000
    if not has_fem:
        del made["fem"], made["transfer"]
    return made


def changes_of(has_fem, most):
    names = changes if has_fem else ("lem_tool", "mpm_solver", "all")
    one = st.sampled_from(list(names)).flatmap(lambda phase: st.sampled_from(changes[phase]))
    appends = st.sampled_from([each for phase in names for each in changes[phase] if "/-=" in each])
    return st.lists(one | one | one | appends, max_size=most, unique_by=lambda each: each.split("=")[0])


@st.composite
def sweeps(draw):
    """Variants, overrides, times, repeats, cache; with or without a FEM, with or without a stability analysis."""
    has_fem = draw(st.sampled_from([True, True, True, False]))
    study = {"format": "breachline-study/1", "name": "random", "scene": scene(has_fem, draw(st.integers(0, 9999)))}
    if has_fem:
        study["transfer_times"] = sorted(draw(st.lists(st.sampled_from(times), min_size=1, max_size=3, unique=True)))
    study["overrides"] = draw(changes_of(has_fem, 2))
    room = 6 // len(study.get("transfer_times", [1]))  # variants times repeats
    count = draw(st.integers(0, min(3, room)))
    if count:
        study["variants"] = [{"name": "abc"[k], "overrides": draw(changes_of(has_fem, 4))} for k in range(count)]
    draws = draw(st.integers(1, max(1, min(3, room // max(1, count)))))
    if draws > 1:
        study["draws"] = draws
        if has_fem and draw(st.booleans()):
            study["draws_of"] = "fem"
    for key, value in (("reuse", False), ("stability", False), ("known_failure", True), ("priority", 7)):
        if draw(st.integers(0, 3)) == 0:
            study[key] = value
    return study


@st.composite
def triggered(draw):
    """A criterion or a window on a few variants, rarely with given times."""
    study = draw(sweeps().filter(lambda each: "fem" in each["scene"]))
    if draw(st.integers(0, 3)):
        del study["transfer_times"]
    study.pop("draws_of", None)  # refused: each repeat's FEM would have its own time
    if study.get("draws", 1) > 2:
        study["draws"] = 2
    condition = st.builds(
        "{} > {}".format, st.sampled_from(["crest_displacement", "time", "kinetic_energy"]), st.sampled_from([0.25, 0.45, 0.75, 1.25, 1.75, 2.5])
    )
    trigger = {"kind": draw(st.sampled_from(["criterion", "window", "window"])), "name": "t", "snapshot_interval_s": known.step}
    if trigger["kind"] == "criterion":
        trigger["when"] = draw(condition)
    else:
        # A quarter of them with several spans after the lower edge.
        trigger |= {"lower": draw(st.just("time > 0.25") | condition), "upper": draw(st.just("kinetic_energy > 1.25") | condition)}
        pick = draw(st.sampled_from([None, "first", "midpoint", "last_before"]))
        trigger |= {"pick": pick} if pick else {}
    if draw(st.integers(0, 4)) == 0:
        study["overrides"].append(without_memory)
    if "transfer_times" not in study and draw(st.booleans()):
        trigger["snapshot_interval_s"] = draw(st.sampled_from([0.3, 0.5]))
    if draw(st.booleans()):
        trigger["hold_s"] = draw(st.sampled_from([0.1, 0.2, 0.5]))
    return study | {"triggers": [trigger]}


@st.composite
def cases(draw, studies=None):
    study = draw(studies if studies is not None else sweeps())
    any_of_them = st.lists(st.sampled_from(disturbances), max_size=5, unique=True)
    chosen = draw(any_of_them | any_of_them | any_of_them | st.just(["extend", "warm"]))
    apt = "retry" if without_memory in str(study) else "extend" if "uncertainty" in study else None
    if apt and draw(st.booleans()):
        chosen = [*chosen, apt]
    return {
        "study": study,
        "disturbances": sorted(set(chosen), key=disturbances.index),
        "after_ms": draw(st.sampled_from([0, 30, 100, 300])),
    }


def reversed_variants(study):
    """The same study with its variants in another order."""
    other = copy.deepcopy(study)
    if "variants" in other:
        other["variants"].reverse()
    return other
