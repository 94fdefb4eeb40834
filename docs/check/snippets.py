"""Runs the code of a page from top to bottom, in a directory of its own.

    python docs/check/snippets.py PAGE DIRECTORY

Blocks of `python` share one namespace; blocks of `sh` are run by bash; blocks of `toml` are read as cases. What is no whole case is laid
over one: `cases/pit-near-steel.toml`, or what `base=PATH` after the word `toml` names; `file=PATH` saves it.

`cases/` in the directory are the cases of the repository with cells four times as wide, and so are those that commands ask for
(`--set fluid.levels=6`): what takes a minute on a page takes a second here. What takes hours is shortened by the comment before it:

    <!-- run-as: --cells 5 -->          these words are added to every command of the block
    <!-- run-as:                        a line for each command
    --set time.end=1e-6
    nothing
    -->

`scripts/` and `tests/long/` are copies, `.venv/bin/python` is the Python that runs this, `target/release/cav` the program of the tests, and
`cargo` is cargo.py beside this file: nothing is compiled again. `sbatch` and `scancel` are slurm.py.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pages import DOCS, ROOT, Block, Page

HERE = Path(__file__).parent
BASE = "cases/pit-near-steel.toml"
COARSER = 2
RUN = ("python", "sh", "toml")
NOT_RUN = ("text", "")
"""What a block may be called that nothing is done with: output, equations, drawings."""
RUN_AS = re.compile(r"<!-- run-as:(.+)-->", re.S)
DONE_BY = re.compile(r"<!-- done-by: (\S+): (.+) -->")
"""Something else does what the block does: the file, and a text that it holds there."""
COPIED = ("cases", "examples", "scripts", "tests/long")


def prepare(place: Path) -> None:
    """Copies what pages refer to, the cases coarser, and puts the programs where commands look for them."""
    for name in COPIED:
        shutil.copytree(ROOT / name, place / name, ignore=shutil.ignore_patterns("__pycache__"))
    for path in (place / "cases").rglob("*.toml"):
        path.write_text(coarser(path.read_text()))
    for name in ("target/release", ".venv/bin", "docs/images/paper"):
        (place / name).mkdir(parents=True)
    (place / "target/release/cav").symlink_to(os.environ["CAV_BINARY"])
    program(place / ".venv/bin/python", sys.executable)


def program(path: Path, *words: str) -> None:
    """Writes a program that is a command with words of its own."""
    path.write_text(f"#!/bin/sh\nexec {shlex.join(words)} \"$@\"\n")
    path.chmod(0o755)


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


def commands(text: str) -> list[str]:
    """The commands of a block, without what they say about themselves."""
    lines = re.sub(r"\\\n\s*", "", text).splitlines()
    return [re.sub(r"\s+#.*", "", line) for line in lines if line.strip() and not line.startswith("#")]


def shell(block: Block) -> str:
    """What bash is given: the block, with what a comment `run-as` adds to its commands."""
    text = coarser(block.text)
    found = RUN_AS.fullmatch(block.comment)
    if not found:
        return text
    lines, added = commands(text), found[1].strip().splitlines()
    if len(added) not in (1, len(lines)):
        raise SystemExit(f"{block.first}: {len(lines)} commands, and {len(added)} lines of run-as")
    more = ["" if words.strip() == "nothing" else words for words in added] * (len(lines) // len(added))
    return "\n".join(f"{line} {words}" for line, words in zip(lines, more))


def run_shell(block: Block) -> None:
    subprocess.run(["bash", "-euo", "pipefail", "-c", shell(block)], check=True, stdin=subprocess.DEVNULL, timeout=300)


def is_run(block: Block) -> bool:
    return block.language not in NOT_RUN and not DONE_BY.fullmatch(block.comment)


def run(page: Page, place: Path) -> None:
    os.chdir(place)
    namespace: dict[str, Any] = {"__name__": "__main__"}
    for block in page.blocks:
        where = f"{page.name}:{block.line}"
        if not is_run(block):
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
