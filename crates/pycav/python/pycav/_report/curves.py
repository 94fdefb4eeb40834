"""The curves of a run: which there are, in which units, and their rows."""

from __future__ import annotations

import base64
import csv
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ..mesh import Floats
from .._axis import on_axis
from .._numbers import prefix, rounded
from ..plot.surface import DISPLACEMENT, Profile
from ..result import Result

ROWS = 20_000
"""Rows of a curve within the page, at most. Of more rows the extremes are kept."""


@dataclass
class Clock:
    """What curves are given over: times, or radii."""

    name: str
    label: str
    unit: str
    values: Floats
    factor: float
    shown_unit: str
    symbol: str = "t"


@dataclass
class Curve:
    """One curve, in SI units."""

    name: str
    """Of the dataset, or of what is made of it"""
    label: str
    unit: str
    clock: Clock
    values: Floats


@dataclass
class Chart:
    """Curves of one unit in one frame."""

    title: str
    unit: str
    """SI"""
    curves: list[Curve]
    levels: list[tuple[float, str]] = field(default_factory=list)
    """Horizontal lines: value, label"""
    factor: float = 1.0
    """From SI to the unit that is shown"""
    shown_unit: str = ""

    def __post_init__(self) -> None:
        largest = max((float(np.nanmax(np.abs(curve.values), initial=0.0)) for curve in self.curves), default=0.0)
        if self.shown_unit == "%":
            self.factor = 100.0
        elif self.unit == "Pa s":
            self.factor, self.shown_unit = (1e-3, "kPa s") if largest >= 1e4 else (1.0, "Pa s")
        elif self.unit in ("Pa", "m"):
            self.factor, letter = (1e-6, "M") if self.unit == "Pa" and largest >= 1e6 else prefix(largest)
            self.shown_unit = f"{letter}{self.unit}"
        else:
            self.shown_unit = self.unit


def charts(result: Result) -> list[Chart]:
    """The charts of a run; those alone that have a curve."""
    clocks = _clocks(result)
    found = [_radius(result, clocks), _wall(result, clocks), _jet(result, clocks), _impulse(result, clocks),
             _stress(result, clocks), _strain(result, clocks), _surface(result, clocks), *_probes(result)]
    return [chart for chart in found if any(len(curve.values) > 1 for curve in chart.curves)]


def profile(result: Result) -> list[Chart]:
    """The surface that stays, over the radius; none where nothing can stay."""
    try:
        last = Profile.of(result, None)
    except ValueError:
        return []
    factor, letter = prefix(float(last.r[-1]))
    radii = Clock("profile", "radius", "m", last.r, factor, f"{letter}m", "r")
    curve = Curve("surface/height", "height of the surface at the end", "m", radii, -last.depth)
    return [Chart("The wall's surface at the end, above its level far away", "m", [curve])]


def _clocks(result: Result) -> dict[str, Clock]:
    data = result.histories
    end = float(data["time"].to_numpy()[-1])
    factor, letter = prefix(end)
    named = {"time": ("steps", "steps"), "solid/time": ("solid-steps", "steps of the solid"), "interface/time": ("wall", "rows of the wall"),
             "interface/displacement_time": ("surface", "rows of the surface")}
    return {key: Clock(name, label, "s", data[key].to_numpy(), factor, f"{letter}s")
            for key, (name, label) in named.items() if key in data.variables}


def _given(result: Result, clocks: dict[str, Clock], *wanted: tuple[str, str]) -> Iterable[Curve]:
    """Curves that are datasets: path, label."""
    data = result.histories
    for name, label in wanted:
        if name in data and len(data[name].to_numpy()):
            clock = clocks[str(data[name].dims[0])]
            values = data[name].to_numpy()
            if np.isfinite(values).any() and (clock.name != "steps" or len(values) == len(clock.values)):
                yield Curve(name, label, str(data[name].attrs.get("units", "")), clock, values)


