"""Planes that reach below r = 0, of which both halves are there: no picture mirrors them, or takes r_min for an axis."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import pytest

import pycav
import pycav.plot.section
from pycav.plot import flow

WINDOW = (-0.01, 0.04, 0.02)


@pytest.fixture(scope="module")
def plane(small, tmp_path_factory):
    """A cylinder of gas that collapses at r = −20 mm, in a plane from −40 to 20 mm."""
    case = small.with_({
        "geometry": "planar", "fluid.r": [-0.04, 0.02], "solid.r": [-0.04, 0.02], "fluid.z": [0.01, 0.05], "solid.z": [-0.03, 0.01],
        "fluid.cells": [4, 6], "solid.cells": [16, 24], "fluid.region.0.centre": [0.03, -0.02], "time.snapshots": [1e-5, 2e-5, 3e-5]})
    return pycav.run(case, tmp_path_factory.mktemp("plane") / "run")


def labels(axis):
    return {round(place * 1e3): text.get_text() for place, text in zip(axis.get_ticklocs(), axis.get_ticklabels())}


def test_axes_say_r_as_it_is(plane, result):
    for draw in (pycav.plot.schlieren, pycav.plot.grid_levels):
        shown = labels(draw(plane).axes[0].yaxis)
        assert shown[-20].replace("−", "-") == "-20" and shown[20] == "20"
    overview = pycav.plot.overview(plane)
    assert "at r = " in overview.texts[0].get_text() and "off axis" not in overview.texts[0].get_text()
    below = labels(overview.axes[1].xaxis)
    assert below[-20].replace("−", "-") == "-20" and below[20] == "20"
    assert not any("−" in text or "-" in text for text in labels(pycav.plot.overview(result).axes[1].xaxis).values()), "|r| about an axis"


def test_an_overview_reaches_as_far_to_either_side(plane):
    assert pycav.plot.overview(plane).axes[0].get_xlim() == pytest.approx((-0.04, 0.02))
    assert pycav.plot.overview(plane, reach=0.01).axes[0].get_xlim() == pytest.approx((-0.01, 0.01))
    assert pycav.plot.overview(plane, reach=0.03).axes[0].get_xlim() == pytest.approx((-0.03, 0.02))


def test_lengths_have_the_unit_of_the_farthest_place(plane):
    section = pycav.plot.section.Section.of(plane, None, None)
    section.box = (-1e-4, 1e-4, -0.04, 1e-4)
    assert section.length_scale[1] == "m"


def test_particles_stay_on_their_side(plane):
    start = np.array([[0.03, -0.035], [0.03, -0.005]])
    track = flow.advect(plane.fluid, start, 3e-5, 4)
    assert track[0, -1, 1] == pytest.approx(-0.034, abs=0.001) and track[1, -1, 1] == pytest.approx(-0.006, abs=0.001)
    assert track[0, -1, 1] > -0.035 and track[1, -1, 1] < -0.005, "towards the gas"


def test_a_plane_is_not_turned_about_an_axis(plane):
    with pytest.raises(ValueError, match="the run is planar: it has no axis"):
        pycav.plot.volume(plane)


def test_streamlines_fill_the_plane_evenly(plane):
    """The number of lines was that of a plane up to r_max, and r_min had none."""
    figure = pycav.plot.streamlines(plane)
    lines = [line for lines in figure.axes[0].collections if isinstance(lines, mpl.collections.LineCollection) for line in lines.get_segments()]
    low, high = (end(line[:, 1].min() if end is min else line[:, 1].max() for line in lines) for end in (min, max))
    assert low < -0.039 and high > 0.018
