"""Pictures of all snapshots: images of fields without blur, and lines over them."""

from __future__ import annotations

import base64
import io
from collections.abc import Iterable, Sequence
from typing import Any

import contourpy
import numpy as np
from PIL import Image

from ..mesh import Box, Floats, Raster
from ..plot.plastic import FIELD as STRAIN
from .._numbers import prefix, rounded
from ..result import Result, Snapshot
from .fields import Quantity, quantities
from .scales import Scale, Steps
from .views import View, events, first, view

BUDGET = 4_000_000
"""Bytes of all images before they are written as text, which takes a third more."""
MOST = 560
"""Pixels of an image along a side, at most; it is half of the picture, the other half its mirror image."""
LEAST = 96
FRAMES = 120
"""So many snapshots are shown at most."""
GRID = 4000
"""Steps along the longer side of what is shown in which lines are written."""


def viewer(result: Result) -> dict[str, Any]:
    """All that the viewer of the page draws: fields, frames, lines, scales, the view and moments to go to."""
    shown, kinds = view(result), quantities(result)
    media = list(shown.boxes)
    all_times = result.snapshots(media[0]).times
    steps = np.unique(np.linspace(0, len(all_times) - 1, min(len(all_times), FRAMES)).round().astype(int))
    times = [float(all_times[step]) for step in steps]
    snapshots = {medium: [result.snapshots(medium).at(time) for time in times] for medium in media}
    scales = _scales(kinds, snapshots, shown)
    most = MOST
    while True:
        images = {kind.name: [_image(kind, scales[kind.name], snapshot, shown.boxes[kind.medium], most)
                              for snapshot in snapshots[kind.medium]] for kind in kinds}
        size = sum(len(image["data"]) for row in images.values() for image in row) * 3 // 4
        if size <= BUDGET or most <= LEAST:
            break
        most = max(LEAST, min(int(0.95 * most * (BUDGET / size) ** 0.5), most - 16))
    start, why = first(times, events(result))
    extent = _extent(shown)
    scale, letter = prefix(max(abs(end) for end in extent))
    return {
        "extent": extent, "wall": shown.wall, "mirrored": shown.mirrored, "length": {"factor": scale, "unit": f"{letter}m"},
        "times": times, "of": len(all_times), "first": start, "why": why,
        "moments": [{"label": label, "time": time} for time, label in sorted(events(result))],
        "media": [{"name": medium, "box": shown.boxes[medium],
                   "fields": [_field(kind, scales[kind.name], images[kind.name]) for kind in kinds if kind.medium == medium],
                   "lines": _lines(result, medium, snapshots[medium], shown)} for medium in media],
    }


def _extent(shown: View) -> Box:
    """z from, z to, r from, r to of all that is shown."""
    boxes = shown.boxes.values()
    right = max(box[3] for box in boxes)
    return (min(box[0] for box in boxes), max(box[1] for box in boxes), -right if shown.mirrored else min(box[2] for box in boxes), right)


def _field(kind: Quantity, scale: Scale, images: Sequence[dict[str, Any]]) -> dict[str, Any]:
    return {
        "name": kind.name, "label": kind.label, "unit": kind.unit, "dark": kind.dark, "images": images,
        "colours": "".join(f"{r:02x}{g:02x}{b:02x}" for r, g, b in scale.colours.tolist()),
        "values": [float(f"{value:.4g}") for value in scale.values], "marks": scale.marks,
    }


def _scales(kinds: Iterable[Quantity], snapshots: dict[str, list[Snapshot]], shown: View) -> dict[str, Scale]:
    """One scale for all times, so that colours can be compared; the ends leave out the strongest thousandth of the area."""
    kinds = list(kinds)
    ends: dict[str, tuple[float, float]] = {}
    for kind in kinds:
        low, high = ends.get(kind.shares or kind.name, (np.inf, -np.inf))
        for snapshot in snapshots[kind.medium]:
            raster = Raster(snapshot.mesh, shown.boxes[kind.medium], 200)
            bottom, top = np.nanpercentile(raster.paint(kind.values(snapshot)), [0.1, 99.9])
            low, high = min(low, float(bottom)), max(high, float(top))
        ends[kind.shares or kind.name] = (low, high)
    return {kind.name: kind.scale(ends[kind.shares or kind.name]) for kind in kinds}


