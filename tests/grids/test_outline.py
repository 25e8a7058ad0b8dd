"""Rasters end where the survey ends, and their outermost cells are as good as the inner ones."""

import itertools
import json
import os
import pickle

import numpy as np
import pytest
from matrices import quick
from runs import FAST_WORDS, said
from scipy import ndimage
from scipy.spatial import cKDTree
from surveys import ORIGIN, cut, write

import bare_earth
from bare_earth.algorithms.engine import blocks as blocks_module
from bare_earth.algorithms.grids import outline as outline_module
from bare_earth.algorithms.grids.canopy import without_pits
from bare_earth.algorithms.grids.morphology import closing
from bare_earth.algorithms.grids.outline import Discs, Outline, Span, spans, with_gaps_inside
from bare_earth.algorithms.tools.rasters.rows import RASTERS

rasterio = pytest.importorskip("rasterio")


# On arrays


def _blobs(shape, share, seed=0):
    noise = ndimage.gaussian_filter(np.random.default_rng(seed).normal(size=shape), 3.0)
    return noise > np.quantile(noise, 1.0 - share)


def _reader(cells):
    """Return a function that reads spans of cells; those beyond are False."""

    def read(span):
        found = np.zeros(span.shape, dtype=bool)
        start, end, first, last = span.within(cells.shape)
        if start < end and first < last:
            inside = (
                slice(start - span.start, end - span.start),
                slice(first - span.first, last - span.first),
            )
            found[inside] = cells[start:end, first:last]
        return found

    return read


@pytest.fixture
def small_strips(monkeypatch):
    monkeypatch.setattr(outline_module, "_CELLS_A_SPAN", 1)
    monkeypatch.setattr(outline_module, "_ROWS", 4)
    monkeypatch.setattr(outline_module, "_COLUMNS", 16)


@pytest.fixture
def small_squares(small_strips, monkeypatch):
    monkeypatch.setattr(outline_module, "_WIDE", 1)
    monkeypatch.setattr(outline_module, "_SIDE", 16)


@pytest.mark.parametrize("size", ["small_strips", "small_squares"])
@pytest.mark.parametrize("share", [0.1, 0.3, 0.5, 0.6, 0.8])
@pytest.mark.parametrize("seed", range(3))
def test_gaps_inside_are_those_that_no_way_leads_out_of(request, size, share, seed):
    request.getfixturevalue(size)
    cells = _blobs((90, 70), share, seed)
    read = []

    def reader(span):
        read.append(span)
        return _reader(cells)(span)

    def holds(span):
        return cells[span.start : span.end, span.first : span.last].any()

    found = with_gaps_inside(reader, cells.shape, holds=holds)
    assert len(read) == sum(map(holds, spans(cells.shape)))
    expected = ndimage.binary_fill_holes(cells)
    assert np.array_equal(found.cells(Span(0, 90, 0, 70)), expected)
    assert expected.sum() > cells.sum() or share < 0.5
    # Any part of it, also beyond the raster.
    part = np.pad(expected, 10)[10 - 3 : 10 + 33, 10 + 5 : 10 + 41]
    assert np.array_equal(found.cells(Span(-3, 33, 5, 41)), part)


def test_the_closing_is_that_of_scipy():
    cells = _blobs((80, 60), 0.4)
    across = np.arange(-6, 7)
    disc = across[:, None] ** 2 + across**2 <= 6.0**2
    expected = ndimage.binary_closing(np.pad(cells, 20), disc)[20:-20, 20:-20]
    assert np.array_equal(closing(cells, 6.0), expected) and expected.sum() > cells.sum()


