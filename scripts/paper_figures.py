#!/usr/bin/env python3
"""The paper's kinds of pictures from a run, as docs/verification/paper-figures.md shows them.

    python3 scripts/paper_figures.py RUN_DIR OUT_DIR [--all] [--only NAME] [--numbers]

Draws the paper's figures 5 to 21 at the snapshots nearest to its times, the levels of refinement, pathlines (with 40
snapshots or more) and histories, and prints what can be read off them. With --all every kind at every snapshot instead.
Times and windows scale with the bubble's radius (the paper's figures: 10 mm). Needs scripts/requirements.txt.
"""

import argparse
import sys
from functools import partial
from pathlib import Path

from pycav import plot

from paper.head_waves import head_waves
from paper.picture_file import save
from paper.readings import report
from paper.study import MICRO, Study
from paper.wall_front import wall_front

STEELS = {"structural steel": 250e6, "stainless steel": 502e6}
SOFT = {"aluminium": 95e6, "copper": 70e6}


def of_result(draw, **options):
    """A kind of picture that is one of pycav's."""
    return lambda study, time, window: draw(study.result, time=time, window=window, **options)


def interface(what, reach):
    """What has to be continuous, and up to `reach` radii off the wall along the axis."""
    return lambda study, time, window: plot.interface_continuity(
        study.result, time, window, what=[what], reach=reach * study.radius)


def yielding(materials):
    return of_result(plot.yield_function, yield_strength=list(materials.values()), names=list(materials),
                     one_scale=False)


KINDS = {
    "schlieren": of_result(plot.schlieren), "streamlines": of_result(plot.streamlines), "headwaves": head_waves,
    "velocity": interface("velocity", 0.1),
    "pressure": interface("stress", 0.6), "levels": of_result(plot.grid_levels),
    "bubble": of_result(plot.close_up), "yield": yielding(STEELS), "yield-soft": yielding(SOFT),
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


def pathlines(study, spacing, substeps):
    return plot.pathlines(study.result, study.window(WIDE), spacing=spacing * study.radius, substeps=substeps)


def histories(study):
    probes = [name for name in study.result.probes if name == "solid-2mm"]
    return plot.histories(study.result, theory=False, yield_strength=list(STEELS.values()), probes=probes, place=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("run", type=Path, metavar="RUN_DIR", help="directory of a coupled run")
    parser.add_argument("out", type=Path, metavar="OUT_DIR", help="directory for the pictures")
    parser.add_argument("--all", action="store_true", help="every kind at every snapshot instead")
    parser.add_argument("--only", metavar="NAME", help="only pictures whose name contains this, and no numbers")
    parser.add_argument("--spacing", type=float, default=0.2, metavar="RADII", help="of the pathlines' starts")
    parser.add_argument("--substeps", type=int, default=16, help="of pathlines from snapshot to snapshot")
    parser.add_argument("--numbers", action="store_true", help="with --only the numbers, too")
    arguments = parser.parse_args()
    study = Study(arguments.run)
    arguments.out.mkdir(parents=True, exist_ok=True)

    figures = FIGURES
    if arguments.all:
        windows = dict.fromkeys(KINDS, WIDE)
        windows |= {"yield": DEEP, "yield-soft": DEEPER, "headwaves": HEAD, "bubble": BUBBLE}
        figures = [(f"{time * MICRO:05.2f}us", kind, time * MICRO / study.slowness, windows[kind])
                   for time in study.result.fluid.times for kind in KINDS]
    for name, kind, microseconds, window in figures:
        time = study.time_of(microseconds)
        file = f"{name}.png" if name == kind else f"{name}-{kind}.png"
        if arguments.only and arguments.only not in file:
            continue
        if time is None:
            print(f"{file}: left out, no snapshot near {microseconds * study.slowness:g} µs", file=sys.stderr)
            continue
        save(KINDS[kind](study, time, study.window(window)), arguments.out / file)
    lines = partial(pathlines, spacing=arguments.spacing, substeps=arguments.substeps)
    for file, draw in (("pathlines.png", lines), ("histories.png", histories), ("wall-front.png", wall_front)):
        if arguments.only and arguments.only not in file:
            continue
        if file == "pathlines.png" and len(study.result.fluid.times) < 40:
            print(f"{file}: left out, needs 40 snapshots or more", file=sys.stderr)
            continue
        save(draw(study), arguments.out / file)
    if arguments.numbers or not arguments.only:
        report(study, {figure[2] for figure in FIGURES})


if __name__ == "__main__":
    main()
