"""What of rows over r is on the axis."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray


def on_axis(rows: xr.DataArray) -> NDArray[np.float64]:
    """The column of rows over r, as of ``interface/pressure``, that is on the axis: of the cell from r = 0 on, or the nearest to it."""
    r = rows[rows.dims[-1]].to_numpy()
    # A cell about r = 0 may have a centre that round-off has moved.
    column = int(np.searchsorted(r, -1e-9 * np.abs(r).max()))
    return np.asarray(rows.to_numpy()[..., min(column, len(r) - 1)], float)
