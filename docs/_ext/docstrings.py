"""Docstrings as the package writes them.

Code is what is indented after a paragraph, as in Markdown; bars are those of a magnitude; pages of the book are named by their files.
"""

from __future__ import annotations

import re

from sphinx.application import Sphinx
from sphinx.ext.napoleon import Config, NumpyDocstring

SECTIONS = Config(napoleon_google_docstring=False)
PAGE = re.compile(r"docs/([\w/-]+)\.md")


def as_rst(lines: list[str]) -> list[str]:
    """The lines with `::` before what is indented by four or more, and a blank line before lists."""
    found: list[str] = []
    literal = False
    for number, line in enumerate(lines):
        blank = not line.strip()
        indented = line.startswith("    ")
        if not blank and not indented:
            literal = False
        if indented and not blank and not literal and (number == 0 or not lines[number - 1].strip()):
            before = next((text for text in reversed(found) if text.strip()), "")
            # What is indented below a list's entry or a field belongs to it.
            if not re.match(r"(- |:|\.\. )", before.lstrip()):
                found += ["::", ""]
                literal = True
        found.append(line if literal else plain(line))
    return found


def plain(line: str) -> str:
    """A line of text as reStructuredText, but for what stands between backticks."""
    parts = re.split(r"(`[^`]*`)", line)
    parts[::2] = [PAGE.sub(r":doc:`/\1`", part.replace("|", "\\|")) for part in parts[::2]]
    return "".join(parts)


def _process(app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    # Only where there are sections, underlined as numpy has them: of an attribute that reads `text: more` text would be the type.
    if any(re.match(r"-{3,}$", line) for line in lines):
        lines[:] = str(NumpyDocstring("\n".join(lines), SECTIONS, app, what, name, obj, options)).splitlines()
    lines[:] = as_rst(lines)


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("autodoc-process-docstring", _process)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
