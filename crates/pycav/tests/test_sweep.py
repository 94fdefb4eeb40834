"""Sweeps: every point, whoever runs it, once."""

from __future__ import annotations

import multiprocessing
import subprocess
import sys
import time
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import distributed
import numpy as np
import pytest

import pycav
from pycav import _toml
from pycav.sweeps.points import at_point

MATERIALS = ["structural-steel", "aluminium"]


@pytest.fixture(scope="module")
def short(small):
    return small.with_({"time.end": 2e-5, "time.snapshots": []})


def test_every_point_is_run_and_a_bad_one_does_no_harm(short, tmp_path):
    told = []
    parameters = {"fluid.ambient.pressure": [4e7, 5e7], "solid.material": ["structural-steel", "cheese"]}
    data = pycav.sweep(short, parameters, tmp_path, progress=lambda point, how: told.append((dict(point), how)))
    assert data.sizes == {"fluid.ambient.pressure": 2, "solid.material": 2} and len(told) == 4
    good = data.sel({"solid.material": "structural-steel"})
    alone = pycav.run(short.with_({"fluid.ambient.pressure": 4e7}), tmp_path / "alone")
    assert good["von_mises_peak"][0] == alone.summary["von_mises_peak"]
    assert data["von_mises_peak"].attrs["units"] == "Pa" and list(good["error"].values) == ["", ""]
    bad = data.sel({"solid.material": "cheese"})
    assert np.isnan(bad["von_mises_peak"]).all() and all("unknown material `cheese`" in e for e in bad["error"].values)


def test_a_failing_run_is_recorded_and_tried_again(short, tmp_path):
    # The second is liquid at a hundred times its speed of sound against the wall.
    parameters = {"fluid.ambient.velocity.0": [0.0, -1e5]}
    thin = short.with_({"fluid.ambient.velocity": [0.0, 0.0], "time.end": 65e-6})
    data = pycav.sweep(thin, parameters, tmp_path)
    errors = [str(error) for error in data["error"].values.ravel()]
    assert "NumericalError" in errors[1], errors
    assert [path.read_text().count("NumericalError") for path in tmp_path.glob("*.error.json")].count(1) >= 1
    told = []
    pycav.sweep(thin, parameters, tmp_path, progress=lambda _, how: told.append(how))
    assert told.count("known") == errors.count("") and sum("NumericalError" in how for how in told) == 2 - errors.count("")


