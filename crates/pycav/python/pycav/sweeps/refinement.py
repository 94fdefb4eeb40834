"""New points where a map bends."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray

from ..mesh import Floats
from .dataset import COMPLETE, FAILED, LEFT_OUT, case_of, numeric, opened, parameters
from .points import STAND_OFF, Point
from .runs import sweep

DIGITS = 4
"""Significant digits of a new value, so that it can be read."""


class Bend(NamedTuple):
    """An interval between two neighbouring values of a parameter, and how far off a straight line is within it."""

    axis: str
    """The parameter."""
    low: float
    """Where the interval begins."""
    high: float
    """Where it ends."""
    middle: float
    """The value in between that `refine` runs; of whole numbers a whole one, which is one of the ends where there is none in between."""
    error: float
    """Of linear interpolation, over the quantity's range in the map."""


def bends(
    data: xarray.Dataset | str | os.PathLike[str],
    quantity: str = "pit_depth",
    *,
    along: Sequence[str] | None = None,
    logarithmic: bool = False,
) -> list[Bend]:
    """The intervals of a map's numeric parameters, the worst interpolated first.

    Within an interval of length h linear interpolation is off by at most h² max|f''|/8. f'' is the second divided difference at the
    interval's ends, the larger one of the two; at the edge of the map there is one. The error is the largest over all other
    parameters, divided by the range of f. With two values only, half of the change counts. Parameters whose values
    grow by factors are taken in their logarithm. Where all values of a parameter are whole numbers (`int`) new ones are, too; a
    `stand_off` is a real number however it is written.

    - `logarithmic`: f is the logarithm of the quantity, for one that spans decades; values that are not positive are left out.
    """
    data = opened(data)
    chosen = numeric(data) if along is None else list(along)
    wrong = [name for name in chosen if name not in numeric(data)]
    if wrong or not chosen:
        raise ValueError(f"a map is refined along numbers of two values or more, which are {', '.join(numeric(data)) or 'none here'}, "
                         f"not along {', '.join(wrong) or 'nothing'}")
    return sorted((bend for name in chosen for bend, _ in _along(data, quantity, name, logarithmic)),
                  key=lambda bend: bend.error, reverse=True)


def refine(
    data: xarray.Dataset | str | os.PathLike[str],
    quantity: str = "pit_depth",
    *,
    along: Sequence[str] | None = None,
    values: int = 1,
    tolerance: float = 0.02,
    logarithmic: bool = False,
    everywhere: bool = True,
    out: str | os.PathLike[str] | None = None,
    **options: Any,
) -> xarray.Dataset:
    """Puts new values into the intervals of a map where the quantity bends most, and runs what is missing.

    What comes back is a sweep over the old and the new values, in the same directory: what is done there is not run again. Several
    calls in a row go on where the map then bends most. Where no interval is worse than the tolerance the map comes back as it was.

    - `data`: a dataset of `sweep`, or the file of one.
    - `quantity`, `along`, `logarithmic`: as of `bends`.
    - `values`: how many new values at most, in all parameters together.
    - `tolerance`: intervals count whose interpolation error is more than this share of the quantity's range.
    - `everywhere`: run every combination of a new value with the others; else only those where the quantity bends by more than the
      tolerance, and the others are NaN with `status` 2.
    - `out`: the directory of the runs, if it is not that of the map.
    - `options`: those of `sweep`; `measure` and `change` have to be those of the map.
    """
    data = opened(data)
    case = case_of(data)
    found = bends(data, quantity, along=along, logarithmic=logarithmic)
    worst = [bend for bend in found if bend.error > tolerance and bend.low < bend.middle < bend.high][:values]
    known = parameters(data)
    wanted = {name: _merged(own, [bend.middle for bend in worst if bend.axis == name]) for name, own in known.items()}
    counts = _Counts(data, known, {} if everywhere else _bent(data, quantity, worst, logarithmic, tolerance), everywhere)
    return sweep(case, wanted, data.attrs["out"] if out is None else out, **{"where": counts, **options})


