"""Frames: material points or a mesh at one time, from the exchange files (core/exchange)."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import h5py  # type: ignore[import]
import numpy as np
from numpy.typing import NDArray

from .faults import BreachlineError

if TYPE_CHECKING:
    import pyvista  # type: ignore[import]
    import xarray  # type: ignore[import]

Array = NDArray[Any]


@dataclass(frozen=True)
class Frame:
    """SI units, tension positive; stress and strain (xx, yy, zz, xy), velocity_gradient (xx, xy, yx, yy)."""

    time: float  #: [s], of its phase
    position: Array  #: [points, 2] m
    regions: list[str]  #: names, by region index
    materials: list[str]  #: of the regions
    fields: dict[str, Array]  #: [points] or [points, components]
    units: dict[str, str]
    quads: Array | None = None  #: [elements, 4] corners of a mesh; None: material points
    cell_fields: dict[str, Array] = field(default_factory=dict)  #: [elements] or [elements, components]
    stress_of_regions: list[str] = field(default_factory=list)  #: "effective", "total" or "buoyant"; empty: all effective
    transfer_time: float | None = None  #: of material points [s], on the FEM's clock
    inputs: list[tuple[str, str]] = field(default_factory=list)  #: path and SHA-256 of the files that it was made from

    def __getitem__(self, name: str) -> Array:
        for fields in (self.fields, self.cell_fields):
            if name in fields:
                return fields[name]
        raise BreachlineError(f"the frame at {self.time:g} s has no {name}; it has "
                              + ", ".join(sorted({*self.fields, *self.cell_fields}))
                              + " (/mpm/output/fields of the scene says what a runout's frames hold)")

    def __repr__(self) -> str:
        what = "points" if self.quads is None else f"nodes, {len(self.quads)} elements"
        return f"Frame({self.time:g} s, {len(self.position)} {what}; " + ", ".join({**self.fields, **self.cell_fields}) + ")"

    def pyvista(self) -> pyvista.DataSet:
        """Needs pyvista."""
        import pyvista

        places = np.column_stack([self.position, np.zeros(len(self.position))])
        if self.quads is None:
            data = pyvista.PolyData(places)
        else:
            cells = np.column_stack([np.full(len(self.quads), 4), self.quads]).ravel()
            data = pyvista.UnstructuredGrid(cells, np.full(len(self.quads), 9, dtype=np.uint8), places)
        for name, values in self.fields.items():
            data.point_data[name] = values
        for name, values in self.cell_fields.items():
            data.cell_data[name] = values
        return data


class Frames(Sequence[Frame]):
    """Frames of one task, ascending in time; each is read on access."""

    def __init__(self, times: list[float], opened: Callable[[int], Path], whose: str = "") -> None:
        self.whose = whose  #: label and state of the task
        self.times: NDArray[np.float64] = np.array(times, dtype=np.float64)  #: [s], from the files' names
        self._opened = opened

    def __len__(self) -> int:
        return len(self.times)

    @overload
    def __getitem__(self, index: int) -> Frame: ...

    @overload
    def __getitem__(self, index: slice) -> list[Frame]: ...

    def __getitem__(self, index: int | slice) -> Frame | list[Frame]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(f"frame {index} of {len(self)}")
        return read(self._opened(index % len(self)))

    def at(self, time: float) -> Frame:
        """The frame nearest to this time [s]."""
        return self[int(np.argmin(np.abs(self.times - time)))]

    def __repr__(self) -> str:
        return f"Frames({len(self)} from {self.times[0]:g} s to {self.times[-1]:g} s of {self.whose or 'a task'})"

    def xarray(self) -> xarray.Dataset:
        """All frames as one dataset over time and point; they must have the same points and fields. Needs xarray."""
        import xarray

        frames = list(self)
        names = set.intersection(*(set(each.fields) for each in frames))
        if len({len(each.position) for each in frames}) > 1:
            raise BreachlineError("the frames have different numbers of points, which no one array can hold")
        data = {}
        for name, stacked in [("position", np.stack([each.position for each in frames]))] + [
                (name, np.stack([each.fields[name] for each in frames])) for name in sorted(names)]:
            dimensions = ("time", "point") if stacked.ndim == 2 else ("time", "point", f"component_of_{name}")
            data[name] = (dimensions, stacked, {"unit": "m" if name == "position" else frames[0].units.get(name, "")})
        return xarray.Dataset(data, coords={"time": ("time", np.array([each.time for each in frames]), {"unit": "s"})})


def read(path: Path) -> Frame:
    """Reads a .vtkhdf file of fem_solver, transfer_tool or mpm_solver."""
    try:
        with h5py.File(path) as file:
            return _frame_in(file)
    except (OSError, KeyError) as cause:
        raise BreachlineError(f"{path}: not a whole frame of Breachline ({cause})") from cause


def _frame_in(file: Any) -> Frame:
    grid, ours = file["VTKHDF"], file["breachline"]
    units: dict[str, str] = {}
    fields = _fields(grid["PointData"], units)
    cell_fields = _fields(grid["CellData"], units)
    quads = grid["Connectivity"][()].reshape(-1, 4) if grid["Types"].shape[0] > 0 and grid["Types"][0] == 9 else None
    return Frame(float(ours.attrs["time"]), grid["Points"][:, :2], list(ours["regions"].asstr()),
                 list(ours["materials_of_regions"].asstr()), fields, units, quads, cell_fields, _texts(ours, "stress_of_regions"),
                 float(ours.attrs["transfer_time"]) if "transfer_time" in ours.attrs else None,
                 list(zip(_texts(ours, "provenance/input_paths"), _texts(ours, "provenance/input_sha256"))))


def _texts(group: Any, name: str) -> list[str]:
    return list(group[name].asstr()) if name in group else []


def _fields(group: Any, units: dict[str, str]) -> dict[str, Array]:
    """Removes the components that are zero in plane strain: z of a vector, yz and xz of a tensor."""
    fields = {}
    for name, data in group.items():
        values = data[()]
        plane = {3: 2, 6: 4}.get(values.shape[1], values.shape[1]) if values.ndim == 2 else None
        fields[name] = values if plane is None else values[:, :plane]
        unit = data.attrs.get("unit", b"")
        units[name] = unit.decode() if isinstance(unit, bytes) else str(unit)
    return fields
