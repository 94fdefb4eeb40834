"""Waves: numerical schlieren, and head waves beside what ray theory says of them."""

import numpy as np

from drawing import BLUE, BUBBLE, GREEN, MOST, PINK, bar, bubble_outline, canvas, logarithmic, names, show
from run_directory import MILLI
from snapshots import Raster


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
        if series is run.solid:  # fewer decades where everything is about as strong
            spread = np.log10(strongest / max(np.nanpercentile(image, 2), 1e-12 * strongest, 1e-12))
            decades = np.clip(spread, 1.5, decades)
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
    for speed, colour, name in ((run.c1, BLUE, "head wave, dilatational"), (run.c2, BUBBLE, "head wave, shear"),
                                (run.rayleigh_speed(), PINK, "from a Rayleigh wave")):
        sine, cosine = c / speed, np.sqrt(1 - (c / speed) ** 2)
        r = (path - (depth + height) * cosine) / sine
        real = r >= (depth + height) * sine / cosine
        axes.plot((run.wall + height[real]) * MILLI, r[real] * MILLI, color=colour, linewidth=0.9, dashes=(5, 3),
                  label=name)
    angle = np.linspace(0, np.pi / 2, 200)
    for centre, name in ((depth, "rarefaction"), (-depth, "its reflection")):
        height = centre - np.sign(centre) * path * np.cos(angle)
        fluid = height >= 0
        axes.plot((run.wall + height[fluid]) * MILLI, path * np.sin(angle[fluid]) * MILLI, color=GREEN,
                  linewidth=0.9, dashes=(5, 3) if centre > 0 else (1, 2), label=name)
    axes.legend(loc="lower left", fontsize=7.5, framealpha=0.9, edgecolor="none")
    names(run, axes, time, "Head waves", box)
    return figure
