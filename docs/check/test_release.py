"""The notes of a release are the changelog's section of its version: .ci/notes."""

import subprocess
from pathlib import Path

from pages import ROOT


def notes(version: str, changelog: Path) -> "subprocess.CompletedProcess[str]":
    return subprocess.run([ROOT / ".ci/notes", version, changelog], text=True, capture_output=True, check=False)


def test_the_notes_of_a_release_are_its_section_to_the_last_line(tmp_path: Path) -> None:
    changelog = tmp_path / "CHANGELOG.md"
    changelog.write_text("# Changes\n\n## Unreleased\n\n## 0.2.0\n\nnew\n\n## 0.1.0 (2026-01-01)\n\n### Added\n\nfirst\nlast\n")
    assert notes("0.1.0", changelog).stdout.split() == ["###", "Added", "first", "last"]
    assert notes("0.2.0", changelog).stdout.split() == ["new"]
    for missing in ("0.1", "0.3.0", "Unreleased"):
        assert notes(missing, changelog).returncode == 1 and "has no section" in notes(missing, changelog).stderr
