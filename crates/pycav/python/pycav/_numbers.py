"""Numbers as an engineer writes them: with four digits, and the prefix that fits."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def prefix(largest: float) -> tuple[float, str]:
    """What to multiply with, and the prefix: 5.1e-5 is 51 with µ."""
    if not (largest > 0 and math.isfinite(largest)):
        return 1.0, ""
    power = min(max(3 * math.floor(math.log10(largest * 1.0000001) / 3), -12), 12)
    return 10.0**-power, PREFIXES[power]


def number(value: float) -> str:
    """A number for a tick, with a true minus sign and without round-off."""
    rounded = float(f"{value:.10g}")
    return f"{rounded:g}".replace("-", "−") if rounded else "0"


PER_DEPTH = {"m3": "m2", "m³": "m²", "kg": "kg/m", "N": "N/m", "N s": "N s/m", "J": "J/m"}
"""The units of wholes, and those of the same in planar runs: per metre of depth."""


def unit_in(parameters: Mapping[str, Any], unit: str) -> str:
    """The unit in a run with these parameters of what is in `unit` in an axisymmetric one."""
    return PER_DEPTH.get(unit, unit) if parameters.get("geometry") == "planar" else unit


POWERS = {"m²": 2, "m³": 3}


def si(value: Any, unit: str) -> str:
    """A number with the prefix that fits it; pure numbers without one."""
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
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
