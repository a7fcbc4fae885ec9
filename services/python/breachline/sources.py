"""Sources of a run's documents and files: a service's API, or the folder of `breach export`."""
from __future__ import annotations

import hashlib
import json
import os
import ssl
import tempfile
import urllib.error
import urllib.parse
import urllib.request
from pathlib import Path
from typing import Any, Protocol

from .faults import BreachlineError, Unreachable

Document = dict[str, Any]


class Source(Protocol):
    """A run in one source."""

    def run(self) -> Document: ...

    def study(self) -> Document: ...

    def results(self) -> Document: ...

    def motions(self) -> Document: ...

    def tasks(self) -> list[Document]: ...

    def file(self, task: Document, name: str) -> Path:
        """Path of a local file with the bytes of the task's artifact."""

    def served(self) -> Served:
        """The same run on a service, which accepts orders."""


class Exported:
    """The folder of an exported run."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        if not (folder / "run.json").is_file():
            raise BreachlineError(f"{folder}: has no run.json, so it is no exported run; make one by: breach export RUN {folder}")

    def _read(self, name: str) -> Any:
        try:
            return json.loads((self.folder / name).read_text(encoding="utf-8"))
        except (OSError, ValueError) as cause:
            raise BreachlineError(f"{self.folder / name}: {cause}; repeat the export, which completes it") from cause

    def run(self) -> Document:
        return dict(self._read("run.json"))

    def study(self) -> Document:
        return dict(self._read("study.json"))

    def results(self) -> Document:
        return dict(self._read("results.json"))

    def motions(self) -> Document:
        return dict(self._read("motions.json"))

    def tasks(self) -> list[Document]:
        found = [self._read(f"tasks/{each.parent.name}/task.json") for each in self.folder.glob("tasks/*/task.json")]
        return sorted(found, key=lambda task: str(task["id"]))  # the study's order

    def file(self, task: Document, name: str) -> Path:
        path = self.folder / "tasks" / str(task["label"]) / name
        if not path.is_file():
            raise BreachlineError(f"{path}: missing; repeat the export, which completes it")
        return path

    def served(self) -> Served:
        raise BreachlineError(f"{self.folder}: an exported run takes no orders; ask the service: breachline.run(ID)")


class Api:
    """A service's API. server, token_file: as the command line takes them, from BREACH_SERVER and BREACH_TOKEN_FILE
    when not given. The certificate of an https service must be of an authority in BREACH_TLS_CA (a PEM file), else of
    one that the system trusts, for that name and of today."""

    def __init__(self, server: str | None = None, token_file: str | os.PathLike[str] | None = None) -> None:
        self.server = (server or os.environ.get("BREACH_SERVER") or "http://127.0.0.1:8470").rstrip("/")
        if urllib.parse.urlsplit(self.server).scheme not in ("http", "https"):
            raise BreachlineError(f"{self.server}: no http or https address; give one as http://127.0.0.1:8470")
        file = token_file or os.environ.get("BREACH_TOKEN_FILE")
        self.token = _token_in(Path(file)) if file else None
        self._trust = _trust_in(os.environ.get("BREACH_TLS_CA")) if self.server.startswith("https:") else None

    def bytes_at(self, path: str, body: Document | None = None) -> bytes:
        """body: posted as JSON; None: a GET request."""
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request(self.server + path, data, {"Content-Type": "application/json"} if data else {})
        if self.token:
            request.add_header("Authorization", f"Bearer {self.token}")
        try:
            with urllib.request.urlopen(request, timeout=60, context=self._trust) as answer:
                return bytes(answer.read())
        except urllib.error.HTTPError as refusal:
            raise BreachlineError(f"{self.server}{path}: {_problem(refusal)}") from refusal
        except OSError as cause:  # includes urllib.error.URLError
            reason = getattr(cause, "reason", cause)
            if isinstance(reason, ssl.SSLCertVerificationError):
                raise BreachlineError(f"{self.server}: its certificate is not to be trusted: {reason.verify_message}; if its "
                                      "authority is yours, BREACH_TLS_CA names the file with it") from cause
            raise Unreachable(f"{self.server}: does not answer ({cause}); is the service running, is BREACH_SERVER right?") from cause

    def json_at(self, path: str, body: Document | None = None) -> Any:
        try:
            return json.loads(self.bytes_at(path, body))
        except ValueError as cause:
            raise BreachlineError(f"{self.server}{path}: no JSON; is this a Breachline service?") from cause


class Served:
    """A run of a service. Artifacts are stored below `cache` by their SHA-256, which is checked."""

    def __init__(self, api: Api, run: str, cache: Path | None = None) -> None:
        self.api = api
        self.path = "/v1/runs/" + urllib.parse.quote(run, safe="")
        self.detail = dict(api.json_at(self.path))  # with its study and tasks
        home = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
        self.cache = cache or Path(home) / "breachline"

    def run(self) -> Document:
        return {key: value for key, value in self.detail.items() if key not in ("tasks", "study")}

    def study(self) -> Document:
        return dict(self.detail["study"])

    def results(self) -> Document:
        return dict(self.api.json_at(self.path + "/results"))

    def motions(self) -> Document:
        return dict(self.api.json_at(self.path + "/motions"))

    def tasks(self) -> list[Document]:
        return list(self.detail["tasks"])

    def served(self) -> Served:
        return self

    def file(self, task: Document, name: str) -> Path:
        artifact = next(each for each in task["artifacts"] if each["name"] == name)
        promised = str(artifact["sha256"])
        path = self.cache / promised
        if path.is_file() and hashlib.sha256(path.read_bytes()).hexdigest() == promised:
            return path
        content = self.api.bytes_at("/v1/artifacts/" + promised)
        if hashlib.sha256(content).hexdigest() != promised:
            raise BreachlineError(f"{name}: its SHA-256 is not {promised} as the service promised; ask again")
        self.cache.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=self.cache, delete=False) as partial:
            partial.write(content)
        os.replace(partial.name, path)
        return path


def _trust_in(authority: str | None) -> ssl.SSLContext:
    try:
        return ssl.create_default_context(cafile=authority or None)
    except OSError as cause:  # includes ssl.SSLError
        raise BreachlineError(f"{authority}: holds no certificate that can be read: {cause}; BREACH_TLS_CA names a PEM "
                              "file of the authority's") from cause


def _token_in(file: Path) -> str:
    try:
        words = file.read_text(encoding="utf-8").split()
    except OSError as cause:
        raise BreachlineError(f"{file}: cannot be read: {cause}; BREACH_TOKEN_FILE names the file with the token") from cause
    if not words:
        raise BreachlineError(f"{file}: holds no token")
    return words[0]


def _problem(refusal: urllib.error.HTTPError) -> str:
    try:
        problem = json.loads(refusal.read())
        faults = "".join(f"\n  {each['pointer'] or '/'}: {each['cause']}; {each['remedy']}" for each in problem.get("faults", []))
        return f"{refusal.code} {problem.get('title', '')}: {problem.get('detail', '')}{faults}"
    except ValueError:
        return f"{refusal.code} {refusal.reason}"
