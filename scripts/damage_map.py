#!/usr/bin/env python3
"""What collapsing bubbles do to walls: pit, impulse and peak pressure over stand-off, driving pressure and material.

    python3 scripts/damage_map.py [--out DIR] [--workers N] [--quick] [--data FILE.nc] [--picture OUT.png]

Sixty runs of cases/pit-near-steel.toml on half its cells per radius, and twelve of the points on half and on twice as many for the
uncertainty: half an hour, one run after the other. What is complete in DIR is not run again. Prints Markdown, writes the map as NetCDF, draws it.
Needs pycav (scripts/requirements.txt).
"""

import argparse
import math
from pathlib import Path

import numpy as np
import pycav

ROOT = Path(__file__).resolve().parents[1]
MATERIALS = ["al-1100-o", "copper-ofhc", "stainless-316l"]
MAP = {"stand_off": [1.2, 1.4, 1.7, 2.1, 2.6], "fluid.ambient.pressure": [5e6, 10e6, 20e6, 40e6], "solid.material": MATERIALS}
QUICK = {"stand_off": [1.2, 1.7], "fluid.ambient.pressure": [40e6], "solid.material": MATERIALS[-1:]}
REPEATED = {"stand_off": [1.2, 1.7], "fluid.ambient.pressure": [10e6, 40e6], "solid.material": MATERIALS}
GRIDS = {"13": (4, 2), "26": (5, 3), "51": (6, 4)}  # levels of fluid and solid, by cells per radius
COARSER = 2  # levels, of --quick
RADIUS, DENSITY, VAPOUR = 0.01, 1000.0, 2118.0  # m, kg/m3, Pa: of the case
RAYLEIGH_TIMES = 4.0  # two collapses, and the wall has come to rest
DISC = {"name": "disc", "radius": RADIUS / 5, "rise_time": 1e-7}
SURE = ("pit_depth", "wall_impulse", "wall_pressure_peak", "sensors.disc.pressure_peak", "plastic_strain_peak")


def end(point):
    """The end follows the pressure: so many times 0.915 R sqrt(rho/(p - p_v))."""
    rayleigh = 0.915 * RADIUS * math.sqrt(DENSITY / (point["fluid.ambient.pressure"] - VAPOUR))
    return {"time.end": float(f"{RAYLEIGH_TIMES * rayleigh:.4g}")}


def study(options, grid, parameters):
    """The map on one grid."""
    fluid, solid = (max(level - COARSER * options.quick, 0) for level in GRIDS[grid])
    case = pycav.Case(ROOT / "cases/pit-near-steel.toml").with_({
        "fluid.levels": fluid, "solid.levels": solid, "time.snapshots": [], "solid.plasticity": {"law": "johnson-cook"},
        "solid.material": MATERIALS[0], "sensor": [DISC]})
    # Apart, so that a try is not in the way of the map.
    return pycav.sweep(case, parameters, options.out / (grid + "-quick" * options.quick), workers=options.workers, threads=1, change=end)


def small(data):
    """What is worth keeping: no directories of this machine, the precision that the numbers have."""
    kept = data.drop_vars(["directory", "error"])
    for name in [name for name in kept.data_vars if kept[name].dtype == float]:
        kept[name] = kept[name].astype(np.float32, keep_attrs=True)
    return kept.assign_attrs(out="runs/damage-map")


def table(data, parameters):
    """A row for each stand-off and pressure: the load once, then the pit of each material."""
    distances, pressures, materials = parameters.values()
    print("| d/R | p, MPa | peak on the disc, MPa | impulse, kPa s | " + " | ".join(f"pit in {name}, µm" for name in materials) + " |")
    print("|---" * (4 + len(materials)) + "|")
    for distance in distances:
        for pressure in pressures:
            rows = data.sel({"stand_off": distance, "fluid.ambient.pressure": pressure})
            hard = rows.sel({"solid.material": materials[-1]})
            load = [number(hard, "sensors.disc.pressure_peak", 1e-6), number(hard, "wall_impulse", 1e-3)]
            pits = [pit(rows.sel({"solid.material": name})) for name in materials]
            print(f"| {distance:g} | {1e-6 * pressure:g} | " + " | ".join(load + pits) + " |")


def number(point, name, scale):
    """A value and its uncertainty as a share."""
    value, share = float(point[name]), float(point[f"{name}_uncertainty"] / abs(point[name]))
    return f"{plain(value * scale)} ± {100 * share:.0f} %" if share <= 1 else f"{plain(value * scale)} ± > 100 %"


def plain(value):
    return f"{float(f'{value:.3g}'):g}"


def pit(point):
    if not float(point["pit_depth"]) > 0:
        return "none"
    steep = float(point["pit_depth"]) > 0.05 * float(point["pit_radius"])
    moves = float(point["surface_still"]) > 0.1
    return "≈ " * moves + number(point, "pit_depth", 1e6) + " *" * steep


def repeated(maps, parameters):
    """How the numbers of the repeated points change with the grid."""
    print("| material | d/R | p, MPa | " + " | ".join(f"pit, µm, R/h = {grid}" for grid in maps) + " | "
          + " | ".join(f"disc, MPa, R/h = {grid}" for grid in maps) + " |")
    print("|---" * (3 + 2 * len(maps)) + "|")
    distances, pressures, materials = parameters.values()
    for material in materials:
        for distance in distances:
            for pressure in pressures:
                points = [own.sel({"stand_off": distance, "fluid.ambient.pressure": pressure, "solid.material": material}) for own in maps.values()]
                depths = [f"{plain(1e6 * float(point['pit_depth']))}" for point in points]
                peaks = [f"{plain(1e-6 * float(point['sensors.disc.pressure_peak']))}" for point in points]
                print(f"| {material} | {distance:g} | {1e-6 * pressure:g} | " + " | ".join(depths + peaks) + " |")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--out", type=Path, default=Path("runs/damage-map"), help="directory of the runs")
    parser.add_argument("--workers", type=int, default=1, help="runs at a time, each on one thread")
    parser.add_argument("--data", type=Path, default=ROOT / "scripts/data/damage-map.nc", help="file for the map")
    parser.add_argument("--picture", type=Path, metavar="OUT.png", help="picture to write")
    parser.add_argument("--quick", action="store_true", help="two points on cells four times as wide, to try it")
    options = parser.parse_args()
    wanted, again = (QUICK, QUICK) if options.quick else (MAP, REPEATED)
    maps = {grid: study(options, grid, wanted if grid == "26" else again) for grid in ("26", "51", "13")}
    data = pycav.with_uncertainty(maps["26"], maps["51"], maps["13"], quantities=SURE)
    pycav.save_map(small(data), options.data)
    table(data, wanted)
    print()
    repeated({grid: maps[grid] for grid in GRIDS}, again)
    # Time on the clock: on a machine that does other work besides it is more than that of the core.
    hours = sum(float(own["wall_seconds"].sum()) for own in maps.values()) / 3600
    print(f"\n{sum(own['status'].size for own in maps.values())} runs, {60 * hours:.0f} minutes, one after the other")
    if options.picture:
        pycav.plot.damage_map(data, below=["sensors.disc.pressure_peak", "wall_impulse"]).savefig(options.picture, dpi=130)


if __name__ == "__main__":
    main()
