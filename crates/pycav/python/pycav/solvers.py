"""The two solvers alone, each with its surface driven from Python."""

from __future__ import annotations

import reprlib

import numpy as np
from numpy.typing import ArrayLike

from . import _pycav
from ._given import count
from ._native import Native
from .case import Case, checked
from .cells import Array, Cells
from .simulation import InitialState


def _faces(values: ArrayLike | None, count: int) -> Array | None:
    if values is None:
        return None
    given = np.asarray(values, float)
    return np.full(count, float(given)) if given.ndim == 0 else np.ascontiguousarray(given)


class _Solver:
    _native: _pycav.FluidSolver | _pycav.SolidSolver

    time: Native[float] = Native("s")
    steps: Native[int] = Native("Steps made.")
    surface_edges: Native[Array] = Native(
        "Outer radii of the faces of the surface, m, ascending, shape (faces,). They change when the grid adapts.")

    def time_step_limit(self) -> float:
        """The longest step that the case's Courant number allows, s."""
        return self._native.time_step_limit()

    def trace(self, dt: float) -> dict[str, Array]:
        """The medium's own state on the surface in the middle of a step of length `dt`, arrays of shape (faces,).

        `pressure` (the solid's −σ_zz, Pa), `velocity` (along +z, m/s), `impedance` (Pa s/m); the fluid's `density`,
        `gamma`, `pi`, the solid's `shear`.
        """
        return self._native.trace(dt)

    def step(
        self,
        dt: float,
        *,
        pressure: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        power: ArrayLike | None = None,
    ) -> None:
        """Makes a step of length `dt` in s with the surface's state as means over the step, face by face or one number.

        - `pressure`: −σ_zz on the surface, Pa; `velocity`: along +z, m/s. Of one alone the other follows from the wave that
          runs into the medium; both are taken as they are: the star state of a coupling of your own.
        - One of pressure and velocity is needed where the medium has a surface.
        - `power`: mean of pressure times velocity, W/m², only with both; their product if left out.
        - errors: ValueError for a `dt` with a Courant number above 0.5 (or the case's `time.cfl`, if that is more): `time_step_limit()` is
          always taken.
        """
        count = len(self.surface_edges)
        for name, values in {"pressure": pressure, "velocity": velocity, "power": power}.items():
            if count == 0 and values is not None and np.size(values):
                raise ValueError(f"{name} = {reprlib.repr(values)}: the case couples its fluid to no solid (a rigid wall is none), "
                                 "so it has no surface; give dt alone")
        self._native.step(dt, *(_faces(values, count) for values in (pressure, velocity, power)))

    def fields(self) -> Cells:
        """The leaf cells and what is in them: copies of shape (cells,)."""
        return Cells(self._native.cells(), self.time)

    def sample(self, z: ArrayLike, r: ArrayLike) -> dict[str, Array]:
        """On the grid of `z` and `r` in m: arrays of shape (len(z), len(r)), NaN outside."""
        return self._native.sample(*(np.atleast_1d(np.asarray(x, float)) for x in (z, r)))


class FluidSolver(_Solver):
    """The fluid of a case above a surface that Python moves or presses on.

    Where the case couples the fluid to a solid, its place below z_min is taken by what `step` is given; in other cases
    there is no surface, and `step(dt)` needs nothing.
    """

    _native: _pycav.FluidSolver

    def __init__(self, case: Case, *, initial: InitialState | None = None, threads: int | None = None) -> None:
        self._native = _pycav.FluidSolver(checked(case)._native, initial, count("threads", threads))

    surface_pressure: Native[Array] = Native("Pressure on the surface during the last step, Pa, shape (faces,).")
    equivalent_radius: Native[float] = Native("Radius of the ball of the gas's volume, m.")


class SolidSolver(_Solver):
    """The solid of a case under a surface that Python moves or presses on, in the place of the case's fluid."""

    _native: _pycav.SolidSolver

    def __init__(self, case: Case, *, initial: InitialState | None = None, threads: int | None = None) -> None:
        self._native = _pycav.SolidSolver(checked(case)._native, initial, count("threads", threads))

    surface_velocity: Native[Array] = Native("Velocity of the surface during the last step along +z, m/s, shape (faces,).")
