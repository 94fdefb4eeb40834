"""What part of a run the pictures show, and which snapshot is shown at first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .._key_numbers import wall_peak
from ..mesh import Box, Mesh
from .._numbers import si
from ..result import Result

ACROSS, ABOVE, BELOW = 4.0, 4.5, 3.0
"""Radii of the bubble shown to either side of the axis, above the wall (at least `OVER` above the bubble) and below it."""
OVER = 2.0
LOADS = 5.0
"""Radii of a load that are shown."""


@dataclass(frozen=True)
class View:
    """The part of the section that is shown; lengths in m."""

    boxes: dict[str, Box]
    """Of each medium, z from, z to, r from, r to; the upper one first."""
    wall: float | None
    mirrored: bool


def view(result: Result) -> View:
    """What is near the bubble, or the load, and the wall; all if there is neither."""
    meshes = {medium: result.snapshots(medium)[0].mesh for medium in result.media}
    mirrored = result.parameters.get("geometry", "axisymmetric") == "axisymmetric"
    wall = None
    if "solid" in meshes:
        wall = float(meshes["solid"].high[0])
    elif "fluid" in meshes and "interface/pressure" in result.histories:
        wall = float(meshes["fluid"].low[0])
    across, above, below = _reach(result, wall) if mirrored else (np.inf, np.inf, np.inf)
    across = min(across, max(float(mesh.high[1]) for mesh in meshes.values()))
    return View({medium: _box(mesh, medium, wall, across, above, below) for medium, mesh in meshes.items()}, wall, mirrored)


def _box(mesh: Mesh, medium: str, wall: float | None, across: float, above: float, below: float) -> Box:
    low, high = float(mesh.low[0]), float(mesh.high[0])
    if wall is not None and medium == "fluid":
        high = min(high, wall + above)
    elif wall is not None:
        low = max(low, wall - below)
    return low, high, float(mesh.low[1]), min(across, float(mesh.high[1]))


def _reach(result: Result, wall: float | None) -> tuple[float, float, float]:
    """How far from the axis, above and below the wall, m."""
    load = result.parameters.get("coupling", {}).get("load", {}).get("radius")
    if load is not None:
        return LOADS * load, np.inf, LOADS * load
    radius = result.radius
    if radius is None or wall is None:
        return np.inf, np.inf, np.inf
    spheres = [region for region in result.parameters["fluid"]["region"] if region.get("shape") == "sphere"]
    top = max(float(sphere["centre"][0]) + float(sphere["radius"]) for sphere in spheres)
    return ACROSS * radius, max(ABOVE * radius, top - wall + (OVER - 1.0) * radius), BELOW * radius


def events(result: Result) -> list[tuple[float, str]]:
    """Moments to look at, s, the first of them at first."""
    told = [(f"{wall_peak(result.summary)}_time", "largest wall pressure"), ("collapse_time", "collapse"),
            ("von_mises_peak_time", "largest von Mises stress"), ("jet_velocity_peak_time", "fastest jet"),
            ("rebound_time", "rebound")]
    if "interface/pressure" not in result.histories:
        told = told[1:]
    found = [(float(time), label) for key, label in told if (time := result.summary.get(key)) is not None]
    has_bubble = result.summary.get("min_equivalent_radius") is not None or result.radius is not None
    return [(time, label) for time, label in found if has_bubble or label not in ("fastest jet", "rebound")]


def first(times: list[float], moments: list[tuple[float, str]]) -> tuple[int, str]:
    """The snapshot shown at first, and why."""
    if not moments:
        return len(times) - 1, "the last snapshot"
    time, label = moments[0]
    step = int(np.argmin(np.abs(np.array(times) - time)))
    return step, f"the snapshot nearest to the {label} at {si(time, 's')}"
