"""The points of a sweep: which case is run where."""

from __future__ import annotations

import difflib
import itertools
import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from .. import _toml
from ..case import Case

STAND_OFF = "stand_off"

Point = dict[str, Any]
Change = Callable[[Point], Mapping[str, Any]]
"""What else changes with a point, by the keys of `Case.with_`."""

UNITS = {
    STAND_OFF: "1", "pressure": "Pa", "density": "kg/m3", "radius": "m", "end": "s", "yield_strength": "Pa", "pi": "Pa",
    "hardening_modulus": "Pa", "amplitude": "Pa", "width": "m", "gamma": "1", "levels": "1", "cfl": "1", "young": "Pa",
    "poisson": "1", "c1": "m/s", "c2": "m/s", "gravity": "m/s2", "rise_time": "s", "rate_coefficient": "1",
}
"""Units of what one sweeps over, by the last word of the key."""


class Axes:
    """The values of each parameter, and all their combinations, the last parameter fastest."""

    def __init__(self, parameters: Mapping[str, Sequence[Any]]) -> None:
        if not isinstance(parameters, Mapping) or not parameters:
            raise ValueError(f"parameters = {parameters!r}: a sweep needs lists of values by key, one key or more")
        self.names = list(parameters)
        for name in self.names:
            _refuse_misspelt(name)
        self.lists = [_values(name, parameters[name]) for name in self.names]
        self.shape = tuple(len(values) for values in self.lists)
        self.points: list[Point] = [dict(zip(self.names, values)) for values in itertools.product(*self.lists)]

    def places(self, root: Path) -> list[Path]:
        """The run directory of each point: a name that people can read and no two points share."""
        return [root / ",".join(words) for words in itertools.product(*map(_slugs, self.names, self.lists))]

    def coordinates(self) -> dict[str, Any]:
        """The parameters as coordinates, by `labels`."""
        found: dict[str, Any] = {}
        for name, values in zip(self.names, self.lists):
            attributes = {"long_name": "stand-off d/R" if name == STAND_OFF else name}
            if all(is_plain(value) and not isinstance(value, str) for value in values):
                unit = UNITS.get(name.rpartition(".")[2])
                attributes |= {"units": unit} if unit else {}
            found[name] = ((name,), labels(values), attributes)
        return found


def labels(values: Sequence[Any]) -> list[Any]:
    """What values are called along an axis: themselves; what is no number, text or truth value, as a table, by its number in the list.

    Truth values beside others are the words of a case file, "true" and "false".
    """
    if all(isinstance(value, bool) for value in values):
        return list(values)
    found = [_word(value) if isinstance(value, bool) else value if is_plain(value) else number for number, value in enumerate(values)]
    # As text if one is, as an array has one type.
    return [str(label) for label in found] if any(isinstance(label, str) for label in found) else found


def _refuse_misspelt(name: Any) -> None:
    """`stand_off` is no key of a case, so the case could not tell that it was meant."""
    if not isinstance(name, str):
        raise TypeError(f"{name!r} is a {type(name).__name__}: parameters are named by the keys of a case, as texts, or {STAND_OFF!r}")
    if name != STAND_OFF and difflib.get_close_matches(name.rpartition(".")[2].lower(), [STAND_OFF], 1, 0.8):
        raise ValueError(f"{name!r} is no key of a case: did you mean {STAND_OFF!r}, the distance of the first bubble's centre from the "
                         "wall over its radius?")


def _values(name: str, given: Any) -> list[Any]:
    """The values of an axis: one or more, each once."""
    # A text and a table could be gone through, too, but not by values.
    if isinstance(given, (str, bytes, Mapping)) or not np.iterable(given):
        raise TypeError(f"{name} = {given!r}: give a list of values, for a single one [{given!r}]")
    values = [bool(value) if isinstance(value, np.bool_) else value for value in given]
    if not values:
        raise ValueError(f"{name} = []: give one value or more")
    if any(value is None for value in values):
        raise TypeError(f"{name} has None, which has no place in a case file: give numbers, texts, truth values, lists or dictionaries")
    kinds = [_word(value) if isinstance(value, bool) else value if is_plain(value)
             else repr(value.tolist() if isinstance(value, np.ndarray) else value) for value in values]
    again = next((values[number] for number, kind in enumerate(kinds) if kind in kinds[:number]), None)
    if again is not None:
        raise ValueError(f"{name} has {again!r} twice: every point is run once, give each value once")
    return values


def is_plain(value: Any) -> bool:
    return isinstance(value, (str, int, float, np.number)) and not isinstance(value, bool)


def _word(value: bool) -> str:
    """A truth value as a case file has it."""
    return "true" if value else "false"


def _slugs(name: str, values: Sequence[Any]) -> list[str]:
    """The part of a directory's name that each value of an axis has; of those that would have the same, with the number in the list."""
    words = [_word(value) if isinstance(value, bool) else re.sub(r"[^A-Za-z0-9.+-]+", "-", str(value)) if is_plain(value) else str(number)
             for number, value in enumerate(values)]
    # No word has an underscore of its own.
    return [f"{name.rpartition('.')[2]}={word}" + f"_{number}" * (words.count(word) > 1) for number, word in enumerate(words)]


def at_point(case: Case, point: Mapping[str, Any], change: Change | None = None) -> Case:
    """The case at a point of a sweep."""
    changes = {name: value for name, value in point.items() if name != STAND_OFF}
    if change is not None:
        changes |= change(dict(point))
    changed = case.with_(changes) if changes else case
    if STAND_OFF not in point:
        return changed
    placed = _placed(changed, float(point[STAND_OFF]))
    twice = next((key for key in placed if key in changes), None)
    if twice is not None:
        raise ValueError(f"{STAND_OFF} and {twice!r} both say where the bubble is: leave one of them out")
    return changed.with_(placed)


def _placed(case: Case, stand_off: float) -> dict[str, Any]:
    """What puts the first bubble so many of its radii off the wall."""
    fluid = _toml.parse(case.to_toml()).get("fluid", {})
    bubble, is_described = fluid.get("bubble"), _is_described(case)
    number = bubble["region"] if is_described else 0
    key = "fluid.bubble.centre" if is_described else "fluid.region.0.centre"
    regions = fluid.get("region", [])
    if not regions or "radius" not in regions[number]:
        raise ValueError("stand_off needs a bubble: a sphere as the case's first region, or [fluid.bubble]")
    region = regions[number]
    if bubble is not None and bubble["region"] == number and region["pressure"] > fluid["ambient"]["pressure"]:
        raise ValueError("stand_off is of the largest radius, and the bubble of [fluid.bubble] grows, how far is not in the case: sweep over "
                         f"{key!r} instead, with places [z, 0.0] in m; pycav.laser_bubble(stand_off=...) knows them")
    return {key: [fluid["z"][0] + stand_off * region["radius"], region["centre"][1]]}


def _is_described(case: Case) -> bool:
    """Whether `[fluid.bubble]` makes the bubble; else regions that stand in the case do."""
    told = _toml.parse(case._native.text).get("fluid", {}).get("bubble", {})
    return "centre" in told or any(change.startswith("fluid.bubble") and "centre" in change for change in case._changes)


def in_words(point: Mapping[str, Any]) -> str:
    """A point on one line."""
    return ", ".join(f"{name.rpartition('.')[2]} {_short(value)}" for name, value in point.items())


def _short(value: Any) -> str:
    if isinstance(value, Mapping):
        return str(value.get("name", "of its own"))
    return f"{value:g}" if isinstance(value, (float, np.floating)) else str(value)
