#!/usr/bin/env python3
"""The paper's kinds of pictures from a run, as docs/paper.md shows them.

    python3 scripts/paper_figures.py RUN_DIR OUT_DIR [--all] [--only NAME]

Draws the paper's figures 5 to 21 at the snapshots nearest to its times, the levels of refinement, pathlines (with 40
snapshots or more) and histories, and prints what can be read off them. With --all every kind at every snapshot instead.
Times and windows scale with the bubble's radius (the paper's figures: 10 mm). Needs scripts/requirements.txt.
"""

import argparse
import sys
from pathlib import Path

from across_interface import pressure, velocity
from bubble_close_up import close_up
from drawing import save, style
from flow_lines import pathlines, streamlines
from grid_levels import levels
from histories import histories
from readings import report
from run_directory import MICRO, Run
from wall_front import wall_front
from waves import headwaves, schlieren
from yielding import SOFT, STEELS, yielding

KINDS = {
    "schlieren": schlieren, "streamlines": streamlines, "headwaves": headwaves, "velocity": velocity,
    "pressure": pressure, "levels": levels, "bubble": close_up,
    "yield": lambda run, time, window: yielding(run, time, window, STEELS),
    "yield-soft": lambda run, time, window: yielding(run, time, window, SOFT),
}
# Windows (z from, z to, r up to) in radii of the bubble, z counted from the wall.
WIDE, CLOSE, DEEP, DEEPER = (-4.5, 4.5, 4.5), (-1.5, 3.0, 2.25), (-3.5, 0.0, 3.5), (-3.0, 0.0, 3.0)
HEAD, BUBBLE, COLLAPSED = (-1.5, 1.5, 4.6), (0.78, 2.22, 0.48), (1.5, 2.25, 0.25)
# Number in the paper (or a name), kind, time in µs with R = 10 mm, window.
FIGURES = [
    ("fig05", "schlieren", 16.6, WIDE), ("fig06", "streamlines", 16.6, WIDE),
    ("fig07", "schlieren", 33.1, WIDE), ("fig08", "streamlines", 33.1, WIDE),
    ("fig09", "schlieren", 40.0, CLOSE), ("fig10", "streamlines", 40.0, CLOSE),
    ("fig11", "schlieren", 50.0, CLOSE), ("fig12", "streamlines", 50.0, CLOSE),
    ("fig13", "schlieren", 65.7, CLOSE), ("fig14", "streamlines", 65.7, CLOSE),
    ("fig15", "velocity", 65.7, WIDE), ("fig16", "pressure", 65.7, WIDE),
    ("fig17", "yield", 50.0, DEEP), ("fig18", "yield", 52.0, DEEP),
    ("fig19", "yield", 54.0, DEEP), ("fig20", "yield", 56.0, DEEP), ("fig21", "yield-soft", 50.0, DEEPER),
    ("extra-52us", "schlieren", 52.0, CLOSE), ("extra-56us", "schlieren", 56.0, CLOSE),
    ("extra-16us", "headwaves", 16.6, HEAD), ("extra-40us", "bubble", 40.0, COLLAPSED),
    ("extra-50us", "bubble", 50.0, BUBBLE), ("extra-66us", "bubble", 65.7, BUBBLE),
    ("levels", "levels", 50.0, WIDE),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="directory of a coupled run")
    parser.add_argument("out", type=Path, metavar="OUT_DIR", help="directory for the pictures")
    parser.add_argument("--all", action="store_true", help="every kind at every snapshot instead")
    parser.add_argument("--only", metavar="NAME", help="only pictures whose name contains this, and no numbers")
    arguments = parser.parse_args()
    run = Run(arguments.run)
    arguments.out.mkdir(parents=True, exist_ok=True)
    style()

    figures = FIGURES
    if arguments.all:
        windows = dict.fromkeys(KINDS, WIDE)
        windows |= {"yield": DEEP, "yield-soft": DEEPER, "headwaves": HEAD, "bubble": BUBBLE}
        figures = [(f"{time * MICRO:05.2f}us", kind, time * MICRO / run.slowness, windows[kind])
                   for time in run.fluid.times for kind in KINDS]
    for name, kind, microseconds, window in figures:
        time = run.time_of(microseconds)
        file = f"{name}.png" if name == kind else f"{name}-{kind}.png"
        if arguments.only and arguments.only not in file:
            continue
        if time is None:
            print(f"{file}: left out, no snapshot near {microseconds * run.slowness:g} µs", file=sys.stderr)
            continue
        save(KINDS[kind](run, time, window), arguments.out / file)
    for file, draw in (("pathlines.png", lambda run: pathlines(run, WIDE)), ("histories.png", histories),
                       ("wall-front.png", wall_front)):
        if arguments.only and arguments.only not in file:
            continue
        if file == "pathlines.png" and len(run.fluid.times) < 40:
            print(f"{file}: left out, needs 40 snapshots or more", file=sys.stderr)
            continue
        save(draw(run), arguments.out / file)
    if not arguments.only:
        report(run, {figure[2] for figure in FIGURES})


if __name__ == "__main__":
    main()
