"""What can be read off a run, in numbers."""

import numpy as np
from pycav._report.health import jumps

from .study import MEGA, MICRO, MILLI
from .wall_front import Front


def report(study, times):
    """What can be read off the pictures, in numbers."""
    for microseconds in sorted(times):
        time = study.time_of(microseconds)
        if time is not None:
            print(f"\nt = {time * MICRO:.1f} µs")
            of_snapshot(study, time)
    along_interface(study)
    over_time(study)


def depth_and_radius(study, place):
    z, r = place
    return f"{(study.wall - z) * MILLI:.3f} mm below the wall, {r * MILLI:.2f} mm off the axis"


def of_snapshot(study, time):
    result, data = study.result, study.result.histories
    fluid, solid = result.fluid.at(time), result.solid.at(time)
    wall, radius = (np.interp(time, data["time"], data[name]) for name in ("wall/pressure_axis", "bubble/equivalent_radius"))
    print(f"  wall pressure on the axis {wall * MEGA:.1f} MPa")
    mesh, stress = solid.mesh, solid["von_mises"]
    volume = 2 * np.pi * (mesh.centre()[:, 1] * mesh.width().prod(1))[stress > 250e6].sum()
    near = np.where(study.near_axis(mesh), stress, 0.0)
    for what, part, more in (("largest von Mises stress", stress, f"; above 250 MPa in {volume * MILLI**3:.2f} mm3"),
                             ("near the axis", near, "")):
        print(f"  {what} {part.max() * MEGA:.1f} MPa, {depth_and_radius(study, mesh.centre()[part.argmax()])}{more}")
    density = fluid["density"]
    print(f"  R_eq {radius * MILLI:.2f} mm; density {density.min():.4g} to {density.max():.4g} kg/m3")
    gas_z = fluid.mesh.centre()[fluid["gas_fraction"] > 0.5, 0] * MILLI
    if len(gas_z):
        print(f"  gas fraction above 1/2 from z = {gas_z.min():.2f} to {gas_z.max():.2f} mm")
    fastest = [np.hypot(*snapshot["velocity"][:, :2].T).max() for snapshot in (fluid, solid)]
    print(f"  fastest {fastest[0]:.0f} m/s in the fluid, {fastest[1]:.2f} m/s in the solid")


def along_interface(study):
    print(f"\nalong the interface at {study.result.solid.times[-1] * MICRO:.1f} µs, cells extrapolated to it")
    _, velocity, pressure = jumps(study.result)
    for name, unit, scale, sides in (("v_z", "m/s", 1, velocity[-1]), ("p", "MPa", MEGA, pressure[-1])):
        fluid, solid = scale * sides.T
        print(f"  {name} {fluid.min():.3g} to {fluid.max():.3g} {unit},"
              f" rms difference {np.sqrt(np.mean((solid - fluid) ** 2)):.2g} {unit}")


def over_time(study):
    front, rayleigh = Front(study), study.rayleigh_wave_speed()
    time, peak, place = front.peak
    most, near = peak.argmax(), np.where(place[:, 1] < 0.1 * study.radius, peak, 0.0).argmax()
    print()
    for what, at in (("largest von Mises stress", most), ("largest while it lay near the axis", near)):
        print(f"{what} {peak[at] * MEGA:.1f} MPa at {time[at] * MICRO:.2f} µs, {depth_and_radius(study, place[at])}")
    passed = front.passes(rayleigh)
    if passed:
        print(f"front on the wall as fast as a Rayleigh wave, {rayleigh:.0f} m/s, at {passed[0] * MICRO:.2f} µs,"
              f" {passed[1] * MILLI:.2f} mm off the axis")
    at_surface = study.wall - place[most, 0] < 0.01 * study.radius
    if at_surface and front.time[0] < time[most] < front.time[-1]:
        at, speed, width = (np.interp(time[most], front.time, x) for x in (front.place, front.speed, front.width))
        later = [time[most] + x / MICRO * study.slowness for x in (1, 5)]
        print(f"front at the time of the largest stress: {at * MILLI:.2f} mm off the axis, {speed:.0f} m/s,"
              f" {width * MILLI:.3f} mm wide; from {later[0] * MICRO:.1f} to {later[1] * MICRO:.1f} µs the largest stress"
              f" runs at {front.peak_speed(*later):.0f} m/s")
