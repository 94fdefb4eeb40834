"""How far a run can be trusted: short verdicts, each with the number behind it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from .._convergence import study_of
from .._key_numbers import wall_peak
from ..mesh import Floats
from .._numbers import percent, rounded, si
from ..plot.surface import ALMOST_STILL, STILL, has_pit
from ..result import Result, Snapshots
from .scales import RAISED

ROUND_OFF = 1e-9
"""Below this share a balance is off by rounding alone; a lost flux would show as 1e-6 and more."""
RARE = 1e-3
"""Fall-backs in a smaller share of the cell updates touch next to nothing."""
FLOOR = 1e-2
"""The share of the collapse's energy from which on the program itself warns (docs/reference/output.md)."""
JUMP = 0.05
"""Share of the pressure's change by which both sides' own values may differ at the wall."""
AT_REST = 1e-6
"""A change of the pressure at the wall by a smaller share of it is rounding: sides that differ by as much say nothing of the grid."""
SMALLEST = 10.0
"""Cells along the radius of the smallest bubble below which it is hardly resolved."""
FILM = 4.0
"""Cells across a film of liquid below which it is not resolved."""
SURE = 0.05
"""Grid-convergence index of the wall pressure up to which it counts as known."""

SIDES = ("z_min", "z_max", "r_min", "r_max")
LEDGERS = {
    "mass": [*(f"mass_in_{side}" for side in SIDES), "mass_from_reset"],
    "energy": [*(f"energy_in_{side}" for side in SIDES), "energy_from_floor", "energy_from_reset", "tension_work",
               "energy_from_phase_change"],
}
"""What changes the fluid's content (docs/reference/output-histories.md, *Conservation*); those of a cut are there in cases with one.

`heat_to_wall` is part of what comes through z_min."""


@dataclass(frozen=True)
class Verdict:
    """What was looked at, how it came out, and the number behind it."""

    good: bool
    says: str
    number: str
    note: str = ""


def power(value: float) -> str:
    """A small number: 1.3 · 10⁻¹⁵."""
    if value == 0.0:
        return "0"
    mantissa, exponent = f"{value:.1e}".split("e")
    return f"{mantissa} · 10{str(int(exponent)).translate(RAISED)}"


def health(result: Result) -> Iterable[Verdict]:
    """All verdicts that a run allows, what a reader should know first at the beginning."""
    yield from _convergence(result)
    yield from _resolution(result)
    yield from _still(result)
    yield from _balances(result)
    yield from _continuity(result)
    yield from _fixups(result)


def _convergence(result: Result) -> Iterable[Verdict]:
    study = study_of(result)
    name, what = wall_peak(result.summary), "largest wall pressure"
    if result.summary.get("wall_pressure_mean_peak") is not None:
        name, what = "wall_pressure_mean_peak", "largest mean wall pressure"
    if "interface/pressure" not in result.histories or "fluid" not in result.media:
        name, what = "von_mises_peak", "largest von Mises stress"
    if study is None:
        yield Verdict(False, "No finer grid has been computed: how far the peaks are from converged is not known.", "",
                      "cav run CASE --refine 3 computes it")
        return
    found, value = study[0].record["numbers"].get(name), result.summary.get(name)
    own = None if found is None or found["values"][study[1]] != value else found["uncertainties"][study[1]]
    if own is None or not value:
        yield Verdict(False, f"The grids do not say how sure the {what} is.", "" if found is None else found["convergence"].replace("-", " "))
        return
    share = abs(own / value)
    yield Verdict(share <= SURE, f"The {what} is {'known' if share <= SURE else 'not yet known'} to within {100 * SURE:g} %.",
                  f"± {percent(share)}", "grid-convergence index of this grid")


