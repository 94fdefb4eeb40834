"""Snapshots as files of other programs: meshio's formats, and a series for ParaView."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import meshio

    from ..result import Snapshot, Snapshots


def mesh(snapshot: Snapshot) -> meshio.Mesh:
    """A snapshot as meshio has it: quadrilaterals, x is z, y is r, all fields as data of the cells."""
    try:
        import meshio
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("this needs meshio: pip install 'pycav[mesh]'") from error
    points, quads = snapshot.geometry()
    return meshio.Mesh(points, [("quad", quads)], cell_data={name: [snapshot[name]] for name in snapshot.fields},
                       field_data={"time": [snapshot.time]})


def export(snapshot: Snapshot, path: str | os.PathLike[str]) -> Path:
    """Writes a snapshot in the format that the file's ending names, one of meshio's."""
    target = Path(path)
    target.parent.mkdir(parents=True, exist_ok=True)
    own = mesh(snapshot)
    if target.suffix == ".vtu":
        own.field_data = {}  # the format has none; it would only warn
    own.write(target)
    return target


def series(snapshots: Snapshots, directory: str | os.PathLike[str]) -> Path:
    """Writes every snapshot as `.vtu` and beside them a collection with their times, `MEDIUM.pvd`, which every ParaView opens."""
    root = Path(directory)
    names = [f"{snapshots.medium}-{step:04d}.vtu" for step in range(len(snapshots))]
    for snapshot, name in zip(snapshots, names):
        export(snapshot, root / name)
    rows = [f'    <DataSet timestep="{float(time)!r}" part="0" file="{name}"/>' for time, name in zip(snapshots.times, names)]
    target = root / f"{snapshots.medium}.pvd"
    target.write_text("\n".join(['<?xml version="1.0"?>', '<VTKFile type="Collection" version="0.1">', "  <Collection>", *rows,
                                 "  </Collection>", "</VTKFile>", ""]))
    return target
