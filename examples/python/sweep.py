"""A map over stand-off and material, on all processors.

Stopped half way, it goes on where it was when it is started again.
"""

import os

import pycav
from options import CASES, ask, coarser

options = ask(__doc__)
case = coarser(pycav.Case(CASES / "collapse-near-steel.toml"), options.coarser, fluid=6, solid=6)
case = case.with_({"time.snapshots": []})

# Threads are enough: the interpreter is free while steps are made. One thread for each run wastes nothing.
data = pycav.stand_off_map(
    case, [1.2, 1.6, 2.0, 2.5], ["structural-steel", "aluminium", "copper"], options.out / "map",
    executor="threads", workers=os.cpu_count(), to=options.out / "map.nc")
print(data["wall_pressure_peak"].to_pandas())
pycav.plot.stand_off_map(data).savefig(options.out / "map.png")
