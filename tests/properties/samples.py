"""Studies over distributions, ladders, back-analyses and bisections: random ones, and what each must say
(docs/reference/methods/statistics.md)."""
import copy
import math
import statistics

from hypothesis import strategies as st

import answer
import known
import studies
from stand_in import changed

normal = statistics.NormalDist()
z90 = normal.inv_cdf(0.95)
growing = ["runout", "runout_beyond_toe", "runout_largest", "area_beyond_toe"]

distributions = [
    {"type": "uniform", "from": 0.8, "to": 1.2},
    {"type": "log_uniform", "from": 0.5, "to": 1.5},
    {"type": "normal", "mean": 1, "sd": 0.1},
    {"type": "lognormal", "median": 1, "cov": 0.2},
    {"type": "triangular", "from": 0.7, "mode": 1.1, "to": 1.3},
]
choices = {
    "runout": [["/mpm/cfl=0.3"], ["/mpm/cfl=0.5"], ["/mpm/rest_body_share=0.02"], [], ["/lem/slices=31"]],
    "factor_of_safety": [["/lem/slices=31"], []],
}


def cumulative(distribution, value):
    get = distribution.get
    if get("type") == "uniform":
        return (value - get("from")) / (get("to") - get("from"))
    if get("type") == "log_uniform":
        return math.log(value / get("from")) / math.log(get("to") / get("from"))
    if get("type") == "normal":
        return normal.cdf((value - get("mean")) / get("sd"))
    if get("type") == "lognormal":
        return normal.cdf(math.log(value / get("median")) / math.sqrt(math.log(1 + get("cov") ** 2)))
    a, c, b = get("from"), get("mode"), get("to")
    return (value - a) ** 2 / ((b - a) * (c - a)) if value < c else 1 - (b - value) ** 2 / ((b - a) * (b - c))


def probability(parameter, value):
    """Probability of a smaller value, given the bounds."""
    low, high = (cumulative(parameter["distribution"], each) for each in parameter["between"]) if "between" in parameter else (0, 1)
    return (cumulative(parameter["distribution"], value) - low) / (high - low)


@st.composite
def uncertain(draw):
    quantity = draw(st.sampled_from(["factor_of_safety", "runout"]))
    of_lem = quantity == "factor_of_safety"
    study = {"format": "breachline-study/1", "name": "random", "scene": studies.scene(True, draw(st.integers(0, 9999)))}
    if not of_lem:
        study["transfer_times"] = [draw(st.sampled_from(studies.times))]
        study["overrides"] = draw(st.sampled_from([[], ["/fem/least_jacobian_ratio=0.012"], ['/mpm/runout/regions/-="base"']]))
    pointers = ["/materials/base_soil/density", "/lem/search/minimum_depth"] if of_lem else ["/mpm/damping_ratio"]
    study["scene"]["lem"]["search"]["minimum_depth"] = 1.0
    study["scene"]["mpm"]["damping_ratio"] = 0.2
    parameters = []
    for k, pointer in enumerate(pointers[: draw(st.integers(1, 2))]):
        parameters.append({"name": f"p{k}", "factor_on": [pointer], "distribution": draw(st.sampled_from(distributions))})
        if draw(st.booleans()):
            parameters[-1]["between"] = [0.85, 1.15]
    correlated = len(parameters) == 2 and draw(st.booleans())
    if draw(st.booleans()) or not of_lem:
        parameters.append({"name": "choice", "one_of": choices[quantity]})
    if not of_lem:  # the stability analysis of its own seldom: at times only when extended
        parameters[-1]["weights"] = [2, 2, 2, 2, 1]
    if not of_lem and draw(st.booleans()):
        parameters.append({"name": "lattice", "numerical": True, "draws": 2})
    by_trigger = not of_lem and draw(st.integers(0, 2)) == 0
    if by_trigger:  # depends on the sample
        del study["transfer_times"]
        study["triggers"] = [
            {
                "kind": "criterion",
                "name": "t",
                "snapshot_interval_s": known.step,
                "when": f"crest_displacement > {draw(st.sampled_from([0.5, 1.5, 3]))}",
            }
        ]
        parameters[0]["factor_on"] = ["/materials/base_soil/density"]
    block = 6 if correlated else draw(st.sampled_from([3, 4, 5]))  # fewer are refused
    count = block * draw(st.sampled_from([1] if by_trigger else [1, 2, 4] if of_lem else [1, 2, 2]))
    study["uncertainty"] = {
        "quantity": quantity,
        "samples": count,
        "first_block": block,
        "seed": draw(st.integers(1, 99)),
        "sampling": draw(st.sampled_from(["latin_hypercube", "sobol"])),
        "parameters": parameters,
    }
    if by_trigger and draw(st.booleans()):
        study["uncertainty"]["transfer"] = {"trigger": "t"}
    if correlated:
        study["uncertainty"]["correlation"] = [["p0", "p1", draw(st.sampled_from([-0.7, 0.5, 0.9]))]]
    if draw(st.integers(0, 3)) == 0:
        study["reuse"] = False
    return study


