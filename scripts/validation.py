#!/usr/bin/env python3
"""What others measured and computed on bubbles beside this program's, as docs/verification/validation.md shows it.

    python3 scripts/validation.py near-wall [--cells 40] [--picture docs/images]  collapse time and jet over the stand-off
    python3 scripts/validation.py contact                                          in which collapse the wall is reached
    python3 scripts/validation.py laser                                            jets of bubbles that grow near a wall
    python3 scripts/validation.py shock [--cells 32 64]                            a shock, a bubble, a rigid wall
    python3 scripts/validation.py helium                                           a shock in air meets a cylinder of helium
    python3 scripts/validation.py free [--cells 20 40 80]                          collapse and rebound of a free bubble
    python3 scripts/validation.py one-bar [--cells 10 20 40] [--riemann hllc-lm]   the same by both Riemann solvers, with a covolume
    python3 scripts/validation.py wall-one-bar [--cells 10 20 40 80]               what a rigid wall gets at 1 bar

Runs the cases of cases/validation by `cav` (target/release/cav, or --cav) in a directory of its own (--out), keeps what is complete,
and prints Markdown. Needs scripts/requirements.txt.
"""

from pathlib import Path

from published import contact, free, helium, laser, near_wall, one_bar, shock, wall_one_bar

import program

TABLES = {
    "near-wall": near_wall.table, "contact": contact.table, "laser": laser.table, "shock": shock.table,
    "helium": helium.table, "free": free.table, "one-bar": one_bar.table,
    "wall-one-bar": wall_one_bar.table,
}


def add_options(parser):
    parser.add_argument("--cells", type=int, nargs="+", help="cells per radius")
    parser.add_argument("--stand-offs", type=float, nargs="+", help="of near-wall, contact and laser: d/R")
    parser.add_argument("--euler", type=int, default=200, metavar="CELLS", help="of free and one-bar: cells of gas in one dimension")
    parser.add_argument("--data", type=Path, help="of one-bar: directory of reference-data_emissions of APECSS' rayleighcollapse")
    parser.add_argument("--riemann", nargs="+", help="of one-bar: solvers, hllc and hllc-lm")
    parser.add_argument("--picture", type=Path, help="of near-wall: directory for its pictures")


if __name__ == "__main__":
    program.run_table(__doc__, "validation", TABLES, add_options)
