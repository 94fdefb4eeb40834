#!/usr/bin/env python3
"""Tables of runs against exact solutions of the coupled problem, as docs/verification/index.md shows them.

    python3 scripts/reference_tables.py plane [--cells 10 20 40]       plane pulses at normal incidence
    python3 scripts/reference_tables.py oblique [--cells 10 20]        plane pulses at oblique incidence
    python3 scripts/reference_tables.py materials [--cells 40]         the same on soft, hard and matched materials
    python3 scripts/reference_tables.py rest                           100,000 steps under 5e7 Pa
    python3 scripts/reference_tables.py pulse [--cells 10 20 40]       a spherical pulse above steel, near receivers
    python3 scripts/reference_tables.py pulse --far [--cells 10 20]    the same, all receivers
    python3 scripts/reference_tables.py arrivals [--cells 20]          head waves of the pulse
    python3 scripts/reference_tables.py bubble [--cells 20]            the pulse and its head waves beside a bubble
    python3 scripts/reference_tables.py grids [--cells 20]             adaptation, cells that do not match, limiters
    python3 scripts/reference_tables.py solid [--cells 10 20 40]       the solid alone: spherical wave, Lamb's problem
    python3 scripts/reference_tables.py pictures [--cells 20]          the pulse's fields against the exact ones

Runs `cav` (target/release/cav, or --cav) in a directory of its own (--out), with changes of the cases given by --set, and
prints Markdown. The exact solutions are CSV files in --data, by default those of
scripts/reference/exact.zip. Needs scripts/requirements.txt.
"""

import program
from reference import lamb, pictures, plane, pulse
from reference.series import EXACT, curves

TABLES = {
    "plane": plane.table, "oblique": plane.oblique, "materials": plane.materials, "rest": plane.rest,
    "pulse": pulse.refinement, "arrivals": pulse.arrivals, "bubble": pulse.beside_bubble, "grids": pulse.grids,
    "solid": lamb.table, "pictures": pictures.draw,
}


def add_options(parser):
    parser.add_argument("--cells", type=int, nargs="+", help="cells per width of the pulse or the load")
    parser.add_argument("--far", action="store_true", help="all receivers, to 16 mm and 16 µs, instead of 2 mm and 3 µs")
    parser.add_argument("--only", default="", metavar="TEXT", help="of grids, materials and rest: rows whose name holds this")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a change of every case")
    parser.add_argument("--data", type=curves, default=str(EXACT), help="directory or archive of the exact solutions")
    parser.add_argument("--threads", type=int, default=1)


if __name__ == "__main__":
    program.run_table(__doc__, "reference-tables", TABLES, add_options)
