"""Lines of the flow: streamlines of a snapshot, pathlines through all of them."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

from drawing import BLUE, BUBBLE, INK, MOST, bar, bubble_outline, canvas, logarithmic, names, part_of, show
from run_directory import MICRO, MILLI
from snapshots import Raster


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
    drawn = show(axes, raster, image, cmap=part_of("GnBu", 0.0, 0.75), norm=Normalize(0, 1100))
    denser = "max" if np.nanmax(image) > 1100 else "neither"
    bar(figure, axes, drawn, r"density $\rho$ / (kg m$^{-3}$)", (0.52, 1), denser)
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
    for group, colour in ((lines[0], INK), (lines[1][~gas], BLUE), (lines[1][gas], BUBBLE)):
        for sign in (1, -1):
            axes.add_collection(LineCollection(list(group * [1, sign]), colors=colour, linewidths=0.5))
            axes.plot(*(group[:, -1] * [1, sign]).T, ".", color=colour, markersize=1.6, markeredgewidth=0)
    names(run, axes, run.fluid.times[-1], "Pathlines up to", box)
    axes.set_title(axes.get_title(loc="left").replace("to, ", "to "), loc="left", fontsize=9, pad=4)
    figure.text(0.12, 0.03, f"From $t$ = 0 to the dots. Blue: began in the liquid. Orange: began in the gas.\n"
                f"Solid: displacements {times:g} times enlarged (largest {far * MICRO:.2g} µm).", fontsize=8,
                linespacing=1.4)
    return figure
