"""Points, geometries and rasters as people have them are taken, or refused in a sentence."""

import builtins
import json
import pickle
import warnings
from pathlib import Path

import laspy
import numpy as np
import pytest
from runs import FAST, Heard
from surveys import ORIGIN, strip, write

import bare_earth
from bare_earth import arrays
from bare_earth.algorithms.library.transform import Transform

SQUARE = np.array([(40, 20), (140, 20), (140, 100), (40, 100), (40, 20)]) + ORIGIN[:2]


@pytest.fixture(scope="module")
def las(tmp_path_factory):
    """Points with the classes that they get."""
    path = write(tmp_path_factory.mktemp("points") / "a.laz", strip(5_000, 160.0, 110.0))
    las = laspy.read(str(path))
    las.classification = arrays.classify(las)
    return las


@pytest.fixture(scope="module")
def dtm(las):
    return arrays.terrain(las, crs=25832, dtm_cell_size=2.0)["dtm"]


def table_of(las):
    return pytest.importorskip("pandas").DataFrame(las.points.array)


def with_coordinates(table, las):
    """Return a table of stored integers with coordinates beside them."""
    return table.assign(**{axis: np.asarray(las[axis]) for axis in "xyz"})


@pytest.mark.rest
def test_records_of_laspy_are_points(las, tmp_path):
    ground = arrays.ground(las)
    assert np.array_equal(arrays.ground(las.points), ground)
    las.write(str(tmp_path / "b.laz"))
    with laspy.open(tmp_path / "b.laz") as reader:
        for chunk in reader.chunk_iterator(40_000):
            assert len(arrays.heights(chunk)) == len(chunk)
    first = las.points[:4000]
    assert np.array_equal(arrays.heights(first), arrays.heights(las[:4000]))
    with pytest.raises(bare_earth.BareEarthError, match="own y"):
        arrays.ground(las.points, las.y)


@pytest.mark.rest
def test_columns_of_a_table_are_arrays(las):
    table = with_coordinates(table_of(las), las)
    found = arrays.classify(table.x, table.y, table.z, return_number=las.return_number[:],
                            number_of_returns=las.number_of_returns[:])  # fmt: skip
    assert np.array_equal(found, arrays.classify(las))


@pytest.mark.rest
@pytest.mark.parametrize("point_format", [1, 6])
def test_what_raw_records_hold_in_bits_is_read_beside_coordinates(las, point_format):
    las = laspy.convert(las, point_format_id=point_format)
    las.number_of_returns[:] = las.return_number[:] = 3
    las.return_number[::5] = 2
    las.withheld[::7] = 1
    table = with_coordinates(table_of(las), las)
    heights = arrays.heights(table)
    assert np.array_equal(heights, arrays.heights(las)) and np.isfinite(heights).all()
    assert np.array_equal(arrays.classify(table), arrays.classify(las))


@pytest.mark.parametrize(
    "raw",
    [
        lambda las: (las.points.array,),
        lambda las: (table_of(las),),
        lambda las: (table_of(las).astype({axis: np.int64 for axis in "XYZ"}),),
        lambda las: (laspy.PackedPointRecord(las.points.array, las.point_format),),
        lambda las: (las.X, las.Y, las.Z),
        lambda las: (np.column_stack((las.X, las.Y, las.Z)),),
        lambda las: (las.x, las.y, las.Z),
        lambda las: ({"X": las.X, "Y": las.Y, "Z": las.Z},),
    ],
)
def test_integers_of_files_are_no_coordinates(las, raw):
    with pytest.raises(bare_earth.BareEarthError, match="integers"):
        arrays.ground(*raw(las))


@pytest.mark.parametrize("file", ["a.laz", Path("a.laz")])
def test_a_file_is_no_array(file):
    with pytest.raises(bare_earth.BareEarthError, match=r"points must be .* not a file"):
        arrays.ground(file)


@pytest.mark.rest
def test_other_integers_are_coordinates(las):
    metres = [np.rint(las[axis]).astype(np.int64) for axis in "xyz"]
    assert np.array_equal(arrays.ground(*metres), arrays.ground(*np.array(metres, float)))


def shapes_of(square):
    """Return a polygon in the ways that libraries have."""
    shapely = pytest.importorskip("shapely")
    polygon, geojson = (
        shapely.Polygon(square),
        {"type": "Polygon", "coordinates": [square.tolist()]},
    )
    feature = {"type": "Feature", "properties": {"class": 6}, "geometry": geojson}
    return {
        "shapely": polygon,
        "list": [polygon],
        "array": np.array([polygon]),
        "multi": shapely.MultiPolygon([polygon]),
        "geojson": geojson,
        "feature": feature,
        "collection": {"type": "FeatureCollection", "features": [feature]},
        "features": [feature],
        "ring": square,
        "rings": [square],
        "polygons": [[square]],
        "tuples": [[*map(tuple, square)]],
        "iterator": iter([polygon]),
    }


