"""C: plane pulses at normal incidence on many materials, and what comes back of them."""

import numpy as np

from program import fixed

from .runs import BLOCK, STEEL, Box, Problem, elastic, run, sound, water
from .series import misfit, read

WIDTH, START, AMPLITUDE = 5e-4, 4e-3, 1e4
RECEIVERS = {1e5: ["fluid_z1mm", "fluid_z6mm", "solid_zm1mm", "solid_zm5mm"], 5e7: ["fluid_z1mm", "solid_zm2mm"]}
MATERIALS = {
    "gelatine-like": (1100.0, 1550.0, 20.0),
    "PMMA": (1180.0, 2700.0, 1340.0),
    "aluminium": (2700.0, 6320.0, 3130.0),
    "steel": STEEL,
    "tungsten carbide": (15000.0, 6650.0, 3980.0),
    "matched": (1000.0, None, None),
}
SOLID_STRESSES = ["stress_zz", "stress_zr", "stress_rr", "stress_phiphi"]
COLUMNS = {"fluid": [("p", ["p_Pa"], ["pressure"]), ("v", ["v_z_m_s"], ["velocity_z"])],
           "solid": [("v", ["v_z_m_s"], ["velocity_z"]),
                     ("σ", ["sigma_zz_Pa", "sigma_rr_Pa"], ["stress_zz", "stress_rr"])]}


def place_of(receiver):
    medium, z = receiver.split("_z")
    return medium, float(z.replace("m", "-", 1).replace("mm", "") if z.startswith("m") else z.replace("mm", "")) * 1e-3


def problem(cells, pressure, material, probes, end, height=10e-3, depth=6e-3, limiter=""):
    cell = WIDTH / cells
    # Nothing varies along the surface: one block of cells, planar.
    box = Box(cell, BLOCK * cell, height, depth, adapt=False)
    pulse = (f'[[fluid.pulse]]\nshape = "plane"\ncentre = [{START}, 0.0]\ndirection = [-1.0, 0.0]\nwidth = {WIDTH}\n'
             f'amplitude = {AMPLITUDE}\n[fluid.boundary]\nr_max = "wall"\n')
    solid = elastic(material) + '[solid.boundary]\nr_max = "symmetry"\n'
    return Problem(box, end, fluid=water(pressure) + pulse, solid=solid, geometry="planar", probes=probes,
                   limiter=limiter)


def table(options):
    """Misfits at the receivers, then reflected and transmitted amplitudes of many materials."""
    grids = options.cells or [10, 20, 40]
    print("| pressure | receiver | quantity | " + " | ".join(f"{n} cells" for n in grids) + " |")
    print("|---|---|---|" + "---|" * len(grids))
    for pressure, names in RECEIVERS.items():
        probes = [(name, *place_of(name), 1e-5) for name in names]
        runs = [run(options, f"plane-{pressure:.0e}-{n}", problem(n, pressure, STEEL, probes, 8e-6)) for n in grids]
        for name in names:
            exact = read(options.data / f"C/pulse_steel_p{pressure:.0e}_{name}.csv".replace("e+0", "e"))
            for label, theirs, ours in COLUMNS[place_of(name)[0]]:
                found = []
                for result in runs:
                    times, values = result.probe(name, *ours)
                    found.append(misfit(times, values, exact["t_s"], [exact[key] for key in theirs], times[-1]))
                print(f"| {pressure:.0e} Pa | {name.replace('_', ' ')} | {label} | "
                      + " | ".join(f"{100 * value:.2f} %" for value in found) + " |", flush=True)


def chosen(options):
    """Names and constants of the materials that --only leaves."""
    return [(name, material) for name, material in MATERIALS.items() if options.only in name]


def materials(options):
    """Amplitudes that come back and go on, over the incident one."""
    cells = (options.cells or [40])[0]
    print("| material | pressure | reflected (exact) | transmitted (exact) |\n|---|---|---|---|")
    for name, material in chosen(options):
        for pressure in (1e5, 5e7):
            c = sound(pressure)
            density, c1, c2 = material if material[1] else (1000.0, c, 0.5 * c)
            exact = (density * c1 - 1000.0 * c) / (density * c1 + 1000.0 * c)
            probes = [("above", "fluid", 6e-3, 1e-5), ("below", "solid", -1e-3, 1e-5)]
            result = run(options, f"material-{name}-{pressure:.0e}-{cells}",
                         problem(cells, pressure, (density, float(c1), float(c2)), probes, 12e-3 / c))
            # The receiver is above the start: it sees only what comes back.
            back = extreme(result.probe("above", "pressure")[1][0]) / AMPLITUDE
            on = extreme(-result.probe("below", "stress_zz")[1][0]) / AMPLITUDE
            print(f"| {name} | {pressure:.0e} Pa | {fixed(back, '.4f')} ({exact:.4f}) | {on:.4f} ({1 + exact:.4f}) |", flush=True)


