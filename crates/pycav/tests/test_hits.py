"""Many hits on one wall."""

from __future__ import annotations

import ast
import json
import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import pycav
from pycav.sweeps.measures import measures

PULSE = {
    "time": {"end": 5e-6},
    "solid": {
        "z": [-0.008, 0.0], "r": [0.0, 0.008], "cells": [16, 16], "levels": 2,
        "material": {"density": 7800.0, "c1": 5990.0, "c2": 3458.0},
        "plasticity": {"law": "linear", "yield_strength": 4e8, "hardening_modulus": 3e9},
    },
    "coupling": {"scheme": "load", "load": {
        "amplitude": 1.2e9, "radius": 1e-3, "history": [[0.0, 0.0], [0.5e-6, 1.0], [1e-6, 0.0]]}},
}


def test_a_wall_that_hardens_takes_less_from_every_hit(tmp_path: Path) -> None:
    seen: list[int] = []
    case = pycav.Case.from_dict(PULSE)
    data = pycav.hits(case, 4, tmp_path, progress=lambda hit, result: seen.append(hit))
    assert seen == [1, 2, 3, 4] and list(data.hit) == seen
    first = pycav.open(tmp_path / "load").summary
    # The record of the run, put on the same wall, does what the run's own load did.
    assert data.pit_depth[0] == pytest.approx(first["pit_depth"], rel=3e-3)
    assert data.plastic_work[0] == pytest.approx(first["plastic_work"], rel=3e-3)
    assert (np.diff(data.plastic_strain_peak) > 0).all() and (np.diff(data.pit_depth) > 0).all()
    # Isotropic hardening shakes down: each hit does less work than the one before.
    assert (np.diff(data.plastic_work) < 0).all()
    assert data.plastic_work.units == "J" and data.pit_depth.units == "m"
    # What it is and where it is from, as a sweep's dataset says it.
    assert all(variable.attrs["long_name"] for variable in data.variables.values())
    told = pycav.open(tmp_path / "hit-1").histories.attrs
    assert data.attrs["case_hash"] == case.hash and data.attrs["load"] == str(tmp_path / "load")
    assert data.attrs["git_revision"] == told["git_revision"] and data.attrs["program"] == told["program"] and told["program"]
    # What is there is not run again; more hits go on from it.
    times = [Path(place, "summary.json").stat().st_mtime_ns for place in data.directory.values]
    more = pycav.hits(tmp_path / "load", 5, tmp_path)
    assert times == [Path(place, "summary.json").stat().st_mtime_ns for place in more.directory.values[:4]]
    np.testing.assert_array_equal(more.pit_depth[:4], data.pit_depth)


def test_perfect_plasticity_goes_on_and_changes_reach_every_hit(tmp_path: Path) -> None:
    case = pycav.Case.from_dict(PULSE)
    (example,) = re.findall(r"`(\{.*\})`", pycav.hits.__doc__ or "")
    soft = pycav.hits(case, 2, tmp_path, solid=ast.literal_eval(example))
    for place in soft.directory.values:
        assert pycav.open(place).parameters["solid"]["plasticity"]["law"] == "perfect"
    first = pycav.open(tmp_path / "load").summary
    assert soft.plastic_strain_peak[0] > first["plastic_strain_peak"]


def test_wholes_of_planar_runs_are_per_metre_of_depth(tmp_path: Path) -> None:
    case = pycav.Case.from_dict({**PULSE, "geometry": "planar", "sensor": [{"name": "strip", "radius": 1e-3}]})
    data = pycav.hits(case, 1, tmp_path)
    assert [data[name].units for name in ("pit_volume", "plastic_work", "work_on_solid", "pit_depth")] == ["m2", "J/m", "J/m", "m"]
    loading = pycav.open(tmp_path / "load")
    found = measures(loading)
    assert [found[name][1] for name in ("plastic_work", "pit_volume", "pit_depth")] == ["J/m", "m2", "m"]
    assert found["sensors.strip.force_peak"][1] == "N/m" and found["sensors.strip.impulse"][1] == "N s/m"
    table = loading.key_numbers
    assert table.unit["plastic_work"] == "J/m" and table.unit["yielded_volume_peak"] == "m2"
    assert "J/m" in repr(table) and "m²" in repr(table)
    histories = {"solid/yielded_volume": "m2", "solid/plastic_work": "J/m", "sensors/strip/force": "N/m", "sensors/strip/impulse": "N s/m",
                 "conservation/solid/mass": "kg/m", "conservation/solid/energy": "J/m", "conservation/solid/momentum_z": "N s/m"}
    assert {name: loading.histories[name].units for name in histories} == histories


