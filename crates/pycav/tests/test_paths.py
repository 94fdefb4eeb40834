"""Paths of particles."""

from __future__ import annotations

import re
import warnings

import numpy as np
import pytest
from matplotlib.text import Text

import pycav
from pycav.plot import flow

WINDOW = (-0.04, 0.04, 0.03)


def texts(figure):
    return "\n".join(text.get_text() for text in figure.findobj(Text))


def test_particles_move_with_the_flow(result):
    start = np.array([[0.035, 0.001], [0.02, 0.02]])
    track = flow.advect(result.fluid, start, 36e-6, 4)
    assert track.shape == (2, 8, 2) and np.array_equal(track[:, 0], start)
    assert track[0, -1, 0] < 0.0345 and track[1, -1, 1] < 0.0195, "towards the bubble that collapses"
    finer = flow.advect(result.fluid, start, 36e-6, 16)
    assert np.abs(track - finer).max() < 2e-5


def test_pathlines_tell_what_they_enlarge(result):
    with pytest.warns(UserWarning, match="the velocity is linear between 13 snapshots") as told:
        figure = pycav.plot.pathlines(result, WINDOW, spacing=8e-3, substeps=2)
    assert ["in the fluid" in str(one.message) for one in told] == [True, False] and {one.filename for one in told} == {__file__}
    assert "times enlarged" in texts(figure) and "Pathlines up to $t$ = 56 µs" in texts(figure)


def test_a_wall_that_yields_is_displaced_as_the_solver_says(tmp_path):
    """From the velocities of four snapshots the largest displacement was 13 µm instead of 3.5 µm."""
    run = pycav.run(pycav.wall_load(cells_per_radius=8.0), tmp_path / "run")
    largest = [float(np.hypot(*snapshot["displacement"][:, :2].T).max()) for snapshot in run.solid]
    mesh = run.solid[0].mesh
    track = flow.displaced(run.solid, mesh.centre(), run.solid.times[-1])
    assert track.shape == (len(mesh), 4, 2) and np.array_equal(track[:, 0], mesh.centre())
    assert np.hypot(*np.moveaxis(track - track[:, :1], -1, 0)).max(0) == pytest.approx(largest, rel=1e-9)
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # snapshots are enough, however few
        figure = pycav.plot.pathlines(run, spacing=2e-4)
    (told,) = re.findall(r"largest ([0-9.]+) µm", texts(figure))
    assert 0.8 * max(largest) < 1e-6 * float(told) < 1.05 * max(largest)
