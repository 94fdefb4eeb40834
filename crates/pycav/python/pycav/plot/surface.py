"""The profile of the solid's surface, and what the summary says of the pit in it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._given import nearest_time
from ..mesh import Floats
from ..result import Result, open_run
from .section import Run
from .._numbers import percent, rounded

FAR = 0.1
"""Share of the extent in r, the outermost, whose mean level is that far away (docs/reference/output-summary.md, *The surface of the solid*)."""
STILL = 0.01
"""Up to this `surface_still` the surface is still."""
ALMOST_STILL = 0.1
"""Up to this one its depth is that of a pit, as the answer in the summary has it."""
CARRIED = 16
"""Faces that one cell of the solid carries at most, where the fluid is four levels finer."""
DISPLACEMENT = "interface/displacement_z"


@dataclass
class Profile:
    """The depth of a run's surface below its level far away, at one time."""

    result: Result
    time: float
    """s"""
    r: Floats
    """Centres of the faces, m"""
    depth: Floats
    """m, positive downwards"""
    is_last: bool
    """Whether it is the run's last profile, on which the summary's numbers are"""

    @classmethod
    def of(cls, run: Run, time: float | None) -> Profile:
        """The profile nearest to a time in s, or the last one.

        Raises `ValueError` where no pit can stay, as nothing yields, or where no displacement is known.
        """
        result = open_run(run)
        if "solid" not in result.media:
            raise ValueError("the run has no solid")
        if "plasticity" not in result.parameters["solid"]:
            raise ValueError("the solid is elastic and keeps no pit: [solid.plasticity] of the case makes it yield")
        data = result.histories
        if DISPLACEMENT not in data:
            raise ValueError("the run has no displacement of the surface: nothing acted on it, neither a fluid nor a load")
        if "interface/r" not in data:
            raise ValueError("the run has no radii of the surface: its fluid has left no histories")
        rows = data[DISPLACEMENT].to_numpy()
        times, r = data["interface/displacement_time"].to_numpy(), data["interface/r"].to_numpy()
        row = len(times) - 1 if time is None else nearest_time(times, time)
        far = (np.arange(len(r)) + 0.5) >= (1.0 - FAR) * len(r)
        return cls(result, float(times[row]), r, rows[row, far].mean() - rows[row], row == len(times) - 1)

    @property
    def name(self) -> str:
        cells = self.result.cells_per_radius
        return self.result.directory.name if cells is None else f"{cells:.3g} cells per radius"

    @property
    def line(self) -> tuple[Floats, Floats]:
        """r and depth to draw, m: one point for neighbouring faces that one cell of the solid carries, which else make stairs."""
        begins = np.flatnonzero(np.diff(self.depth, prepend=np.nan) != 0)
        count = np.diff(begins, append=len(self.depth))
        flat = np.repeat(count > CARRIED, count)  # longer than a cell: the surface is level there, to its ends
        kept = np.zeros(len(self.depth), bool)
        kept[begins] = True
        r = np.where(flat, self.r, np.repeat(np.add.reduceat(self.r, begins) / count, count))
        return r[kept | flat], self.depth[kept | flat]

    @property
    def numbers(self) -> dict[str, float]:
        """What the summary has of the pit in SI units, volumes of a plane per metre, where the profile is that of the end."""
        names = ("pit_depth", "pit_radius", "pit_rim", "pit_volume", "pit_floor", "surface_still", "plastic_strain_peak")
        known = self.result.summary if self.is_last else {}
        return {name: float(known[name]) for name in names if known.get(name) is not None}

    @property
    def words(self) -> str:
        """The numbers as lines of text; of an earlier profile its deepest point."""
        found = self.numbers
        if "pit_depth" not in found:
            return f"deepest {rounded(float(self.depth.max()), 'm')}"
        if not has_pit(found):
            floor = f"none deeper than {rounded(found.get('pit_floor'), 'm')}"
            return f"no pit: {floor if found.get('plastic_strain_peak') else 'nothing flowed'}"
        volume, area = ("volume", "m³") if self.result.parameters.get("geometry") != "planar" else ("area", "m²")
        lines = [f"depth {rounded(found['pit_depth'], 'm')}", f"radius at half depth {rounded(found.get('pit_radius'), 'm')}",
                 f"rim {rounded(found.get('pit_rim'), 'm')}", f"{volume} {rounded(found.get('pit_volume'), area)}"]
        if found.get("surface_still", 0.0) > STILL:
            lines.append(f"still moving by {percent(found['surface_still'])}")
        return "\n".join(lines)


def has_pit(summary: Mapping[str, Any]) -> bool:
    """Whether a summary tells of a pit: one deeper than its floor, in a solid that has flowed.

    Without plastic strain nothing stays, whatever waves still leave of a depth when a run ends.
    """
    return bool(summary.get("pit_depth")) and bool(summary.get("plastic_strain_peak"))
