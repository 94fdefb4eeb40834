"""How round a free bubble stays: half of it in front of a plane of symmetry."""

import numpy as np
from pycav.mesh import Raster

from program import fixed

from .free import CASES, RADIUS, exact
from .runs import box_side, run

# Radii at which is looked, in initial ones, as far as the exact bubble has them.
RADII = [0.7, 0.5, 0.3, 0.2, 0.1]
ANGLES = np.radians(np.arange(0.5, 90.0, 1.0))
MOST = 4000  # pixels along a side: one a cell


def when(curve, radius):
    """The time at which the exact radius first falls to a share of the initial one, s."""
    t, r = exact(curve)
    until = int(np.argmin(r))
    return float(np.interp(-radius * RADIUS, -r[: until + 1], t[: until + 1]))


def gas(snapshot, reach):
    """Centres of pixels along z and r, and the gas fraction there, within `reach` of the centre."""
    raster = Raster(snapshot.mesh, (0.0, reach, 0.0, reach), MOST)
    return raster.z, raster.r, raster.paint(snapshot["gas_fraction"]).T


def surface(z, r, fraction):
    """Distances from the centre at which the gas fraction falls through one half, at ANGLES from the axis."""
    h = z[1] - z[0]
    s = np.arange(0.0, z[-1] - h, 0.05 * h)
    found = []
    for angle in ANGLES:
        i, j = [np.clip(part / h - 0.5, 0.0, len(z) - 1.001) for part in (s * np.cos(angle), s * np.sin(angle))]
        a, b = i.astype(int), j.astype(int)
        u, v = i - a, j - b
        along = ((1 - u) * (1 - v) * fraction[a, b] + u * (1 - v) * fraction[a + 1, b]
                 + (1 - u) * v * fraction[a, b + 1] + u * v * fraction[a + 1, b + 1])
        found.append(s[np.flatnonzero(along >= 0.5)[-1]] if (along >= 0.5).any() else np.nan)
    return np.array(found)


def aspect(z, r, fraction):
    """√(2 ⟨z²⟩/⟨r²⟩) over the gas: 1 of a sphere, the ratio of the axes of a spheroid."""
    weight = fraction * r[None, :]
    return float(np.sqrt(2.0 * (weight * z[:, None] ** 2).sum() / (weight * r[None, :] ** 2).sum()))


def table(options):
    """Aspect ratio by the moments of the gas, that of the surface, on the axis over the equator, and its extremes over its mean."""
    print("| bubble | cells per radius | R/R₀ | aspect ratio − 1 | of the surface | nearest and farthest of its mean |")
    print("|---|---|---|---|---|---|")
    for name, pressure, content, _, end, _, smallest, curve in CASES:
        radii = [radius for radius in RADII if radius > smallest]
        times = [when(curve, radius) for radius in radii]
        for cells in options.cells or [40, 80]:
            result, code = run(options, f"round-{name}-{cells}", pressure=pressure, gas=content, radius=RADIUS, centre=0.0,
                               side=box_side(RADIUS), cells=cells, end=times[-1] * 1.001, snapshots=times, model=options.model)
            if code:
                print(f"| {name} | {cells} | exit code {code} | | | |", flush=True)
                continue
            for radius, time in zip(radii, times):
                z, r, fraction = gas(result.result.fluid.at(time), max(1.6 * radius, 4.0 / cells) * RADIUS)
                found = surface(z, r, fraction)
                mean = np.average(found, weights=np.sin(ANGLES))
                low, high = (fixed(100 * (end / mean - 1), "+.1f") for end in (found.min(), found.max()))
                print(f"| {name} | {cells} | {mean / RADIUS:.3f} | {fixed(100 * (aspect(z, r, fraction) - 1), '+.2f')} % "
                      f"| {fixed(100 * (found[0] / found[-1] - 1), '+.1f')} % | {low} %, {high} % |", flush=True)
