"""Terrain models that respect breaklines, water and places without ground; the truth is known."""

import json
import re

import laspy
import numpy as np
import pytest
from runs import FAST, FAST_WORDS, Heard
from surveys import ORIGIN, cut, heights_of, write_points

from bare_earth import BareEarthError, classify, terrain
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.grids.lines import NearPlaces, along, inside_grid
from bare_earth.algorithms.survey.vector_files import read_lines
from benchmarks.scenes.simple import scatter

rasterio = pytest.importorskip("rasterio")
EAST, NORTH = ORIGIN[:2]
SIZE = 120.0


def _write(path, x, y, z):
    return write_points(path, x, y, z, 2)


def _raster(source, target, progress=None, **constraints):
    """Return the heights of a terrain model, and x and y of its cells."""
    terrain(source, dtm=target, progress=progress, **constraints)
    with rasterio.open(target) as raster:
        rows, columns = np.mgrid[: raster.height, : raster.width]
        x, y = (np.reshape(axis, rows.shape) for axis in raster.xy(rows.ravel(), columns.ravel()))
    return heights_of(target), x - EAST, y - NORTH


def _square(west, south, east, north):
    corners = [(west, south), (east, south), (east, north), (west, north)]
    return (np.add(corners, (EAST, NORTH)),)


def _line(*corners):
    return np.add(corners, (EAST, NORTH, 0.0))


@pytest.fixture
def wall(tmp_path):
    """A wall of 5 m between two levels, with a point on four square metres."""
    x, y = scatter(SIZE, 0.25, seed=2)
    z = np.where(x + 0.2 * y < 70.0, 10.0, 15.0)
    ends = [(70.0, 0.0), (70.0 - 0.2 * SIZE, SIZE)]
    lines = [_line(*((x + by, y, z) for x, y in ends)) for by, z in ((-0.02, 10.0), (0.02, 15.0))]
    return _write(tmp_path / "wall.laz", x, y, z), tuple(lines)


def test_no_triangle_crosses_a_breakline(wall, tmp_path):
    source, lines = wall

    def wrong(**constraints):
        found, x, y = _raster(source, tmp_path / "dtm.tif", **constraints)
        truth = np.where(x + 0.2 * y < 70.0, 10.0, 15.0)
        # But for cells that the wall cuts.
        away = np.abs(x + 0.2 * y - 70.0) > 0.8
        return np.nanmean(np.abs(found - truth)[away] > 0.05)

    assert wrong() > 0.01
    assert wrong(breaklines=lines) == 0.0


def test_a_breakline_without_heights_lies_on_the_ground_beside_it(wall, tmp_path):
    source, lines = wall
    line = np.column_stack((lines[0][:, :2] + (0.02, 0.0), np.full(2, np.nan)))
    found, x, y = _raster(source, tmp_path / "dtm.tif", breaklines=(line,))
    truth = np.where(x + 0.2 * y < 70.0, 10.0, 15.0)
    away = np.abs(x + 0.2 * y - 70.0) > 0.8
    assert np.nanmean(np.abs(found - truth)[away] > 0.05) < 0.001


@pytest.mark.rest(but="heights3-1 lie more than 10 m")
@pytest.mark.parametrize(
    ("heights", "told"),
    [((0.0, 0.0), r"2 of 2 .*2 are 0, .*10\.0 m"),
     ((-9999.0, 10.0), "1 stand"),
     ((10.0, -32768.0), "1 stand"), ((10.0, 800.0), "1 lie more than 10 m"),
     ((32.8, 32.8), r"2 lie more than 10 m.* 22\.8 m"),
     ((1e38, np.inf), "1 of 1 ")],
)  # fmt: skip
def test_heights_of_a_breakline_that_cannot_be_are_taken_from_the_ground(tmp_path, heights, told):
    x, y = scatter(SIZE, 1.0, seed=2)
    source = _write(tmp_path / "flat.laz", x, y, np.full(len(x), 10.01))
    progress = Heard()
    line = _line((20.0, 30.0, heights[0]), (100.0, 90.0, heights[1]))
    found, *_ = _raster(source, tmp_path / "dtm.tif", progress, breaklines=(line,))
    assert np.nanmax(np.abs(found - 10.01)) < 0.02
    assert re.search(told, progress.warnings[-1])