def _radius(result: Result, clocks: dict[str, Clock]) -> Chart:
    data = result.histories
    many = sorted(str(name) for name in data.data_vars if str(name).startswith("bubbles/") and str(name).endswith("/equivalent_radius"))
    each = [(name, f"bubble {name.split('/')[1]}") for name in many]
    curves = [curve for curve in _given(result, clocks, *(each or [("bubble/equivalent_radius", "gas" if result.radius is None else "bubble")])) if curve.values.max() > 0]
    return Chart("Equivalent radius", "m", curves)


def _wall(result: Result, clocks: dict[str, Clock]) -> Chart:
    data = result.histories
    # A fluid without a wall at z_min still has cells there, whose pressure says nothing about a wall.
    if "interface/pressure" not in data:
        return Chart("", "Pa", [])
    curves = [*_given(result, clocks, ("wall/pressure_axis", "on the axis"))]
    if not curves:  # a load
        curves = [Curve("interface/pressure", "on the axis", "Pa", clocks["interface/time"], on_axis(data["interface/pressure"]))]
    curves += _mean(result, clocks["interface/time"])
    curves += _given(result, clocks, ("wall/pressure_max", "largest anywhere"))
    return Chart("Pressure on the wall", "Pa", curves)


def _mean(result: Result, clock: Clock) -> Iterable[Curve]:
    """The pressure on the axis over the while before, from the impulse, which has every step: p₀ + (J(t) − J(t − T))/T."""
    window = result.summary.get("wall_pressure_mean_time")
    if window is None or "interface/impulse" not in result.histories:
        return
    impulse, time = on_axis(result.histories["interface/impulse"]), clock.values
    if len(time) < 2 or time[-1] < window:
        return
    rest = float(on_axis(result.histories["interface/pressure"])[0])
    mean = rest + (impulse - np.interp(time - window, time, impulse)) / window
    mean[time < window] = np.nan
    yield Curve("interface/pressure_mean", f"on the axis, mean of {rounded(float(window), 's')}", "Pa", clock, mean)


def _jet(result: Result, clocks: dict[str, Clock]) -> Chart:
    has_bubble = float(result.histories.get("bubble/equivalent_radius", np.zeros(1))[0]) > 0
    axial = result.parameters.get("geometry", "axisymmetric") != "planar"
    where = "towards the wall" if "interface/pressure" in result.histories else "along −z"
    wanted = [("bubble/jet_velocity", where)] if has_bubble and axial else []
    return Chart("Fastest liquid on the axis", "m/s", [*_given(result, clocks, *wanted)])


def _impulse(result: Result, clocks: dict[str, Clock]) -> Chart:
    if "interface/impulse" not in result.histories:
        return Chart("", "Pa s", [])
    impulse = on_axis(result.histories["interface/impulse"])
    return Chart("Impulse on the wall", "Pa s", [Curve("interface/impulse", "on the axis", "Pa s", clocks["interface/time"], impulse)])


def _stress(result: Result, clocks: dict[str, Clock]) -> Chart:
    strength = result.summary.get("yield_strength")
    levels = [] if strength is None else [(float(strength), "yield strength")]
    return Chart("von Mises stress", "Pa", [*_given(result, clocks, ("solid/von_mises_max", "largest in the solid"))], levels)


def _strain(result: Result, clocks: dict[str, Clock]) -> Chart:
    return Chart("Plastic strain", "1", [*_given(result, clocks, ("solid/plastic_strain_max", "largest in the solid"))], shown_unit="%")


def _surface(result: Result, clocks: dict[str, Clock]) -> Chart:
    """How deep the surface is at the axis below its level far away, over time; of a solid that keeps a pit."""
    try:
        Profile.of(result, None)
    except ValueError:
        return Chart("", "m", [])
    rows = result.histories[DISPLACEMENT].to_numpy()
    outer = (np.arange(rows.shape[1]) + 0.5) >= 0.9 * rows.shape[1]
    clock = clocks["interface/displacement_time"] if "interface/displacement_time" in clocks else clocks["interface/time"]
    depth = rows[:, outer].mean(1) - on_axis(result.histories[DISPLACEMENT])
    return Chart("Depth of the surface on the axis", "m", [Curve("surface/depth_axis", "below its level far away", "m", clock, depth)])


