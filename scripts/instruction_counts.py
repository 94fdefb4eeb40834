#!/usr/bin/env python3
"""What a step executes per cell, for docs/performance: divisions, roots, sums, loads, stores.

    python3 scripts/instruction_counts.py [fluid] [exact] [solid] [--levels 4] [--functions 6]

Runs a sound pulse of few and of more steps in QEMU's user mode (`qemu-x86_64`, Debian's qemu-user, 7.2 or newer), which has AVX2
but not AVX-512: one medium alone, uniform grid, one thread. QEMU logs each block of instructions that it translates, and each that
it executes. What the longer run has more is that of the steps between. An instruction counts as many numbers as it works on: four
in a register of 32 bytes. Prints Markdown. Needs scripts/requirements.txt.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import program

CASE = """
[time]
end = {end}
snapshots = []
[output]
interface_every = {end}
[{side}]
z = [0.0, 0.0128]
r = [0.0, 0.0128]
cells = [16, 16]
levels = {levels}
adapt = false
{physics}
[[{side}.pulse]]
{shape}
centre = [0.0064, 0.0]
width = 3e-3
amplitude = {amplitude}
[coupling]
scheme = "none"
"""
LIQUID = """
riemann = "{riemann}"
[fluid.liquid]
gamma = 7.15
pi = 3e8
[fluid.ambient]
phase = "liquid"
density = 1000.0
pressure = 1e5
"""
SOUND = {"side": "fluid", "shape": 'shape = "sphere"', "amplitude": "1e6"}
RUNS = {
    "fluid": SOUND | {"physics": LIQUID.format(riemann="hllc")},
    "exact": SOUND | {"physics": LIQUID.format(riemann="exact")},
    "solid": {"side": "solid", "shape": "", "amplitude": "1e-9", "physics": 'material = "structural-steel"'},
}
# How long the two runs are on 256 cells, s. How many steps that is they say themselves.
ENDS = {"fluid": (4e-8, 12e-8), "solid": (1e-8, 3e-8)}

# Where QEMU puts a program, and how much of what follows is looked at: its own text, no libraries.
BASE, TEXT = 0x4000000000, 0x2000000

INSTRUCTION = re.compile(r"^0x([0-9a-f]+):  (?:[0-9a-f]{2} )+\s*(\S+)\s*(.*)$")
EXECUTED = re.compile(r"^Trace \d+: \S+ \[[0-9a-f]+/([0-9a-f]+)/")
COLUMNS = ("divisions", "roots", "sums and products", "comparisons and choices", "loads", "stores",
           "loads and stores of the stack", "instructions")


@dataclass
class Block:
    """Instructions that are executed one after the other: the function that they are of, and what they come to."""

    function: str
    counts: Counter


def plain(symbol):
    """The path in a mangled name: its parts, each of which follows its length."""
    rest, parts = re.sub(r"^_?_ZN", "", symbol), []
    while match := re.match(r"\d+", rest):
        end = match.end() + int(match[0])
        parts.append(rest[match.end():end])
        rest = rest[end:]
    # Neither the hash, nor which implementation or closure it is, nor the instruction set that is always the same here.
    named = [part for part in parts if not re.fullmatch(r"h[0-9a-f]{16}|.*\$.*|.*_version", part)]
    return "::".join(named) or symbol or "?"


def counts_of(mnemonic, operands):
    """What one instruction counts as, in AT&T's syntax: the last operand is where the result goes."""
    found = Counter({"instructions": 1})
    vector = re.fullmatch(r"v?([a-z0-9]+?)([ps]d)", mnemonic)
    moves = re.fullmatch(r"v?mov(?:[au]p[sd]|dq[au]|sd|q|[lh]pd|nt.*)", mnemonic)
    if not vector and not moves and not mnemonic.startswith(("vbroadcast", "vmov", "vp", "vblend", "vand", "vor", "vxor")):
        return found
    width = 32 if "%ymm" in operands else 16
    if (vector and vector[2] == "sd") or re.fullmatch(r"v?mov(sd|q|[lh]pd)|vbroadcastsd", mnemonic):
        width = 8
    numbers = width // 8
    operation = vector[1] if vector else ""
    if operation == "div":
        found["divisions"] = numbers
    elif operation == "sqrt":
        found["roots"] = numbers
    elif operation in ("add", "sub", "mul"):
        found["sums and products"] = numbers
    elif operation.startswith(("fmadd", "fmsub", "fnmadd", "fnmsub")):
        found["sums and products"] = 2 * numbers
    elif operation.startswith(("cmp", "min", "max", "blend", "and", "or", "xor")):
        found["comparisons and choices"] = numbers
    memory = re.search(r"\(([^)]*)\)", operands)
    if memory and "%xmm" not in memory[1] and not mnemonic.startswith("vpextr"):
        stores = bool(moves) and operands.rstrip().endswith(")")
        found["stores" if stores else "loads"] = numbers
        if memory[1].startswith(("%rsp", "%rbp")):
            found["loads and stores of the stack"] = numbers
    return found


