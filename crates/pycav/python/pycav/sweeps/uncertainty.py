"""How sure a map is: the same points on other grids."""

from __future__ import annotations

import itertools
import os
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import xarray

from ..mesh import Floats
from .dataset import numeric, opened, values_along
from .points import is_plain

KINDS = ("interpolated", "monotone", "oscillatory", "divergent", "oscillatory-divergent", "coincident", "unchanged", "two-grids", "unknown",
         "slow")
"""What the values of a point on several grids do; the words of docs/verification/convergence.md, and `interpolated` between such points."""

SAFETY, SAFETY_OF_TWO, ORDERS, ROUND_OFF = 1.25, 3.0, (0.5, 2.0), 1e-12


class Estimate(NamedTuple):
    """The uncertainty of a value on one of the grids, in its own unit, and what the values do."""

    uncertainty: float
    kind: str


def with_uncertainty(
    data: xarray.Dataset | str | os.PathLike[str],
    *others: xarray.Dataset | str | os.PathLike[str],
    quantities: Sequence[str] = ("pit_depth", "load_impulse", "wall_impulse", "wall_pressure_peak", "plastic_strain_peak"),
) -> xarray.Dataset:
    """A map with what its numbers are off by, from maps of some of its points on finer and coarser grids.

    At a point that the others have, too, the uncertainty is the grid-convergence index times the value, by the rules of `pycav.convergence`:
    three grids give an order, whatever the ratios of their cells, two assume the second, with a safety factor of 3. Where three
    values have no order it is their spread, largest minus smallest, or half of it if they oscillate. In between, the *share* of the
    value is interpolated linearly over numeric parameters, and beyond them the nearest counts; for a text that the others lack, the
    largest of all.

    - `data`: a dataset of `sweep`, or its file; `others`: sweeps over some of the same values, with other cells per radius
      (a ValueError where they are the same and the numbers are not, as of grids that differ in the solid alone).
    - `quantities`: which numbers; those that the map lacks are passed over.

    Each gets `NAME_uncertainty`, in its unit, and `NAME_convergence`, flags as of CF. NaN where nothing is known: at failed points, and
    where all shares are of a value of 0.
    """
    own = opened(data)
    if not others:
        raise ValueError("an uncertainty needs the map on two grids or more")
    maps = [own, *(_paired(own, opened(other)) for other in others)]
    result = own.copy()
    for name in quantities:
        if all(name in own for own in maps):
            _add(result, name, maps)
    return result


def _paired(data: xarray.Dataset, other: xarray.Dataset) -> xarray.Dataset:
    """The other map with the labels of this one: what is labelled by its number in a list, as a table, is told by its value."""
    names = [str(name) for name in data["status"].dims]
    if set(other["status"].dims) != set(names):
        raise ValueError(f"the maps are over other parameters: {', '.join(names)} and {', '.join(map(str, other['status'].dims))}")
    for name in names:
        own, theirs = values_along(data, name), values_along(other, name)
        if own and theirs and not all(is_plain(value) for value in [*own, *theirs]):
            pairs = [(k, own.index(value)) for k, value in enumerate(theirs) if value in own]
            other = other.isel({name: [k for k, _ in pairs]}).assign_coords({name: data[name].to_numpy()[[place for _, place in pairs]]})
        if not set(other[name].to_numpy()) & set(data[name].to_numpy()):
            one, another = (", ".join(map(str, values)) for values in (own or data[name].to_numpy(), theirs or other[name].to_numpy()))
            raise ValueError(f"the maps have no point in common: {name} is {one} in the one and {another} in the other")
    return other


def _add(result: xarray.Dataset, name: str, maps: Sequence[xarray.Dataset]) -> None:
    axes = [str(axis) for axis in maps[0][name].dims]
    common = {axis: [value for value in maps[0][axis].to_numpy() if all(value in own[axis].to_numpy() for own in maps[1:])]
              for axis in axes}
    # By places: a list of truth values would choose as a mask does.
    places = [{axis: [own[axis].to_numpy().tolist().index(value) for value in values] for axis, values in common.items()} for own in maps]
    parts = [own[[name, "cells_per_radius"]].isel(at).transpose(*axes) for own, at in zip(maps, places)]
    values = np.array([part[name].to_numpy() for part in parts])
    cells = np.array([part["cells_per_radius"].to_numpy() for part in parts])
    shape = values.shape[1:]
    share, kinds = np.full(shape, np.nan), np.zeros(shape, np.int8)
    absolute = np.full(shape, np.nan)
    for index in np.ndindex(shape):
        at = (slice(None), *index)
        estimate = estimated(values[at], cells[at])
        absolute[index], kinds[index] = estimate.uncertainty, KINDS.index(estimate.kind)
        if values[(0, *index)] != 0.0:
            share[index] = abs(estimate.uncertainty / values[(0, *index)])
    whole = _spread_out(result, common, axes, share)
    uncertainty: xarray.DataArray = abs(result[name].transpose(*axes)) * whole
    flags = xarray.zeros_like(uncertainty, dtype=np.int8)
    uncertainty[places[0]] = absolute
    flags[places[0]] = kinds
    label = result[name].attrs.get("long_name", name)
    uncertainty.attrs = {"units": result[name].attrs.get("units", "1"), "long_name": f"uncertainty of {label}, by other grids"}
    flags.attrs = {"flag_values": np.arange(len(KINDS), dtype=np.int8), "flag_meanings": " ".join(kind.replace("-", "_") for kind in KINDS),
                   "long_name": f"what {label} does on finer grids"}
    result[f"{name}_uncertainty"], result[f"{name}_convergence"] = uncertainty, flags
    result[name].attrs["ancillary_variables"] = f"{name}_uncertainty {name}_convergence"


