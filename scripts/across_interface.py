"""What has to be continuous across the interface: normal velocity, normal stress and pressure."""

import numpy as np
from matplotlib.colors import LogNorm, SymLogNorm

from drawing import BLUE, BUBBLE, INK, MOST, bar, bubble_outline, canvas, names, show
from run_directory import MEGA, MILLI
from snapshots import Raster


def profile_rows(run, field, time, r):
    """A quantity along z at one distance from the axis, from solid and fluid: (z, value) each."""
    rows = []
    for (series, step), name in zip(run.sides(time), field):
        mesh = series.mesh(step)
        edge = 1e-6 * mesh.finest[0]  # to the interface itself, along the slope in its cell
        z = np.arange(mesh.low[0] + mesh.finest[0] / 2, mesh.high[0], mesh.finest[0])
        z = np.concatenate([[mesh.low[0] + edge], z, [mesh.high[0] - edge]])
        values = series.field(name, step)
        values = values[:, 0] if values.ndim == 2 else values
        rows.append((z, mesh.sample(values, np.column_stack([z, np.full_like(z, r)]))))
    return rows


def inset_profile(run, axes, field, signs, time, label, scale=1.0, reach=0.6):
    """A small panel: the quantity along the axis through the interface, where it has to be continuous."""
    rows = profile_rows(run, field, time, 0.02 * run.radius)
    inset = axes.inset_axes([0.065, 0.085, 0.36, 0.2])
    inset.set_facecolor("white")
    reach *= run.radius
    for (z, values), sign, colour in zip(rows, signs, (BLUE, BUBBLE)):
        near = np.abs(z - run.wall) < reach
        inset.plot((z[near] - run.wall) * MILLI, sign * values[near] * scale, color=colour, linewidth=1)
    inset.axvline(0, color=INK, linewidth=0.6)
    inset.tick_params(labelsize=6, length=2, pad=1)
    inset.set_title(label, fontsize=6.5, pad=2)
    inset.margins(x=0)


def velocity(run, time, window):
    figure, (axes,) = canvas(run, window)
    box = run.box(window)
    images = []
    for series, step in run.sides(time):
        raster = Raster(series.mesh(step), box, MOST)
        images.append((raster, raster.paint(series.field("velocity", step)[:, 0])))
    top = max(1.0, *(np.nanpercentile(np.abs(image), 99.95) for _, image in images))
    # From a hundredth of a metre per second in the solid to hundreds in the jet: linear only about 0.
    norm = SymLogNorm(0.05, linscale=0.4, vmin=-top, vmax=top, base=10)
    for raster, image in images:
        drawn = show(axes, raster, image, cmap="RdBu_r", norm=norm)
    ticks = [s * 10.0**k for s in (-1, 1) for k in range(-1, 4) if 10.0**k < top] + [0]
    bar(figure, axes, drawn, "$v_z$ / (m s$^{-1}$), positive away from the solid", extend="both", ticks=sorted(ticks),
        format=lambda v, _: f"{v:g}".replace("-", "−"))
    bubble_outline(run, axes, time, box)
    names(run, axes, time, "Velocity normal to the wall", box)
    inset_profile(run, axes, ("velocity", "velocity"), (1, 1), time,
                  "$v_z$ / (m s$^{-1}$) on the axis, by mm off the wall", reach=0.1)
    return figure


def pressure(run, time, window):
    figure, (axes,) = canvas(run, window)
    box = run.box(window)
    images = []
    for (series, step), name in zip(run.sides(time), ("stress_zz", "pressure")):
        raster = Raster(series.mesh(step), box, MOST)
        images.append((raster, np.abs(raster.paint(series.field(name, step)))))
    top = max(np.nanmax(image) for _, image in images) * MEGA
    norm = LogNorm(top / 30, top, clip=True)
    for raster, image in images:
        drawn = show(axes, raster, image * MEGA, cmap="cividis", norm=norm)
    bar(figure, axes, drawn, r"$|\sigma_{zz}|$ and $|p|$ / MPa", extend="min")
    names(run, axes, time, "Normal stress and pressure", box)
    inset_profile(run, axes, ("stress_zz", "pressure"), (-1, 1), time,
                  r"$-\sigma_{zz}$, $p$ / MPa on the axis, by mm off the wall", MEGA)
    return figure
