#!/usr/bin/env python3
"""Pits and plastic strains that others have published or computed, beside this program's: docs/verification/pits.md's tables.

    python3 scripts/published_pits.py [plateau] [loads] [ratios] [--out DIR] [--cells 20] [--limiter mc] [--levels 4]
        [--first ROWS]

plateau: depth over the duration of the load, which Chahine finds to be the same above 2 us. loads: pits under Gaussian loads by
an independent finite-element program. ratios: a jet's plastic strain and zone over those of a shock, after Joshi.
Without names all three are made. Prints Markdown. Runs that lie in DIR are made again. Needs pycav (scripts/requirements.txt).
"""

import argparse
import sys
from pathlib import Path

import numpy as np
import pycav

from program import fixed

ROOT = Path(__file__).resolve().parents[1]
REACH = 12.8  # of the solid, over the load's radius: 4 x 4 coarsest blocks with 20 cells to it, 2 x 2 with 10

# Density (kg/m3), Young's modulus (Pa), Poisson's ratio; [solid.plasticity].
BILINEAR_7075 = ({"density": 2810.0, "young": 71.7e9, "poisson": 0.33},
                 {"law": "linear", "yield_strength": 503e6, "hardening_modulus": 670e6})
BILINEAR_6061 = ({"density": 2779.0, "young": 69.6e9, "poisson": 0.33},
                 {"law": "linear", "yield_strength": 292e6, "hardening_modulus": 674e6})
COPPER = ({"density": 8960.0, "young": 124e9, "poisson": 0.34},
          {"law": "johnson-cook", "yield_strength": 90e6, "hardening_modulus": 292e6, "hardening_exponent": 0.31})
DUPLEX = ({"density": 7805.0, "young": 186e9, "poisson": 0.3},
          {"law": "johnson-cook", "yield_strength": 508e6, "hardening_modulus": 832e6, "hardening_exponent": 0.51})


def with_rate(solid, coefficient):
    """The same with the factor 1 + C ln(rate / (1/s)) (Johnson and Cook 1983)."""
    material, law = solid
    return material, law | {"rate_coefficient": coefficient, "reference_rate": 1.0}


# Name, solid, P0 (Pa), dr (m), dt (s); by the finite elements: depth (um), radius at half depth (um), largest plastic strain.
LOADS = [
    ("Al 7075, bilinear", BILINEAR_7075, 1.5e9, 1e-4, 1e-7, (2.31, 52.2, 3.21e-2)),
    ("Al 7075, bilinear", BILINEAR_7075, 1.5e9, 1e-4, 5e-8, (2.39, 52.8, 3.32e-2)),
    ("Al 7075, bilinear", BILINEAR_7075, 1.5e9, 1e-4, 5e-7, (1.39, 47.3, 2.28e-2)),
    ("Al 7075, bilinear", BILINEAR_7075, 1.5e9, 1e-4, 2e-6, (1.31, 46.8, 2.20e-2)),
    ("Al 7075, bilinear", BILINEAR_7075, 2.0e9, 1e-4, 5e-7, (7.8, 53.4, 9.2e-2)),
    ("Al 6061-T6, bilinear", BILINEAR_6061, 1.0e9, 1e-4, 1e-7, (2.85, 54.8, 3.40e-2)),
    ("Al 6061-T6, bilinear", BILINEAR_6061, 1.0e9, 1e-4, 2e-6, (1.71, 50.3, 2.40e-2)),
    ("copper, no rate", COPPER, 0.5e9, 1e-4, 1e-7, (1.10, 60.4, 1.15e-2)),
    ("copper, C = 0.025", with_rate(COPPER, 0.025), 0.5e9, 1e-4, 1e-7, (0.547, 59.8, 6.35e-3)),
    ("2205, no rate", DUPLEX, 1.5e9, 1e-4, 1e-7, (0.698, 52.7, 9.92e-3)),
    ("2205, C = 0.031", with_rate(DUPLEX, 0.031), 1.5e9, 1e-4, 1e-7, (0.148, 44.3, 3.39e-3)),
    ("2205, no rate", DUPLEX, 3.0e9, 5e-5, 5e-8, (6.65, 29.1, 0.140)),
    ("2205, C = 0.031", with_rate(DUPLEX, 0.031), 3.0e9, 5e-5, 5e-8, (2.37, 29.9, 5.01e-2)),
]

DURATIONS = [1e-7, 2e-7, 5e-7, 1e-6, 2e-6, 5e-6, 1e-5]  # s
# Chahine's amplitude, which is hardly above first yield (0.91 GPa), and one that leaves a pit worth the name.
AMPLITUDES = [1.0e9, 1.5e9]  # Pa

