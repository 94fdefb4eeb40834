"""What runs left, read."""

from __future__ import annotations

import subprocess
import sys
from types import SimpleNamespace

import h5py
import numpy as np
import pyvista
import pytest
import xarray as xr

import pycav
from pycav import _toml, theory
from pycav._axis import on_axis
from pycav.histories import from_columns
from pycav.theory import RAYLEIGH_FACTOR, Bubble


def test_histories_have_units_and_coordinates(result):
    data = result.histories
    pressure = data["interface/pressure"]
    assert pressure.dims == ("interface/time", "interface/r") and pressure.attrs["units"] == "Pa"
    assert data["bubble/volume"].dims == ("time",) and data["bubble/volume"].attrs["units"] == "m3"
    assert data["solid/von_mises_max_position"].shape == (data["solid/time"].size, 2)
    assert data["solid/time"].size > data["time"].size, "the solid has steps of its own"
    with h5py.File(result.directory / "history.h5") as file:
        compared = []
        file.visititems(lambda name, item: compared.append(
            np.array_equal(data[name], item[()], equal_nan=True)) if isinstance(item, h5py.Dataset) else None)
    assert len(compared) > 60 and all(compared)
    assert data.sel(time=2e-5, method="nearest")["wall/pressure_axis"] > 0


def test_rows_that_only_some_columns_have_do_not_count():
    def column(*shape):
        return np.arange(np.prod(shape), dtype=float).reshape(shape), "1", ""

    found = from_columns({
        "time": column(4), "bubble/volume": column(3), "interface/time": column(2), "interface/r": column(5),
        "interface/pressure": column(2, 5), "interface/displacement_z": column(3, 5),
        "probes/a/time": (np.array([0.0, 2.0]), "s", ""), "probes/a/pressure": column(3)})
    assert dict(found.sizes) == {"time": 2, "interface/r": 5, "probes/a/time": 2}
    assert found["interface/displacement_z"].values.tolist() == column(3, 5)[0][:2].tolist()


def test_snapshots_are_those_that_vtk_reads(result):
    for medium in ("fluid", "solid"):
        series = result.snapshots(medium)
        reader = pyvista.get_reader(series.path)
        reader.reader.UpdateInformation()
        assert reader.reader.GetNumberOfSteps() == len(series) == 13
        for step in (0, 6, 12):
            reader.reader.SetStep(step)
            theirs, ours = reader.read(), series[step].to_pyvista()
            assert np.array_equal(ours.points, theirs.points)
            assert np.array_equal(ours.cell_connectivity, theirs.cell_connectivity)
            for name in series.fields:
                assert np.array_equal(ours.cell_data[name], theirs.cell_data[name]), name
            assert ours.compute_cell_sizes().cell_data["Area"].sum() == pytest.approx(0.128**2)


def test_snapshots_are_found_by_number_and_time(result):
    assert result.fluid.at(1e-5).time == pytest.approx(2 * 56e-6 / 12)
    assert [snapshot.time for snapshot in result.fluid] == list(result.fluid.times)
    assert result.fluid[-1].time == pytest.approx(56e-6) and len(result.fluid[2:5]) == 3
    with pytest.raises(IndexError):
        result.fluid[13]
    with pytest.raises(KeyError, match="no field 'wind': There are: density.*output.fields"):
        result.fluid[0]["wind"]
    first = result.fluid[0]
    mesh, gas = first.mesh, first["gas_fraction"]
    volume = 2 * np.pi * (gas * mesh.centre()[:, 1] * mesh.width().prod(1)).sum()
    assert volume == pytest.approx(float(result.histories["bubble/volume"][0]), rel=1e-9)


def test_the_last_snapshot_is_the_simulations_state(result):
    with pycav.Simulation(result.case) as simulation:
        simulation.run()
        cells = simulation.fields("solid")
    last = result.solid[-1]
    assert np.array_equal(cells["von_mises"], last["von_mises"]) and np.allclose(cells.z, last.mesh.centre()[:, 0])


def test_summary_table_and_case(result):
    assert result.summary["completed"] and result.media == ["fluid", "solid"]
    assert result.cells_per_radius == pytest.approx(10.0)
    numbers = result.key_numbers
    assert numbers.loc["wall_pressure_peak", "value"] == result.histories["wall/pressure_axis"].max()
    assert list(numbers.columns) == ["value", "unit", "time"]
    shown, html = repr(numbers), numbers._repr_html_()
    megapascals = f"{numbers.loc['wall_pressure_peak', 'value'] * 1e-6:.4g} MPa"
    assert megapascals in shown and megapascals in html and " µs" in shown and "NaN" not in shown and "e-0" not in shown
    assert "value" in repr(numbers[numbers["unit"] == "Pa"]) and type(numbers.head()) is type(numbers["value"].to_frame())
    table = result.table
    peak = numbers.loc["von_mises_peak", "value"]
    assert peak == result.histories["solid/von_mises_max"].max()
    # In the table it is at the fluid's times, between which the peak may lie.
    assert table.index.name == "time" and 0.99 * peak < table["solid/von_mises_max"].max() <= peak
    assert result.case.hash == result.histories.attrs["case_hash"]


