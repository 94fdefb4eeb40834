"""The pit that stays: its picture, its map, and its numbers in the report."""

from __future__ import annotations

import matplotlib as mpl
import numpy as np
import pytest
import xarray
from matplotlib.figure import Figure

import pycav
from pycav._numbers import rounded, si
from pycav._report.damage import damage, work_on_solid
from pycav.plot.surface import Profile
from pycav.result import open_run
from pycav.sweeps.measures import measures

CELLS = 128


@pytest.fixture(scope="module")
def pitted(root, tmp_path_factory) -> pycav.Result:
    """Steel that yields under a bubble on 13 cells per radius: 2 s. The profile is on the faces that the summary's numbers are from."""
    case = pycav.Case(root / "cases/pit-near-steel.toml").with_(
        {"fluid.levels": 4, "solid.levels": 3, "output.interface_cells": CELLS, "time.snapshots": [46e-6]})
    return pycav.run(case, tmp_path_factory.mktemp("runs") / "pit")


def changed(run: pycav.Result, **numbers) -> pycav.Result:
    """The run with another summary."""
    other = pycav.open(run.directory)
    other.summary.update(numbers)
    return other


def texts(figure: Figure) -> str:
    return "\n".join(text.get_text() for text in figure.findobj(mpl.text.Text))


def test_the_pit_is_that_of_the_summary(pitted, tmp_path):
    figure = pycav.plot.pit(pitted)
    figure.savefig(tmp_path / "a.png", dpi=60)
    above, summary = figure.axes[0], pitted.summary
    r, depth = (np.asarray(values) for values in above.lines[0].get_data())
    assert len(r) == 2 * CELLS and np.array_equal(depth, depth[::-1]), "mirrored about the axis"
    first, second = depth[CELLS:CELLS + 2]
    assert depth.max() == first, "it is deepest on the axis, which lies between the faces' centres"
    assert (9 * first - second) / 8 == pytest.approx(summary["pit_depth"], rel=1e-12) and -depth.min() == pytest.approx(summary["pit_rim"])
    assert np.interp(summary["pit_radius"], r, depth) == pytest.approx(0.5 * summary["pit_depth"], rel=1e-9)
    outer = r > 0
    inside = outer & (np.cumsum((depth < 0) & outer) == 0)
    volume = (2 * np.pi * r * depth)[inside].sum() * (r[-1] - r[-2])
    assert volume == pytest.approx(summary["pit_volume"], rel=1e-9)
    ends = {tuple(arrow.xy) for arrow in above.texts if isinstance(arrow, mpl.text.Annotation)}
    assert ends == {(0.0, summary["pit_depth"]), (summary["pit_radius"], 0.5 * summary["pit_depth"])}
    told = texts(figure)
    for words, name, unit in (("depth", "depth", "m"), ("radius at half depth", "radius", "m"), ("rim", "rim", "m"), ("volume", "volume", "m³")):
        assert f"{words} {rounded(summary[f'pit_{name}'], unit)}" in told
    assert "µm" in told and "mm³" in told and "still moving by" in told


def test_faces_that_one_cell_carries_make_no_stairs(pitted):
    r = (np.arange(40) + 0.5) * 1e-5
    depth = np.concatenate([np.repeat([4e-6, 2e-6, 1e-6, 5e-7, 2e-7], 2), np.zeros(30)])
    place, drawn = Profile(open_run(pitted), 0.0, r, depth, False).line
    assert np.array_equal(drawn[:6], [4e-6, 2e-6, 1e-6, 5e-7, 2e-7, 0.0]) and place[:2] == pytest.approx([1e-5, 3e-5])
    assert place[-1] == r[-1] and np.all(np.diff(place) > 0), "a level surface is drawn to its end"


def test_pits_to_be_compared_have_one_scale(pitted):
    times = pitted.snapshots("solid").times
    deepest, strain = 2 * pitted.summary["pit_depth"], 2 * pitted.summary["plastic_strain_peak"]
    figures = [pycav.plot.pit(pitted, time=float(time), reach=1e-3, strongest=(deepest, strain)) for time in times[-2:]]
    (low, high), *others = (figure.axes[0].get_ylim() for figure in figures)
    assert low >= deepest and others == [(low, high)]
    assert all(figure.axes[1].collections[0].norm.vmax == pytest.approx(strain) for figure in figures)


