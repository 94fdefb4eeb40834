"""Case texts of a bubble on the axis, runs of them, and what is read off their histories."""

import json
import subprocess

import h5py
import numpy as np

ROOT_CELLS = 32  # cells of the coarsest grid along a side


class Run:
    """What a run left: its summary, and the gas volume against time."""

    def __init__(self, directory):
        self.summary = json.loads((directory / "summary.json").read_text())
        with h5py.File(directory / "history.h5") as file:
            self.time = file["time"][:]
            self.volume = file["bubble/volume"][:]
            self.jet = file["bubble/jet_velocity"][:]

    def first_minimum(self):
        """Time and volume of the first minimum of the volume below half the initial one that a rise of 1 % follows."""
        volume, time = self.volume, self.time
        lowest = np.minimum.accumulate(volume)
        risen = np.flatnonzero((volume > 1.01 * lowest) & (lowest < 0.5 * volume[0]))
        if not len(risen):
            return np.nan, np.nan
        k = int(np.argmin(volume[: risen[0]]))
        if k == 0 or k + 1 == len(volume):
            return time[k], volume[k]
        a, b, _ = np.polyfit(time[k - 1 : k + 2] - time[k], volume[k - 1 : k + 2], 2)
        return time[k] - 0.5 * b / a, volume[k]


def case_text(*, pressure, gas, radius, centre, side, cells, end, model="five-equation", interface=None,
              limiter="mc", epsilon=1e-3, wall="rigid", start="uniform"):
    """A case: a gas bubble (density, pressure) about (centre, 0) in liquid of a pressure, in a box of a side that is
    2^n times the radius times 32 over the cells per radius."""
    levels = round(np.log2(side / radius * cells / ROOT_CELLS))
    # Without a wall the bubble is in the middle of a box twice as long.
    low, roots = (-side, 2 * ROOT_CELLS) if wall == "none" else (0.0, ROOT_CELLS)
    sharpening = f'interface = "{interface}"\n' if interface else ""
    began = f'initial_pressure = "{start}"\n' if start != "uniform" else ""
    solid = ""
    if wall not in ("rigid", "none"):
        solid = f"""
[solid]
z = [-{side}, 0.0]
r = [0.0, {side}]
cells = [{ROOT_CELLS}, {ROOT_CELLS}]
levels = {levels}
epsilon = {epsilon}
material = "{wall}"

[solid.boundary]
z_min = "non-reflecting"
r_max = "non-reflecting"
"""
    scheme = wall if wall in ("rigid", "none") else "riemann"
    return f"""geometry = "axisymmetric"

[time]
end = {end}
cfl = 0.45

[fluid]
z = [{low}, {side}]
r = [0.0, {side}]
cells = [{roots}, {ROOT_CELLS}]
levels = {levels}
epsilon = {epsilon}
model = "{model}"
{sharpening}{began}limiter = "{limiter}"

[fluid.liquid]
gamma = 7.15
pi = 3e8

[fluid.gas]
gamma = 1.4
pi = 0.0

[fluid.ambient]
phase = "liquid"
density = 1000.0
pressure = {pressure}

[[fluid.region]]
shape = "sphere"
centre = [{centre}, 0.0]
radius = {radius}
phase = "gas"
density = {gas[0]}
pressure = {gas[1]}

[fluid.boundary]
z_max = "non-reflecting"
r_max = "non-reflecting"
{solid}
[coupling]
scheme = "{scheme}"
"""


def run(options, name, **parameters):
    """Runs a case unless its directory is already complete; returns the run and the command's exit code."""
    options.out.mkdir(parents=True, exist_ok=True)
    directory, case = options.out / name, options.out / f"{name}.toml"
    text = case_text(**parameters)
    is_known = case.exists() and case.read_text() == text and (directory / "summary.json").exists()
    if not is_known or not json.loads((directory / "summary.json").read_text()).get("completed"):
        case.write_text(text)
        done = subprocess.run([options.cav, "run", case, "--out", directory, "--force", "-q"], check=False)
        if done.returncode:
            return None, done.returncode
    return Run(directory), 0


def wide_enough(radius, end):
    """Side of a box, 6.4 · 2^n radii, to whose far sides and back no wave gets before the end. A non-reflecting side
    lets waves out but holds back the inflow of a slow collapse: p∞ − p = ρcv there."""
    return 6.4 * radius * 2.0 ** max(0, int(np.ceil(np.log2(0.5 * 1500.0 * end / (6.4 * radius)))))


def rayleigh_time(radius, pressure, gas_pressure):
    """Rayleigh's collapse time of an empty bubble, 0.915 R √(ρ/Δp), s."""
    return 0.91468 * radius * np.sqrt(1000.0 / (pressure - gas_pressure))
