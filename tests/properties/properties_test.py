"""Random studies against an independent answer (answer.py), with phases that compute known functions (known.py).

    properties_test.py [--studies N] [--seed N] [--only PROPERTY] [--case FILE] [--slurm] [--table FILE]

The seed is printed first; the smallest failing case is written to a file that --case reads."""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import traceback

import hypothesis
from hypothesis import strategies as st

import answer
import pairs
import samples
import slips
import studies
import views
from bench import Bench
from journey import journey

here = pathlib.Path(__file__).resolve().parent


def moved_by(run):
    """Overrides of each variant that the service created, by name."""
    study = run["study"]
    return {each["name"]: each["overrides"] for each in study.get("variants", []) if each.get("made_by") == "draws"}


def comes_to_its_answer(bench, case):
    """After any events, the rows, means, state and verdict equal the answer."""
    extended = bool({"extend", "extend_at_once"} & set(case["disturbances"]))
    for study, run in journey(bench, case):
        end = bench.wait(run)
        found = answer.differences(answer.answer(study, moved_by(end)), end, bench.results(run), extended)
        found += reuse_differences(study, case["disturbances"], bench.results(run)["rows"])
        assert not found, f"run {run}: " + "; ".join(found[:12])


def reuse_differences(study, disturbances, rows):
    """Without the cache nothing is reused; with it everything that an equal run has computed."""
    is_new = "has_memory" in study["scene"].get("fem", {})
    warm = "warm" in disturbances and "remove" not in disturbances
    wanted = False if study.get("reuse") is False else True if warm and not is_new else None
    return (
        []
        if wanted is None
        else [
            f"row {row['variant'], row['transfer_time']}: reused is {row['reused']}"
            for row in rows
            if row["runout"] is not None and row["reused"] is not wanted
        ]
    )


def told(bench, case, differences):
    """The same for a study with its own answer: what `differences` finds for (study, run)."""
    for study, run in journey(bench, case):
        found = differences(study, bench.wait(run))
        assert not found, f"run {run}: " + "; ".join(found[:12])


def samples_say(bench, case):
    told(
        bench,
        case,
        lambda study, run: samples.uncertainty_differences(
            study, run, bench.service.call(f"/v1/runs/{run['id']}/uncertainty"), bench.results(run["id"])
        ),
    )


def ladders_say(bench, case):
    told(
        bench,
        case,
        lambda study, run: samples.accuracy_differences(study, run, bench.service.call(f"/v1/runs/{run['id']}/accuracy")),
    )


def a_target_is_found(bench, case):
    told(
        bench, case, lambda study, run: samples.inverse_differences(study, bench.service.call(f"/v1/runs/{run['id']}/uncertainty"))
    )


def a_plateau_is_found(bench, case):
    told(
        bench, case, lambda study, run: samples.bisect_differences(bench.service.call(f"/v1/runs/{run['id']}/triggers")["triggers"])
    )


def views_agree(bench, case):
    for _, run in journey(bench, case):
        bench.wait(run)
        found = views.differences(bench, run, bench.folder)
        assert not found, f"run {run}: " + "; ".join(found[:12])


def is_refused_everywhere(bench, case):
    """An invalid study is refused with its pointer by the API and by --dry-run, and nothing is stored."""
    before, where = bench.newest(), f"{case['how']} at {case['slip']}"
    (of_cost, cost), (of_runs, refusal) = (bench.post(path, case["study"]) for path in ("/v1/cost", "/v1/runs"))
    found = []
    if [of_cost, of_runs] != [422, 422]:
        found.append(f"{where}: cost {of_cost}, runs {of_runs}: {refusal.get('detail', '')} {refusal.get('faults', '')}")
    else:
        faults = [sorted((fault["pointer"], fault["cause"]) for fault in each["faults"]) for each in (cost, refusal)]
        if faults[0] != faults[1]:
            found.append(f"{where}: cost {faults[0]}, runs {faults[1]}")
        if not any(slips.is_about(pointer, case) for pointer, _ in faults[1]):
            found.append(f"{where}: {faults[1]}")
        found += [f"{where}: {cause}" for _, cause in faults[1] if "exception" in cause or re.search(r"\b(nan|inf)\b", cause)]
    if case.get("by_command"):
        file = bench.folder / "slip.json"
        file.write_text(json.dumps(case["study"]))
        done = subprocess.run(
            [views.programs / "breach", "--server", bench.service.url, "submit", file, "--dry-run"], capture_output=True, text=True
        )
        if done.returncode != 65:
            found.append(f"{where}: --dry-run ends with {done.returncode}: {done.stdout[:200]}{done.stderr[:200]}")
    if bench.newest() != before:
        found.append(f"{where}: the study is stored")
    assert not found, "; ".join(found)


def a_wrong_request_changes_nothing(bench, case):
    """Requests to an ended run: refused with 4xx and a problem's type."""
    if not hasattr(bench, "ended"):
        study = {"format": "breachline-study/1", "scene": studies.scene(), "transfer_times": [0.5]}
        bench.ended = bench.submit(study | {"reuse": False})  # from the cache it would have spent nothing
        bench.wait(bench.ended)
    path, body = case["request"]
    before = bench.service.call(f"/v1/runs/{bench.ended}")
    status, answer = bench.send(path.format(run=bench.ended), body)
    assert 400 <= status < 500 and str(answer.get("type", "")).startswith(
        "/problems/"
    ), f"{path} {body}: {status} {str(answer)[:300]}"
    after = bench.service.call(f"/v1/runs/{bench.ended}")
    assert after == before, f"{path} {body}: {[name for name in after if after[name] != before[name]]} changed"


