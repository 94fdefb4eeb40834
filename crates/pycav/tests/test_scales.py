"""Pictures of a case in other units, as scaled studies have them: scales come from the data, and show what those in SI show."""

from __future__ import annotations

import numpy as np
import pytest

import pycav
from pycav.paraview import _clock

SLOWER, DENSER = 1e-2, 10.0
"""Speeds and densities over those in SI; lengths are the same."""
TIMES = [1e-5, 2e-5, 4e-5]
WINDOW = (-0.02, 0.04, 0.02)


@pytest.fixture(scope="module")
def pair(small, tmp_path_factory):
    """The same run twice: in SI, and with its units."""
    root = tmp_path_factory.mktemp("scales")
    steel = {"density": 7850.0, "c1": 5900.0, "c2": 3200.0}
    si = {"time.end": 5e-5, "time.snapshots": TIMES, "solid.material": steel}
    force = DENSER * SLOWER**2
    scaled = {
        "time.end": 5e-5 / SLOWER, "time.snapshots": [time / SLOWER for time in TIMES], "fluid.liquid.pi": 3e8 * force,
        "fluid.ambient.density": 1e3 * DENSER, "fluid.ambient.pressure": 5e7 * force, "fluid.region.0.density": 0.0266 * DENSER,
        "fluid.region.0.pressure": 2118.0 * force, "solid.material": {"density": 7850.0 * DENSER, "c1": 5900.0 * SLOWER, "c2": 3200.0 * SLOWER}}
    return [pycav.run(small.with_(changes), root / name) for name, changes in (("si", si), ("scaled", scaled))]


def colours(figure):
    """The places of all images' values on their scales."""
    return [image.norm(np.asarray(image.get_array(), float)) for axes in figure.axes for image in axes.images]


@pytest.mark.parametrize("kind", ["close_up", "interface_continuity", "streamlines"])
def test_pictures_are_the_same_in_any_units(kind, pair):
    time = TIMES[-1]
    one, other = (colours(getattr(pycav.plot, kind)(run, at, WINDOW)) for run, at in zip(pair, (time, time / SLOWER)))
    assert len(one) == len(other) > 1
    for place, there in zip(one, other):
        assert np.asarray(place) == pytest.approx(np.asarray(there), abs=0.02, nan_ok=True)


def test_bars_have_ticks_in_any_units(pair):
    for run, at in zip(pair, (TIMES[-1], TIMES[-1] / SLOWER)):
        for kind in ("close_up", "interface_continuity"):
            figure = getattr(pycav.plot, kind)(run, at, WINDOW)
            (bar,) = [axes for axes in figure.axes if axes.get_xlabel().startswith("$v_z$") and not axes.lines]
            assert len(bar.get_xticks()) >= 5, (kind, run)


def test_the_clock_in_paraview_tells_snapshots_apart(pair):
    for times, told in [
            (pair[0].fluid.times, (1e6, "us", 2)), (pair[1].fluid.times, (1e3, "ms", 2)), (np.array([0.0, 1e-9, 2e-3]), (1e3, "ms", 6)),
            (np.array([0.0]), (1.0, "s", 2))]:
        assert tuple(_clock(times).values()) == (pytest.approx(told[0]), *told[1:])
