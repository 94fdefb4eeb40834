"""Waves: numerical schlieren."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from ..mesh import Floats
from ..result import Result, Snapshot
from .refinement import blocks as outlines
from .section import Run, Section, Window, bar
from .style import BLUE, logarithmic, styled

LABELS = {"solid": r"$|\nabla\sigma_{zz}|\,/\,c_1^2$ / (kg m$^{-4}$)", "fluid": r"$|\nabla\rho|$ / (kg m$^{-4}$)"}


@styled
def schlieren(
    run: Run,
    time: float | None = None,
    window: Window | None = None,
    *,
    levels: bool = False,
    blocks: bool = False,
    strongest: Mapping[str, float] | None = None,
) -> Figure:
    """Magnitudes of the density's gradient in the fluid and of ∇σ_zz / c₁² in the solid, both logarithmic.

    For a dilatational wave along z the latter is the solid's |∇ρ|; shear waves show as well. The line is φ = ½.

    - `levels`: outlines of the levels of refinement.
    - `blocks`: outlines of the blocks of 16 × 16 cells, at r > 0 only.
    - `strongest`: ends of the scales in kg/m⁴ by medium, for pictures that are to be compared.
    """
    section = Section.of(run, time, window)
    figure, (axes,) = section.canvas()
    for medium, part in section.parts:
        raster = section.raster(medium)
        if raster is None:
            continue
        image = raster.paint(gradient(section.result, medium, section.snapshots[medium]))
        top = float(np.nanpercentile(image, 99.8)) if strongest is None else strongest[medium]
        decades = 4.0
        if medium == "solid":  # fewer decades where everything is about as strong
            weakest = max(float(np.nanpercentile(image, 2)), 1e-12 * top, 1e-12)
            decades = 2.5 if strongest else float(np.clip(np.log10(max(top, 1e-12) / weakest), 1.5, 2.5))
        drawn = section.show(axes, raster, image, cmap="gray_r", norm=logarithmic(top, decades))
        bar(figure, axes, drawn, LABELS[medium], part, "both")
        if blocks:
            outlines(section, axes, medium, colors=BLUE, linewidths=0.4)
    section.annotate(axes, "Numerical schlieren", levels)
    return figure


def gradient(result: Result, medium: str, snapshot: Snapshot) -> Floats:
    """What schlieren show of a medium, kg/m⁴, shape (cells,)."""
    if medium == "fluid" and "schlieren" in snapshot:
        return snapshot["schlieren"]
    name = "density" if medium == "fluid" else "stress_zz"
    scale = 1.0 if medium == "fluid" else wave_speed(result) ** 2
    return np.asarray(np.hypot(*snapshot.mesh.gradient(snapshot[name]).T) / scale)


def wave_speed(result: Result) -> float:
    """The solid's c₁, m/s; the effective case has it whatever the case names."""
    return float(result.parameters["solid"]["material"]["c1"])
