"""A whole run in one picture: waves in the fluid above, stress in the solid below."""

from __future__ import annotations

from typing import Any

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize, PowerNorm
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, MaxNLocator

from .._given import positive
from ..mesh import Box, Floats, Raster
from ..result import Snapshot
from .section import MOST, Run, Section
from .._numbers import number, si
from .style import BLUE, GREY, INK, WHITE, styled
from .waves import gradient

WIDEST, TALLEST = 7.0, 8.2  # inches
LEFT, RIGHT, BOTTOM, TOP = 0.75, 1.0, 0.5, 0.42  # inches about the panels
MEGA = 1e-6


@styled
def overview(
    run: Run, time: float | None = None, reach: float | None = None, *, strongest: Mapping[str, float] | None = None,
    title: str | None = None, depth: float | None = None,
) -> Figure:
    """Numerical schlieren in the fluid above, von Mises stress in the solid below, z upwards.

    - `reach`: only so far about the axis and the wall, m.
    - `strongest`: ends of the scales, of "fluid" in kg/m⁴ and of "solid" in Pa, for pictures that are to be compared.
    - `title`: instead of the time and the largest stress.
    - `depth`: how much of the solid is shown, m; else `reach`.
    """
    reach, depth = (None if value is None else positive(name, value, "m") for name, value in (("reach", reach), ("depth", depth)))
    section = Section.of(run, time, None)
    boxes = _boxes(section, reach, depth)
    figure, panels = _canvas(section, boxes)
    top = strongest or {}
    words = f"$t$ = {section.time_shown}"
    for medium, axes in panels.items():
        snapshot, raster = section.snapshots[medium], Raster(section.snapshots[medium].mesh, boxes[medium], MOST)
        if medium == "fluid":
            _schlieren(section, figure, axes, snapshot, raster, top.get(medium))
        else:
            _stress(section, figure, axes, snapshot, raster, top.get(medium))
            words += f"    {_largest(snapshot, section.mirrored)}"
        _frame(section, axes, medium)
    last = list(panels.values())[-1]
    last.set_xlabel(f"$r$ / {section.length_scale[1]}m")
    last.xaxis.set_major_formatter(FuncFormatter(lambda r, _: section.r_shown(r)))
    if len(panels) == 2:
        upper, lower = panels["fluid"], panels["solid"]
        upper.tick_params(labelbottom=False, bottom=False)
        upper.spines["bottom"].set_visible(False)
        lower.spines["top"].set(linewidth=1.6, color=INK, zorder=5)
        # The wall's own tick is drawn once, by the fluid.
        low, high = lower.get_ylim()
        lower.set_yticks([z for z in lower.get_yticks() if low <= z < high - 1e-6 * (high - low)])
    width, height = figure.get_size_inches()
    figure.text(LEFT / width, 1 - 0.16 / height, words if title is None else title, va="top", ha="left", fontsize=10, color=INK)
    return figure


def _boxes(section: Section, reach: float | None, depth: float | None) -> dict[str, Box]:
    """What is shown of each medium, the upper one first: z from, z to, r from, r to, m."""
    media = [medium for medium in ("fluid", "solid") if medium in section.snapshots]
    meshes = {medium: section.snapshots[medium].mesh for medium in media}
    widest = max(float(mesh.high[1]) for mesh in meshes.values())
    near = widest if reach is None else min(reach, widest)
    left = min(float(mesh.low[1]) for mesh in meshes.values())
    left = left if reach is None else max(left, -reach)
    found: dict[str, Box] = {}
    for medium, mesh in meshes.items():
        low, high = float(mesh.low[0]), float(mesh.high[0])
        if reach is not None and medium == "fluid":
            # A little higher than deep: the bubble stands off the wall, the stress is greatest near it.
            high = min(high, low + 1.2 * near)
        elif medium == "solid" and (reach is not None or depth is not None):
            low = max(low, high - (near if depth is None else depth))
        found[medium] = (low, high, left, near)
    return found


def _canvas(section: Section, boxes: dict[str, Box]) -> tuple[Figure, dict[str, Axes]]:
    """Panels one upon the other that touch at the wall, with one scale along z and r."""
    first = next(iter(boxes.values()))
    left = -first[3] if section.mirrored else first[2]
    width, heights = first[3] - left, {medium: box[1] - box[0] for medium, box in boxes.items()}
    scale = min((WIDEST - LEFT - RIGHT) / width, TALLEST / sum(heights.values()))
    size = (width * scale + LEFT + RIGHT, sum(heights.values()) * scale + BOTTOM + TOP)
    figure, up, panels = Figure(figsize=size), size[1] - TOP, {}
    for medium, height in heights.items():
        up -= height * scale
        axes = figure.add_axes((LEFT / size[0], up / size[1], width * scale / size[0], height * scale / size[1]))
        axes.set(xlim=(left, first[3]), ylim=boxes[medium][:2])
        axes.yaxis.set_major_locator(MaxNLocator(max(2, round(2 * height * scale)), steps=[1, 2, 2.5, 5, 10]))
        axes.yaxis.set_label_coords(-0.45 / (width * scale), 0.5)
        panels[medium] = axes
    return figure, panels


