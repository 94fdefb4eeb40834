"""The book's contents name sections by patterns; what matches no page yet is left out instead of being an error."""

from __future__ import annotations

from sphinx.application import Sphinx
from sphinx.util.matching import patfilter


def _read(app: Sphinx, page: str, source: list[str]) -> None:
    if page != app.config.root_doc:
        return
    left = app.env.found_docs - {page}
    kept = []
    for line in source[0].splitlines(keepends=True):
        entry = line.strip()
        if " " not in entry and entry:
            named = set(patfilter(left, entry)) if entry.endswith("*") else {entry}
            if entry.endswith("*") and not named:
                continue
            left -= named
        kept.append(line)
    source[0] = "".join(kept)


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("source-read", _read)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
