#!/usr/bin/env python3
"""Tables of runs against exact solutions of the coupled problem, as docs/verification.md shows them."""

import argparse
from pathlib import Path

from reference import pulse


def try_pulse(options):
    places = pulse.receivers(options.data, options.farthest)
    result = pulse.run(options, options.name, pulse.problem(places, pulse.box_for(options.cells[0], options.size, options.adapt), options.end, limiter=options.limiter))
    for place in places:
        print(place[0], {k: f"{100*v:.2f}" for k, v in pulse.misfits(options, result, place).items()})
    print(result.updates(), result.summary["wall_seconds"], result.summary["cells"])


def main():
    root = Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, nargs="+")
    parser.add_argument("--data", type=Path, default=root.parent / "shared/reference/data")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--cav", type=Path, default=root / "target/release/cav")
    parser.add_argument("--out", type=Path, default=Path("reference-tables"))
    parser.add_argument("--farthest", type=float, default=4e-3)
    parser.add_argument("--size", type=float, default=12e-3)
    parser.add_argument("--end", type=float, default=6e-6)
    parser.add_argument("--limiter", default="")
    parser.add_argument("--name")
    parser.add_argument("--uniform", dest="adapt", action="store_false")
    options = parser.parse_args()
    try_pulse(options)


if __name__ == "__main__":
    main()
