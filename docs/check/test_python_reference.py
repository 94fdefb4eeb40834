"""Every public name of the Python package is on a page of its reference."""

import re

import pycav
import pytest

from pages import DOCS

DIRECTIVE = re.compile(r"^\.\. (currentmodule|automodule|auto(?:function|class|data|exception)):: ([\w.]+)", re.M)


def documented() -> set[str]:
    """Full names that pages of the reference take from docstrings."""
    found = set()
    for path in (DOCS / "reference/python").glob("*.md"):
        module = "pycav"
        for kind, name in DIRECTIVE.findall(path.read_text(encoding="utf-8")):
            if kind in ("currentmodule", "automodule"):
                module = name
            if kind != "currentmodule":
                found.add(name if kind == "automodule" or name.startswith("pycav.") else f"{module}.{name}")
    return found


def public() -> list[str]:
    """The names of the package, and the functions of `pycav.plot`."""
    drawing = [name for name in pycav.plot.__all__ if callable(getattr(pycav.plot, name)) and name[0].islower()]
    return [f"pycav.{name}" for name in pycav.__all__] + [f"pycav.plot.{name}" for name in drawing]


@pytest.mark.parametrize("name", public())
def test_a_public_name_is_in_the_reference(name: str) -> None:
    assert name in documented(), f"{name} is on no page of docs/reference/python"


def test_what_the_package_leaves_out_of_its_names_is_noticed() -> None:
    drawing = {name for name, value in vars(pycav.plot).items() if callable(value) and name[0].islower()}
    assert drawing == {name for name in pycav.plot.__all__ if name[0].islower()}