@pytest.mark.rest
def test_a_breakline_of_zeros_has_no_heights_on_low_land_either(tmp_path):
    x, y = scatter(SIZE, 1.0, seed=2)
    source = _write(tmp_path / "low.laz", x, y, np.full(len(x), 3.0))
    lines = [_line((20.0, 30.0, 0.0), (100.0, north, z)) for north, z in ((90.0, 0.0), (5.0, 0.3))]
    found, *_ = _raster(source, tmp_path / "dtm.tif", breaklines=lines[:1])
    assert np.nanmin(found) > 2.99
    found, *_ = _raster(source, tmp_path / "dtm.tif", breaklines=lines[1:])  # a ditch
    assert np.nanmin(found) < 0.5


def test_a_high_wall_and_a_breakline_far_from_the_ground_keep_their_heights(wall, tmp_path):
    source, lines = wall
    progress = Heard()
    top = lines[1] + (0.0, 0.0, 9.0)
    away = _line((SIZE + 15.0, 0.0, 0.0), (SIZE + 15.0, SIZE, 0.0))
    found, *_ = _raster(source, tmp_path / "dtm.tif", progress, breaklines=(top, away))
    assert not any("cannot be" in text for text in progress.warnings) and np.nanmax(found) > 20.0


def test_polygons_of_water_with_heights_of_0_have_the_level_of_their_banks(lake, tmp_path):
    (corners,) = _square(30.0, 30.0, 90.0, 90.0)
    rings = [[[*corner, 0.0] for corner in [*corners.tolist(), corners[0].tolist()]]]
    shape = {"type": "Polygon", "coordinates": rings}
    (tmp_path / "water.geojson").write_text(json.dumps(shape))
    found, x, y = _raster(lake, tmp_path / "dtm.tif", water=tmp_path / "water.geojson")
    inside = np.maximum(np.abs(x - 60.0), np.abs(y - 60.0)) < 29.0
    assert np.ptp(found[inside]) < 0.001 and abs(found[inside][0] - 20.0) < 0.1


@pytest.fixture
def lake(tmp_path):
    """A lake whose points are scattered by waves, between banks that rise by a tenth."""
    x, y = scatter(SIZE, 1.0, seed=4)
    away = np.maximum(np.abs(x - 60.0), np.abs(y - 60.0)) - 30.0
    z = 20.0 + 0.1 * np.maximum(away, 0.0)
    waves = np.random.default_rng(1).normal(0.0, 0.6, len(x))
    return _write(tmp_path / "lake.laz", x, y, np.where(away < 0.0, z + waves, z))


@pytest.mark.rest
def test_a_lake_is_flat_at_the_level_of_its_banks(lake, tmp_path):
    shore = _square(30.0, 30.0, 90.0, 90.0)
    found, x, y = _raster(lake, tmp_path / "dtm.tif", water=(shore,))
    inside = np.maximum(np.abs(x - 60.0), np.abs(y - 60.0)) < 29.0
    assert np.ptp(found[inside]) < 0.001 and abs(found[inside][0] - 20.0) < 0.1
    plain, *_ = _raster(lake, tmp_path / "plain.tif")
    assert np.ptp(plain[inside]) > 1.0
    outside = np.maximum(np.abs(x - 60.0), np.abs(y - 60.0)) > 33.0
    assert np.allclose(found[outside], plain[outside], atol=0.03, equal_nan=True)


