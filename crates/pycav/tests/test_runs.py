"""The table of the runs in a folder."""

from __future__ import annotations

import numpy as np
import pandas
import pytest

import pycav


@pytest.fixture(scope="module")
def folder(small, tmp_path_factory):
    """Three runs: two radii, and one that was stopped."""
    place = tmp_path_factory.mktemp("listed")
    short = small.with_({"time.end": 1e-6, "time.snapshots": [0.0, 1e-6]})
    for name, radius in (("one", 0.01), ("deep/two", 0.008)):
        pycav.run(short.with_({"fluid.region.0.radius": radius}), place / name)
    with pycav.Simulation(short, out=place / "stopped") as simulation:
        simulation.step()
    return place


def test_runs_are_a_table_of_what_was_varied_and_what_came_of_it(folder):
    table = pycav.runs(folder)
    assert list(table.index) == ["deep/two", "one", "stopped"]
    assert list(table["state"]) == ["finished", "finished", "interrupted"]
    assert list(table["fluid.region.0.radius"]) == [0.008, 0.01, 0.01]
    assert "time.end" not in table
    summary = pycav.open(folder / "one").summary
    for key in ("wall_pressure_peak", "von_mises_peak", "cells_per_radius"):
        assert table.loc["one", key] == summary[key]
    assert table.attrs["units"]["wall_pressure_peak"] == "Pa"
    assert isinstance(table["started"].dtype, pandas.DatetimeTZDtype)
    assert (pandas.Timestamp.now("UTC") - table["started"]).max() < pandas.Timedelta(hours=1)
    assert (folder / ".cav-index.sqlite").is_file()


def test_a_running_run_is_told_from_one_that_was_stopped(folder, small):
    with pycav.Simulation(small, out=folder / "running") as simulation:
        simulation.step()
        assert pycav.runs(folder, state="running").index.tolist() == ["running"]
    assert pycav.runs(folder, state="running").empty
    assert pycav.runs(folder, where="path=running")["state"].tolist() == ["interrupted"]


def test_conditions_orders_and_columns(folder):
    def paths(**asked):
        return list(pycav.runs(folder, **asked).index)

    assert paths(where=["fluid.region.0.radius<0.009", "state=finished"]) == ["deep/two"]
    assert paths(sort="fluid.region.0.radius")[0] == "deep/two"
    chosen = pycav.runs(folder, columns=["time.end", "solid.material"], state=["finished"])
    assert list(chosen.columns) == ["time.end", "solid.material"]
    assert np.all(chosen["time.end"] == 1e-6) and np.all(chosen["solid.material"] == "structural-steel")
    assert len(pycav.runs(folder, columns="all").columns) > 100


def test_what_makes_no_sense_is_refused(folder, tmp_path):
    with pytest.raises(FileNotFoundError, match="give the folder"):
        pycav.runs(tmp_path / "absent")
    for asked in ({"where": "radius=1"}, {"state": "done"}, {"sort": "peak"}, {"where": "wall_pressure_peak"}):
        with pytest.raises(ValueError):
            pycav.runs(folder, **asked)
    assert pycav.runs(tmp_path).empty
