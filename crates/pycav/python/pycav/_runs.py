"""The runs in a folder as a table."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Sequence

import pandas

from . import _pycav


def runs(
    folder: str | os.PathLike[str] = "runs",
    *,
    where: str | Sequence[str] = (),
    state: str | Sequence[str] = (),
    sort: str | None = None,
    columns: str | Sequence[str] | None = None,
) -> pandas.DataFrame:
    """All runs below a folder: what was varied among them, their key numbers, their states; as ``cav list`` finds them.

    An index in the folder (``.cav-index.sqlite``) makes the second call fast; it may be deleted at any time.

    Parameters
    ----------
    folder
        The folder; runs are found at any depth.
    where
        Conditions that must all hold, as ``"solid.material=copper"`` or ``"wall_pressure_peak>1e8"``. Instead of ``=`` there may be
        ``!=``, ``<``, ``<=``, ``>``, ``>=`` or ``~`` (contains). Keys are those of cases, of ``summary.json`` and of the table.
    state
        Only runs in one of these states: ``"running"``, ``"finished"``, ``"failed"``, ``"interrupted"``.
    sort
        The key to sort by, the smallest first; by path if ``None``.
    columns
        Keys instead of those that are chosen by what there is; ``"all"`` for every key of cases and summaries.

    Returns
    -------
    pandas.DataFrame
        A row for each run, by its path below the folder. The columns are ``state``, ``progress`` (share of the simulated time that is
        done), ``started``, ``version``, the keys of the cases that differ, ``cells_per_radius`` and the key numbers, in SI units.
        ``attrs["units"]`` has units by column, ``attrs["folder"]`` the folder.

    Raises
    ------
    FileNotFoundError
        The folder cannot be read.
    ValueError
        A condition, a key or a state makes no sense.
    """
    text, keys, units, notes = _pycav.runs(
        os.fspath(folder), _list(where), _list(state), sort, None if columns is None else _list(columns))
    for note in notes:
        warnings.warn(note, stacklevel=2)
    table = pandas.DataFrame(json.loads(text), columns=keys).set_index("path")
    if "started" in table:
        table["started"] = pandas.to_datetime(table["started"], utc=True)
    table.attrs.update(units=dict(units), folder=os.fspath(folder))
    return table


def _list(given: str | Sequence[str]) -> list[str]:
    return [given] if isinstance(given, str) else list(given)
