"""Head waves beside what ray theory says of them."""

import numpy as np
from pycav.plot.section import Section, bar
from pycav.plot.style import BLUE, GREEN, ORANGE, PINK, logarithmic, styled


@styled
def head_waves(study, time, window):
    """The gradients of stress and pressure near the wall, with where ray theory puts the head waves of the first wave."""
    section = Section.of(study.result, time, window)
    section.mirrored = False
    figure, (axes,) = section.canvas()
    fields = {"solid": ("stress_zz", study.c1**2, r"$|\nabla\sigma_{zz}|\,/\,c_1^2$ / (kg m$^{-4}$)"),
              "fluid": ("pressure", 1.0, r"$|\nabla p|$ / (Pa m$^{-1}$)")}
    for medium, part in section.parts:
        name, scale, label = fields[medium]
        snapshot, raster = section.snapshots[medium], section.raster(medium)
        image = raster.paint(np.hypot(*snapshot.mesh.gradient(snapshot[name]).T) / scale)
        norm = logarithmic(np.nanpercentile(image, 99), 4)
        bar(figure, axes, section.show(axes, raster, image, cmap="gray_r", norm=norm), label, part, "both")
    draw_rays(axes, study, time, section.box)
    section.names(axes, "Head waves")
    return figure


def sound_speed(study):
    """Of the liquid at rest, as in the cell farthest from bubble and wall at t = 0, m/s."""
    first, liquid = study.result.fluid[0], study.result.parameters["fluid"]["liquid"]
    far = first.mesh.centre().sum(1).argmax()
    return np.sqrt(liquid["gamma"] * (first["pressure"][far] + liquid["pi"]) / first["density"][far])


def draw_rays(axes, study, time, box):
    """Fronts of a wave from the bubble's surface at t = 0; the bubble's centre is two radii off the wall."""
    c = sound_speed(study)
    path, depth = c * time + study.radius, 2 * study.radius
    height = np.linspace(0, box[1] - study.wall, 400)
    for speed, colour, name in ((study.c1, BLUE, "head wave, dilatational"), (study.c2, ORANGE, "head wave, shear"),
                                (study.rayleigh_wave_speed(), PINK, "from a Rayleigh wave")):
        sine, cosine = c / speed, np.sqrt(1 - (c / speed) ** 2)
        r = (path - (depth + height) * cosine) / sine
        real = r >= (depth + height) * sine / cosine
        axes.plot(study.wall + height[real], r[real], color=colour, linewidth=0.9, dashes=(5, 3), label=name)
    angle = np.linspace(0, np.pi / 2, 200)
    for centre, name in ((depth, "rarefaction"), (-depth, "its reflection")):
        height = centre - np.sign(centre) * path * np.cos(angle)
        fluid = height >= 0
        axes.plot(study.wall + height[fluid], path * np.sin(angle[fluid]), color=GREEN, linewidth=0.9,
                  dashes=(5, 3) if centre > 0 else (1, 2), label=name)
    axes.legend(loc="lower left", fontsize=7, framealpha=0.9, edgecolor="none", frameon=True)
