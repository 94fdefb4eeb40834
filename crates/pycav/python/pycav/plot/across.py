"""What has to be continuous across the interface: normal velocity, normal stress and pressure."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, SymLogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from ..mesh import Floats
from ..result import Snapshot
from .section import Run, Section, Window, bar
from .style import BLUE, INK, ORANGE, legend, number, prefix, styled

MEGA = 1e-6


@styled
def interface_continuity(
    run: Run, time: float | None = None, window: Window | None = None, *, levels: bool = False
) -> Figure:
    """v_z in both media, and |σ_zz| beside |p|, each on one scale: nothing may jump at the interface.

    Below, the same along the axis.
    """
    section = Section.of(run, time, window)
    if len(section.snapshots) < 2 or section.wall is None:
        raise ValueError("the run has no interface between two media")
    figure, (left, right) = section.canvas(2, foot=2.75)
    rasters = {medium: section.raster(medium) for medium in ("solid", "fluid")}
    shown = {medium: raster for medium, raster in rasters.items() if raster is not None}

    velocity = {medium: raster.paint(section.snapshots[medium]["velocity"][:, 0]) for medium, raster in shown.items()}
    top = max(1.0, *(float(np.nanpercentile(np.abs(image), 99.95)) for image in velocity.values()))
    # From a hundredth of a metre per second in the solid to hundreds in the jet: linear only about 0.
    signed = SymLogNorm(0.05, linscale=0.4, vmin=-top, vmax=top, base=10)
    drawn: Any = None
    for medium, raster in shown.items():
        drawn = section.show(left, raster, velocity[medium], cmap="RdBu_r", norm=signed)
    ticks = sorted([s * 10.0**k for s in (-1, 1) for k in (-1, 1, 3) if 10.0**k < top] + [0.0])
    bar(figure, left, drawn, "$v_z$ / (m s$^{-1}$)", extend="both", up=2.2, ticks=ticks)
    section.bubble(left)
    section.names(left, "Normal velocity")
    _below(figure, section, left, {"solid": ("velocity", 1.0), "fluid": ("velocity", 1.0)}, "$v_z$ / (m s$^{-1}$)")

    pressure = {medium: MEGA * np.abs(raster.paint(section.snapshots[medium][name]))
                for (medium, raster), name in zip(shown.items(), ("stress_zz", "pressure"))}
    highest = max(float(np.nanmax(image)) for image in pressure.values())
    scale = LogNorm(highest / 30, highest, clip=True)
    for medium, raster in shown.items():
        drawn = section.show(right, raster, pressure[medium], cmap="cividis", norm=scale)
    bar(figure, right, drawn, r"$|\sigma_{zz}|$ and $|p|$ / MPa", extend="min", up=2.2)
    section.names(right, "Normal stress")
    _below(figure, section, right, {"solid": ("stress_zz", -MEGA), "fluid": ("pressure", MEGA)}, r"$-\sigma_{zz}$, $p$ / MPa")
    if levels:
        section.levels(left)
        section.levels(right)
    return figure


def along(snapshot: Snapshot, values: Floats, r: float) -> tuple[Floats, Floats]:
    """z and a field along z at one distance from the axis, to the very ends of the medium."""
    mesh = snapshot.mesh
    edge = 1e-6 * mesh.finest[0]
    z = np.arange(mesh.low[0] + mesh.finest[0] / 2, mesh.high[0], mesh.finest[0])
    z = np.concatenate([[mesh.low[0] + edge], z, [mesh.high[0] - edge]])
    return z, mesh.sample(values, np.column_stack([z, np.full_like(z, r)]))


def _below(figure: Figure, section: Section, axes: Axes, fields: dict[str, tuple[str, float]], label: str) -> None:
    """A small panel below another one: the quantity along the axis through the interface."""
    wall = section.wall or 0.0
    place, inch = axes.get_position(), 1 / figure.get_figheight()
    aside = 0.02 if place.x0 > 0.5 else 0.0  # so that its numbers are not over the panel to the left
    below = figure.add_axes((place.x0 + aside, 0.42 * inch, place.width - aside, 1.1 * inch))
    reach = 0.2 * (section.box[1] - section.box[0])
    scale, letter = prefix(reach)
    for (medium, (name, factor)), colour in zip(fields.items(), (BLUE, ORANGE)):
        snapshot = section.snapshots[medium]
        values = snapshot[name]
        r = 0.25 * float(snapshot.mesh.finest[1])
        z, found = along(snapshot, values[:, 0] if values.ndim == 2 else values, r)
        near = np.abs(z - wall) < reach
        below.plot((z[near] - wall) * scale, factor * found[near], color=colour, label=medium)
    below.axvline(0, color=INK, linewidth=0.6)
    below.xaxis.set_major_formatter(FuncFormatter(lambda z, _: number(z)))
    below.set_xlabel(f"$z$ off the wall, on the axis / {letter}m", labelpad=1)
    below.set_title(label, fontsize=8, pad=3, loc="left")
    below.tick_params(labelsize=8)
    below.set_xlim(-reach * scale, reach * scale)
    legend(below, fontsize=7)
