"""Parameter sweeps: a run for every point of a grid of parameters."""

from __future__ import annotations

import itertools
import json
import os
import re
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor, Future, as_completed
from pathlib import Path
from typing import Any

import numpy as np
import xarray

from . import _toml
from ._pycav import RunError
from .case import Case, Material
from .case import materials as library
from .result import Result
from ._run import run

STAND_OFF = "stand_off"
ERROR = "error.json"

Point = dict[str, Any]


def measures(result: Result) -> dict[str, tuple[float, str]]:
    """What a sweep keeps of a run: value and unit by name."""
    summary = result.summary
    number = {name: float("nan") if summary.get(name) is None else float(summary[name]) for name, _ in SUMMARY}
    return {name: (number[name], unit) for name, unit in SUMMARY}


SUMMARY = [
    ("wall_pressure_peak", "Pa"), ("wall_pressure_peak_time", "s"), ("wall_pressure_peak_anywhere", "Pa"),
    ("wall_pressure_mean_peak", "Pa"), ("wall_pressure_mean_time", "s"), ("wall_impulse", "Pa s"),
    ("von_mises_peak", "Pa"), ("von_mises_peak_time", "s"), ("yielded_volume_peak", "m3"), ("collapse_time", "s"),
    ("min_equivalent_radius", "m"), ("jet_velocity_peak", "m/s"), ("plastic_strain_peak", "1"), ("plastic_work", "J"),
    ("pit_depth", "m"), ("pit_radius", "m"), ("pit_volume", "m3"), ("pit_rim", "m"), ("pit_floor", "m"), ("surface_still", "1"),
    ("wall_seconds", "s"),
]


def sweep(
    case: Case,
    parameters: Mapping[str, Sequence[Any]],
    out: str | os.PathLike[str],
    *,
    executor: Executor | None = None,
    threads: int | None = None,
    measure: Callable[[Result], Mapping[str, tuple[float, str]]] = measures,
    progress: Callable[[Point, str], object] | None = None,
) -> xarray.Dataset:
    """Runs a case at every combination of parameters and returns what was measured, over the parameters.

    - `parameters`: values by key, the keys of `Case.with_`; besides `stand_off`, the distance of the first region's centre
      from the wall over its radius, which moves the region along z.
    - `out`: a directory; every point has a run directory of its own in it. A point that is complete there is not run again,
      so a sweep that was stopped goes on where it was.
    - `executor`: whatever implements `concurrent.futures.Executor`: a thread or process pool, or a Dask client's
      `client.get_executor()`. Without one the points are run one after the other, here.
    - `threads`: of each run; 1 is best with an executor of as many workers as processors.
    - `measure`: what is kept of a run.
    - `progress`: called with every point and "known", "done" or the error.

    A point that fails is NaN, and its error is in the variable `error`; the other points are not affected. Variables carry
    `units`, coordinates are the parameters (a table, as a material of its own, by its number in the list).
    """
    names = list(parameters)
    lists = [list(parameters[name]) for name in names]
    points = [dict(zip(names, values)) for values in itertools.product(*lists)]
    root = Path(out)
    root.mkdir(parents=True, exist_ok=True)
    places = [root / _slug(point, [values.index(point[n]) for n, values in zip(names, lists)]) for point in points]
    errors: list[str] = [""] * len(points)

    def ended(number: int, error: str, how: str) -> None:
        errors[number] = error
        if progress is not None:
            progress(points[number], error or how)

    jobs: list[tuple[int, Case, Path]] = []
    for number, (point, place) in enumerate(zip(points, places)):
        try:
            changed = at_point(case, point)
        except (ValueError, TypeError, KeyError) as error:
            ended(number, f"{type(error).__name__}: {error}", "")
            continue
        if _is_complete(place, changed):
            ended(number, "", "known")
        else:
            jobs.append((number, changed, place))
    if executor is None:
        for number, changed, place in jobs:
            ended(number, _job(changed.to_toml(), changed.name, str(place), threads), "done")
    else:
        waiting: dict[Future[str], int] = {
            executor.submit(_job, changed.to_toml(), changed.name, str(place), threads): number
            for number, changed, place in jobs}
        for future in as_completed(waiting):
            failure = future.exception()
            ended(waiting[future], future.result() if failure is None else f"{type(failure).__name__}: {failure}", "done")
    return _gather(names, lists, places, errors, measure)


def at_point(case: Case, point: Mapping[str, Any]) -> Case:
    """The case at a point of a sweep."""
    changes = {name: value for name, value in point.items() if name != STAND_OFF}
    changed = case.with_(changes) if changes else case
    if STAND_OFF not in point:
        return changed
    effective = _toml.parse(changed.to_toml())
    region, wall = effective["fluid"]["region"][0], effective["fluid"]["z"][0]
    if "radius" not in region:
        raise ValueError("stand_off needs a sphere as the case's first region")
    return changed.with_({"fluid.region.0.centre": [wall + float(point[STAND_OFF]) * region["radius"], region["centre"][1]]})


