#!/usr/bin/env python3
"""Depth of the pit over stand-off and material: a small study, its picture and its table.

    python3 scripts/pit_map.py [--out DIR] [--levels FLUID SOLID] [--stand-offs D ...] [--materials NAME ...] [--picture OUT.png]

Takes cases/pit-near-steel.toml on half its cells per radius, with materials of the library and their Johnson-Cook law, and
prints Markdown. What is complete in DIR is not run again. Needs pycav (scripts/requirements.txt).
"""

import argparse
import sys
from pathlib import Path

import pycav

ROOT = Path(__file__).resolve().parents[1]
STAND_OFFS = [1.2, 1.4, 1.6, 1.8, 2.0]
END = 200e-6  # s: the waves have left, at 90e-6 shallow pits cannot be told from them
MATERIALS = ["copper-ofhc", "stainless-316l", "al-6061-t6", "structural-steel", "duplex-2205", "ti-6al-4v"]


def study(options):
    """The sweep, pits in materials that harden, answer to rates and soften as they warm."""
    # The case's own law is that of its steel: replaced as a whole, so that the library's constants count.
    case = pycav.Case(ROOT / "cases/pit-near-steel.toml").with_({
        "solid.plasticity": {"law": "johnson-cook"}, "solid.material": options.materials[0], "time.snapshots": [], "time.end": END,
        "fluid.levels": options.levels[0], "solid.levels": options.levels[1]})
    return pycav.stand_off_map(case, options.stand_offs, options.materials, options.out,
                               progress=lambda point, how: print(*point.values(), how, file=sys.stderr))


def table(data, options):
    """Depths in µm with their radii in mm, and how much of the depth still moves."""
    print("| material | " + " | ".join(f"d/R = {distance:g}" for distance in options.stand_offs) + " |")
    print("|---" * (len(options.stand_offs) + 1) + "|")
    for material in options.materials:
        row = data.sel({"solid.material": material})
        print(f"| {material} | " + " | ".join(field(row.sel(stand_off=distance)) for distance in options.stand_offs) + " |")


def field(point):
    depth, radius, still = (float(point[name]) for name in ("pit_depth", "pit_radius", "surface_still"))
    if not (depth > 0 and float(point["plastic_strain_peak"]) > 0):
        return "none"
    return f"{1e6 * depth:.3g} µm, {1e3 * radius:.2g} mm, {100 * still:.2g} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--out", type=Path, default=ROOT / "runs/pit-map", help="directory of the runs")
    parser.add_argument("--levels", type=int, nargs=2, default=[5, 3], metavar=("FLUID", "SOLID"), help="levels of refinement")
    parser.add_argument("--stand-offs", type=float, nargs="+", default=STAND_OFFS, help="d/R")
    parser.add_argument("--materials", nargs="+", default=MATERIALS, help="names of the library")
    parser.add_argument("--picture", type=Path, metavar="OUT.png", help="picture to write")
    options = parser.parse_args()
    data = study(options)
    table(data, options)
    if options.picture:
        pycav.plot.pit_map(data).savefig(options.picture, dpi=180)


if __name__ == "__main__":
    main()