def drawn_wrong(study, variants):
    """Deviations of the samples from their design: each in its own slice, and each value set as sampled."""
    found, wanted = [], study["uncertainty"]
    if [each["name"] for each in variants] != [f"s{k + 1:04}" for k in range(wanted["samples"])]:
        found.append(f"samples are {[each['name'] for each in variants]}")
    sobol = wanted["sampling"] == "sobol"
    for parameter in wanted["parameters"]:
        if "distribution" not in parameter:
            continue
        places = [probability(parameter, each["sample"]["values"][parameter["name"]]) for each in variants]
        sizes = (
            [2**k for k in range(5)]
            if sobol and "correlation" not in wanted
            else [wanted["first_block"] * 2**k for k in range(3)] * (not sobol)
        )
        for size in sizes:
            if size <= len(places):
                inside = sorted(places[:size])
                if not all(k / size - 1e-4 <= u <= (k + 1) / size + 1e-4 for k, u in enumerate(inside)):
                    found.append(f"{parameter['name']}: of the first {size} samples not one is in each slice: {inside}")
        for each in variants:
            pointer = parameter["factor_on"][0]
            was = known.at(changed(copy.deepcopy(study["scene"]), study.get("overrides", [])), pointer, None)
            given = [text.split("=")[1] for text in each["overrides"] if text.startswith(pointer + "=")]
            if len(given) != 1 or not math.isclose(
                float(given[0]), was * each["sample"]["values"][parameter["name"]], rel_tol=2e-5
            ):
                found.append(f"{each['name']}: {pointer} is {given} for {was} times {each['sample']['values'][parameter['name']]}")
    return found


def wilson(share, n):
    middle, half = share + z90**2 / (2 * n), z90 * math.sqrt(share * (1 - share) / n + z90**2 / (4 * n * n))
    return [max(0.0, (middle - half) / (1 + z90**2 / n)), min(1.0, (middle + half) / (1 + z90**2 / n))]


def ranks(values):
    order = sorted(values)
    return [order.index(each) + (order.count(each) + 1) / 2 for each in values]


def percentile(values, p):
    """Type 7 of Hyndman and Fan."""
    order, place = sorted(values), (len(values) - 1) * p / 100
    below = math.floor(place)
    return order[below] + (place - below) * (order[min(below + 1, len(order) - 1)] - order[below])


def needed(p):
    share = max(p, 100 - p) / 100
    return math.ceil(math.log(0.05) / math.log(share))


def say(values, moving, parameters):
    """Expected statistics of one number. `values`: the known ones; `moving`: those of samples that still moved."""
    n = len(values)
    found = {
        "count": n,
        "mean": statistics.fmean(values),
        "sd": statistics.stdev(values) if n > 1 else None,
        "bound_from": min(moving) if moving else None,
        "percentiles": {p: percentile(values, p) for p in (5, 10, 50, 90, 95) if n >= needed(p)},
        "exceedance": {
            value: [sum(other > value for other in values) / n, *wilson(sum(other > value for other in values) / n, n)]
            for value in values
        },
    }
    if n >= 5 and len(set(values)) > 1:
        found["rank_correlation"] = {
            name: statistics.correlation(ranks(drawn), ranks(values)) for name, drawn in parameters.items() if len(set(drawn)) > 1
        }
    return found


