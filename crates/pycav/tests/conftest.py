"""Cases at low resolution, and the command line to compare with."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import matplotlib
import pytest

import pycav

matplotlib.use("Agg")

ROOT = Path(__file__).parents[3]


@pytest.fixture(scope="session")
def root() -> Path:
    """The repository."""
    return ROOT


@pytest.fixture(scope="session")
def cav() -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the program `cav` that CAV_BINARY names."""
    binary = os.environ.get("CAV_BINARY")
    assert binary and Path(binary).is_file(), "set CAV_BINARY to the program cav: target/debug/cav"

    def run(*arguments: object, cwd: Path = ROOT) -> subprocess.CompletedProcess[str]:
        return subprocess.run([binary, *map(str, arguments)], cwd=cwd, text=True, capture_output=True, check=False)

    return run


SMALL = {"fluid.levels": 3, "solid.levels": 1}


@pytest.fixture(scope="session")
def small() -> pycav.Case:
    """The coarse case on 32 x 32 cells a side: 0.2 s, physics in outline only."""
    return pycav.Case(ROOT / "cases/dickopp2012-coarse.toml").with_(SMALL)


@pytest.fixture(scope="session")
def result(tmp_path_factory: pytest.TempPathFactory) -> pycav.Result:
    """A run of an adaptive case with snapshots enough for everything that is drawn."""
    times = [k * 56e-6 / 12 for k in range(1, 12)]
    case = pycav.Case(ROOT / "cases/collapse-near-steel.toml").with_(
        {"fluid.levels": 5, "solid.levels": 5, "time.snapshots": times})
    return pycav.run(case, tmp_path_factory.mktemp("runs") / "steel")