def _probes(result: Result) -> Iterable[Chart]:
    """What probes recorded: pressures in the fluid, von Mises stresses in the solid."""
    factor, letter = prefix(float(result.histories["time"].to_numpy()[-1]))
    for quantity, title in (("pressure", "Pressure at probes"), ("von_mises", "von Mises stress at probes")):
        curves = []
        for name, probe in result.probes.items():
            if quantity in probe:
                clock = Clock(f"probe-{name}", f"steps of the probe {name}", "s", probe["time"].to_numpy(), factor, f"{letter}s")
                curves.append(Curve(f"probes/{name}/{quantity}", name, "Pa", clock, probe[quantity].to_numpy()))
        yield Chart(title, "Pa", curves[:6])


def packed(all_charts: Sequence[Chart]) -> dict[str, Any]:
    """Charts for the page: numbers as float64 in base 64, each clock and each curve once."""
    kept = {clock.name: _kept(clock, curves) for clock, curves in _by_clock(all_charts)}
    clocks = {clock.name: {"label": clock.label, "unit": clock.unit, "factor": clock.factor, "shown": clock.shown_unit, "symbol": clock.symbol,
                           "rows": len(clock.values), "data": _coded(clock.values[kept[clock.name]])} for clock, _ in _by_clock(all_charts)}
    return {"clocks": clocks, "charts": [{
        "title": chart.title, "unit": chart.shown_unit, "si": chart.unit, "factor": chart.factor, "levels": chart.levels,
        "curves": [{"name": curve.name, "label": curve.label, "clock": curve.clock.name, "data": _coded(curve.values[kept[curve.clock.name]])}
                   for curve in chart.curves]} for chart in all_charts]}


def _by_clock(all_charts: Sequence[Chart]) -> list[tuple[Clock, list[Curve]]]:
    found: dict[str, tuple[Clock, list[Curve]]] = {}
    for curve in (curve for chart in all_charts for curve in chart.curves):
        found.setdefault(curve.clock.name, (curve.clock, []))[1].append(curve)
    return list(found.values())


def _kept(clock: Clock, curves: Sequence[Curve], rows: int = ROWS) -> Any:
    """Which rows of a clock stay: all, or of each of many stretches those where a curve is smallest and largest."""
    count = len(clock.values)
    if count <= rows:
        return slice(None)
    edges = np.linspace(0, count, max(2, rows // (2 * len(curves))) + 1).astype(int)
    stay = {0, count - 1}
    for curve in curves:
        for first, last in zip(edges[:-1], edges[1:]):
            part = curve.values[first:last]
            if np.isfinite(part).any():
                stay |= {int(first + np.nanargmin(part)), int(first + np.nanargmax(part))}
    return np.array(sorted(stay))


def _coded(values: Floats) -> str:
    return base64.b64encode(np.ascontiguousarray(values, "<f8").tobytes()).decode()


def write_csv(all_charts: Sequence[Chart], directory: Path) -> list[Path]:
    """A file for each clock with all rows of its curves, in SI units with all digits. Returns the files."""
    directory.mkdir(parents=True, exist_ok=True)
    written = []
    for clock, curves in _by_clock(all_charts):
        path = directory / f"{clock.name}.csv"
        with path.open("w", encoding="utf-8", newline="") as file:
            rows = csv.writer(file, lineterminator="\n")
            rows.writerow([f"{clock.symbol} / {clock.unit}", *(f"{curve.name} / {curve.unit}" for curve in curves)])
            table = np.column_stack([clock.values, *(curve.values for curve in curves)])
            rows.writerows([repr(value) if value == value else "" for value in row] for row in table.tolist())
        written.append(path)
    return written
