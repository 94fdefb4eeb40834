"""What older pages may still exceed. The list only shrinks.

    python docs/check/allowances.py              the pages and what they exceed
    python docs/check/allowances.py --lower      write down what has become less
    python docs/check/allowances.py --long PAGE  the sentences of a page that are too long
"""

from __future__ import annotations

import sys
import tomllib
from pathlib import Path

from pages import DOCS, Page, book, length

FILE = Path(__file__).with_name("allowances.toml")
LINES, WORDS = 200, 30
KINDS = ("lines", "long_sentences", "indented_code")


def long_sentences(page: Page) -> list[str]:
    return [sentence for sentence in page.sentences if length(sentence) > WORDS]


def excess(page: Page) -> dict[str, int]:
    """What a page exceeds: lines beyond 200 as their number, sentences of more than 30 words, code that nothing runs."""
    lines = page.lines if page.lines > LINES else 0
    found = {"lines": lines, "long_sentences": len(long_sentences(page)), "indented_code": page.indented}
    return {kind: number for kind, number in found.items() if number}


def allowances() -> dict[str, dict[str, int]]:
    known: dict[str, dict[str, int]] = tomllib.loads(FILE.read_text())["pages"]
    return known


def generated() -> set[str]:
    return set(tomllib.loads(FILE.read_text())["generated"])


def no_run() -> list[str]:
    return sorted(tomllib.loads(FILE.read_text())["no_run"])


def unsourced() -> list[str]:
    return sorted(tomllib.loads(FILE.read_text())["unsourced"])


def measured() -> dict[str, dict[str, int]]:
    return {page.name: excess(page) for page in book() if page.name not in generated()}


def lower() -> None:
    """Writes the list anew with what has become less; nothing is added, nothing raised."""
    known, now = allowances(), measured()
    head, _, _ = FILE.read_text().partition("[pages]")
    rows = []
    for name, allowed in sorted(known.items()):
        left = {kind: min(number, now[name].get(kind, 0)) for kind, number in allowed.items() if name in now}
        pairs = ", ".join(f"{kind} = {number}" for kind, number in left.items() if number)
        rows += [f'"{name}" = {{ {pairs} }}'] if pairs else []
    FILE.write_text(f"{head}[pages]\n" + "".join(f"{row}\n" for row in rows))


def main(arguments: list[str]) -> None:
    if arguments[:1] == ["--lower"]:
        lower()
    elif arguments[:1] == ["--long"]:
        for sentence in long_sentences(Page(DOCS / arguments[1])):
            print(f"{length(sentence)}  {sentence}\n")
    else:
        for name, found in measured().items():
            if found:
                print(f'"{name}" = {{ {", ".join(f"{kind} = {number}" for kind, number in found.items())} }}')


if __name__ == "__main__":
    main(sys.argv[1:])
