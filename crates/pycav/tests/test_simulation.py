"""Simulations: the command line's numbers, steps, callbacks, interruptions, arrays."""

from __future__ import annotations

import gc
import os
import re
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import h5py
import numpy as np
import pytest

import pycav

CHANGES = ["--set", "fluid.levels=3", "--set", "solid.levels=1"]


def datasets(path):
    """All numbers of an HDF5 file by the paths of their datasets."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def assert_same_numbers(one, other):
    compared = 0
    for name in ("fluid.h5", "solid.h5", "fluid.vtkhdf", "solid.vtkhdf"):
        a, b = datasets(one / name), datasets(other / name)
        assert a.keys() == b.keys()
        for key in a:
            assert np.array_equal(a[key], b[key], equal_nan=a[key].dtype.kind == "f"), (name, key)
        compared += len(a)
    assert compared > 100
    assert (one / "case.toml").read_text() == (other / "case.toml").read_text()


@pytest.fixture(scope="module")
def commanded(cav, tmp_path_factory):
    """What `cav run --in-process` leaves of the small case."""
    out = tmp_path_factory.mktemp("commanded") / "run"
    done = cav("run", "cases/dickopp2012-coarse.toml", *CHANGES, "--in-process", "--out", out, "-q")
    assert done.returncode == 0, done.stderr
    return out


@pytest.mark.parametrize("processes", [False, True])
def test_a_run_has_the_command_lines_numbers_to_the_last_bit(processes, small, commanded, tmp_path):
    result = pycav.run(small, tmp_path / "run", processes=processes)
    assert_same_numbers(result.directory, commanded)
    assert result.summary["completed"] and pycav.open(commanded).summary["steps"] == result.summary["steps"]


@pytest.mark.parametrize("who", ["cav", "python", "two processes"])
def test_a_run_that_is_broken_off_goes_on_from_its_checkpoint(cav, small, commanded, tmp_path, who):
    with pycav.Simulation(small, out=tmp_path / "run") as simulation:
        for _ in range(5):
            simulation.step()
    kept = [path.name for path in (tmp_path / "run" / "checkpoints").glob("fluid-*.ckpt")]
    assert kept and simulation.steps == 5 and not simulation.completed
    if who == "cav":
        done = cav("run", "--resume", tmp_path / "run", "--in-process", "-q")
        assert done.returncode == 0, done.stderr
    else:
        done = pycav.resume(tmp_path / "run", processes=who == "two processes", threads=1)
        assert done.summary["completed"] and done.directory == tmp_path / "run"
    assert_same_numbers(tmp_path / "run", commanded)
    assert pycav.resume(tmp_path / "run").summary["steps"] == pycav.open(commanded).summary["steps"], "what is finished stays as it is"
    assert pycav.resume(tmp_path / "run", end=7e-5).histories["time"].values[-1] == 7e-5
    (tmp_path / "none").mkdir()
    for name, end, words in (("run", 7e-5, "is no later"), ("none", None, r"no case\.toml")):
        with pytest.raises(pycav.RunError, match=words):
            pycav.resume(tmp_path / name, end=end)


def told(directory):
    """The log without what differs between any two runs."""
    text = re.sub(r" bytes=\d+ seconds=\S+", "", (directory / "log").read_text().replace(str(directory), "DIR"))
    return re.sub(r"in \d+\.\d s", "in S", re.sub(r"(?m)^\S+Z +(\w+) [\w:]+: ", r"\1 ", text)).splitlines()


def test_a_run_leaves_the_log_that_the_command_line_leaves(small, commanded, cav, tmp_path):
    """Two at a time, each its own."""
    with ThreadPoolExecutor(2) as pool:
        ran = list(pool.map(lambda k: pycav.run(small, tmp_path / str(k), threads=1), range(2)))
    expected = told(commanded)
    assert expected[0].startswith("INFO run ") and expected[3].startswith("INFO done") and expected[-1] == "see DIR"
    for result in ran:
        assert told(result.directory) == expected
    cav("run", "cases/dickopp2012-coarse.toml", *CHANGES, "--out", tmp_path / "two", "-q")
    # Two processes and their launcher write to it in any order.
    assert sorted(told(pycav.run(small, tmp_path / "both", processes=True).directory)) == sorted(told(tmp_path / "two"))
    with pycav.Simulation(small, out=tmp_path / "stopped") as simulation:
        simulation.step()
    (_, *kept, ended) = told(tmp_path / "stopped")
    assert len(kept) == 2 and all(line.startswith("INFO checkpoint") for line in kept), "of each side"
    assert ended.startswith("ERROR interrupted")


def test_an_adaptive_run_has_the_command_lines_numbers(cav, result, tmp_path, root):
    (tmp_path / "case.toml").write_text(result.case.to_toml())
    done = cav("run", tmp_path / "case.toml", "--in-process", "--out", tmp_path / "run", "-q")
    assert done.returncode == 0, done.stderr
    assert_same_numbers(result.directory, tmp_path / "run")


def test_histories_in_memory_are_those_of_the_files(small, commanded):
    simulation = pycav.Simulation(small)
    simulation.run()
    assert simulation.completed and simulation.time == pytest.approx(small.end, rel=1e-14)
    ours, theirs = simulation.histories, pycav.open(commanded).histories
    assert set(ours.variables) == set(theirs.variables)
    for name in theirs.variables:
        assert np.array_equal(ours[name], theirs[name], equal_nan=True), name
        assert ours[name].attrs == theirs[name].attrs
    summary = pycav.open(commanded).summary
    for key in ("wall_pressure_peak", "von_mises_peak", "collapse_time", "steps"):
        assert simulation.summary[key] == summary[key], key
    assert not simulation.step(), "nothing is left to do"


def test_steps_one_by_one_are_those_of_a_run(small, commanded):
    simulation = pycav.Simulation(small)
    assert (simulation.time, simulation.dt, simulation.steps) == (0.0, 0.0, 0)
    for number in range(1, 6):
        assert simulation.step()
        assert simulation.steps == number
    data = pycav.open(commanded).histories
    assert (simulation.time, simulation.dt) == (float(data["time"][5]), float(data["time_step"][5]))
    assert simulation.probes["wall"]["pressure"].shape == (6,)


def test_advance_to_lands_on_the_time(small):
    simulation = pycav.Simulation(small)
    for target in (3e-6, 3.1e-6, 2e-5):
        simulation.advance_to(target)
        assert simulation.time == pytest.approx(target, rel=1e-13)
        assert simulation.fields("solid").time == simulation.fields("fluid").time == simulation.time
    simulation.advance_to(2e-5 * (1 - 1e-12))  # there but for rounding
    for time, told in ((1e-6, "time = 1e-06 s is before 2e-05 s, .* no run goes back"), (1.0, "after the end"), (np.nan, "finite number")):
        with pytest.raises(ValueError, match=told):
            simulation.advance_to(time)
    simulation.advance_to(small.end)
    assert simulation.completed


def test_a_callback_sees_every_step_and_may_stop(small):
    seen = []
    simulation = pycav.Simulation(small.with_({"time.end": 2e-5, "time.snapshots": []}))
    simulation.run(callback=lambda s: seen.append((s.steps, s.time)))
    assert [step for step, _ in seen] == list(range(1, simulation.steps + 1))
    assert np.all(np.diff([at for _, at in seen]) > 0)

    class Enough(Exception):
        pass

    def stop(s):
        if s.steps == 7:
            raise Enough

    simulation = pycav.Simulation(small)
    with pytest.raises(Enough):
        simulation.run(callback=stop)
    assert simulation.steps == 7 and not simulation.closed
    simulation.step()
    assert simulation.steps == 8


def test_progress_is_shown_when_it_is_asked_for(small, tmp_path, capfd):
    short = small.with_({"time.end": 5e-6, "time.snapshots": []})
    pycav.run(short, tmp_path / "quiet")
    assert capfd.readouterr() == ("", "")
    pycav.run(short, tmp_path / "told", progress=True)
    assert "done: " in capfd.readouterr().err


def test_the_interpreter_is_free_while_steps_are_made(small):
    count, stop = [0], threading.Event()

    def work():
        while not stop.is_set():
            count[0] += 1
            time.sleep(0.001)

    thread = threading.Thread(target=work)
    simulation = pycav.Simulation(small.with_({"fluid.levels": 5, "solid.levels": 3}))
    thread.start()
    before = count[0]
    simulation.advance_to(2e-5)
    during = count[0] - before
    stop.set()
    thread.join()
    assert during > 20, "a sleep of 1 ms at a time came back at most that often"


def test_two_threads_do_not_wait_for_each_other(small):
    simulation = pycav.Simulation(small.with_({"fluid.levels": 5, "solid.levels": 3}))
    thread = threading.Thread(target=lambda: simulation.advance_to(2e-5))
    thread.start()
    refused = 0
    while thread.is_alive():
        try:
            assert 0 <= simulation.time <= 2.1e-5
        except RuntimeError as error:
            assert "another thread" in str(error)
            refused += 1
    thread.join()
    assert refused > 0 and simulation.time == pytest.approx(2e-5)


@pytest.fixture
def heeds_ctrl_c():
    """In the background of a shell processes are born deaf to interrupts, and Python leaves it at that."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_stops_within_a_step_and_the_run_can_go_on(small, heeds_ctrl_c):
    simulation = pycav.Simulation(small.with_({"fluid.levels": 6, "solid.levels": 4}))
    simulation.step()
    threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        simulation.run()
    steps = simulation.steps
    assert steps > 1 and not simulation.closed, "a whole run takes half a minute"
    assert simulation.step() and simulation.steps == steps + 1


