"""A run of the paper's figures, and what its lengths and times scale with."""

import sys

import pycav
from pycav.theory import rayleigh_wave_speed

MICRO, MILLI, MEGA = 1e6, 1e3, 1e-6  # µs per s, mm per m, MPa per Pa
RADIUS = 0.01  # m, that the paper's times fit


class Study:
    """A run of two media: `result`, `radius` of the bubble, `wall` (z of it), `slowness` (times over the paper's)."""

    def __init__(self, directory):
        self.result = pycav.open(directory)
        if self.result.media != ["fluid", "solid"]:
            sys.exit(f"{directory} is not the directory of a run of fluid and solid")
        self.radius = self.result.radius or RADIUS
        self.wall = float(self.result.fluid[0].mesh.low[0])
        self.slowness = self.radius / RADIUS
        material = self.result.parameters["solid"]["material"]
        self.c1, self.c2 = material["c1"], material["c2"]

    def rayleigh_wave_speed(self):
        return rayleigh_wave_speed(self.c1, self.c2)

    def time_of(self, microseconds):
        """The snapshot time for a time in the paper, None if there is none within 1 % of the paper's last."""
        wanted = microseconds / MICRO * self.slowness
        found = self.result.fluid.at(wanted).time
        return found if abs(found - wanted) < 0.66 / MICRO * self.slowness else None

    def window(self, window):
        """A window (z from, z to, r up to) in m of one in radii, with z from the wall."""
        low, high, reach = (x * self.radius for x in window)
        return self.wall + low, self.wall + high, reach

    def near_axis(self, mesh):
        """The cells within a tenth of the bubble's radius of the axis."""
        return mesh.centre()[:, 1] < 0.1 * self.radius
