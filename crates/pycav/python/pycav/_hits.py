"""Many hits: the load of one collapse on the same wall, again and again."""

from __future__ import annotations

import numbers
import os
import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray

from . import _pycav
from ._given import count, positive
from ._numbers import unit_in
from ._provenance import provenance
from ._run import run
from .case import Case
from .result import Result, open_run
from .sweeps.measures import words
from .sweeps.work import is_complete

MEASURES = {
    "pit_depth": "m", "pit_radius": "m", "pit_volume": "m3", "plastic_strain_peak": "1", "plastic_work": "J",
    "work_on_solid": "J", "surface_still": "1",
}
"""What is kept of a hit, with units of axisymmetric runs; `plastic_work` and `work_on_solid` are of that hit alone."""


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
    - `solid`: changes of the `[solid]` table for all hits, with the keys of `Case.with_` below it. Another law takes the whole table:
      `{"plasticity": {"law": "perfect", "yield_strength": 4e8}}`, as keys of the old one may have no say in it.
    - `longest`: how long a hit may take to become still, s; without it a hit ends with its record. One shorter than the record cuts
      the load off, which is warned of.
    - `threads`: of each run. `progress`: called with the number of the hit and its result.

    Returns a dataset over `hit` from 1 to n: pit_depth, pit_radius (m), pit_volume (m³; planar: m²), plastic_strain_peak,
    plastic_work, work_on_solid (J, planar: J/m, of the hit), surface_still, directory. Variables carry `units` and `long_name`, the
    dataset version, revision, case of the load, its hash and date. Raises `ValueError` for a run without a wall that yields, for one
    that has not reached its end, and for an `out` that is the run's own directory.
    """
    n = _number_of_hits(n)
    longest = None if longest is None else positive("longest", longest, "s")
    threads, root = count("threads", threads), Path(out)
    if not isinstance(case, Case) and root.resolve() == open_run(case).directory.resolve():
        raise ValueError(f"out = {root} is the directory of the run that gives the load: the hits need one of their own")
    root.mkdir(parents=True, exist_ok=True)
    loading = _loading(case, root / "load", threads)
    if longest is not None and longest < (recorded := _recorded(loading)):
        warnings.warn(f"longest = {longest:g} s ends each hit before its load, which was recorded for {recorded:g} s: "
                      "what the rest of it does to the wall is missing", stacklevel=2)
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
        name: ("hit", [_number(result.summary.get(name)) for result in results],
               {"units": unit_in(loading.parameters, unit), "long_name": _words(name)})
        for name, unit in MEASURES.items()}
    values["directory"] = ("hit", np.array([str(result.directory) for result in results], dtype=object), {"long_name": "directory"})
    places = ("hit", np.arange(1, n + 1), {"units": "1", "long_name": "number of the hit"})
    # Program and revision of the hits, and the case whose load it is.
    attributes = provenance(
        f"hits on the wall of {loading.case.name}", "pycav.hits", results[0].histories.attrs, case_name=loading.case.name,
        case_hash=loading.case.hash, case=loading.case.to_toml(), load=str(loading.directory))
    return xarray.Dataset(values, {"hit": places}, attributes)


def _number_of_hits(n: Any) -> int:
    if isinstance(n, bool) or not isinstance(n, numbers.Integral):
        raise TypeError(f"n = {n!r} is a {type(n).__name__}: give a whole number of hits, 1 or more")
    if n < 1:
        raise ValueError(f"n = {n}: give 1 hit or more")
    return int(n)


def _recorded(loading: Result) -> float:
    """The last time of the load that a run has recorded, s."""
    times = loading.histories.get("interface/time")
    return 0.0 if times is None or not len(times) else float(times[-1])


def _words(name: str) -> str:
    return "work of the load on the solid" if name == "work_on_solid" else words(name)


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