def test_a_directory_of_something_else_is_refused(tmp_path):
    with pytest.raises(FileNotFoundError, match="no run directory"):
        pycav.open(tmp_path)
    with pytest.raises(FileNotFoundError, match="there is no such directory"):
        pycav.open(tmp_path / "absent")


def test_a_file_of_a_run_is_refused_with_its_directory(result, tmp_path):
    """Of summary.json itself it said that it has no summary.json."""
    for name in ("summary.json", "fluid.h5"):
        with pytest.raises(FileNotFoundError, match=f"{name} is no run directory: it is a file; give the directory of its run, {result.directory}$"):
            pycav.open(result.directory / name)
    (tmp_path / "note").write_text("")
    with pytest.raises(FileNotFoundError, match="it is a file, and no run is in its directory"):
        pycav.open(tmp_path / "note")


@pytest.mark.parametrize(("poisson", "ratio"), [(0.0, 0.874032), (0.25, 0.919402), (0.5 - 1e-9, 0.955313)])
def test_the_rayleigh_wave_is_as_fast_as_poissons_ratio_says(poisson, ratio):
    """c/c₂, e.g. Graff (1975), Wave Motion in Elastic Solids, table 6.1."""
    c2 = 3000.0
    c1 = c2 * np.sqrt((2 - 2 * poisson) / (1 - 2 * poisson))
    assert theory.rayleigh_wave_speed(c1, c2) == pytest.approx(ratio * c2, rel=1e-5)


def test_a_probe_in_the_solid_has_its_von_mises_stress(small, tmp_path):
    probes = [{"name": name, "position": [z, 2e-3], "medium": medium} for name, z, medium in
              (("deep", 0.005, "solid"), ("wet", 0.015, "fluid"))]
    found = pycav.run(small.with_({"probe": probes, "time.end": 1e-5, "time.snapshots": []}), tmp_path / "run").probes
    deep = found["deep"]
    parts = [deep[f"stress_{part}"].to_numpy() for part in ("zz", "rr", "phiphi")]
    shear = deep["stress_zr"].to_numpy()
    # By the stress deviator: σ_vM² = 3/2 s:s.
    deviator = [part - sum(parts) / 3 for part in parts]
    wanted = np.sqrt(1.5 * (sum(part**2 for part in deviator) + 2 * shear**2))
    assert np.allclose(deep["von_mises"], wanted, rtol=1e-9) and deep["von_mises"].attrs["units"] == "Pa"
    assert "von_mises" not in found["wet"]


def test_rayleighs_collapse(result):
    bubble = Bubble.of(result)
    assert RAYLEIGH_FACTOR == pytest.approx(0.91468, abs=1e-5)
    time, radius = bubble.rayleigh()
    assert time[-1] == pytest.approx(bubble.collapse_time) and (radius[0], radius[-1]) == (0.01, 0.0)
    # Ṙ² = 2/3 Δp/ρ ((R₀/R)³ − 1), Rayleigh (1917).
    speed = np.gradient(radius, time, edge_order=2)[100:300]
    exact = np.sqrt(2 / 3 * (5e7 - 2118) / 1000 * ((0.01 / radius[100:300])**3 - 1))
    assert np.allclose(-speed, exact, rtol=1e-3)


@pytest.mark.parametrize(("stiffness", "taken", "tension"), [(0.0, 0.0, 0.0), (0.0, 0.05, 0.0), (3e3, 0.02, 0.0), (0.0, 0.0, 5.0)])
def test_keller_and_miksis_become_rayleigh_and_plesset(stiffness, taken, tension):
    """In a liquid of very fast sound the energy of the incompressible bubble and of its surface is kept."""
    bubble = Bubble(1e-3, 1e4, 1.4, 1e5, 1000.0, 1e9, True, stiffness, taken, tension)
    time, radius = bubble.keller_miksis(1.5 * bubble.collapse_time)
    volume = (radius.min() / 1e-3) ** 3
    # At the smallest radius the liquid's work has all gone into the gas, along (p + π)(V − m b)^γ = const.
    work = 1e5 * (1 - volume) + 3 * tension / 1e-3 * (1 - volume ** (2 / 3))
    gas = (1e4 + stiffness) * (1 - taken) / 0.4 * (((volume - taken) / (1 - taken)) ** -0.4 - 1) - stiffness * (1 - volume)
    assert volume > taken and gas == pytest.approx(work, rel=1e-3)


