#!/usr/bin/env python3
"""Tables of the bubble's collapse against exact solutions, as docs/bubble.md shows them.

    python3 scripts/bubble_tables.py free [--cells 20 40 80]        a free bubble against the exact radius
    python3 scripts/bubble_tables.py round [--cells 40 80]          how round it stays
    python3 scripts/bubble_tables.py parts                          the same with parts of the method switched off
    python3 scripts/bubble_tables.py wall [--cells 20 40 80]        near a rigid wall
    python3 scripts/bubble_tables.py robustness                     many pressures, stand-offs and resolutions, rigid and steel
    python3 scripts/bubble_tables.py stand-off [--cells 40]         collapse time and jet against the stand-off
    python3 scripts/bubble_tables.py sides [--cells 16]             near sides against far ones

Runs `cav` (target/release/cav, or --cav) in a directory of its own (--out) and prints Markdown. Needs
scripts/requirements.txt.
"""

import argparse
from pathlib import Path

from bubble import free, robustness, roundness, sides, stand_off, wall

TABLES = {
    "free": free.table,
    "round": roundness.table,
    "parts": free.parts,
    "wall": wall.table,
    "robustness": robustness.table,
    "stand-off": stand_off.table,
    "sides": sides.table,
}


def main():
    root = Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("table", choices=TABLES)
    parser.add_argument("--cells", type=int, nargs="+", help="cells per radius")
    parser.add_argument("--model", default="five-equation", help="of round: the two-phase model")
    parser.add_argument("--cav", type=Path, default=root / "target/release/cav")
    parser.add_argument("--out", type=Path, default=Path("bubble-tables"))
    parser.add_argument("--picture", type=Path, help="of stand-off: draws the curves, too")
    options = parser.parse_args()
    TABLES[options.table](options)


if __name__ == "__main__":
    main()
