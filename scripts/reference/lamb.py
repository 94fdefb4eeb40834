"""E1 and E2: the solid alone, under a load and with a spherical wave."""

import re

import numpy as np

from .pulse import OURS, STRESSES, VELOCITIES
from .runs import Box, Problem, elastic, run
from .series import misfit, read

LOAD_RADIUS, LOAD, START, RISE = 1e-3, 1e6, 1.65e-6, 3e-7
WAVE_WIDTH, POTENTIAL = 1e-3, 1e-12


def history(kind, end):
    """[t, factor] of the load's two histories, dense enough for straight lines in between."""
    from math import erf

    times = np.linspace(0.0, end, 2001)
    x = (times - START) / RISE
    factors = np.exp(-x * x) if kind == "pulse" else np.array([0.5 * (1.0 + erf(value)) for value in x])
    return "[" + ", ".join(f"[{t:.6e}, {f:.9e}]" for t, f in zip(times, factors)) + "]"


def place_of(stem):
    match = re.search(r"_r(\d+)_z(m?)([\d.]+)mm", stem)
    return float(match[3]) * 1e-3 * (-1 if match[2] else 1), float(match[1]) * 1e-3


def probes(stems, shift=0.0):
    found = []
    for stem in stems:
        z, r = place_of(stem)
        found.append((stem.replace(".", "p"), "solid", z + shift, r))
    return found


def compare(options, result, stems, until=np.inf):
    """Misfits of velocities and stresses, receiver by receiver."""
    for stem in stems:
        exact = read(options.data / f"E/{stem}.csv")
        found = {}
        for label, names in (("v", VELOCITIES), ("σ", STRESSES)):
            # What is zero by symmetry is left out.
            names = [name for name in names if np.max(np.abs(exact[name])) > 1e-9 * np.max(np.abs(exact[names[0]]))]
            times, values = result.probe(stem.replace(".", "p"), *(OURS[name] for name in names), absolute=True)
            found[label] = misfit(times, values, exact["t_s"], [exact[name] for name in names], until)
        yield stem, found


def lamb(options, kind, cells, size=32e-3, end=9e-6, **more):
    """Lamb's problem with the load's radius over `cells`."""
    stems = sorted(path.stem for path in (options.data / "E").glob(f"lamb_steel_{kind}_*.csv"))
    load = f'[coupling.load]\namplitude = {LOAD}\nradius = {LOAD_RADIUS}\nhistory = {history(kind, end)}\n'
    problem = Problem(Box(LOAD_RADIUS / cells, size, 0.0, size, adapt=options.adapt), end,
                      solid=elastic(), coupling='scheme = "load"\n' + load, probes=probes(stems), **more)
    return run(options, f"lamb-{kind}-{cells}{more.get('limiter', '')}{'' if options.adapt else '-uniform'}", problem), stems


def spherical(options, cells, size=9e-3, end=2e-6, **more):
    """The spherical P wave in the middle of a solid twice as deep as wide."""
    stems = sorted(path.stem for path in (options.data / "E").glob("spherical_P_steel_series*.csv"))
    half = Box(WAVE_WIDTH / cells, size, 0.0, size, adapt=options.adapt)
    reach = float(half.coarsest_block() * np.ceil(size / half.coarsest_block() - 1e-9))
    pulse = (f"[[solid.pulse]]\ncentre = [{-reach!r}, 0.0]\nwidth = {WAVE_WIDTH}\namplitude = {POTENTIAL}\n"
             '[solid.boundary]\nz_max = "non-reflecting"\n')
    problem = Problem(Box(half.cell, size, 0.0, 2 * reach, adapt=options.adapt), end, solid=elastic() + pulse,
                      coupling='scheme = "none"\n', probes=probes(stems, -reach), **more)
    return run(options, f"spherical-{cells}{more.get('limiter', '')}{'' if options.adapt else '-uniform'}", problem), stems
