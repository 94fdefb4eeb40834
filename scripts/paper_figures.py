#!/usr/bin/env python3
"""The paper's kinds of pictures from a run, as docs/paper.md shows them.

    python3 scripts/paper_figures.py RUN_DIR OUT_DIR [--all]

Draws the paper's figures 5 to 21 at the snapshots nearest to its times, the levels of refinement, pathlines (with 40
snapshots or more) and histories, and prints what can be read off them. With --all every kind at every snapshot instead.
Times and windows scale with the bubble's radius (the paper's figures: 10 mm). Needs scripts/requirements.txt.
"""

import argparse
import io
import re
import sys
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import (LinearSegmentedColormap, ListedColormap, LogNorm, Normalize, SymLogNorm, TwoSlopeNorm,
                               to_rgb)
from PIL import Image

from snapshots import Raster, Series

MICRO, MILLI, MEGA = 1e6, 1e3, 1e-6
INK, GREY, BUBBLE, YIELD = "#1a1a1a", "0.5", "#d55e00", "#d55e00"
DPI = 140
MOST_BYTES = 160 << 10  # of a picture in all colours
MOST = 1400  # pixels of a raster along a side
# Windows (z from, z to, r up to) in radii of the bubble, z counted from the wall.
WIDE, CLOSE, DEEP, DEEPER = (-4.5, 4.5, 4.5), (-1.5, 3.0, 2.25), (-2.0, 0.0, 2.0), (-3.0, 0.0, 3.0)
HEAD = (-1.5, 1.5, 4.6)
STEELS = [("structural steel", 250e6), ("stainless steel", 502e6)]
SOFT = [("aluminium", 95e6), ("copper", 70e6)]
# Number in the paper (or a name), kind, time in µs with R = 10 mm, window.
FIGURES = [
    ("fig05", "schlieren", 16.6, WIDE), ("fig06", "streamlines", 16.6, WIDE),
    ("fig07", "schlieren", 33.1, WIDE), ("fig08", "streamlines", 33.1, WIDE),
    ("fig09", "schlieren", 40.0, CLOSE), ("fig10", "streamlines", 40.0, CLOSE),
    ("fig11", "schlieren", 50.0, CLOSE), ("fig12", "streamlines", 50.0, CLOSE),
    ("fig13", "schlieren", 65.7, CLOSE), ("fig14", "streamlines", 65.7, CLOSE),
    ("fig15", "velocity", 65.7, WIDE), ("fig16", "pressure", 65.7, WIDE),
    ("fig17", "yield", 50.0, DEEP), ("fig18", "yield", 52.0, DEEP),
    ("fig19", "yield", 54.0, DEEP), ("fig20", "yield", 56.0, DEEP), ("fig21", "yield-soft", 50.0, DEEPER),
    ("extra-52us", "schlieren", 52.0, CLOSE), ("extra-56us", "schlieren", 56.0, CLOSE),
    ("extra-16us", "headwaves", 16.6, HEAD), ("levels", "levels", 50.0, WIDE),
]


def part_of(name, low, high):
    """A colour map's part, so that lines drawn over it stay visible."""
    colours = plt.get_cmap(name)(np.linspace(low, high, 256))
    return LinearSegmentedColormap.from_list(f"{name} {low}-{high}", colours, 64)


def logarithmic(top, decades):
    """A scale of some decades below a value, which may be 0 before anything has happened."""
    top = max(top, 1e-12)
    return LogNorm(top / 10**decades, top, clip=True)


