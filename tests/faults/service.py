"""A `breachline serve` on loopback with the fake phases, for tests in Python."""
import json
import os
import pathlib
import signal
import socket
import subprocess
import time
import urllib.error
import urllib.request

root = pathlib.Path(os.environ["BREACH_ROOT"])
programs = pathlib.Path(os.environ["BREACH_BIN"])


def study(times=(0.5,), title="", **more):
    scene = json.loads((root / "workflows/scenes/slope.json").read_text())
    scene["title"] = title
    return {"format": "breachline-study/1", "name": "fault", "scene": scene, "transfer_times": list(times), "reuse": False,
            **more}


def fake_phases(folder):
    """A folder with the four programs."""
    bin = pathlib.Path(folder) / "bin"
    bin.mkdir(exist_ok=True)
    for name in ("lem_tool", "fem_solver", "transfer_tool", "mpm_solver"):
        if not (bin / name).exists():
            (bin / name).symlink_to(programs / "fake_phase")
    return bin


def refusal_to_start(folder, *arguments):
    """(exit code, standard error) of a service that cannot start."""
    done = subprocess.run([programs / "breachline", "serve", "--data", pathlib.Path(folder) / "none", "--port", "0", "--bin",
                           fake_phases(folder), *arguments], text=True, capture_output=True, stdin=subprocess.DEVNULL, timeout=30)
    return done.returncode, done.stderr


class Service:
    def __init__(self, folder, *arguments):
        folder = pathlib.Path(folder)
        fake_phases(folder)
        self.data = folder / "data"
        self.process = subprocess.Popen(
            [programs / "breachline", "serve", "--data", self.data, "--bin", folder / "bin", "--port", "0", "--grace", "0.3",
             "--retry-delay", "0.05", *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.port = json.loads(self.process.stdout.readline())["port"]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.end(signal.SIGTERM)

    def end(self, how):
        self.process.send_signal(how)
        self.process.wait(30)
        self.process.stdout.close()

    def ask(self, path, body=None, timeout=30, method=None, **headers):
        """(status, headers, body: parsed if JSON)"""
        data = None if body is None else body if isinstance(body, bytes) else json.dumps(body).encode()
        request = urllib.request.Request(f"http://127.0.0.1:{self.port}{path}", data,
                                         {"Content-Type": "application/json", **headers}, method=method)
        try:
            with urllib.request.urlopen(request, timeout=timeout) as answer:
                status, head, text = answer.status, answer.headers, answer.read()
        except urllib.error.HTTPError as error:
            status, head, text = error.code, error.headers, error.read()
        return status, head, json.loads(text) if text and "json" in head.get("Content-Type", "") else text

    def submit(self, wanted):
        status, _, body = self.ask("/v1/runs", wanted)
        assert status == 202, (status, body)
        return body["id"]

    def wait_for_end(self, run, seconds=60):
        return until(lambda: (body := self.ask(f"/v1/runs/{run}")[2])["finished"] and body, seconds)

    def connect(self, text=b""):
        connection = socket.create_connection(("127.0.0.1", self.port), timeout=20)
        connection.sendall(text)
        return connection

    def raw(self, text):
        """Status of the answer to these bytes; 0: the connection was closed without answer."""
        with self.connect(text) as connection:
            answer = b""
            while b"\r\n" not in answer and (part := connection.recv(4096)):
                answer += part
        return int(answer[9:12]) if answer else 0


def until(question, seconds=30):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if answer := question():
            return answer
        time.sleep(0.05)
    raise AssertionError(f"not within {seconds} s")
