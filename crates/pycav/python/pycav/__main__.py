"""`pycav`: the command line of `cav`, and reports.

    pycav report RUN_DIR [--out PAGE.html]
    pycav run CASE ...          as `cav run CASE ...`; likewise all commands of `cav`, see `pycav --help`
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence

from . import _pycav

PROGRAM = [sys.executable, "-m", "pycav"]
"""The command line of `cav` as this installation has it, for the processes of a run."""

REPORT = ("report", "Write one self-contained page on a run; see pycav report --help")
"""What helps and completions say of the command that Python does itself."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Does what a command line says; returns the exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given[:1] == ["report"]:
        return _report(given[1:])
    return _pycav.main(["pycav", *given], PROGRAM, [REPORT])


def _report(given: list[str]) -> int:
    from ._report import report

    parser = argparse.ArgumentParser(prog="pycav report", description="Write one self-contained page on a run.")
    parser.add_argument("run", metavar="RUN_DIR", help="directory of a run")
    parser.add_argument("--out", metavar="PAGE.html", help="the page [default: report.html in the directory]")
    options = parser.parse_args(given)
    try:
        print(report(options.run, options.out))
    except (OSError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
