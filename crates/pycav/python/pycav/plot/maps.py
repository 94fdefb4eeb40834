"""Maps over the parameters of a sweep."""

from __future__ import annotations

import numpy as np
import xarray
from matplotlib.figure import Figure

from .style import BLUE, GREEN, GREY, INK, ORANGE, PINK, WIDTH, legend, prefix, styled, ticks

SHOWN = [
    ("wall_pressure_peak", "wall pressure, largest", "Pa"), ("wall_impulse", "impulse on the wall", "Pa s"),
    ("von_mises_peak", "von Mises stress, largest", "Pa"), ("yielded_volume_peak", "yielded volume", "m$^3$"),
]
COLOURS, MARKS = (BLUE, ORANGE, GREEN, PINK, INK, GREY), "osD^vP"


@styled
def stand_off_map(data: xarray.Dataset) -> Figure:
    """Wall-pressure peak, impulse, von Mises peak and yielded volume over the stand-off, a line for every material.

    - `data`: what `pycav.stand_off_map` returned.
    """
    distance = data["stand_off"].to_numpy()
    figure = Figure(figsize=(WIDTH, 4.6), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True).ravel()
    for axes, (name, label, unit) in zip(panels, SHOWN):
        values = data[name].transpose("stand_off", "solid.material").to_numpy()
        for column, material in enumerate(data["solid.material"].to_numpy()):
            axes.plot(distance, values[:, column], color=COLOURS[column % 6], marker=MARKS[column % 6], markersize=4,
                      label=str(material))
        largest = float(np.nanmax(values)) if np.isfinite(values).any() else 0.0
        if unit == "m$^3$":
            scale, letter = prefix(largest ** (1 / 3))  # of a length, whose cube the volume is
            axes.yaxis.set_major_formatter(lambda v, _, s=scale: f"{v * s**3:g}")
            axes.set_ylabel(f"{label} / {letter}{unit}")
        else:
            ticks(axes.yaxis, largest, label, unit)
        axes.set_ylim(min(0.0, 1.05 * float(np.nanmin(values, initial=0.0))), 1.08 * largest or None)
    for axes in panels[2:]:
        axes.set_xlabel("stand-off $d/R$")
    legend(panels[0])
    return figure
