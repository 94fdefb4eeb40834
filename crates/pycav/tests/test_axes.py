"""Axes of maps: the directories of their points, their labels, and how points of several maps find each other."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import xarray

import pycav
from pycav.sweeps.dataset import parameters
from pycav.sweeps.points import Axes, at_point, labels

SOFT, HARD = ({"law": "perfect", "yield_strength": strength} for strength in (1e7, 3e7))


@pytest.fixture(scope="module")
def short(small):
    return small.with_({"time.end": 2e-5, "time.snapshots": []})


@pytest.fixture(scope="module")
def switched(short, tmp_path_factory):
    """A map over a truth value and another parameter, with its file."""
    root = tmp_path_factory.mktemp("axes")
    data = pycav.sweep(short, {"time.cfl": [0.3, 0.4], "time.local_steps": [True, False]}, root / "runs", progress=False, to=root / "map.nc",
                       measure=lambda run: {"steps": (run.summary["steps"], "1"), "cells_per_radius": (run.cells_per_radius, "1"),
                                            "local": (run.parameters["time"]["local_steps"] is True, "1")})
    return data, root


@pytest.mark.parametrize(("values", "names"), [
    (["runs/one", "runs-one", "two"], ["runs-one_0", "runs-one_1", "two"]),
    (["a/b", "a-b", "a-b-1", "a-b_1"], ["a-b_0", "a-b_1", "a-b-1_2", "a-b-1_3"]),
    (["1", {"c1": 1.0}], ["1_0", "1_1"]), ([1.5, 2.0], ["1.5", "2.0"]), ([True, "auto", np.False_], ["true", "auto", "false"])])
def test_no_two_points_share_a_directory(values, names):
    found = Axes({"solid.initial": values, "stand_off": [1.5]}).places(Path("out"))
    assert [place.name for place in found] == [f"initial={name},stand_off=1.5" for name in names]


def test_values_label_their_axis():
    assert labels([True, False]) == [True, False] and labels([1e7, 2e7]) == [1e7, 2e7] and labels(["copper", SOFT]) == ["copper", "1"]
    assert labels(["auto", True, False]) == ["auto", "true", "false"] and labels([SOFT, HARD]) == [0, 1]


def test_a_bubble_is_placed_once(small):
    """The stand-off would win, and every place of the sweep be the same run."""
    for change in ({"fluid.region.0.centre": [0.03, 0.0]}, {}):
        moved = None if change else lambda point: {"fluid.region.0.centre": [0.03, 0.0]}
        with pytest.raises(ValueError, match="stand_off and 'fluid.region.0.centre' both say where the bubble is"):
            at_point(small, {"stand_off": 1.2} | change, moved)


@pytest.mark.parametrize("name", ["standoff", "stand-off", "StandOff", "fluid.stand_off"])
def test_a_stand_off_by_another_name_is_told_its_own(name, short, tmp_path):
    """The case knows no such key and can only tell those that it has, of which none is meant."""
    with pytest.raises(ValueError, match=f"'{name}' is no key of a case: did you mean 'stand_off'"):
        pycav.sweep(short, {name: [1.0, 2.0]}, tmp_path)
    with pytest.raises(TypeError, match="3 is a int"):
        pycav.sweep(short, {3: [1.0]}, tmp_path)


@pytest.mark.parametrize(("values", "kind", "told"), [
    ([2e7, None], TypeError, r"fluid\.ambient\.pressure has None, which has no place in a case file"),
    ([True, "true"], ValueError, r"has 'true' twice")])
def test_values_that_are_none_or_look_alike_are_refused(values, kind, told, short, tmp_path):
    with pytest.raises(kind, match=told):
        pycav.sweep(short, {"fluid.ambient.pressure": values}, tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("ending", ["nc", "zarr"])
def test_truth_values_are_found_by_their_values(ending, switched):
    data, root = switched
    path = pycav.save_map(data, root / f"again.{ending}")
    with xarray.open_dataset(path, engine="zarr" if ending == "zarr" else "h5netcdf") as found:
        for own in (data, found.load()):
            assert own["time.local_steps"].dtype == bool
            assert [float(own["local"].sel({"time.local_steps": value})[0]) for value in (True, False)] == [1.0, 0.0]
    assert pycav.bends(path, "steps")[0].axis == "time.cfl", "a truth value is no number to refine"


def test_truth_values_stand_in_pictures(switched):
    data, _ = switched
    assert [line.get_label() for line in pycav.plot.sweep_lines(data, "steps", x="time.cfl").axes[0].lines] == ["True", "False"]
    across = pycav.plot.sweep_lines(data, "steps", x="time.local_steps").axes[0]
    assert [tick.get_text() for tick in across.get_xticklabels()] == ["False", "True"]
    fields = pycav.plot.damage_map(data.expand_dims({"solid.material": ["steel"]}), "steps", x="time.local_steps", y="time.cfl")
    assert [tick.get_text() for tick in fields.axes[0].get_xticklabels()] == ["False", "True"]


def over(name, values, depths, cells):
    """A map of pits over one parameter, as `sweep` returns it."""
    data = np.array(depths, float)
    return xarray.Dataset(
        {"pit_depth": ((name,), data, {"units": "m"}), "cells_per_radius": ((name,), np.full(data.shape, cells)),
         "status": ((name,), np.zeros(data.shape, np.int8))}, Axes({name: values}).coordinates(), {"parameters": json.dumps({name: values})})


@pytest.mark.parametrize(("name", "values"), [("solid.plasticity", [SOFT, HARD]), ("solid.adapt", [True, False]), ("material", ["steel", SOFT])])
def test_points_of_other_grids_are_paired_by_value(name, values):
    """Two grids: four times the difference, of 8 and 9, and of 4 and 4."""
    data, other = over(name, values, [8.0, 4.0], 10.0), over(name, values[::-1], [4.0, 9.0], 20.0)
    for own in (other, other.isel({name: [1, 0]})):
        assert list(pycav.with_uncertainty(data, own)["pit_depth_uncertainty"].values) == [4.0, 0.0]
    # Of one point alone the share of the other is that of the worst.
    assert list(pycav.with_uncertainty(data, other.isel({name: [1]}))["pit_depth_convergence"].values) == [7, 0]
    named = [own.assign_coords({name: own_names}) for own, own_names in ((data, ["a", "b"]), (other, ["b", "a"]))]
    assert list(pycav.with_uncertainty(*named)["pit_depth_uncertainty"].values) == [4.0, 0.0], "names of one's own count"


def test_maps_of_other_tables_have_no_point_in_common():
    other = {"law": "perfect", "yield_strength": 5e7}
    with pytest.raises(ValueError, match=r"no point in common: law is \{.* 10000000.0\} in the one and \{.* 50000000.0\} in the other"):
        pycav.with_uncertainty(over("law", [SOFT], [8.0], 10.0), over("law", [other], [9.0], 20.0))


def test_the_parameters_of_a_part_are_its_own():
    data = over("law", [SOFT, HARD], [8.0, 4.0], 10.0)
    assert parameters(data.isel(law=[1])) == {"law": [HARD]} and parameters(data.isel(law=[1, 0])) == {"law": [HARD, SOFT]}
    # A file from before truth values were labels.
    before = over("adapt", [True, False], [8.0, 4.0], 10.0).assign_coords(adapt=[0, 1])
    assert parameters(before.isel(adapt=[1])) == {"adapt": [False]}
