#!/usr/bin/env python3
"""What the fluid gives on the interface and what the solid gets, over the figures' case with local time steps.

The table is in docs/theory/conservation.md.

    python3 scripts/ledger.py [--levels 5] [--set KEY=VALUE ...] [--keep DIR] [--cav PROGRAM]

Runs cases/dickopp2012-coarse.toml, both grids adaptive, with `time.local_steps = true` and the models one after the other, and
prints impulse and work on both sides, per radian. Ends with 1 if they differ by more than round-off. Needs scripts/requirements.txt.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pycav

import program

MODELS = {"five-equation": "mc", "saurel-abgrall": "minmod"}
# Sums of some 10⁵ means over faces and steps, each of them round-off of its own size.
ROUND_OFF = 1e-12
FLUID, SOLID = "conservation/fluid/", "conservation/solid/"
LINES = [("impulse", "N s", FLUID + "interface_impulse", SOLID + "momentum_in_z_max"),
         ("work", "J", FLUID + "interface_work", SOLID + "energy_in_z_max")]


def run(cav, model, limiter, arguments, directory):
    """The result of a run with a model."""
    out = Path(directory) / model
    local = ["time.local_steps=true", "fluid.adapt=true", "solid.adapt=true", "time.snapshots=[]"]
    grids = [f"fluid.levels={arguments.levels}", f"solid.levels={arguments.levels - 2}"]
    changes = [*local, *grids, f"fluid.model={model}", f"fluid.limiter={limiter}", *arguments.set]
    subprocess.run(program.command(cav, program.ROOT / "cases/dickopp2012-coarse.toml", out, changes), check=True)
    return pycav.open(out)


def rows(result):
    """Name, unit, given, received, largest difference at any time of both sides' histories over what was given in all.

    Both sides write at the same times. What is given in all is the sum of the sizes of what was given between them: in a
    collapse the work changes its sign.
    """
    data = result.histories
    if not np.allclose(data[FLUID + "time"], data[SOLID + "time"], rtol=1e-12, atol=0.0):
        sys.exit(f"{result.directory}: both sides have written their ledgers at different times")
    for name, unit, given, received in LINES:
        one, other = data[given].to_numpy(), -data[received].to_numpy()
        in_all = np.abs(np.diff(one)).sum()
        yield name, unit, one[-1], other[-1], np.abs(one - other).max() / in_all


def main():
    parser = program.parser(__doc__)
    parser.add_argument("--levels", type=int, default=6, help="of the fluid; the solid has two less (6: 51.2 cells per radius)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="changes the case")
    parser.add_argument("--keep", type=Path, metavar="DIR", help="keeps the runs there")
    arguments = parser.parse_args()
    worst = 0.0
    print("| model | of p* | in the fluid's ledger | in the solid's, other sign | difference |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for model, limiter in MODELS.items():
            result = run(arguments.cav, model, limiter, arguments, arguments.keep or scratch)
            for name, unit, given, received, difference in rows(result):
                print(f"| {model} | {name} | {given:.12e} {unit} | {received:.12e} {unit} | {difference:.1e} |", flush=True)
                worst = max(worst, difference)
    sys.exit(1 if worst > ROUND_OFF else 0)


if __name__ == "__main__":
    main()
