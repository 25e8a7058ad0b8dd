"""Planes through the neighbours on each side of a place."""

from __future__ import annotations

import numpy as np
import pytest

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.filters.side_planes import Sides
from bare_earth.algorithms.grids.cells import Cells


@pytest.fixture(scope="module")
def lowest() -> tuple[Points, Cells]:
    """The lowest points of cells of 2 m, with gaps."""
    random = np.random.default_rng(4)
    x, y = random.uniform(-30.0, 50.0, (2, 3000))
    kept = np.hypot(x, y) > 12.0
    points = Points(x[kept], y[kept], (0.1 * x + np.sin(y / 5.0))[kept])
    cells = Cells.over(points, 2.0)
    which = cells.lowest_points(points)
    return points.take(which), Cells.over(points.take(which), 2.0)


def test_neighbours_by_cell_are_those_of_a_tree(lowest: tuple[Points, Cells]) -> None:
    ground, cells = lowest
    places = Points(*np.random.default_rng(5).uniform(-29.0, 49.0, (2, 500)), np.zeros(500))
    by_tree, by_cell = (Sides(ground, 10.0, 1.0, given).planes(places) for given in (None, cells))
    assert np.isfinite(by_tree[0]).mean() > 0.9
    np.testing.assert_allclose(by_cell, by_tree, atol=1e-9)


def test_first_side_is_all_that_is_computed_where_it_is_enough(
    lowest: tuple[Points, Cells],
) -> None:
    places = lowest[0].take(slice(0, 200))
    sides = Sides(lowest[0], 10.0)
    rise, _ = sides.rises(places, own=True)

    def enough(_: slice, rise: np.ndarray, *plane: np.ndarray) -> np.ndarray:
        return rise > 0.0

    some, _ = sides.rises(places, own=True, enough=enough)
    is_enough = rise[:, 0] > 0.0
    assert 20 < np.count_nonzero(is_enough) < 180
    assert np.isnan(some[is_enough, 1:]).all()
    np.testing.assert_allclose(some[is_enough, 0], rise[is_enough, 0], atol=1e-9)
    np.testing.assert_array_equal(some[~is_enough], rise[~is_enough])
