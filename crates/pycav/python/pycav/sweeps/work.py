"""One point of a sweep, run wherever an executor likes."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import NamedTuple

import h5py

from .. import _pycav
from .._pycav import RunError
from .._run import resume, run
from ..case import Case
from ..histories import text as plain

ERROR = "error.json"


class Job(NamedTuple):
    """A point that has to be run; everything in it can be sent to another machine."""

    number: int
    case: str
    name: str
    place: str
    threads: int | None


class Ended(NamedTuple):
    """How a point ended: its error, "" if there is none, and how long it took."""

    error: str
    seconds: float


def do(job: Job) -> Ended:
    """Runs a point; one that was stopped goes on from its newest checkpoint."""
    begun, place = time.monotonic(), Path(job.place)
    note = place.with_name(f"{place.name}.{ERROR}")
    try:
        case = Case.from_toml(job.case, job.name)
        if not (_goes_on(place, case) and _resume(place, job.threads)):
            run(case, place, threads=job.threads, force=True)
    except Exception as error:
        message = f"{type(error).__name__}: {error}"
        note.write_text(json.dumps({"error": message}))
        return Ended(message, time.monotonic() - begun)
    note.unlink(missing_ok=True)
    return Ended("", time.monotonic() - begun)


def is_complete(place: Path, case: Case) -> bool:
    """Whether the run of just this case is there and reached its end."""
    try:
        return is_finished(place) and _hash(place) == case.hash
    except (OSError, StopIteration):
        return False


def is_finished(place: Path) -> bool:
    """Whether a run, of whatever case, is there and reached its end."""
    return _pycav.run_state(place) == "finished"


def _hash(place: Path) -> str:
    """The hash of the case that a run has made."""
    path = next(path for path in (place / "fluid.h5", place / "solid.h5", place / "history.h5") if path.exists())
    with h5py.File(path, "r") as file:
        return str(plain(file.attrs.get("case_hash", "")))


def _goes_on(place: Path, case: Case) -> bool:
    """Whether an unfinished run of just this case has left a checkpoint."""
    if not any((place / "checkpoints").glob("*.ckpt")):
        return False
    try:
        left = Case.from_toml((place / "case.toml").read_text(), case.name)
        return left.hash == case.hash and _ended_well(place)
    except (OSError, ValueError):
        return False


def _ended_well(place: Path) -> bool:
    """A run that failed would fail again from the same state; it begins anew."""
    try:
        return not json.loads((place / "summary.json").read_text()).get("error")
    except (OSError, ValueError):
        return True


def _resume(place: Path, threads: int | None) -> bool:
    """Goes on with a run; whether that has reached the end."""
    try:
        resume(place, threads=threads)
    except RunError:
        return False
    return True
