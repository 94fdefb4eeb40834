"""Maps over the parameters of a sweep."""

from __future__ import annotations

import os
from collections.abc import Sequence

import numpy as np
import xarray
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from .._given import among
from ..mesh import Floats
from .._numbers import number, prefix, rounded
from ..sweeps.dataset import opened
from .style import BLUE, GREEN, GREY, INK, ORANGE, PINK, WHITE, WIDTH, legend, part_of, styled, ticks
from .surface import ALMOST_STILL

SHOWN = [
    ("wall_pressure_peak", "wall pressure, largest", "Pa"), ("load_impulse", "impulse on the wall", "Pa s"),
    ("von_mises_peak", "von Mises stress, largest", "Pa"), ("yielded_volume_peak", "yielded volume", "m3"),
]
LENGTHS = {"pit_depth": "depth of the pit", "pit_radius": "radius at half depth", "pit_rim": "height of the rim"}
MOVES, STEEP = ALMOST_STILL, 0.05
"""Where a pit's field is marked: `surface_still`, and depth over radius; beyond the latter a run warns, too."""
UNSURE = 0.5
"""A field is hatched where the uncertainty is more than this share of it."""
COLOURS, MARKS = (BLUE, ORANGE, GREEN, PINK, INK, GREY), "osD^vP"


@styled
def stand_off_map(data: xarray.Dataset | str | os.PathLike[str]) -> Figure:
    """Wall-pressure peak, impulse, von Mises peak and yielded volume over the stand-off, a line for every material.

    - `data`: what `pycav.stand_off_map` returned, or its file; with error bars where `pycav.with_uncertainty` has said how sure it is.
    """
    data = opened(data)
    # Maps of earlier versions have the impulse beyond the pressure at the start alone.
    shown = [("wall_impulse" if name == "load_impulse" and name not in data else name, *more) for name, *more in SHOWN]
    _over_both("a map over the stand-off", data, [name for name, *_ in shown])
    distance = data["stand_off"].to_numpy()
    figure = Figure(figsize=(WIDTH, 4.6), layout="constrained")
    panels = figure.subplots(2, 2, sharex=True).ravel()
    for axes, (name, label, unit) in zip(panels, shown):
        values = data[name].transpose("stand_off", "solid.material").to_numpy()
        off = data[f"{name}_uncertainty"].transpose("stand_off", "solid.material").to_numpy() if f"{name}_uncertainty" in data else None
        for column, material in enumerate(data["solid.material"].to_numpy()):
            axes.plot(distance, values[:, column], color=COLOURS[column % 6], marker=MARKS[column % 6], markersize=4,
                      label=str(material))
            if off is not None:
                axes.errorbar(distance, values[:, column], off[:, column], color=COLOURS[column % 6], linestyle="none", capsize=2)
        largest = float(np.nanmax(values)) if np.isfinite(values).any() else 0.0
        if unit == "m3":
            power = 2 if data[name].attrs.get("units") == "m2" else 3  # a planar volume is an area
            scale, letter = prefix(largest ** (1 / power))  # of a length, whose power the volume is
            axes.yaxis.set_major_formatter(lambda v, _, s=scale**power: f"{v * s:g}")
            axes.set_ylabel(f"{label} / {letter}m$^{power}$")
        else:
            ticks(axes.yaxis, largest, label, unit)
        axes.set_ylim(min(0.0, 1.05 * float(np.nanmin(values, initial=0.0))), 1.08 * largest or None)
    for axes in panels[2:]:
        axes.set_xlabel("stand-off $d/R$")
    legend(panels[0])
    return figure


