"""Runs for other programs: xarray and NetCDF, pint, meshio, ParaView."""

from __future__ import annotations

import ast
import json
import os
import subprocess
import sys
import xml.etree.ElementTree

import meshio
import numpy as np
import pytest
import xarray

import pycav
from pycav.exchange.quantities import pint_unit

WINDOW = (-0.02, 0.03, 0.02)


def test_a_runs_file_needs_no_pycav(result, tmp_path):
    path = result.to_netcdf(tmp_path / "run.nc", ["pressure", "velocity", "von_mises"], spacing=1e-3, window=WINDOW)
    code = (f"import sys, xarray\nfound = xarray.open_dataset({str(path)!r})\nassert 'pycav' not in sys.modules\n"
            "print(found['bubble_equivalent_radius'].min().item(), found['fluid_pressure'].max().item())\n"
            "print(found['fluid_pressure'].dims, found.attrs['case_hash'], found['bubble_equivalent_radius'].units)")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout.split()[0]) == float(result.histories["bubble/equivalent_radius"].min())
    assert f"('snapshot_time', 'z_fluid', 'r_fluid') {result.case.hash} m" in done.stdout
    with xarray.open_dataset(path) as found:
        assert found.sizes["snapshot_time"] == 13 and found.sizes["z_fluid"] == 30 and found.sizes["z_solid"] == 20
        assert {"fluid_velocity_z", "fluid_velocity_r", "solid_velocity_z", "solid_von_mises"} <= set(found)
        assert json.loads(found.attrs["summary"])["wall_pressure_peak"] == result.summary["wall_pressure_peak"]
        assert found.attrs["git_revision"] and found.attrs["Conventions"].startswith("CF-") and found.attrs["completed"] == 1
        # Every variable says what it is, in letters that the conventions allow.
        for name, variable in found.variables.items():
            assert str(name).replace("_", "").isalnum() and "long_name" in variable.attrs, name
        assert found["time"].attrs["axis"] == "T" and found["z_fluid"].attrs["units"] == "m"
    with pytest.raises(ValueError, match="as .nc"):
        result.to_netcdf(tmp_path / "run.csv")


def test_snapshots_on_a_grid_are_the_cells(result):
    data = result.to_xarray(["pressure", "velocity"], window=(0.0, 0.03, 0.02), spacing=1e-3)
    step = 7
    snapshot = result.fluid[step]
    z, r = data["z_fluid"].to_numpy(), data["r_fluid"].to_numpy()
    assert z[0] == pytest.approx(0.5e-3) and len(z) == 30 and len(r) == 20
    for z_at, r_at in ((3, 4), (20, 1), (29, 19)):
        cell = snapshot.mesh.locate(np.array([[z[z_at], r[r_at]]]))
        exact = snapshot.mesh.sample(snapshot["pressure"], np.array([[z[z_at], r[r_at]]]))[0]
        assert float(data["fluid_pressure"][step, z_at, r_at]) == pytest.approx(exact, rel=1e-6)
        near = snapshot["velocity"][cell[0], 0]
        assert abs(float(data["fluid_velocity_z"][step, z_at, r_at]) - near) < 0.5 * abs(near) + 5.0
    # Next to the axis, off a cell's centre, the slope of v_r counts its mirror image.
    near_axis = result.to_xarray(["velocity"], window=(0.0, 0.03, 0.02), spacing=4e-4)
    point = near_axis["z_fluid"].values[40], near_axis["r_fluid"].values[0]
    axis = snapshot.mesh.sample(snapshot["velocity"][:, 1], np.array([point]), -1)[0]
    assert float(near_axis["fluid_velocity_r"][step, 40, 0]) == pytest.approx(axis, rel=1e-6) and axis != 0.0
    assert list(data["snapshot_time"].values) == list(result.fluid.times) and data["fluid_pressure"].attrs["units"] == "Pa"
    assert data["fluid_velocity_r"].attrs["units"] == "m/s" and "solid_velocity_z" not in data, "the window is in the fluid"
    for given, told in (({"fields": ["wind"]}, "no snapshot has wind"), ({"fields": ["pressure"], "spacing": 1e-9}, "too many"),
                        ({"fields": ["pressure"], "window": (-0.03, -0.01, 0.02)}, "nothing of the fluid")):
        with pytest.raises(ValueError, match=told):
            result.to_xarray(**given)


def test_no_value_on_a_grid_is_beyond_those_of_the_cells(result):
    """Liquid of a thousand kilograms beside gas of a few grams: slopes between them lead below 0 within half a cell."""
    names = {"fluid": ["density", "gas_fraction", "pressure"], "solid": ["von_mises"]}
    data = result.to_xarray([name for own in names.values() for name in own], spacing=4e-4, window=WINDOW)
    for medium, fields in names.items():
        for name in fields:
            found = data[f"{medium}_{name}"].to_numpy()
            for step, snapshot in enumerate(result.snapshots(medium)):
                cells = snapshot[name].astype(np.float32)
                assert cells.min() <= found[step].min() and found[step].max() <= cells.max(), (name, step)
    # Bounds act next to jumps alone: elsewhere values are linear.
    snapshot = result.fluid[7]
    z, r = np.meshgrid(data["z_fluid"], data["r_fluid"], indexing="ij")
    linear = snapshot.mesh.sample(snapshot["pressure"], np.column_stack([z.ravel(), r.ravel()]), bounded=False)
    same = np.isclose(data["fluid_pressure"][7].to_numpy().ravel(), linear, rtol=1e-6)
    assert 0.5 < same.mean() < 1.0


