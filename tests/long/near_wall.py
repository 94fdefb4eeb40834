#!/usr/bin/env python3
"""Bubbles at and near walls: whether every run ends, and what it had to mend.

The tables are in docs/verification/near-wall.md.

    python3 tests/long/near_wall.py                                      all of it: 992 runs, about a day of one processor
    python3 tests/long/near_wall.py --cells 26 --walls rigid             a part
    python3 tests/long/near_wall.py --stand-offs 0 0.5 1 1.5 --table     only the table of what is there
    python3 tests/long/near_wall.py --load --stand-offs 1.5 1.25 1.1     the load on a rigid wall with 51, 102 and 205 cells per radius

A bubble of 10 mm and 2118 Pa, its centre d/R radii above the wall, in water of 1e5 to 5e7 Pa, through the second collapse: to 2.9
Rayleigh times, 2.5 collapse times of the slowest. All choices are the program's defaults. The load is that of water of 5e7 Pa until 1.5
Rayleigh times, with time steps of the levels' own and so two levels more at the wall. What is complete in --out is not run again. Needs h5py
and target/release/cav (or --cav).
"""

import argparse
import json
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import h5py

ROOT = Path(__file__).resolve().parents[2]
RADIUS = 0.01
GAS = 2118.0
PRESSURES = [1e5, 5e5, 5e6, 5e7]
WALLS = ["rigid", "structural-steel", "aluminium", "pmma"]
STAND_OFFS = [round(0.1 * k, 1) for k in range(31)]
# Cells per radius, and the levels that make them of 4 x 4 cells on 5 radii.
LEVELS = {13: 4, 26: 5, 51: 6, 102: 7, 205: 8}

CASE = """geometry = "axisymmetric"
time.end = {end!r}
[fluid]
z = [0.0, 0.05]
r = [0.0, 0.05]
cells = [4, 4]
levels = {levels}
[fluid.liquid]
gamma = 7.15
pi = 3e8
[fluid.gas]
gamma = 1.4
pi = 0.0
[fluid.ambient]
density = 1000.0
pressure = {pressure!r}
[[fluid.region]]
shape = "sphere"
centre = [{centre!r}, 0.0]
radius = 0.01
phase = "gas"
density = 0.0266
pressure = 2118.0
"""
SOLID = """[solid]
z = [-0.05, 0.0]
r = [0.0, 0.05]
cells = [4, 4]
levels = {levels}
material = "{wall}"
[coupling]
scheme = "riemann"
"""
RIGID = """[coupling]
scheme = "rigid"
"""
# A disc of a tenth of the radius.
SENSORS = """[[sensor]]
name = "short"
radius = 1e-3
rise_time = 1e-9
[[sensor]]
name = "long"
radius = 1e-3
rise_time = 5e-7
"""
# Fix-ups that change the state of a cell; the others bound a reconstruction.
MENDED = ["redone", "floored", "lifted_phases", "expanded_cells"]


def rayleigh_time(pressure):
    return 0.914681 * RADIUS * (1000.0 / (pressure - GAS)) ** 0.5


def text(options, pressure, wall, stand_off, cells):
    end = options.until * rayleigh_time(pressure)
    case = CASE.format(end=end, levels=LEVELS[cells], pressure=pressure, centre=stand_off * RADIUS)
    case += RIGID if wall == "rigid" else SOLID.format(levels=LEVELS[cells], wall=wall)
    return f"time.local_steps = true\n{case}{SENSORS}" if options.load else case


def gas_mass_drift(directory):
    """The largest relative change of the gas's mass that no fix-up explains."""
    with h5py.File(directory / "history.h5") as file:
        mass = file["bubble/gas_mass"][:]
        turn = 2.0 * 3.141592653589793
        added = turn * (file["fixups/gas_mass_added"][:] - file["fixups/liquid_mass_added"][:])
    return float(abs((mass - added) / mass[0] - 1.0).max())


def solve(options, pressure, wall, stand_off, cells):
    """What a run left: its summary and exit code, from what is there if it is of this very case."""
    name = f"{'load-' if options.load else ''}{wall}-{pressure:.0e}-{stand_off}-{cells}"
    kept, path, directory = (options.out / f"{name}{end}" for end in (".json", ".toml", ""))
    case = text(options, pressure, wall, stand_off, cells)
    if kept.exists() and path.exists() and path.read_text() == case:
        return json.loads(kept.read_text())
    if options.table:
        return None
    path.write_text(case)
    command = [str(options.cav), "run", str(path), "--out", str(directory), "--quiet", "--force", "--in-process",
               "--threads", str(options.threads)]
    done = subprocess.run(command, check=False, capture_output=True, text=True)
    found = {"code": done.returncode, "says": done.stderr.strip(), "summary": {}}
    summary = directory / "summary.json"
    if summary.exists():
        found["summary"] = json.loads(summary.read_text())
    if done.returncode == 0:
        found["gas_mass_drift"] = gas_mass_drift(directory) if wall == "rigid" else None
        shutil.rmtree(directory)
    kept.write_text(json.dumps(found))
    return found


