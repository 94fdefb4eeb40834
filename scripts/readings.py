"""What can be read off a run, in numbers."""

import h5py
import numpy as np

from run_directory import MEGA, MICRO, MILLI
from wall_front import Front
from yielding import near_axis


def report(run, times):
    """What can be read off the pictures, in numbers."""
    with h5py.File(run.path / "history.h5") as file:
        history = {name: file[name][:] for name in ("time", "wall/pressure_axis", "bubble/equivalent_radius")}
    for microseconds in sorted(times):
        time = run.time_of(microseconds)
        if time is None:
            continue
        (solid, solid_step), (fluid, fluid_step) = run.sides(time)
        wall, radius = (np.interp(time, history["time"], history[name])
                        for name in ("wall/pressure_axis", "bubble/equivalent_radius"))
        mesh, stress = solid.mesh(solid_step), solid.field("von_mises", solid_step)
        z, r = mesh.centre(np.array([stress.argmax()]))[0] * MILLI
        volume = 2 * np.pi * (mesh.centre()[:, 1] * mesh.width().prod(1))[stress > 250e6].sum()
        density, gas = (fluid.field(name, fluid_step) for name in ("density", "gas_fraction"))
        gas_z = fluid.mesh(fluid_step).centre()[gas > 0.5, 0] * MILLI
        fastest = [np.hypot(*series.field("velocity", step)[:, :2].T).max() for series, step in run.sides(time)]
        print(f"\nt = {time * MICRO:.1f} µs")
        print(f"  wall pressure on the axis {wall * MEGA:.1f} MPa")
        print(f"  largest von Mises stress {stress.max() * MEGA:.1f} MPa, {run.wall * MILLI - z:.2f} mm below the wall,"
              f" {r:.2f} mm off the axis; above 250 MPa in {volume * MILLI**3:.2f} mm3")
        near = np.where(near_axis(run, mesh), stress, 0.0)
        z, r = mesh.centre(np.array([near.argmax()]))[0] * MILLI
        print(f"  near the axis {near.max() * MEGA:.1f} MPa, {run.wall * MILLI - z:.2f} mm below the wall,"
              f" {r:.2f} mm off the axis")
        print(f"  R_eq {radius * MILLI:.2f} mm; density {density.min():.4g} to {density.max():.4g} kg/m3")
        if len(gas_z):
            print(f"  gas fraction above 1/2 from z = {gas_z.min():.2f} to {gas_z.max():.2f} mm")
        print(f"  fastest {fastest[1]:.0f} m/s in the fluid, {fastest[0]:.2f} m/s in the solid")

    time = run.solid.times[-1]
    (solid, solid_step), (fluid, fluid_step) = run.sides(time)
    below, above = solid.mesh(solid_step), fluid.mesh(fluid_step)
    r = np.arange(1, 400) / 400 * min(below.high[1], above.high[1])
    left, right = (np.column_stack([np.full_like(r, run.wall + side * below.finest[0]), r]) for side in (-1e-6, 1e-6))
    print(f"\nalong the interface at {time * MICRO:.1f} µs, cells extrapolated to it")
    for name, unit, scale, one, other in (
            ("v_z", "m/s", 1, below.sample(solid.field("velocity", solid_step)[:, 0], left),
             above.sample(fluid.field("velocity", fluid_step)[:, 0], right)),
            ("p", "MPa", MEGA, -below.sample(solid.field("stress_zz", solid_step), left),
             above.sample(fluid.field("pressure", fluid_step), right))):
        print(f"  {name} {other.min() * scale:.3g} to {other.max() * scale:.3g} {unit},"
              f" rms difference {np.sqrt(np.mean((one - other) ** 2)) * scale:.2g} {unit}")

    front, rayleigh = Front(run), run.rayleigh_speed()
    peak_time, peak, place = front.peak
    most = peak.argmax()
    print(f"\nlargest von Mises stress {peak[most] * MEGA:.1f} MPa at {peak_time[most] * MICRO:.2f} µs,"
          f" {(run.wall - place[most, 0]) * MILLI:.3f} mm below the wall, {place[most, 1] * MILLI:.2f} mm off the axis")
    near = np.where(place[:, 1] < 0.1 * run.radius, peak, 0.0).argmax()
    print(f"largest while it lay near the axis {peak[near] * MEGA:.1f} MPa at {peak_time[near] * MICRO:.2f} µs,"
          f" {(run.wall - place[near, 0]) * MILLI:.2f} mm below the wall")
    passed = front.passes(rayleigh)
    if passed:
        print(f"front on the wall as fast as a Rayleigh wave, {rayleigh:.0f} m/s, at {passed[0] * MICRO:.2f} µs,"
              f" {passed[1] * MILLI:.2f} mm off the axis")
    at_surface = run.wall - place[most, 0] < 0.01 * run.radius
    if at_surface and front.time[0] < peak_time[most] < front.time[-1]:
        at, speed, width = (np.interp(peak_time[most], front.time, x) for x in (front.place, front.speed, front.width))
        later = [peak_time[most] + x / MICRO * run.slowness for x in (1, 5)]
        print(f"front at the time of the largest stress: {at * MILLI:.2f} mm off the axis, {speed:.0f} m/s,"
              f" {width * MILLI:.3f} mm wide; from {later[0] * MICRO:.1f} to {later[1] * MICRO:.1f} µs the largest stress"
              f" runs at {front.peak_speed(*later):.0f} m/s")
