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

    def rebound(self):
        """Time and volume of the largest volume after the first minimum."""
        collapse, _ = self.first_minimum()
        after = self.time > collapse
        k = np.flatnonzero(after)[np.argmax(self.volume[after])] if after.any() else 0
        return self.time[k], self.volume[k]

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
              limiter="mc", epsilon=1e-3, wall="rigid", start="uniform", box=None, second=None, snapshots=()):
    """A case: a gas bubble (density, pressure) about (centre, 0) in liquid of a pressure, in a box of a side that is
    2^n times the radius times 32 over the cells per radius; or in a box (z from, z to, r to) of whole radii, with 2^n cells
    per radius. `second`: centre and radius of another bubble."""
    levels = round(np.log2(side / radius * cells / ROOT_CELLS))
    # Without a wall the bubble is in the middle of a box twice as long.
    low, roots = (-side, 2 * ROOT_CELLS) if wall == "none" else (0.0, ROOT_CELLS)
    z, r, roots = (low, side), side, (roots, ROOT_CELLS)
    if box:
        levels = round(np.log2(cells))
        z, r = box[:2], box[2]
        roots = round((z[1] - z[0]) / radius), round(r / radius)
    sharpening = f'interface = "{interface}"\n' if interface else ""
    began = f'initial_pressure = "{start}"\n' if start != "uniform" else ""
    solid = ""
    if wall not in ("rigid", "none"):
        solid = f"""
[solid]
z = [-{r}, 0.0]
r = [0.0, {r}]
cells = [{roots[1]}, {roots[1]}]
levels = {levels}
epsilon = {epsilon}
material = "{wall}"
"""
    other = "" if second is None else f"""
[[fluid.region]]
shape = "sphere"
centre = [{second[0]}, 0.0]
radius = {second[1]}
phase = "gas"
density = {gas[0]}
pressure = {gas[1]}
"""
    scheme = wall if wall in ("rigid", "none") else "riemann"
    return f"""geometry = "axisymmetric"

[time]
end = {end}
cfl = 0.45
snapshots = {list(snapshots)}

[fluid]
z = [{z[0]}, {z[1]}]
r = [0.0, {r}]
cells = [{roots[0]}, {roots[1]}]
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
{other}{solid}
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


def box_side(radius):
    """Side of a box about a bubble or above a wall, 6.4 radii: the far field takes it for unbounded liquid."""
    return 6.4 * radius


def rayleigh_time(radius, pressure, gas_pressure):
    """Rayleigh's collapse time of an empty bubble, 0.915 R √(ρ/Δp), s."""
    return 0.91468 * radius * np.sqrt(1000.0 / (pressure - gas_pressure))
