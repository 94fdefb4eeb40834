"""A single bubble in unbounded liquid, waves on a surface: what runs are compared with.

SciPy is imported where it computes: it takes as long as all else that a picture needs, and few need it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import gamma, pi, sqrt

import numpy as np

from .mesh import Floats
from .result import Result

RAYLEIGH_FACTOR = gamma(5 / 6) * sqrt(pi) / gamma(4 / 3) / sqrt(6)
"""Collapse time over R₀ √(ρ/Δp), B(5/6, 1/2)/√6: 0.91468."""


def rayleigh_wave_speed(c1: float, c2: float) -> float:
    """The speed c of waves on a solid's free surface, m/s: (2 − c²/c₂²)² = 4 √(1 − c²/c₁²) √(1 − c²/c₂²).

    - `c1`, `c2`: speeds of dilatational and of shear waves, m/s, c₁ ≥ √2 c₂.
    """
    from scipy.optimize import brentq

    def excess(c: float) -> float:
        left = (2 - (c / c2) ** 2) ** 2
        return float(left - 4 * np.sqrt((1 - (c / c1) ** 2) * (1 - (c / c2) ** 2)))

    return float(brentq(excess, 0.5 * c2, c2))


@dataclass(frozen=True)
class Bubble:
    """A spherical gas bubble in liquid, SI."""

    radius: float
    gas_pressure: float
    gas_exponent: float
    pressure: float
    density: float
    sound_speed: float
    begins_at_rest: bool
    """Whether the liquid begins in the pressure field of Rayleigh's problem instead of a uniform pressure."""
    gas_stiffness: float = 0.0
    """π of the gas"""
    covolume_share: float = 0.0
    """b ρ of the gas at the start: the share of the bubble that its molecules themselves take"""
    surface_tension: float = 0.0
    """N/m"""
    viscosity: float = 0.0
    """Of the liquid, Pa s"""

    @classmethod
    def of(cls, result: Result) -> Bubble | None:
        """The first gas sphere in a run's ambient liquid; `None` if there is none, or if the geometry is planar.

        Under gravity the liquid's pressure is the hydrostatic one at its centre.
        """
        case = result.parameters
        fluid = case.get("fluid", {})
        ambient = fluid.get("ambient", {})
        spheres = [region for region in fluid.get("region", [])
                   if region["shape"] == "sphere" and region["phase"] == "gas"]
        if case.get("geometry") == "planar" or not spheres or ambient.get("phase") == "gas":
            return None
        liquid, gas, bubble, terms = fluid["liquid"], fluid["gas"], spheres[0], fluid.get("terms", {})
        density = ambient["density"]
        free = 1.0 - liquid.get("covolume", 0.0) * density
        far = ambient["pressure"] + density * fluid.get("gravity", 0.0) * (bubble["centre"][0] - fluid["z"][0])
        c = np.sqrt(liquid["gamma"] * (far + liquid["pi"]) / (density * free))
        return cls(bubble["radius"], bubble["pressure"], gas["gamma"], far, density, float(c),
                   fluid.get("initial_pressure") == "rayleigh", gas.get("pi", 0.0), gas.get("covolume", 0.0) * bubble["density"],
                   terms.get("surface_tension", 0.0), terms.get("viscosity", {}).get("liquid", 0.0))

    @property
    def collapse_time(self) -> float:
        """Rayleigh's, 0.915 R₀ √(ρ/Δp) with Δp = p∞ − p_gas, s; NaN where the gas has p∞ or more."""
        driving = self.pressure - self.gas_pressure
        return RAYLEIGH_FACTOR * self.radius * float(np.sqrt(self.density / driving)) if driving > 0 else float("nan")

    def rayleigh(self, points: int = 400) -> tuple[Floats, Floats]:
        """Times in s and radii in m of the collapse at constant Δp in incompressible liquid, to R = 0.

        Rayleigh (1917): t/T = 1 − I(x³; 5/6, 1/2) with x = R/R₀ and the regularised incomplete beta function I.
        """
        from scipy.special import betainc

        x = np.linspace(1.0, 0.0, points)
        return self.collapse_time * (1.0 - betainc(5 / 6, 1 / 2, x**3)), self.radius * x

    def keller_miksis(self, end: float, points: int = 2000) -> tuple[Floats, Floats]:
        """Times in s and radii in m up to `end` by the equation of Keller and Miksis (1980), with surface tension and viscosity.

        The gas goes along its isentrope, (p + π)(V − m b)^γ = const; for an ideal one p R^(3γ) = const. The liquid's pressure on the
        bubble's wall is p = p_gas − 2σ/R − 4μ Ṙ/R.

        Where the liquid begins at a uniform pressure, that on the bubble's wall changes at once; the
        term R ṗ/(ρc) of the equation then starts the wall with Ṙ = (p − p∞)/(ρc).
        """
        from scipy.integrate import solve_ivp

        rho, c, p_inf, taken, stiff = self.density, self.sound_speed, self.pressure, self.covolume_share, self.gas_stiffness
        twice, friction = 2 * self.surface_tension, 4 * self.viscosity
        start = (self.gas_pressure - twice / self.radius - p_inf) / (rho * c + friction / self.radius)

        def rate(_: float, y: Floats) -> list[float]:
            # By the logarithm of R/R₀, which no step makes negative.
            radius, speed = self.radius * np.exp(y[0]), y[1]
            volume = np.exp(3 * y[0])  # over the first one
            stiffened = (self.gas_pressure + stiff) * ((volume - taken) / (1 - taken)) ** -self.gas_exponent
            p = stiffened - stiff - (twice + friction * speed) / radius
            mach = speed / c
            # Of that pressure in time, but for −4μ R̈/R, which is on the left.
            change = (-3 * self.gas_exponent * stiffened * volume / (volume - taken) + (twice + friction * speed) / radius) * speed / radius
            pull = (1 + mach) * (p - p_inf) / rho + radius * change / (rho * c) - 1.5 * (1 - mach / 3) * speed**2
            return [speed / radius, pull / ((1 - mach) * radius + friction / (rho * c))]

        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # trial steps beyond the collapse, which are refused
            found = solve_ivp(rate, (0.0, end), [0.0, 0.0 if self.begins_at_rest else start], "DOP853", np.linspace(0, end, points), rtol=1e-9,
                              atol=[1e-9, 1e-9 * c])
        return np.asarray(found.t), np.asarray(self.radius * np.exp(found.y[0]))
