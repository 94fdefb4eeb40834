"""What a sweep keeps of a run."""

from __future__ import annotations

import reprlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from .._numbers import unit_in
from ..result import Result

Measure = Callable[[Result], Mapping[str, tuple[float, str]]]
"""What is kept of a run: value and unit by name."""

SUMMARY = [
    ("wall_pressure_peak", "Pa"), ("wall_pressure_peak_time", "s"), ("wall_pressure_peak_anywhere", "Pa"),
    ("wall_pressure_mean_peak", "Pa"), ("wall_pressure_mean_time", "s"), ("wall_impulse", "Pa s"), ("load_impulse", "Pa s"),
    ("von_mises_peak", "Pa"), ("von_mises_peak_time", "s"), ("yielded_volume_peak", "m3"), ("collapse_time", "s"),
    ("min_equivalent_radius", "m"), ("jet_velocity_peak", "m/s"), ("plastic_strain_peak", "1"), ("plastic_work", "J"),
    ("pit_depth", "m"), ("pit_radius", "m"), ("pit_volume", "m3"), ("pit_rim", "m"), ("pit_floor", "m"), ("surface_still", "1"),
    ("cells_per_radius", "1"), ("film_cells_min", "1"), ("wall_seconds", "s"),
]
SENSOR = [("pressure_peak", "Pa"), ("pressure_peak_time", "s"), ("force_peak", "N"), ("impulse", "N s"), ("load_impulse", "N s")]

WORDS = {
    "wall_pressure_peak": "largest wall pressure on the axis", "wall_pressure_peak_anywhere": "largest wall pressure",
    "wall_pressure_mean_peak": "largest short mean of the wall pressure on the axis", "wall_impulse": "impulse on the wall's axis",
    "load_impulse": "impulse beyond the pressure far away",
    "von_mises_peak": "largest von Mises stress", "yielded_volume_peak": "largest yielded volume",
    "min_equivalent_radius": "smallest equivalent radius", "jet_velocity_peak": "largest jet velocity",
    "plastic_strain_peak": "largest plastic strain", "plastic_work": "plastic work", "pit_depth": "depth of the pit",
    "pit_radius": "radius of the pit at half depth", "pit_volume": "volume of the pit", "pit_rim": "height of the pit's rim",
    "pit_floor": "depth below which no pit can be told", "surface_still": "share of the depth that still moves",
    "cells_per_radius": "finest fluid cells along the bubble's radius", "film_cells_min": "fewest cells across the film",
    "wall_seconds": "time that the run took", "pressure_peak": "largest mean pressure on the disc",
    "force_peak": "largest force on the disc", "impulse": "impulse on the disc",
}
"""What the numbers are, for people."""


def measures(result: Result) -> dict[str, tuple[float, str]]:
    """What a sweep keeps of a run: value and unit by name, NaN for what the run has not. Wholes of planar runs are per metre of depth.

    Numbers of the summary, among them `load_impulse`, `pit_depth`, `plastic_strain_peak` and `cells_per_radius`; and of every
    disc (`[[sensor]]`) `sensors.NAME.pressure_peak`, `.pressure_peak_time`, `.force_peak`, `.impulse`, `.load_impulse`.
    """
    summary = result.summary
    found = {name: (_number(summary.get(name)), unit) for name, unit in SUMMARY}
    for sensor, numbers in (summary.get("sensors") or {}).items():
        found |= {f"sensors.{sensor}.{name}": (_number(numbers.get(name)), unit) for name, unit in SENSOR}
    return {name: (value, unit_in(result.parameters, unit)) for name, (value, unit) in found.items()}


def measured(measure: Measure, place: Path) -> dict[str, tuple[float, str]]:
    """What a function measures of a run; `TypeError` where that is no value and unit by name."""
    given: Any = measure(Result(place))
    if not isinstance(given, Mapping):
        raise TypeError(f"measure returned {reprlib.repr(given)} of {place}: {WANTED}")
    for name, pair in given.items():
        is_pair = isinstance(pair, (tuple, list)) and len(pair) == 2
        if not (isinstance(name, str) and is_pair and _is_value(pair[0]) and isinstance(pair[1], str)):
            raise TypeError(f"measure returned {reprlib.repr(name)}: {reprlib.repr(pair)} of {place}: {WANTED}")
    return dict(given)


WANTED = 'it has to return {name: (value, unit)}, as {"depth": (1e-5, "m")}, with NaN for what a run has not'


def _is_value(given: Any) -> bool:
    """Whether something is a number: of Python, of NumPy, or one in an array."""
    try:
        float(given)
    except (TypeError, ValueError):
        return False
    return not isinstance(given, str)


def words(name: str) -> str:
    """What a measured number is, in words."""
    return WORDS.get(name) or WORDS.get(name.rpartition(".")[2]) or name.replace("_", " ")


def _number(value: object) -> float:
    return float(value) if isinstance(value, (int, float)) else float("nan")
