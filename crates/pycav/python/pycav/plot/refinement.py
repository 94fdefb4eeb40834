"""The levels of refinement."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, Normalize
from matplotlib.figure import Figure

from ..mesh import Box, Floats, Mesh
from .section import Run, Section, Window, bar
from .style import INK, styled

BLOCK = 16  # cells along a side of a block


@styled
def grid_levels(run: Run, time: float | None = None, window: Window | None = None) -> Figure:
    """The level of every cell in both media, and the outlines of the blocks of 16 × 16 cells."""
    section = Section.of(run, time, window)
    figure, (axes,) = section.canvas()
    for medium, part in section.parts:
        snapshot, raster = section.snapshots[medium], section.raster(medium)
        if raster is None:
            continue
        level = snapshot["level"]
        low, high = int(level.min()), int(level.max())
        colours = ListedColormap(mpl.colormaps["YlGnBu"](np.linspace(0.05, 0.75, high - low + 1)))
        drawn = section.show(axes, raster, raster.paint(level), cmap=colours, norm=Normalize(low - 0.5, high + 0.5))
        bar(figure, axes, drawn, f"level in the {medium}", part, ticks=np.arange(low, high + 1))
        blocks(section, axes, medium, (1, -1) if section.mirrored else (1,))
    section.annotate(axes, "Levels, and blocks of 16 × 16 cells", False)
    return figure


def blocks(section: Section, axes: Axes, medium: str, signs: Sequence[int] = (1,), **style: Any) -> None:
    """The outlines of a medium's blocks, at r > 0 for a sign of 1 and mirrored for −1."""
    outlines = _outlines(section.snapshots[medium].mesh, section.box)
    for sign in signs:
        axes.add_collection(LineCollection(list(outlines * [1, sign]), **{"colors": INK, "linewidths": 0.25, **style}))


def _outlines(mesh: Mesh, box: Box) -> Floats:
    """The corners of the blocks in a box, around each: shape (blocks, 5, 2), m."""
    blocks = np.unique(np.column_stack([mesh.index // BLOCK, mesh.depth]), axis=0)
    width = mesh.finest * BLOCK * 2.0 ** blocks[:, 2:]
    low = mesh.low + blocks[:, :2] * width
    # Outlines closer than about four pixels would be a black spot.
    large = width > 0.006 * (box[1] - box[0])
    seen = ((low + width > [box[0], box[2]]) & (low < [box[1], box[3]]) & large).all(1)
    around = np.array([(0, 0), (0, 1), (1, 1), (1, 0), (0, 0)])
    return np.asarray(low[seen, None] + around * width[seen, None])
