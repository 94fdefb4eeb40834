"""`pycav`: the command line of `cav`, reports, and runs for other programs.

    pycav report RUN_DIR [--out PAGE.html] [--csv DIR]
    pycav paraview RUN_DIR [--out SCRIPT.py] [--vtu]
    pycav netcdf RUN_DIR [--out FILE.nc] [--fields NAME ...]
    pycav run CASE ...          as `cav run CASE ...`; likewise all commands of `cav`, see `pycav --help`
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from . import _pycav
from ._program import PROGRAM

OWN = [
    ("report", "Write one self-contained page on a run; see pycav report --help"),
    ("paraview", "Write a script that opens a run in ParaView; see pycav paraview --help"),
    ("netcdf", "Write a run as one NetCDF file; see pycav netcdf --help"),
]
"""What helps and completions say of the commands that Python does itself."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Does what a command line says; returns the exit code."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given[:1] == ["report"]:
        return _report(given[1:])
    if given[:1] == ["paraview"]:
        return _paraview(given[1:])
    if given[:1] == ["netcdf"]:
        return _netcdf(given[1:])
    # The script of either name speaks of itself by that.
    called = Path(sys.argv[0]).name
    return _pycav.main(["cav" if called == "cav" else "pycav", *given], PROGRAM, OWN)


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


def _paraview(given: list[str]) -> int:
    from .paraview import paraview_state

    parser = argparse.ArgumentParser(prog="pycav paraview", description="Write a script that opens a run in ParaView as a report draws it.")
    parser.add_argument("run", metavar="RUN_DIR", help="directory of a run")
    parser.add_argument("--out", metavar="SCRIPT.py", help="the script [default: paraview.py in the directory]")
    parser.add_argument("--vtu", action="store_true", help="write the snapshots as .vtu, for a ParaView before 5.12; needs meshio")
    options = parser.parse_args(given)
    return _told(lambda: paraview_state(options.run, options.out, vtu=options.vtu))


def _netcdf(given: list[str]) -> int:
    from .result import Result

    parser = argparse.ArgumentParser(prog="pycav netcdf", description="Write a run as one NetCDF file.")
    parser.add_argument("run", metavar="RUN_DIR", help="directory of a run")
    parser.add_argument("--out", metavar="FILE.nc", help="the file [default: run.nc in the directory]")
    parser.add_argument("--fields", nargs="+", default=[], metavar="NAME", help="fields of the snapshots, on a regular grid")
    parser.add_argument("--spacing", type=float, metavar="METRES", help="of that grid [default: 128 points along the longer side]")
    options = parser.parse_args(given)
    out = Path(options.out) if options.out else Path(options.run) / "run.nc"
    return _told(lambda: Result(options.run).to_netcdf(out, options.fields, spacing=options.spacing))


def _told(write: Callable[[], Path]) -> int:
    """Writes something and says where; an error is a sentence."""
    try:
        print(write())
    except (OSError, ValueError, ModuleNotFoundError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
