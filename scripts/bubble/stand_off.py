"""Collapse time and jet against the stand-off: a sweep, beside what is known of incompressible liquid."""

import numpy as np

from .runs import rayleigh_time, run, wide_enough

RADIUS = 1e-3
STAND_OFFS = [1.1, 1.3, 1.5, 2.0, 2.5, 3.0]
FREE = 1e9
# Ambient pressure, gas pressure, start.
SERIES = [(5e7, 2118.0, "uniform"), (1e5, 2118.0, "rayleigh")]


def table(options):
    cells = (options.cells or [40])[0]
    print(f"{cells} cells per radius; T(d)/T(free) beside 1 + 0.205 R/d; jet beside 0.9 √(Δp/ρ)/ζ, ζ = 0.195 (R/d)².\n")
    print("| ambient, start | d/R | collapse time | T(d)/T(free) | 1 + 0.205 R/d | jet | Supponen et al. |\n|---|---|---|---|---|---|---|")
    for pressure, gas, start in SERIES:
        density = 0.0266 * gas / 2118.0
        scale = rayleigh_time(RADIUS, pressure, gas)
        free = None
        for stand_off in [FREE, *STAND_OFFS]:
            is_free = stand_off == FREE
            side = wide_enough(RADIUS, 1.5 * scale)
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
            zeta = 0.195 / stand_off**2
            print(f"| {pressure:.0e} Pa, {start} | {stand_off} | {time * 1e6:.3f} µs | {time / free:.4f} "
                  f"| {1 + 0.205 / stand_off:.4f} | {jet:.0f} m/s | {0.9 * np.sqrt((pressure - gas) / 1000) / zeta:.0f} m/s |",
                  flush=True)
