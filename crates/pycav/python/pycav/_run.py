"""Whole runs."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from . import _pycav
from ._given import count
from ._program import PROGRAM
from .case import Case, checked
from .result import Result
from .simulation import Simulation


def run(
    case: Case,
    out: str | os.PathLike[str] | None = None,
    *,
    processes: bool = False,
    force: bool = False,
    threads: int | None = None,
    callback: Callable[[Simulation], object] | None = None,
    progress: bool = False,
) -> Result:
    """Runs a case to its end and returns what it left.

    - `out`: the run directory; else the case's own, else `runs/NAME`.
    - `processes`: fluid and solid in two processes, as `cav run` does it; otherwise both in this one. Same numbers, bit
      for bit.
    - `force`: replace a finished run, which is refused otherwise.
    - `threads`: of each process; all processors if `None`.
    - `callback`: in this process only: called with the `Simulation` after every step.

    Raises `pycav.RunError` or one of its kinds; what was computed is written in any case.
    """
    case, threads = checked(case), count("threads", threads)
    if not processes or len(case.media) < 2:
        with Simulation(case, out=_directory(case, out), force=force, threads=threads) as simulation:
            simulation.run(callback, progress)
            return simulation.result
    if callback is not None:
        raise ValueError("two other processes make the steps: a callback needs processes=False")
    with tempfile.TemporaryDirectory(prefix="pycav-") as place:
        path = Path(place) / f"{case.name}.toml"
        path.write_text(case._native.text)
        return Result(Path(_pycav.run_in_processes(
            case._native, str(path), PROGRAM, None if out is None else os.fspath(out), force, threads, progress)))


def resume(
    directory: str | os.PathLike[str], *, end: float | None = None, processes: bool = False, threads: int | None = None,
    progress: bool = False,
) -> Result:
    """Goes on with a run that was stopped or killed, from its newest checkpoint, and returns what it left.

    What `cav run --resume` does: the numbers are those of a run that nothing has happened to, bit for bit. Without a checkpoint yet it
    begins again; one that is finished stays as it is, or goes on to a later end.

    - `directory`: of the run; its case is there.
    - `end`: when it is to end, s, later than its case says; snapshots go on in their interval.
    - `processes`, `threads`, `progress`: as in `pycav.run`; they need not be those that the run began with.

    Raises `pycav.RunError` if it is no run's directory, if its case was changed, if no checkpoint can be used, or if it ends no earlier;
    else as `pycav.run`.
    """
    return Result(Path(_pycav.resume(os.fspath(directory), PROGRAM, end, processes, count("threads", threads), progress)))


def _directory(case: Case, out: str | os.PathLike[str] | None) -> str:
    return os.fspath(out) if out is not None else case._native.directory
