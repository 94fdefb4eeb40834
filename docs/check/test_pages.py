"""Pages stay short, sentences too, and what is excepted only shrinks."""

import re

import pytest

import measured
from allowances import KINDS, allowances, excess, generated, no_run, unsourced
from pages import DOCS, Page, book, length, split

PAGES = [page for page in book() if page.name not in generated()]

# Words of how the program came about, which are nobody's business who reads about what it does.
PROCESS = re.compile(r"\b(TODO|FIXME|XXX|acceptance criteri\w*|this session|issue #?\d+|pull request|founder|helpers?)\b", re.I)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_is_short_and_so_are_its_sentences(page: Page) -> None:
    allowed, found = allowances().get(page.name, {}), excess(page)
    for kind in KINDS:
        assert found.get(kind, 0) <= allowed.get(kind, 0), f"{page.name}: {kind}; python docs/check/allowances.py --long PAGE"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page_speaks_of_the_program_not_of_its_making(page: Page) -> None:
    assert not (found := PROCESS.findall(page.text)), f"{page.name} says {found}"


def test_what_is_excepted_is_still_needed() -> None:
    now = {page.name: excess(page) for page in PAGES}
    stale = {name: kind for name, kinds in allowances().items() for kind, number in kinds.items()
             if number > now.get(name, {}).get(kind, 0)}
    assert not stale, f"python docs/check/allowances.py --lower: {stale}"


def test_code_that_is_not_run_is_known_and_says_why() -> None:
    blocks = [(page, block) for page in book() for block in page.blocks if "no-run" in block.words]
    assert sorted(f"{page.name}: {block.first}" for page, block in blocks) == no_run()
    for page, block in blocks:
        assert re.match(r"<!-- no-run: .{10,} -->$", block.comment), f"{page.name}:{block.line} says not why it is not run"


def test_tables_of_numbers_say_how_and_when_they_were_made() -> None:
    assert sorted(table.name for table in measured.unsourced()) == unsourced(), "python docs/check/measured.py"


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
