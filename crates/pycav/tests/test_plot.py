"""Pictures: that they show what they say, not how it looks."""

from __future__ import annotations

import json
import re
import warnings

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

import pycav
from pycav._numbers import prefix
from pycav.plot.overtime import _image, _panel

WINDOW = (-0.04, 0.04, 0.03)


def texts(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.findobj(mpl.text.Text))


def save(figure: Figure, path) -> np.ndarray:
    figure.savefig(path, dpi=80)
    pixels = np.asarray(Image.open(path).convert("RGB"))
    assert (pixels != 255).any(2).mean() > 0.05, "something is drawn"
    return pixels


def images(figure: Figure):
    return [image for axes in figure.axes for image in axes.images]


@pytest.mark.parametrize("kind", ["schlieren", "streamlines", "interface_continuity", "grid_levels"])
def test_sections_show_both_media_mirrored(kind, result, tmp_path):
    figure = getattr(pycav.plot, kind)(result, window=WINDOW, **({} if kind == "grid_levels" else {"levels": True}))
    save(figure, tmp_path / "a.png")
    assert "solid" in texts(figure) and "fluid" in texts(figure) and "µs" in texts(figure)
    shown = images(figure)
    assert len(shown) == (4 if kind == "interface_continuity" else 2)
    for image in shown:
        values = np.ma.getdata(image.get_array())
        assert np.array_equal(values, values[::-1], equal_nan=True), "mirrored about the axis"
    low = min(image.get_extent()[0] for image in shown)
    high = max(image.get_extent()[1] for image in shown)
    assert low == pytest.approx(-0.04, abs=0.004) and high == pytest.approx(0.04, abs=0.004)


OUTLINED = {
    "schlieren": {}, "streamlines": {}, "interface_continuity": {}, "yield_function": {"yield_strength": 95e6},
    "pathlines": {"spacing": 2e-2, "substeps": 1},
}


@pytest.mark.filterwarnings("ignore:pathlines in the")
@pytest.mark.parametrize("kind", OUTLINED)
def test_outlines_of_the_levels_are_drawn_when_they_are_asked_for(kind, result):
    draw = getattr(pycav.plot, kind)

    def grey_lines(**more):
        window = (-0.128, 0.0 if kind == "yield_function" else 0.128, 0.128)
        figure = draw(result, window=window, **OUTLINED[kind], **more)
        return [lines for lines in figure.findobj(mpl.contour.ContourSet)
                if np.allclose(lines.get_edgecolor()[:1], mpl.colors.to_rgba("0.35"))]

    assert not grey_lines() and grey_lines(levels=True)


def test_schlieren_of_the_start_show_the_bubble_alone(result):
    figure = pycav.plot.schlieren(result, time=0.0, window=(0.0, 0.04, 0.03))
    (image,) = images(figure)
    values, (z0, z1, r0, r1) = image.get_array(), image.get_extent()
    r, z = np.meshgrid(np.linspace(r0, r1, values.shape[0]), np.linspace(z0, z1, values.shape[1]), indexing="ij")
    off = np.abs(np.hypot(z - 0.02, r) - 0.01)
    assert values[off < 1e-3].max() > 1e4 and values[off > 4e-3].max() == 0


def test_the_yield_function_is_the_stress_less_the_strength(result):
    strengths = [70e6, 95e6, 250e6, 502e6]
    figure = pycav.plot.yield_function(result, strengths, 50e-6, names=["a", "b", "c", "d"])
    stress = result.solid.at(50e-6)["von_mises"]
    shown = images(figure)
    assert len(shown) == 4
    for image, strength in zip(shown, strengths):
        assert 1e6 * np.nanmax(image.get_array()) == pytest.approx(stress.max() - strength)
        assert image.norm.vcenter == 0
    assert len({id(image.norm) for image in shown}) == 1
    own = images(pycav.plot.yield_function(result, strengths, 50e-6, one_scale=False))
    assert [image.norm.vmin for image in own] == [pytest.approx(-1e-6 * strength) for strength in strengths]
    with pytest.raises(ValueError, match="no solid"):
        pycav.plot.yield_function(_rigid(result), 1e6)


def _rigid(result):
    case = result.case.with_({"coupling.scheme": "rigid", "time.end": 1e-6, "time.snapshots": []})
    return pycav.run(case, result.directory.with_name("rigid"), force=True)


