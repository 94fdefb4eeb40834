"""Maps over two parameters and a third one, with what they are off by."""

from __future__ import annotations

import os
from collections.abc import Sequence
from textwrap import fill
from typing import Any

import numpy as np
import xarray
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from .._given import among
from ..mesh import Floats
from .._numbers import number, prefix, rounded
from ..sweeps.dataset import opened
from .style import BLUE, GREEN, GREY, INK, ORANGE, PINK, WHITE, legend, part_of, styled, ticks
from .surface import ALMOST_STILL

STEEP, MOVES = 0.05, ALMOST_STILL
"""Where a pit is marked: depth over radius, and `surface_still`."""
LINES, MARKS = (BLUE, GREEN, ORANGE, PINK, GREY, INK), "os^Dv."
PANEL, FIELD, LOW = 2.9, 0.42, 2.3  # inches
NARROW = 26
"""Letters that have room along a small panel's side."""
LABELS = {"stand_off": "stand-off $d/R$", "fluid.ambient.pressure": "driving pressure"}


@styled
def damage_map(
    data: xarray.Dataset | str | os.PathLike[str],
    quantity: str = "pit_depth",
    *,
    x: str = "stand_off",
    y: str = "fluid.ambient.pressure",
    panels: str = "solid.material",
    below: Sequence[str] = (),
    sure: float = 0.5,
) -> Figure:
    """A quantity over two parameters, a panel for every value of a third, written into every field.

    Hatched: not converged, where the uncertainty of `pycav.with_uncertainty` is more than the share `sure` of the value. Pits
    have marks: * deeper than a twentieth of their radius, which is much for small strains; ≈ the surface still moves by more than a tenth
    of the depth. A field without a pit, one that failed and one that was not run say so.

    - `data`: a sweep over these three parameters, or its file; others have to be chosen before (`sel`).
    - `below`: quantities drawn below as lines over x, one for each y, of the last panel's value, with bands of their uncertainty.
    """
    data = opened(data)
    if quantity not in data or set(data[quantity].dims) != {x, y, panels}:
        have = ", ".join(map(str, data[quantity].dims)) if quantity in data else f"none of {quantity}"
        raise ValueError(f"this map needs a sweep over {x}, {y} and {panels}; the dataset has {have}")
    data = data.transpose(panels, y, x).sortby([x, y])
    names = data[panels].to_numpy()
    across = max(len(names), len(below), 1)
    high = 0.9 + FIELD * data.sizes[y]
    figure = Figure(figsize=(PANEL * across, high + LOW * bool(below)), layout="constrained")
    rows: Any = figure.subfigures(2, 1, height_ratios=[high, LOW], hspace=0.02) if below else [figure]
    upper = rows[0].subplots(1, len(names), sharey=True, squeeze=False)[0]
    values = data[quantity].to_numpy()
    shown = np.ma.masked_array(values, ~(np.nan_to_num(values) > 0))
    norm = LogNorm(0.999 * float(shown.min()), 1.001 * float(shown.max())) if shown.count() else LogNorm(0.1, 1.0)
    unit, marks = str(data[quantity].attrs.get("units", "")), set[str]()
    drawn: Any = None
    for axes, name in zip(upper, names):
        drawn = _fields(axes, data.sel({panels: name}), quantity, norm, unit, sure, marks)
        axes.set_title(str(name), fontsize=9)
        _ticks(axes, data, x, y)
    for axes in upper[1:]:
        axes.set_ylabel("")
    _bar(figure if not below else rows[0], drawn, upper, norm, data[quantity], unit)
    _notes(upper[0] if len(names) == 1 else upper[len(names) // 2], marks, sure)
    if below:
        lower = rows[1].subplots(1, len(below), squeeze=False)[0]
        for axes, own in zip(lower, below):
            sweep_lines_on(axes, data.sel({panels: names[-1]}), own, x, y)
        legend(lower[-1], title=_label(y), title_fontsize=8)
        lower[0].set_title(f"on {names[-1]}", fontsize=9, loc="left")
    return figure


def _fields(axes: Axes, data: xarray.Dataset, quantity: str, norm: LogNorm, unit: str, sure: float, marks: set[str]) -> Any:
    """One panel, its fields of equal size."""
    values = data[quantity].to_numpy()
    drawn = axes.pcolormesh(np.ma.masked_array(values, ~(np.nan_to_num(values) > 0)), norm=norm, cmap=part_of("YlOrRd", 0.0, 0.9),
                            edgecolors=WHITE, linewidth=1.0)
    axes.set_facecolor("0.95")
    axes.tick_params(length=0)
    unsure = _unsure(data, quantity, sure)
    for row, column in np.ndindex(values.shape):
        here = data.isel({data[quantity].dims[0]: row, data[quantity].dims[1]: column})
        says, mark = _says(here, quantity, float(values[row, column]), unit)
        marks |= mark
        if unsure[row, column]:
            marks.add("/")
            axes.add_patch(Rectangle((column, row), 1, 1, fill=False, hatch="////", edgecolor="0.55", linewidth=0))
        dark = np.nan_to_num(values[row, column]) > 0 and float(norm(values[row, column])) > 0.6
        plate = {"boxstyle": "square,pad=0.12", "facecolor": drawn.cmap(norm(values[row, column])), "edgecolor": "none"}
        axes.text(column + 0.5, row + 0.5, says, ha="center", va="center", fontsize=7, color=WHITE if dark else INK,
                  bbox=plate if unsure[row, column] else None)
    return drawn


def _says(here: xarray.Dataset, quantity: str, value: float, unit: str) -> tuple[str, set[str]]:
    """What stands in a field, and the marks in it."""
    if "status" in here and int(here["status"]) == 2:
        return "not run", set()
    if not np.isfinite(value):
        return "failed" if "status" not in here or int(here["status"]) == 1 else "–", set()
    if not quantity.startswith("pit_"):
        return rounded(value, unit), set()
    if not value > 0 or ("plastic_strain_peak" in here and not float(here["plastic_strain_peak"]) > 0):
        return "no pit", set()
    marks = set[str]()
    if {"pit_depth", "pit_radius"} <= set(here) and float(here["pit_depth"]) > STEEP * float(here["pit_radius"]):
        marks.add("*")
    if "surface_still" in here and float(here["surface_still"]) > MOVES:
        marks.add("≈")
    return "≈ " * ("≈" in marks) + rounded(float(f"{value:.2g}"), unit) + "*" * ("*" in marks), marks


def _unsure(data: xarray.Dataset, quantity: str, sure: float) -> Any:
    values = np.nan_to_num(data[quantity].to_numpy())
    if f"{quantity}_uncertainty" not in data:
        return np.zeros(values.shape, bool)
    known = data[f"{quantity}_uncertainty"].to_numpy()
    return (values != 0) & ~(known <= sure * np.abs(values))


def _ticks(axes: Axes, data: xarray.Dataset, x: str, y: str) -> None:
    for axis, name, limits in ((axes.xaxis, x, axes.set_xlim), (axes.yaxis, y, axes.set_ylim)):
        values = data[name].to_numpy()
        limits(0, len(values))
        scale, letter, unit = _scale(data, name)
        shown = [str(value) if isinstance(value, (str, bool)) else number(float(f"{value * scale:.4g}")) for value in values.tolist()]
        axis.set_ticks(np.arange(len(values)) + 0.5, shown)
        axis.set_label_text(f"{_label(name)} / {letter}{unit}" if unit else _label(name))


def _scale(data: xarray.Dataset, name: str) -> tuple[float, str, str]:
    unit = str(data[name].attrs.get("units", ""))
    if unit in ("", "1"):
        return 1.0, "", ""
    scale, letter = prefix(float(np.abs(data[name]).max()))
    return scale, letter, unit


def _label(name: str) -> str:
    return LABELS.get(name, name.rpartition(".")[2].replace("_", " "))


def _bar(figure: Any, drawn: Any, axes: Any, norm: LogNorm, values: xarray.DataArray, unit: str) -> None:
    scale, letter = prefix(float(norm.vmax or 1.0)) if unit in ("Pa", "m", "s", "J", "J/m", "Pa s") else (1.0, "")
    bar = figure.colorbar(drawn, ax=list(axes), aspect=18, pad=0.01)
    bar.ax.yaxis.set(major_locator=LogLocator(), minor_locator=NullLocator(),
                     major_formatter=FuncFormatter(lambda value, _: number(value * scale)))
    bar.set_label(f"{values.attrs.get('long_name', values.name)} / {letter}{unit}".removesuffix(" / 1"))


def _notes(axes: Axes, marks: set[str], sure: float) -> None:
    said = {"*": f"* deeper than {100 * STEEP:g} % of its radius: beyond small strains",
            "≈": f"≈ still moving by more than {100 * MOVES:g} %", "/": f"hatched: uncertainty above {100 * sure:g} %"}
    if lines := [text for mark, text in said.items() if mark in marks]:
        axes.set_xlabel("\n".join([axes.get_xlabel(), "   ".join(lines)]))


@styled
def sweep_lines(data: xarray.Dataset | str | os.PathLike[str], quantity: str, x: str = "stand_off", lines: str | None = None) -> Figure:
    """A quantity of a map over a parameter, a line for every value of another, with bands of their uncertainty.

    - `data`: a sweep over one or two parameters, or its file; others have to be chosen before (`sel`).
    """
    data = opened(data)
    if quantity not in data:
        raise ValueError(f"the map has no {quantity}: {among(quantity, data.data_vars)}")
    others = [str(name) for name in data[quantity].dims if name != x]
    if x not in data[quantity].dims or len(others) > 1 or (lines is not None and others != [lines]):
        have = ", ".join(map(str, data[quantity].dims))
        raise ValueError(f"lines over {x} need a sweep over it and {lines or 'at most one more parameter'}, not over {have}: "
                         "x and lines say over which, and sel chooses of more")
    figure = Figure(figsize=(4.4, 3.2), layout="constrained")
    axes = figure.subplots()
    sweep_lines_on(axes, data, quantity, x, others[0] if others else None)
    if others:
        legend(axes, title=_label(others[0]), title_fontsize=8)
    return figure


def sweep_lines_on(axes: Axes, data: xarray.Dataset, quantity: str, x: str, by: str | None) -> None:
    """Draws the lines of `sweep_lines` into axes."""
    data = data.sortby(x)
    rows = [data] if by is None else [data.isel({by: k}) for k in range(data.sizes[by])]
    place, top = data[x].to_numpy().astype(float), 0.0
    for k, row in enumerate(rows):
        values, off = row[quantity].to_numpy().astype(float), _off(row, quantity)
        colour = LINES[k % len(LINES)]
        name = "" if by is None else _name(row, by, data)
        axes.plot(place, values, color=colour, marker=MARKS[k % len(MARKS)], markersize=3.5, label=name)
        if np.isfinite(off).any():
            axes.fill_between(place, np.maximum(values - off, 0.0), values + off, color=colour, alpha=0.18, linewidth=0)
        top = max(top, float(np.nanmax(np.nan_to_num(values))))
    label, own = str(data[quantity].attrs.get("long_name", quantity)), str(data[quantity].attrs.get("units", "1"))
    if own in ("", "1"):
        axes.set_ylabel(fill(label, NARROW))
    else:
        ticks(axes.yaxis, top, label, own)
        axes.set_ylabel(fill(axes.get_ylabel(), NARROW))
    axes.set_ylim(0.0, 1.25 * top or None)
    scale, letter, unit = _scale(data, x)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: number(value * scale)))
    if data[x].dtype == bool:
        axes.set_xticks(place, map(str, data[x].to_numpy().tolist()))
    axes.set_xlabel(f"{_label(x)} / {letter}{unit}" if unit else _label(x))


def _off(data: xarray.Dataset, quantity: str) -> Floats:
    found = data.get(f"{quantity}_uncertainty")
    return np.full(data[quantity].shape, np.nan) if found is None else found.to_numpy().astype(float)


def _name(row: xarray.Dataset, by: str, data: xarray.Dataset) -> str:
    value = row[by].item()
    if isinstance(value, (str, bool)):
        return str(value)
    scale, letter, unit = _scale(data, by)
    return f"{number(float(f'{value * scale:.4g}'))} {letter}{unit}".strip()
