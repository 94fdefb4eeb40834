"""Where the solid would yield: von Mises stress minus yield strength."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from .section import Run, Section, Window, bar
from .style import INK, WHITE, number, prefix, styled

MEGA = 1e-6


@styled
def yield_function(
    run: Run,
    yield_strength: float | Sequence[float] = (95e6, 250e6, 502e6),
    time: float | None = None,
    window: Window | None = None,
    *,
    names: Sequence[str] | None = None,
) -> Figure:
    """The yield function Φ = σ_vM − Y₀ of the solid for one or several yield strengths in Pa, a panel each.

    All panels are evaluated on the stresses of the one elastic run, as the paper does: what a softer material would do is
    then only indicated, and a run with that material is the consistent one. The line is Φ = 0.

    - `names`: of the materials, for the titles.
    """
    strengths = np.atleast_1d(np.asarray(yield_strength, float))
    section = Section.of(run, time, None)
    if "solid" not in section.snapshots:
        raise ValueError("the run has no solid")
    snapshot = section.snapshots["solid"]
    mesh = snapshot.mesh
    (z_low, r_low), (z_high, r_high) = mesh.low.tolist(), mesh.high.tolist()
    section.box = (z_low, z_high, r_low, r_high) if window is None else (window[0], window[1], r_low, window[2])
    section.snapshots = {"solid": snapshot}
    raster = section.raster("solid")
    if raster is None:
        raise ValueError(f"the window {window} holds nothing of the solid")
    figure, panels = section.canvas(len(strengths), 2 if len(strengths) == 4 else 3)
    stress = snapshot["von_mises"]
    image, smooth = raster.paint(stress), raster.paint(stress, mesh.gradient(stress))
    # The very largest values fill a few cells at the surface: the colours end where there is something to see.
    reach = max(float(np.nanpercentile(image, 99.9)) - strengths.min(), 0.5 * strengths.min())
    norm = TwoSlopeNorm(0, -strengths.max() * MEGA, reach * MEGA)
    for panel, (axes, strength) in enumerate(zip(panels, strengths)):
        drawn = section.show(axes, raster, (image - strength) * MEGA, cmap="PuOr_r", norm=norm)
        section.contour(axes, raster, smooth - strength, 0.0, colors=INK, linewidths=1.0)
        section.names(axes, "")
        what = f"$Y_0$ = {number(strength * MEGA)} MPa"
        axes.set_title(f"{names[panel]}, {what}" if names else what, loc="left", fontsize=9, pad=4)
        excess = number(round((stress.max() - strength) * MEGA))
        axes.text(0.03, 0.02, rf"largest $\Phi$: {excess} MPa", transform=axes.transAxes, fontsize=8, color=INK,
                  bbox={"boxstyle": "square,pad=0.2", "facecolor": WHITE, "edgecolor": "none", "alpha": 0.85})
    wide = panels[:1] if len(panels) == 1 else panels
    first, end = wide[0].get_position(), wide[-1].get_position()
    part = (0.0, (end.x1 - first.x0) / first.width)
    scale, letter = prefix(section.time)
    label = rf"$\Phi = \sigma_\mathrm{{vM}} - Y_0$ / MPa at $t$ = {section.time * scale:.1f} {letter}s"
    bar(figure, wide[0], drawn, label, part, "max")
    return figure
