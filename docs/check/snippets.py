"""Runs the code of a page from top to bottom, in a directory of its own.

    python docs/check/snippets.py PAGE DIRECTORY

Blocks of `python` share one namespace; blocks of `sh` are run by bash; blocks of `toml` are read as cases. What is no whole case is laid
over one: `cases/pit-near-steel.toml`, or what `base=PATH` after the word `toml` names; `file=PATH` saves it.

`cases/` in the directory are the cases of the repository with cells four times as wide, and so are those that commands ask for
(`--set fluid.levels=6`): what takes a minute on a page takes a second here.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pages import DOCS, ROOT, Block, Page

BASE = "cases/pit-near-steel.toml"
COARSER = 2
RUN = ("python", "sh", "toml")
NOT_RUN = ("text", "")
"""What a block may be called that nothing is done with: output, equations, drawings."""


def prepare(place: Path) -> None:
    """Copies what pages refer to: the cases, coarser, and the examples."""
    shutil.copytree(ROOT / "cases", place / "cases")
    shutil.copytree(ROOT / "examples", place / "examples")
    for path in (place / "cases").rglob("*.toml"):
        path.write_text(coarser(path.read_text()))


def coarser(text: str) -> str:
    """A case, or commands, with fewer levels."""

    def fewer(levels: re.Match[str]) -> str:
        number = int(levels[2])
        return f"{levels[1]}{max(number - COARSER, min(number, 2))}"

    return re.sub(r"(^levels = |\b(?:fluid|solid)\.levels=)(\d+)", fewer, text, flags=re.M)


def over(base: Mapping[str, Any], given: Mapping[str, Any]) -> dict[str, Any]:
    """A case with another one's tables laid over its own."""
    found = dict(base)
    for key, value in given.items():
        below = found.get(key)
        found[key] = over(below, value) if isinstance(value, Mapping) and isinstance(below, Mapping) else value
    return found


def read_case(block: Block) -> None:
    import pycav
    from pycav import _toml

    options = dict(word.split("=", 1) for word in block.words if "=" in word)
    given = _toml.parse(block.text)
    base = options.get("base", BASE)
    if "file" in options:
        Path(options["file"]).write_text(coarser(block.text))
    whole = "time" in given and ("fluid" in given or "solid" in given)
    pycav.Case.from_dict(given if whole else over(_toml.parse(Path(base).read_text()), given))


def run_shell(block: Block) -> None:
    subprocess.run(["bash", "-euo", "pipefail", "-c", coarser(block.text)], check=True, stdin=subprocess.DEVNULL, timeout=300)


def run(page: Page, place: Path) -> None:
    os.chdir(place)
    namespace: dict[str, Any] = {"__name__": "__main__"}
    for block in page.blocks:
        where = f"{page.name}:{block.line}"
        if "no-run" in block.words or block.language in NOT_RUN:
            continue
        if block.language not in RUN:
            raise SystemExit(f"{where}: code called {block.language!r}; call it one of {', '.join(RUN)}, or text")
        print(f"== {where}: {block.first}", flush=True)
        if block.language == "python":
            # As many lines before it as there are on the page, so that errors name the page's lines.
            exec(compile("\n" * block.line + block.text, str(page.path), "exec"), namespace)
        elif block.language == "sh":
            run_shell(block)
        else:
            read_case(block)


if __name__ == "__main__":
    run(Page(DOCS / sys.argv[1]), Path(sys.argv[2]))
