"""What a sweep has found, as one labelled dataset, and as one file."""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import xarray

from .._provenance import provenance
from ..case import Case
from .measures import words
from .points import Axes, is_plain, labels

COMPLETE, FAILED, LEFT_OUT = 0, 1, 2
FLAGS = {"flag_values": np.array([0, 1, 2], np.int8), "flag_meanings": "complete failed not_run", "long_name": "state of the run"}

SMALL = 1 << 15
"""Bytes up to which a variable of a file is not packed."""


def gather(
    axes: Axes, places: Sequence[Path], errors: Sequence[str], left_out: set[int], known: Mapping[int, Mapping[str, tuple[float, str]]],
) -> xarray.Dataset:
    """The numbers of all points, over the parameters; `known`: what was measured, by the point's number."""
    found = [known.get(number, {}) for number in range(len(places))]
    units: dict[str, str] = {}
    for numbers in found:
        units |= {name: unit for name, (_, unit) in numbers.items()}
    variables: dict[str, Any] = {}
    for name, unit in units.items():
        values = [numbers[name][0] if name in numbers else float("nan") for numbers in found]
        variables[name] = (axes.names, np.reshape(values, axes.shape), {"units": unit, "long_name": words(name)})
    states = [LEFT_OUT if number in left_out else FAILED if error else COMPLETE for number, error in enumerate(errors)]
    variables["status"] = (axes.names, np.reshape(np.array(states, np.int8), axes.shape), FLAGS)
    for name, texts in (("error", list(errors)), ("directory", [str(place) for place in places])):
        variables[name] = (axes.names, np.reshape(np.array(texts, dtype=object), axes.shape), {"long_name": name})
    return xarray.Dataset(variables, axes.coordinates())


def attributes(case: Case, axes: Axes, root: Path, places: Sequence[Path]) -> dict[str, Any]:
    """Where a dataset is from: program and revision of its runs, case and its hash, date, values of the parameters."""
    run: dict[str, Any] = {}
    if there := [path for place in places if (path := place / "history.h5").exists()]:
        with h5py.File(there[0], "r") as file:
            run = dict(file.attrs)
    return provenance(
        f"{case.name} over {', '.join(axes.names)}", "pycav.sweep", run, case_name=case.name, case_hash=case.hash, case=case.to_toml(),
        case_read=case._native.text, case_changes=json.dumps(case._changes),
        parameters=json.dumps(dict(zip(axes.names, axes.lists)), default=_json), out=str(root))


def case_of(data: xarray.Dataset) -> Case:
    """The case of a sweep, as it was given: what follows from other keys still does."""
    if "case_read" not in data.attrs:
        raise ValueError("the dataset has no case among its attributes: give what pycav.sweep has returned")
    case = Case.from_toml(str(data.attrs["case_read"]), str(data.attrs["case_name"]))
    return case._changed(list(json.loads(data.attrs["case_changes"])))


def _json(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value.tolist() if isinstance(value, np.ndarray) else str(value)


def parameters(data: xarray.Dataset) -> dict[str, list[Any]]:
    """The values of a sweep's parameters that a dataset has, tables of one's own included, in the order of its coordinates."""
    if "parameters" in data.attrs:
        given = json.loads(data.attrs["parameters"])
        return {str(name): values_along(data, name) or list(values) for name, values in given.items()}
    return {str(name): [value.item() for value in data[name].to_numpy()] for name in data["status"].dims}


def values_along(data: xarray.Dataset, name: str) -> list[Any]:
    """A parameter's values in the order of its labels; none where it has labels that `sweep` did not give, as names of one's own."""
    values = json.loads(data.attrs.get("parameters", "{}")).get(name)
    if values is None or name not in data.coords:
        return []
    here, named = np.atleast_1d(data[name].to_numpy()), np.asarray(labels(values))
    # Maps from before truth values were labels have their numbers in the list.
    of_label = dict(zip(named.tolist() if here.dtype == bool or named.dtype != bool else range(len(values)), values))
    return [of_label[label] for label in here.tolist()] if all(label in of_label for label in here.tolist()) else []


def save_map(data: xarray.Dataset, path: str | os.PathLike[str]) -> Path:
    """Writes a dataset as NetCDF-4 (`.nc`) or Zarr (`.zarr`); the old file is there until the new one is whole."""
    target = Path(path)
    if target.suffix not in (".nc", ".zarr"):
        raise ValueError(f"a map is written as .nc or .zarr, not as {target.name}")
    target.parent.mkdir(parents=True, exist_ok=True)
    fresh = target.with_name(f".{target.name}.new{target.suffix}")
    if target.suffix == ".zarr":
        shutil.rmtree(fresh, ignore_errors=True)
        _to_zarr(data, fresh)
        shutil.rmtree(target, ignore_errors=True)
    else:
        # Of a small variable what describes the packing takes more room than it saves.
        packed = {name: {"zlib": True, "complevel": 4} for name, variable in data.variables.items()
                  if variable.dtype.kind in "fi" and variable.nbytes > SMALL}
        data.to_netcdf(fresh, engine="h5netcdf", encoding=packed)
    os.replace(fresh, target)
    return target


def _to_zarr(data: xarray.Dataset, path: Path) -> None:
    import zarr

    # The second format has texts in its specification, the third has not yet.
    newer = int(zarr.__version__.partition(".")[0]) >= 3
    options: Any = {"zarr_format": 2} if newer else {}
    data.to_zarr(path, mode="w", **options)


def opened(data: xarray.Dataset | str | os.PathLike[str]) -> xarray.Dataset:
    """A dataset, read from its file if it is not at hand."""
    if isinstance(data, xarray.Dataset):
        return data
    path = Path(data)
    if path.is_dir() and path.suffix != ".zarr":
        maps = ", ".join(str(file) for file in _maps_of(path))
        cure = f"give {maps}" if maps else "none is in it or beside it, and the same call with to= writes one and runs nothing again"
        raise ValueError(f"{path} is a directory, not a map, which is the file (.nc or .zarr) that to= of pycav.sweep names: {cure}")
    with _file(path) as found:
        return found.load()


def _file(path: Path) -> xarray.Dataset:
    return xarray.open_dataset(path, engine="zarr" if path.suffix == ".zarr" else "h5netcdf")


def _maps_of(directory: Path) -> list[Path]:
    """The maps in a sweep's directory or beside it that say they are of that sweep."""
    found = []
    for path in sorted([*directory.glob("*"), *directory.parent.glob("*")]):
        if path.suffix not in (".nc", ".zarr"):
            continue
        try:
            with _file(path) as data:
                own = str(data.attrs.get("out", ""))
        except (OSError, ValueError, ImportError):
            continue  # some other file, or Zarr is not installed
        # A sweep's directory may have been given from elsewhere, or moved: its name is what is left.
        if own and Path(own).resolve().name == directory.resolve().name:
            found.append(path)
    return found


def numeric(data: xarray.Dataset) -> list[str]:
    """The parameters that are numbers, with two values or more."""
    known = parameters(data)
    return [name for name, values in known.items() if len(values) > 1
            and all(is_plain(value) and not isinstance(value, str) for value in values)]
