"""Lines of the flow: streamlines of a snapshot, pathlines through all of them."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from .._given import positive
from ..mesh import Floats, Raster
from ..result import Snapshot, Snapshots, open_run
from .section import Run, Section, Window, bar, last_shown
from .._numbers import prefix
from .style import BLUE, INK, ORANGE, logarithmic, part_of, styled

ENOUGH = 40
"""Snapshots from which on a velocity that is linear between them makes good paths."""


@styled
def streamlines(
    run: Run, time: float | None = None, window: Window | None = None, *, density: float = 1.0, levels: bool = False
) -> Figure:
    """Lines along the velocity of both media, over the fluid's density and the solid's speed.

    - `density`: of the lines, 1 as a rule.
    """
    positive("density", density)
    section = Section.of(run, time, window)
    figure, (axes,) = section.canvas()
    parts = dict(section.parts)
    fluid, solid = section.snapshots.get("fluid"), section.snapshots.get("solid")
    if fluid is not None and (raster := section.raster("fluid")):
        image = raster.paint(fluid["density"])
        top = 1.1 * section.usual_density
        drawn = section.show(axes, raster, image, cmap=part_of("GnBu", 0.0, 0.75), norm=Normalize(0, top))
        denser = "max" if np.nanmax(image) > top else "neither"
        bar(figure, axes, drawn, r"density $\rho$ / (kg m$^{-3}$)", parts["fluid"], denser)
    if solid is not None and (raster := section.raster("solid")):
        speed = raster.paint(np.hypot(*solid["velocity"][:, :2].T))
        norm = logarithmic(float(np.nanpercentile(speed, 99.9)), 2)
        drawn = section.show(axes, raster, speed, cmap=part_of("YlOrBr", 0.0, 0.6), norm=norm)
        bar(figure, axes, drawn, r"speed $|\mathbf{v}|$ / (m s$^{-1}$)", parts["solid"], "both")
    for medium, snapshot in section.snapshots.items():
        coarse = section.raster(medium, 320)
        if coarse is None or min(coarse.shape) < 8:  # a tube, whose lines are straight
            continue
        v_z, v_r = (velocity_image(coarse, snapshot, axis) for axis in (0, 1))
        fast = np.hypot(v_z, v_r)
        still = fast < 2e-3 * np.nanpercentile(fast, 99)
        if still.all() or not np.nanmax(fast) > 0:
            continue
        # As close to each other in every medium, however much of the window it has.
        span = (coarse.high - coarse.low) / (section.box[1] - section.box[0])
        # Not those that creep along the axis, which would meet their mirror images.
        off = max(1, len(coarse.r) // 40) if section.mirrored else 0
        v_z, v_r = (np.where(still, np.nan, v)[off:] for v in (v_z, v_r))
        lines = _trace(coarse.z, coarse.r[off:], v_z, v_r, 2.6 * density * span)
        _draw(axes, lines, section, color=INK, linewidths=0.55)
    section.annotate(axes, "Streamlines", levels)
    return figure


def velocity_image(raster: Raster, snapshot: Snapshot, axis: int) -> Floats:
    """v_z or v_r, linear within cells."""
    values = snapshot["velocity"][:, axis]
    return raster.paint(values, snapshot.mesh.linear(values, (1, -1)[axis], bounded=False))


def _trace(z: Floats, r: Floats, v_z: Floats, v_r: Floats, density: Floats) -> list[Floats]:
    """Evenly spaced streamlines of a velocity at z and r; `density` along both."""
    axes = Figure().add_subplot()
    axes.set(xlim=(z[0], z[-1]), ylim=(r[0], r[-1]))
    across, along = (float(part) for part in density)
    lines = axes.streamplot(z, r, v_z, v_r, density=(across, along), minlength=0.2, maxlength=8).lines
    joined: list[list[Any]] = []
    for segment in lines.get_segments():
        if joined and np.allclose(joined[-1][-1], segment[0], rtol=0, atol=1e-9 * (z[-1] - z[0])):
            joined[-1].extend(segment[1:])
        else:
            joined.append(list(segment))
    return [np.array(line) for line in joined]


def _draw(axes: Axes, lines: list[Floats], section: Section, color: str, linewidths: float) -> None:
    """Lines of a half section, on both sides if it is mirrored, with an arrow head in the middle of the longer ones."""
    both = lines + [line * [1, -1] for line in lines] if section.mirrored else lines
    axes.add_collection(LineCollection(both, colors=color, linewidths=linewidths))
    for line in both:
        passed = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
        if passed[-1] > 0.05 * (section.box[1] - section.box[0]):
            before, middle, after = (
                np.array([np.interp(share * passed[-1], passed, line[:, a]) for a in (0, 1)])
                for share in (0.49, 0.5, 0.51))
            angle = np.degrees(np.arctan2(*(after - before)[::-1]))
            axes.plot(*middle, marker=(3, 0, angle - 90), color=color, markersize=3.2, markeredgewidth=0)


@styled
def pathlines(
    run: Run,
    window: Window | None = None,
    *,
    until: float | None = None,
    spacing: float | None = None,
    substeps: int = 8,
    levels: bool = False,
) -> Figure:
    """Where particles of a regular grid have gone from t = 0 on, advected through the snapshots by Heun's method.

    The velocity is linear in time between two snapshots, so the run needs enough of them: 40 and more are good, and of fewer
    a `UserWarning` tells. Where the solid's snapshots have the field `displacement` (a solid that can yield) its paths are that.
    The solid's displacements are enlarged, as the foot of the picture says.

    - `until`: the last time, s; else the last snapshot.
    - `spacing`: of the grid, m; else a thirtieth of the window.
    - `levels`: outlines of the levels of refinement at the last time.
    """
    result = open_run(run)
    last = last_shown(result) if until is None else until
    section = Section.of(result, last, window)
    section.time = last
    apart = (section.box[1] - section.box[0]) / 30 if spacing is None else positive("spacing", spacing, "m")
    figure, (axes,) = section.canvas(foot=1.0)
    foot = ["From $t$ = 0 to the dots."]
    for medium in section.snapshots:
        series = result.snapshots(medium)
        start = _start(series, section, apart)
        if "displacement" in series.fields:
            tracks = displaced(series, start, last)
        else:
            _warn_of_few(series)
            tracks = advect(series, start, last, substeps if medium == "fluid" else 1)
        if medium == "fluid":
            gas = series[0].mesh.sample(series[0]["gas_fraction"], tracks[:, 0]) > 0.5
            groups = [(tracks[~gas], BLUE), (tracks[gas], ORANGE)]
            foot.append("Blue: began in the liquid. Orange: began in the gas.")
        else:
            moved = tracks - tracks[:, :1]
            far = float(np.hypot(*np.moveaxis(moved, -1, 0)).max())
            enlarged = _round_down(2.0 * apart / far) if far > 0 else 1.0
            groups = [(tracks[:, :1] + enlarged * moved, INK)]
            scale, letter = prefix(far)
            foot.append(f"\nSolid: displacements {enlarged:g} times enlarged (largest {far * scale:.2g} {letter}m).")
        for lines, colour in groups:
            for sign in (1, -1) if section.mirrored else (1,):
                axes.add_collection(LineCollection(list(lines * [1, sign]), colors=colour, linewidths=0.5))
                if len(lines):
                    axes.plot(*(lines[:, -1] * [1, sign]).T, ".", color=colour, markersize=1.6, markeredgewidth=0)
    if levels:
        section.levels(axes)
    section.names(axes, "Pathlines up to")
    axes.set_title(axes.get_title(loc="left").replace("to, ", "to "), loc="left", fontsize=9, pad=4)
    figure.text(0.1, 0.15 / figure.get_figheight(), " ".join(foot), fontsize=8, linespacing=1.4)
    return figure


def _start(series: Snapshots, section: Section, spacing: float) -> Floats:
    box, mesh = section.box, series[0].mesh
    low, high = np.maximum([box[0], box[2]], mesh.low), np.minimum([box[1], box[3]], mesh.high)
    z, r = (np.arange(a + spacing / 2, b, spacing) for a, b in zip(low, high))
    return np.stack(np.meshgrid(z, r, indexing="ij"), -1).reshape(-1, 2)


def _warn_of_few(series: Snapshots) -> None:
    if len(series) < ENOUGH:
        more = f"time.snapshots or time.snapshot_every of the case give more, {ENOUGH} are enough"
        if series.medium == "solid":
            more += "; a solid that can yield needs none where output.fields has displacement"
        warnings.warn(f"pathlines in the {series.medium}: the velocity is linear between {len(series)} snapshots, which are few: paths may be "
                      f"off by a factor; {more}", stacklevel=4)


def displaced(series: Snapshots, start: Floats, until: float) -> Floats:
    """As `advect`, by the field `displacement`: the solver has added it up step by step."""
    places = []
    for snapshot in series[: _until(series, until)]:
        field = snapshot["displacement"]
        moved = np.column_stack([snapshot.mesh.sample(field[:, a], start, (1, -1)[a], bounded=False) for a in (0, 1)])
        places.append(np.nan_to_num(moved))
    # A wall that has been hit before begins with what is left of that.
    return np.stack([start + moved - places[0] for moved in places], 1)


def _until(series: Snapshots, time: float) -> int:
    """How many snapshots there are up to a time; the first one always is."""
    return max(1, int(np.searchsorted(series.times, time * (1 + 1e-9), side="right")))


def advect(series: Snapshots, start: Floats, until: float, substeps: int) -> Floats:
    """Places of particles at all snapshots up to a time: shape (particles, snapshots, 2), (z, r) in m."""
    at, track = start.copy(), [start.copy()]
    for step in range(_until(series, until) - 1):
        one, other = series[step], series[step + 1]
        ends = [(end.mesh, end["velocity"]) for end in (one, other)]
        dt = (other.time - one.time) / substeps

        def carried(points: Floats, share: float) -> Floats:
            velocities = [np.column_stack([mesh.sample(v[:, a], points, (1, -1)[a], bounded=False) for a in (0, 1)])
                          for mesh, v in ends]
            return np.nan_to_num((1 - share) * velocities[0] + share * velocities[1])

        for part in range(substeps):
            first = carried(at, part / substeps)
            second = carried(at + dt * first, (part + 1) / substeps)
            at = at + 0.5 * dt * (first + second)
            if other.mesh.mirrored:
                at[:, 1] = np.abs(at[:, 1])
        track.append(at.copy())
    return np.stack(track, 1)


def _round_down(value: float) -> float:
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * max(m for m in (1, 2, 5) if m * power <= value * (1 + 1e-9)))