def test_the_axis_of_a_pit_says_how_much_it_is_stretched(pitted):
    above, below = pycav.plot.pit(pitted).axes[:2]

    def scales(axes):
        """Inches per metre along r and along the depth."""
        place, (width, height) = axes.get_position(), axes.figure.get_size_inches()
        return (place.width * width / np.ptp(axes.get_xlim()), place.height * height / np.ptp(axes.get_ylim()))

    across, down = scales(above)
    assert f"{down / across:.4g} times stretched" in above.get_ylabel()
    across, down = scales(below)
    assert down == pytest.approx(across, rel=1e-6) and "true scale" in below.get_ylabel()
    assert above.get_position().x1 == pytest.approx(below.get_position().x1), "one stands below the other"
    assert above.get_xlim() == below.get_xlim() and above.yaxis_inverted() and below.yaxis_inverted()


def test_the_plastic_zone_hangs_from_the_deformed_surface(pitted):
    above, below = pycav.plot.pit(pitted, reach=0.025).axes[:2]
    profile = above.lines[0].get_data()
    (mesh,) = below.findobj(mpl.collections.QuadMesh)
    across, depth = np.moveaxis(np.asarray(mesh.get_coordinates()), -1, 0)
    assert np.allclose(depth[:, -1], np.interp(across[:, -1], *profile), atol=1e-9), "its top is the surface"
    assert np.ptp(depth[:, -1] - depth[:, 0]) < 1e-12
    strain, summary = pitted.solid[-1]["plastic_strain"], pitted.summary
    assert mesh.get_array().max() == strain.max() and mesh.norm.vmin == 1e-4
    cell = float(pitted.solid[-1].mesh.finest[0])
    drawn = {float(lines.levels[0]): lines for lines in below.findobj(mpl.contour.ContourSet)}
    assert set(drawn) == {1e-4, 2e-3}
    for level, name in ((1e-4, ""), (2e-3, "_2e-3")):
        corners = np.concatenate([path.vertices for path in drawn[level].get_paths()])
        assert np.abs(corners[:, 0]).max() == pytest.approx(summary[f"plastic_zone_radius{name}"], abs=cell)
        assert corners[:, 1].max() == pytest.approx(summary[f"plastic_zone_depth{name}"], abs=cell)


def test_an_earlier_profile_has_no_numbers_of_the_end(pitted):
    figure = pycav.plot.pit(pitted, 46e-6, names=["then"])
    data = pitted.histories
    row = int(np.argmin(np.abs(data["interface/displacement_time"].to_numpy() - 46e-6)))
    profile = data["interface/displacement_z"].to_numpy()[row]
    deepest = float(profile[int(0.9 * CELLS + 0.5):].mean() - profile.min())
    assert f"deepest {rounded(deepest, 'm')}" in texts(figure) and "half depth" not in texts(figure)
    assert figure.axes[1].findobj(mpl.collections.QuadMesh)[0].get_array().max() == pitted.solid.at(46e-6)["plastic_strain"].max()


def test_what_bulges_fits_into_the_picture(pitted, tmp_path):
    with pycav.Simulation(pitted.case.with_({"fluid.levels": 3, "solid.levels": 2}), out=tmp_path / "run") as simulation:
        simulation.advance_to(4e-5)
    above, below = pycav.plot.pit(tmp_path / "run", reach=1.0).axes[:2]
    depth, (bottom, top) = np.asarray(above.lines[0].get_ydata()), above.get_ylim()
    assert -depth.min() > 3 * depth.max() and top < depth.min() and depth.max() < bottom
    assert "no pit: nothing flowed" in texts(above.figure)
    assert below.get_xlim() == (-0.05, 0.05) and below.get_ylim()[0] == pytest.approx(0.05), "no more than there is"


def test_profiles_stand_beside(pitted):
    figure = pycav.plot.pit(pitted, beside=[pitted])
    assert [line.get_label() for line in figure.axes[0].lines[:2]] == ["12.8 cells per radius"] * 2
    with pytest.raises(ValueError, match="2, not 1"):
        pycav.plot.pit(pitted, beside=[pitted], names=["one"])


