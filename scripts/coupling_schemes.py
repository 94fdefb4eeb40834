#!/usr/bin/env python3
"""The paper's coupling schemes and its factors on the figures' case: what each does to the numbers, and its errors (33).

    python3 scripts/coupling_schemes.py [--cfl 0.45 0.098] [--set KEY=VALUE ...] [--out DIR] [--cav PATH]

Runs cases/dickopp2012-coarse.toml (256² cells each, one step for both sides) with every scheme and prints Markdown. The errors are
those of the paper's (33): ε_k = v_z of the fluid's cell on the axis next to the interface less that of the solid's, ε_d = −p − σ_zz
there; root mean squares from 48 to 56 µs, in which the water hammer's shock passes. A Courant number of 0.098 in the solid is
that of the paper's Δt = 10⁻¹⁰ s on its finest grid. Needs scripts/requirements.txt.
"""

import subprocess
from pathlib import Path

import numpy as np
import pycav

import program

SCHEMES = {
    "`riemann`": [],
    "`explicit`": ["coupling.scheme=explicit"],
    "`weak`": ["coupling.scheme=weak"],
    "`weak`, solid first": ["coupling.scheme=weak", "coupling.first=solid"],
    "`weak`, κ on the jump": ["coupling.scheme=weak", "coupling.kappa=jump"],
    "`weak`, κ as printed": ["coupling.scheme=weak", "coupling.kappa=printed"],
    "`strong`": ["coupling.scheme=strong"],
    "`strong`, solid first": ["coupling.scheme=strong", "coupling.first=solid"],
}
WINDOW = 48e-6, 56e-6
WALL, CELL = 0.01, 0.05 / 256
PROBES = [("above", WALL + 0.5 * CELL, "fluid"), ("below", WALL - 0.5 * CELL, "solid"), ("deep", WALL - 2e-3, "solid")]


def run(options, cfl, changes):
    """Runs a case unless it is there, as far as it goes; returns its result."""
    directory = options.out / f"{cfl}-{'-'.join(change.split('=')[1] for change in changes) or 'riemann'}"
    if not (directory / "summary.json").exists():
        probes = ", ".join(f'{{ name = "{name}", position = [{z!r}, {0.5 * CELL!r}], medium = "{medium}" }}'
                           for name, z, medium in PROBES)
        sets = [f"time.cfl={cfl}", "coupling.step_ratio=1", f"probe=[{probes}]", *changes, *options.set]
        command = program.command(options.cav, options.case, directory, sets, "--in-process", "--threads", "1")
        subprocess.run(command, check=False)
    return pycav.open(directory)


def row(result):
    summary, above, deep = result.summary, result.probes["above"], float(result.probes["deep"]["von_mises"].max())
    below = result.probes["below"].interp(time=above["time"], kwargs={"fill_value": "extrapolate"})
    during = (above["time"] > WINDOW[0]) & (above["time"] < WINDOW[1])
    kinematic = (above["velocity_z"] - below["velocity_z"])[during].to_numpy()
    dynamic = (-above["pressure"] - below["stress_zz"])[during].to_numpy()
    ended = "" if summary["completed"] else f", failed at {summary['t_end'] * 1e6:.1f} µs"
    sizes = [f"{np.sqrt(np.mean(error**2)) / unit:.3g}" if error.size else "–"
             for error, unit in ((kinematic, 1.0), (dynamic, 1e6))]
    iterations = summary.get("coupling_iterations", {}).get("mean")
    return [f"{summary['wall_pressure_peak'] / 1e6:.1f}{ended}", f"{summary['von_mises_peak'] / 1e6:.1f}", f"{deep / 1e6:.1f}",
            *sizes, f"{iterations:.2f}" if iterations else "–"]


def main():
    parser = program.parser(__doc__, "coupling-schemes")
    parser.add_argument("--cfl", type=float, nargs="+", default=[0.45, 0.098])
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a change of every run")
    parser.add_argument("--case", type=Path, default=program.ROOT / "cases/dickopp2012-coarse.toml")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    for cfl in options.cfl:
        print(f"\nCourant number {cfl}\n\n| scheme | wall pressure, MPa | largest σ_vM, MPa | σ_vM 2 mm below the wall, MPa "
              "| ε_k, m/s | ε_d, MPa | iterations a step |\n|---|---|---|---|---|---|---|")
        for name, changes in SCHEMES.items():
            print(f"| {name} | " + " | ".join(row(run(options, cfl, changes))) + " |", flush=True)


if __name__ == "__main__":
    main()