def said(quantity):
    """The same from the service's answer."""
    told = quantity["percentiles"]
    found = {
        "count": quantity["count"],
        "mean": quantity["mean"],
        "sd": quantity["sd"],
        "bound_from": quantity["bound_from"],
        "percentiles": {each["p"]: each["value"] for each in told} if isinstance(told, list) else {},
        "exceedance": {each["value"]: [each["probability"], each["low"], each["high"]] for each in quantity["exceedance"]},
    }
    told = {each["parameter"]: each["rank_correlation"] for each in quantity["importance"] if each["rank_correlation"] is not None}
    return found | ({"rank_correlation": told} if told else {})


def near(wanted, got):
    if isinstance(wanted, dict):
        if not isinstance(got, dict) or len(wanted) != len(got):
            return False
        return all(
            near(float(a) if isinstance(a, (int, float)) else a, float(b) if isinstance(b, (int, float)) else b)
            and near(wanted[a], got[b])
            for a, b in zip(sorted(wanted), sorted(got))
        )
    if isinstance(wanted, list):
        return len(wanted) == len(got) and all(map(near, wanted, got))
    return not answer.differs(float(wanted) if isinstance(wanted, (int, float)) else wanted, got)


def uncertainty_differences(study, run, told, results):
    """Differences of GET /uncertainty and of the results' table from the samples' known results."""
    variants = [each for each in run["study"]["variants"] if each.get("made_by") == "uncertainty"]
    found, of_lem, rows = drawn_wrong(study, variants), study["uncertainty"]["quantity"] == "factor_of_safety", []
    for each in variants:
        scene = changed(copy.deepcopy(study["scene"]), study.get("overrides", []) + each["overrides"])
        time, met = (
            (None, False)
            if of_lem
            else (study["transfer_times"][0], False)
            if "triggers" not in study
            else answer.fired(study["triggers"][0], scene)
        )
        shift = scene.get("transfer", {}).get("point_shift", [0, 0])[0]
        nothing = {
            "factor_of_safety": known.lem(scene),
            **dict.fromkeys(growing),
            "no_transfer": not met and known.fem(scene)[1] == "complete",
        }
        row = nothing if of_lem or time is None else answer.row(study, scene, each["name"], time, shift)
        rows.append(row | {"values": each["sample"]["values"]})
    shown = {row["variant"]: row for row in results["rows"]}
    found += [
        f"{row['variant']}: {name} is {shown[row['variant']][name]} for {row[name]}"
        for row in rows
        if row.get("variant") in shown
        for name in [*growing, "state", "factor_of_safety"]
        if answer.differs(row[name], shown[row["variant"]][name])
    ]
    done = [row for row in rows if (row["factor_of_safety"] if of_lem else row["runout"]) is not None]
    moving = [row for row in done if row.get("lower_bound")]
    doubtful = [row for row in done if row.get("questionable") and not row["lower_bound"]]
    stood = sum(row.get("no_transfer", False) for row in rows) * (not of_lem)
    wanted = {
        "planned": len(rows),
        "done": len(done),
        "failed": len(rows) - len(done) - stood,
        "open": 0,
        "no_transfer": stood,
        "moving": len(moving),
        "doubtful": len(doubtful),
        "questionable": len(moving) + len(doubtful),
    }
    got = {name: told["samples"][name] for name in wanted}
    if got != wanted:
        found.append(f"samples are {got} for {wanted}")
    for name in ["factor_of_safety"] if of_lem else [*growing, "factor_of_safety"]:
        counted = [row for row in rows if row[name] is not None]
        if not counted:
            if name in told["quantities"]:
                found.append(f"{name} has statistics, and no sample has a result")
            continue
        drawn = {
            each["name"]: [row["values"][each["name"]] for row in counted]
            for each in study["uncertainty"]["parameters"]
            if "distribution" in each
        }
        asked = say([row[name] for row in counted], [row[name] for row in counted if name in growing and row["lower_bound"]], drawn)
        got = said(told["quantities"][name])
        found += [
            f"{name}: {what} is {got.get(what)} for {asked.get(what)}"
            for what in asked.keys() | got.keys()
            if not near(asked.get(what), got.get(what))
        ]
        if name == "factor_of_safety":
            share = sum(row[name] < 1 for row in counted) / len(counted)
            got = told["quantities"][name]["probability_of_failure"]
            if not near([share, *wilson(share, len(counted))], [got["value"], got["low"], got["high"]]):
                found.append(f"probability of failure {got} for {share} of {len(counted)}")
    return found


