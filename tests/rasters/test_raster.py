import os
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from bare_earth import BareEarthError, Cancelled, Progress
from bare_earth.algorithms.core.points import Frame, Points
from bare_earth.algorithms.rasters import writing
from bare_earth.algorithms.rasters.geotiff import NODATA, RasterGrid, read_raster
from bare_earth.algorithms.rasters.sparse import RasterPart
from bare_earth.algorithms.rasters.writing import RasterCells, write_geotiff

rasterio = pytest.importorskip("rasterio")

FEET = 0.3048


def square(side, z=0.0):
    corners = np.array([[0.0, 0.0], [side, 0.0], [0.0, side], [side, side]])
    return Points(corners[:, 0], corners[:, 1], np.full(4, z))


def test_the_grid_is_a_multiple_of_the_cell_size_and_covers_the_points():
    grid = RasterGrid.over(square(9.0), Frame(origin=(100.3, 200.3)), 2.0)
    assert (grid.west, grid.north) == (100.0, 210.0)
    assert (grid.columns, grid.rows) == (5, 5)
    assert grid.x[0] == pytest.approx(0.7) and grid.y[0] == pytest.approx(8.7)


def test_a_cell_size_in_metres_is_converted_to_feet():
    grid = RasterGrid.over(square(10.0), Frame(horizontal_unit=FEET), 1.0)
    assert grid.cell_size == pytest.approx(1 / FEET)
    assert grid.cell_metres == pytest.approx(1.0)
    assert np.diff(grid.x) == pytest.approx(1.0)


def test_a_stray_point_does_not_allocate_a_huge_raster():
    points = Points(np.array([0.0, 1e6]), np.array([0.0, 1e6]), np.zeros(2))
    with pytest.raises(BareEarthError, match="stray coordinates"):
        RasterGrid.over(points, Frame(), 1.0)


@pytest.mark.parametrize(("columns", "rows"), [(100, 4_100_000), (4_100_000, 100)])
def test_a_raster_that_is_long_in_one_direction_counts_by_its_cells(tmp_path, columns, rows):
    path = tmp_path / "long.vrt"
    path.write_text(
        f'<VRTDataset rasterXSize="{columns}" rasterYSize="{rows}">'
        "<GeoTransform>0, 1, 0, 0, 0, -1</GeoTransform>"
        '<VRTRasterBand dataType="Byte" band="1"/></VRTDataset>'
    )
    with pytest.raises(BareEarthError, match=r"too many .*memory"):
        read_raster(path)


def test_no_points_are_an_error_that_says_so():
    with pytest.raises(BareEarthError, match="no ground point"):
        RasterGrid.over(square(1.0).take([]), Frame(), 1.0)


@pytest.mark.parametrize("kind", ["float32", "uint8"])
def test_the_geotiff_is_tiled_deflated_and_has_nodata_and_crs(tmp_path, kind):
    wkt = rasterio.crs.CRS.from_epsg(25832).to_wkt()
    grid = RasterGrid.over(square(300.0), Frame(origin=(5e5, 5.7e6), wkt=wkt), 1.0)
    values = np.arange(grid.rows * grid.columns).reshape(grid.rows, grid.columns).astype(kind)
    nodata = NODATA if kind == "float32" else 0
    write_geotiff(tmp_path / "a.tif", values, grid, nodata, Progress(), "Height")
    with rasterio.open(tmp_path / "a.tif") as raster:
        assert np.array_equal(raster.read(1), values)
        assert raster.profile["tiled"] and raster.profile["compress"] == "deflate"
        assert (raster.nodata, raster.crs.to_epsg()) == (-9999.0 if nodata else 0, 25832)
        assert raster.transform[:6] == (1.0, 0.0, 5e5, 0.0, -1.0, 5.7e6 + 300)
    assert [path.name for path in tmp_path.iterdir()] == ["a.tif"]


def test_a_crs_that_is_not_understood_is_left_out_with_a_warning(tmp_path):
    warnings = []

    class Listener(Progress):
        def warning(self, text):
            warnings.append(text)

    grid = RasterGrid.over(square(3.0), Frame(wkt="LOCAL"), 1.0)
    write_geotiff(
        tmp_path / "a.tif", np.zeros((3, 3), np.float32), grid, NODATA, Listener(), "Height"
    )
    assert "without a CRS" in warnings[0]


