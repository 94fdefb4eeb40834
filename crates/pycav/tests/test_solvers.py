"""The two solvers alone, with their surfaces driven from here."""

from __future__ import annotations

import numpy as np
import pytest

import pycav


def test_a_coupling_of_ones_own_gives_what_the_programs_does(small):
    """The acoustic Riemann problem between the media, written here, against `coupling.star = "acoustic"`."""
    case = small.with_({"coupling.star": "acoustic", "coupling.step_ratio": 1, "time.snapshots": []})
    whole = pycav.Simulation(case)
    fluid, solid = pycav.FluidSolver(case), pycav.SolidSolver(case)
    assert np.array_equal(fluid.surface_edges, solid.surface_edges)
    for _ in range(150):
        dt = min(fluid.time_step_limit(), solid.time_step_limit())
        f, s = fluid.trace(dt), solid.trace(dt)
        weight = 1 / (f["impedance"] + s["impedance"])
        pressure = weight * (f["impedance"] * s["pressure"] + s["impedance"] * f["pressure"]
                             + f["impedance"] * s["impedance"] * (s["velocity"] - f["velocity"]))
        velocity = weight * (s["impedance"] * s["velocity"] + f["impedance"] * f["velocity"]
                             + s["pressure"] - f["pressure"])
        fluid.step(dt, pressure=pressure, velocity=velocity)
        solid.step(dt, pressure=pressure, velocity=velocity)
        whole.step()
    assert fluid.steps == solid.steps == whole.steps == 150
    assert fluid.time == pytest.approx(whole.time, rel=1e-13)
    ours, theirs = fluid.fields()["pressure"], whole.fields("fluid")["pressure"]
    assert np.ptp(theirs) > 4e7, "something has happened"
    assert np.abs(ours - theirs).max() < 1e-9 * np.abs(theirs).max()
    ours, theirs = solid.fields()["stress_zz"], whole.fields("solid")["stress_zz"]
    assert np.ptp(theirs) > 1e7 and np.abs(ours - theirs).max() < 1e-9 * np.abs(theirs).max()


@pytest.mark.parametrize("rise", [1e6, -3e6])
def test_a_pressed_surface_moves_with_the_plane_waves_velocity(rise, small):
    solid = pycav.SolidSolver(small)
    steel = {material.name: material for material in pycav.materials()}["structural-steel"]
    rest = solid.trace(1e-9)["pressure"]
    assert rest == pytest.approx(5e7)
    for _ in range(8):
        solid.step(solid.time_step_limit(), pressure=5e7 + rise)
    expected = -rise / (steel.density * steel.c1)
    assert solid.surface_velocity[0] == pytest.approx(expected, rel=1e-9)
    # And the other way round: moved with that velocity it is pressed upon as much.
    moved = pycav.SolidSolver(small)
    for _ in range(8):
        moved.step(moved.time_step_limit(), velocity=np.full(len(moved.surface_edges), expected))
    ours, theirs = moved.fields(), solid.fields()
    inner = ours.r < 0.03  # whither no wave from the edge of the load has come
    assert np.allclose(ours["stress_zz"][inner], theirs["stress_zz"][inner], rtol=1e-12)


def test_a_wall_that_is_held_is_a_rigid_wall(small, root):
    """The same fluid above `scheme = "rigid"`: mirror image there, star state here. On 32 cells the
    two differ by 0.3 % of the pressure."""
    # Where the first front passes a far field its cell is steep, and the two have it at other times by a part of a step.
    small = small.with_({"fluid.boundary": {"z_max": "non-reflecting", "r_max": "non-reflecting"}})
    held = pycav.FluidSolver(small)
    rigid = pycav.Simulation(small.with_({"coupling.scheme": "rigid"}))
    while held.time < 3e-5:
        held.step(held.time_step_limit(), velocity=0.0)
    rigid.advance_to(held.time)
    ours, theirs = held.fields()["pressure"], rigid.fields("fluid")["pressure"]
    assert np.abs(ours - theirs).max() < 5e-3 * np.abs(theirs).max()
    assert held.equivalent_radius == pytest.approx(float(rigid.histories["bubble/equivalent_radius"][-1]), rel=1e-4)


def test_where_there_is_no_surface_nothing_can_move_it(small):
    rigid = pycav.FluidSolver(small.with_({"coupling.scheme": "rigid"}))
    for given in ({"velocity": 1.0}, {"pressure": np.ones(3)}, {"power": [1.0]}):
        with pytest.raises(ValueError, match=f"{next(iter(given))} = .*no surface; give dt alone"):
            rigid.step(1e-9, **given)
    rigid.step(rigid.time_step_limit(), **{name: rigid.trace(1e-9)[name] for name in ("pressure", "velocity")})
    assert rigid.steps == 1


