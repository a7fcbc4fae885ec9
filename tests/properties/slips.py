"""Invalid studies: a valid study with one error. {"study": ..., "slip": pointer, "how": in words}."""
import copy

from hypothesis import strategies as st

import studies

# Replacements by the kind of a value.
wrong = {
    bool: ["yes", 1, None],
    int: ["3", [3], None],
    float: ["3", [3], None, True],
    str: [3, None, [], {}],
    list: [{}, "x", 3],
    dict: [[], "x", 3],
}
free = ("notes", "title")  # entries that take any text

# (name, pointer of the error, value there); -: appended
values = [
    ("no draw", "/draws", 0),
    ("too many draws", "/draws", 201),
    ("draws by halves", "/draws", 1.5),
    ("draws of everything", "/draws_of", "all"),
    ("a huge integer", "/draws", 2**70),
    ("priority", "/priority", 101),
    ("format", "/format", "breachline-study/0"),
    ("name", "/name", "A b"),
    ("long name", "/name", "n" * 65),
    ("no scene", "/scene", "nobody"),
    ("times", "/transfer_times", []),
    ("a range without step", "/transfer_times", {"from": 0.1, "to": 0.5}),
    ("a step of zero", "/transfer_times", {"from": 0.1, "to": 0.5, "step": 0}),
    ("an endless range", "/transfer_times", {"from": 0, "to": 2, "step": 1e-9}),
    ("backwards", "/transfer_times", {"from": 0.5, "to": 0.1, "step": 0.1}),
    ("before the start", "/transfer_times/-", -1),
    ("after the FEM's end", "/transfer_times/-", 50),
    ("a time of text", "/transfer_times/-", "0.5"),
    ("a time beyond all numbers", "/transfer_times/-", 1e308),
    ("two variants of a name", "/variants", [{"name": "a"}, {"name": "a"}]),
    ("a variant without a name", "/variants", [{"overrides": ["/mpm/cfl=0.3"]}]),
    ("an unknown trigger", "/triggers", [{"kind": "sometimes"}]),
    ("an unknown field", "/triggers", [{"kind": "criterion", "when": "pore_joy > 1"}]),
    ("half a condition", "/triggers", [{"kind": "criterion", "when": "time >"}]),
    ("no condition", "/triggers", [{"kind": "criterion"}]),
    ("a window of one edge", "/triggers", [{"kind": "window", "lower": "time > 1"}]),
    ("a negative hold", "/triggers", [{"kind": "criterion", "when": "time > 1", "hold_s": -1}]),
    ("an interval of zero", "/triggers", [{"kind": "criterion", "when": "time > 1", "snapshot_interval_s": 0}]),
    ("one seed", "/triggers", [{"kind": "bisect", "seeds": 1}]),
    ("a bisect backwards", "/triggers", [{"kind": "bisect", "from": 1, "to": 0.5}]),
    ("a window's entry in a criterion", "/triggers", [{"kind": "criterion", "when": "time > 1", "pick": "first"}]),
    ("cores", "/resources", {"mpm_solver": {"cores": 0}}),
    ("an unknown phase", "/resources", {"mpm": {"cores": 1}}),
    ("samples of nothing", "/uncertainty", {"samples": 4, "parameters": []}),
    ("a ladder of nothing", "/accuracy", {"quantity": "runout", "ladders": []}),
    ("a check without reference", "/check", {"quantity": "runout"}),
]
overrides = [
    "/mpm/cfll=0.3",
    "mpm/cfl=0.3",
    "/mpm/cfl",
    "/mpm/cfl=2",
    '/mpm/cfl="fast"',
    "/mpm/cfl=",
    '/section/regions/7/material="base_soil"',
    "/section/regions/-1/name=1",
    "/mpm/runout/regions/-=7",
    "=0.3",
    "/=0.3",
    "/mpm/cfl=1e999",
    "/fem=null",
    "/mpm/runout/regions/0/x=1",
    "/materials/base_soil/density=-1",
    "/lem/search/entry=[3,2]",
    "/mpm/cell_size=0",
    "/mpm/runout/toe=[1,2,3]",
    "/mpm/~2=1",
    "/format=1",
]


def places(document, at=""):
    """(pointer, value) of every entry of a document."""
    for key, value in document.items() if isinstance(document, dict) else enumerate(document):
        yield f"{at}/{key}", value
        if isinstance(value, (dict, list)):
            yield from places(value, f"{at}/{key}")


def put(document, pointer, value):
    *path, last = pointer.strip("/").split("/")
    for key in path:
        document = document[int(key)] if isinstance(document, list) else document.setdefault(key, [] if last == "-" else {})
    if last == "-":
        document.append(value)
        return pointer[:-1] + str(len(document) - 1)
    document[int(last) if isinstance(document, list) else last] = value
    return pointer


