"""Events during a study. None may change its results."""
import copy
import time

from studies import reversed_variants, without_memory


def ok(answer, *statuses):
    assert answer[0] in (statuses or (200, 202)), answer
    return answer[1]


def journey(bench, case):
    """(study, run) of every run that must equal its study's answer."""
    study, on = case["study"], set(case["disturbances"])
    if without_memory in str(study):  # a FEM of its own: what an earlier case's retry has computed would be reused
        study = copy.deepcopy(study)
        study["scene"]["fem"]["force_tolerance"] = 1e-6 + 1e-12 * next(bench.numbers)
    if on & {"warm", "remove"}:
        earlier = bench.submit(study)
        bench.wait(earlier)
        if "remove" in on and "warm" not in on:
            assert bench.delete(f"/v1/runs/{earlier}") in (200, 202, 204)
    times = study.get("transfer_times", [])
    piecewise = len(times) > 1 and on & {"extend", "extend_at_once"}
    first = dict(study, transfer_times=times[::2]) if piecewise else study
    rest = {"transfer_times": times[1::2]}
    uncertainty = study.get("uncertainty", {})
    if on & {"extend", "extend_at_once"} and uncertainty.get("first_block", 99) < uncertainty.get("samples", 0):
        piecewise, rest = True, {"samples": uncertainty["samples"]}
        first = dict(study, uncertainty={**uncertainty, "samples": uncertainty["first_block"]})
    run = bench.submit(first)
    if "remove" in on and "warm" in on:  # while the next one takes its files
        assert bench.delete(f"/v1/runs/{earlier}") in (200, 202, 204)
    runs = [(study, run)]
    if "twin" in on:
        runs.append((reversed_variants(study), bench.submit(reversed_variants(study))))
    if "rename" in on:
        ok(bench.post(f"/v1/runs/{run}/title", {"title": "another name"}))
    if "pause" in on:
        ok(bench.post(f"/v1/runs/{run}/pause"))
    if on & {"pause", "cancel", "kill"}:
        time.sleep(case["after_ms"] / 1000)
    if "kill" in on:
        bench.kill()
    if "pause" in on:
        ok(bench.post(f"/v1/runs/{run}/resume"))
    if "cancel" in on:
        ok(bench.post(f"/v1/runs/{run}/cancel"))
        bench.wait(run)
        ok(bench.post(f"/v1/runs/{run}/retry"))
    if piecewise and "extend_at_once" not in on:
        bench.wait(run)
    if piecewise:
        ok(bench.post(f"/v1/sweeps/{run}/extend", rest))
    for _, each in runs:
        bench.wait(each)
    if "retry" in on:
        memory = bench.folder / "bin/memory"
        memory.touch()
        ok(bench.post(f"/v1/runs/{run}/retry"))
        bench.wait(run)
        memory.unlink()
        runs[0] = (with_memory(study), run)
    return runs


def with_memory(study):
    """What a retry makes of it, for the answer."""
    study = copy.deepcopy(study)
    if without_memory in str(study):
        study["scene"]["fem"]["has_memory"] = True
    return study