def _resolution(result: Result) -> Iterable[Verdict]:
    summary, cells = result.summary, result.cells_per_radius
    # The answer's number, which a grid that follows the bubble changes, and which several bubbles do not have.
    left = summary.get("cells_per_smallest_radius")
    if cells is not None and left is not None:
        yield Verdict(left >= SMALLEST, f"The bubble is {'' if left >= SMALLEST else 'hardly '}resolved when it is smallest.",
                      f"{left:.3g} cells", f"along its equivalent radius then; {cells:.4g} at the start")
    film = summary.get("film_cells_min")
    if film is not None:
        yield Verdict(film >= FILM, f"The film of liquid between bubble and wall is {'' if film >= FILM else 'not '}resolved where it is thinnest.",
                      f"{film:.2g} cells", f"across {rounded(summary.get('film_thickness_min'), 'm')} at {si(summary.get('film_thickness_min_time'), 's')}")


def _still(result: Result) -> Iterable[Verdict]:
    still = result.summary.get("surface_still")
    if still is not None and has_pit(result.summary):
        rest = "at rest" if still <= STILL else "nearly at rest"
        yield Verdict(still <= ALMOST_STILL, f"The surface is {rest} at the end: the pit is what stays." if still <= ALMOST_STILL else
                      "The surface still moves at the end: the pit is not yet what stays.", percent(still), "of its depth")


def _balances(result: Result) -> Iterable[Verdict]:
    data = result.histories
    fluid, solid = "conservation/fluid/", "conservation/solid/"
    found = {}
    if fluid + "mass" in data and len(data[fluid + "mass"]) < 2:
        yield Verdict(False, "Whether mass, energy and impulse balance is not known: their histories have a single row.", "",
                      "output.interface_every shorter than the run makes more")
        return
    # The work of the weight has no ledger.
    weighs = bool(result.parameters.get("fluid", {}).get("gravity"))
    for quantity in ("mass",) if weighs else ("mass", "energy"):
        if fluid + quantity in data:
            content = data[fluid + quantity].to_numpy()
            came = sum(data[fluid + ledger].to_numpy() for ledger in LEDGERS[quantity] if fluid + ledger in data)
            found[quantity] = float(np.abs(content - came - content[0]).max() / np.abs(content).max())
    if found:
        largest, what = max(found.values()), "mass and energy" if "energy" in found else "mass"
        verb = "are" if "energy" in found else "is"
        note = "largest imbalance, as a share of the content; all that the ledgers of /conservation have is counted"
        yield Verdict(largest <= ROUND_OFF, f"The fluid's {what} {verb} {'' if largest <= ROUND_OFF else 'not '}conserved.", power(largest),
                      note + "; the energy is not looked at, as the work of the weight has none" * weighs)
    if fluid + "interface_work" in data and solid + "energy_in_z_max" in data:
        gaps = []
        for given, got in (("interface_impulse", "momentum_in_z_max"), ("interface_work", "energy_in_z_max")):
            one, other = data[fluid + given].to_numpy(), data[solid + got].to_numpy()
            count, size = min(len(one), len(other)), max(np.abs(one).max(), np.abs(other).max())
            gaps.append(float(np.abs(one[:count] + other[:count]).max() / size) if size else 0.0)
        yield Verdict(max(gaps) <= ROUND_OFF, "Impulse and work that leave the fluid arrive in the solid." if max(gaps) <= ROUND_OFF else
                      "Impulse and work that leave the fluid do not arrive in the solid.", power(max(gaps)), "largest relative difference")


def _fixups(result: Result) -> Iterable[Verdict]:
    fixups, updates = result.summary.get("fixups", {}), sum(result.summary.get("cell_updates", {}).values())
    if "first_order" in fixups and updates:
        share = max(fixups["first_order"], fixups.get("redone", 0)) / updates
        yield Verdict(share <= RARE, f"Fall-backs to first order were {'rare' if share <= RARE else 'frequent'}.",
                      percent(share), "of the cell updates")
    if fixups.get("floor_energy_share") is not None:
        share = float(fixups["floor_energy_share"])
        yield Verdict(share <= FLOOR, "The pressure floor added no energy to speak of." if share <= FLOOR else
                      "The pressure floor added energy that the collapse does not have.", percent(share), "of the collapse's energy")


