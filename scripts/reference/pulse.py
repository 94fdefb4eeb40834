"""D: a spherical pressure pulse in the liquid above an elastic half-space."""

import re

import numpy as np

from .runs import Box, Problem, elastic, run, water
from .series import first_half, misfit, order, read

WIDTH, CENTRE, AMPLITUDE = 3e-4, 2e-3, 1e4
IN_FLUID = ["p_Pa", "v_z_m_s", "v_r_m_s"]
VELOCITIES = ["v_z_m_s", "v_r_m_s"]
STRESSES = ["sigma_zz_Pa", "sigma_rr_Pa", "sigma_phiphi_Pa", "sigma_rz_Pa"]
OURS = {"p_Pa": "pressure", "p_fluid_Pa": "pressure", "v_r_fluid_m_s": "velocity_r", "v_z_m_s": "velocity_z",
        "v_r_m_s": "velocity_r", "sigma_zz_Pa": "stress_zz", "sigma_rr_Pa": "stress_rr",
        "sigma_phiphi_Pa": "stress_phiphi", "sigma_rz_Pa": "stress_zr"}


def receivers(data, farthest):
    """(file's stem, medium, z, r) of all receivers up to a radius."""
    found = []
    for path in sorted((data / "D/steel").glob("*.csv")):
        match = re.fullmatch(r"(fluid|interface|solid)_r([\d.]+)(?:_z(m?)([\d.]+))?mm(?:_z(m?)([\d.]+)mm)?", path.stem)
        if not match:
            match = re.fullmatch(r"(fluid|solid)_r([\d.]+)_z(m?)([\d.]+)mm", path.stem)
        if not match:
            continue
        medium, r = match[1], float(match[2]) * 1e-3
        z = float(match[4]) * 1e-3 * (-1 if match[3] else 1) if medium != "interface" else 0.0
        if r <= farthest:
            found.append((path.stem, medium, z, r))
    return found


def problem(places, box, end, **more):
    probes = []
    for name, medium, z, r in places:
        label = name.replace(".", "p")
        if medium == "interface":
            probes += [(f"{label}_above", "fluid", 0.0, r), (f"{label}_below", "solid", 0.0, r)]
        else:
            probes.append((label, medium, z, r))
    pulse = (f'[[fluid.pulse]]\nshape = "sphere"\ncentre = [{CENTRE}, 0.0]\nwidth = {WIDTH}\n'
             f"amplitude = {AMPLITUDE}\n")
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


def box_for(cells, size, adapt=True, ratio=(1, 1)):
    return Box(WIDTH / cells, size, size, size, adapt, ratio)