def drop(document, pointer):
    *path, last = pointer.strip("/").split("/")
    for key in path:
        document = document[int(key)] if isinstance(document, list) else document[key]
    del document[last]


@st.composite
def slips(draw):
    study = copy.deepcopy(draw(studies.sweeps().filter(lambda each: "fem" in each["scene"])))
    kind = draw(st.sampled_from(["value", "value", "override", "type", "type", "unknown", "missing"]))
    if kind == "value":
        how, pointer, value = draw(st.sampled_from(values))
        return {"study": study, "slip": put(study, pointer, value), "how": how, "by_command": draw(st.integers(0, 7)) == 0}
    if kind == "override":
        text = draw(st.sampled_from(overrides))
        in_variant = "variants" in study and draw(st.booleans())
        pointer = "/variants/0/overrides" if in_variant else "/overrides"
        return {"study": study, "slip": put(study, pointer + "/-", text), "how": f"the override {text}"}
    if kind == "missing":
        pointer = draw(
            st.sampled_from(
                [
                    "/format",
                    "/name",
                    "/scene",
                    "/scene/format",
                    "/scene/materials",
                    "/scene/section",
                    "/scene/mpm/cell_size",
                    "/scene/mpm/domain_x",
                    "/scene/fem/stages",
                    "/scene/section/regions/0/material",
                    "/scene/mpm/floor/level",
                    "/scene/materials/base_soil/law/E_MPa",
                    "/scene/lem/search/exit",
                    "/scene/mpm/runout/toe",
                ]
            )
        )
        drop(study, pointer)
        return {"study": study, "slip": pointer, "how": "an entry is missing"}
    found = [
        each
        for each in places(study)
        if not each[0].endswith(free) and not each[0].startswith("/overrides") and "/overrides" not in each[0]
    ]
    if kind == "unknown":
        pointer = draw(st.sampled_from([where for where, value in found if isinstance(value, dict)] + [""])) + "/no_such_entry"
        return {"study": study, "slip": put(study, pointer, 1), "how": "an unknown entry"}
    pointer, value = draw(st.sampled_from(found))
    other = draw(st.sampled_from(wrong[type(value)]))
    return {"study": study, "slip": put(study, pointer, other), "how": f"{other!r} for {value!r}"[:80]}


requests = (
    [
        ("/v1/sweeps/{run}/extend", body)
        for body in (
            {},
            [],
            3,
            None,
            {"x": 1},
            {"transfer_times": []},
            {"transfer_times": [-1]},
            {"transfer_times": [50]},
            {"transfer_times": "0.5"},
            {"transfer_times": [1e308]},
            {"transfer_times": {"from": 0, "to": 2, "step": 1e-9}},
            {"transfer_times": {"from": 1, "to": 0.5, "step": 0.1}},
            {"samples": 3},
            {"samples": 0},
            {"transfer_times": [0.5], "samples": 3},
        )
    ]
    + [
        ("/v1/runs/{run}/triggers", body)
        for body in (
            {},
            [],
            None,
            {"kind": "sometimes"},
            {"kind": "criterion"},
            {"kind": "manual"},
            {"kind": "criterion", "when": "pore_joy > 1"},
            {"kind": "criterion", "when": "time >"},
            {"kind": "window", "lower": "time > 1"},
            {"kind": "at_time", "times": [50]},
            {"kind": "bisect", "seeds": 1},
            {"kind": "criterion", "when": "time > 1", "hold_s": -1},
            {"kind": "criterion", "when": "time > 1", "name": "A b"},
        )
    ]
    + [
        ("/v1/runs/{run}/priority", body)
        for body in ({}, {"priority": 101}, {"priority": "high"}, {"priority": 1.5}, {"priority": 2**70})
    ]
    + [("/v1/runs/{run}/title", body) for body in ({}, {"title": 3}, {"title": None}, [])]
    + [
        (f"/v1/runs/{{run}}/results?{query}", None)
        for query in ("format=xml", "limit=0", "limit=-1", "from=-1", "from=x", "state=happy", "table=all", "limit=1e3")
    ]
)


def is_about(fault, case):
    """Whether the fault's pointer is that of the error, one above or below it; for an override also the entry that it sets."""
    at, above = [case["slip"]], [case["slip"].rsplit("/", 1)[0]]
    if case["how"].startswith("the override /"):
        in_scene = "/scene" + case["how"].removeprefix("the override ").split("=")[0].removesuffix("/-")
        at.append(in_scene)
        above += [in_scene.rsplit("/", 1)[0]] * (in_scene.count("/") > 2)
    return fault in above or any(fault == slip or fault.startswith(slip + "/") for slip in at)