def test_a_wall_that_moves_sends_the_sound_of_it(root):
    """p − p₀ = ρ c v before any wave is back, for a slow wall in liquid at rest."""
    case = pycav.Case(root / "cases/dickopp2012-coarse.toml").with_({"fluid.levels": 3, "solid.levels": 1})
    still = pycav.FluidSolver(case, initial=lambda z, r: {"density": 1000.0, "pressure": 5e7})
    for _ in range(6):
        still.step(still.time_step_limit(), velocity=0.1)
    c = np.sqrt(7.15 * (5e7 + 3e8) / 1000.0)
    assert still.surface_pressure[:16] == pytest.approx(5e7 + 1000 * c * 0.1, rel=1e-6)
    assert still.surface_pressure[0] > 5e7 + 1000 * c * 0.1, "compression stiffens"


def test_faces_that_come_with_a_finer_grid_have_what_was_there_in_the_step():
    """A pulse comes down on a wall at rest; the grid there is refined, then coarsened."""
    case = pycav.collapse(cells_per_radius=26, pressure=5e7, stand_off=1.2, wall="steel")
    fluid = pycav.FluidSolver(case.with_({"fluid.adapt_every": 2}), threads=1)
    faces = set()
    while fluid.time < 2e-6:
        before = len(fluid.surface_edges)
        fluid.step(fluid.time_step_limit(), velocity=0.0)
        pressure = fluid.surface_pressure
        assert pressure.shape == fluid.surface_edges.shape
        assert np.all(pressure > 1e3), "nothing has lost its pressure"
        if len(fluid.surface_edges) != before:
            faces.add(len(pressure))
    assert faces, "the grid has changed at the wall"


def test_a_fluid_without_a_surface_needs_nothing(root):
    fluid = pycav.FluidSolver(pycav.Case(root / "cases/shock-tube.toml"))
    assert fluid.surface_edges.size == 0
    fluid.step(fluid.time_step_limit())
    assert fluid.steps == 1 and fluid.sample([0.1], [0.1])["pressure"].shape == (1, 1)


def test_what_a_solver_says_of_itself_cannot_be_set(small):
    fluid = pycav.FluidSolver(small)
    with pytest.raises(AttributeError, match="time cannot be set"):
        fluid.time = 1.0
    assert fluid.time == 0.0 and pycav.Simulation.steps.__doc__ == "Steps made."


def test_what_makes_no_sense_is_refused(small, root):
    fluid, solid = pycav.FluidSolver(small), pycav.SolidSolver(small)
    dt = fluid.time_step_limit()
    with pytest.raises(ValueError, match="pressure or velocity"):
        fluid.step(dt)
    with pytest.raises(ValueError, match="32 finite numbers"):
        fluid.step(dt, velocity=np.zeros(3))
    with pytest.raises(ValueError, match=r"finite numbers.*; pressure\[0\] is NaN"):
        solid.step(dt, pressure=np.nan)
    with pytest.raises(ValueError, match="positive length"):
        solid.step(-1.0, pressure=5e7)
    with pytest.raises(ValueError, match="both"):
        solid.step(dt, pressure=5e7, power=0.0)
    with pytest.raises(ValueError, match=r"dt = .* is not stable in these cells; take time_step_limit\(\)"):
        solid.step(3.0 * solid.time_step_limit(), pressure=5e7)
    with pytest.raises(ValueError, match="no solid"):
        pycav.SolidSolver(pycav.Case(root / "cases/shock-tube.toml"))
    assert fluid.steps == solid.steps == 0


def test_a_solid_that_yields_has_the_fields_of_its_flow(small):
    solid = pycav.SolidSolver(small.with_({"solid.material": "al-1100-o", "solid.plasticity": {"law": "johnson-cook"}}))
    for _ in range(20):
        solid.step(0.9 * solid.time_step_limit(), pressure=2e9)
    cells = solid.fields()
    flown = cells["plastic_strain"] > 0
    assert flown.any() and (cells["plastic_strain_rate"][~flown] == 0).all() and cells["plastic_strain_rate"].max() > 0
    assert (cells["temperature"][flown] > 293).all() and cells["displacement_z"].min() < 0 and np.isfinite(cells["displacement_r"]).all()
    assert "plastic_strain" not in pycav.SolidSolver(small).fields()
