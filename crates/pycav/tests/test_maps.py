"""Maps: what they say while they run, their files, new points where they bend, how sure they are, their pictures."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
import xarray

import pycav
from pycav.sweeps.cost import Cost, duration
from pycav.sweeps.points import at_point
from pycav.sweeps.uncertainty import estimated

STEEL = "structural-steel"


@pytest.fixture(scope="module")
def short(small):
    return small.with_({"time.end": 2e-5, "time.snapshots": [], "sensor": [{"name": "disc", "radius": 5e-3}]})


@pytest.fixture(scope="module")
def line(short, tmp_path_factory):
    """Five runs over the driving pressure, with their file."""
    root = tmp_path_factory.mktemp("maps")
    data = pycav.sweep(short, {"fluid.ambient.pressure": [1e7, 2e7, 4e7], "solid.material": [STEEL]}, root / "runs", progress=False,
                       to=root / "map.nc")
    return data, root


def texts(figure):
    return "\n".join(text.get_text() for text in figure.findobj(mpl.text.Text))


def test_the_default_numbers_have_the_disc_and_the_resolution(line):
    data, _ = line
    run = pycav.open(data["directory"].values[0, 0])
    assert float(data["sensors.disc.pressure_peak"][0, 0]) == run.summary["sensors"]["disc"]["pressure_peak"]
    assert float(data["cells_per_radius"][0, 0]) == run.cells_per_radius
    assert data["wall_impulse"].attrs == {"units": "Pa s", "long_name": "impulse on the wall's axis"}
    assert data["fluid.ambient.pressure"].attrs["units"] == "Pa" and (data["status"] == 0).all()


def test_a_map_is_from_where_its_runs_are_from(line):
    data, _ = line
    run = pycav.open(data["directory"].values[0, 0]).to_xarray()
    for name in ("Conventions", "program", "git_revision", "source"):
        assert data.attrs[name] == run.attrs[name] != "", name
    assert run.attrs["source"] == f"{run.attrs['program']} {run.attrs['git_revision']}"
    assert data.attrs["history"] == f"{data.attrs['date_created']} pycav.sweep" and data.attrs["case_name"] == run.attrs["case_name"]


def test_a_map_tells_what_it_costs_how_far_it_is_and_what_failed(short, tmp_path, capsys):
    parameters = {"stand_off": [1.6, 2.0], "solid.material": [STEEL, "cheese"]}
    pycav.sweep(short, {"stand_off": [2.0]}, tmp_path, progress=False)
    assert capsys.readouterr().err == ""
    data = pycav.sweep(short, parameters, tmp_path)
    told = capsys.readouterr().err.splitlines()
    assert told[0].startswith("sweep: 4 points, 2 of them make no case;") and "of one core" in told[0]
    assert "stand_off 1.6, material structural-steel: done; " in told[1] and told[1].endswith(" left")
    assert told[-4] == "2 of 4 points failed:" and told[-3].split() == ["stand_off", "material", "error"]
    assert "cheese" in told[-1] and "CaseError" in told[-1]
    failed = pycav.failures(data)
    assert list(failed["stand_off"]) == [1.6, 2.0] and set(failed["solid.material"]) == {"cheese"}
    pycav.sweep(short, {"stand_off": [1.6, 2.0], "solid.material": [STEEL]}, tmp_path)
    assert "2 points, 2 of them done before" in capsys.readouterr().err
    pycav.sweep(short, parameters, tmp_path)
    assert capsys.readouterr().err.startswith("sweep: 4 points, 2 of them done before, 2 of them make no case\n")


def test_on_a_terminal_there_is_a_bar(short, tmp_path, monkeypatch):
    class Terminal(io.StringIO):
        def isatty(self):
            return True

    screen = Terminal()
    monkeypatch.setattr(sys, "stderr", screen)
    pycav.sweep(short, {"stand_off": [1.6, 2.0]}, tmp_path)
    assert "2/2" in screen.getvalue() and "left" in screen.getvalue() and "\r" in screen.getvalue()


def test_costs_are_those_of_the_check(root):
    """Cells times steps: half the cells along z and r, and half the steps."""
    coarse = pycav.Case(root / "cases/dickopp2012-coarse.toml").with_({"fluid.levels": 5, "solid.levels": 3})
    fine = pycav.Case(root / "cases/dickopp2012-coarse.toml")
    assert Cost(fine).work == pytest.approx(8 * Cost(coarse).work, rel=0.01)
    assert Cost(coarse.with_({"time.end": fine.end / 2, "time.snapshots": []})).work == pytest.approx(Cost(coarse).work / 2, rel=1e-6)
    adaptive = pycav.Case(root / "cases/dickopp2012.toml")
    # With all cells, for two threads.
    assert "1day 16h if all cells" in adaptive.check() and Cost(adaptive).seconds == 2 * 40 * 3600
    assert [duration(seconds) for seconds in (40, 720, 12600)] == ["40 s", "12 min", "3.5 h"]


def test_what_changes_with_a_point_follows_it(short, tmp_path):
    data = pycav.sweep(short, {"stand_off": [1.5, 3.0]}, tmp_path, progress=False, change=lambda point: {"time.end": 1e-6 * point["stand_off"]},
                       where=lambda point: point["stand_off"] > 2)
    assert list(data["status"].values) == [2, 0] and np.isnan(data["wall_impulse"][0]) and list(data["error"].values) == ["", ""]
    assert pycav.open(data["directory"].values[1]).summary["t_end"] == pytest.approx(3e-6)


@pytest.mark.parametrize("executor", ["threads", "processes", "dask"])
def test_the_same_call_runs_anywhere(executor, short, line, tmp_path):
    data, _ = line
    found = pycav.sweep(short, {"fluid.ambient.pressure": [1e7, 2e7], "solid.material": [STEEL]}, tmp_path, executor=executor, workers=2,
                        progress=False)
    for name in ("wall_pressure_peak", "sensors.disc.impulse"):
        assert np.array_equal(found[name], data[name][:2]) and np.isfinite(found[name]).all()


def test_an_executor_that_is_none_is_refused(short, tmp_path):
    with pytest.raises(ValueError, match="threads, processes, dask"):
        pycav.sweep(short, {"stand_off": [2.0]}, tmp_path, executor="cloud", progress=False)
    with pytest.raises(ValueError, match=".nc or .zarr"):
        pycav.sweep(short, {"stand_off": [2.0]}, tmp_path, to=tmp_path / "map.csv", progress=False)


def test_a_point_that_was_killed_goes_on_from_its_checkpoint(small, tmp_path):
    # Long enough to be killed in.
    case = small.with_({"time.snapshots": [], "fluid.levels": 5, "solid.levels": 3})
    place = tmp_path / "stand_off=2.0"
    path = tmp_path / f"{case.name}.toml"
    path.write_text(at_point(case, {"stand_off": 2.0}).to_toml())
    begun = subprocess.Popen([sys.executable, "-m", "pycav", "run", path, "--in-process", "--threads", "1", "--checkpoint-every", "50ms",
                              "--out", place, "-q"])
    # A checkpoint is one of both sides.
    while begun.poll() is None and not all(list(place.glob(f"checkpoints/{side}-*.ckpt")) for side in ("fluid", "solid")):
        pass
    begun.kill()
    begun.wait()
    log = place / "log"
    data = pycav.sweep(case, {"stand_off": [2.0]}, tmp_path, threads=1, progress=False)
    whole = pycav.run(at_point(case, {"stand_off": 2.0}), tmp_path / "whole", threads=1)
    assert float(data["wall_pressure_peak"][0]) == whole.summary["wall_pressure_peak"]
    assert "checkpoint" in log.read_text(), "it did not begin again"


@pytest.mark.parametrize("ending", ["nc", "zarr"])
def test_a_maps_file_needs_no_pycav(ending, line, tmp_path):
    data, _ = line
    path = pycav.save_map(data, tmp_path / f"map.{ending}")
    engine = {"nc": "h5netcdf", "zarr": "zarr"}[ending]
    code = (f"import sys, xarray\nfound = xarray.open_dataset({str(path)!r}, engine={engine!r})\n"
            "assert 'pycav' not in sys.modules\n"
            "print(found['wall_impulse'].sel({'fluid.ambient.pressure': 2e7}).item())\n"
            "print(found.attrs['case_hash'], found['wall_impulse'].units, found['status'].flag_meanings, found.attrs['git_revision'])")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    value, words = done.stdout.splitlines()
    assert float(value) == float(data["wall_impulse"][1, 0])
    assert words.startswith(f"{data.attrs['case_hash']} Pa s complete failed not_run ") and len(words.split()[-1]) >= 7
    with xarray.open_dataset(path, engine=engine) as found:
        xarray.testing.assert_identical(found.load().drop_vars(["error", "directory"]), data.drop_vars(["error", "directory"]))
        assert pycav.Case.from_toml(found.attrs["case"], found.attrs["case_name"]).hash == found.attrs["case_hash"]


def bent(values, x=(1.0, 2.0, 3.0, 4.0), name="stand_off"):
    """A map as `sweep` returns it, of one quantity over one parameter and two materials."""
    data = np.stack([np.array(values, float), np.zeros(len(x))], 1)
    kinds = (name, "solid.material")
    return xarray.Dataset(
        {"pit_depth": (kinds, data, {"units": "m"}), "status": (kinds, np.zeros(data.shape, np.int8)),
         "error": (kinds, np.full(data.shape, "", object))}, {name: list(x), "solid.material": ["soft", "hard"]})


def test_bends_are_the_errors_of_straight_lines():
    """x² has h² f''/8 = 1/4 in every interval of length 1, over a range of 15; a straight line has none."""
    found = pycav.bends(bent([1.0, 4.0, 9.0, 16.0]))
    assert [bend.error for bend in found] == pytest.approx([0.25 / 16.0] * 3)
    assert max(bend.error for bend in pycav.bends(bent([1.0, 2.0, 3.0, 4.0]))) == 0.0
    kink = pycav.bends(bent([0.0, 0.0, 0.0, 1.0]))
    assert {(bend.low, bend.high) for bend in kink[:2]} == {(2.0, 3.0), (3.0, 4.0)} and kink[2].error == 0.0
    assert kink[0].error == pytest.approx(1 / 8)


def test_what_grows_by_factors_is_halved_by_factors():
    data = bent([0.0, 0.0, 1.0, 5.0], (5e6, 1e7, 2e7, 4e7), "fluid.ambient.pressure")
    worst = pycav.bends(data)[0]
    assert (worst.low, worst.high, worst.middle) in {(1e7, 2e7, 1.414e7), (2e7, 4e7, 2.828e7)}
    # A logarithm of depths that grow by factors is straight.
    assert max(bend.error for bend in pycav.bends(bent([1, 2, 4, 8], (5e6, 1e7, 2e7, 4e7), "p"), logarithmic=True)) < 1e-9
    with pytest.raises(ValueError, match="along numbers"):
        pycav.bends(data, along=["solid.material"])
    with pytest.raises(ValueError, match="no pit_deep"):
        pycav.bends(data, "pit_deep")


def test_of_whole_numbers_new_ones_are_whole(short, tmp_path):
    found = {bend.low: bend.middle for bend in pycav.bends(bent([0.0, 0.0, 1.0, 5.0], [1, 2, 6, 9], "coupling.step_ratio"))}
    assert found == {1: 1, 2: 3, 6: 7} and all(isinstance(middle, int) for middle in found.values())
    assert [bend.middle for bend in pycav.bends(bent([0.0, 1.0], [1, 2], "stand_off"))] == [1.5]
    data = pycav.sweep(short, {"coupling.step_ratio": [1, 2, 4]}, tmp_path, progress=False, to=tmp_path / "map.nc")
    finer = pycav.refine(tmp_path / "map.nc", "wall_pressure_peak", values=5, tolerance=-1.0, progress=False)
    assert list(finer["coupling.step_ratio"].values) == [1, 2, 3, 4] and list(finer["status"].values) == [0] * 4, "there is none between 1 and 2"
    assert data["coupling.step_ratio"].dtype == finer["coupling.step_ratio"].dtype


def test_a_refined_map_runs_what_is_new_alone(line):
    data, root = line
    told = []
    options = {"quantity": "wall_pressure_peak", "tolerance": 0.001, "progress": lambda point, how: told.append((point["fluid.ambient.pressure"], how))}
    finer = pycav.refine(root / "map.nc", **options)
    worst = pycav.bends(data, "wall_pressure_peak")[0]
    assert list(finer["fluid.ambient.pressure"].values) == sorted([1e7, 2e7, 4e7, worst.middle])
    assert sorted(told) == sorted([(1e7, "known"), (2e7, "known"), (4e7, "known"), (worst.middle, "done")])
    same = finer.sel({"fluid.ambient.pressure": [1e7, 2e7, 4e7]})
    assert np.array_equal(same["wall_pressure_peak"], data["wall_pressure_peak"]) and np.isfinite(finer["wall_pressure_peak"]).all()
    told.clear()
    assert pycav.refine(data, **{**options, "tolerance": 10.0}).sizes == data.sizes, "nothing is that bent"
    assert {how for _, how in told} == {"known"}


def test_a_refined_map_may_leave_out_where_nothing_bends(short, tmp_path):
    """At 1 ns nothing has reached the wall, whatever the stand-off; the other end time is not so short."""
    parameters = {"stand_off": [1.3, 1.8, 2.3], "time.end": [1e-9, 2e-5]}
    data = pycav.sweep(short, parameters, tmp_path, progress=False)
    finer = pycav.refine(data, "von_mises_peak", along=["stand_off"], tolerance=1e-3, everywhere=False, progress=False)
    assert finer.sizes["stand_off"] == 4
    fresh = [value for value in finer["stand_off"].values if value not in parameters["stand_off"]]
    assert list(finer["status"].sel(stand_off=fresh[0]).values) == [2, 0]
    with pytest.raises(ValueError, match="has no case"):
        pycav.refine(data.drop_attrs(), "von_mises_peak")


def test_uncertainties_are_grid_convergence_indices():
    # f = 1 + h on h = 1, 1/2, 1/4 is of the first order: 1.25 times the error.
    values, cells = [1.25, 2.0, 1.5], [4.0, 1.0, 2.0]
    assert estimated(values, cells) == (pytest.approx(1.25 * 0.25), "monotone")
    assert estimated(values[::-1], cells[::-1]) == (pytest.approx(1.25 * 0.5), "monotone")
    # Of an order of 0.42, which counts as a half.
    assert estimated([0.3, 0.6, 1.0], [4.0, 2.0, 1.0]) == (pytest.approx(1.25 * 0.3 / (2**0.5 - 1)), "slow")
    assert estimated([1.0, 1.1], [1.0, 2.0]) == (pytest.approx(0.4), "two-grids")
    assert estimated([1.0, 3.0, 2.0], [4.0, 2.0, 1.0]) == (2.0, "oscillatory-divergent")
    assert estimated([1.0, float("nan")], [1.0, 2.0]).kind == "unknown"


@pytest.mark.parametrize("cells", [(80.0, 40.0, 20.0), (80.0, 40.0, 10.0), (30.0, 20.0, 10.0), (32.0, 24.0, 16.0)])
def test_orders_are_those_of_any_ratios(cells):
    """By the formula of equal ratios the index of the first order was a third of that with 80, 40, 10."""
    h = 1 / np.array(cells)
    for order in (0.5, 1.0, 1.5, 2.0):
        for own in range(3):
            places = np.roll(np.arange(3), -own)
            found = estimated((1 + h**order)[places], np.array(cells)[places])
            assert found == (pytest.approx(1.25 * h[own]**order), "monotone"), (order, own)
    assert estimated(1 + h**0.3, cells).kind == "slow" and estimated(h**-0.3, cells).kind == "divergent"
    assert estimated(1 + h**3, cells).uncertainty == pytest.approx(1.25 * (h[1]**3 - h[0]**3) / ((cells[0] / cells[1])**2 - 1))
    step = np.log(h[1] / h[0]) / np.log(h[2] / h[1])
    assert estimated([0.9 * step, 0.0, 1.0], cells).kind == "oscillatory"
    assert estimated([1.1 * step, 0.0, 1.0], cells).kind == "oscillatory-divergent"


def test_maps_on_the_same_cells_of_the_fluid_are_refused():
    for cells in ([80.0, 80.0], [80.0, 80.0, 40.0], [80.0, 40.0, 40.0]):
        with pytest.raises(ValueError, match="0 cells per radius and different values"):
            estimated([1.0, 1.1, 1.2][:len(cells)], cells)
    assert estimated([1.0, 1.0], [80.0, 80.0]).kind == "unknown"


def on_grid(cells, depths, x):
    """A map of pits in the soft material, and of none in the hard one."""
    kinds, data = ("stand_off", "solid.material"), np.stack([np.array(depths), np.zeros(len(x))], 1)
    return xarray.Dataset(
        {"pit_depth": (kinds, data, {"units": "m"}), "cells_per_radius": (kinds, np.full(data.shape, cells)),
         "status": (kinds, np.zeros(data.shape, np.int8)), "error": (kinds, np.full(data.shape, "", object))},
        {"stand_off": list(x), "solid.material": ["soft", "hard"]})


def test_a_map_gets_what_it_is_off_by_between_the_repeated_points_too():
    coarse = on_grid(10.0, [8.0, 4.0, 2.0], (1.0, 2.0, 3.0))
    finer = on_grid(20.0, [8.8, 2.0], (1.0, 3.0)).isel({"solid.material": [0]})
    data = pycav.with_uncertainty(coarse, finer)
    # Two grids: four times the difference, 3.2 of 8; nothing at d/R = 3; half the share in between.
    off = data["pit_depth_uncertainty"].sel({"solid.material": "soft"})
    assert off.values == pytest.approx([3.2, 0.2 * 4.0, 0.0])
    assert float(data["pit_depth_uncertainty"].sel({"solid.material": "hard"}).max()) == 0.0, "no pit, nothing to be off by"
    flags = data["pit_depth_convergence"].sel({"solid.material": "soft"})
    words = data["pit_depth_convergence"].attrs["flag_meanings"].split()
    assert [words[k] for k in flags.values] == ["two_grids", "interpolated", "two_grids"]
    assert data["pit_depth"].attrs["ancillary_variables"] == "pit_depth_uncertainty pit_depth_convergence"
    with pytest.raises(ValueError, match="two grids or more"):
        pycav.with_uncertainty(coarse)
    with pytest.raises(ValueError, match="no point in common"):
        pycav.with_uncertainty(coarse, on_grid(20.0, [1.0], (5.0,)))


def test_the_damage_map_shows_values_marks_and_what_is_unsure():
    kinds, shape = ("stand_off", "fluid.ambient.pressure", "solid.material"), (2, 2, 1)
    depth = np.array([[2e-5, 4e-4], [0.0, np.nan]]).reshape(shape)
    data = xarray.Dataset(
        {"pit_depth": (kinds, depth, {"units": "m"}), "pit_radius": (kinds, np.full(shape, 2e-3)),
         "pit_depth_uncertainty": (kinds, np.array([[1e-6, 3e-4], [0.0, np.nan]]).reshape(shape)),
         "plastic_strain_peak": (kinds, np.full(shape, 0.1)), "surface_still": (kinds, np.full(shape, 0.01)),
         "wall_impulse": (kinds, np.full(shape, 5.0), {"units": "Pa s", "long_name": "impulse"}),
         "status": (kinds, np.array([[0, 0], [0, 1]], np.int8).reshape(shape))},
        {"stand_off": [1.2, 2.0], "fluid.ambient.pressure": ("fluid.ambient.pressure", [1e7, 4e7], {"units": "Pa"}),
         "solid.material": ["copper"]})
    figure = pycav.plot.damage_map(data, below=["wall_impulse"])
    said = texts(figure)
    for word in ("20 µm", "400 µm*", "no pit", "failed", "copper", "beyond small strains", "uncertainty above 50 %", "driving pressure / MPa"):
        assert word in said, word
    hatched = [patch for patch in figure.findobj(mpl.patches.Rectangle) if patch.get_hatch()]
    assert [patch.get_xy() for patch in hatched] == [(0, 1)], "one field alone: the deep one"
    lines = pycav.plot.sweep_lines(data.isel({"solid.material": 0}), "wall_impulse")
    assert [line.get_label() for line in lines.axes[0].lines] == ["10 MPa", "40 MPa"]
    with pytest.raises(ValueError, match="needs a sweep over"):
        pycav.plot.damage_map(data.isel({"solid.material": 0}))


def test_the_directory_of_a_sweep_is_no_map(line, tmp_path):
    """It ended in "Unable to synchronously open file (file read failed ... Is a directory)"."""
    data, root = line
    draws = (lambda own: pycav.plot.sweep_lines(own, "wall_impulse"), pycav.plot.stand_off_map, pycav.plot.pit_map, pycav.plot.damage_map)
    place = Path(data.attrs["out"])
    assert (root / "map.nc").is_file() and place.is_dir()
    for draw in draws:
        with pytest.raises(ValueError, match=f"{place} is a directory, not a map.*to= of pycav.sweep names: give {root / 'map.nc'}"):
            draw(place)
    (tmp_path / "other.nc").write_text("")
    (tmp_path / "sweep").mkdir()
    with pytest.raises(ValueError, match="sweep is a directory.*none is in it or beside it"):
        pycav.plot.damage_map(tmp_path / "sweep")


def test_pictures_take_a_file_and_say_what_they_need(line):
    data, root = line
    numbers = pycav.plot.sweep_lines(root / "map.nc", "wall_impulse", "fluid.ambient.pressure").axes[0].lines[0].get_ydata()
    assert np.array_equal(numbers, data["wall_impulse"].values[:, 0])
    over = r"not over fluid\.ambient\.pressure, solid\.material"
    for draw, told in ((lambda own: pycav.plot.sweep_lines(own, "wall_impulse"), f"lines over stand_off need a sweep over it and .*{over}"),
                       (lambda own: pycav.plot.sweep_lines(own, "wall_impuls"), "has no wall_impuls: did you mean wall_impulse"),
                       (pycav.plot.stand_off_map, f"needs a sweep over stand_off and solid.material, {over}"),
                       (pycav.plot.pit_map, f"needs a sweep over stand_off and solid.material, {over}"),
                       (pycav.plot.damage_map, "needs a sweep over stand_off, fluid.ambient.pressure and solid.material")):
        for own in (data, root / "map.nc"):
            with pytest.raises(ValueError, match=told):
                draw(own)
    other = data.rename({"fluid.ambient.pressure": "stand_off"})[["wall_impulse"]]
    with pytest.raises(ValueError, match="a map of pits needs pit_depth, pit_radius"):
        pycav.plot.pit_map(other)


def test_the_maps_of_before_show_what_is_unsure():
    kinds = ("solid.material", "stand_off")
    numbers = {"pit_depth": [[2e-4, 4e-5]], "pit_radius": [[9e-3, 9e-3]], "plastic_strain_peak": [[0.1, 0.1]], "surface_still": [[0.0, 0.0]],
               "von_mises_peak": [[1e9, 1e9]], "pit_depth_uncertainty": [[1e-4 * 1.9, 1e-6]], "wall_pressure_peak": [[2e9, 1e9]],
               "wall_pressure_peak_uncertainty": [[1e8, 2e8]], "wall_impulse": [[1.0, 1.0]], "yielded_volume_peak": [[1e-9, 1e-9]]}
    data = xarray.Dataset({name: (kinds, np.array(values)) for name, values in numbers.items()},
                          {"solid.material": ["soft"], "stand_off": [1.25, 1.5]})
    hatched = [patch for patch in pycav.plot.pit_map(data).findobj(mpl.patches.Rectangle) if patch.get_hatch()]
    assert len(hatched) == 1 and hatched[0].get_x() < 1.25 < hatched[0].get_x() + hatched[0].get_width()
    bars = [own for own in pycav.plot.stand_off_map(data).axes[0].collections if isinstance(own, mpl.collections.LineCollection)]
    ends = np.sort([segment[:, 1] for segment in bars[0].get_segments()], axis=1)
    assert ends == pytest.approx(np.array([[1.9e9, 2.1e9], [0.8e9, 1.2e9]]))


def test_a_stopped_map_keeps_what_is_done(short, tmp_path):
    def stop(point, how):
        if how == "done":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pycav.sweep(short, {"stand_off": [1.6, 2.0]}, tmp_path / "runs", progress=stop, to=tmp_path / "map.nc")
    with xarray.open_dataset(tmp_path / "map.nc", engine="h5netcdf") as left:
        assert list(left["status"].values) == [0, 2] and "stopped before" in str(left["error"].values[1])
    assert json.loads(left.attrs["parameters"]) == {"stand_off": [1.6, 2.0]}
