"""What happens over time: bubble, wall, solid."""

import h5py
import matplotlib.pyplot as plt
import numpy as np

from drawing import BLUE, BUBBLE, GREEN, GREY
from run_directory import MEGA, MICRO, MILLI
from yielding import STEELS


def von_mises(probe):
    zz, rr, phiphi, zr = (probe[f"stress_{name}"][:] for name in ("zz", "rr", "phiphi", "zr"))
    return np.sqrt(0.5 * ((zz - rr) ** 2 + (rr - phiphi) ** 2 + (phiphi - zz) ** 2) + 3 * zr**2)


def histories(run):
    with h5py.File(run.path / "history.h5") as file:
        time, wall = file["time"][:] * MICRO, file["wall/pressure_axis"][:] * MEGA
        solid_time, stress = file["solid/time"][:] * MICRO, file["solid/von_mises_max"][:] * MEGA
        place = file["solid/von_mises_max_position"][:] * MILLI
        radius = file["bubble/equivalent_radius"][:] / run.radius
        probe = "probes/solid-2mm"
        below = (file[f"{probe}/time"][:] * MICRO, von_mises(file[probe]) * MEGA) if probe in file else None
    figure, (top, middle, bottom) = plt.subplots(3, 1, sharex=True, figsize=(5.6, 5.2),
                                                 gridspec_kw=dict(height_ratios=(1, 2, 1), hspace=0.08))
    top.plot(time, radius, color=BLUE, linewidth=1)
    top.set(ylabel=r"$R_\mathrm{eq}\,/\,R$", ylim=(0, None))
    top_stress = 1.08 * max(560 / 1.08, stress.max(), wall.max())
    middle.plot(time, wall, color=BLUE, linewidth=1, label="pressure on the wall, on the axis")
    middle.plot(solid_time, stress, color=BUBBLE, linewidth=1, label="von Mises stress, largest in the solid")
    if below:
        middle.plot(*below, color=GREEN, linewidth=1, label="von Mises stress on the axis, 2 mm deep")
    for name, strength in STEELS:
        middle.axhline(strength * MEGA, color=GREY, linewidth=0.6, dashes=(4, 3))
        middle.text(0.5 * run.slowness, strength * MEGA - 0.01 * top_stress, f"yield strength, {name}", fontsize=7,
                    color="0.35", va="top")
    middle.set(ylabel="MPa", ylim=(min(0.0, 1.05 * wall.min()), top_stress))
    middle.legend(frameon=False, loc="upper left", fontsize=8)
    place[stress < 1.05 * stress[0]] = np.nan  # before the first wave every place is as good
    bottom.plot(solid_time, run.wall * MILLI - place[:, 0], color=BUBBLE, linewidth=0.8, label="below the wall")
    bottom.plot(solid_time, place[:, 1], color=GREEN, linewidth=0.8, label="off the axis")
    bottom.set(xlabel="$t$ / µs", ylabel="place of the\nlargest stress / mm", xlim=(0, time[-1]),
               ylim=(0, 1.4 * np.nanmax(place)))
    bottom.legend(frameon=False, fontsize=8, ncols=2, loc="upper left")
    figure.subplots_adjust(0.12, 0.09, 0.98, 0.985)
    return figure
