"""Pictures of runs, as matplotlib figures of publication size.

Every function takes a `pycav.Result` (or the path of a run directory) and returns a `matplotlib.figure.Figure`; times are in
s, windows `(z_low, z_high, r_high)` in m. Without a time the snapshot nearest to the largest von Mises stress is drawn, or
to the largest wall pressure. Sections show the solid and the fluid side by side, mirrored about the axis. Colour maps are
perceptually uniform and safe for the colour-blind.
"""

from .across import interface_continuity
from .close_up import close_up
from .convergence import convergence
from .damage import damage_map, sweep_lines
from .flow import pathlines, streamlines
from .maps import pit_map, stand_off_map
from .overtime import histories, space_time
from .overview import overview
from .pit import pit
from .plastic import plastic_strain
from .refinement import grid_levels
from .section import Window, default_time
from .volume import volume
from .waves import schlieren
from .yielding import yield_function

__all__ = [
    "Window", "close_up", "convergence", "damage_map", "default_time", "grid_levels", "histories", "interface_continuity", "overview",
    "pathlines", "pit", "pit_map", "plastic_strain", "schlieren", "space_time", "stand_off_map", "streamlines", "sweep_lines", "volume",
    "yield_function",
]
