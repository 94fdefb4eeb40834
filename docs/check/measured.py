"""Tables of numbers say where these come from: the command, the version of the program and the day, in their section or before the first one.

    python docs/check/measured.py     the tables that do not, and what they lack
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from pages import Page, book

LOOKED_UP = ("reference/", "notebooks/", "architecture.md")
"""Pages without measurements of their own."""
NUMBER = re.compile(r"[≈<±+−*(-]*\s*\d")
SAYS = {
    "command": re.compile(r"^\s*(?:\.venv/bin/python|python3?|cav|cargo) |`[^`\n]*(?:cav (?:run|check)|cargo (?:run|test|bench)|scripts/|tests/|benches/|cases/[\w/-]+\.toml)"
                          r"|#how-they-were-made", re.M),
    "version": re.compile(r"\b\d+\.\d+\.\d+\b"),
    "date": re.compile(r"\b20\d\d-\d\d-\d\d\b"),
}
EXCEPTED = re.compile(r"<!-- not measured: .{5,} -->")
"""Before a table of numbers that no run has made: chosen, counted or derived ones."""


@dataclass(frozen=True)
class Table:
    """A table of numbers: where it is, its heads, and what a reader cannot find out about it."""

    page: str
    line: int
    heads: tuple[str, ...]
    lacks: tuple[str, ...]

    @property
    def name(self) -> str:
        return f"{self.page}: {' | '.join(self.heads)}"


def tables(page: Page) -> list[Table]:
    """Those in which a third of the cells beside the first column begin with a number."""
    lines = page.text.splitlines()
    heads = [(token.map or [0])[0] for token in page.tokens if token.type == "heading_open" and token.tag == "h2"]
    found, comment = [], ""
    for k, token in enumerate(page.tokens):
        if token.type == "table_open" and not EXCEPTED.search(comment):
            first, last = token.map or [0, 0]
            titles, cells = contents(page, k)
            if is_of_numbers(cells):
                start = max((head for head in heads if head < first), default=0)
                end = min((head for head in heads if head > first), default=len(lines))
                text = "\n".join(lines[start:end] + lines[: min(heads, default=0)])
                found.append(Table(page.name, first + 1, titles, tuple(what for what, say in SAYS.items() if not say.search(text))))
        if token.type in ("html_block", "table_open", "paragraph_open"):
            comment = token.content
    return found


def contents(page: Page, k: int) -> tuple[tuple[str, ...], list[str]]:
    """The heads of a table, and the cells below them but for those of the first column."""
    titles, cells, column, kind = [], [], 0, ""
    for token in page.tokens[k:]:
        if token.type == "table_close":
            break
        if token.type == "tr_open":
            column = 0
        elif token.type in ("th_open", "td_open"):
            kind, column = token.type, column + 1
        elif token.type == "inline" and kind == "th_open":
            titles.append(token.content)
        elif token.type == "inline" and column > 1:
            cells.append(token.content.strip())
    return tuple(titles), cells


def is_of_numbers(cells: list[str]) -> bool:
    numbers = sum(bool(NUMBER.match(cell)) for cell in cells)
    return numbers >= 3 and numbers >= 0.3 * len(cells)


def unsourced() -> list[Table]:
    pages = [page for page in book() if not page.name.startswith(LOOKED_UP)]
    return [table for page in pages for table in tables(page) if table.lacks]


if __name__ == "__main__":
    for table in unsourced():
        print(f"{table.page}:{table.line}: {' | '.join(table.heads)[:80]}: no {', '.join(table.lacks)}")