def test_histories_have_quantities(result):
    found = pycav.units(result)
    radius = found["bubble/equivalent_radius"].min()
    assert radius.pint.to("mm").item().magnitude == pytest.approx(1e3 * float(result.histories["bubble/equivalent_radius"].min()))
    engineering = pycav.units(result, "engineering")
    wall = engineering["wall/pressure_axis"]
    assert str(wall.pint.units) == "megapascal"
    assert wall.max().item().magnitude == pytest.approx(1e-6 * result.summary["wall_pressure_peak"])
    assert str(engineering["bubble/volume"].pint.units) == "millimeter ** 3"
    with pytest.raises(ValueError, match="SI or engineering"):
        pycav.units(result, "imperial")


def test_maps_have_quantities_too():
    data = xarray.Dataset({"pit_depth": ("x", [2e-5], {"units": "m"}), "pit_radius": ("x", [2e-3], {"units": "m"}),
                           "error": ("x", np.array([""], object))})
    found = pycav.units(data, "engineering")
    assert (str(found["pit_depth"].pint.units), str(found["pit_radius"].pint.units)) == ("micrometer", "millimeter")
    assert found["pit_depth"][0].item().magnitude == pytest.approx(20.0) and list(found["error"].values) == [""]
    assert str(pycav.units(data["pit_depth"], "engineering").pint.units) == "micrometer"


def test_all_units_of_a_run_are_pints(result):
    import pint

    registry = pint.UnitRegistry()
    told = {str(variable.attrs.get("units", "")) for variable in result.histories.variables.values()}
    told |= {unit for medium in result.media for unit in result.snapshots(medium).units.values()}
    assert {"kg/m3", "m/s", "Pa"} <= told
    for unit in told:
        registry.Unit(pint_unit(unit))
    assert registry.Unit(pint_unit("kg/m4")) == registry.kilogram / registry.meter**4
    assert registry.Unit(pint_unit("Pa s")) == registry.pascal * registry.second


@pytest.mark.parametrize("ending", ["vtu", "xdmf"])
def test_meshio_reads_a_snapshot_back(ending, result, tmp_path):
    snapshot = result.solid[6]
    mesh = meshio.read(snapshot.export(tmp_path / f"snapshot.{ending}"))
    points, quads = snapshot.geometry()
    assert np.array_equal(mesh.points, points) and np.array_equal(mesh.cells_dict["quad"], quads)
    for name in snapshot.fields:
        assert np.array_equal(mesh.cell_data[name][0], snapshot[name]), name


def test_a_series_is_a_collection_with_times(result, tmp_path):
    path = result.fluid.export(tmp_path)
    rows = xml.etree.ElementTree.parse(path).getroot().findall("Collection/DataSet")
    assert [float(row.get("timestep")) for row in rows] == list(result.fluid.times)
    last = meshio.read(tmp_path / rows[-1].get("file"))
    assert np.array_equal(last.cell_data["pressure"][0], result.fluid[-1]["pressure"])


@pytest.mark.parametrize("vtu", [False, True])
def test_the_script_for_paraview_names_files_and_scales_of_the_run(vtu, result, tmp_path):
    path = pycav.paraview_state(result, tmp_path / "state.py", vtu=vtu)
    tree = ast.parse(path.read_text())
    (told,) = [json.loads(node.value.args[0].value) for node in tree.body
               if isinstance(node, ast.Assign) and node.targets[0].id == "RUN"]
    for medium, name in told["files"].items():
        assert name.endswith(f"{medium}.{'pvd' if vtu else 'vtkhdf'}") and (tmp_path / name).is_file()
    assert told["von_mises"] == max(snapshot["von_mises"].max() for snapshot in result.solid)
    assert told["time"] in result.solid.times and told["mirrored"] is True
    assert told["clock"] == {"scale": pytest.approx(1e6), "unit": "us", "decimals": 2}
    weakest, steepest = told["schlieren"]
    snapshot = result.fluid.at(told["time"])
    area = snapshot.mesh.width().prod(1)
    above = area[snapshot["schlieren"] > steepest].sum() / area.sum()
    assert steepest / weakest == pytest.approx(10**3.5) and 0.0 < above <= 1e-3


def test_other_programs_from_the_command_line(result, tmp_path):
    def run(*arguments):
        return subprocess.run([sys.executable, "-m", "pycav", *map(str, arguments)], capture_output=True, text=True, check=False)

    done = run("netcdf", result.directory, "--out", tmp_path / "run.nc", "--fields", "pressure", "--spacing", "2e-3")
    assert done.returncode == 0 and done.stdout.strip() == str(tmp_path / "run.nc"), done.stderr
    with xarray.open_dataset(tmp_path / "run.nc") as found:
        assert found["fluid_pressure"].shape == (13, 64, 64)
    done = run("paraview", result.directory, "--out", tmp_path / "state.py")
    assert done.returncode == 0 and os.path.getsize(tmp_path / "state.py") > 4000, done.stderr
    done = run("netcdf", result.directory, "--out", tmp_path / "run.nc", "--fields", "wind")
    assert done.returncode == 2 and done.stderr.startswith("error: no snapshot has wind")


def test_opening_a_run_needs_no_labelled_arrays(result):
    code = ("import sys, pycav\n"
            f"found = pycav.open({str(result.directory)!r}); found.summary, found.fluid[-1]['pressure'], found.case\n"
            "print([name for name in ('matplotlib', 'xarray', 'pandas', 'scipy', 'pint', 'meshio') if name in sys.modules])")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stdout.strip() == "[]", done.stdout + done.stderr
