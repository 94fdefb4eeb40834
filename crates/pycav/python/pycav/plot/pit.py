"""The pit that stays: the surface's profile, and the plastic zone below it."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter

from .._given import positive
from ..mesh import Floats, Raster
from .plastic import LABEL, LINES, colours, strain_of
from .section import Run, Section, bar, last_shown
from .._numbers import number, prefix, si
from .style import BLUE, GREEN, GREY, INK, ORANGE, PINK, WHITE, WIDTH, legend, styled
from .surface import Profile, has_pit

LEFT, RIGHT, FOOT, HEAD, GAP, UPPER = 0.7, 0.2, 0.95, 0.3, 0.14, 1.9  # inches about and of the panels
MOST = 700  # pixels of the section along a side
COLOURS, DASHES = (BLUE, ORANGE, GREEN, PINK), ("-", "--", ":", "-.")
BELOW = 0.82  # of the upper panel is below the level far away
ABOVE = 0.03  # of the depth shown is above it in the lower one


@styled
def pit(
    run: Run, time: float | None = None, reach: float | None = None, *, beside: Sequence[Run] = (),
    names: Sequence[str] | None = None, strongest: tuple[float, float] | None = None,
) -> Figure:
    """The pit: above, the surface's depth below its level far away, stretched; below, the plastic strain at true scale.

    The axis says how much is stretched. The strain is that of the nearest snapshot and hangs from the deformed surface; lines are
    at 1e-4 and 2e-3. At the end of a run, depth, radius at half of it, rim and volume are those of `result.summary`, and where
    that tells of no pit the picture does.

    - `time`: of the profile, s; else the end.
    - `reach`: from the axis and below the surface, m; else a little more than the plastic zone.
    - `beside`: runs whose profiles at that time are drawn, too.
    - `names`: of the run and those beside; else their cells per radius.
    - `strongest`: the depth in m and the plastic strain at the ends of the scales, for pictures that are to be compared.
    """
    reach = None if reach is None else positive("reach", reach, "m")
    profiles = [Profile.of(one, time) for one in (run, *beside)]
    labels = names or [profile.name for profile in profiles]
    if len(labels) != len(profiles):
        raise ValueError(f"names are for the run and those beside: {len(profiles)}, not {len(labels)}")
    first = profiles[0]
    # The surface is recorded more often than the strain, in a run that was stopped also after its last snapshot.
    section = Section.of(first.result, min(first.time, last_shown(first.result)), None)
    across, down = _reach(first) if reach is None else (reach, reach)
    mesh = section.snapshots["solid"].mesh
    across, down = min(across, float(mesh.high[1])), min(down, float(mesh.high[0] - mesh.low[0]))
    left = -across if section.mirrored else float(mesh.low[1])
    width = WIDTH - LEFT - RIGHT
    lower = width * (1 + ABOVE) * down / (across - left)
    size = (WIDTH, FOOT + lower + GAP + UPPER + HEAD)
    figure = Figure(figsize=size)
    above, below = (figure.add_axes((LEFT / size[0], up / size[1], width / size[0], height / size[1]))
                    for up, height in ((FOOT + lower + GAP, UPPER), (FOOT, lower)))
    for axes in (above, below):
        axes.set_xlim(left, across)
    deepest, largest = strongest or (None, None)
    _profiles(above, profiles, labels, section.mirrored, UPPER * (across - left) / width, deepest)
    _zone(figure, below, section, first, down, largest)
    return figure


def _reach(profile: Profile) -> tuple[float, float]:
    """What is shown to the side and downwards, m: the plastic zone, else a tenth of the domain."""
    found, widest = profile.result.summary, float(profile.r[-1])
    radius, depth = (float(found.get(f"plastic_zone_{name}") or 0.1 * widest) for name in ("radius", "depth"))
    across = min(1.2 * max(radius, 0.6 * depth), widest)
    return across, max(1.2 * depth, 0.3 * across)


def _profiles(axes: Axes, profiles: Sequence[Profile], labels: Sequence[str], mirrored: bool, span: float,
              shown: float | None) -> None:
    """The profiles, stretched so that `shown` in m fits; `span` is the panel's height at the scale of r, m."""
    first = profiles[0]
    deepest = max(1e-12, *(float(np.abs(profile.depth).max()) for profile in profiles))
    filled = max(1e-12, *(max(float(p.depth.max()) / BELOW, -float(p.depth.min()) / (1 - BELOW)) for p in profiles))
    if shown is not None:
        deepest, filled = shown, shown / BELOW
    # 1, 2 or 5 times a power of ten, as much as leaves some room.
    most = 0.9 * span / filled
    power = 10.0 ** math.floor(math.log10(most))
    stretch = max(factor * power for factor in (1, 2, 5) if factor * power <= most)
    bottom = BELOW * span / stretch
    axes.set_ylim(bottom, bottom - span / stretch)
    for k, (profile, label) in enumerate(zip(profiles, labels)):
        r, depth = _both(*profile.line, mirrored)
        axes.plot(r, depth, color=COLOURS[k % 4], linestyle=DASHES[k % 4], label=label)
        if profile is first:
            axes.fill_between(r, depth, bottom, color="0.95", linewidth=0)
    axes.axhline(0.0, color=GREY, linewidth=0.5)
    scale, letter = prefix(deepest)
    axes.yaxis.set_major_formatter(FuncFormatter(lambda z, _: number(z * scale)))
    axes.set_ylabel(f"depth / {letter}m, {number(stretch)} times stretched", labelpad=2)
    axes.set_title(f"Surface, $t$ = {si(first.time, 's')}", loc="left", fontsize=9, pad=4)
    axes.tick_params(labelbottom=False)
    if len(profiles) > 1:
        legend(axes, loc="lower left")
    found = first.numbers
    if has_pit(found) and "pit_radius" in found:
        lowest, radius = found["pit_depth"], found["pit_radius"]
        deep = int(np.argmax(first.depth))
        place = float(first.r[deep]) if deep or not mirrored else 0.0
        for begin, end in (((place, 0.0), (place, lowest)), ((0.0, 0.5 * lowest), (radius, 0.5 * lowest))):
            line = {"arrowstyle": "<->", "color": INK, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 6}
            axes.annotate("", end, begin, arrowprops=line)
    words = f"{labels[0]}:\n{first.words}" if len(profiles) > 1 else first.words
    axes.text(0.985, 0.05, words, transform=axes.transAxes, ha="right", va="bottom", fontsize=8, color=INK)