class _Counts:
    """Whether a point is run: what the map had, and of the new ones those that are wanted."""

    def __init__(self, data: xarray.Dataset, known: Mapping[str, list[Any]], bent: Mapping[tuple[str, float], set[Any]], all_new: bool) -> None:
        self.known, self.bent, self.all_new = known, bent, all_new
        order = list(known)
        status = data["status"].transpose(*order).to_numpy()
        self.had = {index for index in np.ndindex(status.shape) if status[index] in (COMPLETE, FAILED)}

    def __call__(self, point: Point) -> bool:
        index = {name: values.index(point[name]) if point[name] in values else None for name, values in self.known.items()}
        fresh = [name for name, place in index.items() if place is None]
        if not fresh:
            return tuple(index.values()) in self.had
        if self.all_new:
            return True
        return all(_others(index, name) in self.bent.get((name, float(point[name])), set()) for name in fresh)


def _others(index: Mapping[str, int | None], left: str) -> tuple[int | None, ...]:
    return tuple(place for name, place in index.items() if name != left)


def _bent(data: xarray.Dataset, quantity: str, worst: Sequence[Bend], logarithmic: bool, tolerance: float) -> dict[tuple[str, float], set[Any]]:
    """Where, in the other parameters, an interval is worse than the tolerance."""
    found: dict[tuple[str, float], set[Any]] = {}
    for bend in worst:
        own = next(error for other, error in _along(data, quantity, bend.axis, logarithmic) if other.low == bend.low)
        found[bend.axis, bend.middle] = {tuple(index) for index in np.argwhere(own > tolerance).tolist()}
    return found


def _merged(old: Sequence[Any], new: Sequence[float]) -> list[Any]:
    return sorted([*old, *new]) if new else list(old)


def _along(data: xarray.Dataset, quantity: str, axis: str, logarithmic: bool) -> list[tuple[Bend, Floats]]:
    """The intervals of a parameter, each with its error over the other parameters in their order."""
    if quantity not in data:
        raise ValueError(f"the map has no {quantity}, only {', '.join(map(str, data.data_vars))}")
    others = [str(name) for name in data[quantity].dims if name != axis]
    own = data[quantity].where(data["status"] != LEFT_OUT).transpose(axis, *others).sortby(axis)
    x, f = own[axis].to_numpy().astype(float), own.to_numpy().astype(float)
    if logarithmic:
        f = np.log(np.where(f > 0, f, np.nan))
    geometric = _grows_by_factors(x)
    place = np.log(x) if geometric else x
    whole = axis != STAND_OFF and own[axis].dtype.kind in "iu"
    spread = float(np.nanmax(f) - np.nanmin(f)) if np.isfinite(f).any() else 0.0
    errors = _errors(place, f) / spread if spread > 0 else np.zeros((len(x) - 1, *f.shape[1:]))
    rows = []
    for k, error in enumerate(errors):
        middle = float(np.exp(0.5 * (place[k] + place[k + 1]))) if geometric else 0.5 * float(x[k] + x[k + 1])
        middle = float(f"{middle:.{DIGITS}g}")
        largest = float(np.nanmax(error)) if np.isfinite(error).any() else 0.0
        rows.append((Bend(axis, float(x[k]), float(x[k + 1]), round(middle) if whole else middle, largest), np.asarray(np.nan_to_num(error))))
    return rows


def _errors(x: Floats, f: Floats) -> Floats:
    """h² |f''|/8 of each interval, shape (intervals, ...): NaN where too little is known."""
    step = np.diff(x).reshape(-1, *[1] * (f.ndim - 1))
    if len(x) == 2:
        return np.asarray(0.5 * np.abs(np.diff(f, axis=0)))
    slope = np.diff(f, axis=0) / step
    second = np.abs(2.0 * np.diff(slope, axis=0) / (step[1:] + step[:-1]))
    ends = np.full((2, *slope.shape), np.nan)
    ends[0, 1:], ends[1, :-1] = second, second
    return np.asarray(step**2 / 8.0 * np.fmax(ends[0], ends[1]))


def _grows_by_factors(x: Floats) -> bool:
    """Whether the logarithms of the values are spaced more evenly than the values."""
    if x[0] <= 0 or len(x) < 3:
        return False
    linear, factor = np.diff(x), np.diff(np.log(x))
    return bool(np.std(factor) / np.mean(factor) < np.std(linear) / np.mean(linear))
