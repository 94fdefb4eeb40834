"""A run in this process, step by step."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Mapping
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from . import _pycav
from ._given import Named, count, number
from ._native import Native
from .case import Case, checked
from .cells import Array, Cells

if TYPE_CHECKING:
    import xarray

    from .result import Result

ROUNDING = 1e-9
"""Share of the simulated time by which one asked for may be past, as sums of steps are off by some of it."""

InitialState = Callable[[Array, Array], Mapping[str, ArrayLike]]


class Simulation:
    """A case that is run in this process, at the speed of the command line.

    - `out`: a run directory, which is then written as `cav run` writes it; without one nothing is written and
      histories stay in memory. `force` replaces a finished run.
    - `threads`: of the solvers; all processors if `None`.
    - `fluid_initial`, `solid_initial`: functions of arrays z, r (cell centres, m, one dimension) that take the place of the
      case's initial state. They return a dictionary of arrays or numbers: for the fluid `density` and `pressure`, and if
      they are not zero `velocity_z`, `velocity_r`, `gas_fraction`; for the solid `velocity_z`, `velocity_r`, `stress_zz`,
      `stress_zr`, `stress_rr`, `stress_phiphi`, each zero if left out.

    The interpreter is free while steps are made; Ctrl-C stops after the step under way, and the simulation can go on from
    there. A run directory gets checkpoints as by `cav run`: every five minutes, and when the run is broken off. After an
    exception of the solver (`pycav.NumericalError`) it is closed.
    """

    def __init__(
        self,
        case: Case,
        *,
        out: str | os.PathLike[str] | None = None,
        force: bool = False,
        threads: int | None = None,
        fluid_initial: InitialState | None = None,
        solid_initial: InitialState | None = None,
    ) -> None:
        self.case = checked(case)
        self._native = _pycav.Simulation(
            self.case._native, None if out is None else os.fspath(out), force, count("threads", threads), fluid_initial, solid_initial
        )

    time: Native[float] = Native("Simulated time, s.")
    dt: Native[float] = Native("Length of the last step, s; 0 before the first.")
    steps: Native[int] = Native("Steps made.", "steps_made")
    completed: Native[bool] = Native("Whether the case's end is reached.")
    closed: Native[bool] = Native("Whether no more steps can be made.")

    @property
    def directory(self) -> Path | None:
        """The run directory."""
        directory = self._native.directory
        return None if directory is None else Path(directory)

    def step(self) -> bool:
        """Makes one step of all media; `False` if there was none left to make."""
        return self._native.step()

    def advance_to(self, time: float) -> None:
        """Makes steps until `time` in s, at which the last one ends.

        The step that lands there is shortened, so the run is not bit for bit the one without it. `ValueError` for a time that is past,
        or after the end of the run.
        """
        wanted = number("time", time, "s")
        if wanted < self.time * (1.0 - ROUNDING):
            raise ValueError(f"time = {wanted:g} s is before {self.time:g} s, which the simulation has reached: no run goes back; "
                             "make a new Simulation for an earlier state")
        self._native.advance_to(wanted)

    def run(self, callback: Callable[[Simulation], object] | None = None, progress: bool = False) -> None:
        """Makes all steps that are left.

        - `callback`: called with the simulation after every step; what it raises ends the call and is passed on.
        - `progress`: a bar on the standard error.
        """
        self._native.run_to_end(None if callback is None else lambda: callback(self), progress)

    def fields(self, medium: str) -> Cells:
        """The leaf cells of a medium, "fluid" or "solid", with its fields: copies of shape (cells,).

        The fluid's temperature, tracer and vapour are not among them: snapshots have them.
        """
        return Cells(self._native.cells(medium), self.time)

    def sample(self, medium: str, z: ArrayLike, r: ArrayLike) -> dict[str, Array]:
        """A medium on the grid of the coordinates `z` and `r` in m: arrays of shape (len(z), len(r)), NaN outside.

        Values are those of the linear reconstruction in the cell that holds the point. They are those of the state alone; temperature,
        tracer, vapour and plastic strain are in snapshots.
        """
        along_z, along_r = (np.atleast_1d(np.asarray(x, float)) for x in (z, r))
        return self._native.sample(medium, along_z, along_r)

    @property
    def histories(self) -> xarray.Dataset:
        """The histories so far, as `pycav.open(...).histories` has them."""
        from .histories import from_columns, from_files

        directory = self.directory
        if directory is None:
            return from_columns(self._native.columns())
        if not self.closed:
            self._native.flush()
        return from_files([directory / f"{medium}.h5" for medium in self.case.media])

    @property
    def probes(self) -> dict[str, xarray.Dataset]:
        """The histories of the case's probes so far, by name."""
        from .histories import probes

        return probes(self.histories)

    @property
    def summary(self) -> dict[str, Any]:
        """The numbers one asks for first, as in `summary.json`, as far as they are known."""
        return Named("the summary has no", json.loads(self._native.summary()))

    @property
    def result(self) -> Result:
        """What the run directory holds."""
        from .result import Result

        if self.directory is None:
            raise ValueError("the simulation writes nothing: give it a run directory, Simulation(case, out=...)")
        return Result(self.directory)

    def close(self) -> None:
        """Ends a run that is not to go on and closes its files; `summary["completed"]` stays `False`.

        A run directory keeps a checkpoint: `cav run --resume DIR` goes on from it, and not from what Python made of the initial state.
        """
        self._native.close()

    def __enter__(self) -> Simulation:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<pycav.Simulation of {self.case.name!r} at {self.time:.6g} s of {self.case.end:g} s>"
