"""A run: its results, the frames of its tasks, and how it differs from another."""
from __future__ import annotations

import json
import os
import re
import time
import urllib.parse
import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from .faults import BreachlineError
from .frames import Frames
from .sources import Api, Document, Exported, Served, Source
from .table import Column, Comparison, Table

_timed = re.compile(r"(?:particles|snapshot)_([0-9]+(?:\.[0-9]+)?)\.vtkhdf")


@dataclass(frozen=True)
class Task:
    id: str
    label: str  #: "mpm_0.500000"
    phase: str  #: the program: "mpm_solver"
    state: str  #: "succeeded"
    variant: str  #: empty: the study has none
    transfer_time: float | None  #: [s]
    result: Document | None  #: result.json
    files: list[str]  #: names of its artifacts


class Run:
    def __init__(self, source: Source) -> None:
        self._source = source
        about = source.run()
        self.id: str = about["id"]
        self.name: str = about["name"]
        self.state: str = about["state"]  #: when this object was made
        self.headline: str = about["headline"]["text"]  #: "flows 10.4 m beyond the toe; FS 1.41 as built"; empty: no result yet
        self.verdict: str = about["verdict"]["words"]  #: "not usable"; the reasons are in `about["verdict"]`
        self.about: Document = about  #: the service's description of the run

    def __repr__(self) -> str:
        head = f"Run({self.id}, {self.name}, {self.state}: {'; '.join(filter(None, [self.headline, self.verdict]))})"
        return "\n  ".join([head, *self.reasons])

    @property
    def reasons(self) -> list[str]:
        """Why the verdict is not simply "usable", worst first; the warnings of the submission among them."""
        return [str(each["text"]) for each in self.about["verdict"]["reasons"]]

    @cached_property
    def study(self) -> Document:
        """The submitted study, completed with the defaults."""
        return self._source.study()

    @property
    def scene(self) -> Document:
        return dict(self.study["scene"])

    @cached_property
    def results(self) -> Table:
        """One row per transfer time and variant; `without_transfer` lists the variants without a row."""
        return Table.of(self._source.results())

    @cached_property
    def motions(self) -> Document:
        """Findings of a study of several motions: correlation of measures with liquefaction and runout, onset, fragility."""
        return self._source.motions()

    @cached_property
    def _documents(self) -> list[Document]:
        return self._source.tasks()

    @property
    def tasks(self) -> list[Task]:
        return [Task(each["id"], each["label"], each["phase"], each["state"], each.get("variant") or "", each.get("transfer_time"),
                     each.get("result"), [artifact["name"] for artifact in each["artifacts"]]) for each in self._documents]

    def task(self, phase: str, transfer_time: float | None = None, variant: str | None = None) -> Task:
        """The first task of this phase with files, of this transfer time [s] and variant if given; prefers successful tasks."""
        of_phase = [each for each in self.tasks if each.phase == phase]
        fitting = [each for each in of_phase if each.files and (variant is None or each.variant == variant)
                   and (transfer_time is None
                        or (each.transfer_time is not None and abs(each.transfer_time - transfer_time) < 1e-6))]
        if fitting:
            return next((each for each in fitting if each.state in ("succeeded", "cached")), fitting[0])
        there = ", ".join(f"{each.label} ({each.state})" for each in of_phase) or "none"
        raise BreachlineError(f"run {self.id} has no such task of {phase} with files; it has: {there}")

    def file(self, task: Task, name: str) -> Path:
        """Path of the task's file; a service's file is downloaded once, and its SHA-256 checked."""
        if name not in task.files:
            raise BreachlineError(f"{task.label} has no file {name}; it has " + ", ".join(task.files))
        return self._source.file(next(each for each in self._documents if each["id"] == task.id), name)

    def telemetry(self, task: Task) -> list[Document]:
        """The lines of the task's telemetry."""
        lines = self.file(task, "telemetry.jsonl").read_text(encoding="utf-8").splitlines()
        return [json.loads(line) for line in lines if line.strip()]

    def frames(self, transfer_time: float | None = None, variant: str | None = None, phase: str = "mpm_solver") -> Frames:
        """Frames of one task: of the runout, or with phase="fem_solver" of the mesh. transfer_time [s] and variant select the
        task as in `task`; `whose` names it."""
        task = self.task(phase, transfer_time, variant)
        timed = sorted((float(found[1]), name) for name in task.files if (found := _timed.fullmatch(name)))
        if not timed:
            raise BreachlineError(f"{task.label} has no frames; it has " + ", ".join(task.files))
        return Frames([time for time, _ in timed], lambda k: self.file(task, timed[k][1]), f"{task.label} ({task.state})")

    def again(self) -> Run:
        """The run with its present state."""
        served = self._source.served()
        return Run(Served(served.api, self.id, served.cache))

    def wait(self, every: float = 1.0) -> Run:
        """Waits for the run's end and returns the run. every: polling interval [s]."""
        api = self._source.served().api
        while api.json_at(f"/v1/runs/{self.id}?tasks=0")["finished"] is None:
            time.sleep(every)
        return self.again()

    def cancel(self) -> Run:
        """Stops the running tasks and skips the rest."""
        return self._order("cancel", {})

    def extend(self, *, transfer_times: Sequence[float] | None = None, samples: int | None = None) -> Run:
        """Adds transfer times [s], or extends to a total number of samples. Computed results stay."""
        asked: Document = {"transfer_times": list(transfer_times) if transfer_times is not None else None, "samples": samples}
        return self._order("extend", {key: value for key, value in asked.items() if value is not None}, "sweeps")

    def _order(self, word: str, body: Document, kind: str = "runs") -> Run:
        self._source.served().api.json_at(f"/v1/{kind}/{self.id}/{word}", body)
        return self.again()

    def report(self) -> str:
        """The report of a service's run, as self-contained HTML."""
        return self._source.served().api.bytes_at(f"/v1/runs/{self.id}/report").decode()

    def compare(self, other: Run) -> Comparison:
        """Compares row by row; differences are the other run's value minus this run's."""
        return Comparison.of(self.results, other.results)