@pytest.mark.parametrize("radius", [9.0, 90.0])
def test_spans_give_the_closing_of_the_whole_wherever_the_raster_begins(radius):
    cells = np.zeros((300, 280), dtype=bool)
    cells[tuple(np.random.default_rng(1).integers(60, 200, (2, 400)))] = True
    whole = Discs(_reader(cells), (1000, 700), radius, radius)
    expected = whole.cells(Span(0, 300, 0, 280))
    assert expected[60:200, 60:200].mean() > 0.2 and not expected[:30].any()
    for start, first in itertools.product(range(0, 300, 37), range(0, 280, 41)):
        span = Span(start, min(start + 37, 300), first, min(first + 41, 280))
        found = expected[span.start : span.end, span.first : span.last]
        assert np.array_equal(whole.cells(span), found)
    # 13 rows and 21 columns less.
    less = Discs(_reader(cells[13:, 21:]), (1000 - 13, 700 + 21), radius, radius)
    assert np.array_equal(less.cells(Span(0, 287, 0, 259)), expected[13:, 21:])


def test_an_outline_of_a_large_raster_takes_little_memory():
    outline = Outline((1024, 20_000))
    for span in spans(outline.shape):
        row, x = np.ogrid[span.start : span.end, span.first : span.last]
        outline.set(span, np.hypot(row - 500.0, (x - 10_000.0) / 20.0) < 500.0)
    assert len(pickle.dumps(outline)) < 50_000
    assert outline.cells(Span(500, 501, 0, 20_000)).sum() == 19_999


# On points


def _height(x, y):
    """Return a hillside with ridges, which rises to the middle of its southern border."""
    return 300.0 + 0.35 * y - ((x - 400.0) / 60.0) ** 2 + 3.0 * np.sin(x / 25.0) * np.cos(y / 31.0)


def _write(path, x, y, z, classes=2):
    integers = np.round(np.column_stack((x, y, z)) * 100).astype(np.int64)
    return write(path, integers, classes=classes)


def _terrain(folder, sources, cell=2.0, names=("dtm",), **options):
    folder.mkdir(exist_ok=True)
    files = {name: folder / f"{name}.tif" for name in names}
    bare_earth.terrain(sources, **files, dtm_cell_size=cell, **options)
    return [_values(path) for path in files.values()]


def _values(path):
    """Return values, and x and y of the cells relative to the origin."""
    with rasterio.open(path) as raster:
        values = raster.read(1, masked=True).astype(float).filled(np.nan)
        rows, columns = np.mgrid[: raster.height, : raster.width]
        x, y = raster.xy(rows.ravel(), columns.ravel())
    shape = values.shape
    return values, np.reshape(x, shape) - ORIGIN[0], np.reshape(y, shape) - ORIGIN[1]


def _ring(known):
    return known & ~ndimage.binary_erosion(known, np.ones((3, 3)))