def test_no_pit_is_told_where_the_summary_has_none(pitted):
    shallow = changed(pitted, pit_depth=0.0, pit_radius=None, pit_volume=0.0, pit_rim=0.0, pit_floor=1.23e-6)
    assert "no pit: none deeper than 1.23 µm" in texts(pycav.plot.pit(shallow))
    # What waves leave when a run ends too early is no pit.
    assert "no pit: nothing flowed" in texts(pycav.plot.pit(changed(pitted, plastic_strain_peak=0.0)))
    rows = {what: (value, note) for what, value, note in damage(shallow)}
    assert rows["pit"][0] == "none" and "1.23 µm" in rows["pit"][1] and "pit, depth" not in rows


def test_pits_that_cannot_be_are_refused(result, pitted, tmp_path):
    with pytest.raises(ValueError, match=r"elastic and keeps no pit: \[solid.plasticity\]"):
        pycav.plot.pit(result)
    with pytest.raises(ValueError, match="no plastic_strain"):
        pycav.plot.plastic_strain(result)
    rigid = pitted.case.with_({"coupling.scheme": "rigid", "time.end": 1e-6, "time.snapshots": []})
    with pytest.raises(ValueError, match="no solid"):
        pycav.plot.pit(pycav.run(rigid, tmp_path / "rigid"))
    alone = pycav.Case.from_dict({
        "time": {"end": 1e-7}, "coupling": {"scheme": "none"},
        "solid": {"z": [-0.01, 0.0], "r": [0.0, 0.01], "cells": [16, 16], "adapt": False, "material": "al-6061-t6",
                  "plasticity": {"law": "perfect"}}})
    with pytest.raises(ValueError, match="no displacement of the surface"):
        pycav.plot.pit(pycav.run(alone, tmp_path / "alone"))


def test_plastic_strain_stands_beside_the_stress(pitted):
    figure = pycav.plot.plastic_strain(pitted, 46e-6, (-0.01, 0.01, 0.02), levels=True)
    stress, strain = (image.get_array() for axes in figure.axes for image in axes.images)
    snapshot = pitted.solid.at(46e-6)
    assert 1e6 * stress.max() == pytest.approx(snapshot["von_mises"].max()) and strain.max() == snapshot["plastic_strain"].max()


def test_a_report_tells_the_damage_in_units_of_an_engineer(pitted, tmp_path):
    page = pycav.report(pitted, tmp_path / "page.html").read_text()
    assert '"name":"strain"' in page and "The wall's surface at the end, above its level far away" in page and "surface/depth_axis" in page
    rows, summary = {what: (value, note) for what, value, note in damage(pitted)}, pitted.summary
    assert rows["largest plastic strain"][0] == f"{100 * summary['plastic_strain_peak']:.3g} %"
    assert "at z = " in rows["largest plastic strain"][1] and "µs" in rows["largest plastic strain"][1]
    assert rows["plastic zone, strains above 0.2 %"][0] == f"{1e3 * summary['plastic_zone_depth_2e-3']:.3g} mm deep"
    work, times = (pitted.histories[f"solid/{name}"].to_numpy() for name in ("plastic_work", "time"))
    first, last = times[np.flatnonzero(work)[0]], times[np.flatnonzero(work == work[-1])[0]]
    assert rows["flows from, to"][0] == f"{si(first, 's')}, {si(last, 's')}" and "yields from, to" not in rows
    assert rows["pit, depth"][0] == f"{1e6 * summary['pit_depth']:.3g} µm"
    assert rows["pit, volume"][0] == f"{1e9 * summary['pit_volume']:.3g} mm³"
    # Of a load that is not like the pulse the pulse's numbers say nothing.
    assert rows["equivalent load"][0] == "none" and summary["load_misfit"] > 0.5
    like = {what: value for what, value, _ in damage(changed(pitted, load_misfit=0.2))}
    assert like["equivalent load, P₀"] == f"{1e-6 * summary['load_amplitude']:.3g} MPa" and "equivalent load" not in like
    for what in rows:
        assert what in page, what


