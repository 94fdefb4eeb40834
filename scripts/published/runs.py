"""Runs of the cases in cases/validation, and what is read off their histories."""

from pathlib import Path

import numpy as np
from bubble.runs import Run

import program

CASES = Path(__file__).resolve().parents[2] / "cases/validation"


def run(options, case, name, changes):
    """Runs a case of cases/validation on one thread with changes, key and value; a Jetting, or None if it failed."""
    sets = [f"{key}={value}" for key, value in changes.items()]
    result, code = program.solve(options, f"{case}-{name}", (CASES / f"{case}.toml").read_text(), sets, "--threads", "1")
    if code:
        print(f"{case}-{name}: exit code {code}", flush=True)
    return result and Jetting(result)


class Jetting(Run):
    """A run of which the jet is looked at."""

    def __init__(self, result):
        super().__init__(result)
        self.tip, self.radius = (
            result.histories[f"bubble/{name}"].to_numpy() for name in ("jet_tip_z", "equivalent_radius"))

    def fastest(self, since, until):
        """The row at which the liquid on the axis is fastest within a time."""
        within = np.flatnonzero((self.time > since) & (self.time <= until) & np.isfinite(self.jet))
        return within[np.argmax(self.jet[within])]

    def tip_speed(self, row, travel):
        """Mean speed of the jet's tip over the way before a row, m/s."""
        here = np.flatnonzero(np.isfinite(self.tip[: row + 1]))[-1]
        start = np.flatnonzero(self.tip[:here] > self.tip[here] + travel)[-1]
        return (self.tip[start] - self.tip[here]) / (self.time[here] - self.time[start])
