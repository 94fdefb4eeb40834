"""The figures' bubble in front of a rigid wall, in a box wide enough for its echoes to come late."""

from .runs import run

RADIUS, CENTRE, GAS = 0.01, 0.02, (0.0266, 2118.0)


def table(options):
    print("| ambient | cells per radius | wall pressure, axis | smallest equivalent radius | jet | redone, floored "
          "| energy from the floor |\n|---|---|---|---|---|---|---|")
    for pressure, end in [(5e7, 52e-6), (5e6, 160e-6)]:
        for cells in options.cells or [20, 40, 80]:
            result, code = run(options, f"wall-{pressure:.0e}-{cells}", pressure=pressure, gas=GAS, radius=RADIUS,
                               centre=CENTRE, side=12.8 * RADIUS, cells=cells, end=end)
            if code:
                print(f"| {pressure:.0e} Pa | {cells} | exit code {code} | | | | |", flush=True)
                continue
            s = result.summary
            fixups = s["fixups"]
            print(f"| {pressure:.0e} Pa | {cells} | {s['wall_pressure_peak'] / 1e6:.1f} MPa at "
                  f"{s['wall_pressure_peak_time'] * 1e6:.2f} µs | {s['min_equivalent_radius'] / RADIUS:.4f} R at "
                  f"{s['collapse_time'] * 1e6:.2f} µs | {s['jet_velocity_peak']:.0f} m/s at "
                  f"{s['jet_velocity_peak_time'] * 1e6:.2f} µs | {fixups['redone']}, {fixups['floored']} "
                  f"| {fixups['floor_energy_share']:.1e} |", flush=True)
