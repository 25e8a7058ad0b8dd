"""Functions on arrays give what the functions for files give, whatever the arrays are."""

import io
import subprocess
import sys
from pathlib import Path

import laspy
import numpy as np
import pytest
import stub
from matrices import quick
from realdata import real
from surveys import ORIGIN, strip, write, write_points
from water_scenes import lake_scene

import bare_earth
from bare_earth import arrays
from bare_earth.algorithms.library import array_names
from bare_earth.algorithms.library.arrays import FUNCTIONS
from benchmarks.data import FOLDER

ROOT = Path(__file__).parents[2]
REAL = "house_slope.laz", "ign_pf8.las", "yard_photogrammetry.laz"


def classes_of(path):
    return np.asarray(laspy.read(str(path)).classification)


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A raw file, and the same with classes."""
    folder = tmp_path_factory.mktemp("arrays")
    raw, done = write(folder / "raw.laz", strip(5_000, 160.0, 110.0)), folder / "done.laz"
    bare_earth.classify(raw, done)
    return raw, done


def columns(las):
    """Return the columns of points as PDAL names them."""
    names = {
        "X": "x", "Y": "y", "Z": "z", "ReturnNumber": "return_number",
        "NumberOfReturns": "number_of_returns", "Classification": "classification",
        "Intensity": "intensity", "Withheld": "withheld",
    }  # fmt: skip
    return {name: np.array(las[source]) for name, source in names.items()}


def structured(table):
    array = np.empty(len(table["X"]), [(name, column.dtype) for name, column in table.items()])
    for name, column in table.items():
        array[name] = column
    return array


def as_pandas(table):
    return pytest.importorskip("pandas").DataFrame(table)


def as_pyarrow(table):
    return pytest.importorskip("pyarrow").table(table)


def as_geopandas(table):
    geopandas = pytest.importorskip("geopandas")
    x, y, z = (table.pop(name) for name in "XYZ")
    return geopandas.GeoDataFrame(table, geometry=geopandas.points_from_xy(x, y, z), crs=25832)


def test_all_functions_are_listed():
    assert sorted(FUNCTIONS) == array_names()
    assert set(array_names()) < set(dir(arrays))


@pytest.mark.rest(but="as_pandas")
@pytest.mark.parametrize("kind", [dict, structured, as_pandas, as_pyarrow, as_geopandas])
def test_a_table_gets_the_labels_of_the_file(files, kind):
    raw, done = files
    found = arrays.classify(kind(columns(laspy.read(str(raw)))))
    assert found.dtype == np.uint8 and np.array_equal(found, classes_of(done))


@pytest.mark.rest
def test_arrays_get_the_labels_of_the_file_and_do_not_change(files):
    raw, done = files
    las = laspy.read(str(raw))
    x, y, z = given = [np.asarray(las[axis]) for axis in "xyz"]
    before = [axis.copy() for axis in given]
    for axis in given:
        axis.flags.writeable = False
    ground = classes_of(done) == 2
    assert np.array_equal(arrays.ground(x, y, z), ground)
    assert np.array_equal(arrays.ground(las.xyz), ground)
    assert np.array_equal(arrays.ground(las), ground)
    assert all(map(np.array_equal, given, before))
    order = np.random.default_rng(4).permutation(len(x))
    assert np.array_equal(arrays.ground(x[order], y[order], z[order]), ground[order])


@pytest.mark.rest
def test_feet_and_codes_of_a_crs_are_understood(files):
    pytest.importorskip("pyproj")
    x, y, z = (np.asarray(laspy.read(str(files[0]))[axis]) for axis in "xyz")
    feet = [np.round(axis / 0.3048, 2) for axis in (x - ORIGIN[0], y - ORIGIN[1], z)]
    ground = arrays.ground(*feet, crs="EPSG:2222")  # international feet
    assert np.mean(ground == (classes_of(files[1]) == 2)) > 0.97
    assert np.array_equal(arrays.ground(x, y, z, crs=25832), classes_of(files[1]) == 2)
    with pytest.raises(bare_earth.BareEarthError, match=r"projected CRS .WGS 84"):
        arrays.ground(x / 1e5, y / 1e6, z, crs=4326)


@pytest.mark.rest
def test_numbers_without_end_are_rounded_to_less_than_matters(files):
    x, y, z = (np.asarray(laspy.read(str(files[0]))[axis]) for axis in "xyz")
    shift = np.random.default_rng(1).uniform(-1e-7, 1e-7, (3, len(x)))
    ground = arrays.ground(x + shift[0], y + shift[1], z + shift[2])
    assert np.mean(ground == (classes_of(files[1]) == 2)) > 0.999


@pytest.mark.rest
def test_values_of_points_are_those_of_the_file(files, tmp_path):
    _, done = files
    las, target = laspy.read(str(done)), tmp_path / "a.laz"
    bare_earth.heights(done, target)
    heights = arrays.heights(las)
    assert heights.dtype == np.float64
    there = np.asarray(laspy.read(str(target))["HeightAboveGround"])
    assert np.array_equal(heights.astype(np.float32), there, equal_nan=True)
    bare_earth.above_ground(done, target)
    assert np.array_equal(arrays.above_ground(las), classes_of(target))
    bare_earth.key_points(done, target)
    keys = arrays.key_points(las)
    assert keys.dtype == bool and np.array_equal(keys, classes_of(target) == 8)


def test_figures_are_those_of_the_file(files):
    _, done = files
    las = laspy.read(str(done))
    places = las.xyz[las.classification == 2][::200] + np.array((0.4, 0.3, 0.05))
    assert arrays.check(las, checkpoints=places, hold_out=0.02) == bare_earth.check(
        [done], checkpoints=places, hold_out=0.02
    )


@pytest.mark.rest
def test_rasters_are_those_of_the_file(files, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    raw, done = files
    names = ("dtm", "dsm", "hillshade", "expected_error", "red_relief")
    paths = {name: str(tmp_path / f"{name}.tif") for name in names}
    bare_earth.terrain(done, crs="EPSG:25832", raster_nodata=None, **paths)
    rasters = arrays.terrain(laspy.read(str(done)), rasters=names, crs=25832)
    assert tuple(rasters) == names
    for name, path in paths.items():
        raster = rasters[name]
        with rasterio.open(path) as file:
            cells = file.read()
            assert np.array_equal(
                cells, raster.values.reshape(cells.shape), equal_nan=cells.dtype.kind == "f"
            )
            assert tuple(raster.transform) == tuple(file.transform)
            assert raster.nodata == file.nodata or np.isnan(raster.nodata)
            assert file.crs == rasterio.crs.CRS.from_wkt(raster.crs)
            assert file.descriptions[0] == raster.shows
    las = laspy.read(str(raw))
    dtm = arrays.terrain(las, ground=arrays.ground(las))["dtm"]
    assert np.array_equal(dtm.values, rasters["dtm"].values, equal_nan=True)


def test_xarray_has_the_conventions_of_rioxarray(files, tmp_path):
    xarray = pytest.importorskip("xarray")
    las = laspy.read(str(files[1]))
    raster = arrays.terrain(las, rasters="dtm", dtm_cell_size=2.0, crs=25832)["dtm"]
    array = raster.to_xarray()
    assert isinstance(array, xarray.DataArray) and array.dims == ("y", "x")
    west, north = raster.transform[2], raster.transform[5]
    assert array.x[0] == west + 1.0 and array.y[0] == north - 1.0 and array.y[1] == north - 3.0
    assert array.spatial_ref.attrs["GeoTransform"] == f"{west} 2.0 0.0 {north} 0.0 -2.0"
    pytest.importorskip("rioxarray")
    assert array.rio.crs.to_epsg() == 25832 and np.isnan(array.rio.nodata)
    assert tuple(array.rio.transform()) == tuple(raster.transform)


def frame(corners, crs=25832, kind="polygons", **columns):
    geopandas, shapely = pytest.importorskip("geopandas"), pytest.importorskip("shapely")
    shapes = getattr(shapely, kind)(np.array(corners) + np.array(ORIGIN)[: np.shape(corners)[-1]])
    return geopandas.GeoDataFrame(columns, geometry=np.atleast_1d(shapes), crs=25832).to_crs(crs)


@pytest.mark.rest
@pytest.mark.parametrize("crs", [25832, 4326, 25833])
def test_areas_of_geopandas_are_brought_to_the_crs_of_the_points(files, crs):
    las = laspy.read(str(files[0]))
    square = [(40, 20), (140, 20), (140, 100), (40, 100), (40, 20)]
    x, y = np.asarray(las.x) - ORIGIN[0], np.asarray(las.y) - ORIGIN[1]
    near = (x > 39) & (x < 141) & (y > 19) & (y < 101)
    inside = (x > 41) & (x < 139) & (y > 21) & (y < 99)
    found = arrays.classify(las, crs=25832, boundary=frame(square, crs))
    assert (found[~near] == 1).all() and (found[inside] == 2).mean() > 0.5
    wall = [(50.5, 10, 66), (50.5, 90, 66)]
    rasters = dict(crs=25832, rasters="dtm", classification=classes_of(files[1]))
    lines = None, [np.array(wall) + ORIGIN], frame(wall, crs, "linestrings")
    without, given, dtm = (
        arrays.terrain(las, breaklines=some, **rasters)["dtm"].values for some in lines
    )
    assert np.nanmax(np.abs(dtm - given)) < 0.01 < np.nanmax(np.abs(dtm - without))
    known = frame(square, crs, **{"class": [6]})
    assert (arrays.classify(las, crs=25832, corrections=known)[inside] == 6).all()
    with pytest.raises(bare_earth.BareEarthError, match=r"GeoDataFrame .* no line"):
        arrays.terrain(las, breaklines=known, **rasters)


@pytest.mark.rest
def test_features_are_those_of_the_files_functions(files, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    las, crs = laspy.read(str(files[1])), "EPSG:25832"
    dtm, lines = tmp_path / "dtm.tif", tmp_path / "lines.geojson"
    bare_earth.terrain(files[1], dtm=dtm, crs=crs, raster_nodata=None)
    bare_earth.contours(dtm, lines, interval=2.0)
    raster = arrays.terrain(las, crs=crs)["dtm"]
    contours = arrays.contours(raster, interval=2.0).to_geopandas()
    wanted = geopandas.read_file(lines)
    assert list(contours.columns) == list(wanted.columns) and contours.crs == wanted.crs
    assert contours.ELEV.tolist() == wanted.ELEV.tolist() and len(contours) > 5
    assert contours.geometry.geom_equals_exact(wanted.geometry, 0.002).all()
    with pytest.raises(bare_earth.BareEarthError, match="raster of heights"):
        arrays.contours(arrays.terrain(las, rasters="hillshade")["hillshade"])

    points = frame([(50, 50, 63), (90, 70, 65), (150, 30, 69)], 4326, "points", NAME=list("abc"))
    errors = arrays.residuals(las, checkpoints=points, crs=crs).to_geopandas()
    bare_earth.check(files[1], checkpoints=points, crs=crs, residuals=lines)
    wanted = geopandas.read_file(lines)
    assert errors.ERROR.tolist() == wanted.ERROR.tolist() and errors.NAME.tolist() == list("abc")
    assert errors.crs.to_epsg() == 25832 and np.isfinite(errors.ERROR).any()

    one = arrays.expected_error(las, crs=crs, dtm_cell_size=2.0)
    same = arrays.terrain(las, rasters="expected_error", crs=crs, dtm_cell_size=2.0)
    assert np.array_equal(one.values, same["expected_error"].values, equal_nan=True)


@pytest.mark.rest
def test_water_is_that_of_the_file(tmp_path):
    geopandas = pytest.importorskip("geopandas")
    scene = lake_scene("sparse")
    source = write_points(tmp_path / "a.laz", scene.x, scene.y, scene.z, scene.classes, crs=25832)
    bare_earth.water(source, tmp_path / "water.gpkg", breaklines_out=tmp_path / "lines.gpkg")
    found = arrays.water(laspy.read(str(source)))
    for name, path in (("water", "water.gpkg"), ("breaklines", "lines.gpkg")):
        wanted, frame = geopandas.read_file(tmp_path / path), found[name].to_geopandas()
        assert len(frame) and frame.geometry.geom_equals(wanted.geometry).all()
        columns = frame.columns.drop("geometry").tolist()
        assert frame[columns].to_csv() == wanted[columns].to_csv()


@pytest.mark.rest
def test_progress_is_a_callable_or_a_bar_of_tqdm(files):
    tqdm = pytest.importorskip("tqdm")
    las, shares = laspy.read(str(files[0])), []
    arrays.ground(las, progress=shares.append)
    assert shares == sorted(shares) and shares[-1] == 1.0
    with tqdm.tqdm(file=io.StringIO()) as bar:
        arrays.ground(las, progress=bar)
        assert bar.n == bar.total == 1.0

    def cancel(share):
        raise bare_earth.Cancelled

    with pytest.raises(bare_earth.Cancelled):
        arrays.ground(las, progress=cancel)


X = np.arange(5.0)
WRONG = {
    "z is missing": dict(points=X, y=X),
    "x, y and z have 5, 5 and 4": dict(points=X, y=X, z=X[:4]),
    r"points .* \(n, 3\), not \(5,\)": dict(points=X),
    "z has 1 .* finite": dict(points=X, y=X, z=[0, 1, 2, 3, np.nan]),
    "y is float32.* 0.5": dict(points=X, y=(X + 5_700_000).astype(np.float32), z=X),
    "x must be numbers": dict(points=list("abcde"), y=X, z=X),
    "x has masked values": dict(points=np.ma.masked_less(X, 2), y=X, z=X),
    "x runs from 0 to 1e[+]11": dict(points=X * 2.5e10, y=X, z=X),
    r"classification .* \(5,\), not \(4,\)": dict(points=X, y=X, z=X, classification=[1] * 4),
    "return_number .* 0 to 255": dict(points=X, y=X, z=X, return_number=X + 0.5),
    "withheld .* True or False": dict(points=X, y=X, z=X, withheld=X),
    "no column Z, only X, Y": dict(points={"X": X, "Y": X}),
    "its own y": dict(points={"X": X, "Y": X, "Z": X}, y=X),
    "crs must be .* EPSG": dict(points=X, y=X, z=X, crs=[1]),
    "There are no points": dict(points=[], y=[], z=[]),
}


@pytest.mark.parametrize("words", WRONG)
def test_an_error_names_the_argument(words):
    with pytest.raises(bare_earth.BareEarthError, match=words):
        arrays.ground(**WRONG[words])


def test_ground_that_is_not_there_is_told():
    with pytest.raises(bare_earth.BareEarthError, match="cloud has no ground"):
        arrays.heights(X, X, X)
    with pytest.raises(bare_earth.BareEarthError, match=r"raster dem, .* dtm"):
        arrays.terrain(X, X, X, rasters="dem")
    with pytest.raises(TypeError, match="cell_size"):
        arrays.terrain(X, X, X, cell_size=1)


SCRIPT = """
import laspy
import numpy as np
from bare_earth import arrays
las = laspy.read('a.laz')
mask = arrays.ground(las, method='slope', progress=print)
xyz = np.zeros((9, 3))
heights = arrays.heights(xyz, ground=mask, crs='EPSG:25832')
print(heights.mean() + 1.0, mask.sum())
dtm = arrays.terrain(las, ground=mask, rasters=['dtm'])['dtm']
print(dtm.transform[0], dtm.values.shape, arrays.check(las).hold_out_rmse)
lines = arrays.contours(dtm, interval=2.0)
print(lines.values['ELEV'], lines.to_geopandas(), arrays.expected_error(las).values.max())
blocks = arrays.blocks(['tiles', 'https://example.org/a.copc.laz'], preset='hilly')
print(blocks[0].extent[0], blocks[0]()['X'].mean(), arrays.terrain(blocks)['dtm'].values)
arrays.ground(las, metod='slope')
"""


@pytest.fixture
def script(tmp_path):
    package = tmp_path / "bare_earth"
    package.mkdir()
    (package / "algorithms").symlink_to(ROOT / "algorithms", target_is_directory=True)
    stub.write(package)
    (tmp_path / "script.py").write_text(SCRIPT)
    return tmp_path / "script.py"


def only_error(command, script, mark):
    command = [sys.executable, "-m", *map(str, command), str(script)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=script.parent)
    (line,) = (line for line in done.stdout.splitlines() if mark in line)
    assert "script.py:16" in line and "metod" in line


@pytest.mark.long
def test_mypy_accepts_a_script(script, tmp_path):
    (tmp_path / "mypy.ini").write_text(
        f"[mypy]\nstrict = True\nfollow_imports = silent\nignore_missing_imports = True\n"
        f"mypy_path = {tmp_path}\ncache_dir = {ROOT / 'build' / 'mypy-user'}\n"
    )
    only_error(["mypy", "--config-file", tmp_path / "mypy.ini"], script, ": error: ")


@pytest.mark.long
def test_pyright_accepts_a_script(script):
    pytest.importorskip("pyright")
    only_error(["pyright", "--pythonpath", sys.executable], script, " error: ")


@pytest.mark.long
@pytest.mark.parametrize(
    "path", sorted((FOLDER / "real").glob("*.la[sz]")), ids=lambda path: path.name
)
def test_all_real_tiles_get_the_labels_of_the_file(path, tmp_path):
    if path.name not in REAL:
        test_real_tiles_get_the_labels_of_the_file(path.name, tmp_path)


@pytest.mark.rest
@pytest.mark.parametrize("name", quick(REAL, "house_slope.laz"))
def test_real_tiles_get_the_labels_of_the_file(name, tmp_path):
    pytest.importorskip("pyproj")
    source, target = real(f"real/{name}"), tmp_path / "done.laz"
    bare_earth.classify(source, target)
    las, wanted = laspy.read(str(source)), classes_of(target)
    assert np.array_equal(arrays.classify(las), wanted)
    crs = las.header.parse_crs()
    assert np.array_equal(arrays.classify(columns(las), crs=crs), wanted)