# Ladders, back-analyses, bisections --------------------------------------------------------------------------------------------


@st.composite
def ladders(draw):
    has_fem = draw(st.booleans())
    study = {"format": "breachline-study/1", "name": "random", "scene": studies.scene(has_fem, draw(st.integers(0, 9999)))}
    if has_fem:
        study["transfer_times"] = [draw(st.sampled_from(studies.times))]
    pointer, sizes = draw(
        st.sampled_from([("/mpm/cell_size", [4, 2, 1]), ("/mpm/cell_size", [2, 1, 0.5]), ("/mpm/damping_ratio", [0.4, 0.2, 0.1])])
    )
    quantity = draw(st.sampled_from(["runout", "runout_largest"]))
    study["accuracy"] = {
        "quantity": quantity,
        "draws": draw(st.sampled_from([1, 1, 2])),
        "ladders": [{"name": "fine", "steps": [[f"{pointer}={size}"] for size in sizes]}],
        "base": draw(st.sampled_from([[], ["/mpm/cfl=0.3"], ['/mpm/runout/regions/-="base"']])),
    }
    if draw(st.booleans()):
        study["accuracy"]["reference"] = draw(st.sampled_from(["richardson", {"value": 50.0, "source": "a test"}]))
    return study


def accuracy_differences(study, run, told):
    wanted, found, values = study["accuracy"], [], []
    steps = wanted["ladders"][0]["steps"]
    sizes = [float(step[0].split("=")[1]) for step in steps]
    moved = {each["name"]: each["overrides"] for each in run["study"]["variants"]}
    for row, step in zip(told["rows"], steps):
        runs = []
        for name in row["variants"]:
            scene = changed(copy.deepcopy(study["scene"]), moved[name])
            if any(text not in moved[name] for text in wanted["base"] + step) or len(row["variants"]) != wanted["draws"]:
                found.append(f"the rung {step} has {row['variants']}: {moved[name]}")
            time = study["transfer_times"][0] if "fem" in scene else None
            shift = scene["transfer"].get("point_shift", [0, 0])[0] if "fem" in scene else scene["mpm"].get("fill_shift", [0, 0])[0]
            runs.append(answer.row(study, scene, name, time, shift)[wanted["quantity"]])
        values.append(statistics.fmean(runs))
        asked = {
            "value": values[-1],
            "draws": len(runs),
            "standard_deviation": statistics.stdev(runs) if len(runs) > 1 else None,
            "size": sizes[len(values) - 1],
        }
        found += [
            f"rung {step}: {what} is {row[what]} for {value}" for what, value in asked.items() if answer.differs(value, row[what])
        ]
    if wanted["draws"] > 1:
        return found
    order = 2 if "cell_size" in steps[0][0] else 1
    limit = values[-1] - (values[-2] - values[-1]) / (2**order - 1)
    reference = wanted.get("reference", "finest")
    reference = values[-1] if reference == "finest" else limit if reference == "richardson" else reference["value"]
    ladder = told["ladders"][0]
    asked = {
        "course": "monotone",
        "order": float(order),
        "limit": limit,
        "gci": 1.25 * abs(values[-1] - limit) / abs(values[-1]),
        "reference": reference,
        "spread": max(values) - min(values),
    }
    found += [
        f"ladder: {what} is {ladder[what]} for {value}"
        for what, value in asked.items()
        if not (math.isclose(value, ladder[what] or 0, rel_tol=1e-6) if isinstance(value, float) else value == ladder[what])
    ]
    for row, value in zip(told["rows"], values):
        error = None if row["is_reference"] else abs(value - reference) / abs(reference)
        if (error is None) != (row["error"] is None) or error is not None and abs(error - abs(row["error"])) > 1e-6:
            found.append(f"rung {row['setting']}: error is {row['error']} for {error}")
    return found