def run(name: str | os.PathLike[str] = "latest", server: str | None = None,
        token_file: str | os.PathLike[str] | None = None) -> Run:
    """name: a run of a service as in the command line (its id, the beginning of it, its name, or "latest"), else the folder of an
    exported run; "./slope" is always a folder. server and token_file: default to BREACH_SERVER and BREACH_TOKEN_FILE, else
    http://127.0.0.1:8470 without a token, as in the command line."""
    if isinstance(name, os.PathLike) or os.sep in name:
        return Run(Exported(Path(name)))
    try:
        api = Api(server, token_file)
        return Run(Served(api, _id_of(api, name)))
    except BreachlineError:
        if not Path(name).is_dir():
            raise
        return Run(Exported(Path(name)))


def _id_of(api: Api, name: str) -> str:
    """The rules of the command line (run_named in services/cli/commands.cpp)."""
    if len(name) == 26:
        return name
    latest = name == "latest"
    found = _listed(api, limit=1 if latest else 500, search="" if latest else name)
    named = [str(each["id"]) for each in found if latest or each["name"] == name][:1]
    fitting = named or [str(each["id"]) for each in found if each["id"].startswith(name)]
    if len(fitting) == 1:
        return fitting[0]
    if fitting:
        raise BreachlineError(f'several ids begin with "{name}": ' + ", ".join(fitting))
    raise BreachlineError(f"{api.server}: there is no run yet; submit one by: breach submit STUDY.json" if latest
                          else f'{api.server}: no run has the name or id "{name}"; breachline.runs() shows the runs')


def template(name: str, server: str | None = None, token_file: str | os.PathLike[str] | None = None, **options: Any) -> Document:
    """A study of a dam from a few numbers, with its scene: template("upstream_dam", height=20). `breach new NAME --help` lists the options."""
    return dict(Api(server, token_file).json_at(f"/v1/templates/{name}", options)["study"])


def submit(study: Document, server: str | None = None, token_file: str | os.PathLike[str] | None = None) -> Run:
    """Submits a study. study: a document with its scene, such as from `template` or `Run.study`. Its warnings are also shown as
    Python's warnings, and stay in `Run.reasons`."""
    api = Api(server, token_file)
    answer = api.json_at("/v1/runs", study)
    for each in answer["warnings"]:
        warnings.warn(f"{each['pointer']}: {each['message']}", stacklevel=2)
    return Run(Served(api, str(answer["id"])))


def runs(server: str | None = None, token_file: str | os.PathLike[str] | None = None, most: int = 50) -> Table:
    """A service's newest runs, the newest first."""
    return Table([Column(name, "word", "", meaning) for name, meaning in _of_runs.items()],
                 [{**each, "verdict": each["verdict"]["words"], "headline": each["headline"]["text"]}
                  for each in _listed(Api(server, token_file), limit=most)])


_of_runs = {"id": "of the run", "name": "of its study", "title": "of its study, or as renamed", "created": "when it was submitted, UTC",
            "state": "of its tasks", "headline": "what happens; empty: no result yet", "verdict": "whether the results can be used"}


def _listed(api: Api, **asked: Any) -> list[dict[str, Any]]:
    return list(api.json_at("/v1/runs?" + urllib.parse.urlencode(asked))["runs"])
