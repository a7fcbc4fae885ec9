"""A run as files: the phases with their results, and what the service found."""
from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from breachline import plot
from breachline.faults import BreachlineError

from .document import Json
from .words import entry, number

lem, fem, post_seismic, transfer, mpm = "lem_tool", "fem_solver", "post_seismic", "transfer_tool", "mpm_solver"
order = [lem, fem, post_seismic, transfer, mpm]
same_time = 5e-7  #: [s]; names of files spell times to the microsecond, of figures with ten digits
_timed = re.compile(r"[a-z]+_([0-9.]+)\.vtkhdf")


def service_program() -> Path:
    """Beside this program."""
    return Path(sys.argv[0]).absolute().with_name("breachline")


def ask(question: str, place: Path, asked: Json = None) -> Json:
    """What the service's program says of a run, of a FEM's telemetry or of a scene."""
    done = subprocess.run([service_program(), question, place.absolute()], input=json.dumps(asked), capture_output=True, text=True)
    if done.returncode != 0:
        raise (BreachlineError if done.returncode == 65 else OSError)(done.stderr.removeprefix("breachline: ").rstrip())
    return json.loads(done.stdout)


def read_json(file: Path) -> Json:
    """None: there is no such file."""
    return plot.read_json(file) if file.is_file() else None


@dataclass(eq=False)
class Phase:
    """One task of the run, in any state."""

    program: str
    label: str  #: "mpm_13.000000_softened"
    variant: str  #: empty: serves all variants
    time: float | None  #: t_T [s]
    files: Path  #: folder of its outputs
    result: Json  #: None: it did not succeed
    fault: str  #: why there is no result; else empty
    task: str
    artifacts: list[str]  #: SHA-256 of its files
    scene_of_run: Json
    error: float | None = None  #: of one runout [m]
    error_from: str = ""  #: source of the error, or why there is none

    @cached_property
    def scene(self) -> Json:
        """Completed, with the overrides of this phase; the run's for a task that has not begun."""
        return read_json(self.files / "scene.completed.json") or self.scene_of_run

    @property
    def flags(self) -> list[Json]:
        return list(entry(self.result, "/flags", []))

    @property
    def runout(self) -> float:
        return float(self.result["runout"])

    @property
    def still_moves(self) -> bool:
        """Its distances are lower bounds."""
        return entry(self.result, "/at_rest") is False or any(each["code"] == "still_moving" for each in self.flags)

    @property
    def questionable(self) -> bool:
        return any(each["severity"] == "questionable" for each in self.flags)

    @property
    def where(self) -> str:
        """t_T = 13 s, softened."""
        parts = [f"t_T = {self.time:.6g} s"] if self.time is not None else []
        return ", ".join(parts + ([self.variant] if self.variant else [])) or self.label

    @property
    def file_word(self) -> str:
        """Its part of file names: "13s", "filled_soft"."""
        if self.time is not None:
            return f"{self.time:.10g}s"
        return f"filled_{self.variant}" if self.variant else "filled"

    @property
    def columns(self) -> list[str]:
        """Its first cells in a table: run, t_T and variant."""
        return [self.label, "-" if self.time is None else f"{self.time:.6g}", self.variant or "all"]

    def has(self, name: str) -> bool:
        return (self.files / name).is_file()

    @cached_property
    def telemetry(self) -> list[Json]:
        """Its valid lines; none for a phase that ended before the first."""
        lines: list[Json] = []
        if self.has("telemetry.jsonl"):
            for text in (self.files / "telemetry.jsonl").read_text(encoding="utf-8").splitlines():
                try:
                    line = json.loads(text)
                except ValueError:
                    continue  # the phase was stopped while it wrote
                if number(line, "/time") is not None and (not lines or line["time"] > lines[-1]["time"]):
                    lines.append(line)
        return lines

    def course(self, field_name: str, unit: float = 1.0) -> tuple[list[float], list[float]]:
        """A field of the telemetry against time; empty: no line has it."""
        lines = [line for line in self.telemetry if number(line, "/" + field_name) is not None]
        return [line["time"] for line in lines], [line[field_name] / unit for line in lines]

    def snapshots(self) -> list[tuple[float, Path]]:
        """Of the FEM, ascending in time [s]."""
        found = [(_timed.fullmatch(file.name), file) for file in self.files.glob("snapshot_*.vtkhdf")]
        return sorted((float(match[1]), file) for match, file in found if match)


