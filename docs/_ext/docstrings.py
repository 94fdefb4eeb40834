"""Docstrings and types as the package writes them.

Code is what is indented after a paragraph, as in Markdown; bars are those of a magnitude; pages of the book are named by their files.
"""

from __future__ import annotations

import re

import pycav
from pycav._native import Native
from sphinx.application import Sphinx
from sphinx.ext.napoleon import Config, NumpyDocstring
from sphinx.util.inspect import TypeAliasForwardRef

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


def _types(app: Sphinx) -> None:
    """Shows the attributes of what is wrapped with the types that they have for a caller: `float`, not `Native[float]`."""
    for name in pycav.__all__:
        shown = getattr(pycav, name)
        for owner in getattr(shown, "__mro__", ()):
            for attribute, found in vars(owner).items():
                if isinstance(found, Native):
                    held = re.sub(r"^Native\[(.*)\]$", r"\1", owner.__annotations__[attribute])
                    shown.__annotations__[attribute] = app.config.autodoc_type_aliases.get(held, held)


def setup(app: Sphinx) -> dict[str, bool]:
    # Within other types, as in `dict[str, Array]`, Sphinx 8 shows how it writes a name down itself.
    TypeAliasForwardRef.__repr__ = lambda self: self.name  # type: ignore[method-assign]
    app.connect("builder-inited", _types)
    app.connect("autodoc-process-docstring", _process)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