def test_the_yield_strength_drawn_is_the_runs_own(result, small, tmp_path):
    """It was 95, 250 and 502 MPa for every wall."""
    def strengths(run):
        return re.findall(r"Y_0\$ = ([0-9.]+) MPa", texts(pycav.plot.yield_function(run)))

    assert result.summary["yield_strength"] == 250e6 and strengths(result) == ["250"]
    without = {"solid.material": "tungsten-carbide", "time.end": 1e-6, "time.snapshots": []}
    assert strengths(pycav.run(small.with_(without), tmp_path / "run")) == ["95", "250", "502"]


def test_a_consistent_run_stands_beside(result):
    """Aluminium's own run has other stresses than its yield strength on steel's, and its own strength."""
    case = result.case.with_({"solid.material": "aluminium"})
    own = pycav.run(case, result.directory.with_name("aluminium"), force=True)
    figure = pycav.plot.yield_function(result, [95e6], 50e-6, names=["on steel"], beside=[own])
    steel, aluminium = images(figure)
    strength = own.summary["yield_strength"]
    stress = own.solid.at(50e-6)["von_mises"]
    assert 1e6 * np.nanmax(aluminium.get_array()) == pytest.approx(stress.max() - strength)
    assert np.nanmax(np.abs(aluminium.get_array() + strength * 1e-6 - steel.get_array() - 95.0)) > 1.0
    assert f"aluminium, own run, $Y_0$ = {strength * 1e-6:g} MPa" in texts(figure)
    plain = pycav.run(case.with_({"solid.material": {"density": 2700.0, "c1": 6300.0, "c2": 3100.0}, "time.end": 1e-6,
                                  "time.snapshots": []}), result.directory.with_name("plain"), force=True)
    with pytest.raises(ValueError, match="no yield strength"):
        pycav.plot.yield_function(result, 95e6, beside=[plain])


def test_consistent_runs_are_made_once_and_stand_beside(small, tmp_path):
    case = small.with_({"time.end": 3e-5, "time.snapshots": [2e-5]})
    elastic = pycav.run(case, tmp_path / "elastic", threads=1)
    materials = ["aluminium", 502e6, {"name": "acrylic", "density": 1180.0, "young": 5.3e9, "poisson": 0.35, "yield_strength": 80e6}]
    made = pycav.consistent_runs(case, materials, tmp_path / "own", threads=1)
    assert [run.parameters["solid"]["material"]["name"] for run in made] == ["aluminium", "stainless-steel", "acrylic"]
    figure = pycav.plot.yield_function(elastic, [95e6, 502e6, 80e6], 2e-5, beside=made)
    shown = [1e6 * np.nanmax(image.get_array()) for image in images(figure)]
    assert len(shown) == 6
    for own, strength, panel in zip(made, [95e6, 502e6, 80e6], shown[3:]):
        assert panel == pytest.approx(own.solid.at(2e-5)["von_mises"].max() - strength)
    assert abs(shown[3] - shown[0]) > 1e5, "aluminium answers otherwise than steel"
    assert shown[4] == pytest.approx(shown[1]), "both steels have the same elasticity"

    stamps = [(run.directory / "summary.json").stat().st_mtime_ns for run in made]
    again = pycav.consistent_runs(case, materials, tmp_path / "own", threads=1)
    assert [(run.directory / "summary.json").stat().st_mtime_ns for run in again] == stamps, "complete ones are kept"
    with pytest.raises(pycav.RunError, match="cheese"):
        pycav.consistent_runs(case, ["aluminium", "cheese"], tmp_path / "own")
    for strength, told in ((1e6, "no material .* 1 MPa"), (70e6, "more than one material .* copper 70 MPa")):
        with pytest.raises(ValueError, match=told):
            pycav.consistent_runs(case, [strength], tmp_path / "own")


def test_a_tube_and_a_solid_alone_can_be_drawn(root, tmp_path):
    tube = pycav.run(pycav.Case(root / "cases/shock-tube.toml").with_(
        {"time.snapshots": [], "time.end": 2e-5}), tmp_path / "tube")
    assert len(pycav.plot.histories(tube).axes) == 1, "no jet in a plane, no wall"
    save(pycav.plot.streamlines(tube), tmp_path / "a.png")
    page = pycav.report(tube).read_text()
    assert "How far to trust it" in page and "Key numbers" not in page, "a tube has no wall, no bubble, no solid"
    solid = pycav.run(pycav.Case.from_dict({
        "time": {"end": 1e-6, "snapshot_every": 2.5e-7}, "coupling": {"scheme": "none"},
        "solid": {"z": [-0.01, 0.0], "r": [0.0, 0.01], "cells": [4, 4], "levels": 3, "material": "copper",
                  "pulse": [{"centre": [-5e-3, 0.0], "width": 2e-3, "amplitude": 1e-9}]}}), tmp_path / "solid")
    for kind in ("schlieren", "streamlines", "yield_function"):
        save(getattr(pycav.plot, kind)(solid, time=5e-7), tmp_path / "a.png")
    save(pycav.plot.space_time(solid, "axis"), tmp_path / "a.png")
    for draw in (pycav.plot.interface_continuity, pycav.plot.space_time):
        with pytest.raises(ValueError, match="no (interface|wall)"):
            draw(solid)


