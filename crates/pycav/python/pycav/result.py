"""What a run left: histories, snapshots, summary."""

from __future__ import annotations

import functools
import json
import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, overload

import h5py
import numpy as np
from numpy.typing import NDArray

from . import _pycav, _toml
from ._given import Named, among, nearest_time
from .case import Case
from .mesh import Floats, Mesh

if TYPE_CHECKING:
    import meshio
    import pandas
    import pyvista
    import xarray

QUAD = 9  # VTK's number of a quadrilateral


class Snapshot:
    """The cell fields of one medium at one time; a field is read when it is asked for, as a copy."""

    def __init__(self, series: Snapshots, step: int) -> None:
        self._series = series
        self.step = step
        self.time = float(series.times[step])
        """s"""

    @property
    def mesh(self) -> Mesh:
        """The cells: `centre()`, `width()` (m), `sample(values, points)`."""
        return self._series.mesh(self.step)

    @property
    def fields(self) -> list[str]:
        """Names of the fields, see docs/reference/output.md."""
        return self._series.fields

    def __getitem__(self, name: str) -> Floats:
        """A field, shape (cells,), of vectors (cells, 3): (z, r, 0)."""
        return self._series.field(name, self.step)

    def __contains__(self, name: object) -> bool:
        return name in self.fields

    def to_pyvista(self) -> pyvista.UnstructuredGrid:
        """The snapshot with all its fields as PyVista has it: x is z, y is r. Needs pyvista."""
        import pyvista

        points, quads = self._series.geometry(self.step)
        cells = np.column_stack([np.full(len(quads), 4), quads]).ravel()
        grid = pyvista.UnstructuredGrid(cells, np.full(len(quads), QUAD, np.uint8), points)
        for name in self.fields:
            grid.cell_data[name] = self[name]
        grid.field_data["time"] = [self.time]
        return grid

    def geometry(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Points (z, r, 0), m, shape (points, 3), and the four points of each cell, shape (cells, 4)."""
        return self._series.geometry(self.step)

    def to_meshio(self) -> meshio.Mesh:
        """The snapshot with all its fields as meshio has it: x is z, y is r. Needs meshio: `pip install 'pycav[mesh]'`."""
        from .exchange.meshes import mesh

        return mesh(self)

    def export(self, path: str | os.PathLike[str]) -> Path:
        """Writes the snapshot in a format of meshio, by the file's ending: `.vtu`, `.xdmf`, `.msh` … Needs meshio."""
        from .exchange.meshes import export

        return export(self, path)

    def __repr__(self) -> str:
        return f"<pycav.Snapshot of the {self._series.medium} at {self.time:.6g} s>"


class Snapshots(Sequence[Snapshot]):
    """All snapshots of one medium."""

    def __init__(self, path: Path, medium: str) -> None:
        self.path = path
        self.medium = medium
        if not path.is_file():
            raise FileNotFoundError(f"{path.parent} has no {path.name}: the snapshots of the {medium} are missing")
        with h5py.File(path, "r") as file:
            steps = file["VTKHDF/Steps"]
            self.times: NDArray[np.float64] = np.asarray(steps["Values"][: int(steps.attrs["NSteps"])], float)
            """s"""
            self.fields: list[str] = list(file["VTKHDF/CellData"])
            self.units: dict[str, str] = {
                name: _text(data.attrs.get("units", "")) for name, data in file["VTKHDF/CellData"].items()}
        if not len(self.times):
            raise FileNotFoundError(f"{path.parent}: {path.name} has no snapshot: the run is, or ended, before its first")
        self._mesh: tuple[tuple[int, int], Mesh] | None = None

    def __len__(self) -> int:
        return len(self.times)

    @overload
    def __getitem__(self, step: int) -> Snapshot: ...

    @overload
    def __getitem__(self, step: slice) -> list[Snapshot]: ...

    def __getitem__(self, step: int | slice) -> Snapshot | list[Snapshot]:
        if isinstance(step, slice):
            return [self[k] for k in range(*step.indices(len(self)))]
        if not -len(self) <= step < len(self):
            raise IndexError(f"there are {len(self)} snapshots")
        return Snapshot(self, range(len(self))[step])

    def __iter__(self) -> Iterator[Snapshot]:
        return (Snapshot(self, step) for step in range(len(self)))

    def at(self, time: float) -> Snapshot:
        """The snapshot nearest to `time` in s; beyond the first or the last one with a warning."""
        return Snapshot(self, nearest_time(self.times, time))

    def export(self, directory: str | os.PathLike[str]) -> Path:
        """Writes all snapshots as `.vtu` files with a collection `MEDIUM.pvd`, for a ParaView before 5.12. Needs meshio."""
        from .exchange.meshes import series

        return series(self, directory)

    def field(self, name: str, step: int) -> Floats:
        if name not in self.fields:
            raise KeyError(f"{self.path.name} has no field {name!r}: {among(name, self.fields)}; output.fields of the case says which")
        with h5py.File(self.path, "r") as file:
            root = file["VTKHDF"]
            start = int(root["Steps/CellDataOffsets"][name][step])
            return np.asarray(root["CellData"][name][start : start + _size(root, "NumberOfCells", step)], float)

    def geometry(self, step: int) -> tuple[Floats, NDArray[np.int64]]:
        """Points, shape (points, 3), and the four points of each cell, shape (cells, 4)."""
        with h5py.File(self.path, "r") as file:
            root = file["VTKHDF"]
            first, corner = (_entry(root, name, step) for name in ("PointOffsets", "ConnectivityIdOffsets"))
            points = root["Points"][first : first + _size(root, "NumberOfPoints", step)]
            ids = root["Connectivity"][corner : corner + 4 * _size(root, "NumberOfCells", step)]
            return np.asarray(points, float), np.asarray(ids, np.int64).reshape(-1, 4)

    def mesh(self, step: int) -> Mesh:
        with h5py.File(self.path, "r") as file:
            root = file["VTKHDF"]
            place = (_entry(root, "PointOffsets", step), _entry(root, "ConnectivityIdOffsets", step))
        # The last one is kept: snapshots on the same mesh share it in the file.
        if self._mesh is None or self._mesh[0] != place:
            points, quads = self.geometry(step)
            # Corners are counted around a cell, so the first and the third are opposite.
            one, other = points[quads[:, 0], :2], points[quads[:, 2], :2]
            self._mesh = (place, Mesh(np.minimum(one, other), np.maximum(one, other)))
        return self._mesh[1]

    def __repr__(self) -> str:
        return f"<{len(self)} snapshots of the {self.medium}, 0 to {self.times[-1]:.6g} s>"


def _text(value: Any) -> str:
    """An attribute as a text."""
    return value.decode() if isinstance(value, bytes) else str(value)


def _entry(root: Any, name: str, step: int) -> int:
    """An entry of Steps; some of them have a column for each kind of cell, of which there is one."""
    return int(np.ravel(root["Steps"][name][step])[0])


def _size(root: Any, name: str, step: int) -> int:
    """A length of the mesh of a snapshot."""
    return int(root[name][_entry(root, "PartOffsets", step)])


class Result:
    """A run directory, as `cav run` or `pycav.run` left it; of a run that goes on, what is in the files so far."""

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = Path(directory)
        if not (self.directory / "summary.json").is_file():
            why = _grids(self.directory) or _file(self.directory) or "it has no summary.json"
            raise FileNotFoundError(f"{self.directory} is no run directory: {why}")

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """The numbers one asks for first, see docs/reference/output-summary.md."""
        return Named("the summary has no", json.loads((self.directory / "summary.json").read_text()))

    @functools.cached_property
    def case(self) -> Case:
        """The effective case of the run."""
        with h5py.File(self.directory / f"{self.media[0]}.h5", "r") as file:
            name = _text(file.attrs.get("case_name", "case"))
        return Case.from_toml((self.directory / "case.toml").read_text(), name)

    @functools.cached_property
    def parameters(self) -> dict[str, Any]:
        """The effective case as nested dictionaries."""
        return _toml.parse((self.directory / "case.toml").read_text())

    @property
    def state(self) -> str:
        """"running", "finished", "failed" or "interrupted", as it is now and as `pycav.runs` has it."""
        return _pycav.run_state(self.directory)

    @property
    def yield_strength(self) -> float | None:
        """Where the solid begins to yield, Pa; `None` if its material has no yield strength."""
        # A run that goes on, or was killed, has none in its summary.
        solid = self.parameters.get("solid", {})
        law = solid.get("plasticity", {})
        own = law["table"][0][1] if "table" in law else law.get("yield_strength", solid.get("material", {}).get("yield_strength"))
        found = self.summary.get("yield_strength", own)
        return None if found is None else float(found)

    @property
    def media(self) -> list[str]:
        """"fluid", "solid", or both."""
        found = [medium for medium in ("fluid", "solid") if (self.directory / f"{medium}.h5").exists()]
        if not found:
            missing = " and ".join(f"{medium}.h5" for medium in ("fluid", "solid") if medium in self.parameters)
            raise FileNotFoundError(f"{self.directory} has no {missing or 'fluid.h5 or solid.h5'}: the histories of the run are missing")
        return found

    @functools.cached_property
    def histories(self) -> xarray.Dataset:
        """All histories with units and times as coordinates, by the names of docs/reference/output-histories.md: `bubble/volume`."""
        from .histories import from_files

        return from_files([self.directory / f"{medium}.h5" for medium in self.media])

    @functools.cached_property
    def probes(self) -> dict[str, xarray.Dataset]:
        """The histories of each probe by its name, with the coordinate `time`."""
        from .histories import probes

        return probes(self.histories)

    def to_xarray(
        self,
        fields: Sequence[str] = (),
        *,
        spacing: float | None = None,
        window: tuple[float, float, float] | None = None,
    ) -> xarray.Dataset:
        """The run as one dataset by the CF conventions, that needs no pycav to be read.

        Histories have flat names, as `bubble_volume` and `interface_pressure`, with `units` and `long_name`; attributes of the dataset
        are program, revision, case with its hash, date, and the summary as JSON.

        - `fields`: of the snapshots, as `pressure` and `von_mises`, besides: over `snapshot_time`, `z_fluid` and `r_fluid` (or
          `z_solid`, `r_solid`), named `fluid_pressure` and so on; of vectors the two components.
        - `spacing`: of their regular grid, m; 128 points along the longer side if left out. Values are linear within each cell, scalars
          within the range of the cell and its neighbours.
        - `window`: (z_low, z_high, r_high), m.
        """
        from .exchange.dataset import dataset

        return dataset(self, fields, spacing, window)

    def to_netcdf(
        self,
        path: str | os.PathLike[str],
        fields: Sequence[str] = (),
        *,
        spacing: float | None = None,
        window: tuple[float, float, float] | None = None,
    ) -> Path:
        """Writes what `to_xarray` returns as one file of NetCDF-4."""
        from .exchange.dataset import write

        return write(self.to_xarray(fields, spacing=spacing, window=window), path)

    @functools.cached_property
    def fluid(self) -> Snapshots:
        """The snapshots of the fluid."""
        return Snapshots(self.directory / "fluid.vtkhdf", "fluid")

    @functools.cached_property
    def solid(self) -> Snapshots:
        """The snapshots of the solid."""
        return Snapshots(self.directory / "solid.vtkhdf", "solid")

    def snapshots(self, medium: str) -> Snapshots:
        """The snapshots of "fluid" or "solid"."""
        if medium not in ("fluid", "solid"):
            raise ValueError(f'media are "fluid" and "solid", not {medium!r}')
        return self.fluid if medium == "fluid" else self.solid

    @property
    def table(self) -> pandas.DataFrame:
        """The histories of every step (bubble, wall, solid, fix-ups) as a table over time in s.

        The solid has steps of its own; its columns are linear in between.
        """
        import pandas

        times = self.histories["time"].to_numpy()
        columns = {}
        for name, data in self.histories.data_vars.items():
            group = str(name).partition("/")[0]
            if group not in ("time_step", "bubble", "bubbles", "wall", "solid", "fixups") or data.ndim != 1:
                continue
            values = data.to_numpy()
            if data.dims != ("time",):
                values = np.interp(times, self.histories[str(data.dims[0])].to_numpy(), values)
            columns[str(name)] = values
        return pandas.DataFrame(columns, pandas.Index(times, name="time"))

    @property
    def key_numbers(self) -> pandas.DataFrame:
        """The peaks of the summary with their times: columns `value`, `unit`, `time` (s). Printed they are in MPa and µs."""
        from ._key_numbers import KeyNumbers

        return KeyNumbers.of(self.summary, self.parameters)

    @property
    def radius(self) -> float | None:
        """Radius of the case's first gas sphere, m; `None` if it has none."""
        spheres = [region["radius"] for region in self.parameters.get("fluid", {}).get("region", [])
                   if region.get("shape") == "sphere" and region.get("phase") == "gas"]
        return float(spheres[0]) if spheres else None

    @property
    def cells_per_radius(self) -> float | None:
        """Finest fluid cells along that radius, without which no peak means much."""
        told = self.summary.get("cells_per_radius")
        if told is not None:
            return float(told)
        if self.radius is None:
            return None
        fluid = self.parameters["fluid"]
        low, high = fluid["r"]
        return float(self.radius * fluid["cells"][1] * 2 ** fluid.get("levels", 0) / (high - low))

    def __repr__(self) -> str:
        state = "completed" if self.summary.get("completed") else "running" if self.state == "running" else "not completed"
        return f"<pycav.Result {str(self.directory)!r}, {state}>"


def _file(path: Path) -> str:
    """Of a path that is no directory: what to give instead."""
    if path.is_file():
        own = (path.parent / "summary.json").is_file()
        return f"it is a file; give the directory of its run, {path.parent}" if own else "it is a file, and no run is in its directory"
    return "" if path.exists() else "there is no such directory"


def _grids(directory: Path) -> str:
    """Of the directory of a study of grid convergence: which runs are in it; else nothing."""
    places = sorted((path.parent for path in directory.glob("grid-*/summary.json")), key=lambda place: (len(place.name), place.name))
    names = ", ".join(str(place) for place in places)
    return f"it holds a study of grid convergence; give one of its grids: {names}" if names else ""


def open_run(run_dir: str | os.PathLike[str] | Result) -> Result:
    """Opens the directory of a run."""
    return run_dir if isinstance(run_dir, Result) else Result(run_dir)
