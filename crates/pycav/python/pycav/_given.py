"""What is given, checked: errors name the argument, the value, and what is allowed."""

from __future__ import annotations

import difflib
import math
import numbers
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

V = TypeVar("V")

BEYOND = 0.01
"""How far beyond the times that there are one may be, in parts of their span, before it is warned of."""


def number(name: str, value: Any, unit: str = "") -> float:
    """A finite number."""
    wanted = f"give a finite number in {unit}" if unit else "give a finite number"
    if getattr(value, "ndim", None) == 0:
        value = value.item()
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise TypeError(f"{name} = {value!r} is a {type(value).__name__}: {wanted}")
    if not math.isfinite(value):
        raise ValueError(f"{name} = {value}: {wanted}")
    return float(value)


def positive(name: str, value: Any, unit: str = "") -> float:
    """A finite number above 0."""
    found = number(name, value, unit)
    if found <= 0:
        raise ValueError(f"{name} = {value}: give a number above 0" + (f" in {unit}" if unit else ""))
    return found


def count(name: str, value: Any) -> int | None:
    """A whole number above 0, or `None` for all processors."""
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, numbers.Integral) or value < 1:
        raise ValueError(f"{name} = {value!r}: give a whole number above 0, or None for all processors")
    return int(value)


def window(given: Any, low: Iterable[float], high: Iterable[float]) -> tuple[float, float, float]:
    """A window (z_low, z_high, r_high) in m that holds something of a domain with the corners (z, r) `low` and `high`."""
    if isinstance(given, str) or not np.iterable(given) or len(list(given)) != 3:
        raise TypeError(f"window = {given!r}: give three numbers in m, (z_low, z_high, r_high)")
    z_low, z_high, r_high = (number(f"window[{place}]", value, "m") for place, value in enumerate(given))
    (left, near), (right, far) = low, high
    if not z_low < z_high:
        raise ValueError(f"window = {given!r}: z_low has to be below z_high")
    if not (z_low < right and z_high > left and r_high > near):
        raise ValueError(f"window = {given!r} holds nothing of the run, which has z from {left:g} to {right:g} m and r from {near:g} to {far:g} m")
    return z_low, z_high, r_high


def nearest_time(times: NDArray[np.float64], time: Any) -> int:
    """The place of the time that is nearest to one in s, with a warning where that lies beyond them all."""
    wanted = number("time", time, "s")
    first, last = float(times[0]), float(times[-1])
    found = int(np.argmin(np.abs(times - wanted)))
    if not -BEYOND * (last - first) <= wanted - first <= (1 + BEYOND) * (last - first):
        warnings.warn(f"time = {wanted:g} s is outside of what there is, {first:g} to {last:g} s: that at {times[found]:g} s is taken",
                      stacklevel=3)
    return found


def among(name: Any, names: Iterable[Any]) -> str:
    """The names that there are, and the one that another was meant for if one is near."""
    known = [str(one) for one in names]
    near = difflib.get_close_matches(str(name), known, 1)
    return (f"did you mean {near[0]}? " if near else "") + (f"There are: {', '.join(known)}" if known else "There are none")


class Named(dict[str, V]):
    """A dictionary whose `KeyError` tells the names that there are."""

    def __init__(self, what: str, values: Mapping[str, V]) -> None:
        super().__init__(values)
        self._what = what

    def __missing__(self, name: Any) -> V:
        raise KeyError(f"{self._what} {name!r}: {among(name, self)}")