def test_what_cannot_be_hit_is_refused(tmp_path: Path) -> None:
    elastic = pycav.Case.from_dict({**PULSE, "solid": {**PULSE["solid"], "plasticity": None}})
    with pytest.raises(ValueError, match="cannot yield"):
        pycav.hits(elastic, 1, tmp_path / "elastic")
    with pytest.raises(ValueError, match="1 hit or more"):
        pycav.hits(elastic, 0, tmp_path)
    with pytest.raises(FileNotFoundError, match="no run directory"):
        pycav.hits(tmp_path / "nowhere", 1, tmp_path)


@pytest.mark.parametrize(("given", "error", "says"), [
    ({"n": "3"}, TypeError, "n = '3' is a str: give a whole number"), ({"n": 2.5}, TypeError, "n = 2.5"), ({"n": True}, TypeError, "n = True"),
    ({"n": 1, "longest": -1.0}, ValueError, "longest = -1"), ({"n": 1, "longest": "1e-5"}, TypeError, "longest = '1e-5' is a str"),
    ({"n": 1, "threads": 0}, ValueError, "threads = 0")])
def test_arguments_of_another_kind_are_named(given, error, says, tmp_path: Path) -> None:
    with pytest.raises(error, match=says):
        pycav.hits(pycav.Case.from_dict(PULSE), out=tmp_path, **given)
    assert not list(tmp_path.iterdir()), "nothing is run before"


def test_hits_shorter_than_their_load_are_warned_of_and_its_run_is_left_alone(tmp_path: Path) -> None:
    load = pycav.run(pycav.Case.from_dict(PULSE), tmp_path / "load")
    with pytest.warns(UserWarning, match="longest = 4e-07 s ends each hit before its load, which was recorded for 5e-06 s"):
        short = pycav.hits(load, 1, tmp_path / "short", longest=4e-7)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        whole = pycav.hits(load, 1, tmp_path / "whole", longest=6e-6)
    assert short.plastic_work[0] < 0.9 * whole.plastic_work[0]
    there = sorted(load.directory.iterdir())
    for run in (load, load.directory, str(load.directory / ".." / "load")):
        with pytest.raises(ValueError, match="directory of the run that gives the load"):
            pycav.hits(run, 1, load.directory)
    assert sorted(load.directory.iterdir()) == there


def test_only_a_finished_run_has_a_load(tmp_path: Path) -> None:
    place = tmp_path / "stopped"
    with pycav.Simulation(pycav.Case.from_dict(PULSE), out=place) as simulation:
        simulation.step()
        simulation.histories
        with pytest.raises(ValueError, match=r"stopped is running.*wait"):
            pycav.hits(place, 1, tmp_path / "hits")
    with pytest.raises(ValueError, match=r"stopped is interrupted.*--resume"):
        pycav.hits(place, 1, tmp_path / "hits")
    with pytest.raises(ValueError, match="interrupted"):
        pycav.hits(pycav.open(place), 1, tmp_path / "hits")
    summary = place / "summary.json"
    summary.write_text(json.dumps(json.loads(summary.read_text()) | {"error": "NaN"}))
    with pytest.raises(ValueError, match="failed"):
        pycav.hits(place, 1, tmp_path / "hits")


def test_hits_are_run_again_with_their_load(tmp_path: Path) -> None:
    """The case of a hit names the directory of the load; its hash tells that there is another run in it."""
    case = pycav.Case.from_dict(PULSE)
    short = pycav.hits(case, 2, tmp_path)
    # Of the same peak, from which the scales of a hit's grid follow: all of the hit's case is the same.
    longer = pycav.hits(case.with_({"coupling.load.history": [[0.0, 0.0], [0.5e-6, 1.0], [2e-6, 0.0]]}), 2, tmp_path)
    assert (longer.pit_depth > 1.1 * short.pit_depth).all()
