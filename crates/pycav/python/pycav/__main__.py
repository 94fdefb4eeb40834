"""`pycav`: the command line of `cav`, and reports.

    pycav report RUN_DIR [--out PAGE.html] [--csv DIR]
    pycav run CASE ...          as `cav run CASE ...`; likewise check, fluid, solid, materials
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from . import _pycav

PROGRAM = [sys.executable, "-m", "pycav"]
"""The command line of `cav` as this installation has it, for the processes of a run."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Does what a command line says; returns the exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given[:1] == ["report"]:
        return _report(given[1:])
    return _pycav.main(["pycav", *given], PROGRAM)


def _report(given: list[str]) -> int:
    from ._report import report

    parser = argparse.ArgumentParser(
        prog="pycav report", description="Write one self-contained page on a run: the answer, pictures over time, curves, damage, how far "
        "to trust it. Prints the page's path.")
    parser.add_argument("run", metavar="RUN_DIR", help="directory of a run")
    parser.add_argument("--out", metavar="PAGE.html", help="the page [default: report.html in the directory]")
    parser.add_argument("--csv", metavar="DIR", help="write the curves into this directory, too, as CSV with all rows")
    options = parser.parse_args(given)
    try:
        print(report(options.run, options.out, csv=options.csv))
    except (OSError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
