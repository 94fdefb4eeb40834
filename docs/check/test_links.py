"""Links lead somewhere: in all Markdown of the repository, and wherever a file names a page of `docs`.

(Sphinx looks at the book's own links, too; this also reads what is outside of the book.)
"""

import re
import sys
from functools import cache
from pathlib import Path

import pytest

from pages import DOCS, ROOT, Page

MADE = {"target", "runs", ".git", ".venv", "_build", "__pycache__", "corpus", "artifacts"}
MENTION = re.compile(r"docs/[\w/-]+\.md(#[\w-]+)?")
TEXT = {".rs", ".py", ".pyi", ".toml", ".md", ".sh", ".txt", ""}


def files(where: Path) -> list[Path]:
    found: list[Path] = []
    for path in sorted(where.iterdir()):
        if path.name in MADE or path.is_symlink():
            continue
        found += files(path) if path.is_dir() else [path] if path.suffix in TEXT else []
    return found


FILES = files(ROOT)


@cache
def page(path: Path) -> Page:
    return Page(path)


def problem(target: Path, anchor: str) -> str:
    """What is wrong with a link to a file and an anchor in it, "" if nothing is."""
    if not target.exists():
        return "there is no such file"
    if anchor and target.suffix == ".md" and anchor not in page(target).anchors:
        return "there is no such heading"
    return ""


@pytest.mark.parametrize("path", [path for path in FILES if path.suffix == ".md"], ids=lambda path: str(path.relative_to(ROOT)))
def test_links_of_a_page_lead_somewhere(path: Path) -> None:
    wrong = []
    for link in page(path).links:
        if re.match(r"[a-z]+:", link):
            continue
        file, _, anchor = link.partition("#")
        if why := problem((path.parent / file).resolve() if file else path, anchor):
            wrong.append(f"{link}: {why}")
    assert not wrong, "\n".join(wrong)


def test_pictures_with_a_width_move_into_the_book_as_links_do() -> None:
    sys.path.insert(0, str(DOCS / "_ext"))
    from outside import moved

    text = (ROOT / "README.md").read_text(encoding="utf-8")
    pictures = re.findall(r'<img src="([^"]+)"', moved(text, "README.md", "docs/about/readme.md"))
    assert pictures and all((DOCS / "about" / picture).resolve().exists() for picture in pictures), pictures


def test_pages_that_files_name_are_there() -> None:
    wrong = []
    for path in FILES:
        # What has changed names pages as they were called then.
        if path.name == "CHANGELOG.md":
            continue
        for mention in MENTION.finditer(path.read_text(encoding="utf-8", errors="ignore")):
            file, _, anchor = mention[0].partition("#")
            if why := problem(ROOT / file, anchor):
                wrong.append(f"{path.relative_to(ROOT)}: {mention[0]}: {why}")
    assert not wrong, "\n".join(wrong)


def test_anchors_are_those_of_github() -> None:
    sample = DOCS / "index.md"
    found = Page(sample)
    found.text = "# A `code` & more\n\n## How sure am I?\n\n## How sure am I?\n"
    assert found.anchors == {"a-code--more", "how-sure-am-i", "how-sure-am-i-1"}
