"""The bubble close up: density and velocity, and how far the mixture is smeared."""

import numpy as np
from matplotlib.colors import LogNorm, SymLogNorm

from drawing import BUBBLE, INK, MOST, bar, canvas, contour, names, show
from run_directory import MICRO
from snapshots import Raster


def close_up(run, time, window):
    """Density and normal velocity, with the lines on which the gas fraction is 0.1, 0.5 and 0.9."""
    figure, all_axes = canvas(run, window, 2)
    box = run.box(window)
    step = run.fluid.nearest(time)
    mesh = run.fluid.mesh(step)
    raster = Raster(mesh, box, MOST)
    density = raster.paint(run.fluid.field("density", step))
    speed = raster.paint(run.fluid.field("velocity", step)[:, 0])
    gas = run.fluid.field("gas_fraction", step)
    gas = raster.paint(gas, mesh.gradient(gas))
    top = np.nanpercentile(np.abs(speed), 99.9)
    ticks = [s * 10.0**k for s in (-1, 1) for k in range(1, 4) if 10.0**k < top] + [0]
    parts = [(density, dict(cmap="GnBu", norm=LogNorm(10, 5000, clip=True)), r"density $\rho$ / (kg m$^{-3}$)", {}),
             (speed, dict(cmap="RdBu_r", norm=SymLogNorm(10, linscale=0.5, vmin=-top, vmax=top, base=10)),
              "$v_z$ / (m s$^{-1}$)", dict(ticks=sorted(ticks), format=lambda v, _: f"{v:g}".replace("-", "−")))]
    for axes, (image, style, label, more) in zip(all_axes, parts):
        drawn = show(axes, raster, image, **style)
        for level, colour, width in ((0.1, INK, 0.4), (0.9, INK, 0.4), (0.5, BUBBLE, 0.9)):
            contour(axes, raster, gas, level, colors=colour, linewidths=width)
        bar(figure, axes, drawn, label, extend="both", **more)
        names(run, axes, time, "Bubble", box)
        axes.set_title("Density" if axes is all_axes[0] else "Velocity along $z$", loc="left", fontsize=9, pad=4)
    all_axes[1].set_title(f"$t$ = {time * MICRO:.1f} µs", loc="right", fontsize=9, pad=4)
    return figure
