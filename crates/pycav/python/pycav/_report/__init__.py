"""One self-contained page on a run: the answer, pictures over time, curves, damage, how far to trust it."""

from __future__ import annotations

import os
from pathlib import Path

from ..plot.section import Run
from ..result import open_run
from .curves import charts, profile, write_csv
from .page import page

__all__ = ["page", "report"]


def report(run: Run, out: str | os.PathLike[str] | None = None, *, csv: str | os.PathLike[str] | None = None) -> Path:
    """Writes an HTML page on a run, with everything in it: the answer, pictures of all snapshots, curves, key numbers, damage, health.

    The page is one file and asks for nothing from elsewhere.

    - `out`: the page; else `report.html` in the run directory. Returns its path.
    - `csv`: a directory, into which the curves go as CSV besides, with all rows and digits, in SI units.
    """
    result = open_run(run)
    path = result.directory / "report.html" if out is None else Path(out)
    if path.suffix.lower() not in ("", ".html", ".htm"):
        raise ValueError(f"a report is an HTML page, which {path.name} does not say: give a name that ends in .html (a browser prints it to PDF)")
    path.write_text(page(result), encoding="utf-8")
    if csv is not None:
        write_csv([*charts(result), *profile(result)], Path(csv))
    return path
