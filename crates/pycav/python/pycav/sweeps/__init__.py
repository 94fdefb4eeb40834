"""Maps: a case at every point of a grid of parameters, what was measured there, and how sure it is.

The package has another name than its main function, `pycav.sweep`: a module of that name would take the function's place.
"""

from .dataset import save_map
from .refinement import bends, refine
from .runs import consistent_runs, failures, stand_off_map, sweep
from .uncertainty import with_uncertainty

__all__ = ["bends", "consistent_runs", "failures", "refine", "save_map", "stand_off_map", "sweep", "with_uncertainty"]
