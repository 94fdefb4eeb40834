"""Directories that hold no run, or not all of one."""

from __future__ import annotations

import shutil

import pytest

import pycav
from pycav.__main__ import main


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
    assert not (tmp_path / "report.html").exists()


def test_a_study_points_at_its_grids(result, tmp_path, capsys):
    for number in (0, 2, 10):
        (tmp_path / f"grid-{number}").mkdir()
        shutil.copy(result.directory / "summary.json", tmp_path / f"grid-{number}")
    with pytest.raises(FileNotFoundError, match="study of grid convergence; give one of its grids: .*grid-0, .*grid-2, .*grid-10"):
        pycav.open(tmp_path)
    assert main(["report", str(tmp_path)]) == 2
    assert "give one of its grids" in capsys.readouterr().err
