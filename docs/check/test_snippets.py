"""What pages tell people to type does what they say: see snippets.py."""

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

import cargo
from pages import ROOT, Block, Page, book
from snippets import DONE_BY, RUN_AS, commands, is_run, prepare, program, shell

HERE = Path(__file__).parent
BLOCKS = [(page, block) for page in book() for block in page.blocks]


def has_code(page: Page) -> bool:
    return any(is_run(block) for block in page.blocks)


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    """`cav` and `pycav` as an installation has them."""
    programs = tmp_path / "bin"
    programs.mkdir()
    (programs / "cav").symlink_to(os.environ["CAV_BINARY"])
    program(programs / "pycav", sys.executable, "-m", "pycav")
    program(programs / "cargo", sys.executable, str(HERE / "cargo.py"))
    for name in ("sbatch", "scancel"):
        program(programs / name, sys.executable, str(HERE / "slurm.py"), name)
    path = [str(programs), str(Path(sys.executable).parent), os.environ["PATH"]]
    return {**os.environ, "PATH": os.pathsep.join(path), "MPLBACKEND": "Agg"}


@pytest.mark.parametrize("page", [page for page in book() if has_code(page)], ids=lambda page: page.name)
def test_the_code_of_a_page_runs(page: Page, environment: dict[str, str], tmp_path: Path) -> None:
    place = tmp_path / "page"
    prepare(place)
    command = [sys.executable, str(HERE / "snippets.py"), page.name, str(place)]
    done = subprocess.run(command, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
    assert done.returncode == 0, done.stdout


def test_what_shortens_or_replaces_a_block_stands_right_before_it() -> None:
    for page in book():
        said = len(re.findall(r"<!-- (?:run-as|done-by):", page.text))
        meant = sum(bool(re.match(r"<!-- (?:run-as|done-by):", block.comment)) for block in page.blocks)
        assert said == meant, page.name
        for block in page.blocks:
            if RUN_AS.fullmatch(block.comment):
                assert block.language == "sh" and is_run(block), f"{page.name}:{block.line}"
                shell(block)


def test_what_something_else_does_is_done_there() -> None:
    for page, block in BLOCKS:
        if found := DONE_BY.fullmatch(block.comment):
            file, text = found.groups()
            assert text in (ROOT / file).read_text(encoding="utf-8"), f"{page.name}:{block.line}: {file} has no {text!r}"


def test_tests_that_pages_name_are_there() -> None:
    lines = [(page, line) for page, block in BLOCKS if block.language == "sh" for line in commands(block.text)]
    found = [(page, line) for page, line in lines if line.startswith("cargo test ")]
    assert found
    for page, line in found:
        assert cargo.asked(shlex.split(line)[2:]), f"{page.name}: {line}: there is no such test"


def test_system_packages_are_those_that_the_tests_install() -> None:
    installed = set(" ".join(re.findall(r"missing\+=\(([^)]*)\)", (ROOT / ".ci/run").read_text())).split())
    named = [line for name in ("README.md", "docs/guide/first-run.md") for line in
             re.findall(r"apt-get install -y (\w[\w -]*)", (ROOT / name).read_text())]
    assert named
    for packages in named:
        assert set(packages.split()) <= installed, set(packages.split()) - installed


def test_a_block_is_run_as_its_comment_says() -> None:
    text = "cav run a.toml \\\n    --quiet    # four words\n\ncav list\n"
    assert shell(Block("sh", (), text, 1, "")) == text
    assert shell(Block("sh", (), text, 1, "<!-- run-as: --out b -->")) == "cav run a.toml --quiet --out b\ncav list --out b"
    assert shell(Block("sh", (), text, 1, "<!-- run-as:\nnothing\n--all\n-->")) == "cav run a.toml --quiet \ncav list --all"
