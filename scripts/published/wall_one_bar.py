"""What a rigid wall gets of a collapse at 1 bar, on finer and finer grids, with how much the last of them may still be off."""

import numpy as np

from .runs import run

RADIUS, PRESSURE, LEVELS, CELLS = 1e-3, 1e5, 4, 10  # the case has 2^4 times its coarsest cells: 10 per radius
END = 125e-6
GASES = {0.05: {}, 0.02: {"fluid.region.0.pressure": 2e3, "fluid.region.0.density": 0.0734}}
WINDOWS = 0.5e-6, 1e-6  # of the mean pressure, s
AFTER = 10e-6  # of the collapse: until then the impulse counts, s. The jet reaches the wall later.


def measure(done):
    """Peak, means and impulse on the axis, Pa and Pa s; smallest radius over the first; when, s.

    The impulse is that of p - p∞, from its least before the collapse until AFTER it.
    """
    time, radius = done.time, done.radius
    pressure = done.result.histories["wall/pressure_axis"].to_numpy()
    above = pressure - PRESSURE
    impulse = np.append(0.0, np.cumsum(0.5 * (above[1:] + above[:-1]) * np.diff(time)))
    k = int(radius.argmin())
    until = time <= time[k] + AFTER

    def mean(window):
        late = until & (time > window)
        return PRESSURE + np.max(impulse[late] - np.interp(time[late] - window, time, impulse)) / window

    gained = np.interp(time[k] + AFTER, time, impulse) - impulse[:k].min()
    return [pressure[until].max(), *(mean(window) for window in WINDOWS), gained, radius[k] / RADIUS, time[k]]


def uncertainty(values):
    """The last difference over the last value, and the grid-convergence index (Roache 1994) where there is an order."""
    if len(values) < 3:
        return ""
    coarse, middle, fine = values[-3:]
    last = f"{100 * abs(fine / middle - 1):.1f} %"
    if (middle - coarse) * (fine - middle) <= 0:
        return f"{last}; turns"
    order = np.log2(abs((middle - coarse) / (fine - middle)))
    if order <= 0.1:
        return f"{last}; grows"
    return f"{last}; {125 * abs(fine / middle - 1) / (2**order - 1):.1f} %"


def table(options):
    print("| p_gas/p∞ | cells per radius | peak, MPa | mean over 0.5 µs, MPa | over 1 µs, MPa | impulse, Pa s "
          "| smallest R/R₀ | at, µs |\n|---|---|---|---|---|---|---|---|")
    for share, gas in GASES.items():
        found = []
        for cells in options.cells or [10, 20, 40]:
            changes = {"fluid.levels": LEVELS + round(np.log2(cells / CELLS)), "time.end": END, **gas}
            done = run(options, "wall-1bar", f"{share}-{cells}", changes)
            if done:
                found.append(measure(done))
                peak, half, one, impulse, smallest, when = found[-1]
                print(f"| {share} | {cells} | {peak / 1e6:.3f} | {half / 1e6:.3f} | {one / 1e6:.3f} | {impulse:.2f} "
                      f"| {smallest:.4f} | {when * 1e6:.2f} |", flush=True)
        columns = [uncertainty(list(column)) for column in zip(*found)]
        print("| | last difference; GCI | " + " | ".join(columns) + " |", flush=True)