@dataclass
class Run:
    folder: Path
    about: Json  #: run.json, or None
    study: Json  #: {}: the folder has none
    results: Json
    phases: list[Phase]  #: by phase, then transfer time, then variant
    scene: Json
    uncertainty: Json = None  #: of a study over distributions
    envelopes: Json = None
    motions: Json = None  #: of a study of several motions
    means: list[Json] = field(default_factory=list)  #: over repeats
    windows: dict[str, Json] = field(default_factory=dict)  #: edges by the label of the FEM, once they are known

    @property
    def name(self) -> str:
        return str(self.about.get("name") or self.scene["name"])

    @property
    def title(self) -> str:
        return str(self.about.get("title") or self.scene.get("title") or self.name)

    @property
    def without_transfer(self) -> list[Json]:
        return list(entry(self.results, "/without_transfer", []))

    def of(self, program: str) -> list[Phase]:
        return [each for each in self.phases if each.program == program]

    def first(self, program: str) -> Phase | None:
        return next((each for each in self.phases if each.program == program), None)

    @property
    def is_static(self) -> bool:
        """Points fill the section: no FEM. A runout with a transfer time came from a FEM, even if its folder is missing."""
        return not self.first(fem) and not any(each.program == transfer or each.time is not None for each in self.phases)

    @property
    def is_shaken(self) -> bool:
        return any(entry(each.scene, "/fem/motion") is not None for each in self.of(fem))

    @property
    def is_back_analysis(self) -> bool:
        """The samples are the steps of a search for one value, which have no distribution."""
        return entry(self.uncertainty, "/inverse") is not None

    def source_of(self, phase: Phase) -> Phase | None:
        """The phase that made this phase's input file; None: none of the run."""
        for given in entry(phase.result, "/provenance/inputs", []):
            folder = Path(given["path"]).parent
            label = folder.parent.name if folder.name == "output" else folder.name
            found = [each for each in self.phases if given["sha256"] in each.artifacts] \
                or [each for each in self.phases if each.label == label]
            if found:
                return found[0]
        return None

    def behind(self, phase: Phase | None, program: str) -> Phase | None:
        """The phase of this program that a runout came from; None: unknown."""
        while phase and phase.program != program:
            phase = self.source_of(phase)
        return phase

    def of_variant(self, program: str, variant: str) -> Phase | None:
        """The one with a variant's results: its own, the one shared by all, or the only one. Of phases shared by some: the one
        that its runouts or transfers came from, or the FEM without a transfer."""
        of_program = self.of(program)
        own = [each for each in of_program if each.variant in (variant, "")] or (of_program if len(of_program) == 1 else [])
        if own:
            return own[0]
        for later in self.of(mpm) + self.of(transfer):
            if later.variant == variant and (found := self.behind(later, program)):
                return found
        ended = [each.get("fem_task") for each in self.without_transfer if each["variant"] == variant] if program == fem else []
        return next((each for each in of_program if each.task and each.task in ended), None)

    def draws_of(self, mean: Json) -> list[Phase]:
        """The runouts averaged in this row of the means."""
        names = {each["name"] for each in self.study.get("variants", [])
                 if (each["name"].rsplit("_d", 1)[0] if each.get("made_by") == "draws" else each["name"]) == mean["variant"]}
        return [each for each in self.of(mpm) if each.variant in names and _is_at(each, mean["transfer_time"])]

    def runouts_of(self, variant: str) -> list[Phase]:
        """Those that ended, ascending in t_T."""
        return [each for each in self.of(mpm) if each.variant == variant and number(each.result, "/runout") is not None]

    @cached_property
    def variants(self) -> list[str]:
        """With a runout; in the study's order, or by name where the folder has no study."""
        listed = [each["name"] for each in self.study.get("variants", [])]
        names = dict.fromkeys(each.variant for each in self.of(mpm))
        return sorted(names, key=lambda name: listed.index(name) if name in listed else len(listed))

    def _of_task(self, key: str) -> Phase | None:
        task = entry(self.about, f"/{key}/task")
        return next((each for each in self.phases if task and each.task == task), None)

    @cached_property
    def farthest(self) -> Phase | None:
        """The governing runout; None: the run has none."""
        found = self._of_task("governing")
        return found if found and found.program == mpm else None

    @cached_property
    def least_factor(self) -> Phase | None:
        """The stability analysis with the least factor of safety."""
        return self._of_task("stability")

    def shown(self, program: str) -> Phase | None:
        """Of several phases the one shown in detail: behind the farthest runout, else the first."""
        return self._behind_farthest(program) or self.first(program)

    def _behind_farthest(self, program: str) -> Phase | None:
        far = self.farthest
        return (self.behind(far, program) or self.of_variant(program, far.variant)) if far else None

    def which_of_several(self, shown: Phase, plural: str) -> str:
        """Of 2 finite element analyses the one behind the farthest runout: loose; empty if there is only one."""
        count = len(self.of(shown.program))
        if count < 2:
            return ""
        which = "one behind the farthest runout" if self._behind_farthest(shown.program) else "first"
        return f"Of {count} {plural} the {which}: {shown.variant or shown.label}. "


