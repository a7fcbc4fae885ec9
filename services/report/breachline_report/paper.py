"""Published numbers for comparison with a scene (paper.json)."""
from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path

from breachline.plot import Figure, Series

from .document import Json


@dataclass(frozen=True)
class Paper:
    source: str
    remarks: list[str]  #: shown with every result
    values: list[Json]  #: {"key", "what", "unit", "value"}; "first_time": of a condition, "runout_at_s": of the run's runout
    points: list[Json]  #: {"figure", "series", "x", "y"}
    notes: list[Json]  #: below a table, where an entry of its first phase's result has the value: {"table", "text", "entry", "value"}
    case_history_runout_m: str  #: "> 800"

    def add_points(self, figure: Figure) -> None:
        figure.chart.series += [Series(each["series"], each["x"], each["y"], "points") for each in self.points if each["figure"] == figure.name]


def paper_for(scene_name: str) -> Paper | None:
    """None: the scene is not one of a paper's cases."""
    text = json.loads(Path(__file__).with_name("paper.json").read_text(encoding="utf-8"))
    return Paper(**text) if scene_name.startswith(text.pop("scenes_begin_with")) else None
