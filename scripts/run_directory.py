"""A run directory, and the scales of its case."""

import re
import sys

import numpy as np

from snapshots import Series

MICRO, MILLI, MEGA = 1e6, 1e3, 1e-6  # µs per s, mm per m, MPa per Pa


class Run:
    """A run directory, and the scales of its case."""

    def __init__(self, path):
        self.path = path
        if not (path / "fluid.vtkhdf").exists() or not (path / "solid.vtkhdf").exists():
            sys.exit(f"{path} does not hold fluid.vtkhdf and solid.vtkhdf: is it the directory of a coupled run?")
        self.fluid, self.solid = Series(path / "fluid.vtkhdf"), Series(path / "solid.vtkhdf")
        case = (path / "case.toml").read_text()
        radius = re.search(r"^radius = (\S+)", case, re.M)
        self.radius = float(radius[1]) if radius else 0.01
        liquid = case[case.index("[fluid.liquid]") :]
        self.gamma, self.pi, self.c1, self.c2 = (
            float(re.search(rf"^{key} = (\S+)", liquid, re.M)[1]) for key in ("gamma", "pi", "c1", "c2"))
        self.wall = float(self.fluid.mesh(0).low[0])
        self.slowness = self.radius / 0.01  # the paper's times fit a radius of 10 mm

    def rayleigh_speed(self):
        """The speed c of waves on the solid's free surface: (2 - c²/c2²)² = 4 √(1 - c²/c1²) √(1 - c²/c2²)."""
        low, high = 0.5 * self.c2, self.c2
        for _ in range(60):
            c = 0.5 * (low + high)
            left = (2 - (c / self.c2) ** 2) ** 2
            right = 4 * np.sqrt((1 - (c / self.c1) ** 2) * (1 - (c / self.c2) ** 2))
            low, high = (c, high) if left < right else (low, c)
        return low

    def time_of(self, microseconds):
        """The snapshot time for a time in the paper, None if there is none within 1 % of the paper's last."""
        wanted = microseconds / MICRO * self.slowness
        found = self.fluid.times[self.fluid.nearest(wanted)]
        return found if abs(found - wanted) < 0.66 / MICRO * self.slowness else None

    def box(self, window):
        low, high, reach = (x * self.radius for x in window)
        return self.wall + low, self.wall + high, 0.0, reach

    def sides(self, time):
        """For each medium: its snapshots and the number of the one at `time`."""
        return [(series, series.nearest(time)) for series in (self.solid, self.fluid)]