@pytest.mark.rest
def test_ignored_ground_along_the_shore_gives_the_level_but_no_terrain(tmp_path):
    # Banks rise by one half, so that ground 2 m away is 1 m too high for the level.
    x, y = scatter(SIZE, 4.0, seed=5)
    away = np.maximum(np.abs(x - 60.0), np.abs(y - 60.0)) - 30.0
    dry = away > 0.0
    x, y, away = x[dry], y[dry], away[dry]
    source = _write(tmp_path / "banks.laz", x, y, 20.0 + 0.5 * away)
    las = laspy.read(source)
    las.classification[away < 2.0] = 20
    las.write(str(source))
    shore = _square(30.0, 30.0, 90.0, 90.0)
    found, x, y = _raster(source, tmp_path / "dtm.tif", water=(shore,))
    away = np.maximum(np.abs(x - 60.0), np.abs(y - 60.0)) - 30.0
    assert np.ptp(found[away < -1.0]) < 0.001 and abs(found[away < -1.0][0] - 20.0) < 0.2
    # A line gets its height from ground alone, of which there is none here within 2 m of it.
    line = np.insert(_line((40.0, 29.0, 0.0), (80.0, 29.0, 0.0))[:, :2], 2, np.nan, axis=1)
    found, x, y = _raster(source, tmp_path / "line.tif", breaklines=(line,))
    along = found[(np.abs(y - 29.0) < 0.6) & (x > 45.0) & (x < 75.0)]
    assert np.all(along > 20.9)


@pytest.mark.rest
def test_points_of_class_9_in_the_water_decide_its_level(tmp_path):
    """The banks of this canal are 1 m above the water, and fall; a few returns are far below it."""
    x, y = scatter(SIZE, 1.0, seed=6)
    wet = np.abs(y - 60.0) < 10.0
    z = np.where(wet, 7.0, 8.0 + 0.01 * x)
    z[np.flatnonzero(wet)[::40]] -= 3.0
    classes = np.where(wet, 9, 2)
    source, tiles = tmp_path / "canal.laz", tmp_path / "tiles"
    write_points(source, x, y, z, classes)
    tiles.mkdir()
    for name, part in (("west", x < 61.7), ("east", x >= 61.7)):
        write_points(tiles / f"{name}.laz", x[part], y[part], z[part], classes[part])
    water, river = _square(0, 50, SIZE, 70), _line((2, 60, 0), (118, 60, 0))
    for rivers in ((), (river,)):
        how = {"water": (water,), "rivers": rivers}
        found, east, north = _raster(source, tmp_path / "dtm.tif", **how)
        inside = (np.abs(north - 60.0) < 9.0) & (np.abs(east - 60.0) < 55.0)
        assert np.abs(found[inside] - 7.0).max() < 0.01
        np.testing.assert_array_equal(_raster(tiles, tmp_path / "tiles.tif", **how)[0], found)


@pytest.mark.rest
def test_an_island_stays(lake, tmp_path):
    shore = (*_square(30.0, 30.0, 90.0, 90.0), *_square(50.0, 50.0, 70.0, 70.0))
    found, x, y = _raster(lake, tmp_path / "dtm.tif", water=(shore,))
    island = np.maximum(np.abs(x - 60.0), np.abs(y - 60.0)) < 9.0
    assert np.ptp(found[island]) > 0.5


@pytest.mark.rest
def test_each_branch_of_a_river_falls_along_its_own_line(tmp_path):
    x, y = scatter(SIZE, 1.0, seed=5)
    main, branch = np.abs(y - 30.0) - 10.0, np.maximum(np.abs(x - 60.0) - 8.0, 30.0 - y)
    away = np.minimum(main, branch)
    level = np.where(branch < main, 19.0 + 0.03 * (y - 30.0), 20.0 - 0.016 * x)
    level = np.where(np.abs(y - 30.0) < 25.0, 20.0 - 0.016 * x, level)
    wet = away < 0.0
    source = _write(tmp_path / "fork.laz", *(axis[~wet] for axis in (x, y, level + 0.2 * away)))
    ring = [(1, 20), (119, 20), (119, 40), (68, 40), (68, 119), (52, 119), (52, 40), (1, 40)]
    rivers = (
        _line((1.0, 30.0, 0.0), (119.0, 30.0, 0.0)), _line((60.0, 118.0, 0.0), (60.0, 38.0, 0.0))
    )  # fmt: skip
    bed = (np.add(ring, (EAST, NORTH)),)
    found, x, y = _raster(
        source,
        tmp_path / "dtm.tif",
        water=(bed,),
        rivers=rivers,
    )
    head = (np.abs(x - 60.0) < 3.0) & (np.abs(y - 110.0) < 3.0)
    assert np.abs(found[head] - 21.4).max() < 0.2
    for place in (10.0, 110.0):
        there = (np.abs(x - place) < 3.0) & (np.abs(y - 30.0) < 5.0)
        assert np.abs(found[there] - (20.0 - 0.016 * place)).max() < 0.2