def test_histories_stand_beside_theory(result, tmp_path):
    figure = pycav.plot.histories(result, yield_strength=[250e6])
    save(figure, tmp_path / "a.png")
    lines = {line.get_label(): line for line in figure.findobj(mpl.lines.Line2D)}
    run, keller = lines["run, 10 cells per radius"], lines["Keller–Miksis, no wall"]
    early = run.get_xdata() < 15e-6
    theory = np.interp(run.get_xdata()[early], keller.get_xdata(), keller.get_ydata())
    assert np.abs(run.get_ydata()[early] - theory).max() < 0.01 * 0.01, "until the wall makes itself felt"
    assert "$Y_0$ = 250 MPa" in texts(figure) and "/ mm" in texts(figure) and "/ MPa" in texts(figure)


def test_histories_show_a_probe_and_where_the_stress_is_largest(small, tmp_path):
    probe = {"name": "deep", "position": [0.008, 0.0], "medium": "solid"}
    run = pycav.run(small.with_({"probe": [probe], "time.snapshots": []}), tmp_path / "run")
    figure = pycav.plot.histories(run, theory=False, probes=["deep"], place=True)
    assert "von Mises stress at deep" in texts(figure) and "place of the" in texts(figure)
    lines = {line.get_label(): np.asarray(line.get_ydata()) for axes in figure.axes for line in axes.lines}
    assert np.array_equal(lines["von Mises stress at deep"], run.probes["deep"]["von_mises"])
    place = run.histories["solid/von_mises_max_position"].to_numpy()[-1]
    assert lines["below the wall"][-1] == pytest.approx(0.01 - place[0]) and lines["off the axis"][-1] == place[1]


WATER = {"z": [0.0, 0.02], "r": [0.0, 0.02], "cells": [8, 8], "levels": 1, "liquid": {"fluid": "water-tait"}, "gas": {"fluid": "air"}}
PIECE = {"z": [-0.02, 0.0], "r": [0.0, 0.02], "cells": [8, 8], "levels": 1, "material": "aluminium"}


def ball(phase, density, pressure, speed=0.0):
    return [{"shape": "sphere", "centre": [0.006, 0.0], "radius": 0.005, "phase": phase, "density": density, "pressure": pressure,
             "velocity": [-speed, 0.0]}]


def test_histories_have_no_empty_panel_and_no_legend_over_a_curve(tmp_path):
    """Around a drop the gas's radius is that of the whole domain; a legend at the upper left lay on the peak of an early hit."""
    ambient = {"phase": "gas", "density": 1.2, "pressure": 1e5}
    drop = pycav.Case.from_dict({"time": {"end": 1e-5}, "fluid": WATER | {"ambient": ambient, "region": ball("liquid", 998.0, 1e5, 200.0)},
                                 "solid": PIECE})
    figure = pycav.plot.histories(pycav.run(drop, tmp_path / "drop"))
    assert len(figure.axes) == 2 and "eq" not in texts(figure) and "towards the wall" in texts(figure)
    figure.draw_without_rendering()
    assert figure.axes[1].get_legend().get_window_extent().y0 >= figure.axes[1].get_window_extent().y1


def test_a_jet_without_a_wall_runs_along_the_axis(tmp_path):
    open_sides = {"z_min": "non-reflecting", "z_max": "non-reflecting"}
    fluid = WATER | {"z": [-0.02, 0.02], "ambient": {"density": 998.0, "pressure": 5e7}, "region": ball("gas", 5.0, 1e6), "boundary": open_sides}
    free = pycav.run(pycav.Case.from_dict({"time": {"end": 5e-6}, "fluid": fluid, "coupling": {"scheme": "none"}}), tmp_path / "free")
    figure = pycav.plot.histories(free)
    assert len(figure.axes) == 2 and "along $-z$" in texts(figure) and "towards the wall" not in texts(figure)
    page = pycav.report(free).read_text()
    assert "along −z" in page and "towards the wall" not in page


