"""How pictures look: colours, sizes, units on axes."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import LinearSegmentedColormap, LogNorm
from matplotlib.ticker import FuncFormatter

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


PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def prefix(largest: float) -> tuple[float, str]:
    """What to multiply with, and the prefix: 5.1e-5 is 51 with µ."""
    if not (largest > 0 and math.isfinite(largest)):
        return 1.0, ""
    power = min(max(3 * math.floor(math.log10(largest * 1.0000001) / 3), -12), 12)
    return 10.0**-power, PREFIXES[power]


def ticks(axis: Axis, largest: float, symbol: str, unit: str, pad: float = 3.0) -> None:
    """Writes an axis in SI units with the prefix that fits its largest value; the data stay in plain units."""
    scale, letter = prefix(largest)
    axis.set_major_formatter(FuncFormatter(lambda value, _: number(value * scale)))
    axis.set_label_text(f"{symbol} / {letter}{unit}")
    axis.labelpad = pad


def number(value: float) -> str:
    """A number for a tick, with a true minus sign and without round-off."""
    rounded = float(f"{value:.10g}")
    return f"{rounded:g}".replace("-", "−") if rounded else "0"


POWERS = {"m²": 2, "m³": 3}


def si(value: Any, unit: str) -> str:
    """A number with the prefix that fits it; pure numbers without one."""
    if value is None or (isinstance(value, float) and not np.isfinite(value)):
        return "–"
    size = abs(float(value))
    if unit in POWERS:  # the prefix is of a length; from a thousandth of its square or cube on, as the next smaller one is too small
        power = POWERS[unit]
        scale, letter = prefix((1e3 * size) ** (1 / power))
        return f"{_four_digits(value * scale**power)} {letter}{unit}"
    scale, letter = prefix(size) if unit in ("Pa", "s", "m", "J", "J/rad", "J/m") else (1.0, "")
    return f"{_four_digits(value * scale)} {letter}{unit}".strip()


def percent(value: float) -> str:
    """A share with two digits: 0.0773 is 7.7 %."""
    return f"{number(float(f'{100 * value:.2g}'))} %"


def rounded(value: float | None, unit: str) -> str:
    """As `si`, with three digits."""
    return si(None if value is None else float(f"{value:.3g}"), unit)


def _four_digits(value: float) -> str:
    return number(float(f"{value:.4g}"))


def part_of(name: str, low: float, high: float) -> LinearSegmentedColormap:
    """A colour map's part, so that lines drawn over it stay visible."""
    colours = mpl.colormaps[name](np.linspace(low, high, 256))
    return LinearSegmentedColormap.from_list(f"{name} {low}-{high}", colours, 256)


def logarithmic(top: float, decades: float) -> LogNorm:
    """A scale of some decades below a value, which may be 0 before anything has happened."""
    top = max(top, 1e-12)
    return LogNorm(top / 10**decades, top, clip=True)


def signed_powers(top: float, powers: Sequence[int]) -> list[float]:
    """Ticks of a scale that is logarithmic on both sides of 0: ±10^k below a value, and 0."""
    return sorted([sign * 10.0**k for sign in (-1, 1) for k in powers if 10.0**k < top] + [0.0])


def legend(axes: Axes, **options: Any) -> None:
    axes.legend(**{"handlelength": 1.8, "borderaxespad": 0.4, **options})
