"""The page on a run."""

from __future__ import annotations

import base64
import io
import json
import shutil
from html.parser import HTMLParser

import h5py
import numpy as np
import pandas
import pytest
from PIL import Image

import pycav
from pycav import _report
from pycav.__main__ import main
from pycav._report import curves, frames
from pycav._report.damage import LIKE, damage
from pycav._report.health import health, jumps, mismatch
from pycav._report.numbers import key_numbers
from pycav._report.scales import about, logarithmic, power
from pycav._report.views import events
from pycav._key_numbers import wall_peak
from pycav._numbers import rounded, si


class Page(HTMLParser):
    """Tags, whether they are closed, what they refer to, the text, and the data of the scripts."""

    VOID = {"meta", "link", "img", "br", "input"}

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open, self.links, self.text, self.data = [], [], "", {}
        self.feed(text)
        assert self.open == [], "every tag is closed"

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.links += [values[key] for key in ("href", "src") if key in values]
        if tag not in self.VOID:
            self.open.append((tag, values.get("type"), values.get("id")))

    def handle_endtag(self, tag):
        assert self.open.pop()[0] == tag

    def handle_data(self, data):
        if self.open and self.open[-1][0] == "script":
            self.data |= json.loads(data) if self.open[-1][1] == "application/json" else {}
        elif self.open and self.open[-1][0] != "style":
            self.text += data + " "


def pixels(image: dict[str, object]) -> np.ndarray:
    """The steps of the palette that an image has, z upwards."""
    found = Image.open(io.BytesIO(base64.b64decode(str(image["data"]))))
    assert found.format == "PNG" and found.mode == "P"
    return np.asarray(found)


def floats(text: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), "<f8")


def test_a_report_has_everything_in_it(result, tmp_path, capsys):
    path = tmp_path / "page.html"
    assert main(["report", str(result.directory), "--out", str(path)]) == 0
    assert capsys.readouterr().out == f"{path}\n"
    page = Page(path.read_text(encoding="utf-8"))
    assert page.links and all(link.startswith("data:") for link in page.links), "nothing is fetched"
    name = wall_peak(result.summary)
    peak, time = result.summary[name], result.summary[f"{name}_time"]
    assert f"{peak * 1e-6:.4g} MPa" in page.text and "10 cells per radius" in page.text
    for words in (result.histories.attrs["git_revision"], result.histories.attrs["case_hash"], "cav 0", "collapse-near-steel", "material"):
        assert words in page.text, words
    viewer = page.data["viewer"]
    assert viewer["times"] == pytest.approx(result.fluid.times.tolist()) and viewer["of"] == 13
    assert abs(viewer["times"][viewer["first"]] - time) == pytest.approx(np.abs(result.fluid.times - time).min())
    assert [[field["name"] for field in medium["fields"]] for medium in viewer["media"]] == [["schlieren", "pressure", "gas"], ["mises", "normal"]]
    assert path.stat().st_size < 1.5e6


def test_pictures_have_the_values_of_the_cells(result):
    """Every pixel is a cell's own value to half a step of the palette, or the end of the scale: nothing is blurred."""
    viewer = frames.viewer(result)
    factors = {"pressure": ("pressure", 1e-6), "gas": ("gas_fraction", 1.0), "mises": ("von_mises", 1e-6), "normal": ("stress_zz", -1e-6)}
    for medium in viewer["media"]:
        series = result.snapshots(medium["name"])
        for field in medium["fields"]:
            if field["name"] not in factors:
                continue
            name, factor = factors[field["name"]]
            values = np.array(field["values"])
            for step in (0, 7):
                snapshot, image = series[step], field["images"][step]
                steps, (low, high, near, far) = pixels(image)[::-1].T, image["box"]  # (r, z)
                r, z = (a + (np.arange(n) + 0.5) * (b - a) / n for a, b, n in ((near, far, steps.shape[0]), (low, high, steps.shape[1])))
                points = np.stack(np.meshgrid(z, r), -1).reshape(-1, 2)
                cells = snapshot.mesh.locate(points)
                told = factor * snapshot[name][cells]
                shown = values[steps.ravel()]
                nearest = values[np.abs(values[None, :] - told[:, None]).argmin(1)]
                between = np.abs(np.searchsorted(values, shown) - np.searchsorted(values, nearest))
                assert between.max() <= 1, (field["name"], step)


