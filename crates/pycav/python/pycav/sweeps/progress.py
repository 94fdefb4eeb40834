"""How far a sweep is: a bar on a terminal, plain lines elsewhere; at the end a table of what failed."""

from __future__ import annotations

import sys
import time
from collections.abc import Mapping, Sequence
from typing import Any

from .cost import duration
from .points import Point, in_words

KNOWN, DONE = "known", "done"


class Display:
    """Tells on standard error what a sweep will cost, how far it is, and what failed.

    The time left is that of the work so far, in cells times steps as `Case.check` counts them, for the work that is left. Runs that
    were there before say how long one takes before the first has ended.
    """

    def __init__(self, work: Mapping[int, float], total: int, believed: float, known: Sequence[tuple[float, float]]) -> None:
        """`work` of each point to run, by its number; `believed` seconds by the check; `known`: work and seconds of runs that are there."""
        self.work, self.total, self.begun = dict(work), total, time.monotonic()
        self.left, self.done, self.count = sum(work.values()), 0.0, total - len(work)  # of those over: known, or no case
        self.failed: list[tuple[Point, str]] = []
        self.bar: Any = _bar(total, self.count)
        self._say(self._before(believed, known))

    def _before(self, believed: float, known: Sequence[tuple[float, float]]) -> str:
        said, bad = f"{self.total} points", self.count - len(known)
        said += f", {len(known)} of them done before" if known else ""
        said += f", {bad} of them make no case" if bad else ""
        if not self.work:
            return f"sweep: {said}"
        spent, made = (sum(column) for column in zip(*known)) if known else (0.0, 0.0)
        if spent > 0 and made > 0:
            return f"sweep: {said}; by those the rest takes about {duration(self.left * made / spent)} of one core"
        return (f"sweep: {said}; at most {duration(max(believed, 60.0))} of one core as check counts cells and steps; "
                "the time left follows from the first that ends")

    def ended(self, number: int, point: Point, how: str, error: str) -> None:
        """A point has ended; `how`: "known" or "done"."""
        if error:
            self.failed.append((point, error))
        if how == KNOWN:
            return
        self.count += 1
        own = self.work.get(number, 0.0)
        self.done, self.left = self.done + own, max(self.left - own, 0.0)
        elapsed = time.monotonic() - self.begun
        rest = duration(elapsed * self.left / self.done) if self.done > 0 else "?"
        if self.bar is not None:
            self.bar.set_postfix_str(f"{rest} left, {len(self.failed)} failed" if self.failed else f"{rest} left")
            self.bar.update()
            return
        self._say(f"{self.count:>{len(str(self.total))}}/{self.total}  {in_words(point)}: {error.splitlines()[0] if error else how}; {rest} left")

    def close(self) -> None:
        """The last words."""
        if self.bar is not None:
            self.bar.close()
        if self.failed:
            self._say(table(self.failed, self.total))

    def _say(self, text: str) -> None:
        if self.bar is not None:
            self.bar.write(text, file=sys.stderr)
        else:
            print(text, file=sys.stderr, flush=True)


def _bar(total: int, initial: int) -> Any:
    """A bar, where there is a terminal that shows it."""
    if not sys.stderr.isatty():
        return None
    try:
        from tqdm import tqdm
    except ModuleNotFoundError:
        return None
    return tqdm(total=total, initial=initial, unit="run", file=sys.stderr, dynamic_ncols=True,
                bar_format="{l_bar}{bar}| {n_fmt}/{total_fmt} [{elapsed}{postfix}]")


def table(failed: Sequence[tuple[Point, str]], total: int) -> str:
    """What failed and why, a row for each point."""
    names = list(failed[0][0])
    rows = [[in_words({name: point[name]}).split(" ", 1)[1] for name in names] + [error.strip().splitlines()[0]] for point, error in failed]
    heads = [*(name.rpartition(".")[2] for name in names), "error"]
    widths = [max(len(row[column]) for row in [heads, *rows]) for column in range(len(heads))]
    lines = ["  ".join(word.ljust(width) for word, width in zip(row, widths)).rstrip() for row in [heads, *rows]]
    return "\n".join([f"{len(failed)} of {total} points failed:", *(f"  {line}" for line in lines)])
