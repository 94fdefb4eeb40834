#!/usr/bin/env python3
"""What constants of the scheme are worth: the table of docs/verification/constants.md.

    python3 scripts/constants.py [NAME ...] [--out runs/constants] [--list]

For each constant the program is built again with it halved and doubled in a copy of the sources, and two cases are run: the figures'
collapse with both limiters, and the acoustic pulse. Prints the changes of the results in percent as Markdown. All constants are
eighteen programs and three runs of each, some five minutes a program on two cores. --list only says where the constants are. Needs
cargo, git and scripts/requirements.txt.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pycav

import program
from program import ROOT, fixed
from reference.series import misfit

FILES = {
    "WEAK": "crates/fluid/src/reconstruction/dispersion.rs",
    "ACOUSTIC": "crates/fluid/src/reconstruction/dispersion.rs",
    "IN_FRONTS": "crates/solid/src/boundary/mod.rs",
    "SAME_MODULUS": "crates/fluid/src/two_phase/closure.rs",
    "LONGEST_EXCHANGE": "src/run/side/coupled_solver.rs",
    "OPEN_SHARE": "crates/mesh/src/multiresolution/marks.rs",
    "LEAST": "crates/mesh/src/ghosts/mod.rs",
    "MOST": "crates/mesh/src/ghosts/mod.rs",
    "LARGEST_TRACE": "crates/fluid/src/thermodynamics/mixture.rs",
}
BOTH_ADAPT = {"fluid.adapt": "true", "solid.adapt": "true", "time.local_steps": "true"}
COLLAPSE = BOTH_ADAPT | {"fluid.model": "five-equation", "fluid.levels": "5", "solid.levels": "3", "time.snapshots": "[]"}
PULSE = BOTH_ADAPT | {"fluid.levels": "4", "solid.levels": "4", "time.end": "3e-6", "time.snapshots": "[]"}
RUNS = {
    "mc": ("dickopp2012-coarse", COLLAPSE | {"fluid.limiter": "mc", "solid.limiter": "mc"}),
    "minmod": ("dickopp2012-coarse", COLLAPSE | {"fluid.limiter": "minmod", "solid.limiter": "minmod"}),
    "pulse": ("acoustic-pulse", PULSE),
}
KEYS = ("collapse_time", "wall_pressure_peak", "von_mises_peak")


def definition(constant):
    """The file of a constant, what it says, and where in it the value is."""
    file = ROOT / FILES[constant]
    text = file.read_text()
    found = list(re.finditer(rf"(?<=const {constant}: f64 = )[^;]+(?=;)", text))
    if len(found) != 1:
        sys.exit(f"{FILES[constant]} has {len(found)} constants of the name {constant}")
    return file, text, found[0]


def build(options, constant=None, factor=1.0):
    """The program with a constant times `factor`: it is left in the directory of the runs."""
    sources = options.out / "sources"
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, check=True, text=True).stdout
    wanted = {name: (ROOT / name).read_bytes() for name in filter(None, listed.split("\0"))}
    if constant:
        _, text, value = definition(constant)
        wanted[FILES[constant]] = f"{text[:value.start()]}{factor} * ({value[0]}){text[value.end():]}".encode()
    for name, content in wanted.items():
        file = sources / name
        # By the time of its last change cargo sees that a file has another constant, or its own one again.
        if not file.exists() or file.read_bytes() != content:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
    target = options.out / "target"
    environment = os.environ | {"CARGO_TARGET_DIR": str(target)}
    subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=sources, env=environment, check=True)
    return shutil.copy2(target / "release/cav", options.out / "cav")


def results(options, cav, name):
    """The three numbers of the collapses, and the receivers of the pulse."""
    found = {}
    for run, (case, changes) in RUNS.items():
        out = options.out / name / run
        settings = [f"{key}={value}" for key, value in changes.items()]
        subprocess.run(program.command(cav, ROOT / f"cases/{case}.toml", out, settings), check=True)
        result = pycav.open(out)
        if run == "pulse":
            found[run] = receivers(result)
        else:
            found[run] = [result.summary[key] for key in KEYS]
    return found


def receivers(result):
    """Times and the change of the pressure, in the solid the normal stress, of each probe."""
    found = {}
    for name, probe in result.probes.items():
        values = np.asarray(probe["pressure"] if "pressure" in probe else probe["stress_zz"])
        found[name] = np.asarray(probe["time"]), values - values[0]
    return found


def largest_misfit(own, base):
    """The largest difference of a receiver in L2, of its own size."""
    return max(misfit(*own[name], *receiver) for name, receiver in base.items())


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("constants", nargs="*", metavar="NAME", help=f"of {', '.join(FILES)}, by default all")
    parser.add_argument("--out", type=Path, default=Path("runs/constants"), help="directory of sources, programs and runs")
    parser.add_argument("--list", action="store_true", help="print where the constants are, and build nothing")
    options = parser.parse_args()
    options.out = options.out.resolve()
    if unknown := [name for name in options.constants if name not in FILES]:
        parser.error(f"{unknown[0]}: none of {', '.join(FILES)}")
    if options.list:
        print("| constant | is | source file |\n|---|---|---|")
        for constant in options.constants or FILES:
            print(f"| `{constant}` | {definition(constant)[2][0]} | `{FILES[constant]}` |")
        return
    base = results(options, build(options), "as it is")
    print("| constant | | collapse time, % | wall pressure, % | von Mises stress, % | pulse, % |\n" + "|---" * 6 + "|")
    for constant in options.constants or FILES:
        for word, factor in (("half", 0.5), ("twice", 2.0)):
            own = results(options, build(options, constant, factor), f"{constant} {word}")
            change = {run: [100 * (a / b - 1) for a, b in zip(own[run], base[run])] for run in ("mc", "minmod")}
            cells = [f"{fixed(mc, '+.3f')} ({fixed(minmod, '+.3f')})" for mc, minmod in zip(change["mc"], change["minmod"])]
            print(f"| `{constant}` | {word} | {' | '.join(cells)} | {100 * largest_misfit(own['pulse'], base['pulse']):.2f} |", flush=True)


if __name__ == "__main__":
    main()
