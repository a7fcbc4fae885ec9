"""Results: one row per transfer time and variant, with a unit for each column."""
from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import NDArray

from .faults import BreachlineError

if TYPE_CHECKING:
    import pandas  # type: ignore[import]

Row = dict[str, Any]


@dataclass(frozen=True)
class Column:
    name: str
    kind: str  #: number, yes_no, word or flags
    unit: str  #: SI; empty: none
    meaning: str


class Table:
    """Rows as dictionaries, columns as arrays: table[0]["runout"] is table["runout"][0]. A variant without a transfer, such
    as a stable dam, has no row: statistics over rows exclude it."""

    def __init__(self, columns: list[Column], rows: list[Row], without_transfer: Sequence[Row] = ()) -> None:
        self.columns = columns
        self.rows = rows
        self.without_transfer = list(without_transfer)  #: variants and reasons

    @classmethod
    def of(cls, answer: Row) -> Table:
        """answer: from the API's results, or results.json of an export."""
        columns = [Column(each["name"], each["kind"], each["unit"], each["meaning"]) for each in answer["columns"]]
        return cls(columns, list(answer["rows"]), answer.get("without_transfer", []))

    def __len__(self) -> int:
        return len(self.rows)

    def __iter__(self) -> Iterator[Row]:
        return iter(self.rows)

    @overload
    def __getitem__(self, name: int) -> Row: ...

    @overload
    def __getitem__(self, name: str) -> NDArray[Any]: ...

    def __getitem__(self, name: int | str) -> Row | NDArray[Any]:
        """A row by its number, or a column [rows]: float64 with nan for unknown numbers; objects for other columns."""
        if isinstance(name, int):
            return self.rows[name]
        column = self.column(name)
        values = [row.get(name) for row in self.rows]
        if column.kind == "number":
            return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
        return np.array(values, dtype=object)

    def column(self, name: str) -> Column:
        for each in self.columns:
            if each.name == name:
                return each
        raise BreachlineError(f"no column {name}; there are " + ", ".join(each.name for each in self.columns))

    def pandas(self) -> pandas.DataFrame:
        """Needs pandas. Units are in its attrs["units"]."""
        import pandas

        frame = pandas.DataFrame({each.name: self[each.name] for each in self.columns})
        frame.attrs["units"] = {each.name: each.unit for each in self.columns}
        return frame

    def _shown(self) -> list[str]:
        return [name for name in ("id", "name", "created", "variant", "transfer_time", "state", "runout", "runout_beyond_toe", "at_rest", "end_time",
                                  "headline", "verdict")
                if any(row.get(name) not in (None, "") for row in self.rows)]

    def __repr__(self) -> str:
        names = self._shown()
        head = [f"{name} [{self.column(name).unit}]" if self.column(name).unit else name for name in names]
        lines = [head] + [[_cell(row.get(name)) for name in names] for row in self.rows]
        widths = [max(len(line[k]) for line in lines) for k in range(len(names))]
        shown = ["  ".join(text.rjust(width) for text, width in zip(line, widths)) for line in lines]
        shown += [f"no transfer of {each.get('variant') or 'the scene'}: {each.get('reason')}" for each in self.without_transfer]
        return "\n".join(shown)


@dataclass(frozen=True)
class Comparison:
    """Two runs row by row, matched by variant and transfer time. If a variant has no common transfer time, its rows with the
    largest runouts are matched. The difference of a column is the other's value minus this one's."""

    here: Table
    other: Table
    pairs: list[tuple[int, int]]  #: matching rows of `here` and `other`
    only_here: list[tuple[str, float | None]]  #: variant and transfer time [s] without a counterpart
    only_there: list[tuple[str, float | None]]

    @classmethod
    def of(cls, here: Table, other: Table) -> Comparison:
        mine, theirs = _places(here), _places(other)
        common = {key: key for key in mine if key in theirs}
        for variant in {key[0] for key in mine} - {key[0] for key in common}:
            if any(key[0] == variant for key in theirs):
                common[_farthest(here, mine, variant)] = _farthest(other, theirs, variant)
        return cls(here, other, [(mine[key], theirs[twin]) for key, twin in common.items()],
                   [key for key in mine if key not in common], [key for key in theirs if key not in common.values()])

    def __len__(self) -> int:
        return len(self.pairs)

    def difference(self, name: str) -> NDArray[np.float64]:
        """[pairs], in the column's unit; nan where a value is unknown."""
        if self.here.column(name).kind != "number":
            raise BreachlineError(f"{name} holds no numbers")
        mine, theirs = self.here[name], self.other[name]
        return np.array([theirs[j] - mine[i] for i, j in self.pairs], dtype=np.float64)

    def __repr__(self) -> str:
        lines = [f"{len(self)} rows in both, {len(self.only_here)} only here, {len(self.only_there)} only there"]
        for (i, j), difference in zip(self.pairs, self.difference("runout")):
            row = self.here.rows[i]
            times = {_cell(row.get("transfer_time")): 0, _cell(self.other.rows[j].get("transfer_time")): 0}
            place = " ".join(filter(None, [str(row.get("variant") or ""), " and ".join(times) + " s"]))
            lines.append(f"{place}: runout {_cell(row.get('runout'))} m, {_cell(self.other.rows[j].get('runout'))} m, "
                         f"difference {difference:+.4g} m")
        return "\n".join(lines)


def _places(table: Table) -> dict[tuple[str, float | None], int]:
    return {(str(row.get("variant") or ""), row.get("transfer_time")): k for k, row in enumerate(table.rows)}


def _farthest(table: Table, places: dict[tuple[str, float | None], int], variant: str) -> tuple[str, float | None]:
    own = [key for key in places if key[0] == variant]
    return max(own, key=lambda key: -np.inf if (runout := table.rows[places[key]].get("runout")) is None else runout)


def _cell(value: Any) -> str:
    if value is None:
        return "-"
    return f"{value:.6g}" if isinstance(value, float) else str(value)
