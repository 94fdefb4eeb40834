#!/usr/bin/env python3
"""A picture of a run: numerical schlieren in the fluid above, von Mises stress in the solid below.

    python3 scripts/picture.py RUN_DIR OUT.png [--time T] [--reach MM]

Shows the snapshot nearest to the time T in seconds; without --time the one with the highest von Mises stress. Both
sides are mirrored about the axis of symmetry. Needs h5py and matplotlib (scripts/requirements.txt).
"""

import argparse
import sys
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize, PowerNorm
from matplotlib.tri import Triangulation

MILLI = 1e3  # mm per m
GREY, INK, BUBBLE = "0.55", "#1a1a1a", "#0072b2"
WIDEST = 7.0  # inches, a full page's width


class Series:
    """The snapshots of a VTKHDF file, one read at a time."""

    def __init__(self, path):
        self.path = path
        self.file = h5py.File(path, "r")
        self.root = self.file["VTKHDF"]
        count = int(self.root["Steps"].attrs["NSteps"])
        self.times = self.root["Steps/Values"][:count]
        if count == 0:
            sys.exit(f"{path} holds no snapshots yet")

    def field(self, name, step):
        """The values of a cell field, one row per cell."""
        if name not in self.root["CellData"]:
            sys.exit(f"{self.path} has no field {name}; add it to the fields of [output]")
        start = int(self.root["Steps/CellDataOffsets"][name][step])
        part = int(self.root["Steps/PartOffsets"][step])
        return self.root["CellData"][name][start : start + int(self.root["NumberOfCells"][part])]

    def boxes(self, step):
        """The cells as rows (z_min, z_max, r_min, r_max) in mm."""
        steps = self.root["Steps"]
        part = int(steps["PartOffsets"][step])
        cells, points = int(self.root["NumberOfCells"][part]), int(self.root["NumberOfPoints"][part])
        first_point, first_corner = int(steps["PointOffsets"][step]), int(steps["ConnectivityIdOffsets"][step][0])
        xyz = self.root["Points"][first_point : first_point + points] * MILLI
        corners = xyz[self.root["Connectivity"][first_corner : first_corner + 4 * cells].reshape(cells, 4)]
        z, r = corners[..., 0], corners[..., 1]
        return np.column_stack([z.min(1), z.max(1), r.min(1), r.max(1)])


def nearest(times, time):
    return int(np.argmin(np.abs(times - time)))


def as_grid(boxes, values):
    """Values on the grid of a uniform mesh with the grid's faces, or None where the cells differ in size."""
    sizes = np.column_stack([boxes[:, 1] - boxes[:, 0], boxes[:, 3] - boxes[:, 2]])
    if np.ptp(sizes, axis=0).max() > 1e-6 * sizes.min():
        return None
    (dz, dr), z0, r0 = sizes.mean(0), boxes[:, 0].min(), boxes[:, 2].min()
    i = np.rint((boxes[:, 0] - z0) / dz).astype(int)
    j = np.rint((boxes[:, 2] - r0) / dr).astype(int)
    grid = np.full((i.max() + 1, j.max() + 1), np.nan)
    grid[i, j] = values
    return z0 + dz * np.arange(grid.shape[0] + 1), r0 + dr * np.arange(grid.shape[1] + 1), grid


def draw_cells(axes, boxes, values, colours, norm):
    """Every cell in its colour, on both sides of the axis."""
    grid = as_grid(boxes, values)
    if grid is not None:
        z, r, inside = grid
        style = dict(cmap=colours, norm=norm, shading="flat", rasterized=True)
        axes.pcolormesh(-r, z, inside, **style)
        return axes.pcolormesh(r, z, inside, **style)
    z0, z1, r0, r1 = boxes.T
    for sign in (-1, 1):
        corners = [(sign * r0, z0), (sign * r1, z0), (sign * r1, z1), (sign * r0, z1)]
        polygons = np.stack([np.column_stack(corner) for corner in corners], axis=1)
        cells = PolyCollection(polygons, array=values, cmap=colours, norm=norm, edgecolors="face", linewidths=0.15,
                               rasterized=True)
        axes.add_collection(cells)
    return cells


