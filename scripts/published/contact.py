"""In which collapse a bubble comes to lie on the wall, after Philipp & Lauterborn (1998)."""

import numpy as np
from pycav.mesh import Raster

from .near_wall import RADIUS, RAYLEIGH, SIDE
from .runs import run

STAND_OFFS = [1.2, 1.5, 1.8, 2.2]
CELLS = 20
EVERY = 1e-6  # s, of the snapshots with so many cells


def gaps(result, cells):
    """Times, and how far the nearest gas is from the wall, m."""
    times = np.array(result.fluid.times)
    found = []
    for time in times:
        snapshot = result.fluid.at(time)
        raster = Raster(snapshot.mesh, (0.0, SIDE * RADIUS, 0.0, 2.0 * RADIUS), round(SIDE * cells))
        gas = (raster.paint(snapshot["gas_fraction"]) >= 0.5).any(axis=0)
        found.append(raster.z[np.argmax(gas)] - 0.5 * RADIUS / cells if gas.any() else np.nan)
    return times, np.array(found)


def table(options):
    print("| d/R | nearest until the first collapse | until the second | first, second collapse |\n|---|---|---|---|")
    cells = (options.cells or [CELLS])[0]
    for stand_off in options.stand_offs or STAND_OFFS:
        end = 3.2 * RAYLEIGH
        done = run(options, "near-wall", f"contact-{stand_off}-{cells}", {
            "fluid.region.0.centre": [stand_off * RADIUS, 0.0], "time.end": f"{end:.4g}", "time.snapshot_every": EVERY * CELLS / cells,
            "fluid.levels": round(np.log2(cells * SIDE / 4)), "output.fields": '["gas_fraction"]'})
        if done is None:
            continue
        summary = done.result.summary
        first, second = summary["collapse_time"], summary["second_collapse_time"] or end
        times, nearest = gaps(done.result, cells)
        before, after = times <= first, (times > first) & (times <= second)
        ends = f"{second / RAYLEIGH:.2f}" if summary["second_collapse_time"] else "later"
        print(f"| {stand_off} | {np.nanmin(nearest[before]) / RADIUS:.2f} R | {np.nanmin(nearest[after]) / RADIUS:.2f} R "
              f"| {first / RAYLEIGH:.2f}, {ends} Rayleigh times |", flush=True)
