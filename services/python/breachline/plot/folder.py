"""Opens the output folders of phases for the figures."""
from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ..faults import BreachlineError
from .chart import Figure

RESULT, SCENE = "result.json", "scene.completed.json"  #: names as core/phases/files.hpp has them


def read_json(path: Path) -> Any:
    """Raises OSError if the file cannot be read, BreachlineError if it is not JSON."""
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except OSError as cause:
        raise OSError(f"{path}: cannot be read ({cause.strerror}); give a phase's output") from cause
    except ValueError as cause:
        raise BreachlineError(f"{path}: {cause}; run the phase or export the run again") from cause


@contextmanager
def contents_of(path: Path, remedy: str) -> Iterator[None]:
    """Says of which file an entry is missing or of another type, and what to give instead."""
    try:
        yield
    except (AttributeError, IndexError, KeyError, TypeError) as cause:
        raise BreachlineError(f"{path}: an entry is missing or of another type ({cause}); {remedy}") from cause


def write_figures(folder: Path, figures: Sequence[Figure]) -> None:
    """Writes name.svg and name.csv."""
    folder.mkdir(parents=True, exist_ok=True)
    for each in figures:
        if "/" in each.name:
            raise BreachlineError(f"{each.name}: the name of a test holds a /; rename the test")
        (folder / f"{each.name}.svg").write_text(each.svg(), encoding="utf-8")
        (folder / f"{each.name}.csv").write_text(each.csv(), encoding="utf-8")
