"""The pages of the book as text: headings, sentences, links, code."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token
from mdit_py_plugins.dollarmath import dollarmath_plugin
from mdit_py_plugins.front_matter import front_matter_plugin

DOCS = Path(__file__).resolve().parents[1]
ROOT = DOCS.parent
SKIPPED = {"_build", "_ext", "_static", "check", "images", "about"}
"""Folders without pages of their own: those of `about` are made of README, CONTRIBUTING and CHANGELOG."""

SENTENCE_END = re.compile(r"[.!?][\"”)*_]*(?=\s+[\"“(*_`A-Z0-9Ͱ-Ͽ\[]|\s*$)")
ABBREVIATION = re.compile(r"\b(e\.g|i\.e|cf|vs|Fig|Figs|Eq|Eqs|ch|et al|No|pp?)\.$")


@dataclass(frozen=True)
class Block:
    """A piece of code: its language, the words after it, the text, the line where it begins, the comment before it."""

    language: str
    words: tuple[str, ...]
    text: str
    line: int
    comment: str

    @property
    def first(self) -> str:
        """The first line that says something, by which a block is named."""
        return next((line.strip() for line in self.text.splitlines() if line.strip()), "")


class Page:
    """A Markdown file."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.text = path.read_text(encoding="utf-8")

    @property
    def name(self) -> str:
        """Its path below `docs`, or from the repository's root."""
        return self.path.relative_to(DOCS if self.path.is_relative_to(DOCS) else ROOT).as_posix()

    @cached_property
    def tokens(self) -> list[Token]:
        parser = MarkdownIt("commonmark").enable("table").use(front_matter_plugin).use(dollarmath_plugin, allow_space=False)
        return parser.parse(self.text)

    @property
    def is_notebook(self) -> bool:
        """Whether building the book runs it."""
        return bool(self.tokens) and self.tokens[0].type == "front_matter" and "kernelspec" in self.tokens[0].content

    @cached_property
    def lines(self) -> int:
        return len(self.text.splitlines())

    @cached_property
    def anchors(self) -> set[str]:
        """What a link can name: headings, as GitHub makes anchors of them."""
        found: dict[str, int] = {}
        for heading, inline in zip(self.tokens, self.tokens[1:]):
            if heading.type == "heading_open":
                name = slug("".join(part.content for part in inline.children or []))
                found[name] = found.get(name, 0) + 1
        return {f"{name}-{k}" if k else name for name, count in found.items() for k in range(count)}

    @cached_property
    def links(self) -> list[str]:
        """Where links and images lead."""
        parts = [part for token in self.tokens for part in token.children or []]
        return [str(part.attrs[key]) for part in parts for key in ("href", "src") if key in part.attrs]

    @cached_property
    def blocks(self) -> list[Block]:
        """Fenced code in the order of the page, without what is the book's own (`{toctree}` and the like)."""
        found, comment = [], ""
        for token in self.tokens:
            if token.type == "fence":
                language, *words = token.info.split() or [""]
                if not language.startswith("{"):
                    found.append(Block(language, tuple(words), token.content, (token.map or [0])[0] + 1, comment))
            comment = token.content.strip() if token.type == "html_block" else ""
        return found

    @cached_property
    def indented(self) -> int:
        """How many pieces of code are only indented: nothing runs them."""
        return sum(token.type == "code_block" for token in self.tokens)

    @cached_property
    def sentences(self) -> list[str]:
        """The sentences of paragraphs and lists; tables and headings are not read."""
        found: list[str] = []
        depth = {"table": 0, "heading": 0}
        for token in self.tokens:
            kind = token.type.partition("_")[0]
            if kind in depth:
                depth[kind] += token.nesting
            elif token.type == "inline" and not any(depth.values()):
                found += split(plain(token))
        return found


def plain(token: Token) -> str:
    """The text of a paragraph; a piece of code and an equation are a word each, pictures none."""
    words = {"text": lambda part: part.content, "softbreak": lambda _: " ", "hardbreak": lambda _: " ",
             "code_inline": lambda _: "`code`", "math_inline": lambda _: "`equation`"}
    return "".join(words[part.type](part) for part in token.children or [] if part.type in words)


def split(text: str) -> list[str]:
    """A paragraph's sentences."""
    found, start = [], 0
    for end in SENTENCE_END.finditer(text):
        piece = text[start : end.end()].strip()
        if not ABBREVIATION.search(piece):
            found.append(piece)
            start = end.end()
    return [piece for piece in [*found, text[start:].strip()] if piece]


def length(sentence: str) -> int:
    """Words of a sentence: what has a letter or a digit in it."""
    return sum(any(c.isalnum() for c in word) for word in sentence.split())


def slug(heading: str) -> str:
    """The anchor of a heading, as GitHub makes it."""
    kept = re.sub(r"[^\w\- ]", "", heading.strip().lower())
    return kept.replace(" ", "-")


def book() -> list[Page]:
    """All pages that somebody has written for the book."""
    paths = sorted(DOCS.rglob("*.md"))
    return [Page(path) for path in paths if path.relative_to(DOCS).parts[0] not in SKIPPED]
