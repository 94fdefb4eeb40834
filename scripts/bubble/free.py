"""A free bubble: half of it in front of a plane of symmetry, against the exact radius."""

from pathlib import Path

import numpy as np

from program import fixed

from .runs import run

RADIUS = 1e-3
SHIFT = 0.37  # of a cell: so much larger is the bubble of which the interface lies inside cells
# Name, ambient pressure, gas density and pressure, side of the box, end, exact collapse time and smallest radius.
CASES = [
    ("mild", 1e6, (1.2, 1e5), 25.6e-3, 40e-6, 3.22318e-5, 0.288562, "free_bubble_1e6_1e5.csv"),
    ("strong", 5e6, (0.0266, 2118.0), 12.8e-3, 15e-6, 1.267775e-5, 0.0192968, "free_bubble_5e6_2118.csv"),
]
PARTS = [
    ("all of it", {}),
    ("without THINC", {"interface": "none"}),
    ("without the K term", {"model": "allaire"}),
    ("without both", {"model": "allaire", "interface": "none"}),
    ("minmod instead of MC", {"limiter": "minmod"}),
    ("the paper's mixture, MC", {"model": "saurel-abgrall"}),
    ("the paper's mixture, minmod", {"model": "saurel-abgrall", "limiter": "minmod"}),
]
HEAD = ("| bubble | {what} | collapse time | smallest radius / R₀ (exact) | L2 until collapse, after, % of R₀ "
        "| cells redone, floored |\n|---|---|---|---|---|---|")


def exact(name):
    return np.loadtxt(Path(__file__).with_name(name), delimiter=",", skiprows=2, unpack=True)


def measure(options, case, label, what, cells, shift=0.0, **parts):
    name, pressure, gas, side, end, time, smallest, curve = case
    radius = RADIUS * (1.0 + shift / cells)
    scale = radius / RADIUS
    result, code = run(options, f"free-{name}-{label}", pressure=pressure, gas=gas, radius=radius, centre=0.0,
                       side=side, cells=cells / scale, end=end * scale, **parts)
    if code:
        print(f"| {name} | {what} | exit code {code} | | | |", flush=True)
        return
    found, volume = result.first_minimum()
    # Half the bubble is in the box; the history's radius is that of a ball of its volume.
    radii = np.cbrt(2.0 * 0.75 * result.volume / np.pi) / radius
    t, r = exact(curve)
    times = result.time / scale
    until = times <= min(found / scale, time)
    later = (times > max(found / scale, time)) & (times <= t[-1])
    errors = [rms(times[part], radii[part] - np.interp(times[part], t, r / RADIUS)) for part in (until, later)]
    fixups = result.summary["fixups"]
    print(f"| {name} | {what} | {fixed(100 * (found / scale / time - 1), '+.2f')} % "
          f"| {np.cbrt(2.0 * 0.75 * volume / np.pi) / radius:.4f} ({smallest:.4f}) "
          f"| {100 * errors[0]:.2f}, {100 * errors[1]:.2f} | {fixups['redone']}, {fixups['floored']} |", flush=True)


def rms(times, errors):
    """√(∫ e² dt / ∫ dt)."""
    if len(times) < 2:
        return np.nan
    return np.sqrt(np.trapezoid(errors**2, times) / (times[-1] - times[0]))


def table(options):
    """Refinement, with the interface along cell faces and inside cells."""
    print(HEAD.format(what="cells per radius"))
    for case in CASES:
        grids = options.cells or [20, 40, 80]
        for cells in grids:
            measure(options, case, f"{cells}", f"{cells}", cells)
        middle = grids[len(grids) // 2]
        measure(options, case, f"{middle}-shifted", f"{middle + SHIFT:.2f}", middle, shift=SHIFT)


def parts(options):
    """Each part of the method switched off."""
    cells = (options.cells or [40])[0]
    print(HEAD.format(what=f"{cells} cells per radius"))
    for case in CASES:
        for k, (what, settings) in enumerate(PARTS):
            measure(options, case, f"{cells}-part{k}", what, cells, **settings)
