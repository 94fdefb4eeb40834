"""The gallery's runs: how each case comes about, and what of it is kept."""

import json
import shlex
import subprocess
from dataclasses import dataclass, replace
from pathlib import Path

import pycav

ROOT = Path(__file__).resolve().parents[2]


def moments(*parts):
    """Times for `time.snapshots`, s: `parts` are (from, to, how many) in µs, each without its end."""
    found = [begin + (end - begin) * k / count for begin, end, count in parts for k in range(count)]
    return "[" + ", ".join(f"{time:.4f}e-6" for time in found) + "]"


@dataclass(frozen=True)
class Run:
    """A case, either a file of cases/ or what `cav new` writes for some options, and the changes that `--set` makes."""

    case: str
    """As "cases/collapse.toml", or "new collapse --wall steel"."""
    seconds: float
    """Measured, with one thread for each of the two processes."""
    changes: tuple[str, ...] = ()
    grids: int = 1
    """For `cav run --refine`."""

    def options(self):
        """Of `cav run`, beside the case and the directory."""
        sets = [part for change in self.changes for part in ("--set", change)]
        return sets + (["--refine", str(self.grids)] if self.grids > 1 else [])

    def commands(self, name, *, brief=False):
        """As a reader types them; `brief` is without the times of snapshots, those of a case whose end comes sooner, too."""
        run = self
        if brief:
            none = ["time.snapshots=[]"] if any(change.startswith("time.end=") for change in self.changes) else []
            kept = [change for change in self.changes if not change.startswith("time.snapshots=")]
            run = replace(self, changes=(*none, *kept))
        path = run.case
        lines = []
        if path.startswith("new "):
            path = f"{name}.toml"
            lines.append(f"cav {run.case} > {path}")
        return [*lines, shlex.join(["cav", "run", path, *run.options(), "--out", f"runs/gallery/{name}"])]


# Frames of films: most where the bubble is small and its shock on the way.
COLLAPSE = moments((0, 4.8, 6), (4.8, 7.2, 12), (7.2, 7.7, 8), (7.7, 8.9, 24), (8.9, 11.4, 15))
PULSE = moments((0.02, 0.5, 12), (0.5, 0.74, 8), (0.74, 0.96, 22), (0.96, 1.14, 6))
STAND_OFFS = (0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 2.5, 3.0)
WALLS = ("al-1100-o", "copper-ofhc", "al-6061-t6", "stainless-316l")
TWO = """fluid.region=[
    { shape = "sphere", centre = [1.3e-3, 0.0], radius = 1e-3, phase = "gas", density = 0.0278, pressure = 2340.0 },
    { shape = "sphere", centre = [3.3e-3, 0.0], radius = 6e-4, phase = "gas", density = 0.0278, pressure = 2340.0 }]"""

RUNS = {
    "collapse": Run("cases/collapse.toml", 105, ("fluid.levels=3", "solid.levels=2", f"time.snapshots={COLLAPSE}")),
    "jet": Run("new collapse --stand-off 1.2 --wall rigid --cells-per-radius 160", 74,
               (f"time.snapshots={moments((7.74, 8.1, 18))}", "time.end=8.1e-6")),
    "cut": Run("new collapse --stand-off 0.5 --wall steel --cells-per-radius 120", 15,
               (f"time.snapshots={moments((7.6, 8.0, 20))}", "time.end=8e-6")),
    "two": Run("cases/collapse.toml", 28, (TWO, f"time.snapshots={moments((4, 11, 29))}")),
    "pulse": Run("cases/acoustic-pulse.toml", 40),
    "lithotripter": Run("cases/lithotripter.toml", 39, (f"time.snapshots={PULSE}",)),
    "free": Run("new free --cells-per-radius 40", 48),
    **{f"stand-off-{distance}": Run(f"new collapse --stand-off {distance} --wall steel --elastic --cells-per-radius 24", 5)
       for distance in STAND_OFFS},
    **{f"wall-{wall}": Run(f"new collapse --stand-off 1.2 --wall {wall} --cells-per-radius 40", 18) for wall in WALLS},
    "convergence": Run("cases/collapse.toml", 128, ("fluid.levels=1", "solid.levels=0"), grids=3),
}


def result(options, name):
    """The run of a name, made if it is missing; for one of several grids the study."""
    run, directory = RUNS[name], options.out / name
    mark = options.out / f"{name}.txt"
    text = "\n".join(run.commands(name))
    if not (directory.is_dir() and mark.exists() and mark.read_text() == text):
        _make(options, name, run, directory)
        mark.write_text(text)
    return pycav.Convergence(directory) if run.grids > 1 else pycav.open(directory)


def _make(options, name, run, directory):
    directory.parent.mkdir(parents=True, exist_ok=True)
    case = ROOT / run.case
    if run.case.startswith("new "):
        case = options.out / f"{name}.toml"
        made = subprocess.run([options.cav, *shlex.split(run.case)], check=True, capture_output=True, text=True)
        case.write_text(made.stdout)
    print(f"{name}: about {run.seconds} s", flush=True)
    subprocess.run([options.cav, "run", case, *run.options(), "--out", directory, "--force", "--quiet"], check=True)
