"""A spherical bubble by Gilmore's equation (1952): the liquid's isentrope is that of the program's, the gas is ideal or Noble-Abel."""

import numpy as np
from scipy.integrate import solve_ivp

GAMMA, PI = 7.15, 3.046e8


def gilmore(radius, gas, pressure, density, end, *, gas_gamma=1.4, covolume=0.0, stiffness=PI):
    """Times and radii, s and m, of a bubble that begins at rest with a gas pressure; `covolume` is the share of the first volume
    that the gas's molecules keep for themselves."""
    reference, start = pressure + stiffness, density
    sound = np.sqrt(GAMMA * reference / start)

    def gas_pressure(r, v):
        free = (r / radius) ** 3 - covolume
        p = gas * ((1.0 - covolume) / free) ** gas_gamma
        return p, -gas_gamma * p / free * 3.0 * r**2 * v / radius**3

    def rate(_, y):
        r, v = y
        p, p_t = gas_pressure(r, v)
        share = (p + stiffness) / reference
        enthalpy = GAMMA / (GAMMA - 1.0) * reference / start * (share ** (1.0 - 1.0 / GAMMA) - 1.0)
        c = np.sqrt(sound**2 + (GAMMA - 1.0) * enthalpy)
        enthalpy_t = p_t / (start * share ** (1.0 / GAMMA))
        # R V' (1 - V/c) + 3/2 V² (1 - V/(3c)) = H (1 + V/c) + R H'/c (1 - V/c)
        m = v / c
        return [v, (enthalpy * (1 + m) + r / c * enthalpy_t * (1 - m) - 1.5 * v**2 * (1 - m / 3)) / (r * (1 - m))]

    found = solve_ivp(rate, (0.0, end), [radius, 0.0], method="LSODA", rtol=1e-9, atol=[1e-12 * radius, 1e-9], max_step=end / 400)
    return found.t, found.y[0]
