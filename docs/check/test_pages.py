"""Pages stay short, sentences too, tables say how they were made, and the Python reference has every name."""

import inspect
import re

import pycav
import pytest

import measured
from limits import excess, looked_at
from pages import DOCS, Page, length, split

PAGES = looked_at()

# Words of how the program came about, which are nobody's business who reads about what it does.
PROCESS = re.compile(r"\b(TODO|FIXME|XXX|acceptance criteri\w*|this session|issue #?\d+|pull request|founder|helpers?)\b", re.I)

DIRECTIVE = re.compile(r"^\.\. (currentmodule|auto(?:module|class|function|exception|data)):: ([\w.]+)$", re.M)


def in_the_reference() -> set[str]:
    """The names of the package, from `pycav` on, whose docstrings the reference shows."""
    found = set()
    for path in (DOCS / "reference/python").glob("*.md"):
        module = ""
        for directive, name in DIRECTIVE.findall(path.read_text(encoding="utf-8")):
            if directive.endswith("module"):
                module = name
            if directive != "currentmodule":
                found.add(name if name.startswith("pycav.") else f"{module}.{name}")
    return found


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_is_short_and_so_are_its_sentences(page: Page) -> None:
    assert not (found := excess(page)), f"{page.name}: {found}; python docs/check/limits.py PAGE"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_speaks_of_the_program_not_of_its_making(page: Page) -> None:
    assert not (found := PROCESS.findall(page.text)), f"{page.name} says {found}"


def test_tables_of_numbers_say_how_and_when_they_were_made() -> None:
    assert not measured.unsourced(), "python docs/check/measured.py"


def test_a_table_needs_command_version_and_date() -> None:
    page = Page(DOCS / "index.md")
    page.text = "# A\n\n| a | b |\n|---|---|\n| x | 1 |\n| y | 2 |\n| z | 3 |\n"
    assert [table.lacks for table in measured.tables(page)] == [("command", "version", "date")]
    page = Page(DOCS / "index.md")
    page.text = "# A\n\nBy `cav run a.toml`.\n\n## B\n\n0.1.0, 2026-11-25\n\n| a | b |\n|---|---|\n| x | 1 |\n| y | 2 |\n| z | 3 |\n"
    assert [table.lacks for table in measured.tables(page)] == [()]


def test_sentences_are_told_apart() -> None:
    assert split("One ends (here). Two is by Celik et al. and goes on. `Three` has 1.5 words.") == [
        "One ends (here).", "Two is by Celik et al. and goes on.", "`Three` has 1.5 words."]
    assert length("p = 3 MPa, – and no more.") == 6


def test_the_reference_has_every_public_name_of_the_package() -> None:
    plots = [name for name, value in vars(pycav.plot).items() if inspect.isfunction(value) and not name.startswith("_")]
    public = {f"pycav.{name}" for name in pycav.__all__} | {f"pycav.plot.{name}" for name in plots}
    assert plots and not (missing := sorted(public - in_the_reference())), f"docs/reference/python lacks {', '.join(missing)}"
