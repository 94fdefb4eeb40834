"""The gallery's page: its pictures are there, and its commands are those of the script, of cases that can be run."""

from __future__ import annotations

import re
import shlex
import sys
import tomllib

import pytest
from PIL import Image

import pycav

MOST_PICTURE, MOST_FILM, MOST_ALL = 200_000, 1_500_000, 5_000_000


@pytest.fixture(scope="module")
def gallery(root):
    sys.path.insert(0, str(root / "scripts"))
    try:
        from gallery import entries, runs
    finally:
        sys.path.pop(0)
    return entries.ENTRIES, runs.RUNS


@pytest.fixture(scope="module")
def page(root) -> str:
    return (root / "docs/guide/gallery.md").read_text()


def commands(page: str) -> list[str]:
    """What the page's blocks type, with loops gone through."""
    found: list[str] = []
    for block in re.findall(r"```text\n(.*?)```", page, re.DOTALL):
        loop = re.fullmatch(r"for (\w+) in (.*); do\n(.*)done\n", block, re.DOTALL)
        bodies = [loop[3].replace(f"${loop[1]}", value) for value in loop[2].split()] if loop else [block]
        for body in bodies:
            found += [part.strip() for part in re.split(r"\n(?= *cav )", body) if part.strip().startswith("cav ")]
    return found


def test_every_picture_is_on_the_page_and_small(root, gallery, page):
    directory = root / "docs/images/gallery"
    shown = re.findall(r"!\[[^]]+\]\(\.\./images/gallery/([\w-]+)\.webp\)", page)
    assert sorted(shown) == sorted(gallery[0]) == sorted(path.stem for path in directory.iterdir())
    for name, entry in gallery[0].items():
        path = directory / f"{name}.webp"
        is_film = entry.frame_milliseconds > 0
        assert path.stat().st_size < (MOST_FILM if is_film else MOST_PICTURE), name
        with Image.open(path) as image:
            assert (image.n_frames > 20) == is_film and image.width >= 700, name
        assert f"`{name}`" in page, f"{name}: what makes it"
    assert sum(path.stat().st_size for path in directory.iterdir()) < MOST_ALL


def test_the_pages_commands_are_the_scripts(gallery, page):
    entries, runs = gallery
    wanted = [line for name, run in runs.items() for line in run.commands(name, brief=True)]
    assert sorted(commands(page)) == sorted(wanted)
    assert {run for entry in entries.values() for run in entry.runs.values()} == set(runs), "every run is drawn"


def test_every_run_is_of_a_case_that_exists(root, gallery, tmp_path):
    for name, run in gallery[1].items():
        if run.case.startswith("new "):
            case = made(run.case)
        else:
            case = pycav.Case(root / run.case)
        keys = dict(change.split("=", 1) for change in run.changes)
        changed = case.with_({key: tomllib.loads(f"value = {value}")["value"] for key, value in keys.items()})
        assert "cells" in changed.check(), name


def made(words: str) -> pycav.Case:
    """What `cav new` would write."""
    _, kind, *options = shlex.split(words)
    given: dict[str, object] = {}
    for option in options:
        if option.startswith("--"):
            name = option[2:].replace("-", "_")
            given[name] = True
        else:
            given[name] = option if name == "wall" else float(option)
    return {"collapse": pycav.collapse, "free": pycav.free_bubble}[kind](**given)
