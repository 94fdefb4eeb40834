#!/usr/bin/env python3
"""What a region of interest saves, and what it changes: the table of docs/theory/region-of-interest.md.

    python3 scripts/region_of_interest.py                  all rows: about half an hour of two cores
    python3 scripts/region_of_interest.py --only pit       those of one group: coarse, medium, finest, pit, collapse

Runs each case as it is, and with changes; prints Markdown. Needs pycav and target/release/cav (or --cav).
"""

import sys

import program

LEVELS = ["time.local_steps=true", "fluid.near_wall.shock_levels=0"]
# Group: case, changes of all rows, then rows: radius of the region (m), thresholds of fluid and solid; none: the case's.
GROUPS = {
    "coarse": ("dickopp2012-coarse", [], [(None, None), (None, (3e-3, 3e-3)), (25e-3, (3e-3, 3e-3))]),
    "medium": ("dickopp2012-medium", LEVELS, [(None, None), (18e-3, None), (18e-3, (1.4e-3, 4e-3)), (18e-3, (2e-3, 4e-3)), (None, (2e-3, 4e-3))]),
    "finest": ("dickopp2012", [], [(None, None), (18e-3, None), (18e-3, (1.4e-3, 8e-3)), (18e-3, (2e-3, 8e-3))]),
    "pit": ("pit-near-steel", [], [(None, None), (15e-3, None)]),
    "collapse": ("collapse", [], [(None, None), (1.5e-3, None)]),
}
COLUMNS = {"wall pressure": "wall_pressure_peak", "impulse": "wall_impulse_first", "von Mises": "von_mises_peak",
           "R_min": "min_equivalent_radius", "pit": "pit_depth", "volume": "pit_volume"}


def changes_of(group, radius, thresholds):
    """The changes of a row, as --set has them."""
    changes = [] if radius is None else [f"region_of_interest.radius={radius}"]
    if thresholds:
        changes += [f"{side}.epsilon={epsilon}" for side, epsilon in zip(("fluid", "solid"), thresholds)]
        if group == "coarse":
            changes += ["fluid.adapt=true", "solid.adapt=true"]
    return changes


def change(summary, base, key):
    """A number's change against the first row's, in per cent."""
    if not base.get(key) or summary.get(key) is None:
        return "–"
    return f"{100 * (summary[key] / base[key] - 1):+.2f}"


def rows(options, group):
    case, always, variants = GROUPS[group]
    text = (program.ROOT / "cases" / f"{case}.toml").read_text()
    base = None
    for number, (radius, thresholds) in enumerate(variants):
        changes = always + changes_of(group, radius, thresholds) + options.set
        result, _ = program.solve(options, f"{group}-{number}", text, changes)
        if result is None:
            continue
        summary = result.summary
        base = base or summary
        updates, first = (sum(one["cell_updates"].values()) for one in (summary, base))
        values = [change(summary, base, key) for key in COLUMNS.values()] if summary is not base else ["the run compared with"] + [""] * 5
        given = "its own" if not thresholds else ", ".join(f"{epsilon:g}" for epsilon in thresholds)
        yield [group, "–" if radius is None else f"{1e3 * radius:g} mm", given, f"{updates / first:.2f}", *values]


if __name__ == "__main__":
    parser = program.parser(__doc__, "region-of-interest")
    parser.add_argument("--only", choices=GROUPS, help="one group of rows")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="a change of every case")
    options = parser.parse_args()
    print("| case | region | ε | updates |", " | ".join(COLUMNS), "|")
    print("|---" * (4 + len(COLUMNS)) + "|")
    for group in [options.only] if options.only else GROUPS:
        for row in rows(options, group):
            print("|", " | ".join(row), "|", flush=True)
    sys.exit(1 if program.FAILED else 0)