def _is_at(runout: Phase, time: float | None) -> bool:
    if time is None or runout.time is None:
        return time is None and runout.time is None
    return abs(runout.time - time) <= same_time


def _fault_of(files: Path, task: Json) -> str:
    summary = entry(read_json(files / "fault.json"), "/summary") or entry(task, "/fault/summary")
    if summary:
        return str(summary)
    ended = task["state"] in ("cancelled", "failed", "skipped")
    return f"it was {task['state']}" if ended else f"it has not ended ({task['state']})"


def _tasks_of(folder: Path) -> list[tuple[Path, Json]]:
    return [(file.parent, read_json(file)) for file in sorted(folder.glob("tasks/*/task.json"))]


def read_run(folder: Path) -> Run:
    """folder: of `breach export`, of the service, or with one folder per phase, whose findings the service's program tells."""
    about, results = read_json(folder / "run.json"), read_json(folder / "results.json")
    tasks = _tasks_of(folder)
    if not about or not tasks:
        found = ask("findings", folder)
        about, results = found["run"], found["results"]
        tasks = [(folder / each["folder"], each) for each in found["tasks"]]
    for needed in ("verdict", "headline"):
        if needed not in about:
            raise BreachlineError(f"{folder}/run.json: has no {needed}; export the run again with this version")
    study = read_json(folder / "study.json") or {}
    scene = study.get("scene")
    if not isinstance(scene, dict):
        scene = next((found for files, _ in tasks if (found := read_json(files / "scene.completed.json"))), None)
    if scene is None:
        raise BreachlineError(f"{folder}: has no scene: neither in study.json nor in a task's folder; export the run again")
    phases = [_phase_of(files, task, scene) for files, task in tasks if not task.get("not_reached")]
    phases.sort(key=lambda each: (order.index(each.program), each.time or 0.0, each.variant, each.label))
    for row in entry(results, "/rows", []):
        for each in phases:
            if each.program == mpm and each.variant == row["variant"] and _is_at(each, row["transfer_time"]):
                each.error = row.get("runout_error")
                each.error_from = row.get("runout_error_from") or ""
    return Run(folder, about, study, results, phases, scene, read_json(folder / "uncertainty.json"),
               read_json(folder / "envelopes.json"), read_json(folder / "motions.json"), entry(results, "/means", []))


def _phase_of(files: Path, task: Json, scene: Json) -> Phase:
    result = read_json(files / "result.json")
    return Phase(task["phase"], task["label"], task.get("variant") or "", task.get("transfer_time") if task["phase"] in (transfer, mpm) else None,
                 files, result, "" if result else _fault_of(files, task), task["id"],
                 [each["sha256"] for each in task.get("artifacts", [])], scene)
