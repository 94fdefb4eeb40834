#!/usr/bin/env python3
"""What a cell and step of the five-equation model costs against the paper's mixture: docs/performance/two-phase.md.

    python3 scripts/model_cost.py [--levels 6 7] [--limiters mc minmod] [--pairs 4] [--uniform]

Runs the figures' case (cases/dickopp2012.toml, or --case) with both models at the same time, one thread each on a core of its
own, and once more with the cores exchanged: what else the machine does meets both alike. With --uniform all cells are of
the finest level and both models have the same. Prints the fluid's processor time per
cell and step of one over the other, the median and the range of the pairs, as Markdown. Needs two cores, Linux, and
scripts/requirements.txt.
"""

import math
import os
import statistics
import subprocess
import tempfile
from pathlib import Path

import pycav

import program

MODELS = ("five-equation", "saurel-abgrall")
# The same cells for both models: `--uniform`.
UNIFORM = {"fluid.adapt": "false", "solid.adapt": "false", "time.local_steps": "false"}
# The solid's levels beside the fluid's: it is not measured, and should not take long.
COARSER = 2


def start(options, model, levels, limiter, core, out):
    settings = {"fluid.model": model, "fluid.limiter": limiter, "fluid.levels": levels,
                "solid.levels": levels - COARSER, "time.snapshots": "[]"}
    if options.uniform:
        settings |= UNIFORM
    changes = [f"{key}={value}" for key, value in settings.items()]
    command = program.command(options.cav, options.case, out, changes, "--in-process")
    return subprocess.Popen(command, env=dict(os.environ, RAYON_NUM_THREADS="1"),
                            preexec_fn=lambda: os.sched_setaffinity(0, {core}))


def seconds_per_cell(out):
    summary = pycav.open(out).summary
    return summary["compute_seconds"]["fluid"] / summary["cell_updates"]["fluid"], summary["steps"]


def both(options, levels, limiter, cores, directory):
    """Seconds per cell and step of both models, run at once on the cores given, and their steps."""
    outs = [directory / model for model in MODELS]
    runs = [start(options, model, levels, limiter, core, out) for model, core, out in zip(MODELS, cores, outs)]
    if any([run.wait() for run in runs]):
        raise SystemExit("a run failed")
    return [seconds_per_cell(out) for out in outs]


def main():
    parser = program.parser(__doc__)
    parser.add_argument("--levels", type=int, nargs="+", default=[6, 7])
    parser.add_argument("--limiters", nargs="+", default=["mc", "minmod"])
    parser.add_argument("--pairs", type=int, default=4)
    parser.add_argument("--uniform", action="store_true")
    parser.add_argument("--case", type=Path, default=program.ROOT / "cases/dickopp2012.toml")
    options = parser.parse_args()
    cores = sorted(os.sched_getaffinity(0))[:2]
    print("| levels | limiter | five-equation | the paper's mixture | per cell and step, median (range) |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as directory:
        for levels in options.levels:
            for limiter in options.limiters:
                ratios, least, steps = [], [math.inf, math.inf], [0, 0]
                for _ in range(options.pairs):
                    ratio = 1.0
                    for order in (cores, cores[::-1]):
                        found = both(options, levels, limiter, order, Path(directory))
                        ratio *= math.sqrt(found[0][0] / found[1][0])
                        least = [min(one, time) for one, (time, _) in zip(least, found)]
                        steps = [number for _, number in found]
                    ratios.append(ratio)
                columns = [f"{1e9 * time:.0f} ns, {number} steps" for time, number in zip(least, steps)]
                print(f"| {levels} | `{limiter}` | {columns[0]} | {columns[1]} "
                      f"| {statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f}) |", flush=True)


if __name__ == "__main__":
    main()
