"""What all scripts here are asked: where to write, and how much coarser than they are meant to be."""

import argparse
from pathlib import Path

import pycav

CASES = Path(__file__).parents[2] / "cases"


def ask(description: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=description.strip().splitlines()[0])
    parser.add_argument("--out", type=Path, default=Path("runs/python"), help="directory for runs and pictures")
    parser.add_argument("--coarser", type=int, default=0, metavar="N", help="N times half the resolution")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    return options


def coarser(case: pycav.Case, times: int, **levels: int) -> pycav.Case:
    """The case with fewer levels of refinement than `levels` says of each medium: fluid=6, solid=7."""
    return case.with_({f"{medium}.levels": level - times for medium, level in levels.items()})
