#!/usr/bin/env python3
"""A laser bubble from growth to its second collapse beside others' radii, as docs/theory/bubble-content.md shows it.

    python3 scripts/laser_bubble.py [--bubble lechner] [--cells 16 32]     20 µm to half a millimetre, beside Gilmore's equation
    python3 scripts/laser_bubble.py --bubble liang [--cells 16 32]         1.33 to 36 µm, beside a published R(t)

Runs what `cav new laser --stand-off 0` writes (half a bubble on a plane of symmetry: a free one) by `cav`
(target/release/cav, or --cav) in a directory of its own (--out), with changes given by --set, keeps what is complete, and prints
Markdown. Draws the radii with --picture. Needs scripts/requirements.txt.
"""

import subprocess
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from published.spherical import gilmore

import program

SYMMETRY = {"coupling.scheme": '"none"', "fluid.boundary": '{ z_min = "symmetry" }'}


@dataclass
class Bubble:
    """Radii of start, gas and of what is left of it, m; exponents and stiffness; what the case is changed by."""

    start: float
    equilibrium: float
    left: float
    gas_gamma: float = 1.4
    changes: dict = field(default_factory=dict)
    published: Path | None = None


BUBBLES = {
    "lechner": Bubble(20e-6, 184.1e-6, 64e-6),
    # Table 1 of Liang et al. (2022): a femtosecond laser's. Their gas has a hard core after its cut, which an ideal one has not.
    "liang": Bubble(1.33e-6, 13.718e-6, 3.615e-6, 4 / 3, SYMMETRY | {
        "fluid.liquid.gamma": 7.0, "fluid.liquid.pi": 3.14e8, "fluid.ambient.density": 998.0, "fluid.gas.gamma": 4 / 3,
        "fluid.terms": "{ surface_tension = 0.073, viscosity = { liquid = 1e-3, gas = 0.0 } }",
        "time.end": 9.3e-6, "time.snapshots": "[3.2e-6, 6.4e-6]",
    }, Path(__file__).with_name("published") / "liang_2022_radius.csv"),
}
PRESSURE, DENSITY, PI = 1e5, 1000.0, 3e8


def by_gilmore(bubble):
    """Times and radii, s and m: growth with all of the gas, then from rest at the largest radius with what is left."""
    def gas(rest, radius):
        return PRESSURE * (rest / radius) ** (3 * bubble.gas_gamma)

    time, radius = gilmore(bubble.start, gas(bubble.equilibrium, bubble.start), PRESSURE, DENSITY, 60e-6, stiffness=PI)
    k = int(radius.argmax())
    after, later = gilmore(radius[k], gas(bubble.left, radius[k]), PRESSURE, DENSITY, 85e-6, stiffness=PI)
    return np.append(time[:k], time[k] + after), np.append(radius[:k], later)


def turns(time, radius):
    """Largest, smallest, rebound, second collapse: row after row, None for what has not come yet."""
    a = int(radius.argmax())
    if not (radius[a:] < 0.5 * radius[a]).any():
        return a, None, None, None
    half = a + int(np.argmax(radius[a:] < 0.5 * radius[a]))
    rise = half + int(np.argmax(np.diff(radius[half:]) > 0))
    b = half + int(radius[half:rise + 2].argmin())
    turned = b + 1 + np.flatnonzero(radius[b + 1:] < np.maximum.accumulate(radius[b + 1:]) * 0.98)
    c = b + int(radius[b:turned[0] + 1].argmax()) if len(turned) else b + int(radius[b:].argmax())
    again = c + 1 + np.flatnonzero(radius[c + 1:] > 1.02 * np.minimum.accumulate(radius[c + 1:]))
    # What has not risen again has not collapsed.
    return a, b, c, c + int(radius[c:again[0]].argmin()) if len(again) else None


def row(name, time, radius):
    def told(k):
        return "–" if k is None else f"{radius[k] * 1e6:.4g} µm at {time[k] * 1e6:.4g} µs"

    print(f"| {name} | " + " | ".join(told(k) for k in turns(time, radius)) + " |", flush=True)


def run(options, cells):
    """Time and radius of a ball of twice the volume: half of the bubble is there."""
    bubble = BUBBLES[options.bubble]
    radii = {"--radius": bubble.start, "--equilibrium-radius": bubble.equilibrium, "--left-radius": bubble.left}
    given = [part for name, radius in radii.items() for part in (name, f"{radius * 1e9:.0f}nm")]
    case = subprocess.run([str(options.cav), "new", "laser", "--stand-off", "0", "--cells-per-radius", str(cells), *given],
                          check=True, capture_output=True, text=True).stdout
    changes = [f"{key}={value}" for key, value in bubble.changes.items()] + options.set
    result, code = program.solve(options, f"{options.bubble}-{cells}", case, changes, "--threads", "1")
    if code:
        raise SystemExit(f"{options.bubble}-{cells}: exit code {code}")
    history = result.histories
    radius = np.cbrt(2.0) * history["bubble/equivalent_radius"].to_numpy()
    return history["time"].to_numpy(), radius, result.summary


def picture(path, exact, others, runs):
    figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
    if exact is not None:
        axes.plot(exact[0] * 1e6, exact[1] * 1e6, "k--", linewidth=1.0, label="Gilmore, cut at the largest radius")
    if others is not None:
        axes.plot(others[0] * 1e6, others[1] * 1e6, "k.", markersize=4.0, label="Liang et al. (2022)")
    for cells, (time, radius) in runs.items():
        axes.plot(time * 1e6, radius * 1e6, linewidth=1.2, label=f"{cells} cells per present radius")
    axes.set(xlabel="t, µs", ylabel="R, µm", xlim=(0, None), ylim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(path, dpi=110)


def main():
    arguments = program.parser(__doc__, "laser")
    arguments.add_argument("--bubble", choices=BUBBLES, default="lechner", help="whose bubble")
    arguments.add_argument("--cells", type=int, nargs="+", default=[16, 32], help="cells along the present radius")
    arguments.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a change of every case")
    arguments.add_argument("--picture", type=Path, help="picture of R(t) to write")
    options = arguments.parse_args()
    bubble = BUBBLES[options.bubble]
    print("| | largest | smallest | rebound | second collapse |\n|---|---|---|---|---|")
    exact = others = None
    if bubble.published:
        others = np.loadtxt(bubble.published, delimiter=",", skiprows=4, unpack=True) * 1e-6
        row("Liang et al. (2022)", *others)
    else:
        exact = by_gilmore(bubble)
        row("Gilmore", *exact)
    runs = {}
    for cells in options.cells:
        time, radius, summary = run(options, cells)
        runs[cells] = time, radius
        row(f"{cells} cells", time, radius)
        most, updates = summary["cells"]["fluid"]["largest"], summary["cell_updates"]["fluid"]
        seconds = sum(summary["compute_seconds"].values())
        print(f"{cells} cells: {most} cells at the most, {updates:.2g} updates, {seconds:.0f} s of a processor", flush=True)
    if options.picture:
        picture(options.picture, exact, others, runs)


if __name__ == "__main__":
    main()
