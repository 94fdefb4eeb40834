"""Pictures of numbers: histories, stand-offs, walls, grids."""

import matplotlib as mpl
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

import pycav
from pycav import plot
from pycav.plot.style import BLUE, GREEN, GREY, ORANGE, PINK, RC, WIDTH, legend
from pycav.plot.surface import Profile

MILLI, MICRO, NANO, MEGA = 1e-3, 1e-6, 1e-9, 1e6


def free(run):
    """The radius of a free bubble beside Rayleigh's and Keller and Miksis's."""
    bubble = pycav.theory.Bubble.of(run)
    time, radius = (run.histories[name].to_numpy() for name in ("time", "bubble/equivalent_radius"))
    with mpl.rc_context(RC):
        figure = Figure(figsize=(WIDTH, 3.4), layout="constrained")
        axes = figure.subplots()
        rayleigh, keller_miksis = bubble.rayleigh(), bubble.keller_miksis(float(time[-1]), 20_000)
        near = axes.inset_axes((0.68, 0.1, 0.29, 0.4))
        for place in (axes, near):
            place.plot(rayleigh[0] / MICRO, rayleigh[1] / MILLI, color=GREY, dashes=(5, 2), linewidth=0.8,
                       label="Rayleigh, constant pressures")
            place.plot(time / MICRO, radius / MILLI, color=BLUE, linewidth=2.0, alpha=0.6,
                       label=f"run, {run.cells_per_radius:.0f} cells per radius")
            place.plot(keller_miksis[0] / MICRO, keller_miksis[1] / MILLI, color=ORANGE, label="Keller–Miksis")
        smallest = time[radius.argmin()] / MICRO
        near.set(xlim=(smallest - 0.5, smallest + 0.5), ylim=(0.1, 0.22), yticks=(0.1, 0.15, 0.2))
        near.tick_params(labelsize=7)
        axes.indicate_inset_zoom(near, edgecolor="0.4")
        axes.set(xlim=(0, time[-1] / MICRO), ylim=(0, None), xlabel="$t$ / µs", ylabel=r"$R_\mathrm{eq}$ / mm")
        legend(axes, loc="lower left")
    return figure


def stand_off(runs):
    """Peak and impulse on the wall over d/R; `runs` by d/R."""
    shown = sorted(runs)
    span = float(runs[shown[0]].summary["wall_pressure_mean_time"])
    with mpl.rc_context(RC):
        figure = Figure(figsize=(WIDTH, 2.9), layout="constrained")
        left, right = figure.subplots(1, 2)
        for name, colour, label in (("wall_pressure_peak", BLUE, "largest of a step"),
                                    ("wall_pressure_mean_peak", ORANGE, f"largest mean over {span / NANO:.0f} ns")):
            values = [float(runs[distance].summary[name]) / MEGA for distance in shown]
            left.plot(shown, values, color=colour, marker="o", markersize=4, label=label)
        left.set(yscale="log", ylabel="pressure on the wall, on the axis / MPa")
        _plain(left.yaxis, (100, 200, 500, 1000, 2000))
        legend(left)
        impulses = [float(runs[distance].summary["load_impulse"]) for distance in shown]
        right.plot(shown, impulses, color=BLUE, marker="o", markersize=4)
        right.set(ylim=(0, None), ylabel="impulse of the load, on the axis / (Pa s)")
        for axes in (left, right):
            axes.set_xlabel("stand-off $d/R$")
            axes.axvspan(min(shown) - 0.1, 1.0, color="0.94", linewidth=0)
            axes.set_xlim(min(shown) - 0.1, max(shown) + 0.1)
        left.text(0.03, 0.03, "the wall cuts\nthe bubble", transform=left.transAxes, fontsize=8, color="0.3")
    return figure


def walls(runs):
    """Pits in several walls; `runs` by material."""
    with mpl.rc_context(RC):
        figure = Figure(figsize=(WIDTH, 2.9), layout="constrained")
        left, right = figure.subplots(1, 2)
        for (name, run), colour in zip(runs.items(), (BLUE, ORANGE, GREEN, PINK)):
            profile, found = Profile.of(run, None), run.summary
            r, depth = profile.line
            left.plot(r / MILLI, depth / MICRO, color=colour, label=name)
            deep = float(found["pit_depth"]) / MICRO
            right.errorbar(float(found["yield_strength"]) / MEGA, deep, deep * float(found["surface_still"]), fmt="o",
                           color=colour, markersize=4, capsize=2.5, linewidth=0.8)
        left.set(xlim=(0, 2), xlabel="$r$ / mm", ylabel="depth below the level far away / µm")
        left.invert_yaxis()
        legend(left, loc="lower right")
        right.set(xscale="log", yscale="log", xlim=(25, 450), ylim=(0.8, 100), xlabel="yield strength / MPa", ylabel="depth / µm")
        right.text(0.97, 0.96, "bars: how far the surface still moves", transform=right.transAxes, fontsize=8, color="0.3",
                   ha="right", va="top")
        _plain(right.xaxis, (30, 50, 100, 200, 300))
        _plain(right.yaxis, (1, 2, 5, 10, 20, 50, 100))
    return figure


def _plain(axis, marks):
    """Plain numbers on a logarithmic axis."""
    axis.set(major_locator=FixedLocator(marks), minor_locator=NullLocator(), major_formatter=FuncFormatter(lambda v, _: f"{v:g}"))


def convergence(study):
    """Four numbers of the wall on three grids."""
    return study.plot("wall_pressure_peak", "wall_pressure_mean_peak", "load_impulse", "pit_depth")
