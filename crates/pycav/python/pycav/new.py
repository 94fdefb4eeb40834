"""Cases for what is asked most often, as ``cav new`` writes them: SI, with domain, grid and times that follow."""

from __future__ import annotations

from typing import Any, Literal

from . import _pycav
from .case import Case

VAPOUR_PRESSURE = 2340.0
"""Water's at 20 °C, Pa: what a bubble holds at the least."""

UNITS = {"pressure": "Pa", "gas_pressure": "Pa", "amplitude": "Pa", "duration": "s", "radius": "m", "equilibrium_radius": "m",
         "left_radius": "m", "largest_radius": "m"}


def _real(**given: Any) -> None:
    """Checks that arguments are numbers: texts with units are the command line's. What they may be the program says."""
    for name, value in given.items():
        try:
            if not isinstance(value, str):
                float(value)
                continue
        except (TypeError, ValueError):
            pass
        unit = f" in SI units, here {UNITS[name]}" if name in UNITS else ""
        raise TypeError(f"{name} = {value!r} is a {type(value).__name__}: give a number{unit}")


def collapse(
    radius: float = 1e-3,
    pressure: float = 2e7,
    stand_off: float = 1.5,
    wall: str = "al-1100-o",
    *,
    gas_pressure: float = VAPOUR_PRESSURE,
    cells_per_radius: float = 40.0,
    elastic: bool = False,
) -> Case:
    """A gas bubble that collapses in water near a wall, which may yield.

    Parameters
    ----------
    radius
        R, m.
    pressure
        Of the liquid far away, Pa; above `gas_pressure`.
    stand_off
        d/R, the distance of the bubble's centre from the wall in radii, 0 to 1000; below 1 the wall cuts the bubble.
    wall
        A material of the library, a short name such as ``"steel"``, or ``"rigid"``.
    gas_pressure
        Of the gas in the bubble, Pa. Peaks depend on it the more the lower `pressure` is.
    cells_per_radius
        Finest cells of the fluid per radius, 4 to 2000.
    elastic
        Leave the wall elastic, whatever it could bear.

    Raises
    ------
    CaseError
        Numbers that make no case, each named with what is allowed.
    ValueError
        No such wall, with the nearest names.
    """
    _real(radius=radius, pressure=pressure, stand_off=stand_off, gas_pressure=gas_pressure, cells_per_radius=cells_per_radius)
    return Case._of(_pycav.new_collapse(radius, pressure, stand_off, wall, gas_pressure, cells_per_radius, elastic))


def free_bubble(
    radius: float = 1e-3,
    pressure: float = 1e6,
    *,
    gas_pressure: float = 10 * VAPOUR_PRESSURE,
    cells_per_radius: float = 40.0,
) -> Case:
    """A gas bubble that collapses in unbounded water and rebounds. Arguments and errors as of `collapse`."""
    _real(radius=radius, pressure=pressure, gas_pressure=gas_pressure, cells_per_radius=cells_per_radius)
    return Case._of(_pycav.new_free_bubble(radius, pressure, gas_pressure, cells_per_radius))


def laser_bubble(
    radius: float | None = None,
    equilibrium_radius: float | None = None,
    left_radius: float | Literal["scaled"] | None = "scaled",
    pressure: float = 1e5,
    stand_off: float | None = None,
    wall: str | None = None,
    *,
    largest_radius: float | None = None,
    cells_per_radius: float = 16.0,
) -> Case:
    """A laser bubble: a small one of high pressure that grows, collapses and rebounds, on a grid that follows it.

    Parameters
    ----------
    radius
        At the start, m; 20 µm, or in that proportion to `largest_radius`.
    equilibrium_radius
        R_n of its gas, m: it starts with the pressure p∞ (R_n/R)^(3γ). 184.1 µm, of which 494 µm are made.
    left_radius
        R_n of the gas that is left when the bubble is at its largest, m; all of it stays with None. "scaled": 64 µm, or in that
        proportion to `largest_radius`.
    pressure
        Of the liquid far away, Pa.
    stand_off
        d/R_max, the distance of the bubble's centre from a wall in largest radii; far from any wall with None.
    wall
        As of `collapse`, with a `stand_off`; rigid if left out.
    largest_radius
        What the bubble grows to, m, in the place of `equilibrium_radius`, which follows from it by Gilmore's equation.
    cells_per_radius
        Along the present radius, at least; 4 to 2000.

    Errors as of `collapse`; ValueError for both a largest and an equilibrium radius, and for a wall without `stand_off`.
    """
    if largest_radius is not None and equilibrium_radius is not None:
        raise ValueError("largest_radius and equilibrium_radius: give one, the other follows from it")
    left = None if isinstance(left_radius, str) and left_radius == "scaled" else left_radius
    optional = {"radius": radius, "equilibrium_radius": equilibrium_radius, "left_radius": left, "stand_off": stand_off, "largest_radius": largest_radius}
    _real(pressure=pressure, cells_per_radius=cells_per_radius, **{name: value for name, value in optional.items() if value is not None})
    radii = (radius, equilibrium_radius, largest_radius)
    case = _pycav.new_laser_bubble(radii, (left_radius is None, left), pressure, stand_off, "rigid" if wall is None else wall, cells_per_radius)
    # Where there is such a wall: of another one the names that there are say more.
    if wall is not None and stand_off is None:
        raise ValueError(f"wall = {wall!r}: the following required argument was not provided: stand_off, the distance of the bubble's centre "
                         "from the wall in largest radii; without it there is no wall")
    return Case._of(case)


def shocked_bubble(
    radius: float = 1e-4,
    pressure: float = 1e5,
    amplitude: float = 35e6,
    stand_off: float = 2.0,
    wall: str = "steel",
    *,
    cells_per_radius: float = 40.0,
) -> Case:
    """An air bubble that a lithotripter's pulse (Church 1989) collapses near a wall.

    - `pressure`: of water and air before the pulse, Pa; `amplitude`: the largest of the pulse above that, Pa.

    The others, and errors, are those of `collapse`.
    """
    _real(radius=radius, pressure=pressure, amplitude=amplitude, stand_off=stand_off, cells_per_radius=cells_per_radius)
    return Case._of(_pycav.new_shocked_bubble(radius, pressure, amplitude, stand_off, wall, cells_per_radius))


def wall_load(
    amplitude: float = 1e9,
    radius: float = 5e-4,
    duration: float = 1e-6,
    wall: str = "steel",
    *,
    cells_per_radius: float = 20.0,
) -> Case:
    """A pressure A exp(−r²/b²) sin²(πt/T) on a wall, without a fluid: the pit.

    - `amplitude`: A, Pa; `radius`: b, m; `duration`: T, s; `cells_per_radius`: of the load. Errors as of `collapse`.
    """
    _real(amplitude=amplitude, radius=radius, duration=duration, cells_per_radius=cells_per_radius)
    return Case._of(_pycav.new_wall_load(amplitude, radius, duration, wall, cells_per_radius))
