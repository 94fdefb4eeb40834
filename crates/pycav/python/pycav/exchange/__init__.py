"""Runs for other programs: xarray, NetCDF, pint, meshio."""

from .quantities import units

__all__ = ["units"]
