"""How well a run conserves and couples, in words and numbers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from .mesh import Floats
from .plot.style import number, si
from .result import Result

Rows = Iterable[tuple[str, str, str]]


def _power(value: float) -> str:
    return f"{value:.1e}".replace("-", "−")


def health(result: Result) -> Rows:
    """What tells how well the media are coupled and conserved: what, value, note."""
    data, summary = result.histories, result.summary
    fluid, solid = "conservation/fluid/", "conservation/solid/"
    sides = ("z_min", "z_max", "r_min", "r_max")
    for quantity in ("mass", "energy"):
        if fluid + quantity in data:
            content = data[fluid + quantity].to_numpy()
            came = sum(data[f"{fluid}{quantity}_in_{side}"].to_numpy() for side in sides)
            if quantity == "energy":
                came = came + data[f"{fluid}energy_from_floor"].to_numpy()
            drift = np.abs(content - came - content[0]).max() / np.abs(content).max()
            yield f"fluid's {quantity}, balance", _power(drift), "relative; content minus what came in"
    if fluid + "interface_work" in data and solid + "energy_in_z_max" in data:
        for name, given, got in (("impulse", "interface_impulse", "momentum_in_z_max"),
                                 ("work", "interface_work", "energy_in_z_max")):
            one, other = data[fluid + given].to_numpy(), data[solid + got].to_numpy()
            count = min(len(one), len(other))
            size = max(np.abs(one).max(), np.abs(other).max())
            gap = np.abs(one[:count] + other[:count]).max() / size if size else 0.0
            yield f"{name} given and got at the interface", _power(gap), "relative difference"
    yield from _jumps(result)
    fixups = summary.get("fixups", {})
    names = {"first_order": "cell-steps at first order", "redone": "mixed cell-steps done again",
             "floored": "cell-steps lifted to the pressure floor", "floored_stars": "star states lifted"}
    for key, label in names.items():
        if key in fixups:
            yield label, f"{fixups[key]:,}", ""
    if fixups.get("floor_energy_share") is not None:
        yield "energy that the floor added", f"{100 * fixups['floor_energy_share']:.3g} %", "of the collapse's"
    if "exchange_wait_share" in summary.get("coupling", {}):
        share = summary["coupling"]["exchange_wait_share"]
        yield "waits for frames that were ready", f"{100 * share:.2g} %", "of the wall time"


def jumps(result: Result) -> tuple[Floats, Floats, Floats]:
    """What jumps at the interface though it should not, the paper's Eq. (33), at the snapshots of a run of two media.

    Returns radii (m, the fluid's finest faces, shape (faces,)) and two arrays of shape (snapshots, faces, 2): v_z of the fluid
    and of the solid in m/s, whose difference is ε_k, and p and −σ_zz in Pa, whose difference is ε_d; each side's own values,
    linear from its cells to the wall.
    """
    fluid, solid = result.fluid, result.solid
    mesh = fluid[0].mesh
    wall, count = float(mesh.low[0]), round(float((mesh.high[1] - mesh.low[1]) / mesh.finest[1]))
    r = mesh.low[1] + (np.arange(count) + 0.5) * mesh.finest[1]

    def on_wall(snapshots: Any, name: str) -> Floats:
        rows = []
        for snapshot in snapshots:
            values = snapshot[name]
            side = 1e-6 * snapshot.mesh.finest[0] * (1 if snapshots is fluid else -1)
            points = np.column_stack([np.full(count, wall + side), r])
            rows.append(snapshot.mesh.sample(values[:, 0] if values.ndim == 2 else values, points))
        return np.stack(rows)

    velocity = np.stack([on_wall(side, "velocity") for side in (fluid, solid)], -1)
    pressure = np.stack([on_wall(fluid, "pressure"), -on_wall(solid, "stress_zz")], -1)
    return r, velocity, pressure


def _jumps(result: Result) -> Rows:
    """ε_k and ε_d of the snapshot in which they are largest."""
    needed = {"fluid": ("velocity", "pressure"), "solid": ("velocity", "stress_zz")}
    if len(result.media) < 2 or any(name not in result.snapshots(medium).fields for medium, names in needed.items()
                                    for name in names):
        return
    r, velocity, pressure = jumps(result)
    area = r / r.sum() if result.parameters.get("geometry") != "planar" else np.full(len(r), 1 / len(r))
    rows = [("ε_k, v_z of the fluid less that of the solid", "m/s", "the velocity there", velocity, 0.0),
            ("ε_d, p + σ_zz", "Pa", "the pressure's change there", pressure, pressure[0].mean())]
    for name, unit, of, pair, rest in rows:
        jump = np.sqrt(((pair[..., 0] - pair[..., 1])**2 * area).sum(1))
        size = np.sqrt((((pair - rest)**2).mean(-1) * area).sum(1))
        worst = int(np.argmax(jump))
        share = f", {number(float(f'{100 * jump[worst] / size[worst]:.2g}'))} % of {of}" if size[worst] > 0 else ""
        yield name, si(float(jump[worst]), unit), f"rms over the wall at {si(float(result.fluid.times[worst]), 's')}{share}"
