"""Many hits: the load of one collapse on the same wall, again and again."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray

from . import _pycav
from ._run import run
from .case import Case
from .result import Result, open_run
from .sweeps.work import is_complete

MEASURES = {
    "pit_depth": "m", "pit_radius": "m", "pit_volume": "m3", "plastic_strain_peak": "1", "plastic_work": "J",
    "work_on_solid": "J", "surface_still": "1",
}
"""What is kept of a hit, with units; `plastic_work` and `work_on_solid` are of that hit alone."""


def hits(
    case: Case | Result | str | os.PathLike[str],
    n: int,
    out: str | os.PathLike[str],
    *,
    solid: Mapping[str, Any] | None = None,
    longest: float | None = None,
    threads: int | None = None,
    progress: Callable[[int, Result], object] | None = None,
) -> xarray.Dataset:
    """Puts the load that a run has recorded on its wall n times and returns what stays after each hit.

    The load is p(r, t) on the interface of the run (`coupling.load.run`), one-way: the solid alone answers, so a hit costs what a
    solid costs. The first hit meets the wall as the case has it, each further one the wall that the one before has left
    (`solid.initial`): its stress, plastic strain, temperature and displacement, at rest. After the record the last pressure stays.

    - `case`: a case with a wall that yields, which is run once in `out/load`; or a finished run of one.
    - `out`: a directory; every hit has a run directory of its own in it. What is complete there is not run again, unless the load
      or the hit before has changed since.
    - `solid`: changes of the `[solid]` table for all hits, with the keys of `Case.with_` below it: `{"plasticity.law": "perfect"}`.
    - `longest`: how long a hit may take to become still, s; without it a hit ends with its record.
    - `threads`: of each run. `progress`: called with the number of the hit and its result.

    Returns a dataset over `hit` from 1 to n: pit_depth, pit_radius (m), pit_volume (m³), plastic_strain_peak, plastic_work,
    work_on_solid (J, of the hit), surface_still, directory. Raises `ValueError` for a run without a wall that yields, and for one
    that has not reached its end.
    """
    if n < 1:
        raise ValueError(f"n = {n}: give 1 hit or more")
    root = Path(out)
    root.mkdir(parents=True, exist_ok=True)
    loading = _loading(case, root / "load", threads)
    results: list[Result] = []
    for hit in range(1, n + 1):
        place = root / f"hit-{hit:0{len(str(n))}d}"
        before = results[-1].directory if results else None
        repeated = _repeated(loading, solid or {}, before, longest)
        if not is_complete(place, repeated):
            run(repeated, place, threads=threads, force=True)
        results.append(open_run(place))
        if progress is not None:
            progress(hit, results[-1])
    values: dict[str, Any] = {
        name: ("hit", [_number(result.summary.get(name)) for result in results], {"units": unit})
        for name, unit in MEASURES.items()}
    values["directory"] = ("hit", np.array([str(result.directory) for result in results], dtype=object), {})
    return xarray.Dataset(values, {"hit": np.arange(1, n + 1)}, {"load": str(loading.directory)})


def _number(value: Any) -> float:
    return float("nan") if value is None else float(value)


def _loading(case: Case | Result | str | os.PathLike[str], place: Path, threads: int | None) -> Result:
    """The run whose load is repeated."""
    if isinstance(case, Case):
        if not is_complete(place, case):
            run(case, place, threads=threads, force=True)
        return open_run(place)
    loading = open_run(case)
    state = _pycav.run_state(loading.directory)
    if state != "finished":
        cure = "wait for its end" if state == "running" else f"go on with it by cav run --resume {loading.directory}"
        raise ValueError(f"case: the run in {loading.directory} is {state}, and only a finished one has all of its load; {cure}")
    return loading


def _repeated(loading: Result, changes: Mapping[str, Any], before: Path | None, longest: float | None) -> Case:
    """The case of a hit: the solid of the run alone, under what its wall got."""
    effective = loading.parameters
    if "plasticity" not in effective.get("solid", {}):
        raise ValueError(f"{loading.directory}: its wall cannot yield, so hits leave nothing; give the case [solid.plasticity]")
    solid = dict(effective["solid"])
    if before is not None:
        solid["initial"] = str(before.resolve())
    end = effective["time"].get("end")
    time: dict[str, Any] = {"cfl": effective["time"]["cfl"], "local_steps": effective["time"]["local_steps"]}
    time |= {"end": end} if longest is None else {"end": "settled", "longest": longest}
    table = {
        "geometry": effective["geometry"], "time": time, "solid": solid,
        "coupling": {"scheme": "load", "load": {"run": str(loading.directory.resolve())}},
    }
    repeated = Case.from_dict(table, f"{loading.case.name}-hit")
    return repeated.with_({f"solid.{key}": value for key, value in changes.items()}) if changes else repeated
