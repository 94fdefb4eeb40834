"""Sections through solid and fluid, mirrored about the axis."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from .. import _given
from ..mesh import Box, Floats, Raster
from ..result import Result, Snapshot, open_run
from .._numbers import number, prefix, si
from .style import GREY, INK, ORANGE, WHITE, WIDTH

MOST = 1400  # pixels of a raster along a side

Run = Result | str | os.PathLike[str]
Window = tuple[float, float, float]


def default_time(run: Run) -> float:
    """The time of the largest von Mises stress, else of the largest wall pressure, else of the end, s; none after the last snapshot."""
    result = open_run(run)
    times = (result.summary.get(f"{name}_time") for name in ("von_mises_peak", "wall_pressure_peak"))
    last = last_shown(result)
    return next((min(float(time), last) for time in times if time is not None), last)


def last_shown(result: Result) -> float:
    """The last time until which all media have snapshots, s: a run that was stopped has gone on after it."""
    return min(float(result.snapshots(medium).times[-1]) for medium in result.media)


@dataclass
class Section:
    """What is drawn: the snapshots of all media at one time, in a window."""

    result: Result
    time: float
    snapshots: dict[str, Snapshot]
    box: Box
    """z from, z to, r from, r to, m"""
    wall: float | None
    """z of the interface, m"""
    mirrored: bool

    @classmethod
    def of(cls, run: Run, time: float | None, window: Window | None) -> Section:
        result = open_run(run)
        wanted = default_time(result) if time is None else time
        snapshots = {medium: result.snapshots(medium).at(wanted) for medium in result.media}
        meshes = {medium: snapshot.mesh for medium, snapshot in snapshots.items()}
        low = np.min([mesh.low for mesh in meshes.values()], 0)
        high = np.max([mesh.high for mesh in meshes.values()], 0)
        if window is None:
            box = (float(low[0]), float(high[0]), float(low[1]), float(high[1]))
        else:
            z_low, z_high, r_high = _given.window(window, low, high)
            box = (z_low, z_high, float(low[1]), r_high)
        wall = float(meshes["fluid"].low[0]) if "fluid" in meshes else None
        mirrored = result.parameters.get("geometry", "axisymmetric") == "axisymmetric"
        first = next(iter(snapshots.values()))
        return cls(result, first.time, snapshots, box, wall, mirrored)

    @property
    def length_scale(self) -> tuple[float, str]:
        return prefix(max(map(abs, self.box)))

    def r_shown(self, r: float) -> str:
        """What an axis says at r in m, in the unit of `length_scale`: |r| where both halves are the same."""
        return number((abs(r) if self.mirrored else r) * self.length_scale[0])

    @property
    def usual_density(self) -> float:
        """What nearly all cells stay below at the start: the liquid's density, kg/m³."""
        return float(np.nanpercentile(self.result.fluid[0]["density"], 99))

    @property
    def time_shown(self) -> str:
        return si(self.time, "s")

    @property
    def parts(self) -> list[tuple[str, tuple[float, float]]]:
        """The media from left to right, and the part of a panel's width that the colour bar of each one has."""
        media = [medium for medium in ("solid", "fluid") if medium in self.snapshots]
        return list(zip(media, ((0.0, 0.48), (0.52, 1.0)) if len(media) == 2 else ((0.0, 1.0),)))

    def raster(self, medium: str, most: int = MOST) -> Raster | None:
        """The window as far as a medium has it; `None` if it has nothing of it."""
        mesh = self.snapshots[medium].mesh
        inside = self.box[0] < mesh.high[0] and self.box[1] > mesh.low[0] and self.box[3] > mesh.low[1]
        return Raster(mesh, self.box, most) if inside else None

    def images(self, fields: Mapping[str, Floats]) -> list[tuple[Raster, Floats]]:
        """The window's raster and image of a field of each medium that has part of it, shape (cells,)."""
        rasters = {medium: self.raster(medium) for medium in fields}
        return [(raster, raster.paint(fields[medium])) for medium, raster in rasters.items() if raster is not None]

    def canvas(self, panels: int = 1, columns: int | None = None, foot: float = 0.95) -> tuple[Figure, list[Axes]]:
        """A figure with panels of equal scale, `columns` side by side, room for bars at the foot."""
        columns = min(panels, columns or panels)
        rows = -(-panels // columns)
        low, high, near, top = self.box
        bottom = -top if self.mirrored else near
        left, gap, head, across = 0.62, 0.25, 0.34, 0.32
        width = (WIDTH - left - 0.2 - (columns - 1) * gap) / columns
        height = width * (top - bottom) / (high - low)
        tallest = 5.2 if rows == 1 else 7.5  # what a page has room for
        if rows * height > tallest:
            width, height = width * tallest / (rows * height), tallest / rows
        size = (left + columns * width + (columns - 1) * gap + 0.2, foot + rows * height + (rows - 1) * across + head)
        figure = Figure(figsize=size)
        scale, letter = self.length_scale
        found = []
        for panel in range(panels):
            row, column = divmod(panel, columns)
            up = foot + (rows - 1 - row) * (height + across)
            axes = figure.add_axes((
                (left + column * (width + gap)) / size[0], up / size[1], width / size[0], height / size[1]))
            axes.set(xlim=(low, high), ylim=(bottom, top), aspect="equal")
            axes.xaxis.set_major_formatter(FuncFormatter(lambda z, _: number(z * scale)))
            axes.yaxis.set_major_formatter(FuncFormatter(lambda r, _: self.r_shown(r)))
            axes.tick_params(labelleft=column == 0, labelbottom=row == rows - 1)
            if row == rows - 1:
                axes.set_xlabel(f"$z$ / {letter}m", labelpad=1)
            if column == 0:
                axes.set_ylabel(f"$r$ / {letter}m", labelpad=2)
            found.append(axes)
        return figure, found

    def mirror(self, image: Floats) -> Floats:
        return np.vstack([image[::-1], image]) if self.mirrored else image

    def show(self, axes: Axes, raster: Raster, image: Floats, **style: Any) -> Any:
        """An image of a half section and its mirror image."""
        bottom = -raster.high[1] if self.mirrored else raster.low[1]
        extent = (raster.low[0], raster.high[0], bottom, raster.high[1])
        return axes.imshow(self.mirror(image), origin="lower", extent=extent, interpolation="nearest", **style)

    def contour(self, axes: Axes, raster: Raster, image: Floats, level: float, **style: Any) -> None:
        if np.nanmin(image) < level < np.nanmax(image):
            r = np.concatenate([-raster.r[::-1], raster.r]) if self.mirrored else raster.r
            axes.contour(raster.z, r, self.mirror(image), [level], **style)

    def bubble(self, axes: Axes) -> None:
        """The line on which half is gas."""
        snapshot = self.snapshots.get("fluid")
        raster = self.raster("fluid", MOST // 2) if snapshot is not None and "gas_fraction" in snapshot else None
        if snapshot is not None and raster is not None:
            gas = snapshot["gas_fraction"]
            image = raster.paint(gas, snapshot.mesh.linear(gas))
            self.contour(axes, raster, image, 0.5, colors=ORANGE, linewidths=0.9)

    def levels(self, axes: Axes) -> None:
        """Outlines of the levels of refinement."""
        for medium, snapshot in self.snapshots.items():
            raster = self.raster(medium, MOST // 2)
            if raster is None:
                continue
            depth = raster.paint(snapshot.mesh.depth.astype(float))
            for level in range(int(snapshot.mesh.depth.max())):
                self.contour(axes, raster, depth, level + 0.5, colors="0.35", linewidths=0.35)

    def annotate(self, axes: Axes, what: str, levels: bool) -> None:
        """The bubble's outline and the names; the levels' outlines if they are asked for."""
        if levels:
            self.levels(axes)
        self.bubble(axes)
        self.names(axes, what)

    def names(self, axes: Axes, what: str) -> None:
        """The media's names, the interface, the axis, a title."""
        if self.mirrored:
            axes.axhline(0, color=GREY, linewidth=0.5, dashes=(8, 3, 1.5, 3))
        frame = {"boxstyle": "square,pad=0.2", "facecolor": WHITE, "edgecolor": "none", "alpha": 0.85}
        places: list[tuple[str, float, Any]] = []
        if "solid" in self.snapshots and self.wall is not None and self.box[0] < self.wall:
            places.append(("solid", 0.015, "left"))
        if "fluid" in self.snapshots and (self.wall is None or self.box[1] > self.wall):
            places.append(("fluid", 0.985, "right"))
        for name, x, side in places:
            axes.text(x, 0.975, name, ha=side, va="top", style="italic", color=INK, bbox=frame,
                      transform=axes.transAxes)
        if self.wall is not None:
            axes.axvline(self.wall, color=INK, linewidth=1.1)
        axes.set_title(f"{what}, $t$ = {self.time_shown}", loc="left", fontsize=9, pad=4)


def bar(
    figure: Figure, axes: Axes, drawn: Any, label: str, part: tuple[float, float] = (0.0, 1.0), extend: str = "neither",
    up: float = 0.40, **more: Any,
) -> Any:
    """A slim bar below a part of a panel, `up` inches from the foot; labels are in the units of the image."""
    place = axes.get_position()
    inch = 1 / figure.get_figheight()
    x, width = place.x0 + part[0] * place.width, (part[1] - part[0]) * place.width
    into = figure.add_axes((x + 0.02 * width, up * inch, 0.96 * width, 0.09 * inch))
    more.setdefault("format", FuncFormatter(lambda value, _: number(value)))
    colours = figure.colorbar(drawn, cax=into, orientation="horizontal", extend=extend, extendfrac=0.03, **more)
    if isinstance(drawn.norm, LogNorm):
        low, high = float(drawn.norm.vmin or 0), float(drawn.norm.vmax or 1)
        if high < 100 * low:  # too few powers of ten
            marks = [m * 10.0**k for k in range(int(np.floor(np.log10(low))), int(np.log10(high)) + 1) for m in (1, 2, 5)]
            marks = [m for m in marks if low <= m <= high]
            colours.set_ticks(marks, labels=[number(m) for m in marks])
        else:
            colours.ax.xaxis.set_major_locator(LogLocator(numticks=6))
            colours.ax.xaxis.set_major_formatter(FuncFormatter(lambda v, _: f"$10^{{{round(np.log10(v))}}}$"))
        colours.ax.xaxis.set_minor_formatter(NullFormatter())
    colours.set_label(label, labelpad=1)
    colours.outline.set_linewidth(0.5)
    colours.ax.tick_params(width=0.5, length=2.5)
    return colours
