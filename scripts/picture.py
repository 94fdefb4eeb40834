#!/usr/bin/env python3
"""A picture of a run: numerical schlieren in the fluid above, von Mises stress in the solid below.

    python3 scripts/picture.py RUN_DIR OUT.png [--time T] [--reach MM]

Shows the snapshot nearest to the time T in seconds; without --time the one nearest to the highest von Mises stress. Both
sides are mirrored about the axis of symmetry. Needs pycav (scripts/requirements.txt), whose `plot.overview` it is.
"""

import argparse
import sys
from pathlib import Path

import pycav


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="directory of the run")
    parser.add_argument("out", type=Path, metavar="OUT.png", help="picture to write; .pdf and .svg work as well")
    parser.add_argument("--time", type=float, metavar="T", help="simulated time in s (default: highest von Mises stress)")
    parser.add_argument("--reach", type=float, metavar="MM", help="show only so many mm about the axis and the wall")
    options = parser.parse_args()
    try:
        figure = pycav.plot.overview(options.run, options.time, options.reach and 1e-3 * options.reach)
    except (FileNotFoundError, KeyError) as error:
        sys.exit(str(error.args[0]))
    figure.savefig(options.out, dpi=220)


if __name__ == "__main__":
    main()
