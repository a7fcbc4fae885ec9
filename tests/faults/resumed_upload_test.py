"""An interrupted upload continues where it stopped, also after a kill of the service, and only with the right bytes."""
import hashlib
import json
import os
import pathlib
import signal
import socket
import subprocess
import tempfile

from service import Service, programs, root, until


def upload_path(sha256, start):
    return f"/v1/files?name=record.csv&sha256={sha256}&from={start}"


def break_off(service, content, sha256, start, end):
    """Announces all bytes from `start` on, and sends them only up to `end`."""
    head = (f"POST {upload_path(sha256, start)} HTTP/1.1\r\nHost: 127.0.0.1:{service.port}\r\n"
            f"Content-Type: application/octet-stream\r\nContent-Length: {len(content) - start}\r\n\r\n")
    with service.connect(head.encode() + content[start:end]) as connection:
        connection.shutdown(socket.SHUT_WR)
        while connection.recv(4096):
            pass


def arrived(service, sha256):
    status, head, _ = service.ask(f"/v1/files/{sha256}", method="HEAD")
    assert status == 404, status
    return int(head.get("X-Arrived-Bytes", 0))


def send(service, content, sha256, start):
    status, _, answer = service.ask(upload_path(sha256, start), content[start:], method="POST", **{"Content-Type": "application/octet-stream"})
    return status, answer


def goes_on(folder):
    content = (root / "workflows/motions/synthetic_long.csv").read_bytes()
    sha256 = hashlib.sha256(content).hexdigest()
    third, half = len(content) // 3, len(content) // 2
    with Service(folder) as service:
        assert arrived(service, sha256) == 0
        break_off(service, content, sha256, 0, third)
        until(lambda: arrived(service, sha256) == third)
        status, answer = send(service, content, sha256, half)
        assert (status, answer["type"]) == (409, "/problems/other-part"), answer
        assert str(third) in answer["detail"], answer
        service.end(signal.SIGKILL)
    with Service(folder) as service:
        assert arrived(service, sha256) == third
        break_off(service, content, sha256, third, half)
        until(lambda: arrived(service, sha256) == half)
        # Foreign bytes in its place are found by the hash and removed.
        wrong = content[:half] + bytes(len(content) - half)
        status, answer = send(service, wrong, sha256, half)
        assert (status, answer["type"]) == (422, "/problems/hash-mismatch"), answer
        assert arrived(service, sha256) == 0
        break_off(service, content, sha256, 0, half)
        until(lambda: arrived(service, sha256) == half)
        assert send(service, content, sha256, half)[0] == 201
        assert service.ask(f"/v1/files/{sha256}")[2] == content
        assert not list((service.data / "arriving").iterdir())
        assert service.ask("/v1/files?name=a.csv&from=3", b"x", method="POST", **{"Content-Type": "application/octet-stream"})[0] == 400
        assert service.ask(upload_path("../" + sha256[3:], 0), b"x", method="POST", **{"Content-Type": "application/octet-stream"})[0] == 400
        commands_go_on(folder, service)
    checked = subprocess.run([programs / "breachline", "check", "--data", folder / "data"], capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def commands_go_on(folder, service):
    """`breach submit` queries what has arrived; if that is not the file's beginning, it sends all."""
    study = json.loads((root / "workflows/studies/mochikoshi_quarter.json").read_text())
    scene = root / "workflows/studies" / study["scene"]
    study["scene"] = json.loads(scene.read_text())
    for tampered, told in ((False, "had arrived before"), (True, "sent ")):
        content = (root / "workflows/motions/synthetic.csv").read_bytes() + (b"\n" if tampered else b"")
        motion = folder / f"{tampered}.csv"
        motion.write_bytes(content)
        study["scene"]["fem"]["motion"]["file"] = motion.name
        (folder / "study.json").write_text(json.dumps(study))
        sha256 = hashlib.sha256(content).hexdigest()
        break_off(service, content[::-1] if tampered else content, sha256, 0, 3000)
        until(lambda: arrived(service, sha256) == 3000)
        done = subprocess.run([programs / "breach", "submit", "study.json", "--send-files"], cwd=folder, text=True, capture_output=True,
                              env={**os.environ, "BREACH_SERVER": f"http://127.0.0.1:{service.port}"})
        assert done.returncode == 0, done.stderr
        assert told in done.stderr and ("3000 bytes" in done.stderr) != tampered, done.stderr
        assert service.ask(f"/v1/files/{sha256}")[2] == content


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="breach-upload-") as name:
        goes_on(pathlib.Path(name))
