"""The bubble close up: density and velocity, and how far the mixture is smeared."""

from __future__ import annotations

from matplotlib.colors import LogNorm, SymLogNorm
from matplotlib.figure import Figure

from .section import Run, Section, Window, bar
from .style import INK, ORANGE, nearly_largest, signed_powers, styled

LINES = ((0.1, INK, 0.4), (0.9, INK, 0.4), (0.5, ORANGE, 0.9))
"""Gas fraction, colour, width."""


@styled
def close_up(run: Run, time: float | None = None, window: Window | None = None, *, levels: bool = False) -> Figure:
    """Density and velocity along z in the fluid, with the lines on which the gas fraction is 0.1, 0.5 and 0.9.

    - `levels`: outlines of the levels of refinement.
    """
    section = Section.of(run, time, window)
    snapshot = section.snapshots.get("fluid")
    raster = section.raster("fluid") if snapshot is not None else None
    if snapshot is None or raster is None:
        raise ValueError("there is nothing of a fluid in the window")
    figure, all_axes = section.canvas(2)
    velocity, fraction = snapshot["velocity"][:, 0], snapshot["gas_fraction"]
    gas = raster.paint(fraction, snapshot.mesh.linear(fraction))
    density, speed = raster.paint(snapshot["density"]), raster.paint(velocity)
    top, usual = nearly_largest(speed), section.usual_density
    signed = SymLogNorm(0.01 * top, linscale=0.5, vmin=-top, vmax=top, base=10)
    drawn = [section.show(all_axes[0], raster, density, cmap="GnBu", norm=LogNorm(0.01 * usual, 5 * usual, clip=True)),
             section.show(all_axes[1], raster, speed, cmap="RdBu_r", norm=signed)]
    bar(figure, all_axes[0], drawn[0], r"density $\rho$ / (kg m$^{-3}$)", extend="both")
    bar(figure, all_axes[1], drawn[1], "$v_z$ / (m s$^{-1}$)", extend="both", ticks=signed_powers(0.005 * top, top))
    for axes, what in zip(all_axes, ("Density", "Velocity along $z$")):
        for level, colour, width in LINES:
            section.contour(axes, raster, gas, level, colors=colour, linewidths=width)
        if levels:
            section.levels(axes)
        section.names(axes, what)
    return figure