@pytest.mark.rest
def test_geometries_of_any_library_are_areas(las, tmp_path):
    raw = laspy.LasData(las.header, las.points.copy())
    raw.classification[:] = 1
    wanted = arrays.classify(raw, boundary=[[SQUARE]], **FAST)
    assert 0.1 < (wanted == 2).mean() < 0.6
    for name, shape in shapes_of(SQUARE).items():
        assert np.array_equal(arrays.classify(raw, boundary=shape, **FAST), wanted), name
    found = arrays.classify(raw, corrections=shapes_of(SQUARE)["collection"], **FAST)
    feature = [shapes_of(SQUARE)["feature"]]
    same = arrays.classify(raw, corrections=feature, **FAST)
    assert (found == 6).sum() == (same == 6).sum() > 1000
    path = tmp_path / "a.laz"
    raw.write(str(path))
    bare_earth.classify(path, tmp_path / "b.laz", boundary=shapes_of(SQUARE)["shapely"], **FAST)
    assert np.array_equal(laspy.read(str(tmp_path / "b.laz")).classification, wanted)


@pytest.mark.rest
def test_lines_and_checkpoints_of_shapely(las):
    shapely = pytest.importorskip("shapely")
    wall = np.array([(50.5, 10, 66), (50.5, 90, 66)]) + ORIGIN
    wanted = arrays.terrain(las, breaklines=[wall])["dtm"].values
    for lines in (shapely.LineString(wall), [shapely.LineString(wall)], wall):
        found = arrays.terrain(las, breaklines=lines)["dtm"].values
        assert np.array_equal(found, wanted, equal_nan=True)
    places = las.xyz[las.classification == 2][::500]
    wanted = arrays.check(las, checkpoints=places)
    for points in ([*map(shapely.Point, places)], shapely.MultiPoint(places)):
        assert arrays.check(las, checkpoints=points).nva == wanted.nva


@pytest.mark.rest
def test_an_extent_is_four_numbers_or_that_of_a_geometry(las):
    shapely = pytest.importorskip("shapely")
    wanted = arrays.ground(las, extent=[*SQUARE.min(axis=0), *SQUARE.max(axis=0)])
    assert np.array_equal(arrays.ground(las, extent=shapely.Polygon(SQUARE)), wanted)
    for extent in ("here", (1, 2, 3), 5, [None] * 4):
        with pytest.raises(bare_earth.BareEarthError, match="extent is"):
            arrays.ground(las, extent=extent)


@pytest.mark.parametrize(
    ("shape", "words"),
    [
        ({"type": "Point", "coordinates": [1, 2]}, "geometry .* no polygon"),
        ({"coordinates": [1, 2]}, "geometry .* 'type'"),
        ([{"type": "Polygon", "coordinates": [[[0, 0], [1, 1], [0, 1]]]}, SQUARE], "nothing but"),
        ([["a", "b"]], "The polygon is not valid"),
        (5, "The polygon is not valid"),
        ([], "boundary .* no polygon"),
    ],
)
def test_what_is_no_polygon_is_told(las, shape, words):
    with pytest.raises(bare_earth.BareEarthError, match=words):
        arrays.ground(las, boundary=shape)


def test_codes_of_a_crs_are_numbers_everywhere(las, tmp_path):
    pyproj = pytest.importorskip("pyproj")
    path = tmp_path / "a.laz"
    las.write(str(path))
    for crs in (26912, np.int64(26912), "26912", pyproj.CRS(26912)):
        assert bare_earth.info(path, crs=crs).epsg == 26912
    bare_earth.terrain(path, dtm=tmp_path / "dtm.tif", crs=25832)
    assert bare_earth.check(path, checkpoints=las.xyz[:9], checkpoints_crs=25832, crs=25832)
    with pytest.raises(bare_earth.BareEarthError, match="crs must be"):
        bare_earth.info(path, crs=True)


def test_a_raster_is_an_array_with_a_transform(dtm):
    affine = pytest.importorskip("affine")
    assert np.asarray(dtm) is dtm.values and np.array(dtm) is not dtm.values
    assert np.asarray(dtm, dtype=float).dtype == float and np.isfinite(np.nanmean(dtm))
    assert isinstance(dtm.transform, affine.Affine)
    west, north = dtm.transform.c, dtm.transform.f
    with warnings.catch_warnings():  # of newer versions, which prefer @
        warnings.simplefilter("ignore", PendingDeprecationWarning)
        assert ~dtm.transform * (west + 5.0, north - 3.0) == (2.5, 1.5)
    again = pickle.loads(pickle.dumps(dtm))
    assert again.transform == dtm.transform and np.array_equal(again, dtm, equal_nan=True)
    assert np.asarray(arrays.Raster(np.zeros((2, 3)), (1, 0, 5, 0, -1, 9))).shape == (2, 3)