# Angles below the first critical one of steel, 14.2 degrees: V is real, and nothing in the solid runs ahead of the contact.
ANGLES, REACH, NARROW = (5.0, 10.0), 32e-3, 3e-4


def oblique(options):
    """Plane pulses at oblique incidence: what is measured above the wall, against incident and reflected wave."""
    grids = options.cells or [10, 20]
    angles, reflected, *_ = read(options.data / "C/oblique_steel.csv").values()
    c = sound(1e5)
    print("| angle | V | quantity | " + " | ".join(f"{n} cells" for n in grids) + " |")
    print("|---|---|---|" + "---|" * len(grids))
    for angle in ANGLES:
        factor = np.interp(angle, angles, reflected)
        along, across = float(np.cos(np.radians(angle))), float(np.sin(np.radians(angle)))
        # The pulse begins above the wall everywhere; where the box begins it is lowest.
        start, z, r = 5 * NARROW, 1e-3, 0.8 * REACH
        arrival = (along * (start + z) + across * r) / c
        end = arrival + 4 * NARROW / c
        found = []
        for cells in grids:
            box = Box(NARROW / cells, REACH, start + REACH * across / along + 8 * NARROW, 12e-3)
            pulse = (f'[[fluid.pulse]]\nshape = "plane"\ncentre = [{start}, 0.0]\ndirection = [{-along!r}, {across!r}]\n'
                     f'width = {NARROW}\namplitude = {AMPLITUDE}\n[fluid.boundary]\nr_min = "non-reflecting"\n')
            solid = elastic(STEEL) + '[solid.boundary]\nr_min = "non-reflecting"\n'
            result = run(options, f"oblique-{angle:g}-{cells}",
                         Problem(box, float(end), fluid=water() + pulse, solid=solid, geometry="planar",
                                 probes=[("above", "fluid", z, r)]))
            times, values = result.probe("above", "pressure", "velocity_z", "velocity_r")
            wave = lambda path: AMPLITUDE * np.exp(-((path + across * r - c * times) / NARROW) ** 2)
            down, up = wave(along * (start - z)), factor * wave(along * (start + z))
            impedance = 1000.0 * c
            exact = np.array([down + up, along * (up - down) / impedance, across * (up + down) / impedance])
            found.append([misfit(times, values[:1], times, exact[:1], end), misfit(times, values[1:], times, exact[1:], end)])
        for k, label in enumerate("pv"):
            print(f"| {angle:g}° | {factor:.4f} | {label} | " + " | ".join(f"{100 * one[k]:.2f} %" for one in found) + " |",
                  flush=True)


def rest(options):
    """A hundred thousand steps at rest under 5e7 Pa: the largest change of pressure and stress anywhere looked at."""
    print("| material | steps | largest change of p and σ, relative |\n|---|---|---|")
    for name, material in chosen(options):
        c = sound(5e7)
        density, c1, c2 = material if material[1] else (1000.0, c, 0.5 * c)
        cell, steps = 1e-4, 100_000
        end = steps * 0.45 * cell / max(c1, c)
        probes = [("above", "fluid", 3e-4, 0.0), ("on", "fluid", 0.0, 4e-4), ("under", "solid", 0.0, 4e-4),
                  ("below", "solid", -3e-4, 0.0)]
        side = 2 * BLOCK * cell
        resting = Problem(Box(cell, side, side, side, adapt=False), end, fluid=water(5e7), solid=elastic(material if
                          material[1] else (density, c1, c2)), probes=probes)
        result = run(options, f"rest-{name}", resting)
        moved = [np.max(np.abs(result.probe(probe, *columns)[1])) / 5e7
                 for probe, columns in (("above", ["pressure"]), ("on", ["pressure"]), ("under", SOLID_STRESSES),
                                        ("below", SOLID_STRESSES))]
        print(f"| {name} | {result.summary['steps']} | {max(moved):.1e} |", flush=True)


def extreme(values):
    return values[np.argmax(np.abs(values))]