@pytest.mark.parametrize("pool", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_any_executor_will_do_and_a_sweep_goes_on_where_it_was(pool, short, tmp_path):
    parameters = {"stand_off": [1.5, 2.0], "solid.material": MATERIALS}
    first = pycav.sweep(short, {**parameters, "stand_off": [2.0]}, tmp_path / "a")
    stamps = {path: path.stat().st_mtime_ns for path in (tmp_path / "a").glob("*/summary.json")}
    told = []
    options = {} if pool is ThreadPoolExecutor else {"mp_context": multiprocessing.get_context("spawn")}
    with pool(2, **options) as executor:
        data = pycav.sweep(short, parameters, tmp_path / "a", executor=executor, threads=1,
                           progress=lambda _, how: told.append(how))
    assert sorted(told) == ["done", "done", "known", "known"]
    assert len(stamps) == 2 and all(path.stat().st_mtime_ns == stamp for path, stamp in stamps.items())
    for name in ("von_mises_peak", "wall_pressure_peak", "wall_impulse"):
        assert np.isfinite(data[name]).all()
        assert np.array_equal(data[name].sel(stand_off=[2.0]), first[name])


def test_a_finished_run_of_another_case_is_replaced_by_force_alone(short, tmp_path):
    told, parameters, other = [], {"stand_off": [1.6, 2.0]}, short.with_({"time.cfl": 0.4})
    pycav.sweep(short, {"stand_off": [2.0]}, tmp_path)
    with pytest.raises(pycav.RunError, match=r"stand_off=2\.0 holds a finished run of another case: .*force=True"):
        pycav.sweep(other, parameters, tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["stand_off=2.0"], "nothing has run"
    assert pycav.open(tmp_path / "stand_off=2.0").parameters["time"]["cfl"] != 0.4
    pycav.sweep(other, parameters, tmp_path, force=True, progress=lambda _, how: told.append(how))
    assert told == ["done", "done"] and pycav.open(tmp_path / "stand_off=2.0").parameters["time"]["cfl"] == 0.4
    with pytest.raises(pycav.RunError, match=r"stand_off=1\.6 and 1 more hold finished runs of other cases"):
        pycav.sweep(short, parameters, tmp_path)


def test_a_run_of_another_case_that_is_not_finished_is_replaced(short, tmp_path):
    with pycav.Simulation(at_point(short, {"stand_off": 2.0}), out=tmp_path / "stand_off=2.0") as simulation:
        simulation.advance_to(1e-6)
    told = []
    pycav.sweep(short.with_({"time.cfl": 0.4}), {"stand_off": [2.0]}, tmp_path, progress=lambda _, how: told.append(how))
    assert told == ["done"]


@pytest.mark.parametrize(("given", "told"), [
    (1.5, r"returned 1\.5 of .*stand_off=1\.6: .*\{name: \(value, unit\)\}"), ({"depth": 1.5}, r"returned 'depth': 1\.5 of"),
    ({"depth": (None, "m")}, r"returned 'depth': \(None, 'm'\) of"),
    ({"depth": ("m", 1.5)}, r"returned 'depth': \('m', 1\.5\)"), ({1: (1.5, "m")}, "returned 1: ")])
def test_what_is_measured_is_looked_at_with_the_first_point(given, told, short, tmp_path):
    for _ in ("a run that is made", "one that is there"):
        with pytest.raises(TypeError, match=f"measure {told}"):
            pycav.sweep(short, {"stand_off": [1.6, 2.0]}, tmp_path, measure=lambda run: given)
        assert [path.name for path in tmp_path.iterdir()] == ["stand_off=1.6"]


def test_a_cluster_of_dask_is_an_executor(short, tmp_path):
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            data = pycav.sweep(short, {"stand_off": [1.5, 2.0]}, tmp_path, executor=client.get_executor(), threads=1)
    assert (data["error"] == "").all() and np.isfinite(data["von_mises_peak"]).all()


def test_the_stand_off_is_counted_in_radii_from_the_wall(short):
    values = _toml.parse(at_point(short, {"stand_off": 1.5, "fluid.region.0.radius": 0.008}).to_toml())
    region = values["fluid"]["region"][0]
    assert region["radius"] == 0.008 and region["centre"][0] == pytest.approx(0.01 + 1.5 * 0.008)


def test_the_map_over_stand_off_and_material(short, tmp_path):
    data = pycav.stand_off_map(short, [1.6, 2.0], MATERIALS, tmp_path / "map")
    figure = pycav.plot.stand_off_map(data)
    figure.savefig(tmp_path / "map.png")
    panels = figure.axes
    assert len(panels) == 4 and [line.get_label() for line in panels[0].lines] == MATERIALS
    expected = data["wall_pressure_peak"].sel({"solid.material": "aluminium"})
    assert np.array_equal(panels[0].lines[1].get_ydata(), expected)


def test_a_key_that_no_point_can_have_is_refused_before_anything_runs(short, tmp_path):
    with pytest.raises(pycav.CaseError, match="did you mean `pressure`"):
        pycav.sweep(short, {"stand_off": [1.5, 2.0], "fluid.ambient.presure": [1e5, 2e5]}, tmp_path / "out")
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(("parameters", "kind", "told"), [
    ({"solid.material": "copper"}, TypeError, r"solid\.material = 'copper': give a list of values.*\['copper'\]"),
    ({"stand_off": 1.5}, TypeError, r"stand_off = 1\.5: give a list"),
    ({"stand_off": np.array(1.5)}, TypeError, r"stand_off = .*give a list"),
    ({"solid.material": {"density": 1e3}}, TypeError, r"solid\.material = .*give a list"),
    ({"stand_off": []}, ValueError, r"stand_off = \[\]: give one value"),
    ({"stand_off": [1.5, 2, 2.0]}, ValueError, r"stand_off has 2\.0 twice"),
    ({"solid.material": [{"c1": 1.0}, {"c1": 1.0}]}, ValueError, r"solid\.material has .* twice"),
    ({}, ValueError, "one key or more"), ([1.5], ValueError, "by key")])
def test_values_of_an_axis_are_a_list_without_repetitions(parameters, kind, told, short, tmp_path):
    with pytest.raises(kind, match=told):
        pycav.sweep(short, parameters, tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_processes_end_with_what_has_started_them(tmp_path):
    script = tmp_path / "sweeping.py"
    script.write_text("import os, time\nfrom pycav.sweeps.executors import opened\n"
                      "if __name__ == '__main__':\n    with opened('processes', 1) as pool:\n"
                      "        print(pool.submit(os.getpid).result(), flush=True)\n        time.sleep(600)\n")
    with subprocess.Popen([sys.executable, str(script)], stdout=subprocess.PIPE, text=True) as sweeping:
        worker = Path("/proc") / sweeping.stdout.readline().strip()
        assert worker.is_dir()
        sweeping.terminate()
    until = time.monotonic() + 30
    while worker.is_dir() and time.monotonic() < until:
        time.sleep(0.05)
    assert not worker.is_dir()


def bubble(**radii):
    """A case with a bubble by what is in it, 1 mm above a wall at z = 0.5 mm, and a drop besides."""
    return pycav.Case.from_dict({
        "time": {"end": 1e-6}, "coupling": {"scheme": "rigid"},
        "fluid": {"z": [5e-4, 9e-3], "r": [0.0, 8e-3], "cells": [4, 4], "levels": 2, "liquid": {"fluid": "water-tait"}, "gas": {"fluid": "air"},
                  "ambient": {"density": 998.0, "pressure": 1e5},
                  "region": [{"shape": "box", "z": [7e-3, 8e-3], "r": [0.0, 1e-3], "phase": "liquid", "density": 998.0, "pressure": 1e5}],
                  "bubble": {"centre": [2e-3, 0.0], **radii}}})


@pytest.mark.parametrize("radius", ["radius_max", "radius"])
def test_a_described_bubble_is_moved_by_its_largest_radius(radius):
    case = bubble(**{radius: 1e-3, "equilibrium_radius": 5e-4})
    moved = _toml.parse(at_point(case, {"stand_off": 1.5}).to_toml())["fluid"]
    spheres = [region for region in moved["region"] if region["shape"] == "sphere"]
    assert [sphere["centre"] for sphere in spheres] == [[pytest.approx(2e-3), 0.0]]
    moved = _toml.parse(at_point(case, {"stand_off": 3.0, f"fluid.bubble.{radius}": 2e-3}).to_toml())["fluid"]
    assert [region["centre"] for region in moved["region"] if region["shape"] == "sphere"] == [[pytest.approx(6.5e-3), 0.0]]


def test_the_largest_radius_of_a_bubble_that_grows_is_not_known(tmp_path):
    laser = pycav.laser_bubble(stand_off=1.5)
    for case, key in ((laser, "fluid.bubble.centre"), (pycav.Case.from_toml(laser.to_toml()), "fluid.region.0.centre")):
        with pytest.raises(ValueError, match=f"stand_off is of the largest radius.*sweep over '{key}' instead"):
            pycav.sweep(case, {"stand_off": [1.5, 2.0]}, tmp_path, progress=False)
        assert at_point(case, {key: [9e-4, 0.0]}) != case
    with pytest.raises(ValueError, match="stand_off needs a bubble"):
        at_point(pycav.wall_load(), {"stand_off": 1.5})
