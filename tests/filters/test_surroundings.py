"""Points far from a block are thinned, and decide about its points as all of them do."""

import numpy as np
import pytest
from surveys import classes_of, cut, finished, points_of, write

import bare_earth
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.engine.store import BlockPoints
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.stages.noise import noise_of_squares
from bare_earth.algorithms.grids.cells import Cells, spacing
from bare_earth.algorithms.tools.ground import step
from bare_earth.algorithms.tools.ground.labelling import blocks_of, near, report_spacing, thinned

BOX = near((0.0, 0.0, 100.0, 100.0))


def contents(count=200_000, seed=1):
    random = np.random.default_rng(seed)
    points = Points(*random.uniform(-150.0, 250.0, (2, count)), random.normal(0.0, 1.0, count))
    known, wanted = np.zeros((2, count), dtype=bool)
    known[:: count // 50] = True
    return BlockPoints(points, known, wanted, np.arange(count))


@pytest.mark.rest
def test_near_points_known_ground_and_the_lowest_of_cells_stay():
    whole = contents(500_000)
    west, south, east, north = BOX
    x, y, z = whole.points
    close = (x >= west) & (x < east) & (y >= south) & (y < north)
    left = thinned(whole, BOX)
    assert set(np.flatnonzero(close | whole.known)) <= set(left.positions)
    assert left.points.count < 0.8 * whole.points.count
    # The lowest point of each cell of 1 m and 0.5 m is still there.
    for side in (0.5, 1.0):
        column, row = (np.floor(axis / side).astype(np.int64) for axis in (x, y))
        cell = 10_000 * row + column
        order = np.lexsort((z, cell))
        lowest = order[np.diff(cell[order], prepend=cell.min() - 1) > 0]
        assert set(lowest) <= set(left.positions)


def test_nothing_is_thinned_where_all_points_are_near():
    whole = contents(1000)
    assert thinned(whole, (-200.0, -200.0, 300.0, 300.0)) is whole


def test_the_spacing_is_that_of_the_points_that_are_not_thinned():
    left = thinned(contents(1_000_000), BOX).points
    assert spacing(Points(*left), 0.01) == pytest.approx(0.5)
    report_spacing(left, BOX)
    assert spacing(left, 0.01) == pytest.approx(0.354, abs=0.001)


def village(side=112.0, density=3.0):
    random = np.random.default_rng(4)
    x, y = random.uniform(0.0, side, (2, int(density * side**2)))
    z = 60.0 + 3.0 * np.sin(x / 40.0) + 2.0 * np.sin(y / 25.0) + random.normal(0, 0.03, len(x))
    z[(x % 45 < 12) & (y % 35 < 10)] += 6.0
    trees = random.random(len(x)) < 0.1
    z[trees] += random.uniform(1.0, 9.0, trees.sum())
    return np.round(np.column_stack((x, y, z)) * 100).astype(np.int64)


@pytest.mark.rest
@pytest.mark.parametrize("method", ["grid-minimum", "tin-densification"])
def test_blocks_with_thinned_surroundings_give_the_labels_of_the_whole(
    tmp_path, monkeypatch, method
):
    integers, usual = village(), blocks_of(METHODS[method].parameters())
    source = write(tmp_path / "in.las", integers)
    assert usual.buffer > 100.0
    bare_earth.classify(source, tmp_path / "whole.las", method=method)
    monkeypatch.setattr(step, "blocks_of", lambda parameters: Blocks(75.0, usual.buffer))
    bare_earth.classify(source, tmp_path / "blocks.las", method=method)
    whole, blocks = (classes_of(tmp_path / f"{name}.las") for name in ("whole", "blocks"))
    assert np.count_nonzero(blocks != whole) < 1e-4 * len(whole)
    if method == "grid-minimum":
        files = cut(tmp_path / "files", integers, 4)
        bare_earth.classify(files, tmp_path / "out", method=method)
        found = points_of(finished(tmp_path / "out"))
        assert np.array_equal(found, points_of([tmp_path / "blocks.las"]))


def test_the_noise_is_that_of_points_that_are_not_thinned():
    whole = contents(500_000)
    left = thinned(whole, BOX).points
    inside = left.take(left.within(BOX))
    assert noise_in(left) != noise_in(inside)  # the lowest points of cells scatter less
    report_spacing(left, BOX)
    assert noise_in(left) == noise_in(inside) > 0.2


def noise_in(points):
    cells = Cells.over(points, 1.0)
    level = np.zeros(cells.shape)
    return noise_of_squares(points, cells, level, (level, level))