def draw_contour(axes, boxes, values, level, **style):
    """The line on which the field has the value `level`, on both sides of the axis."""
    if not values.min() < level < values.max():
        return
    z, r = 0.5 * (boxes[:, 0] + boxes[:, 1]), 0.5 * (boxes[:, 2] + boxes[:, 3])
    grid = as_grid(boxes, values)
    if grid is not None:
        faces_z, faces_r, inside = grid
        z, r = 0.5 * (faces_z[1:] + faces_z[:-1]), 0.5 * (faces_r[1:] + faces_r[:-1])
        axes.contour(np.concatenate([-r[::-1], r]), z, np.hstack([inside[:, ::-1], inside]), [level], **style)
        return
    # Only the cells near the interface: a triangulation of all would be slow and no better.
    mixed = (values > 1e-3) & (values < 1 - 1e-3)
    reach = 3 * (boxes[:, 1] - boxes[:, 0]).max()
    near = ((z > z[mixed].min() - reach) & (z < z[mixed].max() + reach) & (r < r[mixed].max() + reach)
            if mixed.any() else np.full(z.shape, True))
    both_r, both_z = np.concatenate([-r[near], r[near]]), np.tile(z[near], 2)
    axes.tricontour(Triangulation(both_r, both_z), np.tile(values[near], 2), [level], **style)


def density_gradient(boxes, density):
    """|grad rho| in kg/m4 on a uniform mesh, for runs without the schlieren field; None on other meshes."""
    grid = as_grid(boxes, density)
    if grid is None:
        return None
    z, r, inside = grid
    # An even function of r: the mirrored half makes the slope at the axis a central one.
    whole = np.hstack([inside[:, ::-1], inside])
    slope = np.hypot(*np.gradient(whole, z[1] - z[0], r[1] - r[0]))[:, inside.shape[1] :] * MILLI
    i = np.rint((boxes[:, 0] - z[0]) / (z[1] - z[0])).astype(int)
    j = np.rint((boxes[:, 2] - r[0]) / (r[1] - r[0])).astype(int)
    return slope[i, j]


def schlieren(series, step, boxes):
    """log10 of |grad rho|; cells in which it vanishes get the smallest value shown."""
    gradient = series.field("schlieren", step) if "schlieren" in series.root["CellData"] else None
    if gradient is None:
        gradient = density_gradient(boxes, series.field("density", step))
    if gradient is None:
        sys.exit(f"{series.path} has no field schlieren, which a mesh of several levels needs")
    return np.log10(np.maximum(gradient, 1e-30))


