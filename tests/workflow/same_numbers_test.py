"""The whole chain of the quarter scene gives the same numbers on one thread and on two, and after kill -9 of every phase
and of the service: every number of every result, and the last line of every telemetry, to 1e-6."""
import json
import math
import os
import pathlib
import signal
import tempfile
import time

from phases import check, quarter, root
from service import Service

allowed = 1e-6
study = root / "workflows/studies/mochikoshi_quarter.json"
# Costs and paths differ between executions.
own = {"cpu_seconds", "wall_seconds", "seconds", "peak_memory_MB", "particle_steps_per_second", "provenance", "threads"}
settings = ["/section/element_size=3", "/fem/stages/2/duration=4.5", "/mpm/duration=15", "/mpm/checkpoint_interval=0.5",
            "/fem/snapshot_times=[2.5]"]  # a requested snapshot also writes a checkpoint


def prepared(threads):
    """The study with its phases on this many threads, without the cache."""
    document = json.loads(study.read_text())
    document["resources"] = {phase: {"cores": threads} for phase in ("fem_solver", "transfer_tool", "mpm_solver")}
    document["reuse"] = False
    document["transfer_times"] = [4, 4.5]
    document["triggers"] = []
    document["scene"] = str((study.parent / document["scene"]).resolve())
    return document


def numbers(value, at=""):
    """Every number in a JSON document, by its pointer."""
    if isinstance(value, dict):
        for key, each in value.items():
            if key not in own:
                yield from numbers(each, f"{at}/{key}")
    elif isinstance(value, list):
        for k, each in enumerate(value):
            yield from numbers(each, f"{at}/{k}")
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield at, float(value)


def found_in(service, run):
    found = {}
    for task in service.call(f"/v1/runs/{run}")["tasks"]:
        check(f"{task['label']} succeeded", task["state"] == "succeeded", task["fault"])
        found.update(numbers(task["result"], task["label"]))
    for phase, times in (("fem_solver", [None]), ("mpm_solver", [4, 4.5])):
        for t in times:
            at = "" if t is None else f"&transfer_time={t}"
            lines = service.call(f"/v1/runs/{run}/telemetry?phase={phase}{at}&from=0")["lines"]
            found.update(numbers(lines[-1], f"{phase} {t} telemetry of {len(lines)} lines"))
    return found


def largest_difference(a, b):
    check(f"the same {len(a)} numbers are there", a.keys() == b.keys(), a.keys() ^ b.keys())
    off = [(abs(a[key] - b[key]) / max(abs(a[key]), abs(b[key])), key)
           for key in a if a[key] != b[key] and not (math.isnan(a[key]) and math.isnan(b[key]))]
    return max(off, default=(0.0, "all bits agree"))


def compare(what, a, b):
    off, where = largest_difference(a, b)
    check(f"{what}: largest relative difference {off:.1e} ({where}), allowed {allowed:.0e}", off <= allowed)


def submit(service, folder, threads):
    file = folder / f"study_{threads}.json"
    file.write_text(json.dumps(prepared(threads)))
    return service.submit(file, *quarter, *settings)


def strike(service, phase, last_chance):
    """kill -9 of a phase after its first checkpoint, at the latest when it has written a certain file."""
    victim = service.wait_for_phase(phase)
    there = lambda name: any(service.data.glob(f"runs/*/{phase[:3]}*/output/{name}"))
    while not there("checkpoint.h5") and not there(last_chance):
        time.sleep(0.02)
    os.kill(victim, signal.SIGKILL)
    print(f"killed {phase}, {'with' if there('checkpoint.h5') else 'without'} a checkpoint")


def struck(folder):
    service = Service(folder / "struck", "--slots", "2")
    run = submit(service, folder, 1)
    strike(service, "fem_solver", "snapshot_4.000000.vtkhdf")  # its checkpoints are 20 s apart
    service.wait_for_phase("fem_solver")
    service.kill()
    print("killed the service")
    service = Service(folder / "struck", "--slots", "2")
    strike(service, "mpm_solver", "particles_10.000000.vtkhdf")
    service.finish(run)
    return service, run


def main(folder):
    found = {}
    for threads in (1, 2):
        service = Service(folder / f"calm_{threads}", "--slots", "2")
        run = submit(service, folder, threads)
        service.finish(run)
        found[threads] = found_in(service, run)
        service.stop()
    compare("one thread and two", found[1], found[2])
    service, run = struck(folder)
    after = found_in(service, run)
    attempts = sum(len(task["attempts"]) for task in service.call(f"/v1/runs/{run}")["tasks"])
    check("the kills are on record", attempts >= 3 + 5, attempts)  # three kills, five tasks besides the LEM
    service.stop()
    check("no phase is left running", not service.phases(""))
    compare("calm and after kill -9", found[1], after)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