def _continuity(result: Result) -> Iterable[Verdict]:
    """How far both sides' own values at the wall are apart at the snapshots, the paper's ε_d and ε_k."""
    needed = {"fluid": ("velocity", "pressure"), "solid": ("velocity", "stress_zz")}
    if len(result.media) < 2 or any(name not in result.snapshots(medium).fields for medium, names in needed.items() for name in names):
        return
    times = common_times(result)
    # At the first one nothing has happened yet.
    if len(times) < 2:
        return
    rows = mismatch(result)
    has_changed = np.array(rows["pressure_share"]) > 0
    if not has_changed.any():
        return
    worst = int(np.argmax(rows["pressure"] * has_changed))
    share = rows["pressure_share"][worst]
    yield Verdict(bool(share <= JUMP), f"The grid {'resolves' if share <= JUMP else 'does not resolve'} the pressure at the wall.", percent(share),
                  f"of its change: by so much (ε_d = {rounded(rows['pressure'][worst], 'Pa')}, rms) fluid and solid differ at most, at "
                  f"{si(float(times[worst]), 's')}; velocities by {rounded(float(max(rows['velocity'])), 'm/s')} (ε_k) at most")


def mismatch(result: Result) -> dict[str, list[float]]:
    """rms over the wall at each snapshot: ε_d (`pressure`, Pa) and ε_k (`velocity`, m/s), and ε_d as a share of the pressure's change
    there (`pressure_share`), which is 0 where that is rounding."""
    r, velocity, pressure = jumps(result)
    area = r / r.sum() if result.parameters.get("geometry") != "planar" else np.full(len(r), 1 / len(r))

    def rms(values: Floats) -> Floats:
        return np.asarray(np.sqrt((values**2 * area).sum(1)))

    gap = rms(pressure[..., 0] - pressure[..., 1])
    change = np.sqrt((((pressure - pressure[0].mean())**2).mean(-1) * area).sum(1))
    share = np.divide(gap, change, out=np.zeros_like(gap), where=change > AT_REST * np.abs(pressure).max((1, 2)))
    return {"pressure": gap.tolist(), "velocity": rms(velocity[..., 0] - velocity[..., 1]).tolist(), "pressure_share": share.tolist()}


def common_times(result: Result) -> Floats:
    """The times of snapshots that both media have, s: a side that failed may have a last one that the other has not."""
    return np.intersect1d(result.fluid.times, result.solid.times)


def jumps(result: Result) -> tuple[Floats, Floats, Floats]:
    """What jumps at the interface though it should not, the paper's Eq. (33), at the snapshots that both media of a run have.

    Returns radii (m, the fluid's finest faces, shape (faces,)) and two arrays of shape (snapshots, faces, 2): v_z of the fluid
    and of the solid in m/s, whose difference is ε_k, and p and −σ_zz in Pa, whose difference is ε_d; each side's own values,
    linear from its cells to the wall.
    """
    fluid, solid = result.fluid, result.solid
    mesh = fluid[0].mesh
    wall, count = float(mesh.low[0]), round(float((mesh.high[1] - mesh.low[1]) / mesh.finest[1]))
    r = mesh.low[1] + (np.arange(count) + 0.5) * mesh.finest[1]

    times = common_times(result)

    def on_wall(snapshots: Snapshots, name: str) -> Floats:
        rows = []
        for snapshot in map(snapshots.at, times):
            values = snapshot[name]
            side = 1e-6 * snapshot.mesh.finest[0] * (1 if snapshots is fluid else -1)
            points = np.column_stack([np.full(count, wall + side), r])
            rows.append(snapshot.mesh.sample(values[:, 0] if values.ndim == 2 else values, points, bounded=False))
        return np.stack(rows)

    velocity = np.stack([on_wall(side, "velocity") for side in (fluid, solid)], -1)
    pressure = np.stack([on_wall(fluid, "pressure"), -on_wall(solid, "stress_zz")], -1)
    return r, velocity, pressure
