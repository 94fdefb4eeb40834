"""What pages tell people to type does what they say: see snippets.py."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pages import Page, book
from snippets import NOT_RUN, prepare

HERE = Path(__file__).parent


def has_code(page: Page) -> bool:
    return any("no-run" not in block.words and block.language not in NOT_RUN for block in page.blocks)


@pytest.fixture
def environment(tmp_path: Path) -> dict[str, str]:
    """`cav` and `pycav` as an installation has them."""
    programs = tmp_path / "bin"
    programs.mkdir()
    (programs / "cav").symlink_to(os.environ["CAV_BINARY"])
    (programs / "pycav").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m pycav "$@"\n')
    (programs / "pycav").chmod(0o755)
    path = [str(programs), str(Path(sys.executable).parent), os.environ["PATH"]]
    return {**os.environ, "PATH": os.pathsep.join(path), "MPLBACKEND": "Agg"}


@pytest.mark.parametrize("page", [page for page in book() if has_code(page)], ids=lambda page: page.name)
def test_the_code_of_a_page_runs(page: Page, environment: dict[str, str], tmp_path: Path) -> None:
    place = tmp_path / "page"
    prepare(place)
    command = [sys.executable, str(HERE / "snippets.py"), page.name, str(place)]
    done = subprocess.run(command, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=600)
    assert done.returncode == 0, done.stdout
