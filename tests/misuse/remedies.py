"""Every flag of docs/reference/flags.md: a small scene that raises it and whose remedy is followed (`rows`), or why its message
names no value (`without`). A remedy is text that can be pasted, "--set /pointer=value" (core/words/remedy.hpp), or a number
"write 9.81" for the entry that the message names last, else the flag's own."""
import copy
import json
import re
import shlex
from dataclasses import dataclass, field

from cases import drop, put

setting = r"--set (?:'[^']*'|[^\s';:,()]*[^\s';:,().])"


def remedy_of(pointer, message):
    """The overrides of the first remedy in a message; none: it names no value."""
    if first := re.search(rf"{setting}(?:(?: and)? {setting})*", message):
        return [shlex.split(each)[1] for each in re.findall(setting, first[0])]
    if first := re.search(r"write (?:at least |at most )?(-?\d[\d.]*(?:e[+-]?\d+)?)", message):
        entry = ([pointer] + re.findall(r"; (/[\w/]+): ", message[:first.start()]))[-1]
        return [f"{entry.removeprefix('/scene')}={first[1]}"]
    return []


@dataclass
class Row:
    code: str
    base: dict
    sets: dict = field(default_factory=dict)
    drops: list = field(default_factory=list)
    run: str = None  # the phase that raises the flag; None: the submission
    motion: str = None
    left: str = None  # what the message says is left where the flag stays

    def scene(self, bases):
        document = copy.deepcopy(bases[self.base] if isinstance(self.base, str) else self.base)
        for pointer in self.drops:
            drop(document, pointer)
        for pointer, value in self.sets.items():
            put(document, pointer, value)
        return document


def soil(c, phi, E=20, nu=0.3, **law):
    return {"density": 1800, "law": {"type": "mohr_coulomb", "E_MPa": E, "nu": nu, "c_kPa": c, "phi_deg": phi, **law}}


def region(name, polygon):
    return {"name": name, "material": name, "polygon": [*polygon, polygon[0]]}


def section(materials, regions, **parts):
    return {"format": "breachline-scene/1", "name": "small", "materials": materials,
            "section": {"element_size": 1, "regions": [region(*each) for each in regions.items()]}, **parts}


def bank(c, phi, width=10, height=10, face=0, cell=1, end=60, **mpm):
    """A bank on a floor with friction, for the MPM."""
    foot = width + face
    return section({"s": soil(c, phi, tension_cutoff_kPa=0)}, {"s": [[0, 0], [foot, 0], [width, height], [0, height]]}, mpm={
        "cell_size": cell, "domain_x": [0, end], "domain_y": [0, 1.5 * height], "duration": "until_rest", "runout": {"toe": [foot, 0]},
        "floor": {"level": 0, "friction": [{"from": 0, "to": 100, "coefficient": 0.5}]}, "fill_stress": "overburden", **mpm})


def slope(**lem):
    """10 m, 1 : 2, on 15 m of weaker soil, for the LEM."""
    return section({"upper": soil(10, 30), "lower": soil(12, 10)}, {
        "upper": [[0, 0], [60, 0], [40, 10], [0, 10]], "lower": [[0, -15], [90, -15], [90, 0], [60, 0], [0, 0]]},
        lem={"search": {"entry": [2, 39], "exit": [45, 85]}, **lem})


cut = section({"clay": soil(48, 0)}, {"clay": [[0, -5], [90, -5], [90, 0], [66, 0], [50, 10.5], [0, 10.5]]},
              lem={"search": {"entry": [20, 49], "exit": [55, 85]}})


def of_elements(size):
    return {f"/section/regions/{i}/mesh": {"type": "unstructured", "element_size": size} for i in range(2)}


M = "mochikoshi"
torn = bank(300, 0, height=5, cell=0.5, end=40, tension_share=0, damping_ratio=0, longest_duration=20, floor={"level": 0})
seam = section({"fill": soil(5, 35), "seam": soil(0, 10), "base": soil(5, 35)}, {
    "fill": [[0, 0], [50, 0], [20, 15], [0, 15]], "seam": [[0, -2], [90, -2], [90, 0], [0, 0]],
    "base": [[0, -12], [90, -12], [90, -2], [0, -2]]}, lem={"search": {"entry": [2, 25], "exit": [45, 85]}})
brittle = {"epsilon_q_start": 0.01, "epsilon_q_end": 0.1, "c_residual_kPa": 1, "phi_residual_deg": 20}
softening = "/materials/slope_soil/law/softening"
drifting = "time_s,acceleration_m_s2\n" + "".join(f"{i / 100},{2 if 100 < i < 150 else 0}\n" for i in range(1200))