def test_the_level_of_a_river_steps_at_a_weir(tmp_path):
    x, y = scatter(SIZE, 1.0, seed=5)
    across = np.abs(y - 60.0)
    z = np.where(x < 64.0, 22.0, 20.0) + 0.2 * np.maximum(across - 10.0, 0.0)
    source = _write(tmp_path / "weir.laz", *(axis[across > 10.0] for axis in (x, y, z)))
    river = _line((1.0, 60.0, 0.0), (SIZE - 1.0, 60.0, 0.0))
    bed = _square(1.0, 50.0, SIZE - 1.0, 70.0)
    found, x, y = _raster(source, tmp_path / "dtm.tif", water=(bed,), rivers=(river,))
    wet = np.abs(y - 60.0) < 8.0
    assert np.abs(found[wet & (x > 5.0) & (x < 54.0)] - 22.0).max() < 0.15
    assert np.abs(found[wet & (x > 74.0) & (x < 115.0)] - 20.0).max() < 0.15


@pytest.mark.rest(but="False")
@pytest.mark.parametrize("down", [True, False])
def test_a_river_falls_along_its_line_and_is_level_across(tmp_path, down):
    x, y = scatter(SIZE, 1.0, seed=5)
    across = np.abs(y - 60.0)
    z = 30.0 - 0.05 * x + 0.2 * np.maximum(across - 10.0, 0.0)
    z = np.where(across < 10.0, z + np.random.default_rng(2).normal(0, 0.5, len(x)), z)
    source = _write(tmp_path / "river.laz", x, y, z)
    line = [(1.0, 60.0, 0.0), (SIZE - 1.0, 60.0, 0.0)]
    river = _line(*(line if down else line[::-1]))
    bed = _square(1.0, 50.0, SIZE - 1.0, 70.0)
    found, x, y = _raster(source, tmp_path / "dtm.tif", water=(bed,), rivers=(river,))
    inside = (np.abs(y - 60.0) < 9.0) & (x > 4.0) & (x < SIZE - 4.0)
    assert np.nanmax(np.abs(found - (30.0 - 0.05 * x))[inside]) < 0.45
    middle = found[np.argmin(np.abs(y[:, 0] - 60.0))]
    middle = middle[(x[0] > 4.0) & (x[0] < SIZE - 4.0)]
    assert (np.diff(middle) < 0.01).all() and middle[0] - middle[-1] > 4.0
    columns = found[(np.abs(y[:, 0] - 60.0) < 8.0)][:, 20:100]
    assert np.nanmax(np.ptp(columns, axis=0)) < 0.6


def test_where_there_is_no_ground_the_terrain_is_that_round_about(tmp_path):
    x, y = scatter(SIZE, 1.0, seed=6)
    roof = (np.abs(x - 60.0) < 10.0) & (np.abs(y - 60.0) < 10.0)
    source = _write(tmp_path / "roof.laz", x, y, np.where(roof, 12.0, 5.0))
    polygon = _square(49.0, 49.0, 71.0, 71.0)
    found, *_ = _raster(source, tmp_path / "dtm.tif", no_ground=(polygon,))
    assert np.nanmax(np.abs(found - 5.0)) < 1e-3
    everywhere = _square(-1.0, -1.0, SIZE + 1, SIZE + 1)
    with pytest.raises(BareEarthError, match="water or without ground"):
        _raster(source, tmp_path / "none.tif", no_ground=(everywhere,))


