"""Where the solid would yield: von Mises stress minus yield strength."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.colors import TwoSlopeNorm
from matplotlib.figure import Figure

from .._given import among, positive
from ..case import materials
from ..mesh import Floats
from .section import Run, Section, Window, bar
from .._numbers import number
from .style import INK, WHITE, styled

MEGA = 1e-6
PAPER = (95e6, 250e6, 502e6)
"""Yield strengths of the paper's aluminium, structural and stainless steel, Pa."""


@styled
def yield_function(
    run: Run,
    yield_strength: float | Sequence[float] | None = None,
    time: float | None = None,
    window: Window | None = None,
    *,
    names: Sequence[str] | None = None,
    beside: Sequence[Run] = (),
    one_scale: bool = True,
    levels: bool = False,
) -> Figure:
    """The yield function Φ = σ_vM − Y₀ of the solid for one or several yield strengths, a panel each. The line is Φ = 0.

    All these panels are evaluated on the stresses of the one run, as the paper does with an elastic one: what a softer material
    would do is then only indicated.

    - `yield_strength`: in Pa; else the run's own, and where its material has none the paper's 95, 250 and 502 MPa.
    - `names`: of the materials, for the titles.
    - `beside`: runs with the consistent materials, as `pycav.consistent_runs` makes them; a panel each with the yield strength
      that their cases name.
    - `one_scale`: the same colours in all panels; else each one, side by side, has its own.
    - `levels`: outlines of the levels of refinement.
    """
    first = solid_section(run, time, window)
    if yield_strength is None:
        own = first.result.yield_strength
        yield_strength = PAPER if own is None else own
    panels = [(first, _strength(strength), names[k] if names else "")
              for k, strength in enumerate([yield_strength] if isinstance(yield_strength, (str, int, float)) else yield_strength)]
    for other in beside:
        section = solid_section(other, first.time, window)
        strength = section.result.yield_strength
        if strength is None:
            raise ValueError(f"the material of {section.result.directory} has no yield strength")
        material = section.result.parameters["solid"]["material"]
        panels.append((section, float(strength), f"{material.get('name', 'own material')}, own run"))

    images = [_images(section) for section, _, _ in panels]
    strengths = [strength for _, strength, _ in panels]
    excesses = [float(np.nanpercentile(image, 99.9)) - strength for (image, _), strength in zip(images, strengths)]
    norms = [_scale(excesses, strengths)] * len(panels)
    if not one_scale:
        norms = [_scale([excess], [strength]) for excess, strength in zip(excesses, strengths)]
    figure, all_axes = first.canvas(len(panels), len(panels) if not one_scale else 2 if len(panels) == 4 else 3)
    label = rf"$\Phi = \sigma_\mathrm{{vM}} - Y_0$ / MPa at $t$ = {first.time_shown}"
    for axes, (section, strength, name), (image, smooth), norm in zip(all_axes, panels, images, norms):
        raster = section.raster("solid")
        assert raster is not None
        drawn = section.show(axes, raster, (image - strength) * MEGA, cmap="PuOr_r", norm=norm)
        section.contour(axes, raster, smooth - strength, 0.0, colors=INK, linewidths=1.0)
        if levels:
            section.levels(axes)
        section.names(axes, "")
        what = f"$Y_0$ = {number(strength * MEGA)} MPa"
        axes.set_title(f"{name}, {what}" if name else what, loc="left", fontsize=9, pad=4)
        excess = number(round((float(section.snapshots["solid"]["von_mises"].max()) - strength) * MEGA))
        axes.text(0.03, 0.02, rf"largest $\Phi$: {excess} MPa", transform=axes.transAxes, fontsize=8, color=INK,
                  bbox={"boxstyle": "square,pad=0.2", "facecolor": WHITE, "edgecolor": "none", "alpha": 0.85})
        if not one_scale:
            bar(figure, axes, drawn, label, extend="max")
    if not one_scale:
        return figure
    # One bar below all columns.
    columns = [axes.get_position() for axes in all_axes]
    begin, end = min(place.x0 for place in columns), max(place.x1 for place in columns)
    bar(figure, all_axes[0], drawn, label, (0.0, (end - begin) / columns[0].width), "max")
    return figure


def _strength(given: object) -> float:
    """A yield strength in Pa; of a material's name the error tells that of the material."""
    if not isinstance(given, str):
        return positive("yield_strength", given, "Pa")
    known = {material.name: material.yield_strength for material in materials() if material.yield_strength is not None}
    if given in known:
        raise TypeError(f"yield_strength = {given!r}: give a number in Pa; {given} has {known[given]:g}")
    raise TypeError(f"yield_strength = {given!r}: give a number in Pa, as that of a material of the library; {among(given, known)}")


def _scale(excesses: Sequence[float], strengths: Sequence[float]) -> TwoSlopeNorm:
    """Colours of Φ in MPa; `excesses` are nearly the largest Φ of panels in Pa.

    The very largest values fill a few cells at the surface: the colours end where there is something to see.
    """
    return TwoSlopeNorm(0, -max(strengths) * MEGA, max(*excesses, 0.5 * min(strengths)) * MEGA)


def solid_section(run: Run, time: float | None, window: Window | None) -> Section:
    """The section of a run's solid alone; all of it without a window."""
    section = Section.of(run, time, window)
    if "solid" not in section.snapshots:
        raise ValueError("the run has no solid")
    section.snapshots = {"solid": section.snapshots["solid"]}
    mesh = section.snapshots["solid"].mesh
    if window is None:
        (z_low, r_low), (z_high, r_high) = mesh.low.tolist(), mesh.high.tolist()
        section.box = (z_low, z_high, r_low, r_high)
    if section.raster("solid") is None:
        raise ValueError(f"the window {window} holds nothing of the solid")
    return section


def _images(section: Section) -> tuple[Floats, Floats]:
    """The von Mises stress as it is in cells, and linear within them."""
    raster, snapshot = section.raster("solid"), section.snapshots["solid"]
    assert raster is not None
    stress = snapshot["von_mises"]
    return raster.paint(stress), raster.paint(stress, snapshot.mesh.linear(stress))
