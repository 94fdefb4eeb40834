"""Runs in ParaView, drawn as reports draw them."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from .._numbers import prefix
from ..mesh import Floats
from ..result import Result, Snapshot, open_run

TEMPLATE = Path(__file__).with_name("state.py")
DECADES, NEARLY_ALL = 3.5, 0.999
"""The scale of the schlieren, as `pycav.plot.overview` has it: so many decades, below what is steeper than this share of the section."""


def paraview_state(
    run: Result | str | os.PathLike[str],
    path: str | os.PathLike[str] | None = None,
    *,
    vtu: bool = False,
) -> Path:
    """Writes a script that opens a run in ParaView as the report draws it, and returns its path.

    Numerical schlieren and the bubble's outline above, von Mises stress below, mirrored about the axis, z upwards, with the time;
    the first view is the snapshot of the largest von Mises stress. `paraview --script=FILE` or *File, Load State…* open it,
    `pvpython FILE --picture PICTURE.png` draws one picture.

    - `path`: of the script; `paraview.py` in the run's directory if left out.
    - `vtu`: for a ParaView before 5.12, which does not read the run's own files: writes the snapshots as `.vtu` beside the script. Needs meshio.
    """
    result = open_run(run)
    target = Path(path) if path is not None else result.directory / "paraview.py"
    target.parent.mkdir(parents=True, exist_ok=True)
    files = {medium: (result.snapshots(medium).export(target.parent / f"{target.stem}-vtu") if vtu
                      else result.directory / f"{medium}.vtkhdf") for medium in result.media}
    told = {"files": {medium: os.path.relpath(file, target.parent) for medium, file in files.items()}, **_scales(result)}
    text = TEMPLATE.read_text().replace('RUN = json.loads("{}")', f"RUN = json.loads({json.dumps(json.dumps(told))})", 1)
    target.write_text(text.replace("A run of pycav", f"The run {result.directory.name} of pycav", 1))
    return target


def _scales(result: Result) -> Mapping[str, object]:
    """The time to begin with, the clock's unit, and ends of the colour scales: of the stress over all snapshots, of the schlieren then."""
    times = result.snapshots(result.media[0]).times
    found: dict[str, object] = {"time": float(times[-1]), "mirrored": _mirrored(result), "clock": _clock(times)}
    if "solid" in result.media:
        largest = [float(snapshot["von_mises"].max()) for snapshot in result.solid if "von_mises" in snapshot]
        if largest:
            found["von_mises"], found["time"] = max([*largest, 1e-12]), float(result.solid.times[int(np.argmax(largest))])
    if "fluid" in result.media:
        snapshot = result.fluid.at(float(str(found["time"])))
        if "schlieren" in snapshot:
            steepest = max(_steepest(snapshot), 1e-12)
            found["schlieren"] = [steepest * 10.0**-DECADES, steepest]
    return found


def _clock(times: Floats) -> dict[str, object]:
    """The unit of the times, with as many decimals, two at least, as tell two snapshots apart."""
    scale, letter = prefix(float(times[-1]))
    apart = scale * float(np.diff(times).min(initial=np.inf))
    decimals = int(np.ceil(-np.log10(apart))) if 0 < apart < np.inf else 0
    return {"scale": scale, "unit": letter.replace("µ", "u") + "s", "decimals": min(max(decimals, 2), 9)}


def _steepest(snapshot: Snapshot) -> float:
    """What all but a thousandth of the section stays below: by area, as small cells are many where it is steep."""
    values, area = snapshot["schlieren"], snapshot.mesh.width().prod(1)
    order = np.argsort(values)
    below = np.cumsum(area[order]) / area.sum()
    return float(values[order][min(int(np.searchsorted(below, NEARLY_ALL)), len(values) - 1)])


def _mirrored(result: Result) -> bool:
    return str(result.parameters.get("geometry", "axisymmetric")) == "axisymmetric"