def prefixed(value, unit):
    """A number with an SI prefix: 52.3 µs, 209 MPa."""
    for factor, prefix in [(1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n")]:
        if abs(value) >= 0.9995 * factor:
            return f"{value / factor:.3g} {prefix}{unit}"
    return f"{value:.3g} {unit}"


def style():
    plt.rcParams.update({
        "font.family": "serif",
        "font.serif": ["STIX Two Text", "STIXGeneral", "DejaVu Serif"],
        "mathtext.fontset": "stix",
        "font.size": 9,
        "axes.linewidth": 0.6,
        "axes.edgecolor": INK,
        "xtick.direction": "out", "ytick.direction": "out",
        "xtick.major.width": 0.6, "ytick.major.width": 0.6,
        "xtick.major.size": 3, "ytick.major.size": 3,
        "savefig.facecolor": "white",
    })


def colour_bar(figure, axes, drawn, label, extend):
    """A slim bar the height of a panel, to its right."""
    place = axes.get_position()
    bar_axes = figure.add_axes([place.x1 + 0.02, place.y0 + 0.03 * place.height, 0.018, 0.94 * place.height])
    bar = figure.colorbar(drawn, cax=bar_axes, extend=extend, extendfrac=0.03)
    bar.set_label(label, labelpad=5)
    bar.outline.set_linewidth(0.5)
    bar.ax.tick_params(width=0.5, length=2.5)


def picture(run, out, time, reach):
    fluid = Series(run / "fluid.vtkhdf")
    solid = Series(run / "solid.vtkhdf") if (run / "solid.vtkhdf").exists() else None
    if time is not None:
        time = fluid.times[nearest(fluid.times, time)]
    elif solid is not None:
        time = solid.times[int(np.argmax([solid.field("von_mises", k).max() for k in range(len(solid.times))]))]
    else:
        time = fluid.times[-1]

    style()
    step = nearest(fluid.times, time)
    boxes = fluid.boxes(step)
    panels = [(boxes, "fluid")]
    if solid is not None:
        solid_step = nearest(solid.times, time)
        panels.append((solid.boxes(solid_step), "solid"))
    widest = max(b[:, 3].max() for b, _ in panels)
    bottoms, tops = [b[:, 0].min() for b, _ in panels], [b[:, 1].max() for b, _ in panels]
    if reach is None:
        reach = widest
    else:
        # A little higher than deep: the bubble stands off the wall, the stress is greatest near it.
        reach = min(reach, widest)
        tops[0] = min(tops[0], bottoms[0] + 1.2 * reach)
        if solid is not None:
            bottoms[1] = max(bottoms[1], tops[1] - reach)
    heights = [high - low for low, high in zip(bottoms, tops)]

    # The panels by hand, so that a millimetre is as long along z as along r and the panels touch at the wall.
    left, right, bottom, top = 0.75, 1.0, 0.5, 0.42  # inches
    scale = min((WIDEST - left - right) / (2 * reach), 8.2 / sum(heights))
    size = (2 * reach * scale + left + right, sum(heights) * scale + bottom + top)
    figure = plt.figure(figsize=size)
    all_axes, y = [], bottom + sum(heights) * scale
    for height in heights:
        y -= height * scale
        all_axes.append(figure.add_axes([left / size[0], y / size[1], 2 * reach * scale / size[0],
                                         height * scale / size[1]]))

    shown = schlieren(fluid, step, boxes)
    # Three decades and a half below nearly the strongest show waves and interface at once.
    strongest = np.percentile(shown, 99.9)
    drawn = draw_cells(all_axes[0], boxes, shown, "gray_r", Normalize(strongest - 3.5, strongest))
    if "gas_fraction" in fluid.root["CellData"]:
        draw_contour(all_axes[0], boxes, fluid.field("gas_fraction", step), 0.5, colors=BUBBLE, linewidths=1.0)
    colour_bar(figure, all_axes[0], drawn, r"$\log_{10}\,|\nabla\rho|\;/\;(\mathrm{kg\,m^{-4}})$", "both")
    title = rf"$t$ = {prefixed(time, 's')}"

    if solid is not None:
        stress = solid.field("von_mises", solid_step)
        solid_boxes = panels[1][0]
        # A power below one lifts the waves, which are weak beside the maximum, out of the dark.
        drawn = draw_cells(all_axes[1], solid_boxes, stress / 1e6, "inferno", PowerNorm(0.6, 0.0, stress.max() / 1e6))
        colour_bar(figure, all_axes[1], drawn, "von Mises stress / MPa", "neither")
        at = int(np.argmax(stress))
        z, r = solid_boxes[at, :2].mean(), solid_boxes[at, 2:].mean()
        wall = solid_boxes[:, 1].max()
        place = f"{wall - z:.2g} mm below the wall" + ("" if solid_boxes[at, 2] <= 0 else f", {r:.2g} mm off axis")
        title += f"    max. von Mises stress {prefixed(stress.max(), 'Pa')}, {place}"

    for axes, (_, name), low, high in zip(all_axes, panels, bottoms, tops):
        is_top = name == "fluid"
        axes.set(xlim=(-reach, reach), ylim=(low, high), ylabel=r"$z$ / mm")
        axes.yaxis.set_label_coords(-0.45 / (2 * reach * scale), 0.5)
        axes.axvline(0.0, color=GREY, linewidth=0.5, dashes=(8, 3, 1.5, 3))
        box = dict(boxstyle="square,pad=0.25", facecolor="white", edgecolor="none", alpha=0.85)
        axes.text(0.015, 0.97 if is_top else 0.03, name, transform=axes.transAxes, va="top" if is_top else "bottom",
                  style="italic", color=INK, bbox=box)
        # |r|, since both halves are the same.
        axes.xaxis.set_major_formatter(lambda x, _: f"{abs(x):g}")
    all_axes[-1].set_xlabel(r"$r$ / mm")
    if solid is not None:
        upper, lower = all_axes
        upper.tick_params(labelbottom=False, bottom=False)
        upper.spines["bottom"].set_visible(False)
        lower.spines["top"].set(linewidth=1.6, color=INK, zorder=5)
        # The wall's own tick is drawn once, by the fluid.
        upper_ticks = [tick for tick in upper.get_yticks() if upper.get_ylim()[0] <= tick <= upper.get_ylim()[1]]
        lower_ticks = [tick for tick in lower.get_yticks() if lower.get_ylim()[0] <= tick < lower.get_ylim()[1] - 1e-9]
        upper.set_yticks(upper_ticks)
        lower.set_yticks(lower_ticks)
    figure.text(left / size[0], 1 - 0.16 / size[1], title, va="top", ha="left", fontsize=10, color=INK)
    figure.savefig(out, dpi=220)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="directory of the run")
    parser.add_argument("out", type=Path, metavar="OUT.png", help="picture to write; .pdf and .svg work as well")
    parser.add_argument("--time", type=float, metavar="T", help="simulated time in s (default: highest von Mises stress)")
    parser.add_argument("--reach", type=float, metavar="MM", help="show only so many mm about the axis and the wall")
    arguments = parser.parse_args()
    if not (arguments.run / "fluid.vtkhdf").exists():
        sys.exit(f"{arguments.run} holds no fluid.vtkhdf: is it the directory of a run?")
    picture(arguments.run, arguments.out, arguments.time, arguments.reach)


if __name__ == "__main__":
    main()
