"""A spherical bubble by Euler's equations in one dimension: an independent, converged solution of what the program solves.

The scheme has nothing in common with the program's. Cells move with the fluid, so gas and liquid never mix. Velocities are on nodes,
pressures in cells (von Neumann & Richtmyer 1950). In time it is the trapezoidal rule, solved by Newton's method, as sound crosses the
finest cells in a fraction of a step:

    m_i (u_i' - u_i) = -dt A_i (P_i+½ - P_i-½),   P = ½ (p + p'),   A_i = (r² + r r' + r'²) / 3,   r_i' = r_i + ½ dt (u_i + u_i')

A is the mean area swept, so that P dV is what the nodes get. Both media stay on their isentropes (p + π)(v - b)^γ = const, which is
exact as long as no shock forms: at 1 bar the gas is passed by none and the liquid's wave is still smooth when it leaves the bubble. The
liquid begins at rest with Laplace's pressure, or with a uniform one. It reaches so far that nothing comes back from its end within the run.

Second order in time and space. Checked by three grids each, and by the tracked-interface solution of
scripts/bubble/free_bubble_1e6_1e5.csv.
"""

import numpy as np
from scipy.linalg import solve_banded

GAMMA, PI = 7.15, 3.046e8


class Layers:
    """Cells of gas, equal in width, and of liquid, of which the volumes grow geometrically, about a bubble of radius 1."""

    def __init__(self, cells, gas, pressure, density, gas_density, gas_gamma, covolume, reach, stiffness, laplace):
        growth = 4.0 / cells
        least = 1e-4  # of the bubble's volume: what the liquid's first cells are measured by
        span = np.log1p((reach**3 - 1.0) / least)
        inner = np.linspace(0.0, 1.0, cells + 1)
        outer = np.cbrt(1.0 + least * np.expm1(np.linspace(0.0, span, int(np.ceil(span / growth)) + 1)))
        self.radii, self.wall = np.append(inner, outer[1:]), cells
        is_gas = np.arange(len(self.radii) - 1) < cells
        middle = np.append(0.5 * (inner[1:] + inner[:-1]), np.cbrt(0.5 * (outer[1:] ** 3 + outer[:-1] ** 3)))
        lack = (pressure - gas) if laplace else 0.0
        first = np.where(is_gas, gas, pressure - lack / middle)
        at_rest = np.where(is_gas, gas_density, density * ((first + stiffness) / (pressure + stiffness)) ** (1.0 / GAMMA))
        self.gamma, self.pi = np.where(is_gas, gas_gamma, GAMMA), np.where(is_gas, 0.0, stiffness)
        self.covolume = np.where(is_gas, covolume, 0.0)
        self.first, self.free = first + self.pi, 1.0 / at_rest - self.covolume
        self.mass = at_rest * volumes(self.radii)
        self.node_mass = np.zeros(len(self.radii))
        self.node_mass[:-1] += 0.5 * self.mass
        self.node_mass[1:] += 0.5 * self.mass
        self.outside = pressure - lack / reach

    def pressures(self, radii):
        """Pressure of each cell and its derivative by the specific volume."""
        free = volumes(radii) / self.mass - self.covolume
        stiff = self.first * (self.free / free) ** self.gamma
        return stiff - self.pi, -self.gamma * stiff / free


def volumes(radii):
    """Of shells, over 4π."""
    low, high = radii[:-1], radii[1:]
    return (high - low) * (high**2 + high * low + low**2) / 3.0


def advance(layers, radii, speeds, pressures, guess, step):
    """One step; radii, speeds and pressures after it. Ends when Newton's method moves speeds by less than 1e-9 of the largest."""
    n = len(radii) - 1
    half = 0.5 * step
    for _ in range(12):
        later = radii + half * (speeds + guess)
        after, slope = layers.pressures(later)
        mean = np.append(0.5 * (pressures + after), layers.outside)
        area, area_slope = (radii**2 + radii * later + later**2) / 3.0, (radii + 2.0 * later) / 3.0 * half
        low = -0.5 * slope * later[:-1] ** 2 / layers.mass * half
        high = 0.5 * slope * later[1:] ** 2 / layers.mass * half
        rest = layers.node_mass * (guess - speeds)
        rest[1:] += step * area[1:] * np.diff(mean)
        rest[0] = guess[0]
        bands = np.zeros((3, n + 1))
        bands[1] = layers.node_mass
        bands[1, 1:] -= step * area[1:] * high
        bands[1, 1:n] += step * (area[1:n] * low[1:] + area_slope[1:n] * np.diff(mean)[:-1])
        bands[0, 2:] = step * area[1:n] * high[1:]
        bands[2, : n - 1] = -step * area[1:n] * low[:-1]
        bands[2, n - 1] = -step * area[n] * low[-1]
        bands[1, 0] = 1.0
        change = solve_banded((1, 1), bands, -rest, check_finite=False)
        guess = guess + change
        if np.abs(change).max() < 1e-9 * np.abs(guess).max():
            break
    later = radii + half * (speeds + guess)
    return later, guess, layers.pressures(later)[0]


def euler(radius, gas, pressure, density, end, *, gas_density, cells, gas_gamma=1.4, covolume=0.0, reach=300.0, stiffness=PI,
          laplace=True):
    """Times, radii and mean gas pressures, s, m and Pa, of a bubble at rest in Laplace's field, or in uniform pressure.

    `covolume` in m³/kg, `gas_density` in kg/m³, `cells` in the gas; the liquid has between six and seven times as many, and a step
    changes the radius by at most 0.2/cells of it. `reach` is where the liquid ends, in radii; end < reach · radius/c keeps that unfelt.
    """
    layers = Layers(cells, gas, pressure, density, gas_density, gas_gamma, covolume, reach, stiffness, laplace)
    radii, wall = layers.radii, layers.wall
    speeds, pressures, before = np.zeros_like(radii), layers.pressures(radii)[0], None
    unit, share, now, acceleration = np.sqrt(density / (pressure - gas)), 0.2 / cells, 0.0, pressure / density
    step = 1e-5 * share * unit  # grows from there: a uniform pressure sends out a wave at first
    found = [(0.0, 1.0, gas)]
    while now < end / radius:
        last, step = step, share * min(
            radii[wall] / max(abs(speeds[wall]), 1e-30), np.sqrt(radii[wall] / max(abs(acceleration), 1e-30)), 0.1 * unit)
        step = min(step, 1.05 * last)
        guess = speeds if before is None else speeds + (speeds - before) * step / last
        later = advance(layers, radii, speeds, pressures, guess, step)
        acceleration, before = (later[1][wall] - speeds[wall]) / step, speeds
        radii, speeds, pressures = later
        now += step
        shells = volumes(radii[: wall + 1])
        found.append((now, radii[wall], np.sum(pressures[:wall] * shells) / np.sum(shells)))
    time, r, p = np.array(found).T
    return time * radius, r * radius, p