def test_histories_show_the_pressure_of_a_probe_in_the_fluid(small, tmp_path):
    probes = [{"name": "wet", "position": [0.012, 0.0], "medium": "fluid"}, {"name": "deep", "position": [0.008, 0.0], "medium": "solid"}]
    run = pycav.run(small.with_({"probe": probes, "time.snapshots": [], "time.end": 2e-5}), tmp_path / "run")
    figure = pycav.plot.histories(run, theory=False, probes=["wet", "deep"])
    lines = {line.get_label(): np.asarray(line.get_ydata()) for axes in figure.axes for line in axes.lines}
    assert np.array_equal(lines["pressure at wet"], run.probes["wet"]["pressure"]) and "von Mises stress at deep" in lines
    with pytest.raises(KeyError, match="no probe 'dry'"):
        pycav.plot.histories(run, probes=["dry"])


def test_the_levels_are_those_of_the_cells(result):
    figure = pycav.plot.grid_levels(result, 50e-6, WINDOW)
    for image, medium in zip(images(figure), ("solid", "fluid")):
        level = result.snapshots(medium).at(50e-6)["level"]
        assert (image.norm.vmin, image.norm.vmax) == (level.min() - 0.5, level.max() + 0.5)
        assert set(np.unique(image.get_array())) <= set(range(int(level.min()), int(level.max()) + 1))


def test_the_bubble_close_up_has_its_density_and_velocity(result, tmp_path):
    figure = pycav.plot.close_up(result, 40e-6, (0.0, 0.04, 0.02), levels=True)
    save(figure, tmp_path / "a.png")
    snapshot = result.fluid.at(40e-6)
    density, speed = (np.asarray(image.get_array()) for image in images(figure))
    inside = (snapshot.mesh.centre()[:, 1] < 0.02) & (snapshot.mesh.centre()[:, 0] < 0.04)
    assert density.min() == snapshot["density"][inside].min()
    assert np.abs(speed).max() == np.abs(snapshot["velocity"][inside, 0]).max()
    with pytest.raises(ValueError, match="nothing of a fluid"):
        pycav.plot.close_up(result, 40e-6, (-0.04, -0.01, 0.02))


def test_an_overview_has_the_fluid_above_the_solid(result, tmp_path):
    figure = pycav.plot.overview(result, 50e-6, reach=0.03)
    save(figure, tmp_path / "a.png")
    above, below = images(figure)
    wall = float(result.solid[0].mesh.high[0])
    assert above.get_extent()[2] == pytest.approx(wall) and below.get_extent()[3] == pytest.approx(wall)
    assert figure.axes[0].get_ylim() == pytest.approx((wall, wall + 0.036))
    assert figure.axes[1].get_ylim() == pytest.approx((wall - 0.03, wall))
    stress = np.asarray(below.get_array())
    assert np.array_equal(stress, stress[:, ::-1]), "mirrored about the axis"
    assert 1e6 * stress[-1].max() > 1e6 * stress[0].max(), "z upwards: the stress is greatest near the wall"
    assert f"{1e-6 * result.solid.at(50e-6)['von_mises'].max():.3g} MPa" in texts(figure)
    assert len(images(pycav.plot.overview(_rigid(result)))) == 1, "of a fluid alone"


def test_overviews_to_be_compared_have_one_scale(result):
    figure = pycav.plot.overview(result, 50e-6, 0.03, strongest={"fluid": 1e6, "solid": 2e8}, title="a frame", depth=0.01)
    above, below = images(figure)
    assert (above.norm.vmin, above.norm.vmax) == (2.5, 6.0) and (below.norm.vmin, below.norm.vmax) == pytest.approx((0.0, 200.0))
    wall = float(result.solid[0].mesh.high[0])
    assert figure.axes[1].get_ylim() == pytest.approx((wall - 0.01, wall))
    assert "a frame" in texts(figure) and "max. von Mises" not in texts(figure)


def test_blocks_are_outlined_on_one_side(result):
    plain, outlined = (pycav.plot.schlieren(result, 50e-6, blocks=blocks).axes[0] for blocks in (False, True))
    lines = [np.asarray(line) for found in outlined.collections[:2] for line in found.get_segments()]
    assert len(outlined.collections) > len(plain.collections) and min(line[:, 1].min() for line in lines) >= 0


@pytest.mark.parametrize("what", ["wall", "axis"])
def test_space_time_diagrams(what, result, tmp_path):
    figure = pycav.plot.space_time(result, what, reach=0.05)
    save(figure, tmp_path / "a.png")
    mesh = figure.axes[0].collections[0]
    values = 1e6 * mesh.get_array()
    largest = result.histories["interface/pressure"].max() if what == "wall" else result.fluid[-2]["pressure"].max()
    assert 0.1 * largest < np.nanmax(values) and (what == "axis" or np.nanmax(values) == pytest.approx(float(largest)))
    with pytest.raises(ValueError, match="wall"):
        pycav.plot.space_time(result, "nowhere")


