"""Films: figures of one size and scale, one for each snapshot."""

import numpy as np

from pycav import plot

MICRO, MEGA = 1e-6, 1e6


def _shown(run, begin, end):
    """Times of snapshots in an interval, s."""
    return [float(time) for time in run.fluid.times if begin <= time <= end]


def _wall_pressure(run, time):
    data = run.histories
    return float(np.interp(time, data["time"], data["wall/pressure_axis"]))


def _title(run, time, digits):
    pressure = _wall_pressure(run, time) / MEGA
    return f"$t$ = {time / MICRO:.{digits}f} µs    pressure on the wall, on the axis: {pressure:.0f} MPa"


def collapse(run):
    """Waves and stress, from the start to the rebound."""
    for time in _shown(run, 0, 11.3e-6):
        yield plot.overview(run, time=time, reach=2.5e-3, depth=1.7e-3, strongest={"fluid": 10**7.2, "solid": 80e6},
                            title=_title(run, time, 2))


def pit(run):
    """The surface sinks and the plastic zone grows, from the shock's arrival on."""
    for time in _shown(run, 8.1e-6, 11.3e-6):
        yield plot.pit(run, time=time, reach=2.8e-3, strongest=(13.5e-6, 1.5e-2))


def lithotripter(run):
    """The pulse comes from above, flattens the bubble and drives a jet through it."""
    for time in _shown(run, 0, 1.12e-6):
        yield plot.overview(run, time=time, reach=0.4e-3, depth=0.25e-3, strongest={"fluid": 10**7.9, "solid": 200e6},
                            title=_title(run, time, 2))
