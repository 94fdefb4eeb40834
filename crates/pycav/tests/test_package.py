"""The package itself: its types, its stubs, its examples."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

import pycav

PACKAGE = Path(pycav.__file__).parent
CONFIGURATION = Path(__file__).parents[1] / "pyproject.toml"


def run(*arguments, **options):
    done = subprocess.run([sys.executable, *map(str, arguments)], capture_output=True, text=True, check=False, **options)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def environment(tmp_path_factory):
    """Both checks of types share what they find."""
    return {**os.environ, "MYPY_CACHE_DIR": str(tmp_path_factory.mktemp("mypy"))}


def test_the_package_brings_the_program_under_both_names():
    for name in ("cav", "pycav"):
        script = Path(sys.executable).with_name(name)
        done = subprocess.run([script, "--version"], capture_output=True, text=True, check=True)
        assert done.stdout.split() == [name, pycav.__version__], done.stdout


def test_types_are_strict(environment):
    source = CONFIGURATION.parent / "python" / "pycav"
    told = run("-m", "mypy", "--config-file", CONFIGURATION, source, env=environment)
    assert "no issues" in told


def test_the_stub_is_what_was_compiled(environment, tmp_path):
    # Beside an empty package: what all of the others import would be looked through, too.
    (tmp_path / "pycav").mkdir()
    (tmp_path / "pycav/__init__.pyi").touch()
    (tmp_path / "pycav/_pycav.pyi").write_text((PACKAGE / "_pycav.pyi").read_text())
    told = run("-m", "mypy.stubtest", "pycav._pycav", "--mypy-config-file", CONFIGURATION,
               env=environment | {"MYPYPATH": str(tmp_path)}, cwd=tmp_path)
    assert "no issues" in told


def test_the_package_tells_that_it_is_typed():
    assert (PACKAGE / "py.typed").exists() and (PACKAGE / "_pycav.pyi").exists()


def test_every_public_name_is_there_and_says_what_it_is():
    for name in pycav.__all__:
        found = getattr(pycav, name)
        assert found.__doc__, name
        assert name in dir(pycav)
    for name in pycav.plot.__all__:
        if name != "Window":
            assert getattr(pycav.plot, name).__doc__, name
    with pytest.raises(AttributeError, match="no attribute 'colapse'"):
        pycav.colapse


def test_importing_it_costs_the_processes_of_a_run_little():
    told = run("-c", "import pycav, sys; print([m for m in ('matplotlib', 'xarray', 'h5py', 'scipy') if m in sys.modules])")
    assert told.strip() == "[]"


@pytest.mark.parametrize(("script", "told", "left"), [
    ("first_run", "cells per radius", ["first-run-histories.png", "first-run-schlieren.png", "first-run/report.html"]),
    ("custom_material", "yielded volume", ["acrylic-yield.png"]),
    ("shock_induced_collapse", "incident pulse 3", ["lithotripter.png", "lithotripter-histories.png"]),
    ("two_bubbles", "bubble 2: smallest radius", ["two-bubbles.png", "two-bubbles.gif"]),
    ("own_solver", "largest displacement", ["plate.png"]),
    ("sweep", "structural-steel", ["map.png", "map.nc"]),
])
def test_an_example_runs(script, told, left, root, tmp_path):
    path = root / "examples/python" / f"{script}.py"
    assert told in run(path, "--out", tmp_path, "--coarser", 3, cwd=tmp_path)
    for name in left:
        assert (tmp_path / name).stat().st_size > 1000, name


def test_no_example_is_left_out(root):
    scripts = {path.stem for path in (root / "examples/python").glob("*.py")} - {"options"}
    assert scripts == {"first_run", "custom_material", "shock_induced_collapse", "two_bubbles", "own_solver", "sweep"}
