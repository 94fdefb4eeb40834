#!/usr/bin/env python3
"""The pictures and films of docs/guide/gallery.md.

    python3 scripts/gallery.py [NAME ...] [--cav PROGRAM] [--out RUNS] [--images DIR] [--commands]

Makes the runs that are missing below runs/gallery, ten minutes in all, and draws into
docs/images/gallery; without names everything. --commands only prints what is run. Needs scripts/requirements.txt.
"""

import argparse
from pathlib import Path

from gallery import files
from gallery.entries import ENTRIES
from gallery.runs import ROOT, RUNS, result

FILM_WIDTH = 720


def draw(options, name):
    """Writes the file of a name."""
    entry = ENTRIES[name]
    found = {key: result(options, run) for key, run in entry.runs.items()}
    drawn = entry.draw(found[None] if None in found else found)
    path = options.images / f"{name}.webp"
    if entry.frame_milliseconds:
        files.save_film(drawn, path, FILM_WIDTH, entry.frame_milliseconds)
    else:
        files.save(drawn, path)
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(ENTRIES)}")
    parser.add_argument("--cav", type=Path, default=ROOT / "target/release/cav", help="the program")
    parser.add_argument("--out", type=Path, default=ROOT / "runs/gallery", help="directory of the runs")
    parser.add_argument("--images", type=Path, default=ROOT / "docs/images/gallery", help="directory of the pictures")
    parser.add_argument("--commands", action="store_true", help="print the commands of the runs")
    options = parser.parse_args()
    names = options.names or list(ENTRIES)
    if unknown := [name for name in names if name not in ENTRIES]:
        parser.error(f"there is no {', '.join(unknown)}, only {', '.join(ENTRIES)}")
    if options.commands:
        for run in dict.fromkeys(run for name in names for run in ENTRIES[name].runs.values()):
            print("\n".join(RUNS[run].commands(run)))
        return
    options.images.mkdir(parents=True, exist_ok=True)
    for name in names:
        draw(options, name)


if __name__ == "__main__":
    main()