def _slug(point: Point, numbers: list[int]) -> str:
    """A name for a point's directory that people can read and no two points share."""
    words = []
    for (name, value), number in zip(point.items(), numbers):
        plain = isinstance(value, (str, int, float, np.number)) and not isinstance(value, bool)
        shown = re.sub(r"[^A-Za-z0-9.+-]+", "-", str(value)) if plain else str(number)
        words.append(f"{name.rpartition('.')[2]}={shown}")
    return ",".join(words)


def _is_complete(place: Path, case: Case) -> bool:
    """Whether the run of just this case is there and reached its end."""
    try:
        result = Result(place)
        return bool(result.summary.get("completed")) and result.histories.attrs.get("case_hash") == case.hash
    except (OSError, ValueError):
        return False


def _job(text: str, name: str, place: str, threads: int | None) -> str:
    """Runs a point wherever the executor likes; returns its error, "" if there is none."""
    note = Path(place).with_name(f"{Path(place).name}.{ERROR}")
    try:
        run(Case.from_toml(text, name), place, threads=threads, force=True)
    except Exception as error:
        message = f"{type(error).__name__}: {error}"
        note.write_text(json.dumps({"error": message}))
        return message
    note.unlink(missing_ok=True)
    return ""


def _gather(
    names: list[str],
    lists: list[list[Any]],
    places: list[Path],
    errors: list[str],
    measure: Callable[[Result], Mapping[str, tuple[float, str]]],
) -> xarray.Dataset:
    shape = [len(values) for values in lists]
    found = [{} if error else dict(measure(Result(place))) for place, error in zip(places, errors)]
    units: dict[str, str] = {}
    for numbers in found:
        units |= {name: unit for name, (_, unit) in numbers.items()}
    variables: dict[str, Any] = {}
    for name, unit in units.items():
        values = [numbers[name][0] if name in numbers else float("nan") for numbers in found]
        variables[name] = (names, np.reshape(values, shape), {"units": unit})
    variables["error"] = (names, np.reshape(np.array(errors, dtype=object), shape))
    variables["directory"] = (names, np.reshape(np.array([str(place) for place in places], dtype=object), shape))
    coordinates = {name: [value if isinstance(value, (str, int, float, np.number)) else number
                          for number, value in enumerate(values)] for name, values in zip(names, lists)}
    return xarray.Dataset(variables, coordinates)


def stand_off_map(
    case: Case,
    stand_off: Sequence[float],
    materials: Sequence[Any],
    out: str | os.PathLike[str],
    **options: Any,
) -> xarray.Dataset:
    """A sweep over stand-off and material: wall-pressure peak, impulse, von Mises peak, yielded volume and more.

    `options` are those of `sweep`; `pycav.plot.stand_off_map` draws what comes back.
    """
    return sweep(case, {STAND_OFF: stand_off, "solid.material": materials}, out, **options)


def consistent_runs(
    case: Case,
    materials: Sequence[Any],
    out: str | os.PathLike[str],
    **options: Any,
) -> list[Result]:
    """Runs a case once with each of several materials of its solid and returns what they left, in that order.

    `pycav.plot.yield_function(run, beside=...)` draws them beside the yield functions of a single elastic run.

    - `materials`: names of the library, a `pycav.Material`, tables as in a case file, or yield strengths in Pa, which stand
      for the material of the library that has just this one.
    - `out`, `options`: those of `sweep`: every material has a run directory, and what is complete is not run again.

    Raises `pycav.RunError` with the errors of those that failed, when all have ended.
    """
    chosen = [_material(material) for material in materials]
    data = sweep(case, {"solid.material": chosen}, out, **options)
    errors = [str(error) for error in data["error"].to_numpy() if error]
    if errors:
        raise RunError("; ".join(errors))
    return [Result(directory) for directory in data["directory"].to_numpy()]


def _material(given: Any) -> Any:
    """A material as a case file names it."""
    if isinstance(given, Material):
        return given.name
    if isinstance(given, (str, Mapping)):
        return given
    found = [material.name for material in library() if material.yield_strength == float(given)]
    if len(found) != 1:
        has = ", ".join(f"{m.name} {m.yield_strength * 1e-6:g} MPa" for m in library() if m.yield_strength is not None)
        many = "no material" if not found else "more than one material"
        raise ValueError(f"{many} of the library has a yield strength of {float(given) * 1e-6:g} MPa; they are: {has}")
    return found[0]
