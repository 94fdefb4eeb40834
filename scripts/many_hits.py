"""Does a wall shake down or ratchet? The load of one collapse on the same wall, again and again.

    python scripts/many_hits.py [--hits N] [--stand-offs D ...] [--levels FLUID SOLID] [--out DIR] [--picture PNG]

The bubble of cases/pit-near-steel.toml on half its cells, at two stand-offs; its recorded load goes on the solid alone (`pycav.hits`), of
steel that hardens by 1 GPa and of steel that does not. Prints depth, largest plastic strain and plastic work of some of the hits.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib.pyplot as plt
import xarray

import pycav

CASE = Path(__file__).parents[1] / "cases/pit-near-steel.toml"
STAND_OFFS = [1.25, 1.6]
LAWS = {
    "hardens by 1 GPa": {"law": "linear", "yield_strength": 355e6, "hardening_modulus": 1e9},
    "does not harden": {"law": "perfect", "yield_strength": 355e6},
}
SHOWN = [1, 2, 3, 5, 10, 20, 30]


def study(options: argparse.Namespace) -> dict[tuple[float, str], xarray.Dataset]:
    """The hits by stand-off and law; what is complete in its directory is not run again."""
    found = {}
    hits, out, (fluid, solid) = options.hits, options.out, options.levels
    coarse = {"fluid.levels": fluid, "solid.levels": solid, "time.snapshots": []}
    for stand_off in options.stand_offs:
        case = pycav.Case(CASE).with_({**coarse, "fluid.region.0.centre": [0.01 + stand_off * 0.01, 0.0]})
        load = pycav.hits(case, 1, out / f"{stand_off:g}").attrs["load"]
        for name, law in LAWS.items():
            place = out / f"{stand_off:g}-{law['law']}"
            # Elastic waves need some 100 µs more than the record to leave.
            found[stand_off, name] = pycav.hits(load, hits, place, solid={"plasticity": law}, longest=4e-4)
    return found


def table(found: dict[tuple[float, str], xarray.Dataset]) -> str:
    """As Markdown."""
    lines = ["| d/R | steel | hit | pit, µm | largest plastic strain | plastic work of the hit, J |", "|---|---|---|---|---|---|"]
    for (stand_off, name), data in found.items():
        for hit in (hit for hit in SHOWN if hit <= data.sizes["hit"]):
            row = data.sel(hit=hit)
            lines.append(f"| {stand_off:g} | {name} | {hit} | {1e6 * float(row.pit_depth):.3g} | "
                         f"{float(row.plastic_strain_peak):.4f} | {float(row.plastic_work):.3g} |")
    return "\n".join(lines)


def picture(found: dict[tuple[float, str], xarray.Dataset], path: Path) -> None:
    """Depth, and plastic work of each hit, over the hits."""
    figure, (depth, work) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    stand_offs = sorted({stand_off for stand_off, _ in found})
    for (stand_off, name), data in found.items():
        style = {"color": f"C{stand_offs.index(stand_off)}", "marker": ".", "label": f"d/R = {stand_off:g}, {name}",
                 "linestyle": "-" if name == next(iter(LAWS)) else ":"}
        depth.plot(data.hit, 1e6 * data.pit_depth, **style)
        work.semilogy(data.hit, data.plastic_work, **style)
    depth.set(xlabel="hit", ylabel="depth of the pit, µm")
    work.set(xlabel="hit", ylabel="plastic work of the hit, J")
    for axes in (depth, work):
        axes.xaxis.get_major_locator().set_params(integer=True)
    depth.legend(fontsize=8)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=120)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--hits", type=int, default=30)
    parser.add_argument("--stand-offs", type=float, nargs="+", default=STAND_OFFS, help="d/R")
    parser.add_argument("--levels", type=int, nargs=2, default=[5, 3], metavar=("FLUID", "SOLID"), help="levels of refinement")
    parser.add_argument("--out", type=Path, default=Path("runs/many-hits"))
    parser.add_argument("--picture", type=Path, default=Path("runs/many-hits.png"))
    options = parser.parse_args()
    found = study(options)
    print(table(found))
    picture(found, options.picture)


if __name__ == "__main__":
    main()
