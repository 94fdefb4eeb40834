#!/usr/bin/env python3
"""How a run scales with threads: the tables of docs/performance/threads.md.

    python3 scripts/thread_scaling.py                              the first 6 us of the paper's finest grids, 1 and 2 threads
    python3 scripts/thread_scaling.py --case collapse --threads 1 2 4 8 16 --two

Prints Markdown: wall time, speed-up over one thread, processor time, and the serial fraction after Karp and Flatt (1990),
(1/S - 1/n)/(1 - 1/n): what could not be shared out, whatever the reason. With --two there is a column of two processes with so many
threads each. Every run is made --repeat times, the fastest counts. Needs pycav and target/release/cav (or --cav).
"""

import tempfile
from pathlib import Path

import program

# Case and what is changed of it: no snapshots but the last, which one thread compresses.
CASES = {
    "finest": ("dickopp2012", ["time.end=6e-6", "time.snapshots=[]"]),
    "medium": ("dickopp2012-medium", ["time.snapshots=[]"]),
    "collapse": ("collapse", ["time.snapshots=[]"]),
}


def timed(command):
    """Wall and processor time of a command, s."""
    wall, used = program.usage(command)
    return wall, used.ru_utime + used.ru_stime


def fastest(options, threads, *more):
    """The fastest of some runs with so many threads."""
    case, changes = CASES[options.case]
    with tempfile.TemporaryDirectory() as directory:
        command = program.command(options.cav, program.ROOT / "cases" / f"{case}.toml", Path(directory) / "run",
                                  changes + options.set, "--threads", str(threads), *more)
        return min(timed(command) for _ in range(options.repeat))


def main():
    parser = program.parser(__doc__)
    parser.add_argument("--case", choices=CASES, default="finest")
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2], help="the first is compared with, one is meant")
    parser.add_argument("--two", action="store_true", help="two processes, too")
    parser.add_argument("--repeat", type=int, default=2)
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a change of the case")
    options = parser.parse_args()
    heads = ["case", "threads", "wall time", "speed-up", "processor time", "serial fraction"]
    heads += ["two processes of so many", "speed-up"] if options.two else []
    print("|", " | ".join(heads), "|\n" + "|---" * len(heads) + "|")
    base = None
    for threads in options.threads:
        wall, processor = fastest(options, threads, "--in-process")
        base = base or wall
        speed_up = base / wall
        serial = f"{100 * (1 / speed_up - 1 / threads) / (1 - 1 / threads):.1f} %" if threads > 1 else ""
        row = [options.case, str(threads), f"{wall:.1f} s", f"{speed_up:.2f}", f"{processor:.1f} s", serial]
        if options.two:
            wall, _ = fastest(options, threads)
            row += [f"{wall:.1f} s", f"{base / wall:.2f}"]
        print("|", " | ".join(row), "|", flush=True)


if __name__ == "__main__":
    main()