def power(value):
    """A number as the page has it: 1.2·10⁻⁵ of 1.2e-05."""
    if float(value) == 0.0:
        return "0"
    factor, _, exponent = value.partition("e")
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"10{raised}" if factor == "1" else f"{factor}·10{raised}"


def row(pressure, wall, cells, found):
    """A line of the table: all stand-offs of a wall, a pressure and a resolution."""
    runs = len(found)
    failed = [f"{d} (exit code {f['code']})" for d, f in found if f["code"]]
    ended = [f["summary"] for _, f in found if not f["code"]]
    most = {key: max((s["fixups"].get(key, 0) for s in ended), default=0) for key in MENDED}
    share = max((s["fixups"]["floor_energy_share"] for s in ended), default=0.0)
    updates = max((s["fixups"]["redone"] / s["cell_updates"]["fluid"] for s in ended), default=0.0)
    drift = max((f.get("gas_mass_drift") or 0.0 for _, f in found if not f["code"]), default=0.0)
    seconds = sum(s["wall_seconds"] for s in ended)
    rare = f"; floored {most['floored']}, energy {power(f'{share:.1e}')}" if most["floored"] else ""
    rare += f"; lifted phases {most['lifted_phases']}" if most["lifted_phases"] else ""
    return (f"| {wall} | {power(f'{pressure:.0e}')} | {cells} | {runs - len(failed)}/{runs}{': not ' if failed else ''}{', '.join(failed)}{rare} "
            f"| {most['redone']} ({power(f'{updates:.1e}')}) | {most['expanded_cells']} | {power(f'{drift:.0e}') if drift else ''} | {seconds:.0f} s |")


def load(stand_off, cells, summary):
    """A line of the table of loads."""
    short, long = (summary["sensors"][name] for name in ("short", "long"))
    pressures = [summary["wall_pressure_peak_first"], short["pressure_peak"], long["pressure_peak"]]
    in_mpa = " | ".join(f"{1e-6 * pressure:.0f} MPa" for pressure in pressures)
    return f"| {stand_off:g} | {cells} | {in_mpa} | {summary['wall_impulse_first']:.0f} Pa s | {1e3 * long['impulse']:.2f} mN s |"


def loads(options):
    """Runs what the table of loads is made of; the worst exit code."""
    print("| d/R | cells per radius | peak of the first load, axis | disc of 0.1 R, 1 ns | the same, 0.5 µs | its impulse on the axis | all on the disc |\n"
          "|---|---|---|---|---|---|---|")
    worst = 0
    for stand_off in options.stand_offs:
        for cells in options.cells:
            found = solve(options, 5e7, "rigid", stand_off, cells)
            if found is not None:
                worst = max(worst, found["code"])
                print(f"| {stand_off:g} | {cells} | exit code {found['code']} |" if found["code"] else load(stand_off, cells, found["summary"]), flush=True)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cav", type=Path, default=ROOT / "target/release/cav", help="the program")
    parser.add_argument("--out", type=Path, default=Path("near-wall"), help="directory of the runs")
    parser.add_argument("--load", action="store_true", help="the load on a rigid wall under 5e7 Pa")
    parser.add_argument("--cells", type=int, nargs="+", choices=LEVELS, help="per radius")
    parser.add_argument("--pressures", type=float, nargs="+", help="of the water, Pa")
    parser.add_argument("--walls", nargs="+", help="rigid, or materials of the library")
    parser.add_argument("--stand-offs", type=float, nargs="+", default=STAND_OFFS, help="d/R")
    parser.add_argument("--until", type=float, help="end in Rayleigh times")
    parser.add_argument("--threads", type=int, default=1, help="of each run")
    parser.add_argument("--processes", type=int, default=1, help="runs of a row at a time")
    parser.add_argument("--table", action="store_true", help="run nothing")
    options = parser.parse_args()
    if options.load and (options.walls or options.pressures):
        parser.error("--load is of a rigid wall under 5e7 Pa: it takes neither --walls nor --pressures")
    defaults = {"cells": [51, 102, 205], "until": 1.5} if options.load else {"cells": [26, 51], "until": 2.9}
    for name, value in {**defaults, "walls": WALLS, "pressures": PRESSURES}.items():
        if getattr(options, name) is None:
            setattr(options, name, value)
    options.out.mkdir(parents=True, exist_ok=True)
    if options.load:
        return 1 if loads(options) else 0
    print("| wall | pressure, Pa | cells per radius | ended | redone, most of a run (of its updates) | expanded "
          "| gas mass, change | time |\n|---|---|---|---|---|---|---|---|")
    worst = 0
    for cells in options.cells:
        for wall in options.walls:
            for pressure in options.pressures:
                with ThreadPoolExecutor(options.processes) as pool:
                    solved = pool.map(lambda d: solve(options, pressure, wall, d, cells), options.stand_offs)
                    found = [(d, f) for d, f in zip(options.stand_offs, solved) if f is not None]
                if found:
                    print(row(pressure, wall, cells, found), flush=True)
                worst = max([worst, *(f["code"] for _, f in found)])
    return 1 if worst else 0


if __name__ == "__main__":
    raise SystemExit(main())