@styled
def pit_map(data: xarray.Dataset | str | os.PathLike[str], quantity: str = "pit_depth") -> Figure:
    """A length of the pit over stand-off and material, written into every field.

    Materials are rows, the one of the largest value on top; columns reach half way to the next stand-off. A field where nothing
    stays says so, as does one whose run failed. Marks: ≈ where the surface still moves by more than a tenth of the depth,
    * where the pit is deeper than a twentieth of its radius, which is much for the small strains of the model; hatched where the
    uncertainty of `pycav.with_uncertainty` is more than half of the value.

    - `data`: a sweep over `stand_off` and `solid.material` with a law of hardening, as of `pycav.stand_off_map`, or its file.
    - `quantity`: `pit_depth`, `pit_radius`, or `pit_rim`.
    """
    if quantity not in LENGTHS:
        raise ValueError(f"a map is drawn of {', '.join(LENGTHS)}, not of {quantity!r}")
    data = opened(data)
    _over_both("a map of pits", data, [quantity, "pit_depth", "pit_radius", "plastic_strain_peak", "surface_still"])
    if np.isnan(data["plastic_strain_peak"]).all() and not np.isnan(data["von_mises_peak"]).all():
        raise ValueError("the solids are elastic and keep no pit: [solid.plasticity] of the case makes them yield")
    data = data.sortby("stand_off").transpose("solid.material", "stand_off")
    data = data.isel({"solid.material": np.argsort(data[quantity].fillna(0.0).max("stand_off").to_numpy(), kind="stable")})
    values, depth, radius, strain, still = (data[name].to_numpy() for name in (
        quantity, "pit_depth", "pit_radius", "plastic_strain_peak", "surface_still"))
    stays = (depth > 0) & (strain > 0)
    moves, steep = stays & (still > MOVES), stays & (depth > STEEP * radius)
    distance, names = data["stand_off"].to_numpy().astype(float), [str(name) for name in data["solid.material"].to_numpy()]
    figure = Figure(figsize=(WIDTH, 1.0 + 0.36 * len(names)), layout="constrained")
    axes = figure.subplots()
    axes.set_facecolor("0.95")
    shown = np.ma.masked_array(values, ~(stays & (values > 0)))
    low, high = (float(shown.min()), float(shown.max())) if shown.count() else (1e-6, 1e-6)
    norm = LogNorm(0.999 * low, 1.001 * high)
    edges = _edges(distance)
    unsure = (~(data[f"{quantity}_uncertainty"] <= UNSURE * data[quantity])).to_numpy() if f"{quantity}_uncertainty" in data else stays & False
    drawn = axes.pcolormesh(edges, np.arange(len(names) + 1), shown, norm=norm, cmap=part_of("YlOrRd", 0.0, 0.9),
                            edgecolors=WHITE, linewidth=1.0)
    for row, column in np.ndindex(values.shape):
        value, here = float(values[row, column]), (row, column)
        says = "failed" if np.isnan(depth[here]) else "no pit" if not stays[here] else (
            "≈ " * bool(moves[here]) + rounded(value, "m") + "*" * bool(steep[here]))
        dark = stays[here] and norm(value) > 0.6
        if stays[here] and unsure[here]:
            left, right = float(edges[column]), float(edges[column + 1])
            axes.add_patch(Rectangle((left, row), right - left, 1, fill=False, hatch="////", edgecolor="0.55", linewidth=0))
        axes.text(float(distance[column]), row + 0.5, says, ha="center", va="center", fontsize=8, color=WHITE if dark else INK)
    axes.set_yticks(np.arange(len(names)) + 0.5, names)
    axes.set_xticks(distance, [number(value) for value in distance])
    axes.tick_params(length=0)
    notes = [f"≈ still moving by more than {100 * MOVES:g} %"] * bool(moves.any())
    notes += [f"* deeper than {100 * STEEP:g} % of its radius: beyond small strains"] * bool(steep.any())
    axes.set_xlabel("\n".join(["stand-off $d/R$", *(["   ".join(notes)] if notes else [])]))
    scale, letter = prefix(high)
    bar = figure.colorbar(drawn, ax=axes, aspect=15, pad=0.02)
    bar.ax.yaxis.set(major_locator=LogLocator(subs=(1, 2, 5)), minor_locator=NullLocator(),
                     major_formatter=FuncFormatter(lambda value, _: number(value * scale)))
    bar.set_label(f"{LENGTHS[quantity]} / {letter}m")
    return figure


def _over_both(what: str, data: xarray.Dataset, needed: Sequence[str]) -> None:
    """Refuses what is no map over stand-off and material, and one that lacks a quantity."""
    if set(data.dims) != {"stand_off", "solid.material"}:
        raise ValueError(f"{what} needs a sweep over stand_off and solid.material, not over {', '.join(map(str, data.dims)) or 'nothing'}")
    if missing := [name for name in dict.fromkeys(needed) if name not in data]:
        raise ValueError(f"{what} needs {', '.join(missing)}: {among(missing[0], data.data_vars)}")


def _edges(middles: Floats) -> Floats:
    """Where fields end about increasing values: half way between them, and as far beyond the ends."""
    if len(middles) == 1:
        return np.array([middles[0] - 0.5, middles[0] + 0.5])
    half = 0.5 * np.diff(middles)
    return np.concatenate([[middles[0] - half[0]], middles[:-1] + half, [middles[-1] + half[-1]]])
