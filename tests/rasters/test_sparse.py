"""Rasters of surveys in pieces far apart: empty land takes neither time nor space."""

import json

import numpy as np
import pytest
from surveys import ORIGIN, write

import bare_earth
from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.core.progress import Progress
from bare_earth.algorithms.rasters import content, geotiff, windows, writing
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.rasters.sparse import RasterPart
from bare_earth.algorithms.rasters.writing import RasterCells, write_geotiff
from bare_earth.algorithms.tools.rasters.class_raster import write_class_raster

rasterio = pytest.importorskip("rasterio")

SIDE = 40.0  # metres of a piece
FAR = 22_000.0


def _piece(path, east=0.0, north=0.0, seed=0):
    """Write a piece of a hillside of class 2."""
    x, y = np.random.default_rng(seed).uniform(0.0, SIDE, (2, 3000))
    z = 100.0 + 0.1 * x + np.sin(y / 5.0)
    metres = np.column_stack((x + east, y + north, z))
    return write(path, np.round(metres * 100).astype(np.int64), classes=2)


def _read(path, east, north, side=SIDE):
    """Return the cells of a square, from its southwestern corner."""
    with rasterio.open(path) as raster:
        corner = ORIGIN[0] + east, ORIGIN[1] + north
        window = raster.window(*corner, corner[0] + side, corner[1] + side)
        return raster.read(1, window=window.round_offsets().round_lengths())


