"""Pictures that are wider than the text lead to themselves: what is too small to read is there as it was drawn."""

from __future__ import annotations

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.images import get_image_size

TEXT = 742
"""Width of the text, pixels."""


def _widths(app: Sphinx, doctree: nodes.document) -> None:
    for picture in doctree.findall(nodes.image):
        size = get_image_size(app.srcdir / picture["uri"]) if "://" not in picture["uri"] else None
        # Sphinx makes a link of a picture with a width; the style sheet keeps it within the text.
        if size and size[0] > TEXT and "width" not in picture:
            picture["width"] = f"{size[0]}px"


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("doctree-read", _widths)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
