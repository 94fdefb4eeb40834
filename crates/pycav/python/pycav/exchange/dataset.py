"""A run as one dataset by the CF conventions: histories, and snapshots on a regular grid."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import xarray

from .._given import positive
from .._given import window as checked
from .._provenance import provenance
from ..mesh import Floats

if TYPE_CHECKING:
    from ..result import Result, Snapshots

Window = tuple[float, float, float]
POINTS = 128
"""Points along the longer side of a window, if no spacing is given."""
MOST = 1 << 28
"""Values of one field over all snapshots: 2 GiB of them are a mistake."""
COMPONENTS = ("z", "r")
NAMES = {"time": "time since the start", "z": "height, from the solid into the fluid", "r": "distance from the axis"}


def dataset(
    result: Result,
    fields: Sequence[str] = (),
    spacing: float | None = None,
    window: Window | None = None,
) -> xarray.Dataset:
    """Histories with flat names, and of the media that have them the named fields over (`snapshot_time`, `z_MEDIUM`, `r`)."""
    histories = result.histories
    flat = {name: re.sub(r"[^A-Za-z0-9_]", "_", str(name)) for name in {*histories.variables, *histories.dims}}
    found = histories.rename(flat)
    for variable in found.variables.values():
        variable.attrs = {"units": variable.attrs.get("units", "1") or "1",
                          "long_name": variable.attrs.get("description", "")}
    for name in found.coords:
        last = str(name).rpartition("_")[2]
        if last in NAMES:
            found[name].attrs["long_name"] = found[name].attrs["long_name"] or NAMES[last]
        if last == "time":
            found[name].attrs["axis"] = "T"
    if fields:
        found = found.merge(snapshots(result, fields, spacing, window))
    told = result.histories.attrs
    place = "plane strain, per metre of depth" if result.parameters.get("geometry") == "planar" else "axisymmetric about r = 0"
    found.attrs = provenance(
        f"run of the case {told.get('case_name', result.directory.name)}", f"pycav: written from {result.directory.name}", told,
        **{name: str(told.get(name, "")) for name in ("case_name", "case_hash", "case")},
        completed=int(bool(result.summary.get("completed"))), summary=json.dumps(result.summary),
        comment=f"SI units; {place}; z from the solid into the fluid; stresses are positive in tension")
    return found


def snapshots(result: Result, fields: Sequence[str], spacing: float | None, window: Window | None) -> xarray.Dataset:
    """Fields of the snapshots at the middles of a regular grid, linear within each cell of the run; scalars are bounded by its neighbours."""
    spacing = None if spacing is None else positive("spacing", spacing, "m")
    if window is not None:
        meshes = [result.snapshots(medium)[0].mesh for medium in result.media]
        window = checked(window, np.min([mesh.low for mesh in meshes], 0), np.max([mesh.high for mesh in meshes], 0))
    left, outside = set(fields), ""
    found = xarray.Dataset()
    for medium in result.media:
        series = result.snapshots(medium)
        own = [name for name in fields if name in series.fields]
        left -= set(own)
        low, high = _box(series, window)
        if own and (high > low).all():
            found = found.merge(_sampled(series, own, spacing, low, high))
        elif own:
            outside = medium
    if left:
        known = {name for medium in result.media for name in result.snapshots(medium).fields}
        raise ValueError(f"no snapshot has {', '.join(sorted(left))}, only {', '.join(sorted(known))}")
    if not found:
        raise ValueError(f"the window holds nothing of the {outside}")
    return found


def _box(series: Snapshots, window: Window | None) -> tuple[Floats, Floats]:
    """Corners (z, r) of what is sampled of a medium."""
    low, high = series[0].mesh.low, series[0].mesh.high
    if window is None:
        return low, high
    return np.maximum(low, [window[0], -np.inf]), np.minimum(high, [window[1], window[2]])


def _sampled(series: Snapshots, fields: Sequence[str], spacing: float | None, low: Floats, high: Floats) -> xarray.Dataset:
    step = float((high - low).max()) / POINTS if spacing is None else float(spacing)
    counts = np.maximum(np.floor((high - low) / step + 1e-9).astype(int), 1)
    if float(counts.prod()) * len(series) > MOST:
        raise ValueError(f"a spacing of {step:g} m gives {counts[0]} x {counts[1]} points in each of {len(series)} snapshots: too many")
    z, r = (low[axis] + (np.arange(counts[axis]) + 0.5) * step for axis in (0, 1))
    points = np.stack(np.meshgrid(z, r, indexing="ij"), -1).reshape(-1, 2)
    rows: dict[str, list[Floats]] = {}
    for snapshot in series:
        mesh = snapshot.mesh
        for name in fields:
            for own, values, parity in _parts(name, snapshot[name]):
                scalar = own == name and not name.startswith("stress_")
                rows.setdefault(own, []).append(mesh.sample(values, points, parity, bounded=scalar).reshape(len(z), len(r)))
    place = f"z_{series.medium}", f"r_{series.medium}"
    attributes = {name: {"units": "m", "long_name": NAMES[name[0]], "axis": axis} for name, axis in zip(place, ("Y", "X"))}
    variables = {f"{series.medium}_{name}": (("snapshot_time", *place), np.stack(values).astype(np.float32), {
        "units": series.units.get(_whole(name, fields), "1") or "1", "long_name": f"{name.replace('_', ' ')} in the {series.medium}",
        "cell_methods": "area: point"}) for name, values in rows.items()}
    return xarray.Dataset(variables, {
        "snapshot_time": ("snapshot_time", series.times, {"units": "s", "long_name": "time of the snapshot", "axis": "T"}),
        place[0]: (place[0], z, attributes[place[0]]), place[1]: (place[1], r, attributes[place[1]])})


def _parts(name: str, values: Floats) -> list[tuple[str, Floats, int]]:
    """A field's components with their parity about the axis."""
    if values.ndim == 1:
        return [(name, values, -1 if name == "stress_zr" else 1)]
    return [(f"{name}_{part}", values[:, axis], -1 if part == "r" else 1) for axis, part in enumerate(COMPONENTS)]


def _whole(name: str, fields: Sequence[str]) -> str:
    return name if name in fields else name.rpartition("_")[0]


def write(data: xarray.Dataset, path: str | os.PathLike[str]) -> Path:
    """Writes a dataset as NetCDF-4, compressed."""
    target = Path(path)
    if target.suffix not in (".nc", ".nc4"):
        raise ValueError(f"NetCDF is written as .nc, not as {target.name}")
    target.parent.mkdir(parents=True, exist_ok=True)
    packed = {name: {"zlib": True, "complevel": 4} for name, variable in data.variables.items() if variable.ndim and variable.size}
    data.to_netcdf(target, engine="h5netcdf", encoding=packed)
    return target
