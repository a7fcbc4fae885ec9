"""A simulated service with the API's schemas: one run of three tasks, which advances with each request."""
import hashlib
import http.server
import json
import threading
import urllib.parse

run_id = "01JD0000000000000000000000"
log = "".join(f"line {i}\n" for i in range(1, 6)).encode()
message = "1 of 1 runouts still moving: lower bounds"
columns = [{"name": name, "kind": kind, "unit": unit, "title": name, "meaning": ""}
           for name, kind, unit in (("transfer_time", "number", "s"), ("state", "word", ""), ("runout", "number", "m"))]
artifact = b"\x89HDF pretend " * 1000
result = json.dumps({"runout": 12.5, "provenance": {"version": "0.1.0", "inputs": [
    {"path": "/somewhere/particles.vtkhdf", "sha256": hashlib.sha256(artifact).hexdigest()}]}}).encode()
blobs = {hashlib.sha256(each).hexdigest(): each for each in (artifact, result)}


def artifacts_of(*pairs):
    return [{"name": name, "sha256": hashlib.sha256(content).hexdigest(), "bytes": len(content)}
            for name, content in pairs]


class Service(http.server.ThreadingHTTPServer):
    """end: the state in which the run ends. token: what must be sent, if anything. lies: artifacts come altered."""
    daemon_threads = True

    def __init__(self, end="succeeded", token=None, lies=False, looks=3, restored=False):
        super().__init__(("127.0.0.1", 0), Handler)
        self.end, self.token, self.lies, self.looks_left = end, token, lies, looks
        self.posted, self.asked, self.removed = [], [], []
        self.files, self.uploads = {}, 0
        self.seq = 0
        self.restored = restored  # from a backup, after the first two events
        threading.Thread(target=lambda: self.serve_forever(0.05), daemon=True).start()

    @property
    def url(self):
        return f"http://127.0.0.1:{self.server_address[1]}"

    def tasks(self):
        over = self.looks_left <= 0
        mpm_state = ("succeeded" if self.end == "questionable" else self.end) if over else "running"
        fault = {"exit_code": 70, "summary": "the points\033[2J left the grid"} if mpm_state == "failed" else None
        common = {"run": run_id, "started": "2026-11-21T02:00:01Z", "finished": "2026-11-21T02:00:03Z", "message": ""}
        attempt = {"number": 1, "state": "exited" if over else "running", "started": "2026-11-21T02:00:01Z",
                   "finished": None, "exit_code": 0, "wall_seconds": 2.0, "cpu_seconds": 1.5}
        return [
            {**common, "id": f"{run_id}-00000", "phase": "fem_solver", "label": "fem_solver", "transfer_time": None,
             "state": "succeeded", "progress": 1, "result": {}, "fault": None, "attempts": [attempt],
             "artifacts": artifacts_of(("snapshots/snapshot_0.500000.vtkhdf", artifact))},
            {**common, "id": f"{run_id}-00001", "phase": "mpm_solver", "label": "mpm_0.500000", "transfer_time": 0.5,
             "state": mpm_state, "progress": 1 if over else 0.4, "result": {"runout": 12.5}, "fault": fault,
             "attempts": [attempt], "artifacts": artifacts_of(("result.json", result))},
            {**common, "id": f"{run_id}-00002", "phase": "lem_tool", "label": "lem_tool", "transfer_time": None,
             "state": "skipped", "progress": 1, "result": None, "fault": None, "attempts": [], "artifacts": []},
        ]

    def run(self):
        over = self.looks_left <= 0
        return {"id": run_id, "name": "fake", "title": "A run that is none", "state": self.end if over else "running",
                "created": "2026-11-21T02:00:00Z", "started": "2026-11-21T02:00:01Z",
                "finished": "2026-11-21T02:00:03Z" if over else None, "progress": 1.0 if over else 0.5,
                "tasks_total": 3, "tasks_done": 3 if over else 1,
                "tasks_failed": 1 if over and self.end == "failed" else 0,
                "questionable": 1 if over and self.end == "questionable" else 0,
                "headline": {"outcome": "not_known", "text": ""}, "warnings": [], "verdict": self.verdict(), "message": message if over and self.end == "questionable" else ""}

    def verdict(self):
        usable = "questionable" if self.looks_left <= 0 and self.end == "questionable" else "yes"
        return {"usable": usable, "words": usable, "reasons": []}