def test_scales_come_back_to_the_value():
    for scale in (power(3.0, 0.6, "inferno"), logarithmic(2e6, 4.0, "gray_r"), about(50.0, -20.0, 700.0, "RdBu_r")):
        values = np.linspace(scale.low, scale.high, 37)
        back = scale.values[scale.paint(values)]
        size = np.diff(scale.values).max()
        assert np.abs(back - values).max() <= size and scale.values[0] == pytest.approx(scale.low)
        assert len(scale.ticks) >= 3 and all(0 <= place <= 1 for place, _ in scale.marks)
    # What is at rest has the middle of the palette, and as much above it is as strong as below it.
    scale = about(50.0, -20.0, 120.0, "RdBu_r")
    assert scale.colours[scale.paint(np.array([50.0]))[0]].min() > 240


def test_many_snapshots_keep_the_page_small(result, monkeypatch):
    whole = frames.viewer(result)
    size = sum(len(image["data"]) for medium in whole["media"] for field in medium["fields"] for image in field["images"])
    monkeypatch.setattr(frames, "BUDGET", size * 3 // 4 // 4)
    monkeypatch.setattr(frames, "LEAST", 16)
    monkeypatch.setattr(frames, "FRAMES", 5)
    less = frames.viewer(result)
    assert len(less["times"]) == 5 and less["of"] == 13 and less["times"][-1] == whole["times"][-1]
    left = sum(len(image["data"]) for medium in less["media"] for field in medium["fields"] for image in field["images"])
    assert left * 3 // 4 <= frames.BUDGET


def test_curves_are_those_of_the_histories(result):
    told = curves.packed(curves.charts(result))
    data = result.histories
    names = [curve["name"] for chart in told["charts"] for curve in chart["curves"]]
    assert names[:4] == ["bubble/equivalent_radius", "wall/pressure_axis", "interface/pressure_mean", "wall/pressure_max"]
    assert {"bubble/jet_velocity", "interface/impulse", "solid/von_mises_max"} <= set(names)
    for chart in told["charts"]:
        for curve in chart["curves"]:
            if curve["name"] in data and data[curve["name"]].ndim == 1:
                assert np.array_equal(floats(curve["data"]), data[curve["name"]].to_numpy(), equal_nan=True)
                assert np.array_equal(floats(told["clocks"][curve["clock"]]["data"]), data[data[curve["name"]].dims[0]].to_numpy())
    mean = next(floats(curve["data"]) for chart in told["charts"] for curve in chart["curves"] if curve["name"] == "interface/pressure_mean")
    assert np.nanmax(mean) == pytest.approx(result.summary["wall_pressure_mean_peak"], rel=5e-3)


def test_of_too_many_rows_the_extremes_stay(result, monkeypatch):
    chart = curves.charts(result)[1]
    clock, values = chart.curves[0].clock, chart.curves[0].values
    kept = curves._kept(clock, [chart.curves[0]], 60)
    assert len(kept) <= 62 < len(values) and {0, len(values) - 1, int(values.argmax()), int(values.argmin())} <= set(kept.tolist())
    assert curves._kept(clock, chart.curves) == slice(None)


def test_curves_are_written_as_csv_with_all_digits(result, tmp_path):
    pycav.report(result, tmp_path / "page.html", csv=tmp_path / "curves")
    table = pandas.DataFrame(np.genfromtxt(tmp_path / "curves" / "steps.csv", delimiter=",", names=None, skip_header=1))
    table.columns = (tmp_path / "curves" / "steps.csv").read_text().partition("\n")[0].split(",")
    assert list(table.columns[:2]) == ["t / s", "bubble/equivalent_radius / m"]
    for column in table.columns:
        name = column.partition(" / ")[0]
        if name != "t" and name in result.histories:
            assert np.array_equal(table[column].to_numpy(), result.histories[name].to_numpy(), equal_nan=True), name
    assert {path.name for path in (tmp_path / "curves").iterdir()} >= {"steps.csv", "wall.csv", "solid-steps.csv"}


def test_a_report_opens_with_the_answer(result, tmp_path):
    run = shutil.copytree(result.directory, tmp_path / "run")
    summary = json.loads((run / "summary.json").read_text())
    assert 'id="answer"' not in _report.page(pycav.open(run)) or "answer" in summary
    (run / "summary.json").write_text(json.dumps(summary | {"answer": ["The wall bears 1 < 2.", "</script><b>Nothing</b> yields."],
                                                           "look_next": "Look next: pycav report makes a page of it."}))
    text = _report.page(pycav.open(run))
    page = Page(text)
    assert page.text.index("The wall bears 1 < 2.") < page.text.index("</script><b>Nothing</b> yields.") < page.text.index("Key numbers")
    assert "<b>Nothing" not in text
    assert "makes a page of it" not in page.text, "it is here"


def test_a_report_tells_how_far_the_run_can_be_trusted(result, tmp_path):
    told = {verdict.says: verdict for verdict in health(result)}
    for says in ("The fluid's mass and energy are conserved.", "Impulse and work that leave the fluid arrive in the solid."):
        assert told[says].good and "10⁻" in told[says].number, says
    unknown = "No finer grid has been computed: how far the peaks are from converged is not known."
    assert not told[unknown].good
    text = Page(_report.page(result)).text
    assert all(says in text for says in told) and "share" not in text.split("Where it is from")[1]
    # A run that lost a tenth of a percent of its mass is not called conservative.
    run = shutil.copytree(result.directory, tmp_path / "run")
    with h5py.File(run / "fluid.h5", "r+") as file:
        file["conservation/fluid/mass"][-1] *= 0.999
    told = {verdict.says: verdict for verdict in health(pycav.open(run))}
    assert not told["The fluid's mass and energy are not conserved."].good


VESSEL = {
    "z": [0.0, 0.05], "r": [0.0, 0.05], "cells": [8, 8], "levels": 2, "liquid": {"fluid": "water-tait"}, "gas": {"fluid": "air"},
    "ambient": {"density": 998.0, "pressure": 5e7},
}
CUT = {"bubble": {"centre": [0.025, 0.0], "radius": 4e-3, "equilibrium_radius": 8e-3, "cells_per_radius": 4,
                  "reset": {"equilibrium_radius": 4e-3}}}
SPHERE = {"shape": "sphere", "centre": [0.025, 0.0], "radius": 0.01, "phase": "gas", "density": 5.0, "pressure": 1e6}
BOILS = {"liquid": {"fluid": "water-nasg"}, "gas": {"fluid": "water-vapour"}, "region": [SPHERE],
         "terms": {"phase_change": {"law": "ptg", "vapour_fraction": 0.8}, "surface_tension": 1e4}}


@pytest.mark.parametrize(("fluid", "end", "ledgers"), [
    (CUT, 8e-5, ["energy_from_reset"]), (BOILS, 3e-5, ["energy_from_phase_change", "tension_work"]),
    ({"region": [SPHERE], "gravity": -1e6}, 1e-5, [])], ids=["cut", "boils", "weighs"])
def test_what_the_ledgers_tell_is_no_loss(fluid, end, ledgers, tmp_path):
    case = pycav.Case.from_dict({"time": {"end": end}, "fluid": VESSEL | fluid, "coupling": {"scheme": "rigid"}})
    run = pycav.run(case, tmp_path / "run")
    data = {name: run.histories[f"conservation/fluid/{name}"].to_numpy() for name in ["energy", *ledgers]}
    for name in ledgers:  # each alone is far more than rounding
        assert abs(data[name][-1]) > 1e-7 * data["energy"][0], name
    (told,) = [verdict for verdict in health(run) if "conserved" in verdict.says]
    assert told.good, told
    # The work of the weight is in no ledger: of the energy nothing is said then.
    assert told.says.startswith("The fluid's mass is" if "gravity" in fluid else "The fluid's mass and energy are")
    assert ("weight" in told.note) == ("gravity" in fluid)


def test_numbers_have_units_of_an_engineer(result):
    found = {number.label: number for number in key_numbers(result)}
    name = wall_peak(result.summary)
    assert found["Wall pressure on the axis, largest"].value == f"{1e-6 * result.summary[name]:.4g} MPa"
    assert found["Wall pressure on the axis, largest"].note == f"at {si(result.summary[f'{name}_time'], 's')}"
    assert all(number.around == "" for number in found.values()) and 0 < LIKE < 1


def with_summary(result, place, **changes):
    """A run whose summary says something else."""
    run = shutil.copytree(result.directory, place)
    summary = json.loads((run / "summary.json").read_text())
    (run / "summary.json").write_text(json.dumps(summary | changes))
    return pycav.open(run)


@pytest.mark.parametrize(("face", "value", "time"), [(250.9e6, "250.9 MPa", 4e-5), (240e6, "240.5 MPa", 5e-5)])
def test_the_largest_wall_pressure_is_that_of_cell_or_face(face, value, time, result, tmp_path):
    peaks = {"wall_pressure_peak": 240.5e6, "wall_pressure_peak_time": 5e-5, "wall_pressure_peak_anywhere": 241e6,
             "wall_pressure_peak_interface": face, "wall_pressure_peak_interface_time": 4e-5, "wall_pressure_mean_peak": 239e6}
    run = with_summary(result, tmp_path / "run", **peaks)
    found = {number.label: number for number in key_numbers(run)}
    assert (told := found["Wall pressure on the axis, largest"]).value == value and told.note == f"at {si(time, 's')}"
    # No larger one is said to be anywhere than where it is.
    assert ("Wall pressure anywhere, largest" in found) == (face < 241e6)
    assert events(run)[0] == (time, "largest wall pressure")


def test_the_smallest_radius_is_a_share_of_the_one_it_collapses_from(result, tmp_path):
    def note(run):
        return next(number.note for number in key_numbers(run) if number.label == "Smallest equivalent radius")

    smallest = result.summary["min_equivalent_radius"]
    assert result.summary["growth_time"] is None and note(result).endswith(f"{smallest / 0.01:.3g} of the first radius")
    # A laser bubble is smallest with more than it had at the start.
    grown = with_summary(result, tmp_path / "run", growth_time=1e-5, max_equivalent_radius=0.5, min_equivalent_radius=0.0257)
    assert note(grown).endswith("0.0514 of the largest radius")


@pytest.mark.parametrize(("cells", "good"), [(3.12, False), (16.0, True), (None, None)])
def test_a_report_counts_cells_where_the_bubble_is_smallest_as_the_answer_does(cells, good, result, tmp_path):
    """By the sphere's radius it was less for a bubble that a wall cuts, less on a grid that follows it, and all gas of several bubbles."""
    run = with_summary(result, tmp_path / "run", cells_per_smallest_radius=cells)
    told = [(verdict.good, verdict.number) for verdict in health(run) if "when it is smallest" in verdict.says]
    assert told == ([] if cells is None else [(good, f"{cells:.3g} cells")])


@pytest.mark.parametrize(("still", "good", "says"), [
    (0.005, True, "is at rest at the end: the pit is what stays"), (0.05, True, "is nearly at rest at the end: the pit is what stays"),
    (0.2, False, "still moves at the end: the pit is not yet what stays")])
def test_a_report_takes_the_answers_word_on_whether_a_pit_stays(still, good, says, result, tmp_path):
    """The answer tells of a pit that stays up to a tenth (`ALMOST_STILL`)."""
    run = with_summary(result, tmp_path / "run", surface_still=still, pit_depth=1e-5, plastic_strain_peak=0.1)
    assert [(verdict.good, says in verdict.says) for verdict in health(run) if "surface" in verdict.says] == [(good, True)]


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
    rows = mismatch(result)
    for name, pair in (("velocity", velocity), ("pressure", pressure)):
        worst = np.sqrt(((pair[..., 0] - pair[..., 1])**2 * r / r.sum()).sum(1)).max()
        assert max(rows[name]) == pytest.approx(worst)
    step = int(np.argmax(rows["pressure"]))
    # On 10 cells per radius.
    assert 0 < rows["pressure_share"][step] < 0.1
    says = [verdict for verdict in health(result) if "the pressure at the wall" in verdict.says]
    assert len(says) == 1 and f"ε_d = {rounded(rows['pressure'][step], 'Pa')}" in says[0].note


def at_rest(**time):
    """Liquid at rest on steel: what changes is round-off."""
    return pycav.Case.from_dict({
        "time": {"end": 1e-5} | time,
        "fluid": {key: VESSEL[key] for key in ("z", "r", "cells", "levels", "liquid", "gas", "ambient")},
        "solid": {"z": [-0.05, 0.0], "r": [0.0, 0.05], "cells": [8, 8], "levels": 2, "material": "structural-steel"}})


def test_round_off_at_the_wall_is_no_change_of_pressure(tmp_path):
    run = pycav.run(at_rest(snapshots=[5e-6]), tmp_path / "run")
    _, _, pressure = jumps(run)
    assert np.abs(pressure - 5e7).max() < 5.0 and len(pressure) == 3
    assert mismatch(run)["pressure_share"] == [0.0] * 3
    assert not [verdict for verdict in health(run) if "at the wall" in verdict.says]


def test_a_single_row_measures_nothing(tmp_path):
    run = pycav.run(at_rest().with_({"output.interface_every": 1.0}), tmp_path / "run")
    assert len(run.histories["conservation/fluid/mass"]) == len(run.histories["interface/time"]) == 1
    verdicts = {verdict.says: verdict for verdict in health(run)}
    assert not [says for says in verdicts if "conserved" in says or "arrive" in says]
    assert not next(verdict for says, verdict in verdicts.items() if "single row" in says).good
    assert not [what for what, _, _ in damage(run) if "impulse" in what]


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


def test_helps_and_completions_know_the_program_and_its_own_commands(capfd, tmp_path):
    assert main(["--help"]) == 0
    said = capfd.readouterr().out
    assert "Usage: pycav" in said and "\n  report " in said and "pycav run cases/collapse.toml" in said
    assert main(["keys", "fluid.epsilon"]) == 0
    assert capfd.readouterr().out.startswith("fluid.epsilon\n")
    assert main(["completions", "bash"]) == 0
    script = capfd.readouterr().out
    assert "complete -F _pycav" in script and "report" in script
    assert main(["man", str(tmp_path)]) == 0
    assert (tmp_path / "pycav-run.1").is_file()
