#!/usr/bin/env python3
"""What a run from Python costs more than the same run from the command line.

    python_overhead.py CASE [--set KEY=VALUE ...] [--rounds 7] [--threads 1] [--cav target/release/cav]

Runs `cav run --in-process` and `pycav.run` of a case in turn, each in a process of its own, and prints medians and smallest
values of what they took and the ratios (pycav to cav). Starting Python and importing pycav is not part of a run; it has a line of its
own. On a machine with other work look at the processors' time and at the smallest values. Needs pycav installed.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import pycav

import program

RUN = """
import json, resource, sys, time
started = time.perf_counter()
import pycav, pycav.result
imported = time.perf_counter()
def spent():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime, used.ru_utime + used.ru_stime
before, begin = spent(), time.perf_counter()
path, sets, out, threads = json.loads(sys.argv[1])
case = pycav.Case(path)
case = pycav.Case._of(case._native.with_sets(sets))
pycav.run(case, out, threads=threads)
end, after = time.perf_counter(), spent()
print(json.dumps({"wall": end - begin, "user": after[0] - before[0], "processor": after[1] - before[1],
                  "import": imported - started}))
"""
ROWS = [("computing", "as the summary has it: all steps of both media"), ("wall", "from reading the case to the last file"),
        ("user", "user time of all threads"), ("processor", "user and system time of all threads")]


def computing(out):
    """Seconds that the run's own clocks counted."""
    return sum(pycav.open(out).summary["compute_seconds"].values())


def by_command_line(cav, case, sets, out, threads):
    command = program.command(cav, case, out, sets, "--in-process", "--threads", str(threads))
    begin = time.perf_counter()
    child = subprocess.Popen(command)
    _, status, used = os.wait4(child.pid, 0)
    wall = time.perf_counter() - begin
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode:
        sys.exit(f"{command} failed")
    return {"wall": wall, "user": used.ru_utime, "processor": used.ru_utime + used.ru_stime, "computing": computing(out)}


def by_python(case, sets, out, threads):
    begin = time.perf_counter()
    told = subprocess.run([sys.executable, "-c", RUN, json.dumps([case, sets, str(out), threads])],
                          stdout=subprocess.PIPE, text=True, check=True).stdout
    whole = time.perf_counter() - begin
    found = json.loads(told.splitlines()[-1])
    return found | {"computing": computing(out), "around": whole - found["wall"]}


def main():
    parser = program.parser(__doc__)
    parser.add_argument("case")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    command_line, python = [], []
    with tempfile.TemporaryDirectory() as place:
        for number in range(options.rounds):
            turns = [(command_line, lambda out: by_command_line(options.cav, options.case, options.set, out, options.threads)),
                     (python, lambda out: by_python(options.case, options.set, out, options.threads))]
            # Whoever is first in a round is last in the next one.
            for found, run in turns if number % 2 == 0 else turns[::-1]:
                found.append(run(Path(place) / f"{number}-{len(command_line)}-{len(python)}"))
    print(f"{options.rounds} runs each, {options.threads} thread(s), load {os.getloadavg()[0]:.1f}; seconds\n")
    print("| what | cav, median | least | pycav, median | least | ratio of medians | of least | median of the rounds' |")
    print("|---|---|---|---|---|---|---|---|")
    for name, what in ROWS:
        ours, theirs = ([run[name] for run in runs] for runs in (python, command_line))
        a, b, c, d = statistics.median(theirs), min(theirs), statistics.median(ours), min(ours)
        rounds = statistics.median(x / y for x, y in zip(ours, theirs))
        print(f"| {name} ({what}) | {a:.2f} | {b:.2f} | {c:.2f} | {d:.2f} | {c / a:.3f} | {d / b:.3f} | {rounds:.3f} |")
    print(f"\nbesides, in Python: {statistics.median([run['around'] for run in python]):.2f} s to start the interpreter, to import "
          f"pycav ({statistics.median([run['import'] for run in python]):.2f} s) and to end")


if __name__ == "__main__":
    main()