def without(monkeypatch, name):
    """Let a package not be installed."""
    importing = builtins.__import__

    def imported(module, *arguments, **named):
        if module.partition(".")[0] == name:
            raise ImportError(module)
        return importing(module, *arguments, **named)

    monkeypatch.setattr(builtins, "__import__", imported)


def test_without_affine_a_transform_does_the_same(monkeypatch):
    affine = pytest.importorskip("affine")
    without(monkeypatch, "affine")
    six, more = (2.0, 0.5, 300.0, -0.25, -2.0, 900.0), (1.0, 0.0, -3.0, 0.5, 4.0, 7.0)
    raster = arrays.Raster(np.zeros((2, 3)), six)
    own, theirs = raster.transform, affine.Affine(*six)
    assert isinstance(own, Transform) and tuple(own) == tuple(theirs) and own.f == 900.0
    assert own * (3, 4) == own @ (3, 4) == theirs @ (3, 4)
    assert np.allclose(~own, tuple(~theirs)) and np.allclose(~own * (own * (3, 4)), (3, 4))
    assert np.allclose(own * Transform(*more), tuple(theirs @ affine.Affine(*more)))
    assert own.to_gdal() == theirs.to_gdal()
    columns, rows = np.mgrid[:2, :3]
    assert np.array_equal((own * (columns, rows))[0], 2 * columns + 0.5 * rows + 300)
    with pytest.raises(bare_earth.BareEarthError, match="has no inverse"):
        ~Transform(1.0, 1.0, 0.0, 1.0, 1.0, 0.0)


def test_a_raster_is_drawn(las, dtm, monkeypatch):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    axes = dtm.plot(cmap="terrain")
    (image,) = axes.images
    west, north = dtm.transform.c, dtm.transform.f
    rows, columns = dtm.values.shape
    assert list(image.get_extent()) == [west, west + 2 * columns, north - 2 * rows, north]
    picture = arrays.terrain(las, rasters="red_relief", dtm_cell_size=4.0)["red_relief"]
    assert picture.plot(ax=axes) is axes and axes.images[1].get_array().shape[2] == 3
    matplotlib.pyplot.close("all")
    without(monkeypatch, "matplotlib")
    with pytest.raises(bare_earth.BareEarthError, match="pip install matplotlib"):
        dtm.plot()


def rasters_of(dtm):
    """Return a raster in the ways that users have it."""
    array = dtm.to_xarray()
    bare = array.drop_vars("spatial_ref")
    filled = array.fillna(-9999.0)
    return {
        "ours": dtm,
        "xarray": array,
        "south up": array.isel(y=slice(None, None, -1)),
        "transposed": array.transpose("x", "y"),
        "one band": array.expand_dims("band"),
        "declared": filled.assign_attrs(_FillValue=-9999.0),
        "undeclared": filled.assign_attrs(_FillValue=np.nan),
        "centimetres": (filled * 100).assign_attrs(scale_factor=0.01, _FillValue=-999900.0),
        "without coordinates": array.drop_vars(["x", "y"]),
        "without CRS": bare,
    }


@pytest.mark.rest
def test_rasters_in_memory_are_rasters_everywhere(las, dtm, tmp_path):
    pytest.importorskip("xarray")
    pytest.importorskip("rasterio")
    path, cloud = tmp_path / "dtm.tif", tmp_path / "a.laz"
    las.write(str(cloud))
    bare_earth.terrain(cloud, dtm=path, crs=25832, dtm_cell_size=2.0)
    heights = arrays.heights(las, dtm=path, crs=25832)
    dsm = arrays.terrain(las, rasters="dsm", like=path, crs=25832)["dsm"]
    lines = arrays.contours(path, interval=2.0)
    assert len(lines.geometries) > 5
    for name, raster in rasters_of(dtm).items():
        found = arrays.heights(las, dtm=raster, crs=25832)
        assert np.allclose(found, heights, atol=1e-4, equal_nan=True), name
        found = arrays.terrain(las, rasters="dsm", like=raster, crs=25832)["dsm"]
        assert found.transform == dsm.transform and np.array_equal(found, dsm, equal_nan=True), name
        found = arrays.contours(raster, interval=2.0)
        assert np.allclose(found.values["ELEV"], lines.values["ELEV"]), name
    ours = dtm
    bare_earth.contours(ours, tmp_path / "lines.geojson", interval=2.0)
    found = json.loads((tmp_path / "lines.geojson").read_text())["features"]
    assert len(found) == len(lines.geometries)
    bare_earth.heights(cloud, tmp_path / "b.laz", dtm=ours, crs=25832)
    found = laspy.read(str(tmp_path / "b.laz"))["HeightAboveGround"]
    assert np.allclose(found, heights, atol=1e-4, equal_nan=True)
    bare_earth.terrain(cloud, dsm=tmp_path / "dsm.tif", like=ours, crs=25832)
    places = las.xyz[las.classification == 2][::300]
    figures = [
        bare_earth.check(cloud, checkpoints=places, dtm=one, crs=25832) for one in (path, ours)
    ]
    assert figures[0].dtm_nva == figures[1].dtm_nva


