"""The profile of a place to review: its line, and the points along it from files of any kind."""

import numpy as np
import pytest
from surveys import write_classified, write_points

from bare_earth.algorithms.survey.files import Inputs
from bare_earth.algorithms.tools.review.places import PlaceToReview, Rasters
from bare_earth.algorithms.tools.review.profile import line_of, points_along

OFFSET = (500_000.0, 5_600_000.0, 0.0)


@pytest.fixture(scope="module")
def clouds(tmp_path_factory):
    """Return the paths of a plane that rises to the east, with a roof, as LAZ, COPC and tiles."""
    folder = tmp_path_factory.mktemp("profile")
    random = np.random.default_rng(3)
    x, y = random.uniform(0, 120, (2, 40_000))
    roof = (x > 50) & (x < 70) & (y > 50) & (y < 60)
    z, classes = 100.0 + 0.1 * x + np.where(roof, 8.0, 0.0), np.where(roof, 6, 2)
    whole, tiles = folder / "whole.laz", folder / "tiles"
    write_points(whole, x, y, z, classes, offset=OFFSET)
    tiles.mkdir()
    for name, some in (("west", x < 60), ("east", x >= 60)):
        write_points(tiles / f"{name}.laz", x[some], y[some], z[some], classes[some], offset=OFFSET)
    copc = folder / "whole.copc.laz"
    write_classified(whole, copc, classes.astype(np.uint8))
    return {"laz": whole, "copc": copc, "tiles": tiles}


def _lines(*ends):
    return np.array(ends) + np.tile(OFFSET[:2], 2)


@pytest.mark.parametrize("kind", ["laz", "copc", "tiles"])
def test_points_along_lines_have_distance_height_and_class(clouds, kind):
    lines = _lines((30, 55, 90, 55), (60, 100, 60, 20), (10, 10, 40, 40), (900, 900, 950, 900))
    across, down, diagonal, outside = points_along(Inputs(clouds[kind]), lines, width=2.0)
    # 2.78 points in a square metre.
    assert abs(len(across.along) - 333) < 60 and len(outside.along) == 0
    assert across.along.min() >= 0 and across.along.max() <= 60
    roof = (across.along > 20.1) & (across.along < 39.9)
    assert (across.classes[roof] == 6).all() and (across.classes[~roof] == 2).mean() > 0.98
    ground = across.classes == 2
    np.testing.assert_allclose(across.heights[ground], 103 + 0.1 * across.along[ground], atol=0.002)
    assert (np.diff(down.along) >= 0).all()
    near = np.abs(down.along - 45) < 4.9  # y from 50 to 60 is 40 to 50 m from the northern end
    assert (down.classes[near] == 6).all()
    np.testing.assert_allclose(diagonal.heights, 101 + 0.1 * diagonal.along / np.sqrt(2), atol=0.11)


def test_points_along_are_the_same_from_every_kind_of_file(clouds):
    lines = _lines((30, 55, 90, 55), (60, 100, 60, 20))
    found = [points_along(Inputs(path), lines) for path in clouds.values()]
    for others in found[1:]:
        for one, other in zip(found[0], others):
            assert all(np.array_equal(*pair) for pair in zip(one, other))


@pytest.mark.parametrize("turned", [False, True])
def test_the_line_crosses_the_step_of_the_terrain(turned):
    terrain = np.full((100, 100), 50.0, dtype=np.float32)
    terrain[:, 60:] = 53.0  # a step from north to south
    cells = np.ones((30, 8), dtype=bool)
    window, worst = (slice(30, 60), slice(56, 64)), (45, 60)
    if turned:
        terrain, cells, window, worst = terrain.T, cells.T, window[::-1], worst[::-1]
    rasters = Rasters(np.ones_like(terrain), terrain, None, 1.0)
    place = PlaceToReview(window, cells, 240.0, worst, 1.0, 240.0, 50.0, 53.0, "a step")
    start, end = line_of(rasters, place)
    along = end - start
    assert np.hypot(*along) >= 30
    steep = abs(along[0]) / np.hypot(*along)
    assert steep > 0.8 if turned else steep < 0.6
    # It reaches some 15 m beyond the place on both sides, and goes through the worst cell.
    side = 0 if turned else 1
    assert min(start[side], end[side]) < 45 and max(start[side], end[side]) > 74
    apart = along[0] * (worst[1] - start[1]) - along[1] * (worst[0] - start[0])
    assert abs(apart) < 1e-6 * np.hypot(*along) ** 2


def test_without_a_terrain_model_the_line_is_the_shortest_across():
    cells = np.ones((60, 6), dtype=bool)
    place = PlaceToReview(
        (slice(20, 80), slice(40, 46)), cells, 1.0, (50, 42), 1.0, 360.0, 0, 0, ""
    )
    rasters = Rasters(np.ones((100, 100), dtype=np.float32), None, None, 0.5)
    start, end = line_of(rasters, place)
    assert abs(start[0] - end[0]) < 1e-6 and abs(end[1] - start[1]) * 0.5 >= 30


@pytest.mark.parametrize("seed", [0, 3, 39, 45])
def test_the_line_is_the_same_wherever_the_raster_begins(seed):
    terrain = 50.0 + 3.0 * (np.random.default_rng(seed).random((80, 80)) > 0.995)
    lines = []
    for more in (0, 1, 30):
        wider = np.pad(terrain, ((more, 0), (more, 0)), constant_values=np.nan)
        rasters = Rasters(np.ones_like(wider), wider, None, 1.0)
        window, worst = (slice(10 + more, 14 + more),) * 2, (12 + more, 11 + more)
        place = PlaceToReview(window, np.ones((4, 4), dtype=bool), 1.0, worst, 1.0, 16.0, 0, 0, "")
        lines.append(line_of(rasters, place) - more)
    np.testing.assert_allclose(lines, [lines[0]] * 3, atol=1e-9)
