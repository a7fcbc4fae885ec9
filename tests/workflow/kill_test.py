"""kill -9 of a phase and of the service in the middle of a real sweep, then a restart: the same table, bit for bit."""
import json
import os
import pathlib
import signal
import subprocess
import tempfile
import time
import urllib.request

from phases import check, programs, root

study = json.loads((root / "workflows/studies/column_sweep.json").read_text())
study["scene"] = json.loads((root / "workflows/scenes/column.json").read_text())
study["scene"]["mpm"]["cell_size"] = 0.5  # long enough to be hit in the middle
study["scene"]["mpm"]["checkpoint_interval"] = 0.2


class Service:
    def __init__(self, data):
        self.data = data
        self.process = subprocess.Popen([str(programs / "breachline"), "serve", "--data", str(data), "--port", "0"],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.url = json.loads(self.process.stdout.readline())["url"]

    def call(self, path, body=None):
        request = urllib.request.Request(self.url + path, data=None if body is None else json.dumps(body).encode(),
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=30) as answer:
            return json.loads(answer.read())

    def phases(self, name):
        """Process ids of the running phases called `name` that work in our data folder."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words[0].endswith(name.encode()) and any(str(self.data).encode() in w for w in words):
                found.append(int(entry.name))
        return found

    def wait_for_phase(self, name):
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            if found := self.phases(name):
                return found[0]
            time.sleep(0.01)
        raise AssertionError(f"no {name} was started")

    def finish(self, run):
        while self.call(f"/v1/runs/{run}")["state"] in ("queued", "running"):
            time.sleep(0.2)
        return self.call(f"/v1/runs/{run}/results")["rows"]

    def kill(self, number):
        self.process.send_signal(number)
        self.process.wait(timeout=30)


def numbers(rows):
    return [(row["transfer_time"], row["state"], row["runout"], row["runout_largest"], row["volume_ratio"]) for row in rows]


def main(folder):
    service = Service(folder / "calm")
    expected = numbers(service.finish(service.call("/v1/runs", study)["id"]))
    service.kill(signal.SIGTERM)
    check("the undisturbed sweep succeeds", all(row[1] == "succeeded" for row in expected), expected)

    service = Service(folder / "struck")
    run = service.call("/v1/runs", study)["id"]
    os.kill(service.wait_for_phase("mpm_solver"), signal.SIGKILL)
    print("killed an mpm_solver")
    time.sleep(0.5)
    service.wait_for_phase("mpm_solver")
    service.kill(signal.SIGKILL)
    print("killed the service")
    service = Service(folder / "struck")
    os.kill(service.wait_for_phase("mpm_solver"), signal.SIGKILL)
    print("killed another mpm_solver")
    rows = service.finish(run)
    check("after kill -9 of phases and service the table is the same", numbers(rows) == expected, rows)
    tasks = service.call(f"/v1/runs/{run}")["tasks"]
    attempts = [attempt for task in tasks for attempt in task["attempts"]]
    for task in tasks:
        ended_well = [a for a in task["attempts"] if a["exit_code"] == 0]
        check(f"{task['label']} succeeded exactly once", len(ended_well) == 1, task["attempts"])
    check("the struck attempts are on record", len(attempts) > len(tasks), attempts)
    service.kill(signal.SIGTERM)
    check("no phase is left running", not service.phases("_solver"))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
