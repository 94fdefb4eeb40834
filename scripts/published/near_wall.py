"""Collapse time and jet over the stand-off at atmospheric pressure, beside theory, experiments and potential flow."""

import numpy as np
from matplotlib.figure import Figure
from pycav.plot.style import BLUE, GREEN, GREY, ORANGE, legend, styled
from pycav.theory import RAYLEIGH_FACTOR
from scipy.special import beta

from bubble.runs import rayleigh_time
from program import fixed

from .runs import run

RADIUS, PRESSURE, GAS, DENSITY = 1e-3, 1e5, 1e3, 998.0
SCALE = np.sqrt((PRESSURE - GAS) / DENSITY)  # m/s
RAYLEIGH = RAYLEIGH_FACTOR * RADIUS / SCALE  # s
STAND_OFFS = [0.3, 0.6, 0.8, 1.05, 1.2, 1.5, 2.0, 2.5, 3.0]
SIDE = 6.4  # of the box, over the radius
# The share of R/d by which a collapse takes longer, to first order: the image adds R/(2d) to the liquid's inertia, and the
# mean of R/R0 over Rayleigh's collapse is that of these integrals. Rattray's 0.205.
LONGER = beta(7 / 6, 1 / 2) / beta(5 / 6, 1 / 2) / 4.0  # 0.2032
# Plesset & Chapman (1971), recalled: stand-off and m/s, scaled from 1e5 Pa and 1000 kg/m3.
PLESSET_CHAPMAN = {1.0: 13.0, 1.5: 17.0}


def supponen(stand_off):
    """Jet speed over √(Δp/ρ), 0.9/ζ with ζ = 0.195 (R/d)², for ζ < 0.1 (Supponen et al. 2016, recalled)."""
    return 0.9 * stand_off**2 / 0.195


def changes(stand_off, cells):
    """Of cases/validation/near-wall.toml; None is a free bubble."""
    # A little longer than the collapse.
    until = 1.02 * rayleigh_time(RADIUS, PRESSURE, GAS) * (1.05 if stand_off is None else 1.03 + 0.205 / stand_off)
    common = {"time.end": f"{until:.4g}", "fluid.levels": round(np.log2(cells * SIDE / 4))}
    if stand_off is None:
        side = SIDE * RADIUS
        return common | {"fluid.z": [-side, side], "fluid.cells": [8, 4], "fluid.region.0.centre": [0.0, 0.0],
                         "coupling.scheme": "none"}
    return common | {"fluid.region.0.centre": [stand_off * RADIUS, 0.0]}


def measure(options, stand_off, cells):
    """Collapse time, fastest liquid, the tip's speed over the last tenth of a radius, and the radius then; or None."""
    done = run(options, "near-wall", f"{stand_off}-{cells}", changes(stand_off, cells))
    if done is None:
        return None
    time, _ = done.first_minimum()
    row = done.fastest(0.5 * time, time)
    return time, done.jet[row], done.tip_speed(row, 0.1 * RADIUS), done.radius[row] / RADIUS


def table(options):
    cells = (options.cells or [40])[0]
    free, _ = run(options, "near-wall", f"free-{cells}", changes(None, cells)).first_minimum()
    print(f"{cells} cells per radius; the free bubble takes {free * 1e6:.2f} µs, {free / RAYLEIGH:.4f} of Rayleigh's.\n")
    print("| d/R | T(d)/T(free) | 1 + 0.2032 R/d | off | jet: fastest liquid | its tip | radius then | Supponen et al. "
          "| Plesset & Chapman |\n|---|---|---|---|---|---|---|---|---|")
    rows = []
    for stand_off in options.stand_offs or STAND_OFFS:
        found = measure(options, stand_off, cells)
        if found is None:
            continue
        time, jet, tip, radius = found
        ratio, known = time / free, 1 + LONGER / stand_off
        rows.append((stand_off, ratio, jet / SCALE, tip / SCALE))
        theory = f"{known:.4f} | {fixed(100 * (ratio / known - 1), '+.1f')} %" if stand_off > 1.0 else "|"
        law = f"{SCALE * supponen(stand_off):.0f} m/s" if stand_off >= 1.5 else ""
        potential = f"{SCALE * PLESSET_CHAPMAN[stand_off]:.0f} m/s" if stand_off in PLESSET_CHAPMAN else ""
        print(f"| {stand_off} | {ratio:.4f} | {theory} | {jet:.0f} m/s | {tip:.0f} m/s "
              f"| {radius:.3f} R | {law} | {potential} |", flush=True)
    if options.picture:
        picture(np.array(rows), cells, options.picture)


@styled
def picture(rows, cells, directory):
    """Both ratios over the stand-off: validation-prolongation.png and validation-jet.png."""
    known = np.linspace(1.0, 3.1, 200)
    here = f"this program, {cells} cells per radius"
    figure = Figure(figsize=(4.2, 3.0), layout="constrained")
    axes = figure.subplots()
    axes.plot(known, 1 + LONGER / known, color=GREY, label="first order, 1 + 0.203 R/d")
    axes.plot(rows[:, 0], rows[:, 1], "o", color=BLUE, markersize=4, label=here)
    axes.set(xlabel="stand-off d/R", ylabel="collapse time T(d)/T(free)")
    legend(axes)
    figure.savefig(directory / "validation-prolongation.png", dpi=140)

    figure = Figure(figsize=(4.2, 3.0), layout="constrained")
    axes = figure.subplots()
    far = known[known >= 1.5]
    axes.plot(far, supponen(far), color=GREY, label="Supponen et al. (2016), ζ < 0.1")
    axes.plot(list(PLESSET_CHAPMAN), list(PLESSET_CHAPMAN.values()), "+", color=GREEN, label="Plesset & Chapman (1971)")
    axes.plot(rows[:, 0], rows[:, 2], "o", color=BLUE, markersize=4, label=here + ": fastest liquid")
    axes.plot(rows[:, 0], rows[:, 3], "s", color=ORANGE, markersize=3, label="the tip")
    axes.set(xlabel="stand-off d/R", ylabel="jet / √(Δp/ρ)", ylim=(0, 45))
    legend(axes)
    figure.savefig(directory / "validation-jet.png", dpi=140)
