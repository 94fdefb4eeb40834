#!/usr/bin/env python3
"""Tables of the bubble's collapse against exact solutions, as docs/verification shows them.

    python3 scripts/bubble_tables.py free [--cells 20 40 80]        a free bubble against the exact radius
    python3 scripts/bubble_tables.py round [--cells 40 80]          how round it stays
    python3 scripts/bubble_tables.py parts                          the same with parts of the method switched off
    python3 scripts/bubble_tables.py wall [--cells 20 40 80]        near a rigid wall
    python3 scripts/bubble_tables.py robustness                     many pressures, stand-offs and resolutions, rigid and steel
    python3 scripts/bubble_tables.py stand-off [--cells 40] [--stand-offs 1.5 2]   collapse time and jet against the stand-off
    python3 scripts/bubble_tables.py sides [--cells 16] [--pressures 1e5 5e7] [--only steel]   near sides against far ones

Runs `cav` (target/release/cav, or --cav) in a directory of its own (--out), with changes of the cases given by --set, and prints
Markdown. Needs scripts/requirements.txt.
"""

from pathlib import Path

import program
from bubble import free, robustness, roundness, sides, stand_off, wall

TABLES = {
    "free": free.table, "round": roundness.table, "parts": free.parts, "wall": wall.table, "robustness": robustness.table,
    "stand-off": stand_off.table, "sides": sides.table,
}


def add_options(parser):
    parser.add_argument("--cells", type=int, nargs="+", help="cells per radius")
    parser.add_argument("--model", default="five-equation", help="of round: the two-phase model")
    parser.add_argument("--stand-offs", type=float, nargs="+", help="of stand-off: d/R")
    parser.add_argument("--pressures", type=float, nargs="+", help="of sides: ambient pressures, Pa")
    parser.add_argument("--only", default="", metavar="TEXT", help="of sides: settings whose name holds this")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a change of every case")
    parser.add_argument("--picture", type=Path, help="of stand-off: draws the curves, too")


if __name__ == "__main__":
    program.run_table(__doc__, "bubble-tables", TABLES, add_options)