def _both(r: Floats, depth: Floats, mirrored: bool) -> tuple[Floats, Floats]:
    """A profile, and its mirror image to the left; a point on the axis is there once."""
    if not mirrored:
        return r, depth
    other = slice(None, 0 if r[0] == 0.0 else None, -1)
    return np.concatenate([-r[other], r]), np.concatenate([depth[other], depth])


def _zone(figure: Figure, axes: Axes, section: Section, profile: Profile, down: float, largest: float | None) -> None:
    """The plastic strain below the deformed surface, z and r on one scale."""
    snapshot = section.snapshots["solid"]
    top, strain = float(snapshot.mesh.high[0]), strain_of(snapshot)
    low, high = axes.get_xlim()
    raster = Raster(snapshot.mesh, (top - down, top, max(low, 0.0) if section.mirrored else low, high), MOST)

    def place(r: Floats, z: Floats) -> tuple[Floats, Floats]:
        """r and depth of points of a grid: every column hangs from the surface above it."""
        across, sunk = _both(r, np.interp(r, *profile.line), section.mirrored)
        return np.broadcast_to(across[:, None], (len(across), len(z))), (top - z)[None, :] + sunk[:, None]

    edges = (raster.low[a] + np.arange(raster.shape[a] + 1) * raster.pixel[a] for a in (1, 0))
    drawn = axes.pcolormesh(*place(*edges), section.mirror(raster.paint(strain)), rasterized=True,
                            **colours(strain if largest is None else np.array([largest])))
    smooth = section.mirror(raster.paint(strain, snapshot.mesh.linear(strain)))
    for level, _, width in LINES:
        if smooth.min() < level < smooth.max():
            axes.contour(*place(raster.r, raster.z), smooth, [level], colors=INK, linewidths=width)
    axes.plot(*_both(*profile.line, section.mirrored), color=BLUE)
    axes.set_ylim(down, -ABOVE * down)
    axes.set_aspect("equal", adjustable="box")
    if section.mirrored:
        axes.axvline(0.0, color=GREY, linewidth=0.5, dashes=(8, 3, 1.5, 3))
    scale, letter = prefix(max(high, down))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda x, _: number((abs(x) if section.mirrored else x) * scale)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda z, _: number(z * scale)))
    axes.set_xlabel(f"$r$ / {letter}m", labelpad=1)
    axes.set_ylabel(f"depth / {letter}m, true scale", labelpad=2)
    keys = [Line2D([], [], color=INK, linewidth=width, label=rf"$\varepsilon_\mathrm{{p}}$ = {name}") for _, name, width in LINES]
    legend(axes, handles=keys, loc="lower right", facecolor=WHITE)
    bar(figure, axes, drawn, f"{LABEL} at $t$ = {si(snapshot.time, 's')}", extend="min")
