"""How pictures look: colours, sizes, units on axes."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.ticker import FuncFormatter

from ..mesh import Floats
from .._numbers import number, prefix

# The palette of Okabe and Ito, which the colour-blind can tell apart.
INK, GREY, WHITE = "#1a1a1a", "0.5", "white"
ORANGE, BLUE, GREEN, PINK = "#d55e00", "#0072b2", "#009e73", "#cc79a7"

WIDTH = 6.0  # inches: two columns of a journal

RC: dict[Any, Any] = {
    # By name: a generic family would be looked up again, with other settings, when the picture is saved.
    "font.family": ["STIXGeneral", "DejaVu Serif"],
    "mathtext.fontset": "stix", "font.size": 9, "axes.linewidth": 0.6, "axes.edgecolor": INK,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.major.size": 3, "ytick.major.size": 3,
    "figure.facecolor": "white", "figure.dpi": 200, "legend.frameon": False, "legend.fontsize": 8,
    "lines.linewidth": 1.0,
}

P = ParamSpec("P")
T = TypeVar("T")


def styled(draw: Callable[P, T]) -> Callable[P, T]:
    """Lets a function draw in the house style, and leaves the caller's settings alone."""

    @wraps(draw)
    def drawn(*arguments: P.args, **options: P.kwargs) -> T:
        with mpl.rc_context(RC):
            return draw(*arguments, **options)

    return drawn


def ticks(axis: Axis, largest: float, symbol: str, unit: str, pad: float = 3.0) -> None:
    """Writes an axis in SI units with the prefix that fits its largest value; the data stay in plain units."""
    scale, letter = prefix(largest)
    axis.set_major_formatter(FuncFormatter(lambda value, _: number(value * scale)))
    axis.set_label_text(f"{symbol} / {letter}{unit}")
    axis.labelpad = pad


def part_of(name: str, low: float, high: float) -> LinearSegmentedColormap:
    """A colour map's part, so that lines drawn over it stay visible."""
    colours = mpl.colormaps[name](np.linspace(low, high, 256))
    return LinearSegmentedColormap.from_list(f"{name} {low}-{high}", colours, 256)


STILL = 1e-12
"""Where scales end at least: values may all be 0 before anything has happened."""


def nearly_largest(image: Floats, share: float = 99.9) -> float:
    """What the absolute values of nearly all pixels, `share` per cent, stay below."""
    return max(float(np.nanpercentile(np.abs(image), share)), STILL)


def logarithmic(top: float, decades: float) -> LogNorm:
    """A scale of some decades below a value."""
    top = max(top, STILL)
    return LogNorm(top / 10**decades, top, clip=True)


def signed_powers(least: float, top: float, every: int = 1) -> list[float]:
    """Ticks of a scale that is logarithmic on both sides of 0: ±10^k between two values, and 0; of every second power the odd ones."""
    powers = [k for k in range(int(np.floor(np.log10(least))), int(np.ceil(np.log10(top)))) if least < 10.0**k < top and k % every == every - 1]
    return sorted([sign * 10.0**k for sign in (-1, 1) for k in powers] + [0.0])


def legend(axes: Axes, **options: Any) -> None:
    axes.legend(**{"handlelength": 1.8, "borderaxespad": 0.4, **options})