properties = {
    "sweeps": (comes_to_its_answer, studies.cases),
    "triggers": (comes_to_its_answer, lambda: studies.cases(studies.triggered())),
    "samples": (samples_say, lambda: studies.cases(samples.uncertain())),
    "ladders": (ladders_say, lambda: studies.cases(samples.ladders())),
    "inverse": (a_target_is_found, lambda: studies.cases(samples.inverses())),
    "bisect": (a_plateau_is_found, lambda: studies.cases(samples.bisections())),
    "views": (views_agree, lambda: studies.cases(studies.triggered() | studies.sweeps())),
    "requests": (
        a_wrong_request_changes_nothing,
        lambda: st.builds(lambda request: {"request": list(request)}, st.sampled_from(slips.requests)),
    ),
    "slips": (is_refused_everywhere, slips.slips),
}


shares = {
    "sweeps": 0.22,
    "triggers": 0.2,
    "samples": 0.18,
    "ladders": 0.07,
    "inverse": 0.03,
    "bisect": 0.02,
    "views": 0.08,
    "slips": 0.17,
    "requests": 0.03,
}


def nothing(bench, case):
    pass


def count_of(name, studies):
    return max(1, round(shares[name] * studies))


def look_for_a_failure(name, bench, count, seed, shrink):
    """The smallest failing case, and its failure; None: none found. Without a bench the cases are only generated."""
    holds, strategy = properties[name]
    if bench is None:
        holds = nothing
    failed, runs = {}, []

    @hypothesis.seed(seed)
    @hypothesis.settings(
        max_examples=count,
        deadline=None,
        database=None,
        print_blob=False,
        report_multiple_bugs=False,
        phases=[hypothesis.Phase.generate] + [hypothesis.Phase.shrink] * shrink,
        suppress_health_check=list(hypothesis.HealthCheck),
    )
    @hypothesis.given(strategy())
    def search(case):
        runs.append(case)
        try:
            holds(bench, case)
        except Exception:
            failed["case"], failed["how"] = case, traceback.format_exc(limit=-2)  # the last one is the smallest
            raise

    try:
        search()
    except Exception:
        return failed or {"case": None, "how": traceback.format_exc()}, runs
    return None, runs


def holds_in(bench, file):
    """A stored case. "scene": "slope" in its study is studies.scene()."""
    kept = json.loads(file.read_text())
    study = kept["case"].get("study", {})
    if study.get("scene") == "slope":
        study["scene"] = studies.scene()
    try:
        properties[kept["property"]][0](bench, kept["case"])
    except Exception:
        print(f"{file}: {traceback.format_exc(limit=-2)}", flush=True)
        return False
    return True


def main():
    words = argparse.ArgumentParser()
    words.add_argument("--studies", type=int, default=112)
    words.add_argument("--seed", type=int, default=1)
    words.add_argument("--only", choices=properties)
    words.add_argument("--case", type=pathlib.Path)
    words.add_argument("--slurm", action="store_true", help="on the fake Slurm")
    words.add_argument("--table", type=pathlib.Path, help="write the pairs of features that were met")
    words.add_argument("--plan", action="store_true", help="make the cases and run none")
    words.add_argument("--as-found", action="store_true", help="do not look for a smaller failure")
    words = words.parse_args()
    print(f"seed {words.seed}", flush=True)
    status = 0
    with tempfile.TemporaryDirectory() as folder:
        bench = None if words.plan else Bench(pathlib.Path(folder) / "bench", words.slurm)
        try:
            if words.case:
                return 0 if holds_in(bench, words.case) else 1
            if bench and not words.only:
                status = 0 if all([holds_in(bench, each) for each in sorted((here / "cases").glob("*.json"))]) else 1
            cases = []
            for name in [words.only] if words.only else properties:
                began, cpu = time.monotonic(), sum(os.times()[:4])
                count = words.studies if words.only else count_of(name, words.studies)
                failed, runs = look_for_a_failure(name, bench, count, words.seed, not words.as_found)
                print(
                    f"{name}: {len(runs)} cases, {time.monotonic() - began:.1f} s, own CPU {sum(os.times()[:4]) - cpu:.1f} s",
                    flush=True,
                )
                cases += [each for each in runs if "disturbances" in each]
                if failed:
                    file = pathlib.Path(tempfile.gettempdir()) / f"failed_{name}_{words.seed}.json"
                    file.write_text(json.dumps({"property": name, "case": failed["case"]}, indent=1))
                    print(f"{failed['how']}\nagain: {sys.argv[0]} --case {file}", flush=True)
                    status = 1
            if words.table:
                words.table.write_text(
                    f"# Pairs of features that random studies have met\n\nBy `properties_test.py --studies {words.studies} --seed "
                    f"{words.seed}{' --plan' * words.plan} --table FILE`.\n\n{pairs.table(cases)}"
                )
        finally:
            if bench:
                bench.stop()
    return status


if __name__ == "__main__":
    sys.exit(main())
