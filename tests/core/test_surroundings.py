"""Points far from a block are thinned, and decide about its points as all of them do."""

import dataclasses

import numpy as np
import pytest
from runs import memory_store
from surveys import cloud_of

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.engine.store import BlockPoints
from bare_earth.algorithms.filters.grid_minimum import GridMinimum
from bare_earth.algorithms.filters.tin import TinDensification
from bare_earth.algorithms.grids.cells import spacing
from bare_earth.algorithms.las.cloud import survey_frame
from bare_earth.algorithms.tools.ground.labelling import blocks_of, label_ground
from bare_earth.algorithms.tools.ground.surroundings import near, tell_spacing, thinned

BOX = near((0.0, 0.0, 100.0, 100.0))


def contents(count=200_000, seed=1):
    random = np.random.default_rng(seed)
    points = Points(*random.uniform(-150.0, 250.0, (2, count)), random.normal(0.0, 1.0, count))
    known, wanted, roads, several = np.zeros((4, count), dtype=bool)
    known[:: count // 50] = True
    return BlockPoints(points, known, wanted, np.arange(count), roads, several)


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
    tell_spacing(left, BOX)
    assert spacing(left, 0.01) == pytest.approx(0.354, abs=0.001)


def village(side=155.0, density=5.0):
    random = np.random.default_rng(4)
    x, y = random.uniform(0.0, side, (2, int(density * side**2)))
    z = 60.0 + 3.0 * np.sin(x / 40.0) + 2.0 * np.sin(y / 25.0) + random.normal(0, 0.03, len(x))
    z[(x % 45 < 12) & (y % 35 < 10)] += 6.0
    trees = random.random(len(x)) < 0.1
    z[trees] += random.uniform(1.0, 9.0, trees.sum())
    return cloud_of(*(np.rint(each * 100) for each in (x, y, z)))


def labels(cloud, parameters, blocks, parts=1):
    pieces = np.array_split(np.argsort(cloud.y, kind="stable"), parts)
    store = memory_store(
        [
            (
                dataclasses.replace(
                    cloud,
                    **{
                        name: value[piece]
                        for name, value in vars(cloud).items()
                        if isinstance(value, np.ndarray)
                    },
                ),
                np.ones(len(piece), dtype=bool),
            )
            for piece in pieces
        ],
        survey_frame(cloud.crs),
        blocks,
    )
    label_ground(store, parameters, blocks)
    found = np.empty(cloud.count, dtype=np.uint8)
    for number, piece in enumerate(pieces):
        found[piece] = store.values(number)
    return found


@pytest.mark.parametrize(("parameters", "files"), [(GridMinimum(), 3), (TinDensification(), 1)])
def test_blocks_with_thinned_surroundings_give_the_labels_of_the_whole(parameters, files):
    cloud, usual = village(), blocks_of(parameters)
    blocks = Blocks(75.0, usual.buffer)
    assert usual.buffer > 100.0
    whole, cut = (labels(cloud, parameters, each) for each in (usual, blocks))
    if files > 1:
        assert np.array_equal(cut, labels(cloud, parameters, blocks, files))
    assert np.count_nonzero(cut != whole) < 1e-4 * cloud.count
