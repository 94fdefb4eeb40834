"""Directories that hold no run, or not all of one."""

from __future__ import annotations

import shutil

import h5py
import numpy as np
import pytest

import pycav
from pycav.__main__ import main
from pycav._report.health import health, jumps


def test_what_is_missing_of_a_run_is_named(result, tmp_path):
    for name in ("summary.json", "case.toml"):
        shutil.copy(result.directory / name, tmp_path)
    for ask in (pycav.report, pycav.plot.overview, pycav.plot.histories, lambda run: pycav.open(run).histories):
        with pytest.raises(FileNotFoundError, match=r"has no fluid\.h5 and solid\.h5"):
            ask(tmp_path)
    for name in ("fluid.h5", "solid.h5", "solid.vtkhdf"):
        shutil.copy(result.directory / name, tmp_path)
    for ask in (pycav.report, pycav.plot.overview):
        with pytest.raises(FileNotFoundError, match=r"has no fluid\.vtkhdf: the snapshots"):
            ask(tmp_path)
    # Killed before its first snapshot.
    for name in ("fluid.vtkhdf", "solid.vtkhdf"):
        shutil.copy(result.directory / name, tmp_path)
        with h5py.File(tmp_path / name, "r+") as file:
            file["VTKHDF/Steps"].attrs["NSteps"] = 0
    for ask in (pycav.report, pycav.plot.overview, lambda run: pycav.open(run).to_xarray(["pressure"])):
        with pytest.raises(FileNotFoundError, match=r"vtkhdf has no snapshot: the run is, or ended, before its first"):
            ask(tmp_path)
    assert not (tmp_path / "report.html").exists()


def test_a_study_points_at_its_grids(result, tmp_path, capsys):
    for number in (0, 2, 10):
        (tmp_path / f"grid-{number}").mkdir()
        shutil.copy(result.directory / "summary.json", tmp_path / f"grid-{number}")
    with pytest.raises(FileNotFoundError, match="study of grid convergence; give one of its grids: .*grid-0, .*grid-2, .*grid-10"):
        pycav.open(tmp_path)
    assert main(["report", str(tmp_path)]) == 2
    assert "give one of its grids" in capsys.readouterr().err


def test_a_side_that_failed_has_a_snapshot_more_than_the_other(result, tmp_path):
    run = shutil.copytree(result.directory, tmp_path / "run")
    with h5py.File(run / "solid.vtkhdf", "r+") as file:
        file["VTKHDF/Steps"].attrs["NSteps"] -= 1
    left = pycav.open(run)
    assert len(left.fluid) == len(left.solid) + 1
    with pytest.warns(UserWarning, match="outside of what there is"):
        pycav.report(left)
    for own, whole in zip(jumps(left)[1:], jumps(result)[1:]):
        assert np.array_equal(own, whole[:-1])
    with h5py.File(run / "solid.vtkhdf", "r+") as file:
        file["VTKHDF/Steps"].attrs["NSteps"] = 1
    assert not any("at the wall" in verdict.says for verdict in health(pycav.open(run))), "at the start nothing can be told"


def test_a_run_whose_fluid_left_nothing_has_a_report(small, tmp_path):
    plastic = {"solid.plasticity": {"law": "perfect", "yield_strength": 1e8}, "time.end": 1e-6, "time.snapshots": []}
    run = pycav.run(small.with_(plastic), tmp_path / "run").directory
    for path in [*run.glob("fluid.*"), run / "history.h5"]:
        path.unlink()
    assert "The wall's surface" not in pycav.report(run).read_text()
    with pytest.raises(ValueError, match="has no radii of the surface: its fluid has left no histories"):
        pycav.plot.pit(run)