def _image(kind: Quantity, scale: Scale, snapshot: Snapshot, box: Box, most: int) -> dict[str, Any]:
    """A field of a snapshot as PNG, z upwards, and where it lies: z from, z to, r from, r to in m."""
    raster = Raster(snapshot.mesh, box, most)
    picture = scale.paint(raster.paint(kind.values(snapshot)).T[::-1])
    where = (raster.low[0], raster.high[0], raster.low[1], raster.high[1])
    return {"data": _png(picture, scale), "box": [float(f"{end:.9g}") for end in where]}


def _png(picture: Steps, scale: Scale) -> str:
    """An image with the palette of a scale, in base 64."""
    image = Image.frombytes("P", (picture.shape[1], picture.shape[0]), picture.tobytes())
    image.putpalette(scale.colours.tobytes())
    buffer = io.BytesIO()
    image.save(buffer, "png", optimize=True)
    return base64.b64encode(buffer.getvalue()).decode()


def _lines(result: Result, medium: str, snapshots: Sequence[Snapshot], shown: View) -> list[dict[str, Any]]:
    """Lines over the fields: the bubble's outline; where a solid has flowed, or, if it is elastic, would yield."""
    if medium == "fluid":
        if "gas_fraction" not in result.fluid.fields:
            return []
        wanted = [("bubble", "bubble, φ = ½", "gas_fraction", 0.5)]
    elif STRAIN in result.solid.fields:
        wanted = [("flowed", "plastic strain 0.01 %", STRAIN, 1e-4), ("flowed strong", "0.2 %", STRAIN, 2e-3)]
    elif (strength := result.summary.get("yield_strength")) is not None and "von_mises" in result.solid.fields:
        wanted = [("yields", f"yield strength {rounded(float(strength), 'Pa')}", "von_mises", float(strength))]
    else:
        return []
    return [{"kind": kind, "label": label,
             "paths": [_outline(snapshot, field, level, shown.boxes[medium], shown.mirrored, _extent(shown)) for snapshot in snapshots]}
            for kind, label, field, level in wanted]


def _outline(snapshot: Snapshot, field: str, level: float, box: Box, mirrored: bool, extent: Box) -> str:
    """The line of a level as a path in `GRID` steps, r to the right from the axis, z downwards from the top of all that is shown."""
    values = snapshot[field]
    if not values.min() < level < values.max():
        return ""
    raster = Raster(snapshot.mesh, box, 400)
    image = raster.paint(values, snapshot.mesh.linear(values)).T
    r = raster.r
    if mirrored:  # as a whole, so that it crosses the axis without a kink
        image, r = np.hstack([image[:, ::-1], image]), np.concatenate([-r[::-1], r])
    if min(image.shape) < 2:
        return ""
    step = max(extent[1] - extent[0], extent[3] - extent[2]) / GRID
    lines = [np.asarray(line, float) for line in contourpy.contour_generator(r, raster.z, image).lines(level)]
    return "".join(_path(np.column_stack([line[:, 0], extent[1] - line[:, 1]]) / step) for line in lines if len(line) > 3)


def _path(points: Floats) -> str:
    """A line as an SVG path of whole steps."""
    places = np.rint(points).astype(int)
    moves = np.diff(places, axis=0)
    moves = moves[(moves != 0).any(1)]
    closed = "z" if np.allclose(points[0], points[-1]) else ""
    return f"M{places[0, 0]} {places[0, 1]}l" + " ".join(f"{x} {y}" for x, y in moves) + closed if len(moves) else ""
