"""Plastic strain: where the solid has flowed."""

from __future__ import annotations

from typing import Any

from matplotlib.colors import LogNorm, PowerNorm
from matplotlib.figure import Figure

from ..mesh import Floats
from ..result import Snapshot
from .section import Run, Window, bar
from .style import INK, part_of, styled
from .yielding import solid_section

FIELD = "plastic_strain"
LABEL = r"plastic strain $\varepsilon_\mathrm{p}$"
LINES = ((1e-4, "$10^{-4}$", 0.5), (2e-3, r"$2\cdot 10^{-3}$", 1.1))
"""Plastic strain, its name and width: the bounds of the plastic zones of `summary.json`."""
MEGA = 1e-6


@styled
def plastic_strain(run: Run, time: float | None = None, window: Window | None = None, *, levels: bool = False) -> Figure:
    """The von Mises stress of a solid that yields and, beside it, the plastic strain with lines at 1e-4 and 2e-3.

    - `levels`: outlines of the levels of refinement.
    """
    section = solid_section(run, time, window)
    snapshot, raster = section.snapshots["solid"], section.raster("solid")
    assert raster is not None
    strain, stress = strain_of(snapshot), snapshot["von_mises"] * MEGA
    figure, (left, right) = section.canvas(2)
    # A power below one lifts what is weak beside the maximum.
    norm = PowerNorm(0.6, 0.0, max(float(stress.max()), 1e-12))
    drawn = section.show(left, raster, raster.paint(stress), cmap="inferno", norm=norm)
    bar(figure, left, drawn, r"von Mises stress $\sigma_\mathrm{vM}$ / MPa")
    drawn = section.show(right, raster, raster.paint(strain), **colours(strain))
    bar(figure, right, drawn, LABEL, extend="min")
    smooth = raster.paint(strain, snapshot.mesh.linear(strain))
    for level, _, width in LINES:
        section.contour(right, raster, smooth, level, colors=INK, linewidths=width)
    for axes, what in ((left, "Stress"), (right, "Plastic strain")):
        if levels:
            section.levels(axes)
        section.names(axes, what)
    return figure


def strain_of(snapshot: Snapshot) -> Floats:
    """The plastic strain of the solid's cells; `ValueError` where the solid is elastic, or where it was not written."""
    if FIELD not in snapshot:
        raise ValueError(f"the snapshots have no {FIELD}: [solid.plasticity] of the case makes the solid yield, "
                         "and output.fields has to hold it if it is given")
    return snapshot[FIELD]


def colours(strain: Floats) -> dict[str, Any]:
    """Colour map and logarithmic scale from 1e-4 on; below it nearly white, as nothing has flowed there."""
    # Also of 0, which has no logarithm.
    colour_map = part_of("magma_r", 0.1, 0.9).with_extremes(under="0.95", bad="0.95")
    return {"cmap": colour_map, "norm": LogNorm(LINES[0][0], max(float(strain.max()), 10 * LINES[0][0]))}
