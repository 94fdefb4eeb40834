"""Two bubbles on the axis, one above the other; the case is built in Python.

The liquid begins in the pressure field that the two have together, so no water hammer starts them.
"""

import pycav
from options import ask, coarser

options = ask(__doc__)
bubble = {"shape": "sphere", "radius": 1e-3, "phase": "gas", "density": 0.12, "pressure": 1e4}
side = {"z": [0.0, 12.8e-3], "r": [0.0, 12.8e-3], "cells": [8, 8]}
case = pycav.Case.from_dict({
    "time": {"end": 40e-6, "snapshot_every": 2e-6},
    "fluid": {
        **side, "levels": 6, "initial_pressure": "rayleigh",
        "liquid": {"gamma": 7.15, "pi": 3e8}, "gas": {"gamma": 1.4},
        "ambient": {"density": 1000.0, "pressure": 1e6},
        "region": [{**bubble, "centre": [2e-3, 0.0]}, {**bubble, "centre": [4.5e-3, 0.0], "radius": 8e-4}],
    },
    "solid": {**side, "z": [-12.8e-3, 0.0], "levels": 6, "material": "aluminium"},
    "coupling": {"scheme": "riemann"},
}, name="two-bubbles")
case = coarser(case, options.coarser, fluid=6, solid=6)
result = pycav.run(case, options.out / "two-bubbles", force=True, progress=True)
for number in (1, 2):
    radius = result.histories[f"bubbles/{number}/equivalent_radius"]
    print(f"bubble {number}: smallest radius {radius.min().item() * 1e6:.0f} µm at "
          f"{radius.idxmin('time').item() * 1e6:.1f} µs")
pycav.plot.streamlines(result, 30e-6, (-4e-3, 8e-3, 5e-3)).savefig(options.out / "two-bubbles.png")
pycav.animate(result, options.out / "two-bubbles.gif", window=(-4e-3, 8e-3, 5e-3), dpi=80)
