"""A bubble that grows near a wall and collapses: the jets of Lechner et al., and when gas lies on the wall."""

import numpy as np

from .runs import run
from .spherical import gilmore

RADIUS, GAS, PRESSURE, DENSITY = 5e-5, 5e7, 1e5, 998.0
STAND_OFFS = [0.15, 0.3, 0.6]
LEVELS, CELLS = 7, 100  # of cases/validation/laser-bubble.toml, cells per largest radius


def largest():
    """The largest radius without a wall, m, and when."""
    time, radius = gilmore(RADIUS, GAS, PRESSURE, DENSITY, 60e-6)
    k = radius.argmax()
    return radius[k], time[k]


def table(options):
    free, when = largest()
    print(f"Largest radius without a wall {free * 1e6:.0f} µm at {when * 1e6:.1f} µs (Gilmore).\n")
    print("| D* | largest equivalent radius | smallest | jet: fastest liquid before it | its tip | wall, axis |\n|---|---|---|---|---|---|")
    cells = (options.cells or [CELLS])[0]
    for stand_off in options.stand_offs or STAND_OFFS:
        centre = [round(float(stand_off * free), 8), 0.0]
        levels = LEVELS + round(np.log2(cells / CELLS))
        done = run(options, "laser-bubble", f"{stand_off}-{cells}", {"fluid.region.0.centre": centre, "fluid.levels": levels})
        if done is None:
            continue
        most = int(done.radius[: np.searchsorted(done.time, 1.6 * when)].argmax())
        least = most + int(done.radius[most:].argmin())
        row = done.fastest(done.time[most], done.time[least])
        tip = done.tip_speed(row, 0.1 * free)
        wall = done.result.histories["wall/pressure_axis"].to_numpy()
        late = done.time > done.time[most]
        print(f"| {stand_off} | {done.radius[most] / free:.3f} R at {done.time[most] * 1e6:.1f} µs "
              f"| {done.radius[least] / free:.3f} R at {done.time[least] * 1e6:.1f} µs "
              f"| {done.jet[row]:.0f} m/s at {done.time[row] * 1e6:.2f} µs | {tip:.0f} m/s "
              f"| {wall[late].max() / 1e6:.0f} MPa |", flush=True)
