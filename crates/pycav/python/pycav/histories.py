"""Histories as one labelled dataset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import xarray

from ._given import Named

Columns = Mapping[str, tuple[Any, str, str]]

PROBES = "probes/"


def from_columns(columns: Columns) -> xarray.Dataset:
    """A dataset of columns: path to (values, unit, description).

    Variables have the paths of the files (`bubble/volume`, `interface/pressure`) and the attributes `units` and
    `description`. Coordinates are the times: `time` of every step, and those of each group that is written less often, as
    `interface/time`; the radii of the interface are `interface/r`. While a run goes on, and after one that was killed, some columns
    have more rows than others: of those on one time the rows that all have count.
    """
    groups: dict[str, dict[str, tuple[Any, str, str]]] = {}
    for path, column in columns.items():
        group, _, _ = path.strip("/").rpartition("/")
        groups.setdefault(group, {})[path.strip("/")] = column
    variables: dict[str, Any] = {}
    coordinates: dict[str, Any] = {}
    steps = np.asarray(columns.get("time", columns.get("/time", (np.empty(0), "", "")))[0])
    times = {group: _time_of(group, members, steps) for group, members in groups.items()}
    rows: dict[str, int] = {}
    for group, members in groups.items():
        least = min((len(values) for path, (values, _, _) in members.items() if path != f"{group}/r"), default=0)
        rows[times[group]] = min(least, rows.get(times[group], least))
    for group, members in groups.items():
        own, time = f"{group}/time" if group else "time", times[group]
        radii = f"{group}/r" if f"{group}/r" in members else None
        for path, (values, unit, description) in members.items():
            array = np.asarray(values)
            if path != radii:
                array = array[:rows[time]]
            attributes = {"units": unit, "description": description}
            if path == own:
                coordinates[path] = ((time,), array, attributes)
            elif path == radii:
                coordinates[path] = ((path,), array, attributes)
            elif array.ndim == 1:
                variables[path] = ((time,), array, attributes)
            else:
                across = radii if radii and array.shape[1] == len(members[radii][0]) else f"{path} component"
                variables[path] = ((time, across), array, attributes)
    return xarray.Dataset(variables, coordinates)


def _time_of(group: str, members: Columns, steps: np.ndarray) -> str:
    """The time that the columns of a group are over: `time` where theirs is that of every step, so that rows of groups stand side by
    side."""
    own = f"{group}/time" if group else "time"
    if own not in members:
        return "time"
    times = np.asarray(members[own][0])
    both = min(len(times), len(steps))
    # Two rows tell a time of every step from a rarer one.
    known = len(times) == len(steps) or both > 1
    return "time" if known and np.array_equal(times[:both], steps[:both]) else own


def from_files(paths: Sequence[Path]) -> xarray.Dataset:
    """The dataset of one or several files of histories; of a dataset that several have, the first one's counts."""
    columns: dict[str, tuple[Any, str, str]] = {}
    attributes: dict[str, Any] = {}
    for path in paths:
        with h5py.File(path, "r") as file:
            attributes = {name: text(value) for name, value in file.attrs.items()} | attributes

            def take(name: str, item: Any) -> None:
                if isinstance(item, h5py.Dataset):
                    units, description = (text(item.attrs.get(key, "")) for key in ("units", "description"))
                    columns.setdefault(name, (item[()], units, description))

            file.visititems(take)
    found = from_columns(columns)
    found.attrs.update(attributes)
    return found


def text(value: Any) -> Any:
    """An attribute as a plain value."""
    return value.decode() if isinstance(value, bytes) else value


def probes(histories: xarray.Dataset) -> dict[str, xarray.Dataset]:
    """Each probe's dataset by its name, with the coordinate `time`; in the solid with `von_mises` besides."""
    names = sorted({str(name).split("/")[1] for name in histories.variables if str(name).startswith(PROBES)})
    found: dict[str, xarray.Dataset] = {}
    for name in names:
        prefix = f"{PROBES}{name}/"
        time = histories[f"{prefix}time"]
        members = [str(n) for n in histories.data_vars if str(n).startswith(prefix)]
        found[name] = xarray.Dataset(
            {n.removeprefix(prefix): (("time",), histories[n].to_numpy(), histories[n].attrs) for n in members},
            {"time": (("time",), time.to_numpy(), time.attrs)})
        if "stress_phiphi" in found[name]:
            found[name]["von_mises"] = von_mises(found[name])
    return Named("the run has no probe", found)


def von_mises(probe: xarray.Dataset) -> xarray.DataArray:
    """√(½ ((σ_zz − σ_rr)² + (σ_rr − σ_φφ)² + (σ_φφ − σ_zz)²) + 3 σ_zr²) of a probe's stresses, Pa."""
    zz, rr, phiphi, zr = (probe[f"stress_{part}"] for part in ("zz", "rr", "phiphi", "zr"))
    found = (0.5 * ((zz - rr) ** 2 + (rr - phiphi) ** 2 + (phiphi - zz) ** 2) + 3.0 * zr**2) ** 0.5
    return found.assign_attrs(units="Pa", description="von Mises stress")
