#!/usr/bin/env python3
"""Bytes of memory per cell, for docs/performance: the peak of the program on a fine grid less that on a coarse one, by the cells.

    python3 scripts/memory.py [rest] [collapse] [load] [--coarser N]

- rest: the figures' fluid on uniform grids of 1024 x 1024 and 512 x 512 cells, some steps, no snapshot but the last, both two-phase models.
- collapse: its first 8 us above a rigid wall, adaptive, with its output, levels with steps of their own.
- load: steel under a pressure pulse, adaptive, six snapshots, with levels' own steps and without.

Peaks are those that the operating system tells of a process. Prints Markdown. Needs scripts/requirements.txt.
"""

import json
import subprocess
import tempfile
from pathlib import Path

import program

FIGURES = (program.ROOT / "cases/dickopp2012.toml").read_text()
LOAD = """
[time]
end = 4e-6
snapshots = [5e-7, 1e-6, 1.5e-6, 2e-6, 3e-6, 4e-6]
[solid]
z = [-0.04, 0.0]
r = [0.0, 0.04]
cells = [16, 16]
material = "structural-steel"
[coupling]
scheme = "load"
[coupling.load]
amplitude = 1e8
radius = 2e-3
history = [[0.0, 0.0], [3e-7, 1.0], [6e-7, 0.0]]
"""
UNIFORM = {"coupling.scheme": "rigid", "fluid.adapt": "false", "time.local_steps": "false", "time.snapshots": "[]",
           "time.end": "2e-8", "fluid.cells": "[16, 16]"}
COLLAPSE = {"coupling.scheme": "rigid", "time.end": "8e-6", "time.local_steps": "true",
            "time.snapshots": "[2e-6, 4e-6, 6e-6, 8e-6]"}
# What is run: its name, the case, its changes, and the key and the values of the coarse and the fine grid's levels.
RUNS = {
    "rest": [
        ("fluid, five-equation", FIGURES, UNIFORM | {"fluid.model": "five-equation"}, "fluid.levels", (5, 6)),
        ("fluid, the paper's mixture", FIGURES, UNIFORM | {"fluid.model": "saurel-abgrall"}, "fluid.levels", (5, 6)),
    ],
    "collapse": [("fluid, five-equation, adaptive", FIGURES, COLLAPSE | {"fluid.model": "five-equation"}, "fluid.levels", (7, 9))],
    "load": [
        (f"solid, adaptive, {name}", LOAD, {"time.local_steps": value}, "solid.levels", (4, 6))
        for name, value in (("own steps", "true"), ("one step", "false"))
    ],
}


def peak(cav, case, changes, directory):
    """Bytes at the most, and the most cells, of a run."""
    path, out = directory / "case.toml", directory / "run"
    path.write_text(case)
    command = program.command(cav, path, out, [f"{key}={value}" for key, value in changes.items()], "--in-process")
    _, used = program.usage(command, stderr=subprocess.DEVNULL)
    cells = json.loads((out / "summary.json").read_text())["cells"]
    return 1024 * used.ru_maxrss, sum(side["largest"] for side in cells.values())


def main():
    parser = program.parser(__doc__)
    parser.add_argument("which", nargs="*", metavar="rest | collapse | load", help="what is run, by default all")
    parser.add_argument("--coarser", type=int, default=0, help="so many levels less")
    options = parser.parse_args()
    if unknown := [name for name in options.which if name not in RUNS]:
        parser.error(f"{unknown[0]}: none of {', '.join(RUNS)}")
    print("| | cells | bytes per cell |\n|---|---|---|")
    for name, case, changes, key, levels in (run for which in options.which or RUNS for run in RUNS[which]):
        with tempfile.TemporaryDirectory() as directory:
            (few, coarse), (much, fine) = (
                peak(options.cav, case, changes | {key: level - options.coarser}, Path(directory)) for level in levels
            )
        print(f"| {name} | {coarse:,} and {fine:,} | {(much - few) / (fine - coarse):.0f} |", flush=True)


if __name__ == "__main__":
    main()
