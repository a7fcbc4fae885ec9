"""A run: its results, the frames of its tasks, and how it differs from another."""
from __future__ import annotations

import json
import os
import re
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from .faults import BreachlineError
from .frames import Frames
from .sources import Api, Document, Exported, Served, Source
from .table import Comparison, Table

_timed = re.compile(r"(?:particles|snapshot)_([0-9]+(?:\.[0-9]+)?)\.vtkhdf")


@dataclass(frozen=True)
class Task:
    id: str
    label: str  #: "mpm_0.500000"
    phase: str  #: the program: "mpm_solver"
    state: str  #: "succeeded"
    variant: str  #: of the study; empty: it has none
    transfer_time: float | None  #: [s]
    result: Document | None  #: what the phase says of itself
    files: list[str]  #: names of its artifacts


class Run:
    def __init__(self, source: Source) -> None:
        self._source = source
        about = source.run()
        self.id: str = about["id"]
        self.name: str = about["name"]
        self.state: str = about["state"]  #: as it was when this object was made
        self.verdict: str = about["verdict"]["words"]  #: "not usable"; the reasons are in `about["verdict"]`
        self.about: Document = about  #: everything the service says of the run

    def __repr__(self) -> str:
        return f"Run({self.id}, {self.name}, {self.state}: {self.verdict})"

    @cached_property
    def study(self) -> Document:
        """As it was submitted, completed with every default."""
        return self._source.study()

    @property
    def scene(self) -> Document:
        return dict(self.study["scene"])

    @cached_property
    def results(self) -> Table:
        """One row per transfer time and variant; `without_transfer` has the variants that are in no row."""
        return Table.of(self._source.results())

    @cached_property
    def motions(self) -> Document:
        """Of a study of several motions: which measures go with liquefaction and runout, onset, fragility."""
        return self._source.motions()

    @cached_property
    def _documents(self) -> list[Document]:
        return self._source.tasks()

    @property
    def tasks(self) -> list[Task]:
        return [Task(each["id"], each["label"], each["phase"], each["state"], each.get("variant") or "", each.get("transfer_time"),
                     each.get("result"), [artifact["name"] for artifact in each["artifacts"]]) for each in self._documents]

    def task(self, phase: str, transfer_time: float | None = None, variant: str | None = None) -> Task:
        """The first task of this phase with files, one that ended well before one that did not; of this transfer time [s] and
        variant when they are given."""
        of_phase = [each for each in self.tasks if each.phase == phase]
        fitting = [each for each in of_phase if each.files and (variant is None or each.variant == variant)
                   and (transfer_time is None
                        or (each.transfer_time is not None and abs(each.transfer_time - transfer_time) < 1e-6))]
        if fitting:
            return next((each for each in fitting if each.state in ("succeeded", "cached")), fitting[0])
        there = ", ".join(f"{each.label} ({each.state})" for each in of_phase) or "none"
        raise BreachlineError(f"run {self.id} has no such task of {phase} with files; it has: {there}")

    def file(self, task: Task, name: str) -> Path:
        """A file of the task on this machine; from a service it is fetched once, and its SHA-256 compared."""
        if name not in task.files:
            raise BreachlineError(f"{task.label} has no file {name}; it has " + ", ".join(task.files))
        return self._source.file(next(each for each in self._documents if each["id"] == task.id), name)

    def telemetry(self, task: Task) -> list[Document]:
        """The lines that the phase wrote as it went."""
        lines = self.file(task, "telemetry.jsonl").read_text(encoding="utf-8").splitlines()
        return [json.loads(line) for line in lines if line.strip()]

    def frames(self, transfer_time: float | None = None, variant: str | None = None, phase: str = "mpm_solver") -> Frames:
        """Of one task: the runout's, or with phase="fem_solver" the mesh's snapshots. transfer_time [s] and variant choose
        among several; otherwise it is that of `task`, and the frames say whose they are."""
        task = self.task(phase, transfer_time, variant)
        timed = sorted((float(found[1]), name) for name in task.files if (found := _timed.fullmatch(name)))
        if not timed:
            raise BreachlineError(f"{task.label} has no frames; it has " + ", ".join(task.files))
        return Frames([time for time, _ in timed], lambda k: self.file(task, timed[k][1]), f"{task.label} ({task.state})")

    def again(self) -> Run:
        """The run as it is now."""
        served = self._source.served()
        return Run(Served(served.api, self.id, served.cache))

    def wait(self, every: float = 1.0) -> Run:
        """The run as it ended; looked at every so many seconds."""
        api = self._source.served().api
        while api.json_at(f"/v1/runs/{self.id}?tasks=0")["finished"] is None:
            time.sleep(every)
        return self.again()

    def cancel(self) -> Run:
        """Stops what runs and skips the rest."""
        return self._order("cancel", {})

    def extend(self, *, transfer_times: Sequence[float] | None = None, samples: int | None = None,
               cpu_seconds: float | None = None) -> Run:
        """One of: more transfer times [s], so many samples in all, a larger budget. What was computed stays."""
        asked: Document = {"transfer_times": list(transfer_times) if transfer_times is not None else None, "samples": samples,
                           "budget": {"cpu_seconds": cpu_seconds} if cpu_seconds is not None else None}
        return self._order("extend", {key: value for key, value in asked.items() if value is not None}, "sweeps")

    def _order(self, word: str, body: Document, kind: str = "runs") -> Run:
        self._source.served().api.json_at(f"/v1/{kind}/{self.id}/{word}", body)
        return self.again()

    def report(self) -> str:
        """The report of a run of a service, as HTML that needs nothing else."""
        return self._source.served().api.bytes_at(f"/v1/runs/{self.id}/report").decode()

    def compare(self, other: Run) -> Comparison:
        """Row by row; differences are the other's value minus this run's."""
        return Comparison.of(self.results, other.results)


def run(name: str | os.PathLike[str] = "latest", server: str | None = None,
        token_file: str | os.PathLike[str] | None = None) -> Run:
    """name: a run's id or "latest", asked of a service; or the folder of an exported run. server and token_file: by
    default BREACH_SERVER and BREACH_TOKEN_FILE, else http://127.0.0.1:8470 without a token, as for the command line."""
    if isinstance(name, os.PathLike) or os.sep in name or Path(name).is_dir():
        return Run(Exported(Path(name)))
    api = Api(server, token_file)
    if name == "latest":
        newest = _listed(api, 1)
        if not newest:
            raise BreachlineError(f"{api.server}: there is no run yet; submit one by: breach submit STUDY.json")
        name = str(newest[0]["id"])
    return Run(Served(api, name))


def template(name: str, server: str | None = None, token_file: str | os.PathLike[str] | None = None, **options: Any) -> Document:
    """A study of a dam from a few numbers, with its scene: template("upstream_dam", height=20). `breach new NAME --help` lists the options."""
    return dict(Api(server, token_file).json_at(f"/v1/templates/{name}", options)["study"])


def submit(study: Document, server: str | None = None, token_file: str | os.PathLike[str] | None = None) -> Run:
    """study: a document with its scene inside, as `template` or `Run.study` gives it."""
    api = Api(server, token_file)
    return Run(Served(api, str(api.json_at("/v1/runs", study)["id"])))


def runs(server: str | None = None, token_file: str | os.PathLike[str] | None = None, most: int = 50) -> list[Document]:
    """What a service says of its newest runs, the newest first."""
    return _listed(Api(server, token_file), most)


def _listed(api: Api, most: int) -> list[dict[str, Any]]:
    return list(api.json_at(f"/v1/runs?limit={most}")["runs"])