@pytest.mark.parametrize("many", [False, True])
def test_files_above_a_raster_in_memory_can_be_gone_on_with(las, dtm, tmp_path, many):
    folder = tmp_path / "tiles"
    folder.mkdir()
    half = np.asarray(las.x) < np.median(las.x)
    for name, part in (("a", half), ("b", ~half))[: 1 + many]:
        las[part].write(str(folder / f"{name}.laz"))
    for _ in range(2):
        bare_earth.heights(folder, tmp_path / "out", dtm=dtm, crs=25832, resume=True)
    found = laspy.read(str(tmp_path / "out" / "a.laz"))["HeightAboveGround"]
    assert np.allclose(
        found, arrays.heights(las[half], dtm=dtm, crs=25832), atol=1e-4, equal_nan=True
    )


def test_undeclared_no_data_in_memory_is_told(las, dtm):
    heard, values = Heard(), np.where(np.isnan(dtm), np.float32(-9999), dtm)
    values[3, 3:5] = -9999
    raster = arrays.Raster(values, dtm.transform, 25832)
    count = np.count_nonzero(values == -9999)
    arrays.contours(raster, progress=heard)
    assert f"raster has {count} cells of -9999" in heard.warnings[0]


@pytest.mark.rest
@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            lambda one: one.assign_coords(x=one.x + one.x % 3),
            "x of the DataArray .* even",
        ),
        (lambda one: one.drop_vars(["x", "spatial_ref"]), "DataArray has no .* x"),
        (lambda one: one.to_dataset(), "xarray.DataArray, not Dataset"),
        (lambda one: one.values, "not ndarray.* Raster"),
        (lambda one: one.isel(y=0), "rows and columns"),
        (
            lambda one: one.assign_coords(x=[*map(str, one.x.values)]),
            "x of the DataArray .* num",
        ),
    ],
)
def test_what_is_no_raster_is_told(dtm, change, words):
    pytest.importorskip("xarray")
    with pytest.raises(bare_earth.BareEarthError, match=words):
        arrays.contours(change(dtm.to_xarray()))


@pytest.mark.rest
def test_reliefs_and_surfaces_are_those_of_files(las, dtm, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    cloud, path = tmp_path / "a.laz", tmp_path / "dsm.tif"
    las.write(str(cloud))
    bare_earth.terrain(cloud, dsm=path, crs=25832)
    dsm = arrays.terrain(las, rasters="dsm", crs=25832)["dsm"]
    kinds = ("vat", "local-relief", "slope")
    bare_earth.relief(path, tmp_path / "reliefs", kinds=kinds)
    reliefs = arrays.relief(dsm, kinds=kinds)
    assert tuple(reliefs) == kinds
    bare_earth.remove_off_terrain_objects(path, tmp_path / "reliefs" / "bare.tif")
    found = {**reliefs, "bare": arrays.remove_off_terrain_objects(dsm)}
    assert list(arrays.relief(dsm, kind="slope")) == ["slope"]
    for name, raster in found.items():
        with rasterio.open(tmp_path / "reliefs" / f"{name}.tif") as file:
            cells = file.read().reshape(raster.values.shape)
            nodata = 0 if cells.dtype == np.uint8 else np.nan
            cells = np.where(cells == file.nodata, nodata, cells)
            assert np.array_equal(cells, raster, equal_nan=cells.dtype.kind == "f"), name
            assert raster.transform == file.transform and raster.shows == file.descriptions[0]


def test_functions_on_arrays_have_no_options_of_files():
    import inspect

    for name in ("classify", "ground", "heights", "terrain", "key_points", "above_ground"):
        named = inspect.signature(getattr(arrays, name)).parameters
        assert "threads" in named
        assert named.keys().isdisjoint({"memory", "remember_classes", "cache", "limit", "output"})
