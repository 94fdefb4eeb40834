"""Numbers with their units, as pint has them."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import xarray

if TYPE_CHECKING:
    from ..result import Result

ENGINEERING = {
    "Pa": "MPa", "m": "mm", "s": "us", "m3": "mm3", "m/s": "m/s", "kg/m3": "g/cm3", "Pa s": "Pa s", "N": "N", "J": "J", "N s": "mN s",
    "kg": "mg", "J/m3": "J/mm3", "m2": "mm2", "N s/m": "mN s/m", "kg/m": "mg/m",
}
"""What engineers write for the units of a run; others stay."""
SMALL = ("pit_", "film_thickness", "displacement")
"""Lengths whose names begin like this are in micrometres."""
SYSTEMS = ("SI", "engineering")


def units(
    data: Result | xarray.Dataset | xarray.DataArray,
    system: str = "SI",
) -> Any:
    """A run, a map or one variable with units that count: pint's, through pint-xarray.

        run = pycav.units(result)
        run["bubble/equivalent_radius"].max().pint.to("mm")

    - `data`: a `Result`, whose histories it then is, a dataset or a variable of pycav.
    - `system`: `"SI"`, or `"engineering"`: MPa, mm, µs, mm³, g/cm³, depths of pits and displacements in µm.

    Needs pint and pint-xarray: `pip install 'pycav[units]'`.
    """
    if system not in SYSTEMS:
        raise ValueError(f"system is {' or '.join(SYSTEMS)}, not {system!r}")
    try:
        import pint_xarray
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("units need pint and pint-xarray: pip install 'pycav[units]'") from error
    found: Any = data if isinstance(data, (xarray.Dataset, xarray.DataArray)) else data.histories
    # Variables that are no numbers, as errors and directories, have no units and stay what they are.
    registry = pint_xarray.unit_registry
    quantified = found.pint.quantify(_told(found), unit_registry=registry)
    if system == "SI":
        return quantified
    if isinstance(found, xarray.DataArray):
        wanted = _engineering(str(found.name), found.attrs.get("units"))
        return quantified.pint.to(registry.Unit(pint_unit(wanted))) if wanted else quantified
    chosen = {name: registry.Unit(pint_unit(wanted)) for name, variable in found.variables.items()
              if (wanted := _engineering(str(name), variable.attrs.get("units")))}
    return quantified.pint.to(chosen)


def _told(data: Any) -> Any:
    if isinstance(data, xarray.DataArray):
        own = {data.name: pint_unit(data.attrs["units"])} if "units" in data.attrs else {}
        return own | {name: pint_unit(variable.attrs["units"]) for name, variable in data.coords.items() if variable.attrs.get("units")}
    return {name: pint_unit(variable.attrs["units"]) for name, variable in data.variables.items() if variable.attrs.get("units")}


def _engineering(name: str, unit: str | None) -> str | None:
    last = re.split(r"[/.]", name)[-1]
    if unit == "m" and last.startswith(SMALL) and last != "pit_radius":
        return "um"
    return ENGINEERING.get(unit or "")


def pint_unit(text: str) -> str:
    """A unit of a run's files as pint reads it: kg/m3 is kg/m**3, J/rad stays, a space multiplies."""
    if text.strip() in ("", "1"):
        return "dimensionless"
    raised = re.sub(r"(?<=[A-Za-z])(-?\d+)", r"**\1", text)
    return re.sub(r"\s+", "*", raised.strip())