class Run:
    """A run directory, and the scales of its case."""

    def __init__(self, path):
        self.path = path
        if not (path / "fluid.vtkhdf").exists() or not (path / "solid.vtkhdf").exists():
            sys.exit(f"{path} does not hold fluid.vtkhdf and solid.vtkhdf: is it the directory of a coupled run?")
        self.fluid, self.solid = Series(path / "fluid.vtkhdf"), Series(path / "solid.vtkhdf")
        case = (path / "case.toml").read_text()
        radius = re.search(r"^radius = (\S+)", case, re.M)
        self.radius = float(radius[1]) if radius else 0.01
        liquid = case[case.index("[fluid.liquid]") :]
        self.gamma, self.pi, self.c1, self.c2 = (
            float(re.search(rf"^{key} = (\S+)", liquid, re.M)[1]) for key in ("gamma", "pi", "c1", "c2"))
        self.wall = float(self.fluid.mesh(0).low[0])
        self.slowness = self.radius / 0.01  # the paper's times fit a radius of 10 mm

    def time_of(self, microseconds):
        """The snapshot time for a time in the paper, None if there is none within 1 % of the paper's last."""
        wanted = microseconds / MICRO * self.slowness
        found = self.fluid.times[self.fluid.nearest(wanted)]
        return found if abs(found - wanted) < 0.66 / MICRO * self.slowness else None

    def box(self, window):
        low, high, reach = (x * self.radius for x in window)
        return self.wall + low, self.wall + high, 0.0, reach

    def sides(self, time):
        """For each medium: its snapshots and the number of the one at `time`."""
        return [(series, series.nearest(time)) for series in (self.solid, self.fluid)]


def mirrored(image, sign=1):
    return np.vstack([sign * image[::-1], image])


def show(axes, raster, image, sign=1, **style):
    """An image of a half section and its mirror image."""
    extent = [raster.low[0] * MILLI, raster.high[0] * MILLI, -raster.high[1] * MILLI, raster.high[1] * MILLI]
    return axes.imshow(mirrored(image, sign), origin="lower", extent=extent, **style)


def contour(axes, raster, image, level, **style):
    if np.nanmin(image) < level < np.nanmax(image):
        r = np.concatenate([-raster.r[::-1], raster.r]) * MILLI
        axes.contour(raster.z * MILLI, r, mirrored(image), [level], **style)


