"""Equations as MathML, which browsers draw themselves: no script, no fonts to fetch, no network."""

from __future__ import annotations

from docutils import nodes
from latex2mathml.converter import convert
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError


def _mathml(node: nodes.Element, display: str) -> str:
    try:
        return convert(node.astext(), display=display)
    except Exception as error:
        raise ExtensionError(f"{node.source}:{node.line}: no equation: {node.astext()!r}: {error}") from error


def _inline(self: object, node: nodes.math) -> None:
    self.body.append(_mathml(node, "inline"))  # type: ignore[attr-defined]
    raise nodes.SkipNode


def _block(self: object, node: nodes.math_block) -> None:
    number = f'<span class="number">({node["number"]})</span>' if node.get("number") else ""
    name = f' id="equation-{node["label"]}"' if node.get("label") else ""
    self.body.append(f'<div class="equation"{name}>{_mathml(node, "block")}{number}</div>\n')  # type: ignore[attr-defined]
    raise nodes.SkipNode


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_html_math_renderer("mathml", (_inline, None), (_block, None))
    app.config.html_math_renderer = "mathml"
    return {"parallel_read_safe": True, "parallel_write_safe": True}
