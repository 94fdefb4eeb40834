"""The page on a run as a browser shows it."""

from __future__ import annotations

import shutil

import pytest

import browser
import pycav


@pytest.mark.parametrize("width", [1100, 400])
def test_the_report_is_whole_in_a_browser(width, result, tmp_path):
    seen = browser.look_at(pycav.report(result, tmp_path / "page.html"), width)
    assert seen.faults == []
    assert seen.title == "collapse-near-steel" and len(seen.images) == 5


def test_the_report_on_a_fluid_alone_is_whole_in_a_browser(root, tmp_path):
    case = pycav.Case(root / "cases/shock-tube.toml").with_({"time.snapshots": [], "time.end": 2e-5})
    seen = browser.look_at(pycav.report(pycav.run(case, tmp_path / "tube")))
    assert seen.faults == [] and seen.images


@pytest.mark.parametrize(("content", "told"), [
    ('<img alt="torn" src="data:image/png;base64,AAAA">', "image 'torn' is not shown"),
    ('<img alt="away" src="picture.png">', "image 'away' is not shown"),
    ('<link rel="stylesheet" href="https://pages.example/style.css">', "asks for https://pages.example/style.css"),
    ("<script>nothing()</script>", "nothing is not defined"),
    ('<script>console.error("of no use")</script>', "of no use"),
    ('<div style="width: 5000px">wide</div>', "wider than the window"),
], ids=["torn image", "image elsewhere", "style elsewhere", "script", "console", "width"])
def test_the_browser_tells_what_is_wrong_with_a_page(content, told, tmp_path):
    (tmp_path / "page.html").write_text(f"<!doctype html><meta charset=utf-8><title>bad</title><p>{content}")
    assert any(told in fault for fault in browser.look_at(tmp_path / "page.html").faults)


def test_a_machine_without_a_browser_fails_the_test_and_says_what_to_install(monkeypatch, tmp_path):
    monkeypatch.setattr(shutil, "which", lambda name: None)
    with pytest.raises(AssertionError, match="apt-get install chromium"):
        browser.look_at(tmp_path / "page.html")
