"""Fields linear within cells: exact where they can be, and no value that no cell has."""

from __future__ import annotations

import numpy as np
import pytest

from pycav.mesh import Mesh, Raster


def uniform(count: int = 8) -> Mesh:
    """Cells of 1 m in a square at the axis."""
    corner = np.stack(np.meshgrid(np.arange(count), np.arange(count), indexing="ij"), -1).reshape(-1, 2).astype(float)
    return Mesh(corner, corner + 1.0)


def refined() -> Mesh:
    """The same with a quarter of the cells cut in four."""
    corner = np.stack(np.meshgrid(np.arange(8), np.arange(8), indexing="ij"), -1).reshape(-1, 2).astype(float)
    cut = (corner < 4).all(1)
    fine = np.concatenate([corner[cut] + [a, b] for a in (0.0, 0.5) for b in (0.0, 0.5)])
    return Mesh(np.concatenate([corner[~cut], fine]), np.concatenate([corner[~cut] + 1.0, fine + 0.5]))


@pytest.mark.parametrize("mesh", [uniform(), refined()], ids=["uniform", "refined"])
def test_bounds_leave_a_linear_field_alone(mesh):
    """A bound by the cell's own value, or by the neighbours' without half a cell to the corner, would flatten it."""
    points = np.random.default_rng(7).uniform(1.0, 7.0, (4000, 2))
    for slope in ([3.0, 0.0], [0.0, -2.0], [1.0, 1.0], [5.0, -5.0], [-0.3, 4.0]):
        exact = 11.0 + points @ slope
        assert mesh.sample(11.0 + mesh.centre() @ slope, points) == pytest.approx(exact, abs=1e-12), slope


def test_next_to_a_jump_no_value_is_beyond_those_of_the_cells():
    mesh = refined()
    at = mesh.centre()
    values = np.where(np.hypot(at[:, 0] - 4.0, at[:, 1]) < 2.3, 0.03, 1000.0 + at[:, 0])
    points = np.random.default_rng(8).uniform(0.0, 8.0, (4000, 2))
    found, free = mesh.sample(values, points), mesh.sample(values, points, bounded=False)
    assert found.min() == values.min() and found.max() == values.max()
    assert free.min() < -100.0 and (found == free).mean() > 0.5
    raster = Raster(mesh, (0.0, 8.0, 0.0, 8.0), 100)
    image = raster.paint(values, mesh.linear(values))
    assert image.min() >= values.min() and image.max() <= values.max()
    assert raster.paint(values, mesh.linear(values, bounded=False)).min() < -100.0
    # Beyond the axis lies the mirror image: a component falls on to zero there and is not cut off.
    radial = at[:, 1].copy()
    below = np.array([[1.3, 0.01], [1.3, -0.01]])
    assert mesh.sample(radial, below, -1) == pytest.approx([0.01, -0.01], abs=1e-12)


def test_a_plane_that_reaches_below_0_has_no_mirror_image():
    corner = np.stack(np.meshgrid(np.arange(8), np.arange(-4, 4), indexing="ij"), -1).reshape(-1, 2).astype(float)
    mesh = Mesh(corner, corner + 1.0)
    at = mesh.centre()
    values = at[:, 1] * 3.0
    points = np.random.default_rng(9).uniform([1.0, -3.0], [7.0, 3.0], (1000, 2))
    assert mesh.sample(values, points) == pytest.approx(3.0 * points[:, 1], abs=1e-12)
    inner = (np.abs(at - [4.0, 0.0]) < 3.0).all(1)
    assert mesh.gradient(values)[inner] == pytest.approx(np.tile([0.0, 3.0], (inner.sum(), 1)), abs=1e-12)
