"""What happens over time: histories and space-time diagrams."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import FuncNorm, Normalize, PowerNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from .._given import number, positive
from ..mesh import Floats
from ..result import Result, open_run
from ..theory import Bubble
from .across import along
from .section import Run
from .._numbers import prefix, si
from .style import BLUE, GREEN, GREY, INK, ORANGE, PINK, WHITE, WIDTH, legend, styled, ticks


@styled
def histories(
    run: Run, *, theory: bool = True, yield_strength: Sequence[float] = (), probes: Sequence[str] = (), place: bool = False
) -> Figure:
    """The bubble's radius, the jet, the pressure on the wall and the largest von Mises stress over time; what the run has of them.

    - `theory`: Rayleigh's and Keller and Miksis's curves beside the radius. They are of the same bubble without a wall, which
      holds a collapse up; Keller and Miksis's with the case's surface tension and viscosity of the liquid.
    - `yield_strength`: lines at these stresses in Pa.
    - `probes`: names of probes that are drawn, too: their von Mises stress in the solid, their pressure in the fluid.
    - `place`: where the largest von Mises stress is, below the wall and off the axis, in a panel of its own.
    """
    result = open_run(run)
    data = result.histories
    has_gas = "bubble/equivalent_radius" in data and float(data["bubble/equivalent_radius"][0]) > 0
    parts: list[tuple[Callable[[Axes], None], float]] = []
    # Around a drop the gas is no bubble, and has no radius of its own.
    if has_gas and result.parameters.get("fluid", {}).get("ambient", {}).get("phase") != "gas":
        parts.append((lambda axes: _radius(result, axes, theory), 1.4))
    if has_gas and result.parameters.get("geometry") != "planar":
        parts.append((lambda axes: _jet(result, axes), 1.0))
    if "interface/pressure" in data or "solid/von_mises_max" in data or probes:
        parts.append((lambda axes: _loads(result, axes, yield_strength, probes), 2.0))
    if place and "solid/von_mises_max" in data:
        parts.append((lambda axes: _place(result, axes), 1.0))
    if not parts:
        raise ValueError("the run has no bubble, no wall and no solid: its histories are in `histories`")
    heights = [height for _, height in parts]
    figure = Figure(figsize=(WIDTH, 1.1 + 1.25 * sum(heights)), layout="constrained")
    all_axes = np.atleast_1d(figure.subplots(len(parts), 1, sharex=True, gridspec_kw={"height_ratios": heights}))
    for (draw, _), axes in zip(parts, all_axes):
        draw(axes)
    end = float(data["time"][-1])
    all_axes[-1].set_xlim(0, end)
    ticks(all_axes[-1].xaxis, end, "$t$", "s")
    return figure


def _radius(result: Result, axes: Axes, theory: bool) -> None:
    data = result.histories
    time, radius = data["time"].to_numpy(), data["bubble/equivalent_radius"].to_numpy()
    bubble = Bubble.of(result) if theory and "bubbles/1/volume" not in data else None
    if bubble is not None and bubble.pressure > bubble.gas_pressure:
        axes.plot(*bubble.rayleigh(), color=GREY, dashes=(5, 2), linewidth=0.8, label="Rayleigh, no wall")
        axes.plot(*bubble.keller_miksis(float(time[-1])), color=ORANGE, linewidth=0.8, label="Keller–Miksis, no wall")
    cells = result.cells_per_radius
    label = "run" if cells is None else f"run, {cells:.3g} cells per radius"
    axes.plot(time, radius, color=BLUE, label=label)
    ticks(axes.yaxis, float(radius.max()), r"$R_\mathrm{eq}$", "m")
    axes.set_ylim(0, None)
    legend(axes, loc="lower left" if radius[-1] > 0.5 * radius[0] else "best")


def _jet(result: Result, axes: Axes) -> None:
    data = result.histories
    time, jet = data["time"].to_numpy(), data["bubble/jet_velocity"].to_numpy()
    axes.plot(time, jet, color=GREEN)
    where = "towards the wall" if "interface/pressure" in data else "along $-z$"
    axes.set_ylabel(f"fastest liquid on the axis\n{where} / (m s$^{{-1}}$)", fontsize=8)
    axes.axhline(0, color=GREY, linewidth=0.5)


def _loads(result: Result, axes: Axes, yield_strength: Sequence[float], probes: Sequence[str]) -> None:
    data = result.histories
    largest = 0.0
    for name, time, colour, label in (
            ("wall/pressure_axis", "time", BLUE, "pressure on the wall, on the axis"),
            ("wall/pressure_max", "time", PINK, "pressure on the wall, largest"),
            ("solid/von_mises_max", "solid/time", ORANGE, "von Mises stress, largest in the solid")):
        # A fluid without a wall at z_min still has cells there, whose pressure says nothing about a wall.
        if name not in data or (name.startswith("wall/") and "interface/pressure" not in data):
            continue
        values = data[name].to_numpy()
        axes.plot(data[time], values, color=colour, label=label, linewidth=0.7 if colour == PINK else 1.0,
                  zorder=1.5 if colour == PINK else 2)
        largest = max(largest, float(np.nanmax(values)))
    for name in probes:
        probe = result.probes[name]
        solid = "von_mises" in probe
        values, what = probe["von_mises" if solid else "pressure"].to_numpy(), "von Mises stress" if solid else "pressure"
        axes.plot(probe["time"], values, color=GREEN if solid else INK, label=f"{what} at {name}")
        largest = max(largest, float(np.nanmax(values)))
    for strength in yield_strength:
        axes.axhline(strength, color=GREY, linewidth=0.6, dashes=(4, 3))
        axes.annotate(f"$Y_0$ = {strength * 1e-6:.0f} MPa", (0.01, strength), xycoords=("axes fraction", "data"), fontsize=7,
                      color="0.35", va="bottom")
        largest = max(largest, strength)
    ticks(axes.yaxis, largest, "stress", "Pa")
    # Above the panel: a peak may be anywhere in it.
    legend(axes, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2, borderaxespad=0.2)


def _place(result: Result, axes: Axes) -> None:
    data = result.histories
    place = data["solid/von_mises_max_position"].to_numpy().copy()
    stress, time = data["solid/von_mises_max"].to_numpy(), data["solid/time"].to_numpy()
    place[stress < 1.05 * stress[0]] = np.nan  # before the first wave every place is as good
    wall = float(result.solid[0].mesh.high[0])
    depth, aside = wall - place[:, 0], place[:, 1]
    axes.plot(time, depth, color=ORANGE, linewidth=0.8, label="below the wall")
    axes.plot(time, aside, color=GREEN, linewidth=0.8, label="off the axis")
    largest = float(np.nanmax([depth, aside], initial=0.0))
    axes.set_ylim(0, 1.4 * largest or None)
    ticks(axes.yaxis, largest, "place of the\nlargest stress", "m")
    legend(axes, ncols=2, loc="upper left")


@styled
def space_time(
    run: Run, what: str = "wall", *, reach: float | None = None, since: float = 0.0, power: float = 1.0
) -> Figure:
    """Space-time diagrams: "wall", the pressure p* on the interface over radius and time (from the histories); "axis", the
    pressure in the fluid and −σ_zz in the solid along the axis (from the snapshots: the more of them, the better).

    - `reach`: how far from the axis or from the wall is shown, m.
    - `since`: the first time that the diagram of the wall shows, s.
    - `power`: of its colours; below 1 it lifts what is weak beside the largest pressure.
    """
    result = open_run(run)
    reach = None if reach is None else positive("reach", reach, "m")
    since, power = number("since", since, "s"), positive("power", power)
    if what == "wall":
        return _wall(result, reach, since, power)
    if what == "axis":
        return _axis(result, reach)
    raise ValueError(f'what is "wall" or "axis", not {what!r}')


def _panel(height: float = 3.4) -> tuple[Figure, Axes]:
    figure = Figure(figsize=(WIDTH, height), layout="constrained")
    return figure, figure.add_subplot()


def _wall(result: Result, reach: float | None, since: float, power: float) -> Figure:
    data = result.histories
    if "interface/pressure" not in data:
        raise ValueError("the run has no wall")
    time, r = data["interface/time"].to_numpy(), data["interface/r"].to_numpy()
    far = float(r[-1]) if reach is None else reach
    shown = r <= far
    late = time >= since
    if not late.any():
        raise ValueError(f"the run ends at {time[-1]:.3g} s, before {since:.3g} s")
    time, pressure = time[late], data["interface/pressure"].to_numpy()[late][:, shown]
    figure, axes = _panel()
    _image(figure, axes, r[shown], time, pressure, "$p^*$", 99.9, power)
    ticks(axes.xaxis, far, "$r$", "m")
    ticks(axes.yaxis, float(time[-1]), "$t$", "s")
    row, column = np.unravel_index(int(np.argmax(pressure)), pressure.shape)
    for colour, width in ((WHITE, 2.6), (INK, 1.0)):  # seen on bright and on dark
        axes.plot(r[shown][column], time[row], marker="+", color=colour, markersize=8, markeredgewidth=width, clip_on=False)
    axes.set_title(f"Pressure on the wall; the largest (+) {si(pressure.max(), 'Pa')}", loc="left", fontsize=9)
    return figure


def _axis(result: Result, reach: float | None) -> Figure:
    series = [(result.snapshots(medium), name, sign) for medium, name, sign in
              (("solid", "stress_zz", -1.0), ("fluid", "pressure", 1.0)) if medium in result.media]
    times = series[0][0].times
    if len(times) < 3:
        raise ValueError("the axis over time needs three snapshots or more")
    wall = float(series[-1][0][0].mesh.low[0]) if "fluid" in result.media else float(series[0][0][0].mesh.high[0])
    low = min(float(snapshots[0].mesh.low[0]) for snapshots, _, _ in series)
    high = max(float(snapshots[0].mesh.high[0]) for snapshots, _, _ in series)
    if reach is not None:
        low, high = max(low, wall - reach), min(high, wall + reach)
    finest = min(float(snapshots[0].mesh.finest[0]) for snapshots, _, _ in series)
    z = np.linspace(low, high, min(1200, round((high - low) / finest)) + 1)
    z = 0.5 * (z[1:] + z[:-1])
    rows = np.full((len(times), len(z)), np.nan)
    for snapshots, name, sign in series:
        for step, snapshot in enumerate(snapshots):
            place, values = along(snapshot, sign * snapshot[name], 0.25 * float(snapshot.mesh.finest[1]), bounded=name == "pressure")
            inside = (z > snapshot.mesh.low[0]) & (z < snapshot.mesh.high[0])
            rows[step, inside] = np.interp(z[inside], place, values)
    figure, axes = _panel()
    _image(figure, axes, z, times, rows, r"$p$, $-\sigma_{zz}$", 99.0)
    axes.axvline(wall, color=INK, linewidth=0.8)
    ticks(axes.xaxis, max(abs(low), abs(high)), "$z$", "m")
    ticks(axes.yaxis, float(times[-1]), "$t$", "s")
    axes.set_title(f"Pressure along the axis, {len(times)} snapshots", loc="left", fontsize=9)
    return figure


def _image(figure: Figure, axes: Axes, x: Floats, time: Floats, values: Floats, symbol: str, share: float,
           power: float = 1.0) -> None:
    """A field over place and time on one scale that `share` per cent of the values are within."""
    top = float(np.nanpercentile(values, share))
    least = float(np.nanpercentile(values, 0.1))
    scale, letter = prefix(max(abs(top), abs(least)))
    tension = least < -0.02 * top
    norm: Normalize = PowerNorm(power, least * scale, top * scale)
    marks = None
    if tension and top > 0:
        norm = _about_zero(least * scale, top * scale, power)
        # Either side has a scale of its own.
        marks = [*MaxNLocator(3).tick_values(least * scale, 0)[:-1], *MaxNLocator(5).tick_values(0, top * scale)]
    drawn = axes.pcolormesh(x, time, values * scale, cmap="RdBu_r" if tension else "inferno", norm=norm,
                            shading="nearest", rasterized=True)
    figure.colorbar(drawn, ax=axes, label=f"{symbol} / {letter}Pa", extend="both", pad=0.02, aspect=30, ticks=marks)


def _about_zero(least: float, top: float, power: float) -> Normalize:
    """Colours from `least` < 0 to `top` > 0 with 0 in their middle; a power below one lifts what is weak on either side."""
    ends = np.array([-least, top])

    def forward(value: Floats) -> Floats:
        return np.asarray(np.sign(value) * (np.abs(value) / np.where(value < 0, *ends)) ** power)

    def inverse(share: Floats) -> Floats:
        return np.asarray(np.sign(share) * np.abs(share) ** (1 / power) * np.where(share < 0, *ends))

    return FuncNorm((forward, inverse), least, top)