def test_ctrl_c_stops_two_processes(small, tmp_path):
    code = ("import pycav, signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler);"
            "case = pycav.Case(sys.argv[1]).with_(**{'fluid.levels': 6, 'solid.levels': 4});"
            "pycav.run(case, sys.argv[2], processes=True)")
    path = tmp_path / "case.toml"
    path.write_text(small.to_toml())
    child = subprocess.Popen([sys.executable, "-c", code, path, tmp_path / "run"], stderr=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while not (tmp_path / "run" / "solid.h5").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    _, told = child.communicate(timeout=60)
    assert "KeyboardInterrupt" in told
    assert pycav.open(tmp_path / "run").summary["completed"] is False


def test_a_panic_is_an_exception_and_does_no_harm(small):
    simulation = pycav.Simulation(small)
    with pytest.raises(pycav.InternalError, match="on purpose"):
        simulation._native._panic()
    assert simulation.step()


def test_arrays_are_copies_and_outlive_the_simulation(small):
    simulation = pycav.Simulation(small)
    other = pycav.Simulation(small)
    fields, image = simulation.fields("fluid"), simulation.sample("fluid", [0.02, 0.03], [0.0, 0.001])
    fields["pressure"][:] = -1e99
    image["density"][:] = np.nan
    histories = simulation.histories
    simulation.step()
    other.step()
    assert np.array_equal(simulation.fields("fluid")["pressure"], other.fields("fluid")["pressure"])
    del simulation
    gc.collect()
    assert (fields["pressure"] == -1e99).all() and histories["bubble/volume"].shape == (1,)


def test_cells_are_the_leaves_and_fill_the_domain(result):
    with pycav.Simulation(result.case) as simulation:
        simulation.advance_to(2e-5)
        for medium, area in (("fluid", 0.128**2), ("solid", 0.128**2)):
            cells = simulation.fields(medium)
            assert cells.area.sum() == pytest.approx(area, rel=1e-12)
            assert np.array_equal(cells.area, cells.width_z * cells.width_r)
            assert len(np.unique(cells.level)) > 1, "the grid adapts"
            assert all(cells[name].shape == cells.z.shape for name in cells)
        stress = simulation.fields("solid")
        mises = np.sqrt(0.5 * ((stress["stress_zz"] - stress["stress_rr"])**2 + (stress["stress_rr"] - stress["stress_phiphi"])**2
                               + (stress["stress_phiphi"] - stress["stress_zz"])**2) + 3 * stress["stress_zr"]**2)
        assert np.allclose(mises, stress["von_mises"], rtol=1e-12)


def test_a_sample_at_a_cells_centre_is_the_cell(small):
    simulation = pycav.Simulation(small)
    simulation.advance_to(2e-5)
    cells = simulation.fields("fluid")
    z, r = np.unique(cells.z), np.unique(cells.r)
    image = simulation.sample("fluid", z, r)
    assert image["pressure"].shape == (32, 32)
    order = np.lexsort((cells.r, cells.z))
    for name in image:
        assert np.allclose(image[name].ravel(), cells[name][order], rtol=1e-12, atol=1e-30), name
    assert np.isnan(simulation.sample("solid", [0.02], [0.0])["von_mises"]).all(), "that is in the fluid"
    with pytest.raises(ValueError, match="no gas"):
        simulation.fields("gas")


def test_an_initial_state_from_functions(small):
    def fluid(z, r):
        assert z.shape == r.shape and z.ndim == 1
        return {"density": 1000.0, "pressure": 5e7 + 1e9 * z, "gas_fraction": np.zeros_like(r)}

    simulation = pycav.Simulation(
        small, fluid_initial=fluid, solid_initial=lambda z, r: {"stress_zz": -5e7 + 0 * z, "stress_rr": 1e9 * r})
    cells = simulation.fields("fluid")
    assert np.allclose(cells["pressure"], 5e7 + 1e9 * cells.z, rtol=1e-13)
    assert simulation.summary["min_equivalent_radius"] is None and simulation.histories["bubble/volume"][0] == 0
    solid = simulation.fields("solid")
    assert np.array_equal(solid["stress_rr"], 1e9 * solid.r) and (solid["velocity_z"] == 0).all()
    assert simulation.step()


def test_a_functions_state_is_the_cases_where_they_agree(root):
    """The shock tube's initial state cell by cell: the same run, but for the round-off of the way there and back."""
    case = pycav.Case(root / "cases/shock-tube.toml")
    plain = pycav.Simulation(case)
    start = plain.fields("fluid")
    order = np.lexsort((start.r, start.z))

    def given(z, r):
        found = order[np.lexsort((r, z)).argsort()]
        return {name: start[name][found] for name in
                ("density", "velocity_z", "velocity_r", "pressure", "gas_fraction")}

    ours = pycav.Simulation(case, fluid_initial=given)
    for simulation in (plain, ours):
        simulation.run()
    assert np.allclose(ours.fields("fluid")["pressure"], plain.fields("fluid")["pressure"], rtol=1e-9)


def test_an_adaptive_grid_asks_a_function_level_by_level(result):
    calls = []

    def bump(z, r):
        calls.append(len(z))
        d2 = (z - 0.04)**2 + r**2
        return {"density": 1000.0, "pressure": 1e5 + 1e7 * np.exp(-d2 / 0.004**2)}

    cells = pycav.Simulation(result.case, fluid_initial=bump).fields("fluid")
    assert len(np.unique(cells.level)) > 1 and len(calls) <= 6, "once for each level"
    near = (cells.z - 0.04)**2 + cells.r**2 < 0.004**2
    assert cells.level[near].min() > cells.level.min()
    d2 = (cells.z - 0.04)**2 + cells.r**2
    assert np.allclose(cells["pressure"], 1e5 + 1e7 * np.exp(-d2 / 0.004**2), rtol=1e-9)


@pytest.mark.parametrize(("given", "kind", "told"), [
    (lambda z, r: {"density": 1000.0}, KeyError, "no pressure"),
    (lambda z, r: {"density": 1e3, "pressure": 1e5, "presure": 1.0}, KeyError, "presure is none of"),
    (lambda z, r: 1 / 0, ZeroDivisionError, "division"),
    (lambda z, r: {"density": np.ones(3), "pressure": 1e5}, ValueError, "broadcast"),
    (lambda z, r: [1.0], ValueError, "dictionary"),
    (lambda z, r: {"density": -1.0, "pressure": 1e5}, pycav.NumericalError, "not physical"),
])
def test_a_bad_function_is_told_of(given, kind, told, small):
    with pytest.raises(kind, match=told):
        pycav.Simulation(small, fluid_initial=given)


def test_a_numerical_failure_is_an_exception_and_the_files_are_kept(small, tmp_path):
    # Liquid at a hundred times its speed of sound against the wall.
    case = small.with_({"fluid.ambient.velocity": [-1e5, 0.0]})
    with pytest.raises(pycav.NumericalError, match="t = "):
        pycav.run(case, tmp_path / "run")
    summary = pycav.open(tmp_path / "run").summary
    assert summary["completed"] is False and "t = " in summary["error"]
    assert "ERROR" in (tmp_path / "run" / "log").read_text()


def test_a_finished_run_is_refused_without_force(small, tmp_path):
    short = small.with_({"time.end": 1e-6, "time.snapshots": []})
    pycav.run(short, tmp_path / "run")
    with pytest.raises(pycav.RunError, match="directory with out=, or replace it with force=True"):
        pycav.run(short, tmp_path / "run")
    assert pycav.run(short, tmp_path / "run", force=True).summary["completed"]


def test_a_closed_run_is_readable(small, tmp_path):
    with pycav.Simulation(small, out=tmp_path / "run") as simulation:
        simulation.advance_to(1e-5)
        assert simulation.histories["time"].size == simulation.steps + 1, "what is in memory is written first"
        steps = simulation.steps
    result = pycav.open(tmp_path / "run")
    assert result.summary["completed"] is False and result.histories["time"].size == steps + 1
    assert simulation.closed and not simulation.step()


def test_one_medium_alone(root):
    case = pycav.Case(root / "cases/rigid-wall.toml").with_({"fluid.levels": 3, "time.end": 1e-5, "time.snapshots": []})
    simulation = pycav.Simulation(case)
    simulation.run()
    assert case.media == ["fluid"] and simulation.completed
    assert float(simulation.histories["wall/pressure_axis"][-1]) > 0
