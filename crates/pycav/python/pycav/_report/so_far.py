"""What is known of a run without a summary: one that goes on, or was killed."""

from __future__ import annotations

import json
import re
from typing import Any

import numpy as np

from ..result import Result

PEAKS = {
    "wall_pressure_peak": "wall/pressure_axis", "wall_pressure_peak_anywhere": "wall/pressure_max",
    "von_mises_peak": "solid/von_mises_max", "plastic_strain_peak": "solid/plastic_strain_max",
    "yielded_volume_peak": "solid/yielded_volume",
}
"""Keys of the summary that are the largest number of a history.

The smallest radius is not among them: the summary has it from the turn on alone, and more closely than a step tells."""


def has_summary(result: Result) -> bool:
    """Whether the run's end, of whatever kind, has left its numbers."""
    return "t_end" in result.summary


def known(result: Result) -> dict[str, Any]:
    """The summary; of a run that has none yet how far it is, its yield strength, and the peaks of its histories."""
    if has_summary(result):
        return result.summary
    data = result.histories
    found = {**result.summary, **_standing(result)}
    if result.yield_strength is not None:
        found["yield_strength"] = result.yield_strength
    for key, name in PEAKS.items():
        if name in data and np.isfinite(values := data[name].to_numpy()).any():
            found |= _peak(result, key, name, int(np.nanargmax(values)))
    place = data.get("solid/von_mises_max_position")
    if place is not None and "von_mises_peak" in found:
        found["von_mises_peak_position"] = place[int(np.nanargmax(data["solid/von_mises_max"].to_numpy()))].to_numpy().tolist()
    if "bubble/jet_velocity" in data and len(data["bubble/equivalent_radius"]):
        # What moves while all bubbles grow is no jet.
        each = [name for name in data if re.fullmatch(r"bubbles/\d+/equivalent_radius", str(name))]
        begin = min(int(np.argmax(data[name].to_numpy())) for name in each or ["bubble/equivalent_radius"])
        jets = data["bubble/jet_velocity"].to_numpy()[begin:]
        if np.isfinite(jets).any() and np.nanmax(jets) > 0:
            found |= _peak(result, "jet_velocity_peak", "bubble/jet_velocity", begin + int(np.nanargmax(jets)))
    if "solid/plastic_work" in data and len(data["solid/plastic_work"]):
        found["plastic_work"] = float(data["solid/plastic_work"][-1])
    return found


def _peak(result: Result, key: str, name: str, row: int) -> dict[str, float]:
    values = result.histories[name]
    found = {key: float(values[row])}
    # Of what has not begun, as to yield, the first row is no peak's.
    return found | {f"{key}_time": float(result.histories[str(values.dims[0])][row])} if found[key] else found


def _standing(result: Result) -> dict[str, float]:
    """Time, steps and wall time, by `progress.json` or by the last row of the histories, whichever is later."""
    times = result.histories["time"].to_numpy()
    found: dict[str, float] = {"t_end": float(times[-1]), "steps": len(times) - 1} if len(times) else {}
    try:
        told = json.loads((result.directory / "progress.json").read_text())
        if float(told["time"]) >= found.get("t_end", 0.0):
            found = {"t_end": float(told["time"]), "steps": int(told["step"])}
        found["wall_seconds"] = float(told["wall"])
    except (OSError, ValueError, KeyError, TypeError):
        pass  # a run that has just begun has none, and one that a full disk ended may have a part
    return found
