"""A collapse between sides four radii away, against one between sides 32 radii away."""

import numpy as np

from program import fixed

from .runs import rayleigh_time, run

RADIUS = 1e-3
PRESSURES = [1e5, 5e5, 5e6, 5e7]
GAS_SHARE = 0.01  # of the ambient pressure
NEAR, WIDE = 4, 32
CELLS = 16
# Name, centre in radii, wall, start, box about it: bottom and top beyond the sides' distance.
SETTINGS = [
    ("free", 0.0, "none", "rayleigh", {}),
    ("free, box off-centre", 0.0, "none", "rayleigh", {"above": 2}),
    ("free, water hammer", 0.0, "none", "uniform", {}),
    ("two, R and 0.6 R", 0.0, "none", "rayleigh", {"above": 2, "second": (2.5, 0.6)}),
    ("half a bubble on a wall", 0.0, "rigid", "uniform", {}),
    ("d/R = 0.5, rigid", 0.5, "rigid", "uniform", {}),
    ("d/R = 1.5, rigid", 1.5, "rigid", "rayleigh", {}),
    ("d/R = 2, rigid", 2.0, "rigid", "rayleigh", {}),
    ("d/R = 2, steel", 2.0, "structural-steel", "rayleigh", {}),
    ("d/R = 2, steel, water hammer", 2.0, "structural-steel", "uniform", {}),
]


def measure(options, name, pressure, sides, setting, cells):
    """Collapse time and smallest radius, rebound's time and radius, wall pressure; None where there is none."""
    _, centre, wall, start, more = setting
    top = sides * more.get("above", 1) if wall == "none" else int(np.ceil(centre + sides))
    bottom = -sides if wall == "none" else 0
    gas = GAS_SHARE * pressure
    second = more.get("second")
    result, code = run(options, f"sides-{name}-{sides}-{cells}", pressure=pressure, gas=(1.2e-5 * gas, gas), radius=RADIUS,
                       centre=centre * RADIUS, side=sides * RADIUS, cells=cells, wall=wall, start=start, epsilon=3e-4,
                       end=2.1 * rayleigh_time(RADIUS, pressure, gas),
                       box=(bottom * RADIUS, top * RADIUS, sides * RADIUS),
                       second=second and (second[0] * RADIUS, second[1] * RADIUS))
    if code:
        return None
    (collapse, volume), (rebound, largest) = result.first_minimum(), result.rebound()
    peak = result.summary.get("wall_pressure_peak") if wall != "none" else None
    return [collapse, np.cbrt(volume), rebound, np.cbrt(largest), peak]


def table(options):
    cells = (options.cells or [CELLS])[0]
    print(f"{cells} cells per radius; sides {NEAR} radii from the bubble against {WIDE}.\n")
    print("| ambient | | collapse time | smallest radius | time of the rebound | its radius | wall pressure |"
          "\n|---|---|---|---|---|---|---|")
    for pressure in options.pressures or PRESSURES:
        for k, setting in enumerate(SETTINGS):
            if options.only not in setting[0]:
                continue
            near, wide = (measure(options, f"{pressure:.0e}-{k}", pressure, sides, setting, cells)
                          for sides in (NEAR, WIDE))
            if near is None or wide is None:
                print(f"| {pressure:.0e} Pa | {setting[0]} | failed | | | | |", flush=True)
                continue
            off = [f"{fixed(100 * (a / b - 1), '+.2f')} %" if b else "" for a, b in zip(near, wide)]
            print(f"| {pressure:.0e} Pa | {setting[0]} | " + " | ".join(off) + " |", flush=True)