def executed(lines):
    """Blocks by their address, and how often each ran, from QEMU's log."""
    blocks, times, function, block = {}, Counter(), "?", None
    for line in lines:
        if match := EXECUTED.match(line):
            times[int(match[1], 16)] += 1
        elif line.startswith("IN:"):
            function, block = plain(line[3:].strip()), None
        elif match := INSTRUCTION.match(line):
            if block is None:
                block = blocks[int(match[1], 16)] = Block(function, Counter())
            block.counts.update(counts_of(match[2], match[3]))
    return blocks, times


def run(options, name, end, directory):
    """Counts of a whole run by function, and the updates of cells in it."""
    case, log = directory / f"{name}.toml", directory / "log"
    case.write_text(CASE.format(end=end, levels=options.levels, **RUNS[name]))
    os.mkfifo(log)
    command = ["qemu-x86_64", "-cpu", "max", "-d", "in_asm,exec,nochain", "-dfilter", f"{BASE:#x}+{TEXT:#x}", "-D", str(log),
               *program.command(options.cav, case, directory / "run", (), "--in-process")]
    with subprocess.Popen(command, env=os.environ | {"RAYON_NUM_THREADS": "1"}) as running:
        with log.open(errors="replace") as lines:
            blocks, times = executed(lines)
    log.unlink()
    if running.returncode:
        sys.exit(f"{name}: the run ended with {running.returncode}")
    summary = json.loads((directory / "run" / "summary.json").read_text())
    functions = {}
    for address, number in times.items():
        if block := blocks.get(address):
            total = functions.setdefault(block.function, Counter())
            total.update({what: number * count for what, count in block.counts.items()})
    return functions, summary["cell_updates"][RUNS[name]["side"]]


def per_cell(options, name):
    """Counts per cell and step by function: what the longer run has more."""
    scale = 2.0 ** (4 - options.levels)
    with tempfile.TemporaryDirectory() as directory:
        (first, fewer), (second, more) = (run(options, name, scale * end, Path(directory)) for end in ENDS[RUNS[name]["side"]])
    if more <= fewer:
        sys.exit(f"{name}: both runs have {fewer} updates of cells")
    return {function: {what: (counts[what] - first.get(function, {}).get(what, 0)) / (more - fewer) for what in COLUMNS}
            for function, counts in second.items()}


def row(name, counts):
    print(f"| {name} | " + " | ".join(f"{counts[what]:.1f}" for what in COLUMNS) + " |", flush=True)


def main():
    parser = program.parser(__doc__)
    parser.add_argument("which", nargs="*", metavar="fluid | exact | solid", help="what is counted, by default all")
    parser.add_argument("--levels", type=int, default=4, help="levels: 16 2^levels cells each way")
    parser.add_argument("--functions", type=int, default=6, help="how many functions have a row of their own")
    options = parser.parse_args()
    if unknown := [name for name in options.which if name not in RUNS]:
        parser.error(f"{unknown[0]}: none of {', '.join(RUNS)}")
    print("| | " + " | ".join(COLUMNS) + " |\n" + "|---" * (len(COLUMNS) + 1) + "|")
    for name in options.which or RUNS:
        functions = per_cell(options, name)
        row(f"**{name}**", {what: sum(counts[what] for counts in functions.values()) for what in COLUMNS})
        dearest = sorted(functions, key=lambda function: -functions[function]["instructions"])
        for function in dearest[:options.functions]:
            row(f"`{function}`", functions[function])


if __name__ == "__main__":
    main()
