"""Cases: read, changed, refused as the command line refuses them."""

from __future__ import annotations

import ast
import pickle
import re
from pathlib import Path

import numpy as np
import pytest

import pycav
from pycav import _toml

COARSE = "cases/dickopp2012-coarse.toml"

ROOT = Path(__file__).parents[3]


def table():
    """The program's own table of bad cases: what is done to a good case, as text and `--set`."""
    source, good = ((ROOT / "tests" / name).read_text() for name in ("case_errors/bad.rs", "fixture/small.toml"))
    rows = []
    for kind, arguments in re.findall(r"^    \((Whole|Replace|Append|Sets)\((.*?)\), &\[", source, re.M):
        given = ast.literal_eval(f"({arguments.replace('&[', '[')},)")
        text = {"Whole": lambda: given[0], "Replace": lambda: good.replace(*given, 1),
                "Append": lambda: f"{good}\n{given[0]}", "Sets": lambda: good}[kind]()
        rows.append((text, given[0] if kind == "Sets" else []))
    return rows


def test_the_whole_table_of_bad_cases_is_refused_in_the_same_words(cav, tmp_path, monkeypatch):
    rows = table()
    # Where relative paths count from is a part of some.
    monkeypatch.chdir(tmp_path)
    assert len(rows) > 100 and any(sets for _, sets in rows)
    for text, sets in rows:
        (tmp_path / "bad.toml").write_text(text)
        told = cav("check", "bad.toml", *(word for change in sets for word in ("--set", change)), cwd=tmp_path)
        assert told.returncode == 2, (text, sets)
        with pytest.raises(pycav.CaseError) as refused:
            pycav.Case.from_toml(text, "bad")._native.with_sets(sets)
        assert str(refused.value) == told.stderr.rstrip()


BAD = [
    ["time.cfl=2"], ["time.end=-1"], ["fluid.raduis=3"], ["fluid.region.0.radius=0"], ["fluid.region.1.radius=1"],
    ["fluid.riemann=hlc"], ["fluid.levels=1"], ["solid.material=steal"], ["coupling.scheme=weird", "time.cfl=nan"],
    ["fluid.ambient.density=-1"], ["fluid.region.0.centre=[0.03, 0.01]"], ["fluid.levels=30"], ["probe.0.medium=air"],
    ["fluid.interface=thinc"], ["output.fields=[\"wind\"]"],
]


@pytest.mark.parametrize("sets", BAD, ids=lambda sets: ",".join(sets))
def test_a_bad_case_is_refused_with_the_words_of_the_command_line(sets, cav, root, monkeypatch):
    monkeypatch.chdir(root)
    told = cav("check", COARSE, *(word for change in sets for word in ("--set", change)))
    assert told.returncode == 2
    with pytest.raises(pycav.CaseError) as refused:
        pycav.Case(COARSE)._native.with_sets(sets)
    assert str(refused.value) == told.stderr.rstrip()
    assert refused.value.faults and all(fault["message"] for fault in refused.value.faults)


@pytest.mark.parametrize("text", ["[time", "geometry = 3\n", ""])
def test_a_bad_text_is_refused_with_the_words_of_the_command_line(text, cav, tmp_path, monkeypatch):
    path = tmp_path / "bad.toml"
    path.write_text(text)
    told = cav("check", path)
    with pytest.raises(pycav.CaseError) as refused:
        pycav.Case(path)
    assert str(refused.value) == told.stderr.rstrip()


def test_a_file_that_is_not_there_is_a_case_error(cav):
    with pytest.raises(pycav.CaseError) as refused:
        pycav.Case("nowhere.toml")
    assert str(refused.value) == cav("check", "nowhere.toml").stderr.rstrip()


def test_a_fault_tells_its_place(root):
    text = (root / COARSE).read_text().replace("cfl = 0.45", "cfl = 1.5")
    with pytest.raises(pycav.CaseError, match="must lie in") as refused:
        pycav.Case.from_toml(text)
    (fault,) = refused.value.faults
    assert (fault["path"], fault["line"]) == ("time.cfl", text[: text.index("cfl = 1.5")].count("\n") + 1)
    assert isinstance(refused.value, ValueError)


def test_changes_make_a_copy(small):
    changed = small.with_(**{"fluid.ambient.pressure": 4e7}).with_({"time.end": 1e-5, "time.snapshots": np.array([5e-6])})
    assert changed != small and changed.end == 1e-5 and small.end == 65.7e-6
    values = _toml.parse(changed.to_toml())
    assert values["fluid"]["ambient"]["pressure"] == 4e7
    assert values["time"]["snapshots"] == [0.0, 5e-6, 1e-5]


def test_the_same_case_from_text_dictionary_and_pickle(small):
    values = _toml.parse(small.to_toml())
    for same in (pycav.Case.from_toml(small.to_toml(), small.name), pycav.Case.from_dict(values, small.name),
                 pickle.loads(pickle.dumps(small))):
        assert same == small and same.hash == small.hash and hash(same) == hash(small)


def test_the_hash_is_that_of_the_files(small, cav, root):
    assert small.with_({"fluid.levels": 4}).hash != small.hash
    assert "fluid" in small.check() and small.media == ["fluid", "solid"]


@pytest.mark.parametrize("given", [0.1, -1e-300, 5e7, 1e22, 3, True, "a \"quoted\" word", [1.5, [2, 3.0]], {"a": 1.0}])
def test_values_survive_being_written(given):
    assert _toml.parse(f"x = {_toml.value(given)}")["x"] == given


