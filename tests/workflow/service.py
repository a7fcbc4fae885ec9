"""The real service for a test, on a free port, with its data in a folder."""
import ctypes
import json
import pathlib
import signal
import subprocess
import time
import urllib.error
import urllib.request

from phases import programs


def end_with_parent():
    """A killed test leaves no service: TERM, so running phases save their checkpoints."""
    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGTERM)


class Service:
    def __init__(self, data, *options):
        self.data = data
        self.process = subprocess.Popen([str(programs / "breachline"), "serve", "--data", str(data), "--port", "0", *options],
                                        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                        preexec_fn=end_with_parent)
        self.url = json.loads(self.process.stdout.readline())["url"]

    def call(self, path, body=None):
        request = urllib.request.Request(self.url + path, data=None if body is None else json.dumps(body).encode(),
                                         headers={"Content-Type": "application/json"})
        with urllib.request.urlopen(request, timeout=60) as answer:
            return json.loads(answer.read())

    def text(self, path):
        with urllib.request.urlopen(self.url + path, timeout=60) as answer:
            return answer.read().decode()

    def post(self, path, body):
        """(status, answer), for any status; for a picture its text."""
        request = urllib.request.Request(self.url + path, data=json.dumps(body).encode(), headers={"Content-Type": "application/json"})
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                text = answer.read()
                return answer.status, json.loads(text) if "json" in answer.headers["Content-Type"] else text.decode()
        except urllib.error.HTTPError as refusal:
            return refusal.code, json.loads(refusal.read())

    def breach(self, *words):
        done = subprocess.run([programs / "breach", "--server", self.url, *map(str, words)], capture_output=True, text=True)
        assert done.returncode == 0, f"breach {words}: {done.stdout}{done.stderr}"
        return done.stdout.strip()

    def submit(self, study, *overrides):
        """The run's id."""
        return self.breach("submit", study, *[word for each in overrides for word in ("--set", each)])

    def finish(self, run, seen=lambda answer: None, every=0.5):
        """The run at its end; `seen` gets every answer in between."""
        while True:
            answer = self.call(f"/v1/runs/{run}")
            seen(answer)
            if answer["finished"]:
                return answer
            time.sleep(every)

    def phases(self, name):
        """Process ids of the running phases with this name in our data folder."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if words[0].endswith(name.encode()) and any(f"{self.data}/runs/".encode() in w for w in words[1:]):
                found.append(int(entry.name))
        return found

    def wait_for_phase(self, name):
        deadline = time.monotonic() + 300
        while time.monotonic() < deadline:
            if found := self.phases(name):
                return found[0]
            time.sleep(0.01)
        raise AssertionError(f"no {name} was started")

    def rows(self, run):
        return self.call(f"/v1/runs/{run}/results")["rows"]

    def kill(self):
        self.process.send_signal(signal.SIGKILL)
        self.process.wait(timeout=30)

    def stop(self):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(timeout=60)