def test_keller_and_miksis_have_the_cases_tension_and_viscosity():
    terms = {"surface_tension": 0.0728, "viscosity": {"liquid": 1e-2, "gas": 0.0}}
    case = pycav.collapse().with_({"fluid.terms": terms})
    bubble = Bubble.of(SimpleNamespace(parameters=_toml.parse(case.to_toml())))
    assert (bubble.surface_tension, bubble.viscosity) == (0.0728, 1e-2)
    # Small oscillations about the equilibrium decay by exp(-2 μ t/(ρ R²)), in fast sound.
    bubble = Bubble(1e-4, 1.01 * (1e5 + 2 * 0.0728 / 1e-4), 1.4, 1e5, 1000.0, 1e9, True, surface_tension=0.0728, viscosity=0.02)
    time, radius = bubble.keller_miksis(2e-4, 20_000)
    tops = [k for k in range(1, len(time) - 1) if radius[k - 1] < radius[k] > radius[k + 1]]
    rest = 1e-4 * (1 + 0.01 / (3 * 1.4 - 2 * 0.0728 / 1e-4 / 1.0146e5))
    swing = radius[tops] - rest
    assert len(tops) > 3 and np.log(swing[0] / swing[2]) == pytest.approx(2 * 0.02 / (1000 * 1e-8) * (time[tops[2]] - time[tops[0]]), rel=0.03)


@pytest.mark.parametrize("viscosity", [0.0, 1.0])
def test_the_wall_starts_with_the_jump_of_its_pressure(viscosity):
    """ρ c Ṙ = p - p∞ with the liquid's pressure on the wall, p = p_gas - 2σ/R - 4μ Ṙ/R."""
    bubble = Bubble(1e-5, 1e4, 1.4, 1e6, 1000.0, 1500.0, False, surface_tension=0.5, viscosity=viscosity)
    time, radius = bubble.keller_miksis(1e-11, 3)
    speed = (radius[1] - radius[0]) / time[1]
    assert 1000.0 * 1500.0 * speed == pytest.approx(1e4 - 2 * 0.5 / 1e-5 - 4 * viscosity * speed / 1e-5 - 1e6, rel=1e-3)


def test_sound_and_gas_have_their_covolumes():
    """Of water by Noble and Abel 1000 kg/m³ carry sound at 1569 m/s; without the covolume it would be 913 m/s."""
    case = pycav.collapse().with_({"fluid.liquid": {"fluid": "water-nasg"}, "fluid.ambient.density": 1000.0, "fluid.ambient.pressure": 1e5})
    case = case.with_({"fluid.gas": {"gamma": 1.4, "covolume": 1e-3}, "fluid.region.0.density": 50.0})
    bubble = Bubble.of(SimpleNamespace(parameters=_toml.parse(case.to_toml())))
    assert bubble.sound_speed == pytest.approx(1568.8, abs=0.5)
    assert bubble.covolume_share == pytest.approx(0.05) and bubble.gas_stiffness == 0.0


@pytest.mark.parametrize("first", ["pycav", "h5py", "pyvista"])
def test_it_lives_beside_other_hdf5_libraries(first, result, tmp_path):
    """h5py, VTK and the solver bring an HDF5 each."""
    code = f"""
import {first}
import pycav, h5py, pyvista, sys
case = pycav.Case.from_toml(open(sys.argv[1]).read()).with_(**{{"time.end": 1e-6, "time.snapshots": []}})
found = pycav.run(case, sys.argv[2])
reader = pyvista.get_reader(str(found.directory / "fluid.vtkhdf"))
cells = reader.read().n_cells
with h5py.File(found.directory / "fluid.vtkhdf") as file:
    assert file["VTKHDF/NumberOfCells"][0] == cells == found.fluid[0].to_pyvista().n_cells
again = pycav.run(case, sys.argv[2], force=True)
assert again.summary["completed"]
"""
    done = subprocess.run([sys.executable, "-c", code, result.directory / "case.toml", tmp_path / "run"],
                          capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(("r", "column"), [([0.5, 1.5], 0), ([-1.5, -0.5, 0.5], 2), ([-1.0, -1e-17, 1.0], 1), ([-1.3, -0.3, 0.7], 1), ([-2.0, -1.0], 1)])
def test_the_axis_is_where_r_is_zero(r, column):
    rows = xr.DataArray(np.arange(2.0 * len(r)).reshape(2, -1), dims=("t", "r"), coords={"r": r})
    np.testing.assert_array_equal(on_axis(rows), [column, len(r) + column])
