"""What `cargo` is for the commands of pages: nothing is compiled again.

    cargo run --release -- WORDS     is `cav WORDS`
    cargo test ...                   looks whether there are such tests: the test command runs all that are not ignored,
                                     `.ci/run` short forms of those that are
"""

from __future__ import annotations

import os
import re
import sys
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
ATTRIBUTES = r"(?:[ \t]*(?:#\[[^\]]*\]|//[^\n]*)\n)*"
STUDIES = "cargo test --tests -- --ignored"
TEST = re.compile(rf"({ATTRIBUTES})[ \t]*fn (\w+)\(\)")


class Test(NamedTuple):
    name: str
    is_ignored: bool


def tests(package: str, target: str) -> list[Test]:
    """The tests of a program of tests by their paths, as `--list` has them."""
    place = ROOT / ("tests" if package == "cav" else f"crates/{package}/tests")
    files = [path for path in (place / f"{target}.rs", *sorted((place / target).rglob("*.rs"))) if path.exists()]
    found = []
    for path in files:
        inside = path.relative_to(place / target).with_suffix("").parts if path.is_relative_to(place / target) else ()
        module = "".join(f"{part}::" for part in inside if part not in ("main", "mod"))
        for attributes, name in TEST.findall(path.read_text(encoding="utf-8")):
            if "#[test]" in attributes:
                found.append(Test(module + name, "#[ignore" in attributes))
    return found


def asked(words: list[str]) -> list[Test]:
    """The tests that `cargo test WORDS` runs."""
    package, target, names, flags = "cav", "", [], set()
    rest = iter(words)
    for word in rest:
        if word in ("-p", "--package"):
            package = next(rest)
        elif word == "--test":
            target = next(rest)
        elif word.startswith("-"):
            flags.add(word)
        else:
            names.append(word)
    return [test for test in tests(package, target) if test.is_ignored == ("--ignored" in flags)
            and (not names or any(name == test.name if "--exact" in flags else name in test.name for name in names))]


def main(words: list[str]) -> None:
    if words[:3] == ["run", "--release", "--"]:
        os.execvp("cav", ["cav", *words[3:]])
    if words[:1] != ["test"]:
        sys.exit(f"cargo {' '.join(words)}: of cargo's commands pages have only `run --release --` and `test` run")
    found = asked(words[1:])
    if not found:
        sys.exit(f"cargo {' '.join(words)}: there is no such test")
    if any(test.is_ignored for test in found) and STUDIES not in (ROOT / ".ci/run").read_text(encoding="utf-8"):
        sys.exit(f"cargo {' '.join(words)}: .ci/run no longer has `{STUDIES}`, which tries what the test command leaves out")
    print("\n".join(test.name for test in found))


if __name__ == "__main__":
    main(sys.argv[1:])
