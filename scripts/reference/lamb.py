"""E1 and E2: the solid alone, under a load and with a spherical wave."""

import re
from math import erf

import numpy as np

from .pulse import OURS, STRESSES, VELOCITIES
from .runs import Box, Problem, elastic, run
from .series import misfit, order, read, stems

LOAD_RADIUS, LOAD, START, RISE = 1e-3, 1e6, 1.65e-6, 3e-7
WAVE_WIDTH, POTENTIAL = 1e-3, 1e-12


def history(kind, end):
    """[t, factor] of the load's two histories, dense enough for straight lines in between."""
    times = np.linspace(0.0, end, 2001)
    x = (times - START) / RISE
    factors = np.exp(-x * x) if kind == "pulse" else np.array([0.5 * (1.0 + erf(value)) for value in x])
    return "[" + ", ".join(f"[{t:.6e}, {f:.9e}]" for t, f in zip(times, factors)) + "]"


def place_of(stem):
    match = re.search(r"_r(\d+)_z(m?)([\d.]+)mm", stem)
    return float(match[3]) * 1e-3 * (-1 if match[2] else 1), float(match[1]) * 1e-3


def probes(chosen, shift=0.0):
    found = []
    for stem in chosen:
        z, r = place_of(stem)
        found.append((stem.replace(".", "p"), "solid", z + shift, r))
    return found


def misfits(options, result, stem, until):
    exact = read(options.data / f"E/{stem}.csv")
    for label, names in (("v", VELOCITIES), ("σ", STRESSES)):
        # What is zero by symmetry is left out.
        names = [name for name in names if np.max(np.abs(exact[name])) > 1e-9 * np.max(np.abs(exact[names[0]]))]
        times, values = result.probe(stem.replace(".", "p"), *(OURS[name] for name in names), absolute=True)
        yield label, misfit(times, values, exact["t_s"], [exact[name] for name in names], until)


def lamb(options, kind, cells, size=32e-3, end=9e-6):
    """Lamb's problem: a load that comes and goes, or comes and stays; the load's radius over `cells`."""
    chosen = [stem for stem in stems(options.data / "E") if stem.startswith(f"lamb_steel_{kind}_")]
    load = f"[coupling.load]\namplitude = {LOAD}\nradius = {LOAD_RADIUS}\nhistory = {history(kind, end)}\n"
    problem = Problem(Box(LOAD_RADIUS / cells, size, 0.0, size), end, solid=elastic(),
                      coupling='scheme = "load"\n' + load, probes=probes(chosen))
    return run(options, f"lamb-{kind}-{cells}", problem), chosen, end


def spherical(options, cells, size=9e-3, end=2e-6):
    """The spherical P wave in the middle of a solid twice as deep as wide."""
    chosen = [stem for stem in stems(options.data / "E") if stem.startswith("spherical_P_steel_series")]
    half = Box(WAVE_WIDTH / cells, size, 0.0, size)
    reach = float(half.coarsest_block() * np.ceil(size / half.coarsest_block() - 1e-9))
    pulse = (f"[[solid.pulse]]\ncentre = [{-reach!r}, 0.0]\nwidth = {WAVE_WIDTH}\namplitude = {POTENTIAL}\n"
             '[solid.boundary]\nz_max = "non-reflecting"\n')
    problem = Problem(Box(half.cell, size, 0.0, 2 * reach), end, solid=elastic() + pulse,
                      coupling='scheme = "none"\n', probes=probes(chosen, -reach))
    return run(options, f"spherical-{cells}", problem), chosen, end


def table(options):
    """Misfits and orders of the solid alone, receiver by receiver."""
    grids = options.cells or [10, 20, 40]
    print("| receiver | quantity | " + " | ".join(f"{cells} cells" for cells in grids) + " | order |")
    print("|---|---|" + "---|" * (len(grids) + 1))
    for solve in (spherical, lambda *a: lamb(a[0], "pulse", a[1]), lambda *a: lamb(a[0], "step", a[1])):
        runs = [solve(options, cells) for cells in grids]
        for stem in runs[0][1]:
            found = [dict(misfits(options, result, stem, end)) for result, _, end in runs]
            for label in found[0]:
                values = [one[label] for one in found]
                orders = ", ".join(f"{order(a, b, n / m):.1f}" for a, b, m, n in zip(values, values[1:], grids, grids[1:]))
                name = stem.replace("_", " ").replace(" steel", "").replace(" series", "")
                print(f"| {name} | {label} | " + " | ".join(f"{100 * v:.2f} %" for v in values) + f" | {orders} |", flush=True)
