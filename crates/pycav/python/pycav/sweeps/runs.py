"""Parameter sweeps: a run for every point of a grid of parameters."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future, as_completed
from pathlib import Path
from typing import TYPE_CHECKING, Any

import xarray

from .._given import count
from .._pycav import RunError
from ..case import Case, Material, checked
from ..case import materials as library
from ..result import Result
from .cost import Cost
from .dataset import FAILED, attributes, gather, opened, save_map
from .executors import opened as executor_of
from .measures import Measure, measured, measures
from .points import STAND_OFF, Axes, Change, Point, at_point
from .progress import DONE, KNOWN, Display
from .work import Ended, Job, do, is_complete, is_finished

if TYPE_CHECKING:
    import pandas

NOT_RUN = "not run: the sweep was stopped before"


def sweep(
    case: Case,
    parameters: Mapping[str, Sequence[Any]],
    out: str | os.PathLike[str],
    *,
    executor: Any = None,
    workers: int | None = None,
    threads: int | None = None,
    measure: Measure = measures,
    progress: Callable[[Point, str], object] | bool | None = None,
    change: Change | None = None,
    where: Callable[[Point], bool] | None = None,
    to: str | os.PathLike[str] | None = None,
    force: bool = False,
) -> xarray.Dataset:
    """Runs a case at every combination of parameters and returns what was measured, over the parameters.

    - `parameters`: values by key, the keys of `Case.with_`; besides `stand_off`, the distance of the centre of the first region,
      or of the bubble of `[fluid.bubble]`, from the wall over its radius, which moves it along z. That is the largest radius: a bubble
      of `[fluid.bubble]` that grows first is refused, as its case does not have it.
    - `out`: a directory; every point has a run directory of its own in it. A point that is complete there is not run again,
      and one that has a checkpoint goes on from it, so a sweep that was stopped goes on where it was.
    - `executor`: `"threads"`, `"processes"` or `"dask"` on this machine, a Dask client or cluster, or whatever implements
      `concurrent.futures.Executor`. Without one the points are run one after the other, here.
    - `workers`: how many points at a time, of an executor that is made here; all processors if left out.
    - `threads`: of each run. All processors if left out, 1 with an executor that is made here.
    - `measure`: a function of a point's `Result` that returns what is kept of it, value and unit by name:
      `lambda run: {"depth": (run.summary["pit_depth"], "m")}`. The summary's numbers and those of the discs if left out.
    - `progress`: on standard error a bar, or lines where there is no terminal, with the cost, the time left and what failed;
      nothing with `False`. A function is called with every point and "known", "done" or the error, instead.
    - `change`: a function of a point that returns what else changes with it: `lambda point: {"time.end": ...}`.
    - `where`: which points count; the others are not run, are NaN, and have the `status` 2.
    - `to`: a file, `.nc` or `.zarr`, that gets the dataset with its provenance, also when the sweep is stopped.
    - `force`: replace finished runs of other cases in the points' directories. Without it they are refused by a `pycav.RunError`
      before anything runs. Runs of other cases that are not finished are replaced in any case.

    A point that fails is NaN, and its error is in the variable `error`; the other points are not affected. If not one point makes a
    case, as with a misspelt key, the first one's error is raised. `status` is 0 for a
    complete run, 1 for one that failed. Variables carry `units` and `long_name`, the dataset version, revision, case, its hash
    and date; coordinates are the parameters (a table, as a material of its own, by its number in the list). Truth values are found by
    themselves, `data.sel({"time.local_steps": True})`, and beside other values as "true" and "false".
    """
    case, axes, root = checked(case), Axes(parameters), Path(out)
    if to is not None and Path(to).suffix not in (".nc", ".zarr"):
        raise ValueError(f"a map is written as .nc or .zarr, not as {Path(to).name}")
    places, threads, workers = axes.places(root), count("threads", threads), count("workers", workers)
    if threads is None and (workers is not None or isinstance(executor, str)):
        threads = 1
    errors: list[str] = [""] * len(axes.points)
    left_out = {number for number, point in enumerate(axes.points) if where is not None and not where(point)}
    cases = _cases(case, axes, change, left_out, errors)
    known = {number for number, own in cases.items() if is_complete(places[number], own)}
    others = [places[number] for number in cases if number not in known and is_finished(places[number])]
    if others and not force:
        held = "holds a finished run of another case" if len(others) == 1 else f"and {len(others) - 1} more hold finished runs of other cases"
        raise RunError(f"{others[0]} {held}: give another out, or replace what is there with force=True")
    root.mkdir(parents=True, exist_ok=True)
    found = {number: measured(measure, places[number]) for number in sorted(known)}
    jobs = [Job(number, own.to_toml(), own.name, str(places[number]), threads)
            for number, own in cases.items() if number not in known]
    display = None if callable(progress) or progress is False else _display(axes, cases, known, places, left_out)

    def ended(number: int, how: str) -> None:
        if callable(progress):
            progress(axes.points[number], errors[number] or how)
        elif display is not None:
            display.ended(number, axes.points[number], how, errors[number])

    for number in range(len(axes.points)):
        if number in known or errors[number]:
            ended(number, KNOWN)
    for job in jobs:
        errors[job.number] = NOT_RUN
    try:
        with executor_of(executor, workers) as pool:
            for number, result in _run_all(jobs, pool):
                errors[number] = result.error
                if not result.error:
                    found[number] = measured(measure, places[number])
                ended(number, DONE)
    finally:
        if display is not None:
            display.close()
        # Also of a sweep that was stopped: what is there is worth keeping.
        unrun = {number for number, error in enumerate(errors) if error == NOT_RUN}
        data = gather(axes, places, errors, left_out | unrun, found)
        data.attrs = attributes(case, axes, root, places)
        if to is not None:
            save_map(data, to)
    return data


def _cases(case: Case, axes: Axes, change: Change | None, left_out: set[int], errors: list[str]) -> dict[int, Case]:
    """The case of each point that counts; what is wrong with one becomes its error, and is raised if not one makes a case."""
    cases: dict[int, Case] = {}
    first: Exception | None = None
    for number, point in enumerate(axes.points):
        if number in left_out:
            continue
        try:
            cases[number] = at_point(case, point, change)
        except (ValueError, TypeError, KeyError) as error:
            errors[number] = f"{type(error).__name__}: {error}"
            first = first or error
    # As by a misspelt key: nothing will be run, so nothing is lost.
    if first is not None and not cases:
        raise first
    return cases


def _display(axes: Axes, cases: Mapping[int, Case], known: set[int], places: Sequence[Path], left_out: set[int]) -> Display:
    costs = {number: Cost(own) for number, own in cases.items()}
    seconds = [(costs[number].work, float(Result(places[number]).summary.get("wall_seconds") or 0.0)) for number in known]
    left = {number: cost for number, cost in costs.items() if number not in known}
    return Display({number: cost.work for number, cost in left.items()}, len(axes.points) - len(left_out),
                   sum(cost.seconds for cost in left.values()), seconds)


def _run_all(jobs: Sequence[Job], pool: Any) -> Any:
    """Number and end of each point, in the order in which they end."""
    if pool is None:
        for job in jobs:
            yield job.number, do(job)
        return
    waiting: dict[Future[Ended], int] = {pool.submit(do, job): job.number for job in jobs}
    try:
        for future in as_completed(waiting):
            failure = future.exception()
            told = future.result() if failure is None else Ended(f"{type(failure).__name__}: {failure}", 0.0)
            yield waiting[future], told
    finally:
        for future in waiting:
            future.cancel()


def failures(data: xarray.Dataset | str | os.PathLike[str]) -> pandas.DataFrame:
    """The points of a map that failed, a row for each: its parameters, `error` and `directory`."""
    table = opened(data)[["status", "error", "directory"]].to_dataframe().reset_index()
    return table[table["status"] == FAILED].drop(columns="status").reset_index(drop=True)


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
