"""Cases of a bubble on the axis, runs of them, and what is read off their histories."""

import numpy as np
import pycav
from pycav.theory import RAYLEIGH_FACTOR

import program

ROOT_CELLS = 32  # cells of the coarsest grid along a side
LIQUID, GAS = {"gamma": 7.15, "pi": 3e8}, {"gamma": 1.4, "pi": 0.0}


class Run:
    """What a run left: its summary, and the gas volume against time."""

    def __init__(self, result):
        self.result, self.summary = result, result.summary
        self.time, self.volume, self.jet = (
            result.histories[name].to_numpy() for name in ("time", "bubble/volume", "bubble/jet_velocity"))

    def rebound(self):
        """Time and volume of the largest volume after the first minimum."""
        collapse, _ = self.first_minimum()
        after = self.time > collapse
        k = np.flatnonzero(after)[np.argmax(self.volume[after])] if after.any() else 0
        return self.time[k], self.volume[k]

    def first_minimum(self):
        """Time and volume of the first minimum of the volume below half the initial one that a rise of 1 % follows."""
        volume, time = self.volume, self.time
        lowest = np.minimum.accumulate(volume)
        risen = np.flatnonzero((volume > 1.01 * lowest) & (lowest < 0.5 * volume[0]))
        if not len(risen):
            return np.nan, np.nan
        k = int(np.argmin(volume[: risen[0]]))
        if k == 0 or k + 1 == len(volume):
            return time[k], volume[k]
        a, b, _ = np.polyfit(time[k - 1 : k + 2] - time[k], volume[k - 1 : k + 2], 2)
        return time[k] - 0.5 * b / a, volume[k]


def case(*, pressure, gas, radius, centre, side, cells, end, model="five-equation", interface=None, limiter="mc",
         epsilon=1e-3, wall="rigid", start="uniform", box=None, second=None, snapshots=()):
    """A case: a gas bubble (density, pressure) about (centre, 0) in liquid of a pressure, in a box of a side that is
    2^n times the radius times 32 over the cells per radius; or in a box (z from, z to, r to) of whole radii, with 2^n cells
    per radius. `second`: centre and radius of another bubble."""
    levels = round(np.log2(side / radius * cells / ROOT_CELLS))
    # Without a wall the bubble is in the middle of a box twice as long.
    low, roots = (-side, 2 * ROOT_CELLS) if wall == "none" else (0.0, ROOT_CELLS)
    z, r, roots = (low, side), side, (roots, ROOT_CELLS)
    if box:
        levels = round(np.log2(cells))
        z, r = box[:2], box[2]
        roots = round((z[1] - z[0]) / radius), round(r / radius)
    is_solid = wall not in ("rigid", "none")
    grid = {"levels": levels, "epsilon": epsilon}
    bubbles = [(centre, radius), *([second] if second else [])]
    return pycav.Case.from_dict({
        "geometry": "axisymmetric",
        "time": {"end": end, "cfl": 0.45, "snapshots": list(snapshots)},
        "fluid": grid | {
            "z": z, "r": (0.0, r), "cells": roots, "model": model, "interface": interface, "limiter": limiter,
            "initial_pressure": None if start == "uniform" else start, "liquid": LIQUID, "gas": GAS,
            "ambient": {"phase": "liquid", "density": 1000.0, "pressure": pressure},
            "region": [{"shape": "sphere", "centre": (place, 0.0), "radius": size, "phase": "gas", "density": gas[0],
                        "pressure": gas[1]} for place, size in bubbles]},
        "solid": grid | {"z": (-r, 0.0), "r": (0.0, r), "cells": (roots[1], roots[1]), "material": wall} if is_solid else None,
        "coupling": {"scheme": "riemann" if is_solid else wall},
    })


def run(options, name, **parameters):
    """Runs a case with the changes of --set unless its directory is already complete; the run and the command's exit code."""
    result, code = program.solve(options, name, case(**parameters).to_toml(), options.set)
    return result and Run(result), code


def box_side(radius):
    """Side of a box about a bubble or above a wall, 6.4 radii: the far field takes it for unbounded liquid."""
    return 6.4 * radius


def rayleigh_time(radius, pressure, gas_pressure):
    """Rayleigh's collapse time of an empty bubble, 0.915 R √(ρ/Δp), s."""
    return RAYLEIGH_FACTOR * radius * np.sqrt(1000.0 / (pressure - gas_pressure))
