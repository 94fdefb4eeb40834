"""Reference curves, and how far a run's histories are from them."""

import zipfile
from pathlib import Path

import numpy as np

EXACT = Path(__file__).with_name("exact.zip")


def curves(place):
    """A directory of reference curves, or an archive that holds one."""
    place = Path(place)
    return place if place.is_dir() else zipfile.Path(place)


def stems(folder):
    """Names of the curves in a folder of `curves`, in order."""
    return sorted(path.name.removesuffix(".csv") for path in folder.iterdir() if path.name.endswith(".csv"))


def read(path):
    """A CSV with `#` lines, one header line and numbers: its columns by name."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    numbers = np.array([line.split(",") for line in lines[1:]], dtype=float)
    return dict(zip(lines[0].split(","), numbers.T))


def misfit(times, values, reference_times, reference_values, until=np.inf):
    """‖y − y_ref‖₂ / ‖y_ref‖₂ of one or several series together, at the reference's times.

    - `values`, `reference_values`: one row a series; linear in between the run's samples.
    - `until`: later times do not count.
    """
    counts = reference_times <= min(until, times[-1] * (1 + 1e-9))
    at = reference_times[counts]
    ours = np.array([np.interp(at, times, row) for row in np.atleast_2d(values)])
    exact = np.atleast_2d(reference_values)[:, counts]
    return np.linalg.norm(ours - exact) / np.linalg.norm(exact)


def order(coarse, fine, ratio=2.0):
    """The order of convergence that two errors on grids of that ratio show."""
    return np.log(coarse / fine) / np.log(ratio)


def first_half(times, values, before):
    """When a series first passes half of its first extremum, after scaling with its largest value before `before`.

    The first extremum is the first local one of more than a tenth of the largest value.
    """
    early = times < before
    t, y = times[early], values[early]
    y = y / np.max(np.abs(y))
    turns = np.flatnonzero((np.abs(y[1:-1]) >= np.abs(y[:-2])) & (np.abs(y[1:-1]) > np.abs(y[2:]))) + 1
    turns = turns[np.abs(y[turns]) > 0.1]
    if not len(turns):
        return np.nan
    half = 0.5 * y[turns[0]]
    k = int(np.argmax(y * np.sign(half) >= abs(half)))
    return np.interp(abs(half), np.abs(y[k - 1 : k + 1]), t[k - 1 : k + 1])
