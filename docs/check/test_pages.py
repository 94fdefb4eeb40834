"""Pages stay short, sentences too, and what is excepted only shrinks."""

import re

import pytest

from allowances import KINDS, allowances, excess, generated, no_run
from pages import Page, book, length, split

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


def test_sentences_are_told_apart() -> None:
    assert split("One ends (here). Two is by Celik et al. and goes on. `Three` has 1.5 words.") == [
        "One ends (here).", "Two is by Celik et al. and goes on.", "`Three` has 1.5 words."]
    assert length("p = 3 MPa, – and no more.") == 6
