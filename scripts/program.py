"""Runs of the program for tables: the command, its options, and what is kept of former runs."""

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pycav

ROOT = Path(__file__).resolve().parents[1]
FAILED = []  # exit codes of the runs that `solve` has seen fail


def parser(doc, out=None):
    """Arguments that scripts which run `cav` have in common; `out` is the directory of the runs if --out is not given."""
    found = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    found.add_argument("--cav", type=Path, default=ROOT / "target/release/cav", help="the program")
    if out:
        found.add_argument("--out", type=Path, default=Path(out), help="directory of the runs")
    return found


def run_table(doc, out, tables, add_options):
    """Prints the table that the command line names; tables are functions of the options. Ends with 1 if a run has failed."""
    arguments = parser(doc, out)
    arguments.add_argument("table", choices=tables)
    add_options(arguments)
    options = arguments.parse_args()
    tables[options.table](options)
    sys.exit(1 if FAILED else 0)


def command(cav, case, out, changes=(), *more):
    """`cav run` of a case with changes as --set has them, KEY=VALUE."""
    sets = [part for change in changes for part in ("--set", change)]
    return [str(cav), "run", str(case), "--out", str(out), "--quiet", "--force", *more, *sets]


def usage(command, **options):
    """Runs a command, with options as `subprocess.Popen` has them, and ends the script where it fails; wall time, s, and the system's account."""
    start = time.perf_counter()
    process = subprocess.Popen(command, **options)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"{' '.join(command)} ended with {process.returncode}")
    return time.perf_counter() - start, used


def is_complete(directory):
    summary = directory / "summary.json"
    return summary.exists() and json.loads(summary.read_text()).get("completed", False)


def solve(options, name, case, changes=(), *more, threads=None):
    """Runs a case's text unless its directory already holds that very run; its result, or None, and the exit code."""
    options.out.mkdir(parents=True, exist_ok=True)
    directory, path = options.out / name, options.out / f"{name}.toml"
    text = case + "".join(f"# --set {change}\n" for change in changes)
    if not (path.exists() and path.read_text() == text and is_complete(directory)):
        path.write_text(text)
        environment = os.environ | ({} if threads is None else {"RAYON_NUM_THREADS": str(threads)})
        done = subprocess.run(command(options.cav, path, directory, changes, *more), check=False, env=environment)
        if done.returncode:
            FAILED.append(done.returncode)
            return None, done.returncode
    return pycav.open(directory), 0


def fixed(value, form):
    """A number in a format such as "+.2f"; what is rounded to zero has no sign."""
    text = format(value, form)
    return text.lstrip("+-") if float(text) == 0.0 else text
