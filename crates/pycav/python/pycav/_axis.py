"""What of rows over r is on the axis."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray


def on_axis(rows: xr.DataArray) -> NDArray[np.float64]:
    """The column of rows over r, as of ``interface/pressure``, that is on the axis: of the cell with r = 0, or the nearest to it."""
    r = rows[rows.dims[-1]].to_numpy()
    # Cells are of equal width. Of one that ends at r = 0 the centre is half a width below it, but for round-off.
    half = 0.499999 * (r[1] - r[0]) if len(r) > 1 else 0.0
    column = int(np.searchsorted(r, -half))
    return np.asarray(rows.to_numpy()[..., min(column, len(r) - 1)], float)
