"""A lithotripter's pulse collapses a bubble above a rigid wall: pressures near the wall beside M2C's."""

import numpy as np

from .runs import run

SIDE, RADIUS = 8e-4, 5e-5
PROBES = ["axis", "half", "one"]  # at r = 0, 0.05 and 0.1 mm, 5 µm above the wall
ARRIVED = 1e7  # Pa: when the pulse is at the outermost probe
# M2C's test ShockBubbleCollapseWang17/Test1_PrescribedIC, commit aaf7017, results/pressure_probes.txt, 33 cells per radius:
# largest pressure before 0.2 µs, and in all, Pa; when, after the pulse's arrival at the outermost probe (0.1139 µs), s.
M2C = {"axis": (32.2e6, 352.7e6, 0.2349e-6), "half": (33.9e6, 309.8e6, 0.2422e-6), "one": (53.7e6, 233.0e6, 0.2594e-6)}
FIRST = 0.086e-6  # s after the arrival: until M2C's 0.2 µs


def table(options):
    print("| r | what | M2C, 33 cells per radius |", end="")
    cells = options.cells or [32, 64]
    print("".join(f" {n} |" for n in cells) + "\n|---|---|---|" + "---|" * len(cells))
    runs = [run(options, "shock-and-bubble", f"{n}", {"fluid.levels": round(np.log2(n * SIDE / RADIUS / 16))}) for n in cells]
    probes = [{name: (done.result.probes[name]["time"].to_numpy(), done.result.probes[name]["pressure"].to_numpy())
               for name in PROBES} for done in runs if done]
    arrivals = [found["one"][0][np.argmax(found["one"][1] > ARRIVED)] for found in probes]
    for name, place in zip(PROBES, ("0", "0.05 mm", "0.1 mm")):
        first, most, when = M2C[name]
        columns = ["", "", ""]
        for found, arrival in zip(probes, arrivals):
            time, pressure = found[name][0] - arrival, found[name][1]
            peak = pressure.argmax()
            columns[0] += f" {pressure[time < FIRST].max() / 1e6:.1f} MPa |"
            columns[1] += f" {pressure[peak] / 1e6:.0f} MPa |"
            columns[2] += f" {time[peak] * 1e6:.4f} µs |"
        print(f"| {place} | the pulse | {first / 1e6:.1f} MPa |{columns[0]}")
        print(f"| | the collapse | {most / 1e6:.0f} MPa |{columns[1]}")
        print(f"| | its time | {when * 1e6:.4f} µs |{columns[2]}")
    for done in runs:
        s = done.result.summary
        print(f"\nsmallest radius {s['min_equivalent_radius'] * 1e6:.2f} µm, jet {s['jet_velocity_peak']:.0f} m/s, "
              f"wall {s['wall_pressure_peak_interface'] / 1e6:.0f} MPa")