@pytest.fixture(scope="module")
def pieces(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pieces")
    paths = [
        _piece(folder / "a.laz"), _piece(folder / "b.laz", FAR, 0.4 * FAR, 1)
    ]  # fmt: skip
    names = {
        "dtm": "dtm.tif",
        "hillshade": "hillshade.tif",
        "dsm": "dsm.tif",
        "vat": "vat.tif",
        "expected_error": "expected_error.tif",
    }
    for key, sources in (("both", paths), ("a", paths[0]), ("b", paths[1])):
        (folder / key).mkdir()
        bare_earth.terrain(sources, **{name: folder / key / file for name, file in names.items()})
    return folder


@pytest.mark.rest
@pytest.mark.parametrize("name", ["dtm", "dsm", "hillshade", "vat", "expected_error"])
def test_two_pieces_far_apart_have_the_cells_of_each(pieces, name):
    both = pieces / "both" / f"{name}.tif"
    for key, east, north in (("a", 0.0, 0.0), ("b", FAR, 0.4 * FAR)):
        alone, joined = (_read(path, east, north) for path in (pieces / key / f"{name}.tif", both))
        assert np.array_equal(alone, joined)
    with rasterio.open(both) as raster:
        assert raster.shape[0] * raster.shape[1] > 150_000_000
        small = raster.read(1, out_shape=(raster.height // 64, raster.width // 64), masked=True)
        assert 0 < small.count() < 10
    assert both.stat().st_size < 300_000


def _of_pieces(pieces, make):
    """Return what a function makes of the files in the folders `both`, `a` and `b`."""
    return [make(pieces / key, pieces / key / "made") for key in ("both", "a", "b")]


def _are_joined(both, alone_a, alone_b):
    """Return whether a raster of both pieces has the cells of the rasters of each."""
    places = (alone_a, 0.0, 0.0), (alone_b, FAR, 0.4 * FAR)
    return all(
        np.array_equal(_read(both, east, north), _read(alone, east, north), equal_nan=True)
        for alone, east, north in places
    )


@pytest.mark.rest
def test_reliefs_and_canopy_of_rasters_with_empty_land_are_those_of_the_pieces(pieces, monkeypatch):
    read = []
    monkeypatch.setattr(
        geotiff,
        "read_content",
        lambda *given: read.append(given[2]) or content.read_content(*given),
    )

    def make(folder, made):
        kinds = ["vat", "local-relief"]
        bare_earth.relief(folder / "dtm.tif", made, kinds=kinds)
        bare_earth.canopy(folder / "dsm.tif", folder / "dtm.tif", made / "canopy.tif")
        return [made / f"{kind}.tif" for kind in (*kinds, "canopy")]

    for rasters in zip(*_of_pieces(pieces, make)):
        assert _are_joined(*rasters)
    cells = sum(columns * rows for _, _, columns, rows in filter(None, read))
    assert cells < 30_000_000  # of 180 million in each raster


@pytest.mark.rest
def test_contour_lines_of_a_raster_with_empty_land_are_those_of_the_pieces(pieces):
    def make(folder, made):
        target = folder / "lines.geojson"
        bare_earth.contours(folder / "dtm.tif", target, interval=0.5)
        features = json.loads(target.read_text("utf-8"))["features"]
        return [
            (line["properties"]["ELEV"], np.round(line["geometry"]["coordinates"], 3).tolist())
            for line in features
        ]

    both, a, b = _of_pieces(pieces, make)
    assert sorted(both) == sorted(a + b) and len(a) > 10


@pytest.mark.rest
def test_places_to_review_of_a_raster_with_empty_land_are_those_of_the_pieces(pieces, monkeypatch):
    looked, get = [], windows.RasterWindows.__getitem__

    def counted(cells, window):
        found = get(cells, window)
        looked.append(found.size)
        return found

    monkeypatch.setattr(windows.RasterWindows, "__getitem__", counted)

    def make(folder, made):
        target = folder / "places.geojson"
        error, dtm = folder / "expected_error.tif", folder / "dtm.tif"
        bare_earth.review(error, target, dtm=dtm, earlier=dtm, least_error=0.05)
        features = json.loads(target.read_text("utf-8"))["features"]
        # Squares of places begin at the first cell of a raster.
        return sum(place["properties"]["AREA"] for place in features), len(features)

    (area, count), (of_a, many), (of_b, some) = _of_pieces(pieces, make)
    assert area == pytest.approx(of_a + of_b) and count >= 2 and many and some
    assert sum(looked) < 30_000_000  # of 180 million in each raster


def test_classes_of_pieces_have_cells_as_small_as_those_of_one(tmp_path):
    x, y = np.random.default_rng(0).uniform(0.0, SIDE, (2, 3000))
    x[0], y[0] = 29_999.5, 23_999.5
    metres = np.column_stack((x, y, np.full(3000, 100.0)))
    classes = np.where(x < 20.0, 2, 5)
    path = write(tmp_path / "a.laz", np.round(metres * 100).astype(np.int64), classes=classes)
    assert write_class_raster(path, tmp_path / "a.tif") == [2, 5]
    with rasterio.open(tmp_path / "a.tif") as raster:
        assert raster.res == (1.0, 1.0) and raster.read(
            1,
            window=raster.window(
                ORIGIN[0] + 29_999, ORIGIN[1] + 23_999, ORIGIN[0] + 30_000, ORIGIN[1] + 24_000
            ),
        ).ravel().tolist() == [5]
    cells = _read(tmp_path / "a.tif", 0.0, 0.0)
    assert (cells[:, :19] == 2).mean() > 0.8 and (cells[:, 20:] == 5).mean() > 0.8


@pytest.mark.rest
def test_the_quality_of_pieces_is_that_of_each(pieces):
    def make(folder, made):
        key = folder.name
        sources = [pieces / f"{one}.laz" for one in ("a", "b") if key in (one, "both")]
        target = folder / "quality"
        page = folder / "page.html"
        figures = bare_earth.quality(sources, page=page, folder=target, cell_size=0.5)
        return figures, target

    (both, folder), (a, of_a), (b, of_b) = _of_pieces(pieces, make)
    assert both.points == a.points + b.points
    assert both.area == pytest.approx(a.area + b.area)
    assert both.ground_void_share == pytest.approx(
        (a.ground_void_share + b.ground_void_share) / 2, abs=0.01
    )
    for name in ("pulse_density", "ground_density", "voids", "overlap", "surface_height"):
        assert _are_joined(*(one / f"{name}.tif" for one in (folder, of_a, of_b)))
    assert "in 2 pieces far apart" in (pieces / "both" / "page.html").read_text("utf-8")
    assert "pieces far apart" not in (pieces / "a" / "page.html").read_text("utf-8")


@pytest.mark.rest
def test_a_stray_point_leaves_the_rasters_of_an_extent_as_they_are(tmp_path):
    x, y = np.random.default_rng(0).uniform(0.0, SIDE, (2, 3000))
    x[0], y[0] = 2_999_999.5, 2_399_999.5
    metres = np.column_stack((x, y, np.full(3000, 100.0)))
    path = write(tmp_path / "a.laz", np.round(metres * 100).astype(np.int64), classes=2)
    extent = [ORIGIN[0], ORIGIN[1], ORIGIN[0] + SIDE, ORIGIN[1] + SIDE]
    for name, given in (("a", {"extent": extent}), ("b", {"raster_extent": extent})):
        dtm = tmp_path / f"{name}.tif"
        bare_earth.terrain(path, dtm=dtm, **given)
        with rasterio.open(dtm) as raster:
            assert raster.shape == (SIDE, SIDE) and (raster.read(1) > 0).mean() > 0.95
    with pytest.raises(bare_earth.BareEarthError, match=r"3,000,000 x 2,400,000 .*raster_extent"):
        bare_earth.terrain(path, dtm=tmp_path / "c.tif")


@pytest.mark.rest
@pytest.mark.parametrize("kind, bands, nodata", [
    ("float32", 1, -9999.0), ("float32", 1, np.nan), ("uint8", 1, 255.0), ("uint8", 3, 0.0),
])  # fmt: skip
def test_a_sparse_raster_has_its_cells_and_means_of_them(
    tmp_path, monkeypatch, kind, bands, nodata
):
    monkeypatch.setattr(writing, "_MOST_IN_MEMORY", 1)
    random, shape = np.random.default_rng(3), (1700, 2900)
    whole = np.full((bands, *shape), nodata, kind)
    parts = []
    for row, column, rows, columns in (
        (0, 1024, 300, 256),
        (1024, 0, 256, 256),
        (1536, 2816, 164, 84),
    ):
        values = random.uniform(1.0, 200.0, (bands, rows, columns)).astype(kind)
        values[:, random.random((rows, columns)) < 0.3] = nodata
        whole[:, row : row + rows, column : column + columns] = values
        parts.append(RasterPart(row, column, values if bands > 1 else values[0]))
    cells = RasterCells(shape, kind, iter(parts), bands, made=200_000)
    grid = RasterGrid(500_000.0, 5_500_000.0, 1.0, *shape[::-1], Frame())
    path = tmp_path / "a.tif"
    write_geotiff(path, cells, grid, nodata, Progress(), "Height")
    assert list(tmp_path.iterdir()) == [path]
    with rasterio.open(path) as raster:
        assert np.array_equal(raster.read(), whole, equal_nan=True)
        assert raster.overviews(1) == [2, 4, 8, 16] and raster.transform.c == 500_000.0
        assert raster.descriptions[0] == "Height"
        assert raster.get_tag_item("BLOCK_OFFSET_0_0", "TIFF", 1) is None
    with rasterio.open(path, OVERVIEW_LEVEL=1) as overview:
        found = overview.read().astype(float)
    known = np.isnan(whole) if np.isnan(nodata) else whole == nodata
    values = np.where(known, np.nan, whole.astype(float))
    for _ in range(2):
        padded = np.pad(
            values,
            [(0, 0)] + [(0, count % 2) for count in values.shape[1:]],
            constant_values=np.nan,
        )
        squares = padded.reshape(bands, padded.shape[1] // 2, 2, -1, 2)
        with np.errstate(invalid="ignore"):
            values = np.nansum(squares, axis=(2, 4)) / (~np.isnan(squares)).sum(axis=(2, 4))
        values = np.floor(values + 0.5) if kind == "uint8" else values
    expected = np.where(np.isnan(values), nodata, values)
    assert np.allclose(found, expected, rtol=1e-5, equal_nan=True)