class Handler(http.server.BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"

    def log_message(self, *_):
        pass

    def answer(self, status, content, kind="application/json", **headers):
        body = content if isinstance(content, bytes) else json.dumps(content).encode()
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        for name, value in headers.items():
            self.send_header(name.replace("_", "-"), value)
        self.end_headers()
        self.wfile.write(body)

    def refuse(self, status, title, faults=()):
        self.answer(status, {"type": "/problems/x", "title": title, "status": status, "detail": "",
                             "faults": list(faults)}, "application/problem+json")

    def allowed(self):
        wanted = self.server.token
        if wanted is None or self.headers.get("Authorization") == f"Bearer {wanted}":
            return True
        self.refuse(401, "a token is needed")
        return False

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        if not self.allowed():
            return
        if self.path.startswith("/v1/files?"):
            return self.take_file(body)
        posted = json.loads(body)
        self.server.posted.append((self.path, posted, dict(self.headers)))
        if self.path == "/v1/runs":
            if posted.get("name") == "faulty":
                self.refuse(422, "the study has faults", [
                    {"pointer": "/scene/mpm/cell_size", "cause": "is negative", "remedy": "give a positive size"}])
            elif posted.get("name") == "shaken" and not posted["scene"]["fem"]["motion"]["file"].startswith("file:"):
                self.refuse(422, "the study has faults", [
                    {"pointer": "/scene/fem/motion/file", "cause": "does not exist", "remedy": "send it"}])
            elif posted.get("name") == "busy":
                self.refuse(503, "the disk is full")
            else:
                self.answer(202, self.server.run(), Location=f"/v1/runs/{run_id}")
        elif self.path == f"/v1/runs/{run_id}/cancel":
            self.server.end, self.server.looks_left = "cancelled", 0
            self.answer(202, self.server.run())
        elif self.path in [f"/v1/runs/{run_id}/{word}" for word in ("pause", "resume", "retry", "title", "priority")]:
            self.answer(202, self.server.run())
        elif self.path == "/v1/scenes/plan":
            self.answer(200, {"plans": {"mpm_solver": "pore pressure  left out: the scene is dry\n"}})
        else:
            self.refuse(404, "no such thing")

    def take_file(self, body):
        """The first upload is interrupted."""
        self.server.uploads += 1
        if self.server.uploads == 1:
            return self.refuse(503, "the disk refused")
        sha256 = hashlib.sha256(body).hexdigest()
        self.server.files[sha256] = f"file:sha256/{sha256}.csv"
        self.answer(201, {"reference": self.server.files[sha256], "about": "a motion"})

    def do_DELETE(self):
        self.server.removed.append(self.path)
        self.answer(202, {"id": run_id, "freed_bytes": 12.3e6})

    def do_HEAD(self):
        reference = self.server.files.get(self.path.split("/")[-1])
        self.send_response(200 if reference else 404)
        if reference:
            self.send_header("X-File-Reference", reference)
        self.send_header("Content-Length", "8")
        self.end_headers()

    def do_GET(self):
        if not self.allowed():
            return
        url = urllib.parse.urlsplit(self.path)
        query = dict(urllib.parse.parse_qsl(url.query))
        self.server.asked.append(self.path)
        parts = url.path.strip("/").split("/")[1:]
        server = self.server
        if parts == ["runs"]:
            self.answer(200, {"runs": [server.run()]})
        elif parts == ["storage"]:
            self.answer(200, {"runs": [{"id": run_id, "name": "fake", "freed_bytes": 12.3e6}]})
        elif parts == ["files"]:
            self.answer(200, {"files": []})
        elif parts == ["runs", run_id]:
            server.looks_left -= 1
            self.answer(200, {**server.run(), "study": {"name": "fake"}, "tasks": server.tasks()})
        elif parts == ["runs", run_id, "results"]:
            if query.get("format") == "csv":
                self.answer(200, b"transfer_time,runout\r\n0.5,12.5\r\n", "text/csv")
            else:
                self.answer(200, {"run": run_id, "verdict": server.verdict(), "columns": columns, "rows": [
                    {"transfer_time": 0.5, "state": "succeeded", "runout": 12.5, "questionable": False, "flags": []}]})
        elif parts == ["runs", run_id, "report"]:
            self.answer(200, b"<html>the report</html>", "text/html")
        elif parts == ["runs", run_id, "telemetry"]:
            begin = int(query["from"])
            lines = [{"time": 0.1 * i, "kinetic_energy": 2.0 * i} for i in range(begin, min(begin + 2, 5))]
            self.answer(200, {"lines": lines, "next": begin + len(lines)})
        elif parts == ["events"]:
            after, event = int(query["after"]), []
            reset = server.restored and after == 2
            if reset:
                server.restored, after = False, 0
            if after < 2 and not reset:  # another run's event first, to be ignored
                event = [{"seq": after + 1, "time": "", "run": run_id if after else "other", "task": None,
                          "kind": "task", "detail": {}}]
            self.answer(200, {"events": event, "next": after + len(event), "reset": reset})
        elif parts[:1] == ["tasks"] and len(parts) == 2:
            found = [each for each in server.tasks() if each["id"] == parts[1]]
            self.answer(200, found[0]) if found else self.refuse(404, "no such task")
        elif parts[:1] == ["tasks"] and parts[2:4] == ["attempts", "1"]:
            offset = int(query.get("offset", 0))
            piece = log[offset:offset + 10]  # a part at a time
            self.answer(200, piece, "text/plain", X_Next_Offset=str(offset + len(piece)))
        elif parts[:1] == ["artifacts"] and parts[1] in blobs:
            content = blobs[parts[1]]
            self.answer(200, content[:-1] + b"!" if server.lies else content, "application/octet-stream")
        else:
            self.refuse(404, "no such thing")
