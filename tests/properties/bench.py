"""One service with fake phases for many studies: submit, disturb, wait."""
import itertools
import json
import os
import pathlib
import sys
import time
import urllib.error
import urllib.request

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "workflow"))
from service import Service  # noqa: E402

phases = ("lem_tool", "fem_solver", "transfer_tool", "mpm_solver")
going_on = ("queued", "running", "planning", "refining")


class Bench:
    def __init__(self, folder, slurm=False):
        self.folder, self.numbers = pathlib.Path(folder), itertools.count(1)
        (self.folder / "bin").mkdir(parents=True)
        for name in phases:
            (self.folder / "bin" / name).symlink_to(here / "phase")
        self.options = [
            "--bin",
            str(self.folder / "bin"),
            "--slots",
            "3",
            "--tries",
            "3",
            "--retry-delay",
            "0.01",
            "--grace",
            "0.3",
        ]
        if slurm:
            commands = self.folder / "commands"
            commands.mkdir()
            for name in ("sbatch", "squeue", "scancel"):
                (commands / name).symlink_to(here.parent / "slurm/fake" / name)
            os.environ |= {"PATH": f"{commands}:{os.environ['PATH']}", "FAKE_SLURM": str(self.folder / "slurm")}
            self.options += ["--executor", "slurm", "--slurm-poll", "0.2", "--slurm-grace", "2", "--slurm-command-limit", "20"]
        self.start()

    def start(self):
        self.service = Service(self.folder / "data", *self.options)

    def kill(self):
        """kill -9, then another service on the same data."""
        self.service.kill()
        self.start()

    def stop(self):
        self.service.stop()

    def post(self, path, body=None):
        return self.service.post(path, {} if body is None else body)

    def delete(self, path):
        return self.send(path, method="DELETE")[0]

    def send(self, path, body=None, method=None):
        """(status, answer); GET for a path with a query."""
        data = None if "?" in path or method else json.dumps(body).encode()
        request = urllib.request.Request(self.service.url + path, data, {"Content-Type": "application/json"}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                status, text = answer.status, answer.read()
        except urllib.error.HTTPError as refusal:
            status, text = refusal.code, refusal.read()
        try:
            return status, json.loads(text)
        except ValueError:
            return status, {"text": text.decode(errors="replace")}

    def submit(self, study):
        status, answer = self.post("/v1/runs", {**study, "name": f"s{next(self.numbers)}"})
        assert status == 202, f"submission: {status} {answer.get('detail')} {answer.get('faults')}"
        return answer["id"]

    def wait(self, run, seconds=300):
        """Waits until nothing of the run is active."""
        deadline, pause = time.monotonic() + seconds, 0.02
        while time.monotonic() < deadline:
            answer = self.service.call(f"/v1/runs/{run}")
            if answer["finished"] or answer["state"] not in going_on:
                return answer
            time.sleep(pause)
            pause = min(0.3, 1.3 * pause)
        raise AssertionError(
            f"run {run} is {answer['state']} after {seconds} s: "
            f"{[(task['label'], task['state'], task['message']) for task in answer['tasks']]}"
        )

    def content(self, path):
        with urllib.request.urlopen(self.service.url + path, timeout=60) as answer:
            return answer.read()

    def results(self, run):
        return self.service.call(f"/v1/runs/{run}/results")

    def newest(self):
        return [run["id"] for run in self.service.call("/v1/runs?limit=1")["runs"]]
