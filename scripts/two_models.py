#!/usr/bin/env python3
"""The figures' case with the paper's mixture and with the five-equation model, side by side.

The table is in docs/verification/paper-true-collapse.md.

    python3 scripts/two_models.py OUT.png --mixture 51.2=DIR 102.4=DIR ... --five 51.2=DIR 102.4=DIR ...

Draws the bubble's radius, the pressure on the wall and the von Mises stress 2 mm below it over time, one line per run (named by
its cells per radius), and prints a table of what can be read off. Needs scripts/requirements.txt.
"""

import argparse
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pycav
from matplotlib.figure import Figure
from pycav.plot.style import styled

from paper.picture_file import save
from paper.study import MEGA, MICRO, MILLI

RADIUS, WALL = 0.01, 0.01
NEAR = 0.1 * RADIUS
STAINLESS = 502e6


class Histories:
    def __init__(self, argument):
        self.cells, directory = argument.split("=", 1)
        result = pycav.open(directory)
        self.time, self.wall, radius, self.jet, self.solid_time, self.stress, self.place = (
            result.histories[name].to_numpy() for name in (
                "time", "wall/pressure_axis", "bubble/equivalent_radius", "bubble/jet_velocity", "solid/time",
                "solid/von_mises_max", "solid/von_mises_max_position"))
        self.radius = radius / RADIUS
        probe = result.probes["solid-2mm" if "solid-2mm" in result.probes else "deep"]
        self.deep_time, self.deep = probe["time"].to_numpy(), probe["von_mises"].to_numpy()

    def row(self):
        smallest = self.radius.argmin()
        # The shock of the first collapse; later ones are of the rest that rebounds.
        first = np.flatnonzero(self.time < self.time[smallest] + 0.45 * self.time[smallest])
        peak = first[self.wall[first].argmax()]
        # In the liquid that comes through the axis, before the bubble is smallest.
        jet = np.nanmax(np.where(self.time < self.time[smallest], self.jet, np.nan))
        near = self.place[:, 1] < NEAR
        near &= (self.solid_time > self.time[peak] - 2e-6) & (self.solid_time < self.time[peak] + 3e-6)
        axis = np.flatnonzero(near)[self.stress[near].argmax()]
        most = self.stress.argmax()
        above = self.solid_time[self.stress > STAINLESS]
        first_above = f"from {above[0] * MICRO:.1f} µs, {self.place[self.stress > STAINLESS][0, 1] * MILLI:.1f} mm off the axis" if len(above) else "never"
        return [self.cells, f"{self.radius[smallest]:.4f} R at {self.time[smallest] * MICRO:.2f} µs", f"{jet:.0f} m/s",
                f"{self.wall[peak] * MEGA:.1f} MPa at {self.time[peak] * MICRO:.2f} µs",
                f"{self.stress[axis] * MEGA:.1f} MPa, {(WALL - self.place[axis, 0]) * MILLI:.1f} mm deep",
                f"{self.deep.max() * MEGA:.1f} MPa",
                f"{self.stress[most] * MEGA:.0f} MPa at {self.solid_time[most] * MICRO:.1f} µs, r = {self.place[most, 1] * MILLI:.1f} mm",
                first_above]


@styled
def draw(columns):
    figure = Figure(figsize=(8.4, 6.4))
    axes = figure.subplots(3, 2, sharex=True, sharey="row",
                           gridspec_kw=dict(height_ratios=(1, 1.5, 1.5), hspace=0.08, wspace=0.05))
    for column, (title, runs) in zip(axes.T, columns):
        shades = mpl.colormaps["viridis"](np.linspace(0.85, 0.05, len(runs)))
        for run, colour in zip(runs, shades):
            line = dict(color=colour, linewidth=1, label=f"{run.cells} cells per radius")
            column[0].plot(run.time * MICRO, run.radius, **line)
            column[1].plot(run.time * MICRO, run.wall * MEGA, **line)
            column[2].plot(run.deep_time * MICRO, run.deep * MEGA, **line)
        column[0].set_title(title, fontsize=9)
        column[2].set(xlabel="$t$ / µs", xlim=(30, 65.7))
        column[2].axhline(STAINLESS * MEGA, color="0.5", linewidth=0.6, dashes=(4, 3))
    axes[0, 0].set(ylabel=r"$R_\mathrm{eq}\,/\,R$", ylim=(0, None))
    axes[1, 0].set_ylabel("wall pressure\non the axis / MPa")
    axes[2, 0].set(ylabel="von Mises stress\n2 mm below the wall / MPa", ylim=(0, 540))
    axes[2, 0].text(31, 506, "yield strength, stainless steel", fontsize=7, color="0.35")
    axes[1, 0].legend(frameon=False, fontsize=8, loc="upper left")
    figure.subplots_adjust(0.09, 0.075, 0.985, 0.955)
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--mixture", nargs="+", type=Histories, required=True, metavar="CELLS=DIR")
    parser.add_argument("--five", nargs="+", type=Histories, required=True, metavar="CELLS=DIR")
    options = parser.parse_args()
    columns = [("the paper's mixture", options.mixture), ("five-equation model", options.five)]
    save(draw(columns), options.out)
    print("| model | cells per radius | smallest R_eq | jet before that | wall pressure on the axis | σ_vM near the axis | 2 mm deep "
          "| σ_vM anywhere | above 502 MPa |\n|---|---|---|---|---|---|---|---|---|")
    for title, runs in columns:
        for run in runs:
            print(f"| {title} | " + " | ".join(run.row()) + " |")


if __name__ == "__main__":
    main()
