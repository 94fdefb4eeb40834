"""README, CONTRIBUTING and CHANGELOG as pages of the book, and links to them from other pages.

They lie outside of the book's directory and are to stay readable there: what is changed is where their links lead.
"""

from __future__ import annotations

import posixpath
import re

from sphinx.application import Sphinx

PAGES = {"README.md": "about/readme", "CONTRIBUTING.md": "about/contributing", "CHANGELOG.md": "about/changelog"}
LINK = re.compile(r"(\]\()([^)\s#:]+)((?:#[^)\s]*)?\))")
# A picture with a width, which Markdown has no words for.
PICTURE = re.compile(r'(<img src=")([^"\s#:]+)(")')


def moved(text: str, at: str, to: str) -> str:
    """The text with its links as they have to be in the page `to` instead of the file `at` (both from the repository's root)."""

    def link(match: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(at), match[2]))
        target = f"docs/{PAGES[target]}.md" if target in PAGES else target
        return f"{match[1]}{posixpath.relpath(target, posixpath.dirname(to))}{match[3]}"

    return PICTURE.sub(link, LINK.sub(link, text))


def _read(app: Sphinx, page: str, source: list[str]) -> None:
    here = f"docs/{page}.md"
    file = next((name for name, place in PAGES.items() if place == page), None)
    if file is None:
        source[0] = moved(source[0], here, here)
        return
    path = app.srcdir.parent / file
    app.env.note_dependency(str(path))
    source[0] = moved(path.read_text(encoding="utf-8"), file, here)


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("source-read", _read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
