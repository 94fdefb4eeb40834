"""D: a spherical pressure pulse in the liquid above an elastic half-space."""

import re

import numpy as np

from program import fixed

from .runs import Box, Problem, elastic, run, water
from .series import first_half, misfit, order, read, stems

WIDTH, CENTRE, AMPLITUDE = 3e-4, 2e-3, 1e4
IN_FLUID = ["p_Pa", "v_z_m_s", "v_r_m_s"]
VELOCITIES = ["v_z_m_s", "v_r_m_s"]
STRESSES = ["sigma_zz_Pa", "sigma_rr_Pa", "sigma_phiphi_Pa", "sigma_rz_Pa"]
# Farthest receivers along r, end and size of the domains: far enough that no wave comes back from outside.
NEAR, FAR = (2e-3, 3e-6, 11e-3), (1.0, 16e-6, 40e-3)
# Head waves, with a bubble so far away that nothing comes from it: its centre and radius.
HEADS, BUBBLE = (12e-3, 6e-6, 24e-3), (14e-3, 1e-3)
OURS = {"p_Pa": "pressure", "p_fluid_Pa": "pressure", "v_r_fluid_m_s": "velocity_r", "v_z_m_s": "velocity_z",
        "v_r_m_s": "velocity_r", "sigma_zz_Pa": "stress_zz", "sigma_rr_Pa": "stress_rr",
        "sigma_phiphi_Pa": "stress_phiphi", "sigma_rz_Pa": "stress_zr"}


def receivers(data, farthest):
    """(file's stem, medium, z, r) of all receivers up to a radius."""
    found = []
    for stem in stems(data / "D/steel"):
        match = re.fullmatch(r"(fluid|interface|solid)_r([\d.]+)(?:_z(m?)([\d.]+))?mm(?:_z(m?)([\d.]+)mm)?", stem)
        if not match:
            match = re.fullmatch(r"(fluid|solid)_r([\d.]+)_z(m?)([\d.]+)mm", stem)
        if not match:
            continue
        medium, r = match[1], float(match[2]) * 1e-3
        z = float(match[4]) * 1e-3 * (-1 if match[3] else 1) if medium != "interface" else 0.0
        if r <= farthest:
            found.append((stem, medium, z, r))
    return found


def problem(places, box, end, bubble=None, **more):
    probes = []
    for name, medium, z, r in places:
        label = name.replace(".", "p")
        if medium == "interface":
            probes += [(f"{label}_above", "fluid", 0.0, r), (f"{label}_below", "solid", 0.0, r)]
        else:
            probes.append((label, medium, z, r))
    pulse = (f'[[fluid.pulse]]\nshape = "sphere"\ncentre = [{CENTRE}, 0.0]\nwidth = {WIDTH}\n'
             f"amplitude = {AMPLITUDE}\n")
    if bubble is not None:
        centre, radius = BUBBLE
        pulse += (f'[[fluid.region]]\nshape = "sphere"\ncentre = [{centre}, 0.0]\nradius = {radius}\nphase = "gas"\n'
                  f"density = {bubble[1]}\npressure = {bubble[0]}\n")
    return Problem(box, end, fluid=water() + pulse, solid=elastic(), probes=probes, **more)


def quantities(medium, r):
    """What is compared at a receiver: label, probe's suffix, columns; on the axis without what vanishes there."""
    there = [name for name in VELOCITIES if r > 0 or "v_r" not in name]
    stresses = [name for name in STRESSES if r > 0 or "rz" not in name]
    if medium == "fluid":
        return [("p", "", ["p_Pa"]), ("v", "", there)]
    if medium == "solid":
        return [("v", "", there), ("σ", "", stresses)]
    # No shear is passed to the liquid: the reference has round-off there.
    above = ["v_z_m_s", "v_r_fluid_m_s"] if r > 0 else ["v_z_m_s"]
    return [("p", "_above", ["p_fluid_Pa"]), ("v above", "_above", above), ("v", "_below", there),
            ("σ", "_below", stresses[:3])]


def misfits(options, result, place, until=np.inf):
    name, medium, _, r = place
    exact = read(options.data / f"D/steel/{name}.csv")
    found = {}
    for label, suffix, columns in quantities(medium, r):
        times, values = result.probe(name.replace(".", "p") + suffix, *(OURS[column] for column in columns))
        found[label] = misfit(times, values, exact["t_s"], [exact[column] for column in columns], until)
    return found


def solve(options, cells, farthest, end, size, adapt=True, ratio=(1, 1), **more):
    """Runs the problem and yields (receiver, misfits)."""
    places = receivers(options.data, farthest)
    box = Box(WIDTH / cells * min(ratio), size, size, size, adapt, ratio)
    label = "-".join(str(part) for part in (
        "pulse", cells, f"{farthest:g}", "adaptive" if adapt else "uniform", *ratio, *(f"{key}={value}" for key, value in more.items())))
    result = run(options, label, problem(places, box, end, **more))
    return result, [(place, misfits(options, result, place, end)) for place in places]


def worst(readings, medium):
    """The largest misfit of the receivers in the fluid, or of those in the solid and on the interface."""
    in_fluid = [place[1] == "fluid" for place, _ in readings]
    chosen = [found for (_, found), fluid in zip(readings, in_fluid) if fluid == (medium == "fluid")]
    return max(max(found.values()) for found in chosen)


