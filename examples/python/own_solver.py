"""A solver of one's own under the fluid: a rigid plate on a spring.

The fluid's solver gives the plate its pressure, the plate gives the fluid its velocity; once a step, the velocity at the
middle of the step (leapfrog). For other solids, or other liquids above `pycav.SolidSolver`, it goes likewise.
"""

import matplotlib
import numpy as np

import pycav
from options import CASES, ask, coarser

matplotlib.use("Agg")
import matplotlib.pyplot as plt

options = ask(__doc__)
case = coarser(pycav.Case(CASES / "dickopp2012-coarse.toml"), options.coarser, fluid=6, solid=4)
fluid = pycav.FluidSolver(case)

MASS = 20.0  # kg per m² of the plate
STIFFNESS = 2e11  # Pa per m
REST = 5e7  # Pa, which the spring carries at the start

edges = np.concatenate([[0.0], fluid.surface_edges])
areas = np.pi * np.diff(edges**2)
place, velocity, rows = 0.0, 0.0, []
while fluid.time < 60e-6:
    dt = fluid.time_step_limit()
    # What the plate feels is p = felt + Z v; implicit in v, which is stable whatever the mass.
    trace = fluid.trace(dt)
    felt = trace["pressure"] - trace["impedance"] * trace["velocity"]
    felt, Z = (np.average(values, weights=areas) for values in (felt, trace["impedance"]))
    velocity += dt * (REST - felt - STIFFNESS * place - Z * velocity) / (MASS + dt * Z)
    place += dt * velocity
    fluid.step(dt, velocity=velocity)
    rows.append((fluid.time, place, velocity, np.average(fluid.surface_pressure, weights=areas)))

time, place, velocity, pressure = np.array(rows).T
print(f"{fluid.steps} steps; largest displacement {np.abs(place).max() * 1e6:.1f} µm, mean pressure "
      f"{pressure.min() * 1e-6:.1f} to {pressure.max() * 1e-6:.1f} MPa")
figure, (upper, lower) = plt.subplots(2, 1, sharex=True, layout="constrained")
upper.plot(time * 1e6, place * 1e6)
upper.set_ylabel("displacement / µm")
lower.plot(time * 1e6, pressure * 1e-6)
lower.set(xlabel="$t$ / µs", ylabel="mean pressure / MPa")
figure.savefig(options.out / "plate.png")
