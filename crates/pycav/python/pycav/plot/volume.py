"""The bubble and the solid in three dimensions."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..result import open_run
from .section import Run, default_time

if TYPE_CHECKING:
    import pyvista


def volume(run: Run, time: float | None = None, *, angle: float = 270.0, cells: int = 200) -> dict[str, pyvista.DataSet]:
    """The axisymmetric run turned about its axis, for PyVista: `{"bubble": surface of φ = ½, "solid": cut block}`.

    The solid carries `von_mises` in Pa. Needs pyvista; show it with
    `plotter.add_mesh(parts["solid"], scalars="von_mises")`. A planar run is refused by a ValueError.

    - `angle`: how far the solid is turned, degrees; `cells`: along each side of the section that is turned.
    """
    import pyvista

    result = open_run(run)
    if result.parameters.get("geometry") == "planar":
        raise ValueError("the run is planar: it has no axis to be turned about; pycav.plot.overview shows its plane")
    wanted = default_time(result) if time is None else time
    parts: dict[str, pyvista.DataSet] = {}
    for medium, name in (("fluid", "gas_fraction"), ("solid", "von_mises")):
        if medium not in result.media:
            continue
        snapshot = result.snapshots(medium).at(wanted)
        mesh = snapshot.mesh
        z, r = (np.linspace(mesh.low[a], mesh.high[a], cells + 1) for a in (0, 1))
        edge = 1e-9 * (mesh.high - mesh.low)
        points = np.stack(np.meshgrid(z, r, indexing="ij"), -1).reshape(-1, 2)
        values = mesh.sample(snapshot[name], np.clip(points, mesh.low + edge, mesh.high - edge))
        # A point (z, r) of the section becomes (r, 0, z): turning is about the third axis.
        low = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
        quads = np.column_stack([np.full(cells * cells, 4), low, low + 1, low + cells + 2, low + cells + 1])
        grid = pyvista.PolyData(np.column_stack([points[:, 1], np.zeros(len(points)), points[:, 0]]), quads.ravel())
        grid.point_data[name] = values
        if medium == "fluid":
            line = grid.contour([0.5], scalars=name)
            if line.n_points:
                parts["bubble"] = line.extrude_rotate(resolution=90, capping=False)
        else:
            parts["solid"] = grid.extrude_rotate(resolution=90, angle=angle, capping=True)
    return parts
