"""Functions of time as tables that are linear in between."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]
Function = Callable[[Floats], ArrayLike]

PARTS = 1 << 15
"""Equal parts of the span that a function is looked at in, at their ends and three times within each."""
QUARTERINGS = 10
"""How often a part may be cut in four. A function that is still not straight in it jumps."""
MOST = 1 << 20
"""Times that a function may need."""


def table(function: Function, end: float, tolerance: float) -> Floats:
    """Rows (time, value), from 0 to `end`, between which the function is linear but for `tolerance` times its range.

    The function is looked at in `4 PARTS` equal steps, and where it bends in ever smaller ones. `ValueError` where it jumps
    or is not finite.
    """
    if not 0.0 < tolerance < 1.0:
        raise ValueError(f"a tolerance is between 0 and 1, not {tolerance:g}")
    times, values = _dense(function, end, 0.5 * tolerance)
    kept = _corners(times, values, 0.5 * tolerance * float(np.ptp(values)))
    return np.column_stack([times[kept], values[kept]])


def _dense(function: Function, end: float, tolerance: float) -> tuple[Floats, Floats]:
    """Times so close that the function is straight between them, and its values there."""
    times = np.linspace(0.0, end, PARTS + 1)
    values = _ask(function, times)
    # The parts that are to be looked at: their ends, and the values there.
    ends, at_ends = np.stack([times[:-1], times[1:]], 1), np.stack([values[:-1], values[1:]], 1)
    for _ in range(QUARTERINGS + 1):
        inner = ends[:, :1] + np.diff(ends) * [0.25, 0.5, 0.75]
        found = _ask(function, inner.ravel()).reshape(inner.shape)
        bend = np.abs(found - (at_ends[:, :1] + np.diff(at_ends) * [0.25, 0.5, 0.75])).max(1)
        bent = bend > tolerance * max(float(np.ptp(values)), float(np.ptp(found)))
        if not bent.any():
            order = np.argsort(times)
            return times[order], values[order]
        times, values = np.append(times, inner[bent]), np.append(values, found[bent])
        cut, at_cut = (np.concatenate([one[bent, :1], middle[bent], one[bent, 1:]], 1)
                       for one, middle in ((ends, inner), (at_ends, found)))
        ends, at_ends = (np.stack([row[:, :-1].ravel(), row[:, 1:].ravel()], 1) for row in (cut, at_cut))
        if len(times) > MOST:
            raise ValueError(f"a table of the function needs more than {MOST:,} times: give `times`, or a larger tolerance")
    jump = ends[np.argmax(np.abs(np.diff(at_ends)))].mean()
    raise ValueError(f"the function jumps at t = {jump:.9g} s, and a history is linear in between: let it rise within some "
                     "time, or give `times`")


def _ask(function: Function, times: Floats) -> Floats:
    values = np.broadcast_to(np.asarray(function(times), float), times.shape)
    if not np.isfinite(values).all():
        raise ValueError(f"the function's value at t = {times[~np.isfinite(values)][0]:.9g} s is not finite")
    return values


def _corners(times: Floats, values: Floats, allowed: float) -> list[int]:
    """Some of the rows, the first and the last among them, between which all others lie on straight lines but for `allowed`."""
    kept, t, v = [0], times.tolist(), values.tolist()
    low, high = -np.inf, np.inf  # slopes from the last corner that leave no row between too far off
    for k in range(1, len(t)):
        start = kept[-1]
        slope = (v[k] - v[start]) / (t[k] - t[start])
        if not low <= slope <= high:
            kept.append(start := k - 1)
            low, high = -np.inf, np.inf
        low = max(low, (v[k] - allowed - v[start]) / (t[k] - t[start]))
        high = min(high, (v[k] + allowed - v[start]) / (t[k] - t[start]))
    return [*kept, len(t) - 1]
