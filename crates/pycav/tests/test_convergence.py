"""Grid convergence: the program's own numbers, tables and pictures of them, and reports that know them."""

from __future__ import annotations

import json

import numpy as np
import pytest

import pycav
from pycav._report import page
from pycav._report.numbers import shown


@pytest.fixture(scope="module")
def short(root):
    return pycav.Case(root / "tests/fixture/small.toml").with_({"fluid.levels": 2, "solid.levels": 2, "time.end": 3e-6})


@pytest.fixture(scope="module")
def study(short, tmp_path_factory):
    return pycav.convergence(short, tmp_path_factory.mktemp("runs") / "study", levels=3, threads=1)


def test_it_is_what_the_command_line_does(short, study, cav, root, tmp_path):
    done = cav("run", root / "tests/fixture/small.toml", "--set", "fluid.levels=2", "--set", "solid.levels=2", "--set", "time.end=3e-6",
               "--refine", 3, "--threads", 1, "--out", tmp_path / "study")
    assert done.returncode == 0, done.stderr
    there = json.loads((tmp_path / "study/convergence.json").read_text())
    assert there["numbers"] == study.record["numbers"]
    assert [grid["case_hash"] for grid in there["grids"]] == [grid["case_hash"] for grid in study.grids]
    assert study.record == json.loads((study.directory / "convergence.json").read_text())


def test_numbers_are_tables_with_units_and_what_they_come_to(study):
    assert study.errors == ["", "", ""] and "3 of 3 grids" in repr(study)
    assert [result.cells_per_radius for result in study.results] == pytest.approx([3.2, 6.4, 12.8])
    mean = study.data["wall_pressure_mean_peak"]
    assert list(mean.values) == [result.summary["wall_pressure_mean_peak"] for result in study.results]
    assert mean.attrs["units"] == "Pa" and list(study.data["cells_per_radius"].values) == pytest.approx([3.2, 6.4, 12.8])
    # An order and an index, by the formulas.
    f3, f2, f1 = mean.values
    assert mean.attrs["order"] == pytest.approx(np.log2((f2 - f3) / (f1 - f2)))
    assert mean.attrs["richardson"] == pytest.approx(f1 + (f1 - f2) / (2 ** mean.attrs["order"] - 1))
    row = study.table.loc["wall_pressure_mean_peak"]
    used = min(max(row["order"], 0.5), 2.0)
    assert row["gci"] == pytest.approx(1.25 * abs((f2 - f1) / f1) / (2**used - 1))
    assert row["uncertainty"] == pytest.approx(row["gci"] * f1) and row["grid-2"] == f1
    # Where there is none, there is none.
    other = study.table[study.table["convergence"] != "monotone"]
    assert len(other) and other["order"].isna().all() and "order" not in study.data[other.index[0]].attrs


def test_what_is_complete_is_kept(short, study):
    def kept():
        """When what a run computed was written, and its summary but for the sentences that name the study."""
        found = []
        for grid in range(3):
            run = study.directory / f"grid-{grid}"
            summary = json.loads((run / "summary.json").read_text())
            found.append(((run / "history.h5").stat().st_mtime_ns, {key: summary[key] for key in summary.keys() - {"answer"}}))
        return found

    before = kept()
    again = pycav.convergence(short, study.directory, levels=2, threads=1)
    assert kept() == before
    assert again.data.sizes["grid"] == 2 and set(again.table["convergence"]) == {"two-grids"}
    assert pycav.convergence(short, study.directory, levels=3).record == study.record


def test_a_grid_that_fails_leaves_the_numbers_of_the_others(short, tmp_path):
    (tmp_path / "grid-1").mkdir()
    (tmp_path / "grid-1/notes.txt").write_text("mine")
    found = pycav.convergence(short, tmp_path, levels=3, threads=1)
    assert [bool(error) for error in found.errors] == [False, True, False] and "notes.txt" in found.errors[1]
    assert found.results[1] is None
    assert list(np.isnan(found.data["von_mises_peak"].values)) == [False, True, False]
    assert found.plot().axes


