"""Pairs of features that random cases have covered, as a table."""
import itertools
import re


def features(case):
    """Features of a case, by name."""
    study = case["study"]
    found = set(case.get("disturbances", []))
    found |= {key for key in ("variants", "draws", "priority", "known_failure", "accuracy") if study.get(key)}
    found |= {f"trigger: {each['kind']}" for each in study.get("triggers", [])}
    found |= {"hold" for each in study.get("triggers", []) if "hold_s" in each}
    found |= {"static"} if "fem" not in study["scene"] else set()
    found |= {"cache off"} if study.get("reuse") is False else set()
    found |= {"no stability analysis"} if study.get("stability") is False else set()
    found |= {"draws of the FEM"} if study.get("draws_of") == "fem" else set()
    found |= {"several times"} if len(study.get("transfer_times", [])) > 1 else set()
    uncertainty = study.get("uncertainty", {})
    found |= {uncertainty["sampling"]} if "sampling" in uncertainty else set()
    found |= {"back-analysis"} if "target" in uncertainty else set()
    found |= {"correlation"} if "correlation" in uncertainty else set()
    text = " ".join(
        study.get("overrides", []) + [each for variant in study.get("variants", []) for each in variant.get("overrides", [])]
    )
    for name, pattern in (
        ("append", "/-="),
        ("FEM entangles", "least_jacobian"),
        ("FEM ends well when tried again", "newmark_beta=0.45"),
        ("FEM breaks down", "largest_iterations"),
        ("MPM breaks down", "cfl=0.7"),
        ("MPM tries again", "cfl=0.6"),
        ("lower bound", "cfl=0.5"),
        ("LEM breaks down", "slices=13"),
        ("transfer breaks down", "neighbours=13"),
        ("questionable", "share=0.02"),
    ):
        found |= {name} if re.search(pattern, text) else set()
    return found


def table(cases):
    """Number of cases per pair, as Markdown: a triangle of counts, and the uncovered pairs."""
    counts, names = {}, sorted(set().union(*map(features, cases)) if cases else [])
    for case in cases:
        for pair in itertools.combinations(sorted(features(case)), 2):
            counts[pair] = counts.get(pair, 0) + 1
    lines = ["| | " + " | ".join(map(str, range(1, len(names)))) + " |", "|---" * len(names) + "|"]
    for k, name in enumerate(names[1:], 1):
        lines.append(
            f"| {k + 1} {name} | "
            + " | ".join(str(counts.get((other, name), "")) for other in names[:k])
            + " |"
            + " |" * (len(names) - 1 - k)
        )
    missed = [pair for pair in itertools.combinations(names, 2) if pair not in counts]
    return (
        "\n".join(
            [
                f"{len(cases)} cases, {len(counts)} of {len(names) * (len(names) - 1) // 2} pairs of {len(names)} features. "
                "Pairs that cannot be (a ladder and a distribution) are counted, too.\n",
                *lines,
                f"\n1 is {names[0] if names else ''}. Not met: " + "; ".join(f"{a} with {b}" for a, b in missed),
            ]
        )
        + "\n"
    )
