"""What has to be continuous across the interface: normal velocity, normal stress and pressure."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, SymLogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter

from .._given import positive
from ..mesh import Floats
from ..result import Snapshot
from .section import Run, Section, Window, bar
from .._numbers import number, prefix
from .style import BLUE, INK, ORANGE, legend, nearly_largest, signed_powers, styled

MEGA = 1e-6


@styled
def interface_continuity(
    run: Run, time: float | None = None, window: Window | None = None, *, what: Sequence[str] = ("velocity", "stress"),
    reach: float | None = None, levels: bool = False,
) -> Figure:
    """v_z in both media, and |σ_zz| beside |p|, each on one scale: nothing may jump at the interface.

    Below, the same along the axis.

    - `what`: "velocity", "stress", or both, a panel each.
    - `reach`: of the lines below, off the wall, m; else a fifth of the window.
    - `levels`: outlines of the levels of refinement.
    """
    section = Section.of(run, time, window)
    if len(section.snapshots) < 2 or section.wall is None:
        raise ValueError("the run has no interface between two media")
    if not what or not set(what) <= set(PANELS):
        raise ValueError(f'what are "velocity" and "stress", not {what!r}')
    figure, panels = section.canvas(len(what), foot=2.75)
    near = 0.2 * (section.box[1] - section.box[0]) if reach is None else positive("reach", reach, "m")
    for name, axes in zip(what, panels):
        PANELS[name](figure, section, axes, near)
        if levels:
            section.levels(axes)
    return figure


def _velocity(figure: Figure, section: Section, axes: Axes, reach: float) -> None:
    images = section.images({medium: snapshot["velocity"][:, 0] for medium, snapshot in section.snapshots.items()})
    top = max(nearly_largest(image, 99.95) for _, image in images)
    # From a hundredth of a metre per second in the solid to hundreds in the jet: linear only about 0.
    linear = top / 5000
    norm = SymLogNorm(linear, linscale=0.4, vmin=-top, vmax=top, base=10)
    drawn = [section.show(axes, raster, image, cmap="RdBu_r", norm=norm) for raster, image in images]
    label = "$v_z$ / (m s$^{-1}$)"
    bar(figure, axes, drawn[-1], label, extend="both", up=2.2, ticks=signed_powers(linear, top, every=2))
    section.bubble(axes)
    section.names(axes, "Normal velocity")
    _below(figure, section, axes, {"solid": ("velocity", 1.0), "fluid": ("velocity", 1.0)}, label, reach)


def _stress(figure: Figure, section: Section, axes: Axes, reach: float) -> None:
    fields = {"solid": "stress_zz", "fluid": "pressure"}
    images = section.images({medium: MEGA * np.abs(section.snapshots[medium][name]) for medium, name in fields.items()})
    highest = max(float(np.nanmax(image)) for _, image in images)
    norm = LogNorm(highest / 30, highest, clip=True)
    drawn = [section.show(axes, raster, image, cmap="cividis", norm=norm) for raster, image in images]
    bar(figure, axes, drawn[-1], r"$|\sigma_{zz}|$ and $|p|$ / MPa", extend="min", up=2.2)
    section.names(axes, "Normal stress")
    fields_below = {"solid": ("stress_zz", -MEGA), "fluid": ("pressure", MEGA)}
    _below(figure, section, axes, fields_below, r"$-\sigma_{zz}$, $p$ / MPa", reach)


PANELS = {"velocity": _velocity, "stress": _stress}


def along(snapshot: Snapshot, values: Floats, r: float, bounded: bool = False) -> tuple[Floats, Floats]:
    """z and a field along z at one distance from the axis, to the very ends of the medium.

    `bounded` as of `Mesh.linear`, but for the two ends: they are that side's own state at the wall, with its slope.
    """
    mesh = snapshot.mesh
    edge = 1e-6 * mesh.finest[0]
    z = np.arange(mesh.low[0] + mesh.finest[0] / 2, mesh.high[0], mesh.finest[0])
    z = np.concatenate([[mesh.low[0] + edge], z, [mesh.high[0] - edge]])
    points = np.column_stack([z, np.full_like(z, r)])
    found = mesh.sample(values, points, bounded=bounded)
    found[[0, -1]] = mesh.sample(values, points[[0, -1]], bounded=False)
    return z, found


def _below(
    figure: Figure, section: Section, axes: Axes, fields: dict[str, tuple[str, float]], label: str, reach: float
) -> None:
    """A small panel below another one: the quantity along the axis through the interface."""
    wall = section.wall or 0.0
    place, inch = axes.get_position(), 1 / figure.get_figheight()
    aside = 0.02 if place.x0 > 0.5 else 0.0  # so that its numbers are not over the panel to the left
    below = figure.add_axes((place.x0 + aside, 0.42 * inch, place.width - aside, 1.1 * inch))
    scale, letter = prefix(reach)
    for (medium, (name, factor)), colour in zip(fields.items(), (BLUE, ORANGE)):
        snapshot = section.snapshots[medium]
        values = snapshot[name]
        r = 0.25 * float(snapshot.mesh.finest[1])
        z, found = along(snapshot, values[:, 0] if values.ndim == 2 else values, r, bounded=name == "pressure")
        near = np.abs(z - wall) < reach
        below.plot((z[near] - wall) * scale, factor * found[near], color=colour, label=medium)
    below.axvline(0, color=INK, linewidth=0.6)
    below.xaxis.set_major_formatter(FuncFormatter(lambda z, _: number(z)))
    below.set_xlabel(f"$z$ off the wall, on the axis / {letter}m", labelpad=1)
    below.set_title(label, fontsize=8, pad=3, loc="left")
    below.tick_params(labelsize=8)
    below.set_xlim(-reach * scale, reach * scale)
    legend(below, fontsize=7)
