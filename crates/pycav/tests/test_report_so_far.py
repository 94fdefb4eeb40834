"""The page on a run that goes on or was killed: it has no summary yet."""

from __future__ import annotations

import json
import re
import shutil

import numpy as np
import pytest

import pycav
from pycav import _report
from pycav._report.damage import damage
from pycav._report.numbers import key_numbers
from pycav._report.so_far import PEAKS, known

BEGUN = {"completed": False, "program": "cav", "git_revision": "unknown"}


def killed(result, place):
    """A finished run as it would be if it had been killed before its summary."""
    run = shutil.copytree(result.directory, place)
    (run / "summary.json").write_text(json.dumps(BEGUN))
    return pycav.open(run)


def words(run):
    """The text of the page, without its scripts."""
    text = re.sub(r"<(style|script).*?</\1>", "", _report.page(run), flags=re.S)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", text))


def test_a_report_on_a_run_that_goes_on_says_how_far_it_is(small, tmp_path):
    with pycav.Simulation(small, out=tmp_path / "run") as simulation:
        simulation.advance_to(2e-5)
        assert len(simulation.histories["time"]) > 1  # what is asked for is written
        run = pycav.open(tmp_path / "run")
        assert run.state == "running" and "running" in repr(run)
        text = words(run)
        # It said "Not completed: it was stopped - in 0 steps", and of steel that it has no yield strength.
        assert "still running 20 µs of " in text and f"in {simulation.steps:,} steps" in text
        assert "it was stopped" not in text and "nan" not in text
        assert "yield strength 250 MPa" in text and "has none" not in text
    assert pycav.open(tmp_path / "run").state == "interrupted"
    assert "Not completed: it was stopped" in words(pycav.open(tmp_path / "run"))


def test_a_killed_run_has_the_peaks_of_its_histories(result, tmp_path):
    run = killed(result, tmp_path / "run")
    found, whole = known(run), result.summary
    assert (found["t_end"], found["steps"], found["yield_strength"]) == (whole["t_end"], whole["steps"], whole["yield_strength"])
    for key in (*PEAKS, "jet_velocity_peak"):
        if whole.get(key) is not None:
            assert found[key] == whole[key], key
            assert f"{key}_time" not in whole or found[f"{key}_time"] == whole[f"{key}_time"], key
    assert found["von_mises_peak_position"] == whole["von_mises_peak_position"]
    told = {number.label: number.value for number in key_numbers(run)}
    assert {"Wall pressure on the axis, largest", "Fastest liquid on the axis", "von Mises stress, largest"} <= set(told)
    assert "Not completed: it was stopped" in words(run)


def test_progress_counts_where_it_is_later_than_the_histories(result, tmp_path):
    run = killed(result, tmp_path / "run")
    rows = len(run.histories["time"])
    for time, step in ((1.0, 12345), (0.0, rows - 1)):
        (run.directory / "progress.json").write_text(json.dumps({"time": time, "step": step, "wall": 7.0}))
        found = known(run)
        assert (found["t_end"], found["steps"]) == (max(time, float(run.histories["time"][-1])), step) and found["wall_seconds"] == 7.0
    (run.directory / "progress.json").write_text('{"time": 1.')
    assert known(run)["steps"] == rows - 1 and "wall_seconds" not in known(run)


@pytest.mark.parametrize(("changes", "strength"), [
    ({"solid.material": "tungsten-carbide"}, None), ({"solid.material": "al-1100-o"}, 34e6),
    ({"solid.plasticity": {"law": "perfect", "yield_strength": 9e7}}, 9e7),
    ({"solid.plasticity": {"law": "table", "table": [[0.0, 8e7], [0.1, 9e7]]}}, 8e7)])
def test_the_yield_strength_is_that_of_the_case(changes, strength, small, tmp_path):
    """As the summary has it; that it has none is said of a material without one alone."""
    whole = pycav.run(small.with_({"time.end": 1e-6, "time.snapshots": [0.0], **changes}), tmp_path / "whole")
    assert whole.yield_strength == whole.summary.get("yield_strength") == strength
    run = killed(whole, tmp_path / "killed")
    assert run.yield_strength == strength
    rows = {what: (value, note) for what, value, note in damage(run)}
    assert ("has none" in rows["yield strength"][1]) == (strength is None)
    assert not any("none" in value for what, (value, _) in rows.items() if "zone" in what), "how deep it is, is not known"
    assert np.isfinite(known(run)["von_mises_peak"])
    strain = known(run).get("plastic_strain_peak")
    assert ("plastic_strain_peak_time" in known(run)) == bool(strain), "what has not begun has no time"
