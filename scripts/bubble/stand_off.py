"""Collapse time and jet against the stand-off: a sweep, beside what is known of incompressible liquid."""

from pathlib import Path

import numpy as np

from .runs import box_side, rayleigh_time, run

RADIUS = 1e-3
STAND_OFFS = [1.1, 1.3, 1.5, 2.0, 2.5, 3.0]
FREE = 1e9
# Ambient pressure, gas pressure, start.
SERIES = [(5e7, 2118.0, "uniform"), (1e5, 2118.0, "rayleigh")]
# Stand-off and jet speed over √(Δp/ρ) of incompressible liquid: 130 and 170 m/s at 1e5 Pa (Plesset & Chapman 1971).
PLESSET_CHAPMAN = [(1.0, 13.0), (1.5, 17.0)]


def table(options):
    cells = (options.cells or [40])[0]
    print(f"{cells} cells per radius; T(d)/T(free) beside 1 + 0.205 R/d; jet beside 0.9 √(Δp/ρ)/ζ, ζ = 0.195 (R/d)².\n")
    print("| ambient, start | d/R | collapse time | T(d)/T(free) | 1 + 0.205 R/d | jet | Supponen et al. |\n|---|---|---|---|---|---|---|")
    curves = {}
    for pressure, gas, start in SERIES:
        density = 0.0266 * gas / 2118.0
        scale = rayleigh_time(RADIUS, pressure, gas)
        free = None
        for stand_off in [FREE, *(options.stand_offs or STAND_OFFS)]:
            is_free = stand_off == FREE
            side = box_side(RADIUS)
            result, code = run(options, f"stand-off-{pressure:.0e}-{'free' if is_free else stand_off}-{cells}",
                               pressure=pressure, gas=(density, gas), radius=RADIUS,
                               centre=0.0 if is_free else stand_off * RADIUS, side=side, cells=cells,
                               end=1.5 * scale, start=start, wall="none" if is_free else "rigid")
            if code:
                print(f"| {pressure:.0e} Pa, {start} | {stand_off} | exit code {code} | | | | |", flush=True)
                continue
            time, _ = result.first_minimum()
            if is_free:
                free = time
                print(f"| {pressure:.0e} Pa, {start} | free | {time * 1e6:.3f} µs, {time / scale:.4f} of Rayleigh's | 1 | 1 | | |",
                      flush=True)
                continue
            # The jet is the fastest liquid before it hits the proximal wall: until the collapse.
            jet = np.nanmax(result.jet[result.time <= time])
            curves.setdefault((pressure, start), []).append((stand_off, time / free, jet / np.sqrt((pressure - gas) / 1000)))
            zeta = 0.195 / stand_off**2
            print(f"| {pressure:.0e} Pa, {start} | {stand_off} | {time * 1e6:.3f} µs | {time / free:.4f} "
                  f"| {1 + 0.205 / stand_off:.4f} | {jet:.0f} m/s | {0.9 * np.sqrt((pressure - gas) / 1000) / zeta:.0f} m/s |",
                  flush=True)
    if options.picture:
        picture(curves, options.picture)


def picture(curves, path: Path):
    """Both ratios over the stand-off, with what is known of incompressible liquid."""
    # Not above: the other tables draw nothing.
    from matplotlib.figure import Figure
    from pycav.plot.style import BLUE, GREY, ORANGE, legend

    figure = Figure(figsize=(7.2, 3.0), layout="constrained")
    times, jets = figure.subplots(1, 2)
    known = np.linspace(1.0, 3.1, 100)
    times.plot(known, 1 + 0.205 / known, color=GREY, label="incompressible, 1 + 0.205 R/d")
    beyond = known[known >= 1.5]
    jets.plot(beyond, 0.9 / (0.195 / beyond**2), color=GREY, label="Supponen et al. (2016)")
    jets.plot(*zip(*PLESSET_CHAPMAN), "k+", label="Plesset & Chapman (1971)")
    for ((pressure, start), rows), colour, marker in zip(curves.items(), (ORANGE, BLUE), "os"):
        d, ratio, speed = zip(*rows)
        label = f"{pressure:.0e} Pa, {start}"
        times.plot(d, ratio, marker, color=colour, label=label, markersize=4)
        jets.plot(d, speed, marker, color=colour, label=label, markersize=4)
    times.set(xlabel="stand-off d/R", ylabel="collapse time T(d)/T(free)")
    jets.set(xlabel="stand-off d/R", ylabel="jet / √(Δp/ρ)", ylim=(0, 50))
    for axes in (times, jets):
        legend(axes, fontsize=7, frameon=False)
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(path, dpi=140)
