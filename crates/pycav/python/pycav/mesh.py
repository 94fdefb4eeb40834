"""Meshes of rectangles that are leaves of a quadtree, painted onto regular rasters.

The sides of every cell are those of the finest cell times a power of two.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

CHUNK = 1 << 20  # cells worked on at once

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Box = tuple[float, float, float, float]
"""z from, z to, r from, r to, m"""


class Linear(NamedTuple):
    """A field that is linear within cells: what `Mesh.linear` returns of some of them."""

    slope: Floats
    """d/dz, d/dr, shape (cells, 2)"""
    low: Floats
    """Least value of the cell and of its neighbours, shape (cells,); −∞ without bounds"""
    high: Floats
    """Largest one, likewise"""

    def at(self, values: Floats, z: Floats, r: Floats, own: Any = slice(None)) -> Floats:
        """The field at the distances `z` and `r` from the centres of the cells `own`, whose means are `values`."""
        found = values + z * self.slope[own][..., 0] + r * self.slope[own][..., 1]
        return np.asarray(np.clip(found, self.low[own], self.high[own]))


class Mesh:
    """Rectangles that are leaves of a tree: `depth` 0 are the finest, a cell of depth k is 2^k times as wide."""

    def __init__(self, low: Floats, high: Floats) -> None:
        size = high - low
        self.low, self.high = low.min(0), high.max(0)  # (z, r) of the domain
        self.finest = size.min(0)
        # A domain that reaches below r = 0 is a plane of which both halves are there.
        self.mirrored = bool(self.low[1] >= -0.5 * self.finest[1])
        ratio = np.log2(size / self.finest)
        self.depth = np.rint(ratio[:, 0]).astype(np.int64)
        # Corners as whole numbers of cells of the same size, counted from the domain's corner.
        place = (low - self.low) / (self.finest * 2.0 ** self.depth[:, None])
        self.index = np.rint(place).astype(np.int64)
        if np.abs(ratio - self.depth[:, None]).max() > 1e-3 or np.abs(place - self.index).max() > 1e-2:
            raise ValueError("the cells are no leaves of one tree")
        self.levels: list[tuple[int, int, Ints, Ints]] = []  # depth, row length, sorted keys, cells in the order of the keys
        for depth in np.unique(self.depth):
            cells = np.flatnonzero(self.depth == depth)
            row = int(np.ceil((self.high - self.low)[1] / (self.finest[1] * 2.0**depth) - 1e-6))
            keys = self.index[cells, 0] * row + self.index[cells, 1]
            order = np.argsort(keys)
            self.levels.append((int(depth), row, keys[order], cells[order]))

    def __len__(self) -> int:
        return len(self.depth)

    def width(self, cells: Any = slice(None)) -> Floats:
        """Widths (z, r) of cells, m, shape (cells, 2)."""
        return np.asarray(self.finest * 2.0 ** self.depth[cells, None])

    def centre(self, cells: Any = slice(None)) -> Floats:
        """Centres (z, r) of cells, m, shape (cells, 2)."""
        return np.asarray(self.low + (self.index[cells] + 0.5) * self.width(cells))

    def locate(self, points: Floats) -> Ints:
        """The cell that holds each point (z, r); -1 outside."""
        found = np.full(len(points), -1)
        left = np.flatnonzero(((points >= self.low) & (points < self.high)).all(1))
        for depth, row, keys, cells in self.levels:
            if len(left) == 0:
                break
            i, j = np.floor((points[left] - self.low) / (self.finest * 2.0**depth)).astype(np.int64).T
            wanted = i * row + j
            at = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
            hit = (keys[at] == wanted) & (j < row)
            found[left[hit]] = cells[at[hit]]
            left = left[~hit]
        return found

    def gradient(self, values: Floats, parity: int = 1, cells: Any = None) -> Floats:
        """The gradient (d/dz, d/dr) in `cells` (default: all), exact for linear fields, by least squares over the
        neighbours, two to a side so that two finer ones count alike. Beyond r = 0 lies the field's mirror image: itself
        with `parity` 1, its negative with -1.
        """
        return self.linear(values, parity, cells).slope

    def linear(self, values: Floats, parity: int = 1, cells: Any = None, bounded: bool = True) -> Linear:
        """The field linear within `cells` (default: all), with the slopes of `gradient`.

        - `bounded`: no further than the values of the cell and its neighbours. Beside gas a liquid would else have densities and
          pressures below those of any cell, and below 0. A linear field stays itself, but for the outer half of cells at a side of
          the domain, where there is no neighbour. `False` for components of vectors and of stresses, which have either sign.
        """
        cells = np.arange(len(self)) if cells is None else np.asarray(cells)
        slope, (low, high) = np.empty((len(cells), 2)), np.empty((2, len(cells)))
        for start in range(0, len(cells), CHUNK):
            part = slice(start, start + CHUNK)
            slope[part], low[part], high[part] = self._linear(values, parity, cells[part])
        return Linear(slope, low, high) if bounded else Linear(slope, np.full(len(cells), -np.inf), np.full(len(cells), np.inf))

    def _linear(self, values: Floats, parity: int, cells: Ints) -> Linear:
        centre, width, own = self.centre(cells), self.width(cells), values[cells]
        zz, zr, rr, z, r = np.zeros((5, len(cells)))
        low, high = own, own
        for axis, side, across in [(a, s, c) for a in (0, 1) for s in (-1, 1) for c in (-1, 1)]:
            point = centre.copy()
            point[:, axis] += side * 0.5 * (width + self.finest)[:, axis]
            point[:, 1 - axis] += across * 0.25 * width[:, 1 - axis]
            beyond = (point[:, 1] < 0.0) & self.mirrored
            point[beyond, 1] *= -1.0
            other = self.locate(point)
            to = self.centre(other)
            to[beyond, 1] *= -1.0
            step = np.where(other >= 0, (to - centre).T, 0.0)
            there = np.where(other >= 0, np.where(beyond, parity, 1) * values[other], own)
            change = there - own
            low, high = np.minimum(low, there), np.maximum(high, there)
            zz, zr, rr = zz + step[0] * step[0], zr + step[0] * step[1], rr + step[1] * step[1]
            z, r = z + step[0] * change, r + step[1] * change
        determinant = np.maximum(zz * rr - zr * zr, np.finfo(float).tiny)
        slope = np.column_stack([(rr * z - zr * r) / determinant, (zz * r - zr * z) / determinant])
        return Linear(slope, low, high)

    def sample(self, values: Floats, points: Floats, parity: int = 1, bounded: bool = True) -> Floats:
        """Values at points (z, r), linear within each cell; mirrored beyond r = 0 where the domain ends there (see `gradient`); NaN outside.

        - `bounded`: no further than the values of the cell and its neighbours, see `linear`. Give `False` for components.
        """
        sign = np.where((points[:, 1] < 0.0) & self.mirrored, parity, 1)
        points = np.column_stack([points[:, 0], np.abs(points[:, 1])]) if self.mirrored else points
        cells = self.locate(points)
        inside = np.flatnonzero(cells >= 0)
        at = cells[inside]
        result = np.full(len(points), np.nan)
        off = points[inside] - self.centre(at)
        result[inside] = sign[inside] * self.linear(values, parity, at, bounded).at(values[at], off[:, 0], off[:, 1])
        return result


class Raster:
    """A window of a mesh in square pixels: a finest cell, or 2^m of them where that would give more than `most` pixels
    along a side. Painting is exact: a pixel within a cell has its value, a pixel of several cells their mean.
    """

    def __init__(self, mesh: Mesh, window: Box, most: int) -> None:
        self.mesh = mesh
        low = np.maximum([window[0], window[2]], mesh.low)
        high = np.minimum([window[1], window[3]], mesh.high)
        cells = ((high - low) / mesh.finest).max()
        fold = max(0, int(np.ceil(np.log2(max(cells, 1) / most))))
        self.pixel = mesh.finest * 2.0**fold
        first = np.floor((low - mesh.low) / self.pixel + 1e-6).astype(np.int64)
        last = np.ceil((high - mesh.low) / self.pixel - 1e-6).astype(np.int64)
        self.shape = tuple(np.maximum(last - first, 1))
        self.low = mesh.low + first * self.pixel
        self.high = self.low + self.shape * self.pixel
        self.z, self.r = (self.low[a] + (np.arange(self.shape[a]) + 0.5) * self.pixel[a] for a in (0, 1))
        # Cells as wide as a pixel or wider: which cell a pixel lies in, level by level.
        self.cell = np.full(self.shape, -1)
        for depth, _, _, level in mesh.levels:
            if depth < fold:
                continue
            i, j = ((np.arange(n) + f) >> (depth - fold) for n, f in zip(self.shape, first))
            index = mesh.index[level] - [i[0], j[0]]
            here = ((index >= 0) & (index <= [i[-1] - i[0], j[-1] - j[0]])).all(1)
            grid = np.full((i[-1] - i[0] + 1, j[-1] - j[0] + 1), -1)
            grid[tuple(index[here].T)] = level[here]
            painted = grid[np.ix_(i - i[0], j - j[0])]
            self.cell = np.where(painted >= 0, painted, self.cell)
        # Narrower ones: which pixel a cell lies in, and its share of it.
        narrow = np.flatnonzero(mesh.depth < fold)
        up = fold - mesh.depth[narrow]
        pixel = (mesh.index[narrow] >> up[:, None]) - first
        here = ((pixel >= 0) & (pixel < self.shape)).all(1)
        self.narrow, pixel = narrow[here], pixel[here]
        self.pixel_of_narrow = pixel[:, 0] * self.shape[1] + pixel[:, 1]
        self.share = 0.25 ** up[here]

    def paint(self, values: Floats, linear: Linear | None = None) -> Floats:
        """The values as an image: rows along r, columns along z. With `linear` = mesh.linear(values), pixels within a
        cell follow it."""
        image = np.where(self.cell >= 0, values[self.cell].astype(float), np.nan)
        if linear is not None:
            centre = self.mesh.centre(self.cell.ravel()).reshape(*self.shape, 2)
            image = linear.at(image, self.z[:, None] - centre[..., 0], self.r[None, :] - centre[..., 1], self.cell)
        if len(self.narrow):
            count = self.shape[0] * self.shape[1]
            total = np.bincount(self.pixel_of_narrow, self.share * values[self.narrow], count)
            covered = np.bincount(self.pixel_of_narrow, self.share, count)
            mean = np.divide(total, covered, out=np.full(count, np.nan), where=covered > 0).reshape(self.shape)
            image = np.where(self.cell >= 0, image, mean)
        return np.asarray(image.T)
