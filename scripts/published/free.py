"""Spherical collapse and rebound beside a Navier-Stokes solution and Gilmore's equation."""

import numpy as np

from .euler import euler
from .runs import run
from .spherical import gilmore

RADIUS, PRESSURE, GAS, DENSITY = 1e-3, 1e5, 1e3, 997.0
# Denner & Schenke (2023), stored with APECSS: smallest radius and its time, largest one after it and its time; R0 and 0.915 R0 √(ρ/Δp).
NAVIER_STOKES = 0.067626, 1.01107, 0.8064, 1.8338
# Their R/R0 on the way, at shares of 0.915 R0 √(ρ/Δp).
ON_THE_WAY = {0.2: 0.983048, 0.4: 0.929863, 0.6: 0.831044, 0.8: 0.658094, 0.9: 0.512490, 0.95: 0.401064, 0.99: 0.253741}
UNIT = 0.915 * RADIUS * np.sqrt(DENSITY / (PRESSURE - GAS))
# m³/kg, and what the gas has at GAS: 1.2 kg/m³ at 1e5 Pa, brought there along its isentrope, on which p (1/ρ − b)^γ stays.
COVOLUME = 1.5e-3
GAS_DENSITY = 1.0 / (COVOLUME + (1.0 / 1.2 - COVOLUME) * (1e5 / GAS) ** (1 / 1.4))
SIDE = 4.8  # of the box from the centre, over the radius


def turn(time, values, k, reach, sign):
    """An extremum near row k by a polynomial through what lies within `reach`: its value and time; sign -1 of a smallest one."""
    near = np.abs(time - time[k]) <= reach
    curve = np.polynomial.Polynomial.fit(time[near], sign * values[near], 4 if near.sum() > 20 else 2)
    fine = np.linspace(time[near][0], time[near][-1], 4001)
    most = int(curve(fine).argmax())
    return sign * curve(fine)[most], fine[most]


def key_numbers(time, radius):
    """Smallest radius, when; largest after it, when; R0 and UNIT. The rebound is flat, so its time needs a fit."""
    time, radius = time / UNIT, radius / RADIUS
    k = int(radius.argmin())
    near = max(abs(time[min(k + 1, len(time) - 1)] - time[k]), abs(time[k] - time[k - 1]))
    smallest = turn(time, radius, k, near * 1.01, -1.0)
    if time[-1] < 1.5:
        return *smallest, np.nan, np.nan
    return *smallest, *turn(time, radius, k + int(radius[k:].argmax()), 0.08, 1.0)


def row(name, found):
    print(f"| {name} | {found[0]:.4f} | {found[1]:.4f} | {found[2]:.4f} | {found[3]:.4f} |", flush=True)


def table(options):
    print("| | smallest R/R₀ | at | rebound R/R₀ | at |\n|---|---|---|---|---|")
    row("Denner & Schenke: Navier–Stokes, covolume", NAVIER_STOKES)
    for name, covolume in (("Gilmore, covolume", COVOLUME * GAS_DENSITY), ("Gilmore, ideal gas", 0.0)):
        row(name, key_numbers(*gilmore(RADIUS, GAS, PRESSURE, DENSITY, 180e-6, covolume=covolume)))
    for name, covolume in (("Euler, covolume", COVOLUME), ("Euler, ideal gas", 0.0)):
        found = euler(RADIUS, GAS, PRESSURE, DENSITY, 180e-6, gas_density=GAS_DENSITY, cells=options.euler, covolume=covolume)
        row(name, key_numbers(*found[:2]))
    farthest = {}
    for cells in options.cells or [20, 40, 80]:
        done = run(options, "free-collapse", f"{cells}", {"fluid.levels": round(np.log2(cells * SIDE / 3))})
        if done:
            row(f"this program, ideal gas, {cells} cells per radius", key_numbers(done.time, done.radius))
            found = np.interp(np.array(list(ON_THE_WAY)) * UNIT, done.time, done.radius / RADIUS)
            farthest[cells] = np.abs(found - list(ON_THE_WAY.values())).max()
    print("\nOn the way, at 0.2 to 0.99 of the collapse, R/R₀ is off by at most "
          + ", ".join(f"{off:.4f} ({cells} cells)" for cells, off in farthest.items()) + ".")
