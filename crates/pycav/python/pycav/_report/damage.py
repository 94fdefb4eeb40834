"""What a run did to its solid, in words and numbers."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

import numpy as np

from .._axis import on_axis
from .._numbers import percent, rounded, si, unit_in
from ..plot.surface import has_pit
from ..result import Result
from .so_far import has_summary, known

Rows = Iterable[tuple[str, str, str]]

LIKE = 0.5
"""Misfit above which a load is not like a Gaussian pulse, whose numbers would then say nothing."""


def damage(result: Result) -> Rows:
    """What the solid bore, and what stays of it: what, value, note."""
    summary, data = known(result), result.histories
    if "solid" in result.media:
        strength = result.yield_strength
        plastic = "plasticity" in result.parameters["solid"]
        yield "yield strength", si(strength, "Pa"), "" if strength else "the material has none"
        yield "largest von Mises stress", si(summary.get("von_mises_peak"), "Pa"), _place(summary, "von_mises_peak")
        if not plastic:
            volume = summary.get("yielded_volume_peak")
            told = si(volume, unit_in(result.parameters, "m³")) if volume else "none"
            yield "yielded volume, largest", told if strength else "–", "the solid is elastic: where it would yield"
            duration = data["solid/time"].to_numpy()[data["solid/yielded_volume"].to_numpy() > 0]
            if strength and len(duration):
                yield "yields from, to", f"{si(duration[0], 's')}, {si(duration[-1], 's')}", "anywhere"
        else:
            yield from _flowed(result, summary)
            yield from _pit(result)
            yield from _load(summary)
    # A single row is that of t = 0.
    if "interface/impulse" in data and len(data["interface/time"]) > 1:
        impulse, until = on_axis(data["interface/impulse"])[-1], float(data["interface/time"][-1])
        yield "impulse on the wall, on the axis", f"{impulse:.4g} Pa s", f"∫ (p* − p at t = 0) dt until {si(until, 's')}"


def _place(summary: dict[str, Any], name: str) -> str:
    place = summary.get(f"{name}_position")
    return "" if place is None else f"at z = {si(place[0], 'm')}, r = {si(place[1], 'm')}"


def _flowed(result: Result, summary: dict[str, Any]) -> Rows:
    """Plastic strain, zone and work."""
    parameters = result.parameters
    strain = summary.get("plastic_strain_peak")
    if strain is None:
        return  # not known yet
    when = f"at {si(summary.get('plastic_strain_peak_time'), 's')}"
    yield "largest plastic strain", f"{100 * strain:.3g} %", ", ".join(filter(None, [_place(summary, "plastic_strain_peak"), when])) if strain else ""
    rate = summary.get("plastic_strain_rate_peak", None if not has_summary(result) else 0.0)
    if rate is not None:
        yield "its fastest growth", f"{float(f'{rate:.3g}'):,.0f} 1/s", "in a step"
    grows = result.histories["solid/time"].to_numpy()[np.diff(result.histories["solid/plastic_work"].to_numpy(), prepend=0.0) > 0]
    if len(grows):
        yield "flows from, to", f"{si(grows[0], 's')}, {si(grows[-1], 's')}", "anywhere"
    if "temperature_peak" in summary:
        yield "highest temperature", f"{summary['temperature_peak']:.4g} K", "of plastic work, without conduction"
    for bound, shown in (("", "0.01 %"), ("_2e-3", "0.2 %")) if has_summary(result) else ():
        depth, radius, volume = (summary.get(f"plastic_{name}{bound}") for name in ("zone_depth", "zone_radius", "volume"))
        content = f"out to r = {rounded(radius, 'm')}; {rounded(volume, unit_in(parameters, 'm³'))} in all"
        yield f"plastic zone, strains above {shown}", f"{rounded(depth, 'm')} deep" if volume else "none", content if volume else ""
    work, given = summary.get("plastic_work"), work_on_solid(result)
    unit = unit_in(parameters, "J")
    share = f"{percent(work / given)} of the work on the solid, {rounded(given, unit)}" if work and given else ""
    yield "plastic work", rounded(work, unit), share


def work_on_solid(result: Result) -> float | None:
    """The whole work done on the solid through its surface until the end, J (planar: J/m); `None` where it is not known."""
    known = result.summary.get("work_on_solid")
    if known is not None:
        return float(known)
    ledger = result.histories.get("conservation/solid/energy_in_z_max")
    if ledger is None or len(ledger) < 2:
        return None
    return float(ledger[-1]) * (1.0 if result.parameters.get("geometry") == "planar" else 2.0 * math.pi)


def _pit(result: Result) -> Rows:
    """The pit, or that there is none."""
    summary, planar = result.summary, result.parameters.get("geometry") == "planar"
    if summary.get("pit_depth") is None:
        return
    if not has_pit(summary):
        yield "pit", "none", f"none deeper than {rounded(summary.get('pit_floor'), 'm')}, or nothing flowed"
        return
    still = summary.get("surface_still")
    moves = "" if still is None else f"at the end, when it still moved by {percent(still)}"
    yield "pit, depth", rounded(summary["pit_depth"], "m"), moves
    radius = summary.get("pit_radius")
    yield "pit, radius at half depth", rounded(radius, "m"), ""
    yield "pit, rim", rounded(summary.get("pit_rim"), "m"), "above the surface far away"
    yield f"pit, {'area' if planar else 'volume'}", rounded(summary.get("pit_volume"), unit_in(result.parameters, "m³")), ""


def _load(summary: dict[str, Any]) -> Rows:
    """The Gaussian pulse that the wall's pressure is nearest to."""
    if summary.get("load_amplitude") is None:
        return
    misfit = float(summary.get("load_misfit", math.nan))
    if not misfit <= LIKE:
        yield ("equivalent load", "none", "no pulse P₀ exp(−(r/Δr)²) exp(−((t − t₀)/Δt)²) is like the wall's pressure: "
               f"of its squares' root the nearest one leaves {percent(misfit)}")
        return
    yield ("equivalent load, P₀", rounded(summary["load_amplitude"], "Pa"),
           "P₀ exp(−(r/Δr)²) exp(−((t − t₀)/Δt)²), the pulse nearest to the wall's pressure; "
           f"misfit {percent(misfit)}")
    yield "equivalent load, Δr", rounded(summary.get("load_radius"), "m"), ""
    yield "equivalent load, Δt", rounded(summary.get("load_duration"), "s"), f"about t₀ = {si(summary.get('load_time'), 's')}"
