"""Faults of the product that the properties have found and that are not mended yet. A difference that matches one is counted,
not failed. An entry goes with the commit that mends it."""
import re

known = [
    (
        "the verdict of a run whose FEMs all entangled before every transfer time is not 'no'",
        r"the verdict is \w+ for (no|questionable): .*Entangled",
    ),
    (
        "a dam that stood in some variants is a remark, against docs/reading_results.md",
        r"the verdict is with_remarks for questionable: .*The dam may stand",
    ),
    ("a mean over draws that still moved is not marked as a lower bound", r"^breach results does not mark the mean of"),
    ("the fault of an override that is no assignment points to /scene", r"^the override [^:]*: \[\('/scene', '--set"),
    ("the fault of an override whose place is no place tells the library's words", r"json\.exception"),
    ("a message has the number -inf", r"-inf m"),
    (
        "submission and --dry-run give different causes for a scene that is no object",
        r"cost \[\('/scene', 'is not the scene itself'\)\], runs",
    ),
]
seen = {}

# Removing an equal run takes the recipes with it that a trigger's transfers need: "FOREIGN KEY constraint failed" in every round of
# the dispatcher, so that nothing of any run is started any more, after a restart neither (store/removal.cpp). Such a case would
# stop the service of all others: the removal waits for the run's end. cases/removal_with_trigger.json does not wait.
removal_waits = True


def is_open(difference):
    for name, pattern in known:
        if re.search(pattern, difference):
            seen[name] = seen.get(name, 0) + 1
            return True
    return False


def unknown(differences):
    return [each for each in differences if not is_open(each)]