@st.composite
def inverses(draw):
    """A damping ratio for a runout, which grows with it by 100 m."""
    study = {
        "format": "breachline-study/1",
        "name": "random",
        "scene": studies.scene(True, draw(st.integers(0, 9999))),
        "transfer_times": [draw(st.sampled_from(studies.times))],
        "overrides": draw(st.sampled_from([[], ["/mpm/cfl=0.3"], ["/mpm/cfl=0.5"]])),
    }
    sought = draw(st.floats(0.0, 0.5).map(lambda each: round(each, 3)))
    scene = changed(copy.deepcopy(study["scene"]), study["overrides"] + [f"/mpm/damping_ratio={sought}"])
    target = known.mpm(scene, study["transfer_times"][0], known.fem(scene)[0], known.transfer(scene), 0)["runout"]
    study["uncertainty"] = {
        "quantity": "runout",
        "samples": 16,
        "target": {"value": target, "vary": "d", "draws": 1, "tolerance": 0.1},
        "parameters": [
            {"name": "d", "sets": ["/mpm/damping_ratio"], "distribution": {"type": "uniform", "from": 0.05, "to": 0.45}}
        ],
    }
    return study | {"title": f"{sought}"}


def inverse_differences(study, told):
    sought, found = float(study["title"]), []
    told = told["inverse"]
    enclosed = 0.05 <= sought <= 0.45
    if enclosed != (told["value"] is not None):
        return [f"value is {told['value']} for {sought}: {told['reason']}"]
    if not enclosed:
        return found
    if abs(told["value"] - sought) > 0.1 * 0.4:
        found.append(f"value is {told['value']} for {sought} within {0.1 * 0.4}")
    bound = "at_most" if "/mpm/cfl=0.5" in study["overrides"] else None  # a lower bound of the runout: less of what makes it longer
    if told["bound"] != bound:
        found.append(f"bound is {told['bound']} for {bound}")
    return found


@st.composite
def bisections(draw):
    study = {
        "format": "breachline-study/1",
        "name": "random",
        "scene": studies.scene(True, draw(st.integers(0, 9999))),
        "overrides": draw(
            st.sampled_from(
                [[], ["/mpm/cfl=0.3"], ["/mpm/cfl=0.5"], ["/fem/least_jacobian_ratio=0.017"], ["/fem/largest_iterations=18"]]
            )
        ),
        "triggers": [
            {
                "kind": "bisect",
                "name": "t",
                "share": 0.9,
                "tolerance_s": 0.1,
                "from": draw(st.sampled_from([0.1, 0.2, 0.3])),
                "to": draw(st.sampled_from([1.6, 1.8, 1.9])),
                "seeds": draw(st.sampled_from([4, 5])),
            }
        ],
    }
    if draw(st.integers(0, 2)) == 0:
        study["variants"] = [{"name": "a", "overrides": ["/mpm/damping_ratio=0.2"]}]
    return study


def bisect_differences(triggers):
    got = triggers[0]["result"]
    edges = {"complete": True, "lower": {"off": 0.5, "on": 0.6}, "upper": {"off": 1.5, "on": 1.4}}
    return [
        f"{name} is {(got or {}).get(name)} for {value}: {triggers[0]['reason']}"
        for name, value in edges.items()
        if (got or {}).get(name) != value
    ]
