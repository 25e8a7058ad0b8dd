"""A corridor at 45 degrees: the cells beside it, by far the most, are not looked up."""

from __future__ import annotations

import numpy as np
import pytest

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.grids.cell_window import CellWindow
from bare_earth.algorithms.tin.surface import Surface
from bare_earth.algorithms.tin.triangulation import Tin
from bare_earth.algorithms.tools.rasters.block import LayerMaker
from bare_earth.algorithms.tools.rasters.block_view import BlockView


@pytest.fixture()
def corridor() -> Points:
    """Points on a plane, 800 m long and 20 m wide."""
    random = np.random.default_rng(2)
    along, across = random.uniform(0.0, 800.0, 6000), random.uniform(-10.0, 10.0, 6000)
    x, y = (along - across) / np.sqrt(2.0), (along + across) / np.sqrt(2.0)
    return Points(x, y, 100.0 + 0.1 * x - 0.2 * y)


@pytest.fixture()
def looked_up(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """How many places were looked up in triangulations, call by call."""
    counts, locate = [], Tin.locate

    def counted(tin: Tin, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        counts.append(len(x))
        return locate(tin, x, y)

    monkeypatch.setattr(Tin, "locate", counted)
    return counts


def test_surface_looks_up_only_places_in_its_hull(corridor: Points, looked_up: list[int]) -> None:
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0.5, 560.0), np.arange(0.5, 560.0)))
    heights = Surface(corridor).heights(x, y)
    inside = np.isfinite(heights)
    np.testing.assert_allclose(heights[inside], (100.0 + 0.1 * x - 0.2 * y)[inside], atol=1e-6)
    assert 14_000 < np.count_nonzero(inside) < 17_000
    assert sum(looked_up) < 20_000


def test_surface_model_looks_up_only_cells_near_points(
    corridor: Points, looked_up: list[int]
) -> None:
    nothing, everything = np.zeros(6000, dtype=bool), np.ones(6000, dtype=bool)
    view = BlockView(corridor, nothing, everything, everything, (0.0, 0.0))
    found = LayerMaker(1.0, ("surface",)).of(view, (-20.0, -20.0, 600.0, 600.0))
    heights = found.layers["surface"]
    x, y = np.meshgrid(*CellWindow(*found.window).centres(1.0))
    inside = np.isfinite(heights)
    assert np.count_nonzero(inside) > 14_000
    # The highest point of a cell lies up to half a cell beside its centre.
    assert np.abs(heights - (100.0 + 0.1 * x - 0.2 * y))[inside].max() < 0.16
    assert sum(looked_up) < 20_000
