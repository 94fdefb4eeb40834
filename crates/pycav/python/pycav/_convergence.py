"""Grid convergence: a case on finer and finer grids, and what its numbers come to."""

from __future__ import annotations

import functools
import json
import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _pycav
from ._given import count
from ._program import PROGRAM
from .case import Case, checked
from .result import Result

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

RECORD = "convergence.json"


def convergence(
    case: Case,
    out: str | os.PathLike[str],
    *,
    levels: int = 3,
    processes: bool = False,
    force: bool = False,
    threads: int | None = None,
    progress: bool = False,
) -> Convergence:
    """Runs a case on finer and finer grids and says what its numbers converge to, as ``cav run CASE --refine N`` does.

    Grid *k* has cells half as wide as grid *k* - 1; grid 0 is the case as it is given. What is complete in `out`, of the same
    effective case, is not run again, and what is not finished goes on from its newest checkpoint.

    Parameters
    ----------
    case
        The case on the coarsest grid.
    out
        The study's directory: `grid-0`, `grid-1` … are run directories, `convergence.json` the numbers.
    levels
        How many grids, 2 to 5.
    processes
        Fluid and solid in two processes; otherwise both in this one. Same numbers, bit for bit.
    force
        Replace finished runs of other cases in `out`, which are refused otherwise.
    threads
        Of each process; all processors if ``None``.
    progress
        Show how far the runs are.

    Returns
    -------
    Convergence
        Values by grid, observed order, Richardson's value, grid-convergence index.

    Raises
    ------
    ValueError
        `levels` or `out` will not do.
    CaseError
        The case is bad, or its finest grid needs more memory than there is; nothing has been run then.
    RunError
        A finished run of another case is in the way, or the numbers cannot be written. A grid whose run fails raises nothing: it is in
        `Convergence.errors`, and the others' numbers are there.
    KeyboardInterrupt
        Ctrl-C; what is complete stays, and the same call goes on.
    """
    if isinstance(levels, bool) or not isinstance(levels, int) or levels < 0:
        raise ValueError(f"levels is a number of grids, 2 to 5, not {levels!r}")
    case, threads = checked(case), count("threads", threads)
    with tempfile.TemporaryDirectory(prefix="pycav-") as place:
        path = Path(place) / f"{case.name}.toml"
        path.write_text(case._native.text)
        directory, _ = _pycav.convergence(
            case._native, str(path), PROGRAM, levels, os.fspath(out), processes, force, threads, progress)
    return Convergence(directory)


class Convergence:
    """What a study of grid convergence has left: the directory that `pycav.convergence` or ``cav run --refine`` has written.

    Parameters
    ----------
    directory
        The study's directory.

    Raises
    ------
    FileNotFoundError
        There is no `convergence.json` in it.
    """

    def __init__(self, directory: str | os.PathLike[str]) -> None:
        self.directory = Path(directory)
        self.record: dict[str, Any] = json.loads((self.directory / RECORD).read_text())
        """All of `convergence.json`, see docs/reference/output-summary.md."""

    @property
    def grids(self) -> list[dict[str, Any]]:
        """The grids, the coarsest first: `directory`, `levels`, `cells_per_radius`, `completed`, `error` …"""
        return list(self.record["grids"])

    @property
    def errors(self) -> list[str]:
        """Why a grid failed, by grid; "" where it did not."""
        return [str(grid["error"] or "") for grid in self.grids]

    @functools.cached_property
    def results(self) -> list[Result | None]:
        """The run of each grid, the coarsest first; ``None`` for one that has not reached its end."""
        return [Result(self.directory / grid["directory"]) if grid["completed"] else None for grid in self.grids]

    @functools.cached_property
    def data(self) -> xarray.Dataset:
        """The numbers over the dimension `grid`, NaN where a grid has none, with the coordinate `cells_per_radius` where there is a bubble.

        A variable's attributes are `units`, `convergence` and, where there is such a number, `order`, `richardson`, `gci`, `order_used`,
        `safety_factor`, `spread`.
        """
        import xarray

        variables = {}
        for name, number in self.record["numbers"].items():
            values = [float("nan") if value is None else float(value) for value in number["values"]]
            attributes = {"units": number["unit"], "convergence": number["convergence"]}
            attributes |= {key: number[key] for key in WHERE_THERE if number[key] is not None}
            variables[name] = ("grid", np.array(values), attributes)
        cells = [grid["cells_per_radius"] for grid in self.grids]
        coordinates: dict[str, Any] = {"grid": np.arange(len(cells))}
        if None not in cells:
            coordinates["cells_per_radius"] = ("grid", np.array(cells, float))
        return xarray.Dataset(variables, coordinates)

    @functools.cached_property
    def table(self) -> pandas.DataFrame:
        """A row for each number: `unit`, a column for each grid, `convergence`, `order`, `richardson`, `gci`, `uncertainty` (of the finest
        grid, in the number's unit), `spread`."""
        import pandas

        rows = {}
        for name, number in self.record["numbers"].items():
            known = [own for own, value in zip(number["uncertainties"], number["values"]) if value is not None]
            rows[name] = {
                "unit": number["unit"],
                **{f"grid-{k}": value for k, value in enumerate(number["values"])},
                **{key: number[key] for key in ("convergence", "order", "richardson", "gci")},
                "uncertainty": known[-1] if known else None,
                "spread": number["spread"],
            }
        table = pandas.DataFrame.from_dict(rows, orient="index")
        numbers = [name for name in table.columns if name not in ("unit", "convergence")]
        return table.astype({name: float for name in numbers})

    def plot(self, *names: str) -> Figure:
        """Draws numbers over the cells per radius, see `pycav.plot.convergence`."""
        from .plot import convergence as draw

        return draw(self, *names)

    def __repr__(self) -> str:
        complete = sum(bool(grid["completed"]) for grid in self.grids)
        return f"<pycav.Convergence {str(self.directory)!r}, {complete} of {len(self.grids)} grids>"


WHERE_THERE = ("order", "richardson", "gci", "order_used", "safety_factor", "spread")


def study_of(result: Result) -> tuple[Convergence, int] | None:
    """The study that a run belongs to, and the number of its grid: in the run's directory, above, or in NAME-convergence beside it.

    What counts is the case: a study of another one is passed over.
    """
    run = result.directory.resolve()
    own = str(result.histories.attrs.get("case_hash", ""))
    for place in [*[run, *run.parents][:3], run.with_name(run.name + "-convergence")]:
        try:
            study = Convergence(place)
            grids = [grid["case_hash"] for grid in study.grids]
        except (OSError, ValueError, KeyError, TypeError):
            continue
        if own and own in grids:
            return study, grids.index(own)
    return None
