"""What is given to plots and results, checked."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import pycav
from pycav import plot


@pytest.mark.parametrize("value", [0.0, -1e-3, float("nan"), float("inf")])
@pytest.mark.parametrize(("name", "draw"), [
    ("reach", lambda r, x: plot.overview(r, reach=x)), ("depth", lambda r, x: plot.overview(r, depth=x)),
    ("reach", lambda r, x: plot.interface_continuity(r, reach=x)), ("reach", lambda r, x: plot.space_time(r, reach=x)),
    ("reach", lambda r, x: plot.pit(r, reach=x)), ("power", lambda r, x: plot.space_time(r, power=x)),
    ("spacing", lambda r, x: plot.pathlines(r, spacing=x)), ("density", lambda r, x: plot.streamlines(r, density=x)),
    ("spacing", lambda r, x: r.to_xarray(["pressure"], spacing=x)), ("yield_strength", lambda r, x: plot.yield_function(r, [95e6, x]))])
def test_lengths_are_above_0_and_finite(name, draw, value, result):
    with pytest.raises(ValueError, match=f"{name} = .*give a"):
        draw(result, value)


@pytest.mark.parametrize("draw", [plot.schlieren, plot.yield_function, lambda r, window: r.to_xarray(["pressure"], window=window)],
                         ids=["schlieren", "yield_function", "to_xarray"])
@pytest.mark.parametrize(("given", "kind", "told"), [
    ((-0.01, 0.01), TypeError, r"three numbers in m, \(z_low, z_high, r_high\)"), ("all", TypeError, "three numbers"),
    ((-0.01, "0.01", 0.02), TypeError, r"window\[1\] = '0\.01' is a str"), ((-0.01, 0.01, np.nan), ValueError, r"window\[2\] = nan"),
    ((0.01, -0.01, 0.02), ValueError, "z_low has to be below z_high"), ((5.0, 6.0, 0.02), ValueError, "holds nothing of the run"),
    ((-0.01, 0.01, -0.02), ValueError, "holds nothing of the run")])
def test_a_window_is_three_numbers_that_hold_something(draw, given, kind, told, result):
    with pytest.raises(kind, match=told):
        draw(result, window=given)


def test_a_time_is_a_number_and_beyond_the_snapshots_it_is_warned_of(result):
    with pytest.raises(TypeError, match="time = '8us' is a str: give a finite number in s"):
        result.fluid.at("8us")
    with pytest.raises(ValueError, match="time = nan"):
        result.fluid.at(float("nan"))
    for time, nearest in ((57e-6, 56e-6), (1.0, 56e-6), (-1e-6, 0.0)):
        with pytest.warns(UserWarning, match="outside of what there is, 0 to 5.6e-05 s"):
            assert result.fluid.at(time).time == pytest.approx(nearest)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert result.fluid.at(np.array(56.1e-6)).time == pytest.approx(56e-6)
        plot.overview(result)
    with pytest.warns(UserWarning, match="time = 1 s"):
        plot.schlieren(result, 1.0)


def test_names_that_are_not_there_come_with_those_that_are(result, small, tmp_path):
    with pytest.raises(KeyError, match="did you mean wall_pressure_peak.*von_mises_peak"):
        result.summary["wall_presure_peak"]
    assert result.summary.get("wall_presure_peak") is None
    with pytest.raises(KeyError, match="no probe 'deep'.*There are: solid-2mm, wall"):
        result.probes["deep"]
    probes = [{"name": name, "position": [z, 2e-3], "medium": medium} for name, z, medium in
              (("deep", 0.005, "solid"), ("wet", 0.015, "fluid"))]
    with pycav.Simulation(small.with_({"probe": probes, "time.snapshots": []}), out=tmp_path / "run") as simulation:
        simulation.step()
        with pytest.raises(KeyError, match="no field 'presure': did you mean pressure.*density"):
            simulation.fields("fluid")["presure"]
        with pytest.raises(KeyError, match="did you mean von_mises_peak"):
            simulation.summary["von_misses_peak"]
    run = simulation.result
    for ask in (lambda: run.probes["deeep"], lambda: plot.histories(run, probes=["deeep"])):
        with pytest.raises(KeyError, match="no probe 'deeep': did you mean deep.*deep, wet"):
            ask()


def test_a_yield_strength_is_no_material(result):
    with pytest.raises(TypeError, match="'coper': give a number in Pa.*did you mean copper"):
        plot.yield_function(result, ["coper"])
    with pytest.raises(TypeError, match="'structural-steel'.*has 2.5e.08"):
        plot.yield_function(result, "structural-steel")


@pytest.mark.parametrize("value", [0, -1, 1.5, True, "2"])
def test_threads_are_a_whole_number_above_0(value, small, tmp_path):
    for call in (pycav.run, pycav.FluidSolver, pycav.SolidSolver, pycav.Simulation,
                 lambda case, threads: pycav.sweep(case, {"time.cfl": [0.4]}, tmp_path / "runs", threads=threads),
                 lambda case, threads: pycav.convergence(case, tmp_path / "grids", threads=threads)):
        with pytest.raises(ValueError, match=f"threads = {value!r}: give a whole number above 0"):
            call(small, threads=value)
    assert not any(tmp_path.iterdir())


def test_a_report_is_a_page(result, tmp_path):
    with pytest.raises(ValueError, match="page.pdf does not say: give a name that ends in .html"):
        pycav.report(result, tmp_path / "page.pdf")


def test_a_laser_bubble_grows_to_the_radius_that_a_camera_has_seen():
    assert pycav.laser_bubble(largest_radius=493.6e-6) == pycav.laser_bubble()
    text = pycav.laser_bubble(largest_radius=1.3e-3, left_radius=None).to_toml()
    assert "radius = 5.267e-5" in text and "reset" not in text
    with pytest.raises(ValueError, match="largest_radius and equilibrium_radius: give one"):
        pycav.laser_bubble(largest_radius=1e-3, equilibrium_radius=3e-4)
    with pytest.raises(pycav.CaseError, match="largest_radius: must be positive"):
        pycav.laser_bubble(largest_radius=-1e-3)


def test_a_laser_bubbles_wall_needs_a_distance():
    """The wall was left out without a word; the command line refuses it."""
    for wall in ("steel", "rigid"):
        with pytest.raises(ValueError, match=f"wall = '{wall}': the following required argument was not provided: stand_off"):
            pycav.laser_bubble(wall=wall)
        assert pycav.laser_bubble(wall=wall, stand_off=1.5).media == (["fluid"] if wall == "rigid" else ["fluid", "solid"])
    assert pycav.laser_bubble(stand_off=1.5) == pycav.laser_bubble(stand_off=1.5, wall="rigid")
    with pytest.raises(ValueError, match="no material `stel`"):
        pycav.laser_bubble(wall="stel")


@pytest.mark.parametrize(("make", "name", "unit"), [
    (pycav.collapse, "radius", "m"), (pycav.free_bubble, "gas_pressure", "Pa"), (pycav.laser_bubble, "largest_radius", "m"),
    (pycav.laser_bubble, "left_radius", "m"), (pycav.shocked_bubble, "amplitude", "Pa"), (pycav.wall_load, "duration", "s"),
    (pycav.collapse, "stand_off", ""), (pycav.wall_load, "cells_per_radius", "")])
def test_a_new_cases_numbers_are_in_si_units(make, name, unit):
    """It was "must be real number, not str", of whichever argument."""
    with pytest.raises(TypeError, match=f"^{name} = '1mm' is a str: give a number{f' in SI units, here {unit}' if unit else ''}$"):
        make(**{name: "1mm"})
    with pytest.raises(pycav.CaseError, match=f"{name}.*NaN"):
        make(**{name: float("nan")})
    assert pycav.collapse(radius=np.array(1e-3), pressure=np.float32(2e7)) == pycav.collapse()
