"""A collapse at 1 bar by both Riemann solvers, beside a Navier-Stokes solution: radius on the way, smallest one, rebound, cost."""

import numpy as np

from .free import COVOLUME, DENSITY, GAS, NAVIER_STOKES, ON_THE_WAY, PRESSURE, RADIUS, UNIT, extremes
from .runs import run
from .spherical import gilmore

SIDE, ROOT_CELLS = 6.4, 4  # of the box over the radius, and of cases/validation/collapse-1bar.toml
SHARES = np.array(list(ON_THE_WAY))


def off_on_the_way(time, radius):
    """The largest difference to the Navier-Stokes solution, of R0, and where."""
    off = np.interp(SHARES * UNIT, time, radius / RADIUS) - np.array(list(ON_THE_WAY.values()))
    k = int(np.abs(off).argmax())
    return f"{off[k]:+.4f} at {SHARES[k]}"


def row(name, time, radius, cost=""):
    smallest, when, rebound, later = extremes(time, radius)
    print(f"| {name} | {off_on_the_way(time, radius)} | {smallest:.4f} at {when:.4f} | {rebound:.4f} at {later:.4f} | {cost} |", flush=True)


def table(options):
    print("| | on the way, R/R₀ off by | smallest R/R₀ | rebound | steps, updates, processor time |\n|---|---|---|---|---|")
    smallest, when, rebound, later = NAVIER_STOKES
    print(f"| Denner & Schenke | | {smallest:.4f} at {when:.4f} | {rebound:.4f} at {later:.4f} | |")
    row("Gilmore", *gilmore(RADIUS, GAS, PRESSURE, DENSITY, 180e-6, covolume=COVOLUME))
    for cells in options.cells or [10, 20, 40]:
        for solver in ("hllc", "hllc-lm"):
            changes = {"fluid.levels": round(np.log2(cells * SIDE / ROOT_CELLS)), "fluid.riemann": f'"{solver}"'}
            done = run(options, "collapse-1bar", f"{solver}-{cells}", changes)
            if done:
                summary = done.summary
                cost = (f"{summary['steps']}, {summary['cell_updates']['fluid'] / 1e6:.0f}·10⁶, "
                        f"{sum(summary['compute_seconds'].values()):.0f} s")
                # Half a bubble: its ball has the volume of two halves.
                row(f"`{solver}`, {cells} cells per radius", done.time, done.radius * 2.0 ** (1.0 / 3.0), cost)
