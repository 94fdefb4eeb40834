"""Key numbers: what one asks for first, in units of an engineer, and how sure they are."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from .._convergence import Convergence, study_of
from .._key_numbers import wall_peak
from .._numbers import rounded, si, unit_in
from ..plot.surface import has_pit
from ..result import Result
from .so_far import has_summary, known


@dataclass(frozen=True)
class Number:
    """A number with what stands behind it."""

    label: str
    value: str
    around: str = ""
    """Its uncertainty, where it is known"""
    note: str = ""


LABELS = {
    "wall_pressure_peak": "Wall pressure on the axis, largest",
    "wall_pressure_mean_peak": "Wall pressure on the axis, largest mean",
    "wall_pressure_peak_anywhere": "Wall pressure anywhere, largest",
    "load_impulse": "Impulse on the wall's axis beyond the pressure far away",
    "jet_velocity_peak": "Fastest liquid on the axis",
    "min_equivalent_radius": "Smallest equivalent radius",
    "von_mises_peak": "von Mises stress, largest",
    "yielded_volume_peak": "Volume that would yield, largest",
    "plastic_strain_peak": "Plastic strain, largest",
    "pit_depth": "Pit, depth",
}
"""The keys of the summary that have a number on the page, in their order."""

UNITS = {"load_impulse": "Pa s", "jet_velocity_peak": "m/s", "min_equivalent_radius": "m", "yielded_volume_peak": "m³",
         "plastic_strain_peak": "%", "pit_depth": "m"}
TIMES = {"min_equivalent_radius": "collapse_time"}


def shown(value: float, unit: str) -> str:
    """A number with four digits: pressures in MPa as soon as they reach a tenth of one, shares in per cent."""
    if unit == "Pa" and abs(value) >= 1e5:
        return f"{float(f'{value * 1e-6:.4g}'):g} MPa".replace("-", "−")
    if unit == "%":
        return f"{100 * value:.3g} %"
    return si(value, unit)


def key_numbers(result: Result) -> Iterable[Number]:
    """The numbers that a run has."""
    summary, study = known(result), study_of(result)
    has_wall = "interface/pressure" in result.histories
    on_axis = wall_peak(summary)
    for key, label in LABELS.items():
        name = on_axis if key == "wall_pressure_peak" else key
        value = summary.get(name)
        if value is None or not math.isfinite(value) or _says_nothing(name, summary, result) or (name.startswith("wall_") and not has_wall):
            continue
        if name == "wall_pressure_peak_anywhere" and value <= (summary.get(on_axis) or 0.0):
            continue  # it was on the axis
        unit = unit_in(result.parameters, UNITS.get(name, "Pa"))
        notes = [f"at {si(float(time), 's')}"] if (time := summary.get(TIMES.get(name, f"{name}_time"))) is not None else []
        if name == "wall_pressure_mean_peak" and summary.get("wall_pressure_mean_time") is not None:
            label += f" over {rounded(float(summary['wall_pressure_mean_time']), 's')}"
        if name == "min_equivalent_radius" and (share := _of_radius(float(value), result)):
            notes.append(share)
        around, says = _uncertainty(*study, name, float(value), unit) if study is not None else ("", "")
        is_pit = name == "pit_depth"  # three digits, as the table of the damage has it
        yield Number(label, shown(float(f"{value:.3g}") if is_pit else float(value), unit), around, "; ".join([*notes, *filter(None, [says])]))


def _of_radius(smallest: float, result: Result) -> str:
    """The smallest radius as a share of the one that the collapse begins from: of a bubble that grows first the largest."""
    largest = result.summary.get("max_equivalent_radius") if result.summary.get("growth_time") is not None else None
    whole = largest or result.summary.get("initial_equivalent_radius") or result.radius
    return f"{smallest / whole:.3g} of the {'largest' if largest else 'first'} radius" if whole else ""


def _says_nothing(name: str, summary: dict[str, Any], result: Result) -> bool:
    """Numbers that are there though nothing stands behind them: without a bubble, a yield strength, a pit."""
    if name in ("jet_velocity_peak", "min_equivalent_radius"):
        planar = result.parameters.get("geometry") == "planar"
        return "bubble/equivalent_radius" not in result.histories or float(result.histories["bubble/equivalent_radius"][0]) <= 0 \
            or (planar and name == "jet_velocity_peak")
    if name == "yielded_volume_peak":
        return not summary.get(name) or result.yield_strength is None or "plasticity" in result.parameters.get("solid", {})
    return name == "pit_depth" and not has_pit(summary)


def _uncertainty(study: Convergence, grid: int, name: str, value: float, unit: str) -> tuple[str, str]:
    """What stands behind a number, and what is said of it: its uncertainty by the study, or why there is none."""
    found = study.record["numbers"].get(name)
    if found is None or found["values"][grid] != value:
        return "", ""
    own = found["uncertainties"][grid]
    how = found["convergence"].replace("-", " ")
    if own is None:
        return "", f"on finer grids {how}"
    order = how if found["order"] is None else f"order {found['order']:.2g}"
    if how == "slow":
        order += ", too low to extrapolate"
    around = shown(float(f"{own:.3g}"), unit)
    return f" ± {around}", order


def resolution(result: Result) -> str:
    """How fine the grid was, and where it stands in a study."""
    cells, study = result.cells_per_radius, study_of(result)
    told = [] if cells is None else [f"{cells:.4g} cells per radius of the bubble"]
    counts = {medium: count.get("largest", 0) for medium, count in result.summary.get("cells", {}).items()}
    told += [" and ".join(f"{count:,} cells in the {medium}" for medium, count in counts.items()) + " at most"] if counts else []
    if study is not None:
        told.append(f"grid {study[1]} of 0 to {len(study[0].grids) - 1} of a convergence study; ± is its grid-convergence index")
    if not has_summary(result):
        told.append("peaks are those of the recorded steps")
    return "; ".join(told)
