"""The table of a run's key numbers: plain SI units to compute with, an engineer's to read."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas

from ._numbers import si, unit_in

KEY_NUMBERS = [
    ("wall_pressure_peak", "Pa", "wall_pressure_peak_time"),
    ("wall_pressure_peak_interface", "Pa", "wall_pressure_peak_interface_time"),
    ("wall_pressure_peak_anywhere", "Pa", "wall_pressure_peak_anywhere_time"),
    ("wall_pressure_mean_peak", "Pa", "wall_pressure_mean_peak_time"),
    ("wall_impulse", "Pa s", "wall_impulse_time"),
    ("load_impulse", "Pa s", "load_impulse_time"),
    ("von_mises_peak", "Pa", "von_mises_peak_time"),
    ("yielded_volume_peak", "m3", ""),
    ("plastic_strain_peak", "1", "plastic_strain_peak_time"),
    ("plastic_work", "J", ""),
    ("pit_depth", "m", ""),
    ("min_equivalent_radius", "m", "collapse_time"),
    ("jet_velocity_peak", "m/s", "jet_velocity_peak_time"),
]
"""Keys of the summary, their units in axisymmetric runs, and the keys of their times."""


def wall_peak(summary: Mapping[str, Any]) -> str:
    """The key of the largest pressure on the wall at the axis: of its first cell or of its face, where a jet lands and means are taken."""
    cell, face = "wall_pressure_peak", "wall_pressure_peak_interface"
    return face if (summary.get(face) or 0.0) > (summary.get(cell) or 0.0) else cell


class KeyNumbers(pandas.DataFrame):
    """Columns `value`, `unit`, `time` (s). Printed, or in a notebook, it shows MPa and µs; what is made of it is a plain table."""

    @classmethod
    def of(cls, summary: Mapping[str, Any], parameters: Mapping[str, Any]) -> KeyNumbers:
        """Those that the summary of a run with these parameters has."""
        known = [row for row in KEY_NUMBERS if summary.get(row[0]) is not None
                 and not (row[0] == "yielded_volume_peak" and summary.get("yield_strength") is None)]
        rows = {name: (summary[name], unit_in(parameters, unit), summary.get(time)) for name, unit, time in known}
        return cls(pandas.DataFrame.from_dict(rows, orient="index", columns=["value", "unit", "time"]))

    @property
    def _constructor(self) -> type[pandas.DataFrame]:
        return pandas.DataFrame

    def _read(self) -> pandas.DataFrame:
        """As it is read: text."""
        units = {"1": "", "m2": "m²", "m3": "m³"}
        rows = {name: (si(row["value"], units.get(row["unit"], row["unit"])), "" if pandas.isna(row["time"]) else si(row["time"], "s"))
                for name, row in self.iterrows()}
        return pandas.DataFrame.from_dict(rows, orient="index", columns=["value", "time"])

    def __repr__(self) -> str:
        return repr(self._read())

    def _repr_html_(self) -> str:
        return self._read().to_html()