rows = [
    # ------------------------------------------------ raised at submission
    Row("coarse_cells", "slope", {"/mpm/cell_size": 2.5}),
    Row("shared_cells", "slope", {"/mpm/cell_size": 1.5, "/mpm/domain_x": [0, 60]}),
    Row("local_softening", "slope", {softening: brittle}),
    Row("short_nonlocal_length", "slope", {softening: brittle, "/mpm/softening_length": 1, "/materials/slope_soil/nonlocal_length": 1.5}),
    Row("wide_band", "slope", {softening: brittle, "/mpm/softening_length": 1, "/materials/slope_soil/nonlocal_length": 3}),
    Row("coarse_elements", "slope", {"/section/regions/0/mesh": {"type": "unstructured", "element_size": 4}}),
    Row("free_upstream_end", M, {"/mpm/domain_x": [-247.3, 692], "/mpm/floor/friction/0/from": -248}),
    Row("motion_cut", M, {"/fem/stages/2/duration": 2}),
    Row("beyond_motion", M, {"/fem/stages/2/duration": 80}),
    Row("section_upstream", M, {"/mpm/sections": [{"name": "pond", "x": 20}]}),
    Row("short_runout", "column", {"/mpm/duration": 0.5}),
    Row("coarse_step", M, {"/fem/stages/2/time_step": 0.05}),
    Row("drifting_motion", M, {"/fem/motion": {"file": "record.csv"}}, motion=drifting),
    Row("depths_differ", M, {"/fem/liquefaction/level": 10}),
    Row("beyond_ground", "slope", {"/lem/search/exit": [25, 70]}),
    Row("implausible", "slope", {"/gravity": 32.2}),
    Row("implausible", "slope", {"/mpm/domain_y": [-6, 15], "/mpm/floor/level": -6}),
    Row("implausible", M, {"/mpm/cell_size": 0.2}),
    # ------------------------------------------------ raised by a run
    Row("still_moving", bank(1, 30, height=5, end=30, duration=1), run="mpm_solver"),
    Row("still_moving", bank(1, 30, height=5, end=30, longest_duration=3), run="mpm_solver"),
    Row("reached_wall", bank(1, 30, end=20, right="roller"), run="mpm_solver"),
    Row("overlap", bank(1, 30), run="mpm_solver"),
    Row("overlap_work", bank(5, 30, height=20, end=100, cell=2, overlap_correction={"rate": 50}), run="mpm_solver"),
    Row("high_mach", bank(1, 20, end=100, stiffness_scale=0.3), run="mpm_solver"),
    Row("numerical_share", torn, run="mpm_solver"),
    Row("volume_ratio", torn, run="mpm_solver"),
    Row("thin_deposit", bank(1, 30, height=5, end=30), run="mpm_solver", left="until two cell sizes agree within 5 %"),
    Row("viscous_band", "slope", {**of_elements(2.5), "/fem/stages/1/duration": 3, "/fem/damping": {"ratio": 0.002, "frequency_Hz": 0.5},
                                  "/materials/slope_soil/law/c_kPa": 4, "/materials/slope_soil/law/phi_deg": 8},
        drops=[softening], run="fem_solver"),
    Row("bound_raises_factor", slope(search={"entry": [30, 38], "exit": [45, 60]}), run="lem_tool"),
    Row("range_edge", slope(search={"entry": [36, 38], "exit": [45, 85]}), run="lem_tool"),
    Row("deep_crack", slope(tension_crack={"depth": 9}), run="lem_tool"),
    Row("deep_crack", slope(tension_crack={"level": 1}), run="lem_tool"),
    Row("no_tension_crack", cut, run="lem_tool"),
    Row("surfaces_disagree", seam, run="lem_tool"),
    Row("drained_only", "static_lift", {"/lem/undrained": []}, run="lem_tool"),
]

drawing, judgement, test_of_soil = "the section must be drawn differently", "needs a judgement of the soil", "needs other laboratory tests"
without = {
    "upstream_wall": drawing, "sliver": drawing, "broken_base": drawing, "hardly_held": drawing, "undrawn_water": drawing,
    "far_crest": drawing, "load_ends": drawing, "steep_water": drawing, "scarp_without_pool": drawing,
    "standing_water": "says that the runout is a bound, whatever is set", "pool_runs_over": "a flood asks for another program",
    "needs_fem": drawing,
    "total_stress": judgement, "no_residual_strength": judgement, "strengths_differ": judgement, "outside_relation": judgement,
    "unused_density": judgement, "unconsolidated": judgement, "fails_unliquefied": judgement, "limit_point": judgement,
    "carried_slide": "pastes a viscosity of each material; tests/verification/mpm/carried_slide_test.py follows it",
    "layers_differ": "pastes a layer; tests/unit/check/agreement_test.cpp follows it",
    "missing_water": "pastes a line; tests/unit/check/agreement_test.cpp follows it",
    "sudden_change": judgement, "stress_cut_down": judgement,
    "critical_state_not_reached": test_of_soil, "parameter_not_held": test_of_soil, "few_tests": test_of_soil,
    "one_density": test_of_soil, "poor_fit": test_of_soil, "test_not_computed": test_of_soil, "calibration_not_settled": test_of_soil,
    "impossible": "of a motion file alone, before it is in a scene; the unit is named",
    "no_base_motion": "needs columns or a base beside the section",
    "still_liquefying": "how much longer it liquefies is not known",
    "entangled": "the end of a FEM that fails; transfer before",
    "entangled_corner": "where to refine is a place of the mesh",
    "fell_to_critical_state": "transfer before; the place is in the snapshots",
    "out_of_balance": "a finer mesh or smaller steps help in some scenes only",
    "no_frictional_rest": "a finer mesh or more iterations help in some scenes only",
    "stands_liquefied": "says what the critical depth is not",
    "below_layers": "the depth is of the study's trigger, not of the scene",
    "varies_higher_factor": "needs a study in place of the analysis",
    "kinked_without_friction": "the factor to use is in the same result",
    "starts_outside": "of an element test, which has no --set", "drained_softening": "S stays where the stage is undrained",
    "strength_of_floor": "of an element test, which has no --set", "clipped_overconsolidation": "of an element test, which has no --set",
    "liquefied_gap": "after a FEM of minutes: followed in tests/unit/liquefied/liquefied_zone_test.cpp",
}