def refinement(options):
    """Misfits and orders, receiver by receiver."""
    far = options.far
    farthest, end, size = FAR if far else NEAR
    grids = options.cells or ([10, 20] if far else [10, 20, 40])
    tables = [solve(options, cells, farthest, end, size)[1] for cells in grids]
    print("| receiver | quantity | " + " | ".join(f"{cells} cells" for cells in grids) + " | order |")
    print("|---|---|" + "---|" * (len(grids) + 1))
    for rows in zip(*tables):
        for label in rows[0][1]:
            values = [found[label] for _, found in rows]
            orders = ", ".join(f"{order(a, b, n / m):.1f}"
                               for a, b, m, n in zip(values, values[1:], grids, grids[1:]))
            name = rows[0][0][0].replace("_", " ")
            print(f"| {name} | {label} | " + " | ".join(f"{100 * value:.2f} %" for value in values) + f" | {orders} |")


GRIDS = [
    ("all on the finest level, 1:1, common steps", {"adapt": False, "step_ratio": 1}),
    ("adaptive, 1:1, common steps", {"step_ratio": 1}),
    ("adaptive, 1:1, at most 2 steps in one", {"step_ratio": 2}),
    ("adaptive, 1:1, at most 4 steps in one", {"step_ratio": 4}),
    ("adaptive, 1:1, at most 8 steps in one", {"step_ratio": 8}),
    ("adaptive, 1:1", {}),
    ("adaptive, 1:1, levels with steps of their own", {"local_steps": True}),
    ("adaptive, the solid twice as fine, levels with steps of their own", {"ratio": (1, 2), "local_steps": True}),
    ("adaptive, the solid twice as fine", {"ratio": (1, 2)}),
    ("adaptive, the fluid twice as fine", {"ratio": (2, 1)}),
    ("adaptive, the solid four times as fine", {"ratio": (1, 4)}),
    ("adaptive, 2:3", {"ratio": (2, 3)}),
    ("adaptive, no limiter", {"limiter": "none"}),
    ("adaptive, minmod", {"limiter": "minmod"}),
]


def grids(options):
    """Adaptation, cells that do not match, different time steps, limiters."""
    cells = (options.cells or [20])[0]
    print(f"| {cells} cells per width | largest misfit in the fluid | in the solid and on the interface | cell updates |")
    print("|---|---|---|---|")
    for what, settings in GRIDS:
        if options.only not in what:
            continue
        result, readings = solve(options, cells, *NEAR, **settings)
        print(f"| {what} | {100 * worst(readings, 'fluid'):.2f} % | {100 * worst(readings, 'solid'):.2f} % "
              f"| {result.updates():.2e} |", flush=True)


def arrivals(options):
    """Head waves: when the precursor passes half of its first extremum."""
    cells = (options.cells or [20])[0]
    result, _ = solve(options, cells, *FAR)
    print("| receiver | exact | ours | difference |\n|---|---|---|---|")
    for stem, wanted, found in precursors(options, result, 1.0):
        off = fixed(100 * (found / wanted - 1), "+.3f")
        print(f"| {stem.replace('_', ' ')} | {wanted * 1e6:.4f} µs | {found * 1e6:.4f} µs | {off} % |")


# What the bubble of `beside_bubble` holds, Pa.
# What is in the case: pressure and density of the bubble. In the thin gas sound runs at 10.8 km/s, seven times as fast as in the water.
CONTENTS = [("no bubble", None), ("a bubble at rest, 1e5 Pa", (1e5, 1.2)), ("one of thin gas, 1.2 g/m³", (1e5, 1.2e-3)),
            ("a collapsing bubble, 2118 Pa", (2118.0, 0.0254))]


def beside_bubble(options):
    """The pulse and its head waves with a bubble in the case, at its default thresholds."""
    cells = (options.cells or [20])[0]
    print("| in the case | largest misfit in the fluid | in the solid and on the interface | head waves off by at most "
          "| cell updates |\n|---|---|---|---|---|")
    for what, gas in CONTENTS:
        result, readings = solve(options, cells, *HEADS, bubble=gas)
        late = max(abs(found / wanted - 1) for _, wanted, found in precursors(options, result, HEADS[0]))
        print(f"| {what} | {100 * worst(readings, 'fluid'):.2f} % | {100 * worst(readings, 'solid'):.2f} % | {100 * late:.2f} % "
              f"| {result.updates():.2e} |", flush=True)


def precursors(options, result, farthest):
    """(receiver, exact time, ours) at which head waves pass half of their first extremum, s."""
    centres = read(options.data / "D/steel/arrivals.csv")
    for r, z, direct, head in zip(*(centres[key] for key in ("r_m", "z_m", "t_direct_s", "t_head_P_s"))):
        stem = f"fluid_r{r * 1e3:g}_z{z * 1e3:g}mm"
        before = direct - 4.0 * WIDTH / 1464.8
        if not np.isfinite(head) or before < head or r > farthest:
            continue
        exact = read(options.data / f"D/steel/{stem}.csv")
        times, values = result.probe(stem.replace(".", "p"), "pressure")
        wanted = first_half(exact["t_s"], exact["p_Pa"], before)
        yield stem, wanted, first_half(times, values[0], before)
