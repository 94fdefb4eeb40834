"""The pulse's fields beside the exact ones, and what runs along the interface."""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from . import pulse
from .runs import Box, run
from .series import read

TIME = 5e-6
IMAGES = Path(__file__).resolve().parents[2] / "docs/images"


def of_cells(snapshot, name, points):
    """The values of the cells that points (z, r) lie in."""
    cells = snapshot.mesh.locate(points)
    return np.where(cells >= 0, snapshot[name][cells], np.nan)


def draw(options):
    cells = (options.cells or [20])[0]
    size = 20e-3
    box = Box(pulse.WIDTH / cells, size, size, size)
    places = pulse.receivers(options.data, 8e-3)
    result = run(options, f"pictures-{cells}", pulse.problem(places, box, 6.5e-6, snapshots=(TIME,)))
    snapshot(options, result)
    histories(options, result)


def snapshot(options, result):
    figure = Figure(figsize=(7.2, 3.6), layout="constrained")
    axes = figure.subplots(1, 2, sharey=True)
    for medium, column, name, rest in (("fluid", "p_Pa", "pressure", 1e5), ("solid", "sigma_zz_Pa", "stress_zz", -1e5)):
        exact = read(options.data / f"D/steel/snap2d_{medium}.csv")
        z, r = np.abs(exact["z_m"]), exact["r_m"]
        sign = 1.0 if medium == "fluid" else -1.0
        inside = np.clip(z, 1e-6, None) * sign
        ours = of_cells(result.result.snapshots(medium).at(TIME), name, np.column_stack([inside, np.clip(r, 1e-6, None)]))
        shape = (len(np.unique(z)), len(np.unique(r)))
        values = [(ours - rest) * sign, exact[column] * sign]
        for axis, value in zip(axes, values):
            shown = axis.pcolormesh(r.reshape(shape) * 1e3, sign * z.reshape(shape) * 1e3, value.reshape(shape),
                                    cmap="RdBu_r", vmin=-60, vmax=60, shading="gouraud")
    for axis, title in zip(axes, ("cav", "exact")):
        axis.axhline(0.0, color="black", linewidth=0.8)
        axis.set(title=f"{title}, t = {TIME * 1e6:g} µs", xlabel="r, mm", xticks=range(0, 8, 2), aspect="equal")
    axes[0].set_ylabel("z, mm")
    figure.colorbar(shown, ax=axes, label="p' above, −σ_zz' below, Pa", shrink=0.7)
    figure.savefig(IMAGES / "verification_snapshot.png", dpi=110)


def histories(options, result):
    names = ["interface_r2mm", "interface_r4mm", "fluid_r8_z2mm", "solid_r4_zm2mm"]
    figure = Figure(figsize=(9, 9), layout="constrained")
    axes = figure.subplots(len(names), 1)
    for axis, name in zip(axes, names):
        exact = read(options.data / f"D/steel/{name}.csv")
        in_solid = name.startswith("solid")
        column, quantity = ("sigma_rr_Pa", "stress_rr") if in_solid else ("p_Pa", "pressure")
        column = "p_fluid_Pa" if name.startswith("interface") else column
        times, values = result.probe(name + ("_above" if name.startswith("interface") else ""), quantity)
        axis.plot(exact["t_s"] * 1e6, exact[column], color="0.6", linewidth=3, label="exact")
        axis.plot(times * 1e6, values[0], color="tab:blue", linewidth=1, label="cav")
        axis.set(xlim=(0, 6.5), ylabel="σ_rr', Pa" if in_solid else "p', Pa",
                 title=name.replace("_", " "))
    axes[0].legend()
    axes[-1].set_xlabel("t, µs")
    figure.savefig(IMAGES / "verification_histories.png", dpi=110)