def bubble_outline(run, axes, time, box):
    """The line on which half is gas."""
    step = run.fluid.nearest(time)
    if "gas_fraction" in run.fluid.fields():
        mesh, gas = run.fluid.mesh(step), run.fluid.field("gas_fraction", step)
        raster = Raster(mesh, box, MOST // 2)
        contour(axes, raster, raster.paint(gas, mesh.gradient(gas)), 0.5, colors=BUBBLE, linewidths=0.9)


def canvas(run, window, panels=1, one_sided=False):
    """A figure with panels of equal scale side by side, room for bars below."""
    low, high, _, top = run.box(window)
    bottom = 0.0 if one_sided else -top
    tall = (top - bottom) / (high - low)
    width = 5.2 / panels if panels > 1 else 4.6
    left, gap, foot, head = 0.62, 0.25, 0.98, 0.34
    size = (left + panels * width + (panels - 1) * gap + 0.2, foot + tall * width + head)
    figure = plt.figure(figsize=size)
    all_axes = []
    for panel in range(panels):
        axes = figure.add_axes([(left + panel * (width + gap)) / size[0], foot / size[1],
                                width / size[0], tall * width / size[1]])
        axes.set(xlim=(low * MILLI, high * MILLI), ylim=(bottom * MILLI, top * MILLI), aspect="equal")
        axes.set_xlabel("$z$ / mm")
        axes.yaxis.set_major_formatter(lambda r, _: f"{abs(r):g}")  # both halves are the same
        axes.tick_params(labelleft=panel == 0)
        all_axes.append(axes)
    all_axes[0].set_ylabel("$r$ / mm", labelpad=2)
    return figure, all_axes


def bar(figure, axes, drawn, label, part=(0.0, 1.0), extend="neither", **more):
    """A slim bar below a part of a panel."""
    place = axes.get_position()
    inch = 1 / figure.get_figheight()
    x, width = place.x0 + part[0] * place.width, (part[1] - part[0]) * place.width
    into = figure.add_axes([x + 0.02 * width, 0.42 * inch, 0.96 * width, 0.09 * inch])
    colours = figure.colorbar(drawn, cax=into, orientation="horizontal", extend=extend, extendfrac=0.03, **more)
    colours.set_label(label, labelpad=1)
    colours.outline.set_linewidth(0.5)
    colours.ax.tick_params(width=0.5, length=2.5)
    return colours


def names(run, axes, time, what, box):
    """The media's names, the interface, the axis, a title."""
    wall = run.wall * MILLI
    axes.axhline(0, color=GREY, linewidth=0.5, dashes=(8, 3, 1.5, 3))
    axes.axvline(wall, color=INK, linewidth=1.1)
    frame = dict(boxstyle="square,pad=0.2", facecolor="white", edgecolor="none", alpha=0.85)
    style = dict(va="top", style="italic", color=INK, bbox=frame, transform=axes.get_xaxis_transform())
    # Between the points of the text and the frame of the panel.
    axes.text(box[0] * MILLI + 0.015 * (box[1] - box[0]) * MILLI, 0.975, "solid", ha="left", **style)
    if box[1] > run.wall:
        axes.text(box[1] * MILLI - 0.015 * (box[1] - box[0]) * MILLI, 0.975, "fluid", ha="right", **style)
    axes.set_title(f"{what}, $t$ = {time * MICRO:.1f} µs", loc="left", fontsize=9, pad=4)


def solid_gradient(run, step):
    """|grad σ_zz| / c1²: for a dilatational wave along z the |grad ρ| of the solid; shear waves show as well."""
    mesh = run.solid.mesh(step)
    return np.hypot(*mesh.gradient(run.solid.field("stress_zz", step)).T) / run.c1**2


def fluid_gradient(run, step):
    if "schlieren" in run.fluid.fields():
        return run.fluid.field("schlieren", step)
    return np.hypot(*run.fluid.mesh(step).gradient(run.fluid.field("density", step)).T)


def schlieren(run, time, window):
    figure, (axes,) = canvas(run, window)
    box = run.box(window)
    # The solid's waves change its density by less, about as ρc² is greater: a scale of its own.
    parts = [(run.solid, solid_gradient, (0, 0.48), r"$|\nabla\sigma_{zz}|\,/\,c_1^2$ / (kg m$^{-4}$)", 2.5),
             (run.fluid, fluid_gradient, (0.52, 1), r"$|\nabla\rho|$ / (kg m$^{-4}$)", 4.0)]
    for series, gradient, part, label, decades in parts:
        step = series.nearest(time)
        raster = Raster(series.mesh(step), box, MOST)
        image = raster.paint(gradient(run, step))
        strongest = np.nanpercentile(image, 99.8)
        drawn = show(axes, raster, image, cmap="gray_r", norm=logarithmic(strongest, decades))
        bar(figure, axes, drawn, label, part, "both")
    bubble_outline(run, axes, time, box)
    names(run, axes, time, "Numerical schlieren", box)
    return figure


def headwaves(run, time, window):
    """The fluid near the wall by its pressure gradient, with where ray theory puts the head waves of the first wave."""
    figure, (axes,) = canvas(run, window, one_sided=True)
    box = run.box(window)
    for series, name, scale, part, label in (
            (run.solid, "stress_zz", run.c1**2, (0, 0.48), r"$|\nabla\sigma_{zz}|\,/\,c_1^2$ / (kg m$^{-4}$)"),
            (run.fluid, "pressure", 1.0, (0.52, 1), r"$|\nabla p|$ / (Pa m$^{-1}$)")):
        step = series.nearest(time)
        mesh = series.mesh(step)
        raster = Raster(mesh, box, MOST)
        image = raster.paint(np.hypot(*mesh.gradient(series.field(name, step)).T) / scale)
        strongest = np.nanpercentile(image, 99)
        drawn = show(axes, raster, image, cmap="gray_r", norm=logarithmic(strongest, 4))
        bar(figure, axes, drawn, label, part, "both")
    # Sound in the liquid at rest, as in the cell farthest from bubble and wall at t = 0.
    far = run.fluid.mesh(0).centre().sum(1).argmax()
    density, pressure = (run.fluid.field(name, 0)[far] for name in ("density", "pressure"))
    c = np.sqrt(run.gamma * (pressure + run.pi) / density)
    # A wave from the bubble's surface at t = 0; the bubble's centre is two radii off the wall.
    path, depth = c * time + run.radius, 2 * run.radius
    height = np.linspace(0, box[1] - run.wall, 400)
    for speed, colour, name in ((run.c1, "#0072b2", "dilatational"), (run.c2, "#d55e00", "shear")):
        sine, cosine = c / speed, np.sqrt(1 - (c / speed) ** 2)
        r = (path - (depth + height) * cosine) / sine
        real = r >= (depth + height) * sine / cosine
        axes.plot((run.wall + height[real]) * MILLI, r[real] * MILLI, color=colour, linewidth=0.9, dashes=(5, 3),
                  label=f"head wave, {name}")
    angle = np.linspace(0, np.pi / 2, 200)
    for centre, name in ((depth, "rarefaction"), (-depth, "its reflection")):
        height = centre - np.sign(centre) * path * np.cos(angle)
        fluid = height >= 0
        axes.plot((run.wall + height[fluid]) * MILLI, path * np.sin(angle[fluid]) * MILLI, color="#009e73",
                  linewidth=0.9, dashes=(5, 3) if centre > 0 else (1, 2), label=name)
    axes.legend(loc="lower left", fontsize=7.5, framealpha=0.9, edgecolor="none")
    names(run, axes, time, "Head waves", box)
    return figure


def velocity_rasters(series, step, box, most):
    """v_z and v_r, linear within cells."""
    mesh, velocity = series.mesh(step), series.field("velocity", step)
    raster = Raster(mesh, box, most)
    return raster, [raster.paint(velocity[:, a], mesh.gradient(velocity[:, a], (1, -1)[a])) for a in (0, 1)]


def trace(raster, v_z, v_r, density):
    """Evenly spaced streamlines in r > 0, as arrays of points in mm."""
    scratch = plt.figure()
    axes = scratch.add_subplot()
    # Not those that creep along the axis, which would meet their mirror images.
    off = max(1, len(raster.r) // 40)
    z, r, v_z, v_r = raster.z * MILLI, raster.r[off:] * MILLI, v_z[off:], v_r[off:]
    axes.set(xlim=(z[0], z[-1]), ylim=(r[0], r[-1]))
    lines = axes.streamplot(z, r, v_z, v_r, density=density, minlength=0.2, maxlength=8).lines
    joined = []
    for segment in lines.get_segments():
        if joined and np.allclose(joined[-1][-1], segment[0]):
            joined[-1].extend(segment[1:])
        else:
            joined.append(list(segment))
    plt.close(scratch)
    return [np.array(line) for line in joined]


def draw_lines(axes, lines, window_length, **style):
    """Lines of a half section on both sides, with an arrow head in the middle of the longer ones."""
    both = lines + [line * [1, -1] for line in lines]
    axes.add_collection(LineCollection(both, **style))
    for line in both:
        along = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
        if along[-1] > 0.05 * window_length:
            before, middle, after = (np.array([np.interp(share * along[-1], along, line[:, a]) for a in (0, 1)])
                                     for share in (0.49, 0.5, 0.51))
            angle = np.degrees(np.arctan2(*(after - before)[::-1]))
            axes.plot(*middle, marker=(3, 0, angle - 90), color=style["colors"], markersize=3.2, markeredgewidth=0)


def streamlines(run, time, window):
    figure, (axes,) = canvas(run, window)
    box = run.box(window)
    length = (box[1] - box[0]) * MILLI
    (solid, solid_step), (fluid, fluid_step) = run.sides(time)

    raster = Raster(fluid.mesh(fluid_step), box, MOST)
    image = raster.paint(fluid.field("density", fluid_step))
    drawn = show(axes, raster, image, cmap=part_of("GnBu", 0.0, 0.75), norm=Normalize(0, max(1100, np.nanmax(image))))
    bar(figure, axes, drawn, r"density $\rho$ / (kg m$^{-3}$)", (0.52, 1))
    raster = Raster(solid.mesh(solid_step), box, MOST)
    speed = raster.paint(np.hypot(*solid.field("velocity", solid_step)[:, :2].T))
    top = np.nanpercentile(speed, 99.9)
    drawn = show(axes, raster, speed, cmap=part_of("YlOrBr", 0.0, 0.6), norm=logarithmic(top, 2))
    bar(figure, axes, drawn, r"speed $|\mathbf{v}|$ / (m s$^{-1}$)", (0, 0.48), "both")

    for series, step in run.sides(time):
        coarse, (v_z, v_r) = velocity_rasters(series, step, box, 320)
        fast = np.hypot(v_z, v_r)
        still = fast < 2e-3 * np.nanpercentile(fast, 99)
        if still.all() or not fast.max() > 0:
            continue
        v_z, v_r = np.where(still, np.nan, v_z), np.where(still, np.nan, v_r)
        span = np.array([coarse.high[0] - coarse.low[0], coarse.high[1]]) * MILLI / length
        draw_lines(axes, trace(coarse, v_z, v_r, tuple(2.6 * span)), length, colors=INK, linewidths=0.55)
    bubble_outline(run, axes, time, box)
    names(run, axes, time, "Streamlines", box)
    return figure


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
    for (z, values), sign, colour in zip(rows, signs, ("#0072b2", "#d55e00")):
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


def yielding(run, time, window, materials):
    figure, all_axes = canvas(run, window, 2)
    box = run.box(window)
    series, step = run.sides(time)[0]
    mesh, stress = series.mesh(step), series.field("von_mises", step)
    raster = Raster(mesh, box, MOST)
    image, smooth = raster.paint(stress), raster.paint(stress, mesh.gradient(stress))
    for axes, (name, strength) in zip(all_axes, materials):
        norm = TwoSlopeNorm(0, -strength * MEGA, max(0.5 * strength, stress.max() - strength) * MEGA)
        drawn = show(axes, raster, (image - strength) * MEGA, cmap="PuOr_r", norm=norm)
        contour(axes, raster, smooth - strength, 0.0, colors=INK, linewidths=1.0)
        names(run, axes, time, f"{name}, $Y_0$ = {strength * MEGA:.0f} MPa", box)
        axes.set_title(axes.get_title(loc="left").split(", $t$")[0], loc="left", fontsize=9, pad=4)
        axes.text(0.98, 0.03, f"largest {(stress.max() - strength) * MEGA:+.0f} MPa".replace("-", "−"), ha="right",
                  transform=axes.transAxes, fontsize=8, color=INK,
                  bbox=dict(boxstyle="square,pad=0.2", facecolor="white", edgecolor="none", alpha=0.85))
        bar(figure, axes, drawn, r"$\Phi = \sigma_\mathrm{vM} - Y_0$ / MPa")
    all_axes[1].set_title(f"$t$ = {time * MICRO:.1f} µs", loc="right", fontsize=9, pad=4)
    return figure


def levels(run, time, window):
    figure, (axes,) = canvas(run, window)
    box = run.box(window)
    for (series, step), part, name in zip(run.sides(time), ((0, 0.48), (0.52, 1)), ("solid", "fluid")):
        mesh, level = series.mesh(step), series.field("level", step).astype(int)
        raster = Raster(mesh, box, MOST)
        low, high = level.min(), level.max()
        colours = ListedColormap(plt.get_cmap("YlGnBu")(np.linspace(0.05, 0.75, high - low + 1)))
        drawn = show(axes, raster, raster.paint(level), cmap=colours, norm=Normalize(low - 0.5, high + 0.5))
        bar(figure, axes, drawn, f"level in the {name}", part, ticks=np.arange(low, high + 1))
        blocks = np.unique(np.column_stack([mesh.index // 16, mesh.depth]), axis=0)
        width = mesh.finest * 16 * 2.0 ** blocks[:, 2:]
        corner = mesh.low + blocks[:, :2] * width
        box_low, box_high = np.array(box)[[0, 2]], np.array(box)[[1, 3]]
        # Outlines closer than about four pixels would be a black spot.
        seen = ((corner + width > box_low) & (corner < box_high) & (width > 0.006 * (box[1] - box[0]))).all(1)
        z0, r0 = (corner[seen] * MILLI).T
        z1, r1 = ((corner + width)[seen] * MILLI).T
        for sign in (-1, 1):
            outlines = np.stack([np.column_stack(c) for c in ((z0, sign * r0), (z1, sign * r0), (z1, sign * r1),
                                                              (z0, sign * r1), (z0, sign * r0))], axis=1)
            axes.add_collection(LineCollection(outlines, colors=INK, linewidths=0.25))
    bubble_outline(run, axes, time, box)
    names(run, axes, time, "Levels, and blocks of 16 × 16 cells", box)
    return figure


def pathlines(run, window):
    """Particles carried from t = 0 to the end by the velocities of the snapshots, linear in space and time."""
    figure, (axes,) = canvas(run, window)
    box = run.box(window)
    spacing = run.radius / 5
    tracks = {}
    for series in (run.solid, run.fluid):
        low = np.maximum([box[0], box[2]], series.mesh(0).low)
        high = np.minimum([box[1], box[3]], series.mesh(0).high)
        z, r = (np.arange(a + spacing / 2, b, spacing) for a, b in zip(low, high))
        start = np.stack(np.meshgrid(z, r, indexing="ij"), -1).reshape(-1, 2)
        moves = series is run.fluid
        at, track = start.copy(), [start.copy()]
        for step in range(len(series.times) - 1):
            ends = [(series.mesh(k), series.field("velocity", k)) for k in (step, step + 1)]
            parts = 16 if moves else 1
            dt = (series.times[step + 1] - series.times[step]) / parts
            for part in range(parts):
                def carried(points, share):
                    found = np.column_stack([
                        (1 - share) * ends[0][0].sample(ends[0][1][:, a], points, (1, -1)[a])
                        + share * ends[1][0].sample(ends[1][1][:, a], points, (1, -1)[a]) for a in (0, 1)])
                    return np.nan_to_num(found)
                # Heun's method. The solid's particles hardly move, so their velocity is taken where they began.
                first = carried(at if moves else start, part / parts)
                second = carried(at + dt * first if moves else start, (part + 1) / parts)
                at = at + 0.5 * dt * (first + second)
                at[:, 1] = np.abs(at[:, 1])
            track.append(at.copy())
        tracks[series] = np.stack(track, 1)

    track = tracks[run.solid]
    moved = track - track[:, :1]
    far = np.hypot(*np.moveaxis(moved, -1, 0)).max()
    times = 10 ** np.floor(np.log10(2.0 * spacing / far))
    times *= max(m for m in (1, 2, 5) if m * times * far <= 2.0 * spacing)
    lines = [(track[:, :1] + times * moved) * MILLI]
    lines.append(tracks[run.fluid] * MILLI)
    gas = run.fluid.mesh(0).sample(run.fluid.field("gas_fraction", 0), tracks[run.fluid][:, 0]) > 0.5
    for group, colour in ((lines[0], INK), (lines[1][~gas], "#0072b2"), (lines[1][gas], BUBBLE)):
        for sign in (1, -1):
            axes.add_collection(LineCollection(list(group * [1, sign]), colors=colour, linewidths=0.5))
            axes.plot(*(group[:, -1] * [1, sign]).T, ".", color=colour, markersize=1.6, markeredgewidth=0)
    names(run, axes, run.fluid.times[-1], "Pathlines up to", box)
    axes.set_title(axes.get_title(loc="left").replace("to, ", "to "), loc="left", fontsize=9, pad=4)
    figure.text(0.12, 0.03, f"From $t$ = 0 to the dots. Blue: began in the liquid. Orange: began in the gas.\n"
                f"Solid: displacements {times:g} times enlarged (largest {far * MICRO:.2g} µm).", fontsize=8,
                linespacing=1.4)
    return figure


def histories(run):
    with h5py.File(run.path / "history.h5") as file:
        time, wall = file["time"][:] * MICRO, file["wall/pressure_axis"][:] * MEGA
        solid_time, stress = file["solid/time"][:] * MICRO, file["solid/von_mises_max"][:] * MEGA
        place = file["solid/von_mises_max_position"][:] * MILLI
        radius = file["bubble/equivalent_radius"][:] / run.radius
    figure, (top, middle, bottom) = plt.subplots(3, 1, sharex=True, figsize=(5.6, 5.2),
                                                 gridspec_kw=dict(height_ratios=(1, 2, 1), hspace=0.08))
    top.plot(time, radius, color="#0072b2", linewidth=1)
    top.set(ylabel=r"$R_\mathrm{eq}\,/\,R$", ylim=(0, None))
    middle.plot(time, wall, color="#0072b2", linewidth=1, label="pressure on the wall, on the axis")
    middle.plot(solid_time, stress, color="#d55e00", linewidth=1, label="von Mises stress, largest in the solid")
    for name, strength in STEELS:
        middle.axhline(strength * MEGA, color=GREY, linewidth=0.6, dashes=(4, 3))
        middle.text(0.5 * run.slowness, strength * MEGA - 5, f"yield strength, {name}", fontsize=7, color="0.35",
                    va="top")
    middle.set(ylabel="MPa", ylim=(0, 560))
    middle.legend(frameon=False, loc="center left", bbox_to_anchor=(0.0, 0.68), fontsize=8)
    place[stress < 1.05 * stress[0]] = np.nan  # before the first wave every place is as good
    bottom.plot(solid_time, run.wall * MILLI - place[:, 0], color="#d55e00", linewidth=0.8, label="below the wall")
    bottom.plot(solid_time, place[:, 1], color="#009e73", linewidth=0.8, label="off the axis")
    bottom.set(xlabel="$t$ / µs", ylabel="place of the\nlargest stress / mm", xlim=(0, time[-1]),
               ylim=(0, 1.4 * np.nanmax(place)))
    bottom.legend(frameon=False, fontsize=8, ncols=2, loc="upper left")
    figure.subplots_adjust(0.12, 0.09, 0.98, 0.985)
    return figure


KINDS = {
    "schlieren": schlieren, "streamlines": streamlines, "headwaves": headwaves, "velocity": velocity,
    "pressure": pressure, "levels": levels,
    "yield": lambda run, time, window: yielding(run, time, window, STEELS),
    "yield-soft": lambda run, time, window: yielding(run, time, window, SOFT),
}


def style():
    plt.rcParams.update({
        "font.family": "serif", "font.serif": ["STIX Two Text", "STIXGeneral", "DejaVu Serif"],
        "mathtext.fontset": "stix", "font.size": 9, "axes.linewidth": 0.6, "axes.edgecolor": INK,
        "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.major.size": 3, "ytick.major.size": 3,
        "savefig.facecolor": "white",
    })


def palette(figure):
    """256 colours that serve a figure: those of its maps, the same under lines, and those of lines and text."""
    maps = {image.cmap.name: image.cmap for axes in figure.axes for image in axes.images}.values()
    lines = np.array([to_rgb(c) for c in (INK, GREY, BUBBLE, "#0072b2", "#009e73", "white")])
    ink, white = lines[0], lines[-1]
    paler = np.linspace(0.15, 0.85, 6)
    found = [lines, *(c + (white - c) * share for c in lines[:-1] for share in paler)]
    for colours in maps:
        full = colours(np.linspace(0, 1, 128 // len(maps)))[:, :3]
        found += [full, *(full[::4] + (ink - full[::4]) * share for share in (0.3, 0.6))]
    flat = (np.vstack([np.atleast_2d(c).reshape(-1, 3) for c in found])[:256] * 255).round().astype(np.uint8)
    image = Image.new("P", (1, 1))
    image.putpalette(flat.tobytes() + flat[-1].tobytes() * (256 - len(flat)))
    return image


def save(figure, path):
    """In all colours if that takes little room, else with a palette."""
    buffer = io.BytesIO()
    figure.savefig(buffer, dpi=DPI)
    image = Image.open(buffer).convert("RGB")
    image.save(path, optimize=True)
    if path.stat().st_size > MOST_BYTES:
        image.quantize(palette=palette(figure), dither=Image.Dither.NONE).save(path, optimize=True)
    plt.close(figure)
    print(f"{path}  {path.stat().st_size / 1024:.0f} KiB")


def report(run):
    """What can be read off the pictures, in numbers."""
    with h5py.File(run.path / "history.h5") as file:
        history = {name: file[name][:] for name in ("time", "wall/pressure_axis", "bubble/equivalent_radius")}
    for microseconds in sorted({figure[2] for figure in FIGURES}):
        time = run.time_of(microseconds)
        if time is None:
            continue
        (solid, solid_step), (fluid, fluid_step) = run.sides(time)
        wall, radius = (np.interp(time, history["time"], history[name])
                        for name in ("wall/pressure_axis", "bubble/equivalent_radius"))
        mesh, stress = solid.mesh(solid_step), solid.field("von_mises", solid_step)
        z, r = mesh.centre(np.array([stress.argmax()]))[0] * MILLI
        volume = 2 * np.pi * (mesh.centre()[:, 1] * mesh.width().prod(1))[stress > 250e6].sum()
        density, gas = (fluid.field(name, fluid_step) for name in ("density", "gas_fraction"))
        gas_z = fluid.mesh(fluid_step).centre()[gas > 0.5, 0] * MILLI
        fastest = [np.hypot(*series.field("velocity", step)[:, :2].T).max() for series, step in run.sides(time)]
        print(f"\nt = {time * MICRO:.1f} µs")
        print(f"  wall pressure on the axis {wall * MEGA:.1f} MPa")
        print(f"  largest von Mises stress {stress.max() * MEGA:.1f} MPa, {run.wall * MILLI - z:.2f} mm below the wall,"
              f" {r:.2f} mm off the axis; above 250 MPa in {volume * MILLI**3:.2f} mm3")
        print(f"  R_eq {radius * MILLI:.2f} mm; density {density.min():.4g} to {density.max():.4g} kg/m3")
        if len(gas_z):
            print(f"  gas fraction above 1/2 from z = {gas_z.min():.2f} to {gas_z.max():.2f} mm")
        print(f"  fastest {fastest[1]:.0f} m/s in the fluid, {fastest[0]:.2f} m/s in the solid")

    time = run.solid.times[-1]
    (solid, solid_step), (fluid, fluid_step) = run.sides(time)
    below, above = solid.mesh(solid_step), fluid.mesh(fluid_step)
    r = np.arange(1, 400) / 400 * min(below.high[1], above.high[1])
    left, right = (np.column_stack([np.full_like(r, run.wall + side * below.finest[0]), r]) for side in (-1e-6, 1e-6))
    print(f"\nalong the interface at {time * MICRO:.1f} µs, cells extrapolated to it")
    for name, unit, scale, one, other in (
            ("v_z", "m/s", 1, below.sample(solid.field("velocity", solid_step)[:, 0], left),
             above.sample(fluid.field("velocity", fluid_step)[:, 0], right)),
            ("p", "MPa", MEGA, -below.sample(solid.field("stress_zz", solid_step), left),
             above.sample(fluid.field("pressure", fluid_step), right))):
        print(f"  {name} {other.min() * scale:.3g} to {other.max() * scale:.3g} {unit},"
              f" rms difference {np.sqrt(np.mean((one - other) ** 2)) * scale:.2g} {unit}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="directory of a coupled run")
    parser.add_argument("out", type=Path, metavar="OUT_DIR", help="directory for the pictures")
    parser.add_argument("--all", action="store_true", help="every kind at every snapshot instead")
    parser.add_argument("--only", metavar="NAME", help="only pictures whose name contains this")
    arguments = parser.parse_args()
    run = Run(arguments.run)
    arguments.out.mkdir(parents=True, exist_ok=True)
    style()

    figures = FIGURES
    if arguments.all:
        windows = dict.fromkeys(KINDS, WIDE) | {"yield": DEEP, "yield-soft": DEEPER, "headwaves": HEAD}
        figures = [(f"{time * MICRO:05.2f}us", kind, time * MICRO / run.slowness, windows[kind])
                   for time in run.fluid.times for kind in KINDS]
    for name, kind, microseconds, window in figures:
        time = run.time_of(microseconds)
        file = f"{name}.png" if name == kind else f"{name}-{kind}.png"
        if arguments.only and arguments.only not in file:
            continue
        if time is None:
            print(f"{file}: left out, no snapshot near {microseconds * run.slowness:g} µs", file=sys.stderr)
            continue
        save(KINDS[kind](run, time, window), arguments.out / file)
    if not arguments.only or arguments.only in "pathlines.png":
        if len(run.fluid.times) >= 40:
            save(pathlines(run, WIDE), arguments.out / "pathlines.png")
        else:
            print("pathlines.png: left out, needs 40 snapshots or more", file=sys.stderr)
    if not arguments.only or arguments.only in "histories.png":
        save(histories(run), arguments.out / "histories.png")
    report(run)


if __name__ == "__main__":
    main()
