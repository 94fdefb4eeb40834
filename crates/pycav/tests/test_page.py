"""The page on a run as a browser shows it."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

import browser
import pycav

SHOWN = "[...document.querySelectorAll('.stage canvas')].map(c => c.dataset.shown)"
PIXELS = "[...document.querySelectorAll('.stage canvas')].map(c => c.toDataURL()).join()"
TIME = "document.querySelector('.clock output').textContent"
READ = "[...document.querySelectorAll('.chart')][1].querySelector('.value')"
SPAN = "[spans.t.low, spans.t.high]"


@pytest.fixture(scope="module")
def page(result, tmp_path_factory) -> Path:
    return pycav.report(result, tmp_path_factory.mktemp("page") / "page.html")


@pytest.mark.parametrize(("width", "dark"), [(1280, False), (360, False), (1280, True)])
def test_the_report_is_whole_in_a_browser(width, dark, page):
    with browser.opened(page, width, dark=dark) as tab:
        tab.value("document.querySelectorAll('details').forEach(d => { d.open = true; })")
        seen = tab.seen()
        assert seen.faults == [] and seen.title == "collapse-near-steel"
        ground = [int(part) for part in tab.value("getComputedStyle(document.body).backgroundColor.match(/[0-9]+/g).join()").split(",")]
        ink = [int(part) for part in tab.value("getComputedStyle(document.body).color.match(/[0-9]+/g).join()").split(",")]
        assert max(ground) < 50 < 200 < min(ink) if dark else min(ground) > 240 and max(ink) < 60
        filters = tab.value("[...document.querySelectorAll('.stage canvas')].map(c => getComputedStyle(c).filter)")
        assert ("invert" in filters[0]) is dark and filters[1] == "none"
        # Nothing reaches out of the window.
        wide = tab.value("[...document.body.querySelectorAll('*')].filter(e => e.getBoundingClientRect().right > innerWidth + 1).length")
        assert wide == 0
        tab.as_printed(dark)
        assert tab.value("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
        assert tab.value("getComputedStyle(document.querySelector('.stage canvas')).filter") == "none"
        assert tab.value("getComputedStyle(document.querySelector('.clock input')).display") == "none"
        assert tab.seen().faults == []


def test_the_report_on_a_fluid_alone_is_whole_in_a_browser(root, tmp_path):
    case = pycav.Case(root / "cases/shock-tube.toml").with_({"time.snapshots": [], "time.end": 2e-5})
    assert browser.look_at(pycav.report(pycav.run(case, tmp_path / "tube"))).faults == []


def test_the_slider_goes_through_all_snapshots(page, result):
    times = result.fluid.times
    with browser.opened(page) as tab:
        def shows(step: int) -> None:
            tab.until(f"{SHOWN}.every(shown => shown?.endsWith(' {step}'))")
            told = tab.value(TIME)
            assert f"t = {1e6 * times[step]:.4g} µs" in told and f"{step + 1} of {len(times)}" in told
            assert tab.value("document.querySelector('.clock input').getAttribute('aria-valuetext')").startswith(f"{1e6 * times[step]:.4g} µs")

        first = tab.value("viewer.step")
        shows(first)
        tab.value("document.querySelector('.clock input').focus()")
        pictures = {first: tab.value(PIXELS)}
        for key, step in (("ArrowLeft", first - 1), ("ArrowLeft", first - 2), ("ArrowRight", first - 1), ("End", len(times) - 1), ("Home", 0)):
            tab.press(key)
            shows(step)
            pictures[step] = tab.value(PIXELS)
        assert len(set(pictures.values())) == len(pictures) == 5
        # By pointer: half way.
        place = tab.place(".clock input")
        tab.click(place["x"] + place["width"] / 2, place["y"] + place["height"] / 2)
        shows((len(times) - 1) // 2)
        # The charts' line goes with it, and so do the values in the legends.
        assert tab.value("spans.t.moment") == times[(len(times) - 1) // 2]
        tab.value("document.querySelector('.play').click()")
        tab.until(f"viewer.step > {(len(times) - 1) // 2}")
        tab.value("document.querySelector('.play').click()")
        assert tab.seen().faults == []


def test_pictures_are_mirrored_at_the_axis_and_tell_their_values(page, result):
    with browser.opened(page) as tab:
        tab.until(f"{SHOWN}.every(Boolean)")
        # To the pixel, but for the one on the axis.
        uneven = tab.value("""[...document.querySelectorAll('.stage canvas')].map(c => {
            const n = c.width, axis = Math.round(viewer.media[0].toX(0)), half = Math.min(axis, n - axis) - 1;
            const d = c.getContext('2d').getImageData(0, 0, n, c.height).data; let off = 0;
            for (let y = 0; y < c.height; y++) for (let x = 0; x < half; x++) for (let k = 0; k < 3; k++)
                off += d[4 * (y * n + axis + x) + k] !== d[4 * (y * n + axis - 1 - x) + k];
            return off / (half * c.height); })""")
        assert max(uneven) == 0.0
        outline = tab.value("document.querySelector('.outline.bubble').getAttribute('d')")
        assert outline.startswith("M")
        before = tab.value(PIXELS)
        place = tab.place("input[value=pressure] + span")
        tab.click(place["x"] + 5, place["y"] + 5)
        tab.until(f"{SHOWN}[0].startsWith('pressure')")
        assert tab.value(PIXELS) != before and "MPa" in tab.value("document.querySelector('.unit').textContent")
        # Under the pointer: the pressure of the cell there.
        z, r = 0.0217, 0.0081
        x, y = (tab.value(f"viewer.{name}({value})") for name, value in (("x", -r), ("y", z)))
        stage = tab.place(".stage")
        tab.point("mouseMoved", stage["x"] + x, stage["y"] + y)
        tab.until("document.querySelector('.readout').textContent.includes('≈')")
        told = tab.value("document.querySelector('.readout').textContent")
        snapshot = result.fluid[tab.value("viewer.step")]
        value = 1e-6 * snapshot["pressure"][snapshot.mesh.locate(np.array([[z, r]]))[0]]
        assert float(told.split("≈")[1].split()[0].replace("−", "-")) == pytest.approx(value, rel=0.06)
        assert tab.seen().faults == []


def test_curves_tell_recorded_values_and_zoom(page, result):
    data = result.histories
    values, times = data["wall/pressure_axis"].to_numpy(), data["time"].to_numpy()
    with browser.opened(page) as tab:
        place = tab.place(".chart:nth-of-type(2) svg")
        y = place["y"] + 60

        def at(time: float) -> float:
            return float(place["x"] + tab.value(f"charts[1].x({time})") * place["width"] / tab.value("charts[1].width"))

        tab.point("mouseMoved", at(float(times[values.argmax()])), y)
        told, value, time = (tab.value(f"{READ}.{name}") for name in ("textContent", "dataset.value", "dataset.place"))
        # The peak itself, though hundreds of steps share the pixels.
        assert float(value) == values.max() and float(time) == times[values.argmax()]
        assert told == f"{1e-6 * values.max():.4g} MPa" or told.split()[0] == f"{float(f'{1e-6 * values.max():.4g}'):g}"
        for moment in (1.13e-5, 3.07e-5):
            tab.point("mouseMoved", at(moment), y)
            value, time = (float(tab.value(f"{READ}.dataset.{name}")) for name in ("value", "place"))
            row = int(np.flatnonzero(times == time)[0])
            assert values[row] == value and abs(time - moment) < 3e-7
            assert f"t = {1e6 * time:.4g}"[:8] in tab.value("charts[1].when.textContent")
        # On 30 columns of pixels, each of many steps, the line has both ends of each, and the pointer the largest value.
        low, high = tab.value(SPAN)
        assert len(times) > 200
        path = tab.value(f"charts[1].curves[0].path({low}, {high}, t => 30 * (t - {low}) / ({high - low}), v => -v)")
        drawn = np.array([[float(part) for part in point.split(" ")] for point in path[1:].split("L")])
        assert len(drawn) <= 4 * 31 and -drawn[:, 1].min() == pytest.approx(values.max(), abs=0.01)
        assert -drawn[:, 1].max() == pytest.approx(values.min(), abs=0.01)
        peak = float(times[values.argmax()])
        assert tab.value(f"charts[1].curves[0].row({peak + 8e-7}, 1e-6)") == values.argmax()
        whole = tab.value(SPAN)
        tab.drag(at(2e-5), y, at(4e-5))
        tab.until(f"{SPAN}[0] > 1e-6")
        assert tab.value(SPAN) == pytest.approx([2e-5, 4e-5], abs=2e-7)
        tab.until("!charts[1].reset.hidden")
        tab.click(place["x"] + 200, y, times=2)
        tab.until(f"{SPAN}[1] === {whole[1]}")
        tab.until("performance.now() - scrolled > 400")
        tab.point("mouseWheel", place["x"] + 200, y, deltaX=0, deltaY=-300)
        tab.until(f"{SPAN}[1] - {SPAN}[0] < {0.8 * (whole[1] - whole[0])}")
        # By keyboard: all again, along the rows, in.
        tab.value("charts[1].svg.focus()")
        tab.press("Escape")
        tab.until(f"{SPAN}[0] === {whole[0]} && {SPAN}[1] === {whole[1]}")
        tab.press("Home")
        tab.press("ArrowRight")
        tab.press("ArrowRight")
        assert float(tab.value(f"{READ}.dataset.place")) == times[2] and float(tab.value(f"{READ}.dataset.value")) == values[2]
        assert "on the axis" in tab.value("document.getElementById('told').textContent")
        tab.press("+")
        tab.until(f"{SPAN}[1] - {SPAN}[0] < {0.6 * (whole[1] - whole[0])}")
        # Off and on by the legend.
        lines = "charts[1].svg.querySelectorAll('path').length"
        count = tab.value(lines)
        tab.value("charts[1].figure.querySelector('.legend button').click()")
        assert tab.value(lines) == count - 1
        assert tab.value("charts[1].figure.querySelector('.legend button').getAttribute('aria-pressed')") == "false"
        assert tab.seen().faults == []


def test_curves_are_saved_as_csv_with_all_digits(page, result, tmp_path):
    with browser.opened(page, downloads=tmp_path) as tab:
        tab.value("document.querySelector('#data details').open = true")
        for name in ("wall-pressure_axis", "solid-von_mises_max", "steps"):
            tab.value(f"document.querySelector('[data-file=\"{name}\"]').click()")
            path = tmp_path / f"collapse-near-steel-{name}.csv"
            for _ in range(200):
                if path.exists():
                    break
                tab.value("new Promise(done => setTimeout(() => done('waited'), 50))")
            head, *rows = path.read_text(encoding="utf-8").splitlines()
            columns = np.array([[float(value or "nan") for value in row.split(",")] for row in rows]).T
            names = [column.split(" / ")[0] for column in head.split(",")]
            data = result.histories
            assert names[0] == "t" and head.split(",")[0] == "t / s" and len(names) == len(columns)
            for column, values in zip(names[1:], columns[1:]):
                assert np.array_equal(values, data[column].to_numpy(), equal_nan=True), column
                assert np.array_equal(columns[0], data[str(data[column].dims[0])].to_numpy())
                assert f"{column} / {data[column].attrs['units']}" in head
        assert tab.seen().faults == []


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
