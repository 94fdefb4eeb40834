"""A cavitation bubble collapsing near an elastic solid: cases, runs, results, pictures.

    import pycav

    case = pycav.collapse(radius=1e-3, pressure=2e7, stand_off=1.5, wall="al-1100-o", cells_per_radius=20)
    result = pycav.run(case, out="runs/first")
    print(result.summary["wall_pressure_peak"])
    pycav.plot.histories(result).savefig("histories.png")

Everything is in SI units; z points from the solid into the fluid, stresses are positive in tension. Arrays that are handed
out are copies: changing one changes nothing else, and it may outlive what it came from.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

from ._pycav import CaseError, CouplingError, InternalError, NumericalError, OutputError, RunError

if TYPE_CHECKING:
    from . import plot, theory
    from ._animate import animate
    from .case import Case, Material, materials
    from ._convergence import Convergence, convergence
    from .cells import Cells
    from ._hits import hits
    from ._report import report
    from .new import collapse, free_bubble, laser_bubble, shocked_bubble, wall_load
    from .result import Result, Snapshot
    from .result import open_run as open
    from ._run import resume, run
    from ._runs import runs
    from .simulation import Simulation
    from .solvers import FluidSolver, SolidSolver
    from .exchange import units
    from .paraview import paraview_state
    from .sweeps import bends, consistent_runs, failures, refine, save_map, stand_off_map, sweep, with_uncertainty

    __version__: str

__all__ = [
    "Case", "CaseError", "Cells", "Convergence", "CouplingError", "FluidSolver", "InternalError", "Material", "NumericalError",
    "OutputError", "Result", "RunError", "Simulation", "Snapshot", "SolidSolver", "animate", "bends", "collapse",
    "consistent_runs", "convergence", "failures", "free_bubble", "hits", "laser_bubble", "materials", "open", "paraview_state",
    "plot", "refine", "report", "resume", "run", "runs", "save_map", "shocked_bubble", "stand_off_map", "sweep", "theory",
    "units", "wall_load", "with_uncertainty",
]

# Where names live. They are fetched when they are first used: the processes of a run need none of them.
_PLACES = {
    "Case": "case", "Cells": "cells", "Convergence": "_convergence", "FluidSolver": "solvers", "Material": "case", "Result": "result",
    "Simulation": "simulation", "Snapshot": "result", "SolidSolver": "solvers", "animate": "_animate",
    "bends": "sweeps", "collapse": "new", "consistent_runs": "sweeps", "convergence": "_convergence",
    "failures": "sweeps", "free_bubble": "new", "hits": "_hits", "laser_bubble": "new", "materials": "case", "open": "result",
    "paraview_state": "paraview", "refine": "sweeps", "report": "_report", "resume": "_run", "run": "_run", "runs": "_runs",
    "save_map": "sweeps", "shocked_bubble": "new", "stand_off_map": "sweeps", "sweep": "sweeps", "units": "exchange", "wall_load": "new",
    "with_uncertainty": "sweeps",
}


def __getattr__(name: str) -> Any:
    if name in ("plot", "theory"):
        return import_module(f".{name}", __name__)
    if name == "__version__":
        return import_module("importlib.metadata").version(__name__)
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = getattr(import_module(f".{_PLACES[name]}", __name__), "open_run" if name == "open" else name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return sorted({*__all__, *(name for name in globals() if name.startswith("__")), "__version__"})
