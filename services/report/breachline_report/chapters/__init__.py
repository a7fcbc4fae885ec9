"""The chapters, each from the files of its phases. What lacks data is left out, and the reason is noted."""
from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from ..measures import Measures
from ..paper import Paper
from ..run import Run


@dataclass
class Choice:
    """Choices of the reader."""

    snapshot_times: list[float] = field(default_factory=list)  #: of contours and meshes [s]; empty: four over the run
    transfer_times: list[float] = field(default_factory=list)  #: of the runouts in detail [s]; empty: chosen
    companions: list[Path] = field(default_factory=list)  #: other runs with variants that belong to this one
    element_tests: Path | None = None  #: folder of element_bench


@dataclass
class Material:
    """The input of all chapters."""

    run: Run
    paper: Paper | None
    measures: Measures
    choice: Choice