def test_numpy_values_are_written_as_plain_ones():
    assert _toml.value(np.float64(0.1)) == "0.1" and _toml.value(np.int32(3)) == "3"
    assert _toml.parse(f"x = {_toml.value(np.array([[0.0, 1e5], [1.0, 2e5]]))}")["x"] == [[0.0, 1e5], [1.0, 2e5]]
    with pytest.raises(TypeError, match="no place in a case file"):
        _toml.value(object())


def test_the_library_of_materials_and_one_of_ones_own(small):
    library = {material.name: material for material in pycav.materials()}
    assert library["structural-steel"].yield_strength == 250e6
    steel = library["structural-steel"]
    own = small.with_({"solid.material": {"density": steel.density, "c1": steel.c1, "c2": steel.c2}})
    assert own != small, "it has no yield strength"


def test_an_inflow_is_sampled_from_a_function(root):
    case = pycav.Case(root / "cases/lithotripter.toml")
    times = np.linspace(0, 2e-6, 5)
    changed = case.with_inflow(lambda t: 1e5 + 1e12 * t, times)
    pressure = np.array(_toml.parse(changed.to_toml())["fluid"]["inflow"]["pressure"])
    assert np.array_equal(pressure, np.column_stack([times, 1e5 + 1e12 * times]))


PULSES = {
    "narrow pulse": lambda t: 1e5 + 4e7 * np.exp(-(((t - 0.6123456e-6) / 2e-11) ** 2)),
    "front of 20 ns": lambda t: 1e5 + np.clip(t / 20e-9, 0.0, 1.0) * 5e7 * np.exp(-9.1e5 * t) * np.cos(5.2e5 * t + 1.0),
    "kinks": lambda t: 1e5 + 1e12 * np.abs(t - 7e-7) - 1e12 * np.abs(t - 1.1e-6),
    "square root": lambda t: 1e9 * np.sqrt(t),
    "many periods": lambda t: 1e7 * np.sin(2 * np.pi * 20e6 * t),
}


@pytest.mark.parametrize("tolerance", [1e-2, 1e-4])
@pytest.mark.parametrize("name", PULSES)
def test_an_inflow_from_a_function_is_as_close_to_it_as_was_asked(name, tolerance, root):
    case = pycav.Case(root / "cases/lithotripter.toml")
    changed = case.with_inflow(PULSES[name], tolerance=tolerance)
    rows = np.array(_toml.parse(changed.to_toml())["fluid"]["inflow"]["pressure"])
    assert rows[0, 0] == 0.0 and rows[-1, 0] == case.end and (np.diff(rows[:, 0]) > 0).all()
    anywhere = np.sort(np.random.default_rng(1).uniform(0.0, case.end, 3_000_000))
    exact = PULSES[name](anywhere)
    off = np.abs(np.interp(anywhere, *rows.T) - exact).max() / np.ptp(exact)
    assert off <= tolerance
    assert len(rows) < (5000 if name == "many periods" else 300), "no more rows than that takes"


@pytest.mark.parametrize(("function", "told"), [
    (lambda t: np.where(t < 1.0e-6, 1e5, 4e7), r"jumps at t = 1(\.0000\d*)?e-06 s"),
    (lambda t: 1e5 + np.where(t > 0, t, np.inf), "t = 0 s is not finite"),
    (lambda t: np.where(t > 1e-6, np.nan, 1e5), "is not finite"),
    (lambda t: 1e5 * np.random.default_rng(1).normal(size=t.shape), "more than 1,048,576 times"),
], ids=["jump", "pole", "nan", "noise"])
def test_a_function_that_no_table_holds_is_refused(function, told, root):
    case = pycav.Case(root / "cases/lithotripter.toml")
    with pytest.raises(ValueError, match=told):
        case.with_inflow(function)
    with pytest.raises(ValueError, match="between 0 and 1"):
        case.with_inflow(PULSES["kinks"], tolerance=0.0)


def test_a_constant_inflow_needs_two_rows(root):
    changed = pycav.Case(root / "cases/lithotripter.toml").with_inflow(lambda t: 2e5)
    assert _toml.parse(changed.to_toml())["fluid"]["inflow"]["pressure"] == [[0.0, 2e5], [changed.end, 2e5]]


def test_paths_may_be_of_any_kind(root):
    assert pycav.Case(str(root / COARSE)) == pycav.Case(Path(root / COARSE))


@pytest.mark.parametrize("wanted", [
    pycav.run, pycav.Simulation, pycav.FluidSolver, pycav.SolidSolver, lambda case: pycav.convergence(case, "out"),
    lambda case: pycav.sweep(case, {"time.cfl": [0.4]}, "out")], ids=["run", "simulation", "fluid", "solid", "convergence", "sweep"])
def test_a_path_is_no_case_and_the_cure_is_told(wanted, small, result, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for given, told in (("mid.toml", r"a str.*pycav\.Case\('mid\.toml'\)"), (Path("mid.toml"), r"pycav\.Case\('mid\.toml'\)"),
                        ({"time": {}}, r"a dict.*from_dict"), (result, r"a Result.*\.case"), (None, "NoneType, not a pycav.Case")):
        with pytest.raises(TypeError, match=told):
            wanted(given)
    assert not any(tmp_path.iterdir())
