"""The page on a run."""

from __future__ import annotations

import base64
import io
from html.parser import HTMLParser

import numpy as np
import pytest
from PIL import Image

import pycav
from pycav.__main__ import main
from pycav._health import health, jumps
from pycav.plot.style import si
from pycav._report import _timings


class Page(HTMLParser):
    """Tags, whether they are closed, what they refer to, and the text."""

    VOID = {"meta", "link", "img", "br"}

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open, self.links, self.images, self.text = [], [], [], ""
        self.feed(text)
        assert self.open == [], "every tag is closed"

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.links += [values[key] for key in ("href", "src") if key in values]
        if tag == "img":
            self.images.append(values)
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text += data + " "


def test_a_report_has_everything_in_it(result, tmp_path, capsys):
    path = tmp_path / "page.html"
    assert main(["report", str(result.directory), "--out", str(path)]) == 0
    assert str(path) in capsys.readouterr().out
    page = Page(path.read_text(encoding="utf-8"))
    assert page.links and all(link.startswith("data:") for link in page.links), "nothing is fetched"
    assert "<script" not in path.read_text(encoding="utf-8")
    names = [image["alt"] for image in page.images]
    assert names == ["Histories", "Numerical schlieren", "Normal velocity and normal stress", "Yield function",
                     "Pressure on the wall over time"]
    for image in page.images:
        kind, data = image["src"].split(",", 1)
        assert kind == "data:image/png;base64"
        pixels = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))).convert("RGB"))
        assert min(pixels.shape[:2]) > 200 and (pixels != 255).any(2).mean() > 0.03
    peak = result.summary["wall_pressure_peak"]
    assert f"{peak * 1e-6:.4g} MPa" in page.text and "10 cells per radius" in page.text
    assert f"revision {result.histories.attrs['git_revision']}" in page.text
    assert "collapse-near-steel" in page.text and 'material' in page.text


def test_a_report_tells_the_conservation_of_the_run(result):
    rows = {what: value for what, value, _ in health(result)}
    for what in ("fluid's mass, balance", "fluid's energy, balance", "impulse given and got at the interface",
                 "work given and got at the interface"):
        assert float(rows[what].replace("−", "-")) < 1e-12, what
    assert "fluid: computing" in dict((what, value) for what, value, _ in _timings(result))


def test_a_report_tells_what_jumps_at_the_interface(result):
    """Each side's own state at the wall is near the common one of the histories, and nearer to the other side's."""
    r, velocity, pressure = jumps(result)
    data = result.histories
    assert np.allclose(r, data["interface/r"]) and velocity.shape == pressure.shape == (13, len(r), 2)
    assert np.abs(pressure[0] - 5e7).max() < 1.0 and np.abs(velocity[0]).max() == 0.0
    for step in (6, 9, 12):
        there = data.sel({"interface/time": result.fluid.times[step]}, method="nearest")
        common, moves = there["interface/pressure"].to_numpy(), there["interface/normal_velocity"].to_numpy()
        assert np.abs(pressure[step].mean(-1) - common).max() < 0.15 * np.ptp(common)
        assert np.abs(velocity[step].mean(-1) - moves).max() < 0.3 * np.ptp(moves)
    rows = {what: (value, note) for what, value, note in health(result)}
    for name, pair in (("ε_k, v_z of the fluid less that of the solid", velocity), ("ε_d, p + σ_zz", pressure)):
        worst = np.sqrt(((pair[..., 0] - pair[..., 1])**2 * r / r.sum()).sum(1)).max()
        value, note = rows[name]
        assert value == si(float(worst), "m/s" if "v_z" in name else "Pa") and "rms over the wall at" in note
        # On 10 cells per radius; the wall's own velocity is small beside that of the liquid half a cell off.
        assert float(note.split(",")[1].split("%")[0]) < (80 if "v_z" in name else 10)


def test_a_report_on_a_run_that_was_stopped_says_so(small, tmp_path):
    with pycav.Simulation(small, out=tmp_path / "run") as simulation:
        simulation.advance_to(2e-5)
    page = Page(pycav.report(tmp_path / "run").read_text())
    assert "Not completed" in page.text and (tmp_path / "run" / "report.html").exists()


def test_a_report_on_nothing_is_refused(tmp_path, capsys):
    assert main(["report", str(tmp_path)]) == 2
    assert "no run directory" in capsys.readouterr().err


@pytest.mark.parametrize(("value", "unit", "shown"), [
    (2.483e8, "Pa", "248.3 MPa"), (5.073e-5, "s", "50.73 µs"), (3.8e-6, "m³", "3800 mm³"), (0.0, "m³", "0 m³"), (1.1e-16, "m³", "110 µm³"), (3.5e-10, "m³", "0.35 mm³"), (2.41e-7, "m²", "0.241 mm²"), (5.62, "J", "5.62 J"),
    (None, "Pa", "–"),
    (-1.5e5, "Pa", "−150 kPa"), (257.35, "m/s", "257.4 m/s"), (0.0, "Pa", "0 Pa"),
])
def test_numbers_in_si(value, unit, shown):
    assert si(value, unit) == shown


def test_the_command_line_is_that_of_cav(cav, capfd):
    assert main(["materials"]) == 0
    assert capfd.readouterr().out == cav("materials").stdout
    assert main(["run", "nowhere.toml"]) == 2
    assert "cannot read the case file" in capfd.readouterr().err
    assert main(["nonsense"]) == 2
