"""kill -9 of a phase and of the service in the middle of a real sweep, then a restart: the same table, bit for bit."""
import json
import os
import pathlib
import signal
import tempfile
import time

from phases import check, root
from service import Service

study = json.loads((root / "workflows/studies/column_sweep.json").read_text())
study["scene"] = json.loads((root / "workflows/scenes/column.json").read_text())
study["scene"]["mpm"]["cell_size"] = 0.5  # long enough to be killed during it
study["scene"]["mpm"]["checkpoint_interval"] = 0.2


def numbers(rows):
    return [(row["transfer_time"], row["state"], row["runout"], row["runout_largest"], row["volume_ratio"]) for row in rows]


def main(folder):
    service = Service(folder / "calm")
    run = service.call("/v1/runs", study)["id"]
    service.finish(run)
    expected = numbers(service.rows(run))
    service.stop()
    check("the undisturbed sweep succeeds", all(row[1] in ("succeeded", "questionable") for row in expected), expected)

    service = Service(folder / "struck")
    run = service.call("/v1/runs", study)["id"]
    os.kill(service.wait_for_phase("mpm_solver"), signal.SIGKILL)
    print("killed an mpm_solver")
    time.sleep(0.5)
    service.wait_for_phase("mpm_solver")
    service.kill()
    print("killed the service")
    service = Service(folder / "struck")
    os.kill(service.wait_for_phase("mpm_solver"), signal.SIGKILL)
    print("killed another mpm_solver")
    service.finish(run)
    rows = service.rows(run)
    check("after kill -9 of phases and service the table is the same", numbers(rows) == expected, rows)
    tasks = service.call(f"/v1/runs/{run}")["tasks"]
    attempts = [attempt for task in tasks for attempt in task["attempts"]]
    for task in tasks:
        ended_well = [a for a in task["attempts"] if a["exit_code"] == 0]
        check(f"{task['label']} succeeded exactly once", len(ended_well) == 1, task["attempts"])
    check("the struck attempts are on record", len(attempts) > len(tasks), attempts)
    service.stop()
    check("no phase is left running", not service.phases("_solver"))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
