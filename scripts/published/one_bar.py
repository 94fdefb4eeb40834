"""A collapse at 1 bar by both Riemann solvers, beside Euler's equations in one dimension and a Navier-Stokes solution of others."""

import numpy as np

from .euler import euler
from .free import COVOLUME, DENSITY, GAS, GAS_DENSITY, NAVIER_STOKES, ON_THE_WAY, PRESSURE, RADIUS, UNIT, key_numbers
from .runs import run
from .spherical import gilmore

SIDE, ROOT_CELLS = 6.4, 4  # of the box over the radius, and of cases/validation/collapse-1bar.toml
SHARES = np.array(list(ON_THE_WAY))
THEIR_PRESSURE = 129.19e6  # mean over the gas, at its largest, Pa
ABOUT_COLLAPSE = np.linspace(1.009, 1.013, 33)  # when fields are written; a coarse grid's collapse comes later
END = 1.95 * UNIT


def on_the_way(time, radius):
    return np.interp(SHARES * UNIT, time, radius / RADIUS)


def row(name, way, numbers, pressure, exact, cost=""):
    """`way` and what `exact` has on it, R/R0; the largest difference in % of R0."""
    off = 100.0 * np.abs(way - exact).max() if exact is not None else 0.0
    smallest, when, rebound, later = numbers
    again = "" if np.isnan(rebound) else f"{rebound:.4f} at {later:.4f}"
    told = "" if pressure is None else f"{pressure / 1e6:.1f}"
    print(f"| {name} | {off:.2f} | {smallest:.5f} at {when:.5f} | {told} | {again} | {cost} |", flush=True)


def mean_pressure(snapshot):
    """Of the gas, by its volume, Pa."""
    mesh = snapshot.mesh
    gas = snapshot["gas_fraction"] * mesh.width().prod(1) * mesh.centre()[:, 1]
    return float((gas * snapshot["pressure"]).sum() / gas.sum())


def ours(options, solver, cells, exact):
    times = ", ".join(f"{share * UNIT:.9e}" for share in ABOUT_COLLAPSE)
    changes = {"fluid.levels": round(np.log2(cells * SIDE / ROOT_CELLS)), "fluid.riemann": f'"{solver}"',
               "time.snapshots": f"[{times}]"}
    done = run(options, "collapse-1bar", f"{solver}-{cells}", changes)
    if not done:
        return
    summary = done.summary
    cost = (f"{summary['steps']}, {summary['cell_updates']['fluid'] / 1e6:.0f}·10⁶, "
            f"{sum(summary['compute_seconds'].values()):.0f} s")
    # Half a bubble: its ball has the volume of two halves.
    radius = done.radius * 2.0 ** (1.0 / 3.0)
    fluid, numbers, pressure = done.result.fluid, key_numbers(done.time, radius), None
    if ABOUT_COLLAPSE[0] < numbers[1] < ABOUT_COLLAPSE[-1]:
        pressure = max(mean_pressure(fluid.at(share * UNIT)) for share in ABOUT_COLLAPSE)
    row(f"`{solver}`, {cells} cells per radius", on_the_way(done.time, radius), numbers, pressure, exact, cost)


def check(cells):
    """The solver of Euler's equations against another of the same, with a tracked interface: a collapse from uniform pressure."""
    with np.errstate(invalid="ignore"):  # too few cells: the first wave turns one inside out
        time, radius, _ = euler(RADIUS, 1e5, 1e6, 1000.0, 36e-6, gas_density=1.2, cells=cells, reach=80.0, stiffness=3e8, laplace=False)
    k = int(radius.argmin())
    found = f"{radius[k] / RADIUS:.5f} at {time[k] * 1e6:.3f} µs" if np.isfinite(radius[k]) else f"– (more cells than {cells} are needed)"
    print(f"\n10⁵ Pa in 10⁶ Pa: {found}; by a tracked interface 0.28856 at 32.232 µs.")


def their_isentrope(directory):
    """By how much the radius that Denner & Schenke's volume has exceeds the one that their mean pressure has on the gas's isentrope.

    `directory` has NavierStokes_bubbleVolumeRadius and NavierStokes_bubbleAvgPres of APECSS, examples/rayleighcollapse.
    """
    time, _, radius = np.loadtxt(directory / "NavierStokes_bubbleVolumeRadius", unpack=True)
    pressure = np.loadtxt(directory / "NavierStokes_bubbleAvgPres", unpack=True)[1]
    share = COVOLUME * GAS_DENSITY
    isentropic = np.cbrt(share + (1.0 - share) * (pressure / GAS) ** (-1 / 1.4))
    k = int(radius.argmin())
    rows = [int(np.searchsorted(time, t * UNIT / RADIUS)) for t in (0.2, 0.6, 0.9, 0.99, 1.05, 1.5, 1.8338)]
    print("\nTheir R/R₀ less the isentrope's: "
          + ", ".join(f"{radius[k] - isentropic[k]:.5f} at {time[k] * RADIUS / UNIT:.4f}" for k in sorted([*rows, k])))


def table(options):
    print("| | on the way, R/R₀ off by, % of R₀ | smallest R/R₀ | mean gas pressure, MPa | rebound | steps, updates, time |")
    print("|---|---|---|---|---|---|")
    ways = {}
    fine = options.euler
    for cells in (fine // 4, fine // 2, fine):
        time, radius, pressure = euler(RADIUS, GAS, PRESSURE, DENSITY, END, gas_density=GAS_DENSITY, cells=cells, covolume=COVOLUME)
        ways[cells] = on_the_way(time, radius)
        row(f"Euler, {cells} cells of gas", ways[cells], key_numbers(time, radius), pressure.max(), None)
    exact = ways[fine] + (ways[fine] - ways[fine // 2]) / 3.0
    row("Denner & Schenke", np.array(list(ON_THE_WAY.values())), NAVIER_STOKES, THEIR_PRESSURE, exact)
    time, radius = gilmore(RADIUS, GAS, PRESSURE, DENSITY, END, covolume=COVOLUME * GAS_DENSITY)
    free = (radius.min() / RADIUS) ** 3 - COVOLUME * GAS_DENSITY
    pressure = GAS * ((1.0 - COVOLUME * GAS_DENSITY) / free) ** 1.4
    row("Gilmore", on_the_way(time, radius), key_numbers(time, radius), pressure, exact)
    for cells in options.cells or [10, 20, 40]:
        for solver in options.riemann or ("hllc", "hllc-lm"):
            ours(options, solver, cells, exact)
    print("\nOn the way Euler's has, extrapolated: " + ", ".join(f"{r:.5f} at {t}" for t, r in zip(SHARES, exact)) + ".")
    check(fine // 2)
    if options.data:
        their_isentrope(options.data)