FULL_DISK = """
import resource, sys
import numpy as np
from pathlib import Path
from bare_earth import BareEarthError, Progress
from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.rasters.writing import write_geotiff

values = np.random.default_rng(1).random((300, 300)).astype(np.float32)
grid = RasterGrid(0.0, 300.0, 1.0, 300, 300, Frame())
target = Path(sys.argv[1])
write_geotiff(target.with_name("whole.tif"), values, grid, -9999.0, Progress(), "Height")
size = target.with_name("whole.tif").stat().st_size
for missing in (size - 1, 100_000, 20_000, 200, 1):  # the end is written when the file is closed
    resource.setrlimit(resource.RLIMIT_FSIZE, (size - missing, resource.RLIM_INFINITY))
    try:
        write_geotiff(target, values, grid, -9999.0, Progress(), "Height")
        print("written all the same")
    except BareEarthError as error:
        print(error)
"""


@pytest.mark.rest
def test_a_disk_that_becomes_full_leaves_the_old_raster(tmp_path):
    pytest.importorskip("resource")
    target = tmp_path / "a.tif"
    target.write_text("old")
    command = [sys.executable, "-c", FULL_DISK, str(target)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    assert done.stdout.splitlines() == [f"Cannot write {target}: File too large."] * 5
    assert done.stderr == ""
    assert target.read_text() == "old"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.tif", "whole.tif"]


def test_cells_that_find_no_room_to_wait_on_disk_are_told_before_any_is_made(tmp_path, monkeypatch):
    asked = []

    def usage(folder):
        asked.append(folder)
        return SimpleNamespace(free=65_000_000)

    target, side = tmp_path / "out.tif", 8_100  # more than 64 million cells of one byte
    target.write_bytes(b"old")
    monkeypatch.setattr(shutil, "disk_usage", usage)
    rows = RasterCells((side, side), "uint8", (pytest.fail("a row was made") for _ in range(1)))
    grid = RasterGrid(0.0, float(side), 1.0, side, side, Frame())
    with pytest.raises(BareEarthError, match=r"out\.tif: .*disk.* full"):
        write_geotiff(target, rows, grid, 255, Progress(), "classes")
    assert asked == [tmp_path] and target.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_cancel_closes_the_cells_that_wait_on_disk_before_it_removes_them(tmp_path, monkeypatch):
    remove, removed = os.unlink, []

    def unlink(path, **named):
        # Windows removes no file that is open.
        files = Path("/proc/self/fd").iterdir() if Path("/proc/self/fd").exists() else ()
        assert str(path) not in [os.path.realpath(name) for name in files]
        removed.append(Path(path).name)
        remove(path, **named)

    def parts():
        yield RasterPart(0, 0, np.zeros((4, 9), np.uint8))
        raise Cancelled

    monkeypatch.setattr(writing, "_MOST_IN_MEMORY", 10)
    monkeypatch.setattr(os, "unlink", unlink)
    grid = RasterGrid(0.0, 9.0, 1.0, 9, 9, Frame())
    with pytest.raises(Cancelled):
        write_geotiff(
            tmp_path / "a.tif",
            RasterCells((9, 9), "uint8", parts()),
            grid,
            255,
            Progress(),
            "classes",
        )
    assert [file for file in removed if file.endswith(".cells.tif")] and not os.listdir(tmp_path)


def test_a_vertical_crs_that_geotiff_cannot_hold_is_left_out_with_a_warning(tmp_path):
    warnings = []

    class Listener(Progress):
        def warning(self, text):
            warnings.append(text)

    wkt = (
        f'COMPD_CS["both",{rasterio.crs.CRS.from_epsg(25832).to_wkt()},'
        'VERT_CS["Ellipsoid",VERT_DATUM["Ellipsoid",2002],UNIT["metre",1],AXIS["Up",UP]]]'
    )
    grid = RasterGrid.over(square(3.0), Frame(wkt=wkt), 1.0)
    cells = np.zeros((3, 3), np.float32)
    write_geotiff(tmp_path / "a.tif", cells, grid, NODATA, Listener(), "Height, {unit}")
    with rasterio.open(tmp_path / "a.tif") as raster:
        assert "not that of its heights" in warnings[0] and raster.crs.to_epsg() == 25832
    assert [path.name for path in tmp_path.iterdir()] == ["a.tif"]


def test_statistics_of_the_raster_before_are_removed(tmp_path):
    grid, target = RasterGrid.over(square(9.0), Frame(), 1.0), tmp_path / "a.tif"
    statistics = tmp_path / "a.tif.aux.xml"
    statistics.write_text("<PAMDataset></PAMDataset>")
    values = np.zeros((grid.rows, grid.columns), np.float32)
    write_geotiff(target, values, grid, NODATA, Progress(), "Height")
    assert target.exists() and not statistics.exists()


def test_a_point_cloud_is_no_raster(tmp_path):
    cloud = tmp_path / "points.laz"
    cloud.write_bytes(b"LASF" + bytes(400))
    with pytest.raises(BareEarthError, match=r"points\.laz is a point cloud"):
        read_raster(cloud)
