"""A first run: a bubble collapses above steel, and what is left of it.

The paper's case on a coarse, uniform grid: 18 s on two cores.
"""

import pycav
from options import CASES, ask, coarser

options = ask(__doc__)
case = coarser(pycav.Case(CASES / "dickopp2012-coarse.toml"), options.coarser, fluid=6, solid=4)
result = pycav.run(case, options.out / "first-run", force=True, progress=True)

# The numbers one asks for first. They grow with the resolution, so never quote one without it.
print(result.key_numbers.to_string())
print(f"{result.cells_per_radius:.1f} cells per radius")

# Histories are labelled arrays: names, units and times go with the numbers.
data = result.histories
radius = data["bubble/equivalent_radius"]
print(f"smallest equivalent radius {radius.min().item():.3e} {radius.attrs['units']}"
      f" at {radius.idxmin('time').item():.3e} s")

pycav.plot.histories(result, yield_strength=[250e6]).savefig(options.out / "first-run-histories.png")
pycav.plot.schlieren(result, time=50e-6).savefig(options.out / "first-run-schlieren.png")
print(pycav.report(result))
