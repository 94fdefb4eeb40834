"""The quantities that the pictures of a run can show."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np

from ..mesh import Floats
from ..plot.plastic import FIELD as STRAIN
from .._numbers import prefix
from ..plot.waves import gradient
from ..result import Result, Snapshot
from . import scales
from .scales import Scale

Ends = tuple[float, float]


@dataclass(frozen=True)
class Quantity:
    """A field of one medium, in the unit in which it is shown."""

    medium: str
    name: str
    label: str
    unit: str
    values: Callable[[Snapshot], Floats]
    """Of the cells of a snapshot"""
    scale: Callable[[Ends], Scale]
    """From nearly the smallest and nearly the largest value that is shown at any time"""
    shares: str = ""
    """Quantities of the same name here have one scale, on both sides of the wall"""
    dark: str = "turn"
    """What a dark page does with the picture: `turn` light into dark and keep the hue, `keep` it"""


def quantities(result: Result) -> list[Quantity]:
    """What the snapshots of a run have, the medium above first; the first of each medium is shown at first."""
    media = result.media
    return [*(_of_fluid(result) if "fluid" in media else ()), *(_of_solid(result) if "solid" in media else ())]


def _of_fluid(result: Result) -> Iterable[Quantity]:
    fields = result.fluid.fields
    rest = _ambient(result)
    if "schlieren" in fields or "density" in fields:
        yield Quantity("fluid", "schlieren", "schlieren |∇ρ|", "kg/m⁴", lambda snapshot: gradient(result, "fluid", snapshot),
                       lambda ends: scales.logarithmic(ends[1], 4.0, "gray_r"))
    if "pressure" in fields:
        yield _pressure("fluid", "pressure", "pressure", lambda snapshot: snapshot["pressure"], rest)
    if "gas_fraction" in fields:
        yield Quantity("fluid", "gas", "gas fraction φ", "", lambda snapshot: snapshot["gas_fraction"],
                       lambda ends: scales.power(1.0, 1.0, "YlGnBu", steps=64))


def _of_solid(result: Result) -> Iterable[Quantity]:
    fields = result.solid.fields
    if "von_mises" in fields:
        yield Quantity("solid", "mises", "von Mises stress", "MPa", lambda snapshot: 1e-6 * snapshot["von_mises"],
                       lambda ends: scales.power(ends[1], 0.6, "inferno"), dark="keep")
    if STRAIN in fields:
        # Logarithmic from a hundredth of a per cent on, below which nothing is said to have flowed (docs/reference/output.md).
        yield Quantity("solid", "strain", "plastic strain", "%", lambda snapshot: 100 * snapshot[STRAIN],
                       lambda ends: scales.logarithmic(max(ends[1], 0.1), float(np.log10(max(ends[1], 0.1) / 0.01)), "magma_r",
                                                       0.0, 0.95, 128))
    if "stress_zz" in fields:
        yield _pressure("solid", "normal", "normal stress −σ_zz", lambda snapshot: -snapshot["stress_zz"], _ambient(result))
    if "displacement" in fields:
        largest = max((float(np.abs(snapshot["displacement"][:, 0]).max()) for snapshot in result.solid), default=0.0)
        factor, letter = prefix(largest)
        yield Quantity("solid", "displacement", "displacement u_z", f"{letter}m",
                       lambda snapshot: factor * snapshot["displacement"][:, 0],
                       lambda ends: scales.about(0.0, *ends, "PuOr"))


def _pressure(medium: str, name: str, label: str, values: Callable[[Snapshot], Floats], rest: float) -> Quantity:
    return Quantity(medium, name, label, "MPa", lambda snapshot: 1e-6 * values(snapshot),
                    lambda ends: scales.about(1e-6 * rest, *ends, "RdBu_r"), "pressure")


def _ambient(result: Result) -> float:
    """The pressure to which others are compared, Pa: that of the liquid far away at the start, or none under a load."""
    return float(result.parameters.get("fluid", {}).get("ambient", {}).get("pressure", 0.0)) if "fluid" in result.media else 0.0
