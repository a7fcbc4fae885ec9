"""The run's values of a paper's quantities, the window of transfer times, and the plateau of runouts."""
from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from statistics import median

from breachline.plot import Mark

from .document import Json, Table
from .ended import entangled_at
from .paper import Paper
from .run import Phase, Run, ask, fem, lem
from .words import at_least, entry, number, rounded

_runs_out = 1.0  # [m]: smaller runouts count as none
_plateau_share = 0.75  # of the largest runout


@dataclass
class Measure:
    """One number and its origin."""

    value: float
    source: str
    cpu: float  #: [s] of its runs
    error: str = ""
    lower_bound: bool = False
    least: float = 0.0  #: of its runs
    most: float = 0.0


@dataclass
class Window:
    """Edges of the transfer window [s]; None: the telemetry never meets it."""

    lower: float | None = None
    upper: float | None = None

    @property
    def is_none(self) -> bool:
        """The mesh was too distorted before the failure developed."""
        return self.lower is not None and self.upper is not None and self.upper <= self.lower

    def marks(self) -> list[Mark]:
        words = ("failure developed", "mesh too distorted") if self.is_none else ("window opens", "window closes")
        return [Mark("x", edge, word) for edge, word in zip((self.lower, self.upper), words) if edge is not None]


@dataclass
class Plateau:
    """The transfer times around the largest runout whose runouts are at least three quarters of it."""

    first: float
    last: float
    runouts: list[Phase]


def _window_spec(run: Run) -> Json:
    asked = [each for each in run.study.get("triggers", []) if each.get("kind") == "window"]
    return asked[0] if asked else entry(run.scene, "/transfer/window")


def _conditions(run: Run) -> list[str]:
    for specs in (run.study.get("triggers", []), [entry(run.scene, "/transfer/window", {})]):
        found = [each[key] for each in specs for key in ("when", "lower", "upper") if key in each]
        if found:
            return found
    return []


def conditions_of(run: Run, phase: Phase, paper: Paper | None = None) -> Json:
    """{"window", "first", "thresholds"}: what the service's program finds in the FEM's telemetry."""
    stability = run.of_variant(lem, phase.variant)
    depth = number(stability.result, "/critical_depth") if stability else None
    return ask("conditions", phase.files / "telemetry.jsonl",
               {"constants": {} if depth is None else {"critical_depth": depth}, "window": _window_spec(run), "thresholds": _conditions(run),
                "first": [each["first_time"] for each in (paper.values if paper else []) if "first_time" in each]})


def window_of(run: Run, phase: Phase) -> Window:
    """Asked once of a FEM that variants share."""
    if phase.label not in run.windows:
        run.windows[phase.label] = conditions_of(run, phase).get("window", {})
    return Window(**run.windows[phase.label])


