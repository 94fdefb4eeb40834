"""How long pages and sentences may be.

    python docs/check/limits.py          the pages that exceed it, and by what
    python docs/check/limits.py PAGE     the sentences of a page that are too long
"""

from __future__ import annotations

import sys

from pages import DOCS, Page, book, length

LINES, WORDS = 200, 30
GENERATED = {"reference/case-keys.md", "reference/command-line.md"}
"""Pages that the program writes: neither length nor sentences are looked at."""


def looked_at() -> list[Page]:
    return [page for page in book() if page.name not in GENERATED]


def long_sentences(page: Page) -> list[str]:
    return [sentence for sentence in page.sentences if length(sentence) > WORDS]


def excess(page: Page) -> dict[str, int]:
    """What a page exceeds: lines beyond 200 as their number, sentences of more than 30 words, code that nothing runs."""
    lines = page.lines if page.lines > LINES else 0
    found = {"lines": lines, "long sentences": len(long_sentences(page)), "indented code": page.indented}
    return {kind: number for kind, number in found.items() if number}


def main(arguments: list[str]) -> None:
    for name in arguments:
        for sentence in long_sentences(Page(DOCS / name)):
            print(f"{length(sentence)}  {sentence}\n")
    if not arguments:
        for page in looked_at():
            if found := excess(page):
                print(page.name, found)


if __name__ == "__main__":
    main(sys.argv[1:])