def test_what_cannot_be_done_is_refused(short, study, tmp_path):
    for levels in (1, 6, 0, -1, 2.5, True):
        with pytest.raises(ValueError, match="2 to 5"):
            pycav.convergence(short, tmp_path / "study", levels=levels)
    large = short.with_({"fluid.adapt": False, "fluid.levels": 0, "fluid.cells": [2048, 2048]})
    with pytest.raises(pycav.CaseError, match=r"(?s)grid 4 \(fluid.levels = 4, .*32768\s+x\s+32768\s.*cells"):
        pycav.convergence(large, tmp_path / "study", levels=5)
    assert not (tmp_path / "study").exists()
    with pytest.raises(pycav.RunError, match="holds a finished run"):
        pycav.convergence(short.with_({"time.cfl": 0.4}), study.directory, levels=2)
    with pytest.raises(ValueError, match="is the directory of a run"):
        pycav.convergence(short, study.directory / "grid-0", levels=2)
    with pytest.raises(FileNotFoundError):
        pycav.Convergence(tmp_path)


def test_a_picture_shows_values_richardsons_and_the_band(study):
    figure = study.plot()
    assert 2 <= len(figure.axes) <= 6
    one = pycav.plot.convergence(str(study.directory), "wall_pressure_mean_peak")
    (axes,) = one.axes
    labels = axes.get_legend_handles_labels()[1]
    assert labels == ["grids", "finest ± GCI", "Richardson"] and axes.get_xlabel() == "cells per radius"
    assert list(axes.lines[0].get_xdata()) == pytest.approx([3.2, 6.4, 12.8])
    with pytest.raises(ValueError, match="no wall_presure"):
        study.plot("wall_presure")


def test_a_report_says_how_sure_its_numbers_are(study, result):
    for grid, factor in ((2, 1.0), (1, 2.0)):
        text = page(study.results[grid])
        number = study.record["numbers"]["wall_pressure_mean_peak"]
        own = number["uncertainties"][grid]
        assert own == pytest.approx(number["uncertainties"][2] * factor ** number["order_used"])
        assert f" ± {shown(float(f'{own:.3g}'), 'Pa')}" in text and f"order {number['order']:.2g}" in text
        assert f"grid {grid} of 0 to 2" in text and f"{3.2 * 2**grid:g} cells per radius" in text
    assert "±" not in page(result)


def test_a_sweeps_impulse_is_the_summarys(result):
    from pycav.sweeps.measures import measures

    assert measures(result)["wall_impulse"] == (result.summary["wall_impulse"], "Pa s")
    largest = float(result.histories["interface/impulse"].to_numpy()[:, 0].max())
    assert result.summary["wall_impulse"] >= largest > 0


def test_maps_estimate_their_uncertainty_by_the_same_rules(study):
    from pycav.sweeps.uncertainty import estimated

    cells = [result.cells_per_radius for result in study.results]
    compared = set()
    for name, number in study.record["numbers"].items():
        if None in number["values"] or None in number["uncertainties"]:
            continue
        for grid in range(3):
            others = [k for k in (2, 0, 1) if k != grid]
            found = estimated([number["values"][k] for k in (grid, *others)], [cells[k] for k in (grid, *others)])
            assert found.uncertainty == pytest.approx(number["uncertainties"][grid], rel=1e-9), (name, grid)
            assert found.kind == number["convergence"], name
        compared.add(number["convergence"])
    assert "monotone" in compared
    two = pycav.convergence(study.results[0].case, study.directory.parent / "two", levels=2, threads=1).record["numbers"]["wall_impulse"]
    for grid in range(2):
        found = estimated([two["values"][grid], two["values"][1 - grid]], [cells[grid], cells[1 - grid]])
        assert found == (pytest.approx(two["uncertainties"][grid], rel=1e-9), "two-grids")