class Measures(dict[str, Measure]):
    """By the keys of paper.json; with a variant the key ends in ":<variant>". What the run lacks is missing."""

    def __init__(self, run: Run, paper: Paper | None) -> None:
        super().__init__()
        self.run, self.paper = run, paper
        self._stability()
        self._shaking()
        if not run.is_static:  # which has no transfer times
            for variant in run.variants:
                self._runout(variant)
        soft, strong = self.get("plateau_runout:softened"), self.get("plateau_runout:not_softened")
        if soft and strong and strong.value > _runs_out:
            self["plateau_ratio"] = Measure(soft.value / strong.value, "both variants", soft.cpu + strong.cpu, _error_of_ratio(soft, strong))

    @cached_property
    def found(self) -> Json:
        """Conditions over the telemetry of the FEM shown; empty: it has none."""
        phase = self.run.shown(fem)
        return conditions_of(self.run, phase, self.paper) if phase and phase.telemetry else {}

    @property
    def window(self) -> Window:
        return Window(**self.found.get("window", {}))

    def _stability(self) -> None:
        phase = self.run.shown(lem)
        stages = entry(phase.result if phase else None, "/stages", [])
        slices = number(phase.result, "/slices") if phase else None
        for key, result, pointer in (("factor_of_safety_intact", phase and phase.result, "/factor_of_safety"),
                                     ("depth_at_fs_1", phase and phase.result, "/depth_at_fs_1"),
                                     ("critical_depth", phase and phase.result, "/critical_depth"),
                                     ("factor_of_safety_liquefied", stages and stages[-1], "/factor_of_safety")):
            if phase and (value := number(result, pointer)) is not None:
                self[key] = Measure(value, phase.label, _cpu(phase), f"{slices:.6g} slices" if slices else "")

    def _shaking(self) -> None:
        phase = self.run.shown(fem)
        if not phase or not phase.telemetry:
            return
        asked = [each["key"] for each in (self.paper.values if self.paper else []) if "first_time" in each]
        entangled = entangled_at(phase) if phase.result else phase.telemetry[-1]["time"] if "entangled" in phase.fault else None
        for key, time in [*zip(asked, self.found["first"]), ("time_entangled", entangled), ("window_lower", self.window.lower),
                          ("window_upper", self.window.upper)]:
            if time is not None:
                self[key] = Measure(time, phase.label, _cpu(phase), "telemetry interval")

    def _runout(self, variant: str) -> None:
        suffix, runouts = f":{variant}" if variant else "", self.run.runouts_of(variant)
        for value in self.paper.values if self.paper else []:
            if "runout_at_s" in value and (value["key"].endswith(suffix) if suffix else ":" not in value["key"]):
                for each in runouts:
                    if abs((each.time or 0.0) - value["runout_at_s"]) < 0.1:
                        self[value["key"]] = Measure(each.runout, each.label, _cpu(each), "see the table of runouts", each.still_moves)
        begun = [each for each in runouts if each.runout > _runs_out]
        if begun:
            self["first_runout_time" + suffix] = Measure(begun[0].time or 0.0, begun[0].label, _cpu(begun[0]), "spacing of t_T")
        plateau = plateau_of(self.run, variant)
        if not plateau:
            return
        cpu, moving = sum(map(_cpu, plateau.runouts)), sum(each.still_moves for each in plateau.runouts)
        for key, pointer in (("plateau_runout", "/runout"), ("released_area", "/area_beyond_toe")):
            values = [value for each in plateau.runouts if (value := number(each.result, pointer)) is not None]
            if values:
                self[key + suffix] = Measure(median(values), f"median of {len(values)} runouts", cpu,
                                             f"they lie between {min(values):.6g} and {max(values):.6g}"
                                             + (f"; {moving} still moving" if moving else ""), moving > 0, min(values), max(values))
        of = "runouts of at least 75 % of the largest"
        self["plateau_begin" + suffix] = Measure(plateau.first, of, cpu, "spacing of t_T")
        self["plateau_end" + suffix] = Measure(plateau.last, of, cpu, "spacing of t_T")

    def comparison(self, paper: Paper) -> Table:
        """One row per value of the paper; "-" where the run has none."""
        table = Table("comparison", "The paper's numbers beside ours",
                      ["quantity", "unit", "paper", "here", "here / paper", "from", "error", "CPU s"], [],
                      f"Paper: {paper.source}. Plateau here: the transfer times around the largest runout of the variant that runs farthest, as "
                      "long as they give 75 % of it; its runout is their median. Window: from the criteria and the FEM's telemetry.")
        for each in paper.values:
            row, m = [each["what"], each["unit"], rounded(each["value"])], self.get(each["key"])
            if m:
                bound = at_least if m.lower_bound else ""
                row += [bound + rounded(m.value, 4), bound + rounded(m.value / each["value"], 3) if each["value"] else "-", m.source, m.error,
                        rounded(m.cpu, 3)]
            else:
                row += ["-", "-", "not in this run", "", ""]
            table.rows.append(row)
        return table


def _cpu(phase: Phase) -> float:
    return number(phase.result, "/cpu_seconds") or 0.0


def _error_of_ratio(over: Measure, under: Measure) -> str:
    if over.lower_bound or under.lower_bound:
        return "soil still moved: neither bound nor value"
    if under.least <= _runs_out:
        return f"says nothing: the smaller runouts go down to {under.least:.6g} m"
    return f"between {over.least / under.most:.3g} and {over.most / under.least:.3g} by the runouts of either"


def _edges(runouts: Sequence[Phase]) -> tuple[float, float]:
    top = max(range(len(runouts)), key=lambda k: runouts[k].runout)
    first = last = top
    level = _plateau_share * runouts[top].runout
    while first > 0 and runouts[first - 1].runout >= level:
        first -= 1
    while last + 1 < len(runouts) and runouts[last + 1].runout >= level:
        last += 1
    return runouts[first].time or 0.0, runouts[last].time or 0.0


def plateau_of(run: Run, variant: str) -> Plateau | None:
    """Variants that share a FEM share the times, from the one with the largest runout; None: none runs beyond the toe."""
    phase = run.of_variant(fem, variant)
    sharing = [found for each in run.variants if run.of_variant(fem, each) is phase and (found := run.runouts_of(each))]
    largest: list[Phase] = max(sharing, key=lambda found: max(each.runout for each in found), default=[])
    if not largest or max(each.runout for each in largest) <= 0.0:
        return None
    first, last = _edges(largest)
    return Plateau(first, last, [each for each in run.runouts_of(variant) if first <= (each.time or 0.0) <= last])
