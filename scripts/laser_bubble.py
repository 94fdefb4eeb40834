#!/usr/bin/env python3
"""A laser bubble from growth to its second collapse beside Gilmore's equation, as docs/theory/bubble-content.md shows it.

    python3 scripts/laser_bubble.py [--cells 16 32] [--picture docs/images/laser-bubble.png]

Runs what `cav new laser --stand-off 0` writes (half a bubble on a plane of symmetry: a free one) by `cav`
(target/release/cav, or --cav) in a directory of its own (--out), keeps what is complete, and prints Markdown. Needs
scripts/requirements.txt.
"""

import subprocess
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from published.spherical import gilmore

import program

RADIUS, EQUILIBRIUM, LEFT, PRESSURE, DENSITY = 20e-6, 184.1e-6, 64e-6, 1e5, 1000.0
PI = 3e8


def by_gilmore():
    """Times and radii, s and m: growth with all of the gas, then from rest at the largest radius with what is left."""
    def gas(rest, radius):
        return PRESSURE * (rest / radius) ** 4.2

    time, radius = gilmore(RADIUS, gas(EQUILIBRIUM, RADIUS), PRESSURE, DENSITY, 60e-6, stiffness=PI)
    k = int(radius.argmax())
    after, later = gilmore(radius[k], gas(LEFT, radius[k]), PRESSURE, DENSITY, 85e-6, stiffness=PI)
    return np.append(time[:k], time[k] + after), np.append(radius[:k], later)


def turns(time, radius):
    """Largest, smallest, rebound, second collapse: row after row."""
    a = int(radius.argmax())
    half = a + int(np.argmax(radius[a:] < 0.5 * radius[a]))
    rise = half + int(np.argmax(np.diff(radius[half:]) > 0))
    b = half + int(radius[half:rise + 2].argmin())
    turned = b + 1 + np.flatnonzero(radius[b + 1:] < np.maximum.accumulate(radius[b + 1:]) * 0.98)
    c = b + int(radius[b:turned[0] + 1].argmax()) if len(turned) else b + int(radius[b:].argmax())
    d = c + int(radius[c:].argmin())
    # What has not risen again has not collapsed.
    return a, b, c, d if radius[d:].max() > 1.02 * radius[d] else None


def row(name, time, radius):
    def told(k):
        return "–" if k is None else f"{radius[k] * 1e6:.1f} µm at {time[k] * 1e6:.1f} µs"

    print(f"| {name} | " + " | ".join(told(k) for k in turns(time, radius)) + " |", flush=True)


def run(options, cells):
    """Time and radius of a ball of twice the volume: half of the bubble is there."""
    case = subprocess.run([str(options.cav), "new", "laser", "--stand-off", "0", "--cells-per-radius", str(cells)],
                          check=True, capture_output=True, text=True).stdout
    result, code = program.solve(options, f"laser-{cells}", case, [], "--threads", "1")
    if code:
        raise SystemExit(f"laser-{cells}: exit code {code}")
    history = result.histories
    radius = np.cbrt(2.0) * history["bubble/equivalent_radius"].to_numpy()
    return history["time"].to_numpy(), radius, result.summary


def picture(path, exact, runs):
    figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
    axes.plot(exact[0] * 1e6, exact[1] * 1e6, "k--", linewidth=1.0, label="Gilmore, cut at the largest radius")
    for cells, (time, radius) in runs.items():
        axes.plot(time * 1e6, radius * 1e6, linewidth=1.2, label=f"{cells} cells per present radius")
    axes.set(xlabel="t, µs", ylabel="R, µm", xlim=(0, None), ylim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


def main():
    arguments = program.parser(__doc__, "laser")
    arguments.add_argument("--cells", type=int, nargs="+", default=[16, 32], help="cells along the present radius")
    arguments.add_argument("--picture", type=Path, help="picture of R(t) to write")
    options = arguments.parse_args()
    print("| | largest | smallest | rebound | second collapse |\n|---|---|---|---|---|")
    exact, runs = by_gilmore(), {}
    row("Gilmore", *exact)
    for cells in options.cells:
        time, radius, summary = run(options, cells)
        runs[cells] = time, radius
        row(f"{cells} cells", time, radius)
        most = summary["cells"]["fluid"]["largest"]
        print(f"{cells} cells: {most} cells at the most, {summary['wall_seconds']:.0f} s", flush=True)
    if options.picture:
        picture(options.picture, exact, runs)


if __name__ == "__main__":
    main()