def test_tension_on_the_wall_has_a_scale_of_its_own():
    values = np.linspace(-2e6, 6e7, 101)
    for power in (1.0, 0.5):
        figure, axes = _panel()
        _image(figure, axes, np.arange(2.0), np.arange(101.0), np.stack([values, values], axis=1), "p", 100.0, power)
        norm, bar = axes.collections[0].norm, figure.axes[1]
        least, top = norm.vmin, norm.vmax
        assert norm(0.0) == pytest.approx(0.5) and norm(top / 4) == pytest.approx(0.5 + 0.5 * 0.25**power)
        assert norm(least / 4) == pytest.approx(0.5 - 0.5 * 0.25**power) and norm.inverse(norm(least / 3)) == pytest.approx(least / 3)
        assert sum(least < mark < 0 for mark in bar.get_yticks()) >= 2 and sum(0 < mark < top for mark in bar.get_yticks()) >= 3


def test_the_diagram_of_the_wall_may_begin_late(result):
    figure = pycav.plot.space_time(result, since=40e-6, power=0.5)
    assert figure.axes[0].get_ylim()[0] == pytest.approx(40e-6, abs=1e-6)
    assert figure.axes[0].collections[0].norm.gamma == 0.5
    with pytest.raises(ValueError, match="ends at"):
        pycav.plot.space_time(result, since=1.0)


@pytest.mark.parametrize("kind", ["gif", "mp4"])
def test_an_animation_has_a_frame_for_every_snapshot(kind, result, tmp_path):
    path = pycav.animate(result, tmp_path / f"a.{kind}", window=WINDOW, dpi=60)
    if kind == "gif":
        with Image.open(path) as image:
            assert image.n_frames == len(result.fluid)
    else:
        import imageio_ffmpeg

        frames, seconds = imageio_ffmpeg.count_frames_and_secs(str(path))
        assert frames == len(result.fluid) and seconds == pytest.approx(frames / 12, rel=0.1)
    with pytest.raises(ValueError, match="gif"):
        pycav.animate(result, tmp_path / "a.avi")


def test_the_run_turned_about_its_axis(result):
    parts = pycav.plot.volume(result, time=0.0, cells=64)
    x0, x1, y0, y1, z0, z1 = parts["bubble"].bounds
    assert (x1, y1, z0, z1) == pytest.approx((0.01, 0.01, 0.01, 0.03), abs=1.5e-3) and x0 == pytest.approx(-x1, rel=1e-2)
    assert parts["solid"].point_data["von_mises"].max() == pytest.approx(5e7, rel=1e-6)


@pytest.mark.parametrize(("value", "shown"), [
    (5.1e-5, (1e6, "µ")), (2.5e8, (1e-6, "M")), (0.02, (1e3, "m")), (1.0, (1.0, "")), (999.0, (1.0, "")),
    (1e3, (1e-3, "k")), (0.0, (1.0, "")),
])
def test_si_prefixes(value, shown):
    scale, letter = prefix(value)
    assert (pytest.approx(scale), letter) == shown


def test_the_callers_settings_are_left_alone(result):
    before = dict(mpl.rcParams)
    pycav.plot.space_time(result)
    assert dict(mpl.rcParams) == before


def test_of_a_stopped_run_nobody_is_warned_of_a_time_that_he_did_not_give(small, tmp_path):
    """The answer's time is after the last snapshot, and pictures said that it is outside of what there is."""
    case = small.with_({"time.snapshots": [1e-5], "solid.plasticity": {"law": "perfect", "yield_strength": 3e7}})
    with pycav.Simulation(case, out=tmp_path / "run") as simulation:
        simulation.advance_to(2.5e-5)
    summary = tmp_path / "run" / "summary.json"
    summary.write_text(json.dumps(json.loads(summary.read_text()) | {"von_mises_peak_time": 2.2e-5}))
    run = pycav.open(tmp_path / "run")
    assert run.solid.times[-1] == pytest.approx(1e-5, rel=0.01)
    assert pycav.plot.default_time(run) == run.solid.times[-1]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for draw in (pycav.plot.schlieren, pycav.plot.overview, pycav.plot.yield_function, pycav.plot.pit, pycav.plot.volume):
            draw(run)
        assert run.solid.at(pycav.plot.default_time(run)).time == run.fluid.at(pycav.plot.default_time(run)).time
    with pytest.warns(UserWarning, match="time = 2e-05 s is outside"):
        pycav.plot.schlieren(run, 2e-5)
