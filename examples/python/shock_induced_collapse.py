"""A pulse of one's own collapses a bubble beside a stone.

The case `lithotripter` with a pulse given by a function of time instead of a table: Church (1989),
p = p₀ + 2 P exp(−αt) cos(ωt + π/3), with a front that rises in 20 ns.
"""

import numpy as np

import pycav
from options import CASES, ask, coarser

options = ask(__doc__)


def pulse(t):
    front = np.clip(t / 20e-9, 0.0, 1.0)
    return 1e5 + front * 2 * 25e6 * np.exp(-9.1e5 * t) * np.cos(2 * np.pi * 83.3e3 * t + np.pi / 3)


case = pycav.Case(CASES / "lithotripter.toml").with_inflow(pulse)
case = coarser(case, options.coarser, fluid=5, solid=4)
result = pycav.run(case, options.out / "lithotripter", force=True, progress=True)
incident = result.probes["incident"]["pressure"]
print(f"incident pulse {incident.max().item() * 1e-6:.1f} MPa")
print(f"wall pressure  {result.summary['wall_pressure_peak'] * 1e-6:.1f} MPa")
pycav.plot.schlieren(result, window=(-4e-4, 5e-4, 4e-4), levels=True).savefig(options.out / "lithotripter.png")
pycav.plot.histories(result, theory=False).savefig(options.out / "lithotripter-histories.png")
