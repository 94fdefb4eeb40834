"""What a sweep will cost: by `Case.check` before anything has run, by what has run as soon as something has."""

from __future__ import annotations

import re

from ..case import Case

PREFIXES = {"": 1.0, "m": 1e-3, "u": 1e-6, "n": 1e-9, "p": 1e-12, "k": 1e3}
DURATION = {"s": 1.0, "sec": 1.0, "m": 60.0, "min": 60.0, "h": 3600.0, "day": 86400.0, "days": 86400.0}
CELLS = re.compile(r"^(fluid|solid)\b.*?(?:= (\d+) cells|\n\s+at most\s+(\d+) cells)", re.M | re.S)
STEP = re.compile(r"(fluid|solid) ([\d.e+-]+) ([a-z]?)s\b")
SHARES = {"fluid": 2.0, "solid": 1.0}
"""A step of a cell of the fluid takes about twice as long as one of the solid."""


class Cost:
    """The work of a run, in cells times steps, and the time that `Case.check` believes it takes at most on one core, s."""

    def __init__(self, case: Case) -> None:
        text = case.check()
        cells = {match[1]: float(match[2] or match[3]) for match in CELLS.finditer(text)}
        line = next((line for line in text.splitlines() if line.startswith("time step")), "")
        steps = {side: case.end / (float(value) * PREFIXES.get(prefix, 1.0)) for side, value, prefix in STEP.findall(line)}
        self.work = sum(SHARES[side] * cells.get(side, 0.0) * count for side, count in steps.items()) or 1.0
        self.seconds = _run_time(text)


def _run_time(text: str) -> float:
    """The estimate of the check, which is for a number of threads, as time of one core: the first time of its line, with all cells."""
    line = next((line for line in text.splitlines() if line.startswith("run time")), "")
    threads = re.search(r"with (\d+) threads", line)
    told = re.match(r"run time\s+(?:about )?((?:\d+(?:s|min|m|h|days|day)\s*)+)", line)
    if not told:
        return 0.0
    parts = re.findall(r"(\d+)(days|day|min|m|h|s)", told[1])
    return sum(float(number) * DURATION[unit] for number, unit in parts) * (float(threads[1]) if threads else 1.0)


def duration(seconds: float) -> str:
    """A time for people: 40 s, 12 min, 3.5 h."""
    if seconds < 100:
        return f"{seconds:.0f} s"
    return f"{seconds / 60:.0f} min" if seconds < 6000 else f"{seconds / 3600:.1f} h"