def _schlieren(section: Section, figure: Figure, axes: Axes, snapshot: Snapshot, raster: Raster, top: float | None) -> None:
    image = np.log10(np.maximum(raster.paint(gradient(section.result, "fluid", snapshot)), 1e-30))
    # Three decades and a half below nearly the strongest show waves and interface at once.
    strongest = float(np.nanpercentile(image, 99.9)) if top is None else float(np.log10(top))
    drawn = _show(section, axes, raster, image, cmap="gray_r", norm=Normalize(strongest - 3.5, strongest))
    if "gas_fraction" in snapshot:
        fraction = snapshot["gas_fraction"]
        gas = raster.paint(fraction, snapshot.mesh.linear(fraction))
        if np.nanmin(gas) < 0.5 < np.nanmax(gas):
            r = np.concatenate([-raster.r[::-1], raster.r]) if section.mirrored else raster.r
            axes.contour(r, raster.z, section.mirror(gas).T, [0.5], colors=BLUE, linewidths=1.0)
    _bar(figure, axes, drawn, r"$\log_{10}\,|\nabla\rho|\;/\;(\mathrm{kg\,m^{-4}})$", "both")


def _stress(section: Section, figure: Figure, axes: Axes, snapshot: Snapshot, raster: Raster, top: float | None) -> None:
    # A power below one lifts the waves, which are weak beside the maximum, out of the dark.
    stress = snapshot["von_mises"] * MEGA
    norm = PowerNorm(0.6, 0.0, max(float(stress.max()) if top is None else top * MEGA, 1e-12))
    drawn = _show(section, axes, raster, raster.paint(stress), cmap="inferno", norm=norm)
    _bar(figure, axes, drawn, "von Mises stress / MPa", "neither" if top is None else "max")


def _largest(snapshot: Snapshot, mirrored: bool) -> str:
    stress, mesh = snapshot["von_mises"], snapshot.mesh
    z, r = mesh.centre(np.array([stress.argmax()]))[0]
    aside = f", at r = {_rounded(r)}" if not mirrored else f", {_rounded(r)} off axis" if r > mesh.finest[1] else ""
    return f"max. von Mises stress {si(float(f'{stress.max():.3g}'), 'Pa')}, {_rounded(mesh.high[0] - z)} below the wall{aside}"


def _rounded(length: float) -> str:
    return si(float(f"{length:.2g}"), "m")


def _show(section: Section, axes: Axes, raster: Raster, image: Floats, **style: Any) -> Any:
    """An image with r to the right and z upwards."""
    left = -raster.high[1] if section.mirrored else raster.low[1]
    extent = (left, raster.high[1], raster.low[0], raster.high[0])
    return axes.imshow(section.mirror(image).T, origin="lower", extent=extent, aspect="auto", interpolation="nearest", **style)


def _bar(figure: Figure, axes: Axes, drawn: Any, label: str, extend: str) -> None:
    """A slim bar the height of a panel, to its right."""
    place = axes.get_position()
    into = figure.add_axes((place.x1 + 0.02, place.y0 + 0.03 * place.height, 0.018, 0.94 * place.height))
    colours = figure.colorbar(drawn, cax=into, extend=extend, extendfrac=0.03)
    colours.set_label(label, labelpad=5)
    colours.outline.set_linewidth(0.5)
    colours.ax.tick_params(width=0.5, length=2.5)


def _frame(section: Section, axes: Axes, medium: str) -> None:
    """A panel's axis of symmetry, ticks and name."""
    scale, letter = section.length_scale
    axes.set_ylabel(f"$z$ / {letter}m")
    axes.yaxis.set_major_formatter(FuncFormatter(lambda z, _: number(z * scale)))
    if section.mirrored:
        axes.axvline(0.0, color=GREY, linewidth=0.5, dashes=(8, 3, 1.5, 3))
    top = medium == "fluid"
    axes.text(0.015, 0.97 if top else 0.03, medium, transform=axes.transAxes, va="top" if top else "bottom", style="italic",
              color=INK, bbox={"boxstyle": "square,pad=0.25", "facecolor": WHITE, "edgecolor": "none", "alpha": 0.85})