BUBBLE = 1e-4  # m
PULSE = 1e8  # Pa
MEASURES = ["plastic_strain_peak", "plastic_volume", "plastic_volume_2e-3"]
JETS, SHOCKS = [0.9, 1.1], [1.5, 2.0]  # stand-offs, centre to wall, over the bubble's radius


def say(*words):
    print(*words, file=sys.stderr, flush=True)


def gaussian_case(solid, amplitude, radius, duration, cells, limiter):
    """A solid alone under P0 exp(-(r/dr)^2) exp(-((t - 3 dt)/dt)^2), with so many cells to dr within 2.4 dr.

    The load ends at 6 dt, with exp(-9) of P0; the run when the surface is still.
    """
    material, law = solid
    times = np.linspace(0.0, 6.0 * duration, 241)
    factors = np.exp(-((times / duration - 3.0) ** 2))
    factors[[0, -1]] = 0.0
    reach, levels = REACH * radius, 2
    coarsest = round(REACH * cells) >> levels
    within = {"shape": "box", "z": [-2.4 * radius, 0.0], "r": [0.0, 2.4 * radius], "at_least": levels}
    beyond = {"shape": "outer", "centre": [0.0, 0.0], "radius": 3.0 * radius}
    return pycav.Case.from_dict({
        "time": {"end": "settled", "longest": 6.0 * duration + 30.0 * reach / 3000.0},
        "solid": {"z": [-reach, 0.0], "r": [0.0, reach], "cells": [coarsest, coarsest], "levels": levels, "error": 1e-3,
                  "limiter": limiter, "refine": [within, beyond], "material": material, "plasticity": law},
        "coupling": {"scheme": "load", "load": {"amplitude": amplitude, "radius": radius,
                                                "history": np.column_stack([times, factors]).tolist()}},
    }, "load")


def pit(options, solid, amplitude, radius, duration):
    """The summary of a run under such a load."""
    out = options.out / f"{solid[0]['density']:g}-{solid[1].get('rate_coefficient', 0):g}-{amplitude:g}-{radius:g}-{duration:g}"
    case = gaussian_case(solid, amplitude, radius, duration, options.cells, options.limiter)
    summary = pycav.run(case, out, force=True).summary
    say(out.name, f"{summary['wall_seconds']:.0f} s, still {summary['surface_still']:.1e}, settled {summary['settled']}")
    return summary


def plateau(options):
    """Depth in um of the pit on Al 7075 over dt, dr = 100 um.

    After Chahine, in Kim, Chahine, Franc and Karimi (eds., 2014), ch. 6, Fig. 6.28: the same for all dt above 2 us. Other than
    there: a half-space, not 5 mm; the pulse's exponents and the aluminium's constants are as others cite them.
    """
    print("| Δt, µs | " + " | ".join(f"{1e-9 * amplitude:g} GPa: depth, µm | largest ε_p" for amplitude in AMPLITUDES) + " |")
    print("|---" * (2 * len(AMPLITUDES) + 1) + "|")
    for duration in DURATIONS[: options.first]:
        found = [pit(options, BILINEAR_7075, amplitude, 1e-4, duration) for amplitude in AMPLITUDES]
        columns = " | ".join(f"{1e6 * s['pit_depth_axis']:.3g} | {s['plastic_strain_peak']:.3g}" for s in found)
        print(f"| {1e6 * duration:g} | {columns} |", flush=True)


def loads(options):
    """Depth, half radius, largest plastic strain beside those of the finite elements.

    Those have 10 elements to dr, depths 20 where there are, and an error of about 2 %. Other than there: depths are below the mean of the
    outer tenth of 12.8 dr instead of below the surface at 16 dr.
    """
    print("| material | P₀, GPa | Δr, µm | Δt, µs | depth, µm | radius at half depth, µm | largest ε_p |")
    print("|---|---|---|---|---|---|---|")
    for name, solid, amplitude, radius, duration, expected in LOADS[: options.first]:
        summary = pit(options, solid, amplitude, radius, duration)
        found = 1e6 * summary["pit_depth"], 1e6 * (summary["pit_radius"] or np.nan), summary["plastic_strain_peak"]
        pairs = " | ".join(f"{a:.3g} / {b:.3g} ({fixed(100 * (a / b - 1), '+.1f')} %)" for a, b in zip(found, expected))
        print(f"| {name} | {1e-9 * amplitude:g} | {1e6 * radius:g} | {1e6 * duration:g} | {pairs} |", flush=True)


