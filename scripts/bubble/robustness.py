"""Runs past the first collapse and its rebound over the range of pressures, stand-offs, resolutions and walls."""

import itertools

from .runs import box_side, rayleigh_time, run

RADIUS = 1e-3
# Ambient pressure and gas pressure; the gas is air at 293 K.
PRESSURES = [(1e8, 1e5), (1e8, 100.0), (1e7, 1e5), (1e7, 2118.0), (1e6, 1e5), (1e6, 1e3), (1e5, 1e4), (1e5, 2118.0),
             (1e5, 100.0)]
STAND_OFFS = [1.05, 1.5, 2.0, 4.0]
WALLS = ["rigid", "structural-steel"]
FINE_RUNS = 6


def plan():
    """All pressures and stand-offs at 20 cells, walls in turn; a few of them at 40 and 80."""
    cases = list(itertools.product(PRESSURES, STAND_OFFS))
    runs = [(p, d, WALLS[k % 2], 20) for k, (p, d) in enumerate(cases)]
    every = len(cases) // FINE_RUNS
    runs += [(p, d, WALLS[(k + 1) % 2], 40) for k, (p, d) in enumerate(cases[::every])]
    return runs + [((1e7, 2118.0), 1.5, "rigid", 80), ((1e8, 1e5), 1.05, "structural-steel", 80)]


def table(options):
    print("| ambient, gas | d/R | wall | cells per radius | ends | steps | smallest radius | redone, floored "
          "| energy from the floor |\n|---|---|---|---|---|---|---|---|---|")
    failed = total = 0
    for (pressure, gas), stand_off, wall, cells in plan():
        if options.cells and cells not in options.cells:
            continue
        density = gas / (287.05 * 293.15)
        end = 1.6 * rayleigh_time(RADIUS, pressure, gas)
        name = f"robust-{pressure:.0e}-{gas:.0e}-{stand_off}-{wall}-{cells}"
        result, code = run(options, name, pressure=pressure, gas=(density, gas), radius=RADIUS,
                           centre=stand_off * RADIUS, side=box_side(RADIUS), cells=cells, end=end, wall=wall)
        total += 1
        failed += code != 0
        start = f"| {pressure:.0e}, {gas:.0e} Pa | {stand_off} | {wall} | {cells} "
        if code:
            print(start + f"| exit code {code} | | | | |", flush=True)
            continue
        s = result.summary
        fixups, smallest = s["fixups"], s["min_equivalent_radius"]
        print(start + f"| {s['t_end'] * 1e6:.2f} µs | {s['steps']} "
              f"| {smallest / RADIUS if smallest else float('nan'):.4f} R | {fixups['redone']}, {fixups['floored']} "
              f"| {fixups['floor_energy_share']:.1e} |", flush=True)
    print(f"\n{failed} of {total} runs failed.")