def _spread_out(result: xarray.Dataset, common: dict[str, list[Any]], axes: Sequence[str], share: Floats) -> xarray.DataArray:
    """The share at every point of the map, from where it is known."""
    if np.isfinite(share).any():
        share = np.where(np.isfinite(share), share, np.nanmax(share))
    for number, axis in enumerate(axes):
        wanted, have = result[axis].to_numpy(), np.array(common[axis])
        if axis in numeric(result):
            order = np.argsort(have.astype(float))
            own = np.moveaxis(share, number, -1)[..., order]
            spread = np.apply_along_axis(lambda row: np.interp(wanted.astype(float), have[order].astype(float), row), -1, own)
            share = np.moveaxis(spread, -1, number)
        else:
            rows = [share.take(list(have).index(value), number) if value in have else share.max(number) for value in wanted]
            share = np.stack(rows, number)
    return xarray.DataArray(share, {axis: result[axis] for axis in axes}, list(axes))


def estimated(values: Sequence[float] | Floats, cells: Sequence[float] | Floats) -> Estimate:
    """The uncertainty of the first of some values, each with its cells per radius: the rules of docs/verification/convergence.md.

    With f₃, f₂, f₁ on cells h₃ > h₂ > h₁ the order solves (f₃ − f₂)/(f₂ − f₁) = (h₃^p − h₂^p)/(h₂^p − h₁^p), whatever the ratios
    (Celik et al., J. Fluids Eng. 130, 078001, 2008); with equal ones r it is ln((f₃ − f₂)/(f₂ − f₁))/ln r. Kept within 0.5 to 2 it
    gives GCI = F |f₂ − f₁|/(r^p − 1), r = h₂/h₁, and on cells h (h/h₁)^p times as much (Roache, J. Fluids Eng. 116, 405, 1994).
    Differences become smaller if they shrink more than those of order 0, of ln h, would.
    """
    own = float(cells[0])
    rows = sorted({(float(cell), float(value)) for cell, value in zip(cells, values) if np.isfinite(value) and np.isfinite(cell)})
    twice = next((cell for (cell, _), (other, _) in itertools.pairwise(rows) if cell == other), None)
    if twice is not None:
        raise ValueError(f"two maps have {twice:g} cells per radius and different values: an uncertainty needs other cells of the fluid, "
                         "too; give both fluid.levels and solid.levels")
    if not np.isfinite(values[0]) or len(rows) < 2:
        return Estimate(float("nan"), "unknown")
    (cell_3, coarse), (cell_2, f2), (cell_1, f1) = ([(float("nan"), float("nan"))] + rows)[-3:]
    fine = f1 - f2
    if len(rows) < 3:
        return Estimate(_of_order(abs(fine), cell_1 / cell_2, 2.0, SAFETY_OF_TWO, cell_1 / own), "two-grids")
    before = f2 - coarse
    small = ROUND_OFF * max(abs(f1), abs(f2), abs(coarse))
    if abs(fine) <= small:
        return Estimate(0.0 if own >= cell_2 else abs(before), "unchanged" if abs(before) <= small else "coincident")
    ratio, ratio_before = cell_1 / cell_2, cell_2 / cell_3
    spread = max(f1, f2, coarse) - min(f1, f2, coarse)
    shrinks = abs(before / fine)
    if shrinks <= _shrinks(0.0, ratio, ratio_before):
        return Estimate(spread, "divergent" if fine * before > 0 else "oscillatory-divergent")
    if fine * before < 0:
        return Estimate(0.5 * spread, "oscillatory")
    order = _order(shrinks, ratio, ratio_before)
    kind = "slow" if shrinks < _shrinks(ORDERS[0] * (1.0 - ROUND_OFF**0.5), ratio, ratio_before) else "monotone"
    return Estimate(_of_order(abs(fine), ratio, order, SAFETY, cell_1 / own), kind)


def _shrinks(order: float, ratio: float, ratio_before: float) -> float:
    """(f₃ − f₂)/(f₂ − f₁) where the error goes like h^p; it grows with p."""
    if order == 0.0:
        return float(np.log(ratio_before) / np.log(ratio))
    return float(ratio**order * (ratio_before**order - 1.0) / (ratio**order - 1.0))


def _order(shrinks: float, ratio: float, ratio_before: float) -> float:
    """The order of which differences shrink so much, within `ORDERS`."""
    low, high = ORDERS
    if shrinks <= _shrinks(low, ratio, ratio_before):
        return low
    if shrinks >= _shrinks(high, ratio, ratio_before):
        return high
    from scipy.optimize import brentq  # Here: it takes longer to import than all else that a sweep needs.

    return float(brentq(lambda order: _shrinks(order, ratio, ratio_before) - shrinks, low, high))


def _of_order(difference: float, ratio: float, order: float, safety: float, coarser: float) -> float:
    return float(safety * difference / (ratio**order - 1.0) * coarser**order)