@pytest.mark.rest
def test_many_files_give_the_raster_of_one(wall, tmp_path):
    source, lines = wall
    las = laspy.read(source)
    points = np.column_stack((las.X // 10, las.Y // 10, las.Z // 10)).astype(np.int64)
    cut(tmp_path / "many", points, 6)
    cut(tmp_path / "one", points, 2)
    known = dict(breaklines=lines, water=(_square(10.0, 10.0, 30.0, 30.0),))
    rasters = []
    for folder in ("many", "one"):
        for path in (tmp_path / folder).iterdir():
            part = laspy.read(path)
            part.classification[:] = 2
            part.write(str(path))
        rasters.append(_raster(tmp_path / folder, tmp_path / f"{folder}.tif", **known)[0])
    assert np.array_equal(*rasters, equal_nan=True)


@pytest.mark.rest
@pytest.mark.parametrize("how", ["one", pytest.param("parts", marks=pytest.mark.long), "many"])
def test_a_run_that_classifies_makes_the_terrain_of_what_it_writes(tmp_path, how):
    # A lake with points on it, in a slope; a wall that a line knows.
    x, y = scatter(SIZE, 1.0, seed=4)
    z = 10.0 + 0.05 * x + np.where(y > 80.0, 4.0, 0.0)
    source = _write(tmp_path / "in.laz", x, y, z)
    known = {
        "breaklines": (_line((0.0, 80.0, np.nan), (SIZE, 80.0, np.nan)),),
        "water": (_square(20.0, 20.0, 60.0, 50.0),),
    }
    # With a surface, so that the rasters reach as far as all points in both runs.
    once, again = (
        {name: tmp_path / f"{name}-{run}.tif" for name in ("dtm", "dsm")} for run in range(2)
    )
    if how == "many":
        cloud = laspy.read(source)
        integers = np.column_stack((cloud.X, cloud.Y, cloud.Z)) // 10
        source, target = cut(tmp_path / "tiles", integers, 4), tmp_path / "out"
    else:
        target = tmp_path / "out.laz"
    memory, progress = 0.001 if how == "parts" else None, Heard()
    classify(source, target, memory=memory, progress=progress, **FAST, **once, **known)
    assert any("fit into the memory" in text for text in progress.infos) == bool(memory)
    terrain(target, **again, **known)
    assert once["dtm"].read_bytes() == again["dtm"].read_bytes()
    with rasterio.open(once["dtm"]) as raster:
        south, west = raster.index(EAST + 22.0, NORTH + 22.0)
        north, east = raster.index(EAST + 58.0, NORTH + 48.0)
        lake = raster.read(1)[north:south, west:east]
        above, below = (
            next(raster.sample([(EAST + 40.5, NORTH + north)]))[0] for north in (80.9, 79.1)
        )
    assert lake.size > 500 and np.ptp(lake) < 1e-3
    assert above - below > 3.9


def test_a_run_without_rasters_takes_no_lines(wall, tmp_path):
    source, lines = wall
    with pytest.raises(BareEarthError, match="Choose a raster"):
        classify(source, tmp_path / "out.laz", breaklines=lines)


@pytest.mark.rest
def test_the_terrain_command_takes_files_of_lines_and_polygons(wall, tmp_path, capsys):
    source, lines = wall
    features = [
        {
            "type": "Feature",
            "geometry": {"type": "LineString", "coordinates": line.tolist()},
            "properties": {},
        }
        for line in lines
    ]
    collection = {"type": "FeatureCollection", "features": features}
    (tmp_path / "lines.geojson").write_text(json.dumps(collection))
    expected, *_ = _raster(source, tmp_path / "expected.tif", breaklines=lines)
    words = ["terrain", str(source), "--dtm", str(tmp_path / "dtm.tif")]
    assert main([*words, "--breaklines", str(tmp_path / "lines.geojson")]) == 0
    assert np.array_equal(heights_of(tmp_path / "dtm.tif"), expected, equal_nan=True)
    files = [str(source), str(tmp_path / "out.laz"), "--dtm", str(tmp_path / "once.tif")]
    known = ["--dsm", str(tmp_path / "dsm.tif"), "--breaklines", str(tmp_path / "lines.geojson")]
    assert main(["classify", *files, *FAST_WORDS, *known]) == 0
    assert main(["terrain", *files[1:2], "--dtm", str(tmp_path / "again.tif"), *known]) == 0
    assert (tmp_path / "once.tif").read_bytes() == (tmp_path / "again.tif").read_bytes()
    assert main([*words, "--water", str(tmp_path / "lines.geojson")]) == 1
    assert re.search(r"lines\.geojson .*no polygon", capsys.readouterr().err)


def test_lines_far_from_any_ground_are_told(wall, tmp_path):
    source, _ = wall
    line = _line((900.0, 900.0, np.nan), (950.0, 900.0, np.nan))
    progress = Heard()
    _raster(
        source, tmp_path / "dtm.tif", progress,
        breaklines=(line, _line((9.0, 9.0, 10.0), (19.0, 9.0, 10.0))),
        water=(_square(800.0, 800.0, 850.0, 850.0), _square(20.0, 20.0, 30.0, 30.0)),
    )  # fmt: skip
    assert any("Breaklines left out: 1." in text for text in progress.warnings)
    assert any("not flattened: 1" in text for text in progress.warnings)


@pytest.mark.parametrize(
    ("kind", "coordinates", "shapes"),
    [
        ("LineString", [[0, 0], [1, 1]], [(2, False)]),
        ("LineString", [[0, 0, 5], [1, 1, 6], [2, 2, 7]], [(3, True)]),
        ("MultiLineString", [[[0, 0], [1, 1]], [[2, 2], [3, 3], [4, 4]]], [(2, False), (3, False)]),
    ],
)
def test_lines_of_a_file(kind, coordinates, shapes, tmp_path):
    path = tmp_path / "a.geojson"
    path.write_text(json.dumps({"type": kind, "coordinates": coordinates}))
    lines = read_lines(path)
    assert [(len(line), bool(np.isfinite(line[:, 2]).all())) for line in lines] == shapes


def test_places_along_a_line_are_no_farther_apart_than_the_step():
    line = np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 10.0], [3.0, 4.0, 10.0], [9.0, 4.0, np.nan]])
    places = along(line, 0.7)
    assert np.hypot(*np.diff(places[:, :2], axis=0).T).max() <= 0.7 + 1e-12
    first = places[:8]
    assert np.allclose(first[:, 2], 2.0 * np.hypot(first[:, 0], first[:, 1]))
    ring = along(line[:2], 0.5, is_closed=True)
    assert np.array_equal(ring[0], ring[-1])


def test_places_inside_lie_at_multiples_of_the_step():
    found = inside_grid((-1.2, 3.0, 2.5, 4.6), 0.5)
    x, y = np.arange(-2, 6) * 0.5, np.arange(6, 10) * 0.5
    assert found.tolist() == [[west, south] for south in y for west in x]


def test_near_places_are_those_of_the_squares_round_a_place():
    near = NearPlaces(np.array([0.5, 100.0]), np.array([0.5, -3.5]), 2.0)
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(-20, 120) / 1.0, np.arange(-20, 20)))
    expected = np.zeros(len(x), dtype=bool)
    for at_x, at_y in ((0.5, 0.5), (100.0, -3.5)):
        column, row = np.floor(x / 2.0) - np.floor(at_x / 2.0), np.floor(y / 2.0) - at_y // 2.0
        expected |= (np.abs(column) <= 1) & (np.abs(row) <= 1)
    assert np.array_equal(near.of(x, y), expected)