@pytest.fixture(scope="module")
def hillside(tmp_path_factory):
    """Four adjoining tiles of 200 m by 100 m on a hillside, and the same points as one file."""
    folder = tmp_path_factory.mktemp("hillside")
    x, y = np.random.default_rng(4).uniform((200.0, 0.0), (600.0, 200.0), (37_500, 2)).T
    z = _height(x, y) + np.random.default_rng(5).normal(0.0, 0.03, len(x))
    _write(folder / "one.laz", x, y, z)
    (folder / "four").mkdir()
    for number in range(4):
        tile = (x // 200.0 - 1 + 2 * (y // 100.0)).astype(int) == number
        _write(folder / "four" / f"{number}.laz", x[tile], y[tile], z[tile])
    return folder


@pytest.mark.parametrize("cell", quick([0.5, 1.0, 3.0], 3.0))
def test_the_outermost_cells_of_tiles_on_a_slope_are_as_good_as_the_others(
    hillside, tmp_path, cell
):
    ((found, x, y),) = _terrain(tmp_path / "rasters", [hillside / "four"], cell=cell)
    wrong, known = np.abs(found - _height(x, y)), np.isfinite(found)
    ring = _ring(known)
    inner = ndimage.binary_erosion(known, iterations=4)
    rms = [np.sqrt(np.mean(wrong[which] ** 2)) for which in (ring, inner)]
    assert rms[0] < 1.5 * rms[1]
    assert wrong[ring].max() < 0.6
    # Nearly all cells with points have a height: no frame is cut off.
    inside = (x > 200 + 0.5 * cell) & (x < 600 - cell) & (y > 0.5 * cell) & (y < 200 - cell)
    assert known[inside].mean() > 0.985
    ((one, _, _),) = _terrain(tmp_path / "one", hillside / "one.laz", cell=cell)
    assert np.array_equal(one, found, equal_nan=True)


@pytest.mark.long
def test_the_rasters_of_two_tiles_of_a_forest_have_sound_borders_and_no_seam(tmp_path):
    pytest.importorskip("lazrs")
    import laspy
    from realdata import real

    from bare_earth.algorithms.core.points import Points
    from bare_earth.algorithms.tin.triangulation import Tin

    paths = [real("real/conifer_1.laz"), real("real/conifer_2.laz")]
    dtm = tmp_path / "dtm.tif"
    whole = [laspy.read(path) for path in paths]
    # What lies within 60 m of the line between the tiles is enough.
    middle = whole[1].header.mins[1]
    for number, las in enumerate(whole):
        paths[number] = tmp_path / f"{number}.laz"
        near = las.points[np.abs(np.asarray(las.y) - middle) < 60.0].copy()
        laspy.LasData(las.header, near).write(paths[number])
    assert said("classify", *paths, tmp_path / "out", "--dtm", dtm, *FAST_WORDS)[0] == 0
    tiles = [laspy.read(path) for path in paths]
    corner = np.min([tile.header.mins for tile in tiles], axis=0)
    ground = [np.asarray(tile.xyz)[np.asarray(tile.classification) == 2] for tile in tiles]
    found, x, y = _values(dtm)
    x, y = x + ORIGIN[0] - corner[0], y + ORIGIN[1] - corner[1]
    reference = Tin(*Points(*(np.concatenate(ground) - corner).T))
    wrong = found - corner[2] - reference.interpolate(x.ravel(), y.ravel()).reshape(x.shape)
    compared = np.isfinite(wrong)
    ring, inner = (
        np.sqrt(np.mean(wrong[which & compared] ** 2))
        for which in (
            _ring(np.isfinite(found)),
            ndimage.binary_erosion(np.isfinite(found), iterations=4),
        )
    )
    assert ring < 1.5 * inner
    seam = np.abs(y - (tiles[1].header.mins[1] - corner[1])) < 3.0
    seam &= (x > 5.0) & (x < x.max() - 15.0)
    assert np.isfinite(found[seam]).mean() > 0.97
    assert np.sqrt(np.mean(wrong[seam & compared] ** 2)) < 1.5 * inner


def _cloud(folder, keep, trees=True, side=300.0):
    """Write ground and trees where `keep` says so; return the path, and the tree of all points."""
    folder.mkdir(exist_ok=True)
    random = np.random.default_rng(9)
    x, y = random.uniform(0.0, side, (2, int(side**2 / 3)))
    x, y = x[keep(x, y)], y[keep(x, y)]
    is_tree = (random.random(len(x)) < 0.2) & trees
    z = _height(x, y) + np.where(is_tree, random.uniform(4.0, 15.0, len(x)), 0.0)
    path = _write(folder / "cloud.laz", x, y, z, np.where(is_tree, 5, 2))
    integers = np.round(np.column_stack((x, y, z)) * 100).astype(np.int64)
    return path, cKDTree(np.column_stack((x, y))), integers, np.where(is_tree, 5, 2)


# Of each kind one: what is beside them is made of these, and written as they are.
SOME = ("dtm", "dsm", "chm", "hillshade", "sky_view")
SOME_AND_ALL = [SOME, pytest.param(tuple(RASTERS), marks=pytest.mark.long)]


def _is_l(x, y):
    return (x < 60.0) | (y < 60.0)


@pytest.mark.rest
def test_no_raster_has_values_in_the_inner_corner_of_a_survey_like_an_l(tmp_path):
    path, tree, _, _ = _cloud(tmp_path / "in", _is_l, side=180.0)
    for values, x, y in _terrain(tmp_path, path, names=list(RASTERS)):
        known = np.isfinite(values)
        far = tree.query(np.column_stack((x.ravel(), y.ravel())))[0].reshape(x.shape)
        assert far[known].max() < 5.0
        assert known[_is_l(x + 2.0, y + 2.0)].mean() > 0.95


@pytest.mark.long
@pytest.mark.parametrize("names", [SOME, tuple(RASTERS)], ids=len)
def test_the_field_strip_has_no_values_beyond_its_points(tmp_path, names):
    import laspy
    from realdata import real

    path = real("field/strip.laz")
    las = laspy.read(path)
    tree = cKDTree(np.column_stack((las.x, las.y)))
    named = {name: f"--{name.replace('_', '-')}" for name in names}
    options = [word for name in names for word in (named[name], tmp_path / f"{name}.tif")]
    assert said("terrain", path, *options)[0] == 0
    for name in names:
        values, x, y = _values(tmp_path / f"{name}.tif")
        places = np.column_stack((x.ravel() + ORIGIN[0], y.ravel() + ORIGIN[1]))
        far = tree.query(places)[0].reshape(x.shape)
        assert far[np.isfinite(values)].max() < 5.0


def _is_land(x, y):
    """Return what is not in a lake, nor in a bay that is open to the south."""
    lake = np.hypot(x - 90.0, y - 200.0) < 50.0
    return ~lake & ~((np.abs(x - 220.0) < 35.0) & (y < 180.0))


@pytest.mark.rest
def test_a_lake_is_filled_and_a_bay_is_not(tmp_path):
    path, *_ = _cloud(tmp_path / "in", _is_land)
    names = ("dtm", "dsm", "chm")
    rasters = _terrain(tmp_path / "a", path, names=names)
    x, y = rasters[0][1:]
    lake = np.hypot(x - 90.0, y - 200.0) < 45.0
    bay = (np.abs(x - 220.0) < 29.0) & (y < 170.0)
    for name, (values, _, _) in zip(names, rasters):
        assert np.isfinite(values[lake]).all() == (name != "chm")
        assert np.isnan(values[bay]).all()
    # Nothing was measured on the lake, so nothing is known about trees there.
    assert np.isnan(rasters[2][0][lake]).all()
    limited = _terrain(tmp_path / "b", path, names=names, max_edge=30.0)
    for values, _, _ in limited:
        assert np.isnan(values[lake & (np.hypot(x - 90.0, y - 200.0) < 30.0)]).all()


@pytest.mark.rest
def test_canopy_has_no_values_where_no_ground_is_near(tmp_path):
    def keep(x, y):
        return x >= 0.0

    _, _, integers, classes = _cloud(tmp_path / "in", keep)
    far = np.hypot(integers[:, 0] - 15_000, integers[:, 1] - 15_000) < 8000
    path = write(tmp_path / "in" / "roof.laz", integers, classes=np.where(far, 6, classes))
    dtm, chm = _terrain(tmp_path, path, names=("dtm", "chm"))
    _, x, y = dtm
    distance = np.hypot(x - 150.0, y - 150.0)
    assert np.isfinite(dtm[0][distance < 80.0]).all()
    assert np.isnan(chm[0][distance < 25.0]).all()
    assert np.isfinite(
        chm[0][(distance > 35.0) & (np.abs(x - 150) < 145) & (np.abs(y - 150) < 145)]
    ).all()


@pytest.mark.rest
@pytest.mark.parametrize("names", SOME_AND_ALL, ids=len)
def test_blocks_files_and_strips_give_the_same_outlines(tmp_path, monkeypatch, names):
    path, _, integers, classes = _cloud(tmp_path / "in", lambda x, y: _is_l(x, y) & _is_land(x, y))
    one = _terrain(tmp_path / "one", path, names=names)
    # The class follows from the height, so that it can be set again.
    import laspy

    cut(tmp_path / "many", integers, 6)
    known = {tuple(row): value for row, value in zip(integers.tolist(), classes)}
    for file in (tmp_path / "many").iterdir():
        las = laspy.read(file)
        shift = np.round((np.array(las.header.offsets) - ORIGIN) / las.header.scales).astype(int)
        rows = np.column_stack((las.X, las.Y, las.Z)).astype(np.int64) + shift
        las.classification[:] = [known[tuple(row)] for row in rows.tolist()]
        las.write(str(file))
    monkeypatch.setattr(blocks_module, "_SIDE", 100.0)
    monkeypatch.setattr(outline_module, "_CELLS_A_SPAN", 1)
    many = _terrain(tmp_path / "rasters", [tmp_path / "many"], names=names)
    for (a, _, _), (b, _, _) in zip(one, many):
        assert np.array_equal(np.isnan(a), np.isnan(b))
        assert np.nanquantile(np.abs(a - b), 0.999) < 0.001
    # Whatever else is made.
    ((alone, _, _),) = _terrain(tmp_path / "alone", path)
    assert np.array_equal(alone, one[names.index("dtm")][0], equal_nan=True)


# Areas

L = [[20.0, 20.0], [250.0, 20.0], [250.0, 80.0], [90.0, 80.0], [90.0, 280.0], [20.0, 280.0]]


@pytest.fixture
def boundary(tmp_path):
    corners = [[x + ORIGIN[0], y + ORIGIN[1]] for x, y in [*L, L[0]]]
    path = tmp_path / "l.geojson"
    path.write_text(json.dumps({"type": "Polygon", "coordinates": [corners]}))
    return path


def _in_l(x, y):
    return (x > 20) & (x < 250) & (y > 20) & (y < 280) & ((x < 90) | (y < 80))


@pytest.mark.parametrize("more", quick([[], ["--area-only"]], []))
def test_a_boundary_clips_the_rasters_of_classify(tmp_path, boundary, more):
    path, *_ = _cloud(tmp_path / "in", lambda x, y: x >= 0.0, trees=False)
    dtm, shade = tmp_path / "dtm.tif", tmp_path / "shade.tif"
    words = [*FAST_WORDS, "--boundary", boundary, "--dtm", dtm, "--hillshade", shade]
    assert said("classify", path, tmp_path / "o.laz", *words, *more)[0] == 0
    for raster in (dtm, shade):
        values, x, y = _values(raster)
        assert values.shape == (260, 230)
        assert np.isnan(values[~_in_l(x, y)]).all()
        assert np.isfinite(values[_in_l(x, y)]).mean() > 0.97


@pytest.mark.rest
def test_the_terrain_command_takes_a_boundary_and_an_extent(tmp_path, boundary):
    path, *_ = _cloud(tmp_path / "in", lambda x, y: x >= 0.0)
    whole, x, y = _terrain(tmp_path, path)[0]
    dtm = tmp_path / "part.tif"
    words = ["terrain", path, "--dtm", dtm, "--dtm-cell-size", 2]
    assert said(*words, "--boundary", boundary)[0] == 0
    part, part_x, part_y = _values(dtm)
    assert np.array_equal(np.isfinite(part), _in_l(part_x, part_y))
    # Points outside still take part, so the heights are those without a boundary.
    inside = _in_l(x, y)
    assert np.allclose(part[np.isfinite(part)], whole[inside], atol=1e-4)
    extent = [ORIGIN[0] + 100, ORIGIN[1] + 50, ORIGIN[0] + 160, ORIGIN[1] + 90]
    assert said(*words, "--extent", *extent)[0] == 0
    assert _values(dtm)[0].shape == (20, 30)
    code, _, errors = said(*words, "--extent", 0, 0, 10, 10)
    assert code == 1 and "No point lies in the area" in errors


@pytest.mark.rest
def test_blocks_far_from_the_area_are_not_made_and_change_nothing(tmp_path):
    path, _, integers, classes = _cloud(tmp_path / "in", lambda x, y: x >= 0.0)
    far = integers + np.array([900_000, 0, 0])
    write(tmp_path / "in" / "far.laz", far, classes=classes)
    extent = [ORIGIN[0] + 100, ORIGIN[1] + 50, ORIGIN[0] + 160, ORIGIN[1] + 90]
    found = []
    for name, source in (("one", path), ("many", tmp_path / "in")):
        dtm = tmp_path / f"{name}.tif"
        assert said("terrain", source, "--dtm", dtm, "--extent", *extent)[0] == 0
        found.append(_values(dtm)[0])
    assert np.array_equal(*found, equal_nan=True)
    nowhere = [ORIGIN[0] + 4000, ORIGIN[1], ORIGIN[0] + 4100, ORIGIN[1] + 90]
    words = ["terrain", tmp_path / "in", "--dtm", tmp_path / "none.tif", "--extent", *nowhere]
    code, _, errors = said(*words)
    assert code == 1 and "500000.01 to 509300" in errors
    assert not os.path.exists(tmp_path / "none.tif")


@pytest.mark.rest
def test_classify_limits_the_edges_of_its_rasters(tmp_path):
    path, *_ = _cloud(tmp_path / "in", _is_land, trees=False)
    dtm = tmp_path / "dtm.tif"
    for more, is_filled in (([], True), (["--max-edge", "30"], False)):
        words = ["classify", path, tmp_path / "o.laz", "--dtm", dtm, "--dtm-cell-size", 2]
        assert said(*words, *FAST_WORDS, *more)[0] == 0
        values, x, y = _values(dtm)
        lake = np.hypot(x - 90.0, y - 200.0) < 30.0
        assert np.isfinite(values[lake]).all() == is_filled
        assert np.isfinite(values[lake]).any() == is_filled


# Pits


def test_pits_are_filled_and_edges_stay():
    canopy = np.zeros((40, 40))
    canopy[10:30, 10:30] = 20.0
    canopy[5, 5] = 12.0  # a single high cell stays
    holes = canopy.copy()
    for row, column in ((15, 15), (20, 20), (20, 21), (25, 12)):
        holes[row, column] = 3.0
    holes[2, 30] = np.nan
    filled = without_pits(holes)
    assert np.isnan(filled[2, 30])
    filled[2, 30] = 0.0
    assert np.array_equal(filled, canopy)


@pytest.mark.rest
def test_pits_of_the_canopy_are_filled_without_seams(tmp_path, monkeypatch):
    path, *_ = _cloud(tmp_path / "in", lambda x, y: x >= 0.0)
    names = ("dsm", "chm")
    plain = _terrain(tmp_path / "a", path, names=names, cell=2.0)
    filled = _terrain(tmp_path / "b", path, 2.0, names, pit_free=True)
    assert np.array_equal(plain[0][0], filled[0][0], equal_nan=True)
    before, after = plain[1][0], filled[1][0]
    assert np.array_equal(np.isnan(before), np.isnan(after))
    assert np.nanmin(after - before) == 0.0 and np.mean(after - before > 2.0) > 0.02
    monkeypatch.setattr(outline_module, "_CELLS_A_SPAN", 1)
    monkeypatch.setattr(outline_module, "_ROWS", 7)
    monkeypatch.setattr(blocks_module, "_SIDE", 100.0)
    strips = _terrain(tmp_path / "c", path, 2.0, names, pit_free=True)
    assert np.nanmax(np.abs(strips[1][0] - after)) < 0.001


def test_a_survey_smaller_than_a_few_cells_has_terrain(tmp_path):
    x, y = np.random.default_rng(3).uniform(0.0, 18.0, (2, 60))
    source = tmp_path / "small.las"
    _write(source, x, y, np.full(60, 100.0))
    ((terrain,),) = (_terrain(tmp_path / "out", [source], cell=5.0),)
    values, east, north = terrain
    inner = (np.abs(east - 9.0) < 5.0) & (np.abs(north - 9.0) < 5.0)
    assert inner.sum() >= 4 and np.allclose(values[inner], 100.0)
