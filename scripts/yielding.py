"""Where the solid would yield: von Mises stress minus yield strength."""

import numpy as np
from matplotlib.colors import TwoSlopeNorm

from drawing import INK, MOST, bar, canvas, contour, names, show
from run_directory import MEGA, MICRO
from snapshots import Raster

STEELS = [("structural steel", 250e6), ("stainless steel", 502e6)]
SOFT = [("aluminium", 95e6), ("copper", 70e6)]


def near_axis(run, mesh):
    """The cells within a tenth of the bubble's radius of the axis."""
    return mesh.centre()[:, 1] < 0.1 * run.radius


def yielding(run, time, window, materials):
    figure, all_axes = canvas(run, window, 2)
    box = run.box(window)
    series, step = run.sides(time)[0]
    mesh, stress = series.mesh(step), series.field("von_mises", step)
    raster = Raster(mesh, box, MOST)
    image, smooth = raster.paint(stress), raster.paint(stress, mesh.gradient(stress))
    near = stress[near_axis(run, mesh)].max()
    for axes, (name, strength) in zip(all_axes, materials):
        # The very largest values fill a few cells at the surface: the colours end where there is something to see.
        top = max(0.5 * strength, np.nanpercentile(image, 99.9) - strength)
        drawn = show(axes, raster, (image - strength) * MEGA, cmap="PuOr_r",
                     norm=TwoSlopeNorm(0, -strength * MEGA, top * MEGA))
        contour(axes, raster, smooth - strength, 0.0, colors=INK, linewidths=1.0)
        names(run, axes, time, f"{name}, $Y_0$ = {strength * MEGA:.0f} MPa", box)
        axes.set_title(axes.get_title(loc="left").split(", $t$")[0], loc="left", fontsize=9, pad=4)
        text = (f"largest near the axis {(near - strength) * MEGA:+.0f} MPa\n"
                f"anywhere {(stress.max() - strength) * MEGA:+.0f} MPa")
        axes.text(0.03, 0.02, text.replace("-", "−"), ha="left", transform=axes.transAxes, fontsize=8, color=INK,
                  bbox=dict(boxstyle="square,pad=0.2", facecolor="white", edgecolor="none", alpha=0.85))
        bar(figure, axes, drawn, r"$\Phi = \sigma_\mathrm{vM} - Y_0$ / MPa",
            extend="max" if stress.max() - strength > top else "neither")
    all_axes[1].set_title(f"$t$ = {time * MICRO:.1f} µs", loc="right", fontsize=9, pad=4)
    return figure
