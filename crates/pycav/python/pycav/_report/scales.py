"""Scales of colours: from a value to a step of a palette and back."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from ..mesh import Floats
from .._numbers import number

Steps = NDArray[np.uint8]

RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
ROOM = 0.14
"""Share of a scale that the digits of a tick need."""


@dataclass(frozen=True)
class Scale:
    """Values from `low` to `high` on `steps` colours, evenly spaced after `bend`.

    `bend` maps values onto a line and `unbend` back; both grow strictly between the ends. What is beyond the ends has their colours.
    """

    low: float
    high: float
    bend: Callable[[Floats], Floats]
    unbend: Callable[[Floats], Floats]
    colours: NDArray[np.uint8]
    """The palette, shape (steps, 3), red, green, blue"""
    ticks: tuple[float, ...] = ()

    def place(self, values: Floats) -> Floats:
        """Where values are between the ends, 0 to 1."""
        first, last = self.bend(np.array([self.low, self.high]))
        return np.asarray((self.bend(np.clip(values, self.low, self.high)) - first) / (last - first))

    def paint(self, values: Floats) -> Steps:
        """The step of each value."""
        return np.rint(self.place(values) * (len(self.colours) - 1)).astype(np.uint8)

    @property
    def values(self) -> Floats:
        """The value of each step."""
        first, last = self.bend(np.array([self.low, self.high]))
        return self.unbend(np.linspace(first, last, len(self.colours)))

    @property
    def marks(self) -> list[tuple[float, str]]:
        """Where the ticks are, and their numbers."""
        return [(float(self.place(np.array([tick]))[0]), _short(tick)) for tick in self.ticks]


def _short(value: float) -> str:
    if value and not 1e-3 <= abs(value) < 1e5:
        mantissa, exponent = f"{value:.0e}".split("e")
        return ("" if mantissa == "1" else f"{mantissa}·") + f"10{str(int(exponent)).translate(RAISED)}"
    return number(float(f"{value:.3g}"))


def palette(name: str, steps: int, low: float = 0.0, high: float = 1.0) -> NDArray[np.uint8]:
    """A part of one of matplotlib's colour maps."""
    return np.asarray(np.rint(255 * mpl.colormaps[name](np.linspace(low, high, steps))[:, :3]), np.uint8)


def power(high: float, exponent: float, name: str, low: float = 0.0, steps: int = 160) -> Scale:
    """From `low` to `high`; an exponent below one lifts what is weak beside the maximum."""
    high = max(high, low + 1e-12 * max(1.0, abs(low)))
    return _with_ticks(low, Scale(low, high, lambda x: np.asarray((x - low) ** exponent),
                                  lambda y: np.asarray(low + y ** (1 / exponent)), palette(name, steps)))


def logarithmic(high: float, decades: float, name: str, first: float = 0.0, last: float = 1.0, steps: int = 64) -> Scale:
    """Some decades below a value."""
    high = max(high, 1e-30)
    low = high / 10**decades
    tens = [10.0**k for k in range(int(np.ceil(np.log10(low) - 1e-9)), int(np.floor(np.log10(high) + 1e-9)) + 1)]
    return Scale(low, high, lambda x: np.asarray(np.log10(np.maximum(x, low))), lambda y: np.asarray(10.0**y),
                 palette(name, steps, first, last), tuple(tens))


def about(rest: float, low: float, high: float, name: str, steps: int = 200) -> Scale:
    """Differences to `rest` by their square root with its sign; `rest` has the middle colour.

    Of the palette only the part from `low` to `high` is used, so that equal differences on both sides have colours equally strong.
    """
    reach = max(high - rest, rest - low, 1e-12 * max(1.0, abs(rest)))
    low, high = min(low, rest), max(high, rest)
    if high - low < 1e-3 * reach:
        high = rest + reach
    first, last = (0.5 + 0.5 * np.sign(end - rest) * np.sqrt(abs(end - rest) / reach) for end in (low, high))
    return _with_ticks(rest, Scale(low, high, lambda x: np.asarray(np.sign(x - rest) * np.sqrt(np.abs(x - rest))),
                                   lambda y: np.asarray(rest + np.sign(y) * y**2), palette(name, steps, float(first), float(last))))


def _with_ticks(rest: float, scale: Scale) -> Scale:
    """The scale with `rest` and round numbers as ticks, the largest first, as far as there is room for their digits."""
    size = max(abs(scale.low), abs(scale.high))
    largest = int(np.floor(np.log10(size))) if size > 0 else 0
    rounds = [step * 10.0**k for k in range(largest, largest - 4, -1) for step in (5, 2, 1)]
    places: dict[float, float] = {}
    for tick in [rest, *(sign * value for value in rounds for sign in (1, -1)), 0.0]:
        place = float(scale.place(np.array([tick]))[0])
        if scale.low <= tick <= scale.high and all(abs(place - other) >= ROOM for other in places.values()):
            places[tick] = place
    return replace(scale, ticks=tuple(sorted(places)))
