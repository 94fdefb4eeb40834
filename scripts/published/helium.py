"""A Mach 1.22 shock in air meets a cylinder of helium: speeds of its fronts, after Haas & Sturtevant (1987)."""

import numpy as np
from pycav.mesh import Raster

from program import fixed

from .runs import run

AMBIENT, SHOCKED = 101325.0, 159060.0  # Pa
EDGE, SHOCK, SPEED = 0.035, 0.025, 419.68  # m, m, m/s: the cylinder's near edge, the shock at t = 0, its speed
LENGTH, HEIGHT, ROOTS = 0.267, 0.0445, 24
DIAMETER = 144  # cells along it with five levels
# Measured by Haas & Sturtevant (within 10 %), computed by Quirk & Karni (1994).
KNOWN = [("incident shock", 410, 422), ("refracted shock", 900, 943), ("transmitted shock", 393, 377),
         ("upstream interface", 170, 178), ("air jet head", 230, 227), ("downstream interface", 145, 146),
         ("final upstream interface", 113, None)]


def fronts(fluid, along):
    """Against the time since the shock's arrival: shock on the wall, leading front and both interfaces on the axis, last helium.

    `along`: pixels along the tube, one a cell.
    """
    rows = []
    for time in fluid.times:
        snapshot = fluid.at(time)
        raster = Raster(snapshot.mesh, (0.0, LENGTH, 0.0, HEIGHT), along)
        pressure, air = raster.paint(snapshot["pressure"]), raster.paint(snapshot["gas_fraction"])
        helium, z = air < 0.5, raster.z
        axis = np.flatnonzero(helium[0])

        def crossing(outside, inside, axis_air=air[0], z=z):
            share = (axis_air[outside] - 0.5) / (axis_air[outside] - axis_air[inside])
            return z[outside] + (z[inside] - z[outside]) * share

        rows.append([time - (EDGE - SHOCK) / SPEED, last(z, pressure[-1] > 0.5 * (AMBIENT + SHOCKED)),
                     last(z, pressure[0] > 1.02 * AMBIENT),
                     crossing(axis[0] - 1, axis[0]) if len(axis) else np.nan,
                     crossing(axis[-1] + 1, axis[-1]) if len(axis) else np.nan,
                     z[np.flatnonzero(helium.any(axis=0))[0]]])
    return np.array(rows).T


def last(z, where):
    found = np.flatnonzero(where)
    return z[found[-1]] if len(found) else np.nan


def table(options):
    """Straight lines through the places of the fronts, in the windows that CompactLES takes."""
    cells = (options.cells or [DIAMETER])[0]
    levels = 5 + round(np.log2(cells / DIAMETER))
    done = run(options, "shock-and-helium", f"{cells}", {"fluid.levels": levels})
    time, wall, front, upstream, downstream, rear = fronts(done.result.fluid, ROOTS << levels)
    leaves = time[np.flatnonzero((time > 0) & (front > downstream))[0]]
    windows = [(wall, 0.0, 50e-6), (front, 5e-6, leaves - 2e-6), (front, leaves + 10e-6, 250e-6), (upstream, 0.0, 100e-6),
               (upstream, 100e-6, 250e-6), (downstream, leaves + 10e-6, 250e-6), (rear, 600e-6, 1e-3)]
    print("| | Haas & Sturtevant | Quirk & Karni | ours | of measured |\n|---|---|---|---|---|")
    for (name, measured, computed), (place, begin, end) in zip(KNOWN, windows):
        within = (time >= begin) & (time <= end) & np.isfinite(place)
        speed = np.polyfit(time[within], place[within], 1)[0]
        print(f"| {name} | {measured} m/s | {f'{computed} m/s' if computed else ''} | {speed:.0f} m/s "
              f"| {fixed(100 * (speed / measured - 1), '+.0f')} % |")
