"""The levels of refinement."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, Normalize

from drawing import INK, MOST, bar, bubble_outline, canvas, names, show
from run_directory import MILLI
from snapshots import Raster


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