def test_the_share_of_the_plastic_work_is_of_the_work_on_the_solid(pitted):
    """The ledger is per radian, the plastic work whole."""
    given, data = work_on_solid(pitted), pitted.histories
    assert given == pytest.approx(2 * np.pi * float(data["conservation/solid/energy_in_z_max"][-1]))
    taken = 2 * np.pi * float(data["conservation/solid/energy_plastic"][-1])
    assert taken == pytest.approx(pitted.summary["plastic_work"]) and 0 < taken < given
    assert (data["conservation/solid/energy_dissipated"][:] > -1e-6 * given).all()
    assert work_on_solid(changed(pitted, work_on_solid=12.5)) == 12.5
    rows = {what: note for what, _, note in damage(changed(pitted, work_on_solid=10 * pitted.summary["plastic_work"]))}
    assert rows["plastic work"].startswith("10 % of the work on the solid")


def test_a_report_on_an_elastic_solid_has_nothing_of_it(result):
    told = [what for what, _, _ in damage(result)]
    assert told == ["yield strength", "largest von Mises stress", "yielded volume, largest", "yields from, to",
                    "impulse on the wall, on the axis"]


def test_a_sweep_keeps_the_pit(pitted, result):
    found = measures(pitted)
    for name in ("pit_depth", "pit_radius", "pit_volume", "pit_rim", "plastic_strain_peak", "plastic_work", "surface_still"):
        assert found[name][0] == pitted.summary[name]
    assert found["pit_depth"][1] == "m" and np.isnan(measures(result)["plastic_strain_peak"][0])


def study(**changes) -> xarray.Dataset:
    """Two materials at three stand-offs: pits but for one, one that moves, one too deep, one without flow, one that failed."""
    numbers = {
        "pit_depth": [[2e-4, 4e-5, 0.0], [np.nan, 9e-5, 1e-6]], "pit_radius": [[2e-3, 2e-3, np.nan], [np.nan, 3e-3, 1e-3]],
        "plastic_strain_peak": [[0.1, 0.01, 1e-3], [np.nan, 0.02, 0.0]], "surface_still": [[0.01, 0.02, 0.5], [np.nan, 0.3, 2.0]],
        "von_mises_peak": [[1e9] * 3, [np.nan, 1e9, 1e9]],
    } | changes
    kinds = ("solid.material", "stand_off")
    return xarray.Dataset({name: (kinds, np.array(values)) for name, values in numbers.items()},
                          {"solid.material": ["hard", "soft"], "stand_off": [1.5, 1.25, 2.0]})


def test_a_map_of_pits_has_a_number_in_every_field(tmp_path):
    figure = pycav.plot.pit_map(study())
    figure.savefig(tmp_path / "a.png", dpi=60)
    axes = figure.axes[0]
    fields = {tuple(text.get_position()): text.get_text() for text in axes.texts}
    # Columns in the order of the stand-off, the material of the deepest pit on top.
    assert [label.get_text() for label in axes.get_yticklabels()] == ["soft", "hard"]
    assert fields == {(1.25, 0.5): "≈ 90 µm", (1.5, 0.5): "failed", (2.0, 0.5): "no pit",
                      (1.25, 1.5): "40 µm", (1.5, 1.5): "200 µm*", (2.0, 1.5): "no pit"}
    (mesh,) = axes.findobj(mpl.collections.QuadMesh)
    values = np.ma.masked_array(mesh.get_array()).reshape(2, 3)
    assert values.tolist() == [[9e-5, None, None], [4e-5, 2e-4, None]]
    assert np.allclose(np.asarray(mesh.get_coordinates())[0, :, 0], [1.125, 1.375, 1.75, 2.25]), "columns end half way"
    assert "* deeper than 5 %" in axes.get_xlabel() and "≈ still moving" in axes.get_xlabel()
    assert "3 mm" in texts(pycav.plot.pit_map(study(), "pit_radius"))


def test_a_map_says_what_it_needs():
    with pytest.raises(ValueError, match="pit_depth, pit_radius, pit_rim, not of 'depth'"):
        pycav.plot.pit_map(study(), "depth")
    with pytest.raises(ValueError, match="sweep over stand_off and solid.material, not over stand_off"):
        pycav.plot.pit_map(study().isel({"solid.material": 0}))
    with pytest.raises(ValueError, match="elastic and keep no pit"):
        pycav.plot.pit_map(study(plastic_strain_peak=[[np.nan] * 3] * 2))


def test_a_map_without_any_pit_can_be_drawn(tmp_path):
    figure = pycav.plot.pit_map(study(pit_depth=[[0.0] * 3] * 2))
    figure.savefig(tmp_path / "a.png", dpi=60)
    assert texts(figure).count("no pit") == 6
