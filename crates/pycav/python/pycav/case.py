"""Cases: what a run computes."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _pycav, _toml
from ._native import Native
from ._sampling import table


class Case:
    """A case file, read and checked, with all defaults filled in. A case does not change.

    Raises `pycav.CaseError` with the command line's text; its `faults` are dictionaries with the keys `path`, `message`,
    `help`, `line`, `column`.
    """

    _native: _pycav.Case
    _changes: tuple[str, ...] = ()
    """What `with_` has changed since the text was read. An effective case would not do in its place: what follows from other keys, as
    the scales of adaptation, is spelt out there and no longer follows."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self._native = _pycav.Case.load(os.fspath(path))

    @classmethod
    def _of(cls, native: _pycav.Case) -> Case:
        case = cls.__new__(cls)
        case._native = native
        return case

    @classmethod
    def from_toml(cls, text: str, name: str = "case") -> Case:
        """A case from the text of a case file."""
        return cls._of(_pycav.Case.from_toml(text, name))

    @classmethod
    def from_dict(cls, values: Mapping[str, Any], name: str = "case") -> Case:
        """A case from nested dictionaries with the keys of a case file; `None` leaves a key out."""
        return cls.from_toml(_toml.document(values), name)

    def with_(self, changes: Mapping[str, Any] | None = None, /, **more: Any) -> Case:
        """A changed copy: `case.with_(**{"fluid.ambient.pressure": 5e6})`.

        Keys are those of `--set`: tables joined by dots, array elements by number. Values are numbers, texts, truth
        values, lists, arrays, dictionaries.
        """
        changes = {**(changes or {}), **more}
        return self._changed([f"{path}={_toml.value(item)}" for path, item in changes.items()])

    def _changed(self, sets: list[str]) -> Case:
        """A copy with changes `KEY=VALUE`."""
        changed = self._of(self._native.with_sets(sets))
        changed._changes = (*self._changes, *sets)
        return changed

    def with_inflow(
        self,
        pressure: Callable[[NDArray[np.float64]], ArrayLike],
        times: ArrayLike | None = None,
        *,
        tolerance: float = 1e-4,
    ) -> Case:
        """A copy whose inflow has the pressure in Pa that a function of an array of times in s gives.

        A case holds a table that is linear in between. Its rows are chosen so that it is off by at most `tolerance` times the
        range of the function between 0 and the end of the run. The function is looked at every 1/131 072 of that time,
        more closely where it bends; `ValueError` where it jumps or is not finite.

        - `times`: ascending; the rows are then there, whatever the function does in between.
        """
        if times is None:
            return self.with_({"fluid.inflow.pressure": table(pressure, self.end, tolerance)})
        t = np.asarray(times, float)
        p = np.broadcast_to(np.asarray(pressure(t), float), t.shape)
        return self.with_({"fluid.inflow.pressure": np.column_stack([t, p])})

    name: Native[str] = Native("What the case is called: its file's name without `.toml`.")
    end: Native[float] = Native("End of the run, s.")
    media: Native[list[str]] = Native('"fluid", "solid", or both.')
    warnings: Native[list[str]] = Native("What a run of the case would warn of.")
    hash: Native[str] = Native("SHA-256 of what the case computes, the same as in the files of a run.")

    def to_toml(self) -> str:
        """The case as a case file with all defaults filled in."""
        return self._native.to_toml()

    def check(self) -> str:
        """What `cav check` says: cells, memory, steps, impedances."""
        return self._native.report()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Case) and self._native == other._native

    def __hash__(self) -> int:
        return hash(self._native)

    def __repr__(self) -> str:
        return f"<pycav.Case {self.name!r}, {' and '.join(self.media)}, to {self.end:g} s>"

    def __reduce__(self) -> tuple[Any, ...]:
        return (Case.from_toml, (self.to_toml(), self.name))


def checked(given: object) -> Case:
    """What was given as a case, if it is one; `TypeError` says how to make one of it."""
    if isinstance(given, Case):
        return given
    if isinstance(given, (str, os.PathLike)):
        cure = f"read the file first, pycav.Case({os.fspath(given)!r})"
    elif isinstance(given, Mapping):
        cure = "make one, pycav.Case.from_dict(...)"
    elif isinstance(getattr(given, "case", None), Case):
        cure = "give its .case"
    else:
        cure = "give a pycav.Case"
    raise TypeError(f"case is a {type(given).__name__}, not a pycav.Case: {cure}")


class Material(NamedTuple):
    """A material of the library."""

    name: str
    """What cases call it by."""
    density: float
    """kg/m³"""
    c1: float
    """Speed of dilatational waves, m/s."""
    c2: float
    """Speed of shear waves, m/s."""
    yield_strength: float | None
    """Pa; `None` if it has none."""


def materials() -> list[Material]:
    """The library of materials: name, density in kg/m³, wave speeds c1 and c2 in m/s, yield strength in Pa (or `None`)."""
    return [Material(*row) for row in _pycav.materials()]
