"""Numbers over the grids that they are of."""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from .._convergence import Convergence
from .._numbers import number, percent
from .style import BLUE, INK, ORANGE, WIDTH, legend, styled, ticks

USUAL = ("wall_pressure_peak", "wall_pressure_mean_peak", "load_impulse", "collapse_time", "min_equivalent_radius", "von_mises_peak")
"""What is drawn unless something else is asked for."""
PREFIXED = ("Pa", "s", "m", "J", "J/m", "Pa s", "N", "N/m", "N s", "N s/m", "m/s")


@styled
def convergence(study: Convergence | str | os.PathLike[str], *names: str) -> Figure:
    """Values over cells per radius, with Richardson's value and the band of the grid-convergence index about the finest grid's.

    Parameters
    ----------
    study
        What `pycav.convergence` returned, or the directory of a study.
    *names
        Numbers of `convergence.json`; without any those of the wall's pressure, the collapse and the solid's stress that there are.

    Returns
    -------
    matplotlib.figure.Figure
        A panel for each number.

    Raises
    ------
    ValueError
        The study has no such number, or none at all.
    FileNotFoundError
        The directory holds no study.
    """
    if not isinstance(study, Convergence):
        study = Convergence(study)
    known = study.record["numbers"]
    unknown = [name for name in names if name not in known]
    if unknown:
        raise ValueError(f"the study has no {', '.join(unknown)}, only {', '.join(known) or 'no numbers yet'}")
    shown = list(names) or [name for name in USUAL if name in known] or list(known)[:6]
    if not shown:
        raise ValueError("no grid of the study has reached its end")
    columns = min(2, len(shown))
    rows = math.ceil(len(shown) / columns)
    figure = Figure(figsize=(WIDTH, 0.5 + 2.1 * rows), layout="constrained")
    panels = figure.subplots(rows, columns, sharex=True, squeeze=False).ravel()
    cells = [grid["cells_per_radius"] for grid in study.grids]
    has_radius = None not in cells
    along = np.array(cells if has_radius else [2.0**k for k in range(len(cells))], float)
    for axes, name in zip(panels, shown):
        _panel(axes, along, name, known[name])
    for axes in panels[len(shown):]:
        axes.remove()
    for axes in panels[max(0, len(shown) - columns):len(shown)]:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel("cells per radius" if has_radius else "cells, relative to the coarsest grid")
    legend(panels[0])
    return figure


def _panel(axes: Axes, along: np.ndarray[Any, Any], name: str, found: dict[str, Any]) -> None:
    values = np.array([np.nan if value is None else value for value in found["values"]], float)
    axes.set_xscale("log", base=2)
    axes.plot(along, values, color=INK, marker="o", markersize=4, label="grids")
    there = np.flatnonzero(np.isfinite(values))
    if there.size:
        finest = int(there[-1])
        own = found["uncertainties"][finest]
        if own is not None:
            axes.axhspan(values[finest] - own, values[finest] + own, color=BLUE, alpha=0.15, lw=0, label="finest ± GCI")
    if found["richardson"] is not None:
        axes.axhline(found["richardson"], color=ORANGE, linestyle="--", label="Richardson")
    says = found["convergence"].replace("-", " ") if found["order"] is None else f"order {found['order']:.2g}"
    if found["convergence"] == "slow":
        says = "slow: " + says
    if found["gci"] is not None:
        says += f", GCI {percent(found['gci'])}"
    axes.set_title(says, fontsize=8)
    label, unit = name.replace("_", " "), str(found["unit"])
    largest = float(np.nanmax(np.abs(values))) if there.size else 0.0
    if unit in PREFIXED:
        ticks(axes.yaxis, largest, label, unit)
    else:
        axes.set_ylabel(f"{label} / {unit}")
    axes.yaxis.label.set_fontsize(8)
    axes.xaxis.set(major_locator=FixedLocator(list(along)), minor_locator=NullLocator(),
                   major_formatter=FuncFormatter(lambda value, _: number(value)))
    axes.set_xlim(along[0] / 1.3, along[-1] * 1.3)
