"""The cells of a medium at one time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from ._given import among

Array = NDArray[np.float64]


class Cells(Mapping[str, Array]):
    """Fields on the leaf cells of a mesh, as arrays of shape (cells,) that are the caller's own.

    Attributes, all of shape (cells,): `z`, `r` (centres, m), `width_z`, `width_r` (m), `area` (in the section, m²),
    `level` (of refinement). As a mapping: the fields by name. Fluid: `density` (kg/m³), `pressure` (Pa), `velocity_z`,
    `velocity_r` (m/s), `gas_fraction`, `schlieren` (kg/m⁴). Solid: `velocity_z`, `velocity_r`, `stress_zz`, `stress_zr`,
    `stress_rr`, `stress_phiphi`, `von_mises` (Pa); where it can yield `plastic_strain`, `plastic_strain_rate` (1/s), `displacement_z`,
    `displacement_r` (m), and with a law that has heat `temperature` (K).
    """

    def __init__(self, columns: dict[str, Array], time: float) -> None:
        columns = dict(columns)
        self.time = time
        """s"""
        self.z: Array = columns.pop("z")
        self.r: Array = columns.pop("r")
        self.width_z: Array = columns.pop("width_z")
        self.width_r: Array = columns.pop("width_r")
        self.area: Array = columns.pop("area")
        self.level: NDArray[np.uint8] = np.asarray(columns.pop("level"), np.uint8)
        self._fields = columns

    def __getitem__(self, name: str) -> Array:
        if name not in self._fields:
            raise KeyError(f"the cells have no field {name!r}: {among(name, self._fields)}")
        return self._fields[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._fields)

    def __len__(self) -> int:
        return len(self._fields)

    def __repr__(self) -> str:
        return f"<pycav.Cells: {self.z.size} cells at {self.time:.6g} s, {', '.join(self._fields)}>"
