"""Case texts of a liquid above an elastic half-space, runs of them, and their probes' histories."""

import sys
import time as clock
from dataclasses import dataclass, field

import numpy as np

import program

LIQUID = (1000.0, 7.15, 3e8)  # density at the initial pressure, gamma, pi
STEEL = (7800.0, 5990.0, 3458.0)  # density, c1, c2
BLOCK = 16


@dataclass
class Box:
    """Cells of both media: fluid 0 to `height`, solid −`depth` to 0, both 0 to `width`, about `cell` wide."""

    cell: float
    width: float
    height: float
    depth: float
    adapt: bool = True
    # Cells of the fluid and of the solid per `cell`, along both directions.
    ratio: tuple = (1, 1)

    def widths(self):
        return [self.cell / part for part in self.ratio]

    def grid(self, medium, length):
        """`z`, `r`, `cells`, `levels` of a medium; lengths are rounded up to whole coarsest blocks."""
        part = self.ratio[0 if medium == "fluid" else 1]
        coarse = self.coarsest_block()
        roots = [round(np.ceil(side / coarse - 1e-9)) for side in (length, self.width)]
        z, r = [count * coarse for count in roots]
        span = f"[0.0, {z!r}]" if medium == "fluid" else f"[{-z!r}, 0.0]"
        # The part of the ratio goes into the number of blocks, so that both media have the same extent.
        cells = [part * BLOCK * count for count in roots]
        return (f"z = {span}\nr = [0.0, {r!r}]\ncells = {cells}\nlevels = {self.levels()}\n"
                f"adapt = {str(self.adapt).lower()}\n")

    def levels(self):
        """As many as leave four coarsest blocks along the shortest side."""
        shortest = min(side for side in (self.width, self.height, self.depth) if side > 0)
        return max(0, int(np.floor(np.log2(shortest / (4 * BLOCK * self.cell)))))

    def coarsest_block(self):
        return BLOCK * self.cell * 2 ** self.levels()


@dataclass
class Problem:
    """A case: everything between the grids is TOML text."""

    box: Box
    end: float
    fluid: str = ""
    solid: str = ""
    coupling: str = 'scheme = "riemann"\n'
    geometry: str = "axisymmetric"
    cfl: float = 0.45
    limiter: str = ""
    step_ratio: int = 16
    local_steps: bool = False
    snapshots: tuple = ()
    # (name, medium, z, r)
    probes: list = field(default_factory=list)

    def text(self):
        limiter = f'limiter = "{self.limiter}"\n' if self.limiter else ""
        parts = [f'geometry = "{self.geometry}"\n',
                 f"[time]\nend = {self.end!r}\ncfl = {self.cfl}\nlocal_steps = {str(self.local_steps).lower()}\nsnapshots = {list(self.snapshots)}\n"]
        for medium, length, rest in (("fluid", self.box.height, self.fluid), ("solid", self.box.depth, self.solid)):
            if rest:
                parts.append(f"[{medium}]\n{self.box.grid(medium, length)}{limiter}{rest}")
        steps = f"step_ratio = {self.step_ratio}\n" if self.step_ratio < 16 else ""
        parts.append(f"[coupling]\n{steps}{self.coupling}")
        parts += [f'[[probe]]\nname = "{name}"\nposition = [{z!r}, {r!r}]\nmedium = "{medium}"\n'
                  for name, medium, z, r in self.probes]
        return "\n".join(parts)


def water(pressure=1e5, liquid=LIQUID):
    density, gamma, pi = liquid
    return (f"[fluid.liquid]\ngamma = {gamma}\npi = {pi!r}\n"
            f"[fluid.ambient]\ndensity = {density!r}\npressure = {pressure!r}\n")


def elastic(material=STEEL):
    density, c1, c2 = material
    return (f'initial_stress = "hydrostatic"\n'
            f"[solid.material]\ndensity = {density!r}\nc1 = {c1!r}\nc2 = {c2!r}\n")


def sound(pressure=1e5, liquid=LIQUID):
    density, gamma, pi = liquid
    return float(np.sqrt(gamma * (pressure + pi) / density))


class Run:
    """What a run left: its result, its summary, and the histories of its probes."""

    def __init__(self, result):
        self.result, self.summary = result, result.summary

    def probe(self, name, *columns, absolute=False):
        """Times and the columns, one row each, without their values at the start unless `absolute`."""
        probe = self.result.probes[name]
        rows = np.array([probe[column] for column in columns])
        return probe["time"].to_numpy(), rows if absolute else rows - rows[:, :1]

    def updates(self):
        return sum(self.summary["cell_updates"].values())


def run(options, name, problem):
    """Runs a problem unless its directory already holds that very run."""
    begin = clock.monotonic()
    result, code = program.solve(options, name, problem.text(), options.set, "--in-process", threads=options.threads)
    if code:
        sys.exit(f"{name}: exit code {code}")
    print(f"<!-- {name}: {clock.monotonic() - begin:.0f} s -->", flush=True)
    return Run(result)
