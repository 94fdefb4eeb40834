"""A wall of one's own material, and where it would yield.

Acrylic glass by its density, moduli and yield strength; beside it the paper's way of asking, other strengths on the same
elastic stresses, which is right only for materials with the same elasticity.
"""

import pycav
from options import CASES, ask, coarser

options = ask(__doc__)
acrylic = {"name": "acrylic", "density": 1180.0, "young": 5.3e9, "poisson": 0.35, "yield_strength": 80e6}
case = pycav.Case(CASES / "collapse-near-steel.toml").with_({"solid.material": acrylic})
case = coarser(case, options.coarser, fluid=6, solid=6)
print(case.check())
result = pycav.run(case, options.out / "acrylic", force=True, progress=True)
print(f"yielded volume {result.summary['yielded_volume_peak']:.3g} m³ at most")
figure = pycav.plot.yield_function(result, [40e6, 80e6, 120e6], window=(-0.03, 0.0, 0.03))
figure.savefig(options.out / "acrylic-yield.png")