def bubble_case(stand_off, levels):
    """A bubble above duplex 2205 that a plane pulse meets: 20 ns of rise, then 1 us of 100 MPa, from z_max.

    The run ends before what r_max, a plane of symmetry, sends back of the shock comes to the axis again, at 1.2 us.
    """
    width = 8.0 * BUBBLE
    grid = {"r": [0.0, width], "cells": [16, 16], "levels": levels}
    material, law = with_rate(DUPLEX, 0.031)
    return pycav.Case.from_dict({
        "time": {"end": 1.1e-6},
        "fluid": grid | {
            "z": [0.0, width], "liquid": {"gamma": 7.15, "pi": 3e8}, "gas": {"gamma": 1.4},
            "ambient": {"density": 1000.0, "pressure": 1e5},
            "region": [{"shape": "sphere", "centre": [stand_off * BUBBLE, 0.0], "radius": BUBBLE, "phase": "gas",
                        "density": 0.0266, "pressure": 2118.0}],
            "boundary": {"z_max": "inflow", "r_max": "wall"},
            "inflow": {"pressure": [[0.0, 1e5], [2e-8, PULSE], [1e-6, PULSE], [1.1e-6, 1e5]]}},
        "solid": grid | {"z": [-width, 0.0], "material": material, "plasticity": law, "initial_stress": "hydrostatic",
                         "boundary": {"r_max": "symmetry"}},
        "coupling": {"scheme": "riemann"},
    }, "jet-or-shock")


def ratios(options):
    """Largest plastic strain and plastified volume, near the wall over farther away, the bubble and the pulse being the same.

    Joshi, Franc, Ghigliotti and Fivel (2019), J. Mech. Phys. Solids 125, 420: a micro-jet gives twice the largest strain of the
    shock of a detached bubble, in about 1/800 of the volume. Other than there: bubble, pulse and distances, which the abstract does
    not give; axial symmetry in both.
    """
    found = {}
    print("| d/R | jet, m/s | wall pressure, GPa | largest ε_p | volume of ε_p > 10⁻⁴, 10⁻³ mm³ | of ε_p > 2·10⁻³ |")
    print("|---|---|---|---|---|---|")
    for distance in JETS + SHOCKS:
        result = pycav.run(bubble_case(distance, options.levels), options.out / f"stand-off-{distance:g}", force=True)
        found[distance] = s = result.summary
        say(f"d/R = {distance:g}: {s['wall_seconds']:.0f} s")
        print(f"| {distance:g} | {s['jet_velocity_peak']:.0f} | {1e-9 * s['wall_pressure_peak_interface']:.3g} "
              f"| {s['plastic_strain_peak']:.2g} | {1e12 * s['plastic_volume']:.3g} | {1e12 * s['plastic_volume_2e-3']:.3g} |",
              flush=True)
    print("\n| d/R near, far | ratio of the largest ε_p | of the volumes of ε_p > 10⁻⁴ | of ε_p > 2·10⁻³ |\n|---|---|---|---|")
    print("| Joshi et al. | 2 | 1/800, the bound not known | |")
    for jet in JETS:
        for shock in SHOCKS:
            both = [ratio(found[jet][key], found[shock][key]) for key in MEASURES]
            print(f"| {jet:g}, {shock:g} | " + " | ".join(both) + " |")


def ratio(above, below):
    return f"{above / below:.2g}" if below > 0.0 else "none below"


PARTS = {"plateau": plateau, "loads": loads, "ratios": ratios}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("parts", nargs="*", metavar="PART", help=f"any of {', '.join(PARTS)}; all without")
    parser.add_argument("--out", type=Path, default=ROOT / "runs/published-pits", help="directory of the runs")
    parser.add_argument("--cells", type=int, default=20, choices=[5, 10, 20, 40], help="cells to the load's radius")
    parser.add_argument("--limiter", default="mc", choices=["mc", "none"], help="of the solids under plateau and loads")
    parser.add_argument("--levels", type=int, default=4, help="levels of the bubble's grids: 2 cells per radius, times 2 each")
    parser.add_argument("--first", type=int, metavar="ROWS", help="only so many rows of plateau and loads")
    options = parser.parse_args()
    if unknown := [part for part in options.parts if part not in PARTS]:
        parser.error(f"{unknown[0]}: not one of {', '.join(PARTS)}")
    for part in options.parts or PARTS:
        print(f"\n### {part}\n")
        PARTS[part](options)


if __name__ == "__main__":
    main()
