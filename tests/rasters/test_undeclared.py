"""Cells with a value for no data that their raster does not declare are no terrain, and told."""

import json

import numpy as np
import pytest
import rasterio
from runs import Heard
from surveys import ORIGIN, write_points

import bare_earth
from bare_earth.algorithms.rasters.geotiff import read_raster

LEAST = np.finfo(np.float32).min
SIDE = 40


def hill(lowest=100.0, height=20.0):
    y, x = np.mgrid[:SIDE, :SIDE] / SIDE
    return np.round(lowest + height * np.sin(3 * x) * np.sin(3 * y), 1)


def write(path, cells, nodata=None, kind="float32", scale=1.0):
    transform = rasterio.transform.from_origin(*ORIGIN[:2], 1.0, 1.0)
    with rasterio.open(
        path, "w", "GTiff", SIDE, SIDE, 1, "EPSG:25832", transform, kind, nodata=nodata
    ) as file:
        file.write(cells.astype(kind), 1)
        file.scales = (scale,)
    return path


def with_hole(value, cells=None):
    cells = hill() if cells is None else cells
    cells[5:9, 5:9] = value
    return cells


def read(path, heard):
    """Return the heights that tools read, masked where there are none."""
    raster = read_raster(path, 1, heard)
    raster.report(heard)
    return np.ma.masked_invalid(raster.heights)


def told(heard):
    return [line for line in heard.warnings if "far from" in line]


@pytest.mark.parametrize("value", [-9999, -32768, -32767, -99999, -999, LEAST, -1e30, 1.70141e38])
def test_a_usual_value_far_from_all_heights_is_no_data(tmp_path, value):
    path, heard = write(tmp_path / "dem.tif", with_hole(value)), Heard()
    cells = read(path, heard)
    assert cells.mask.sum() == 16 and cells.mask[5:9, 5:9].all() and cells.min() > 99.0
    (line,) = told(heard)
    assert line.startswith(f"{path} has 16 cells of {value:.6g}, ")


def test_other_kinds_of_cells_and_declared_values(tmp_path):
    both = with_hole(-9999)
    both[20, 20:23] = -32768
    heard = Heard()
    cells = read(write(tmp_path / "both.tif", both, nodata=-32768), heard)
    assert cells.mask.sum() == 19 and "has 16 cells of -9999" in told(heard)[0]
    heard = Heard()
    cells = read(write(tmp_path / "int.tif", both.astype(np.int16), kind="int16"), heard)
    assert cells.mask.sum() == 19 and "3 cells of -32768, 16 cells of -9999" in told(heard)[0]
    heard, tenths = Heard(), with_hole(-32768, hill() * 10)
    assert read(write(tmp_path / "dm.tif", tenths, kind="int16", scale=0.1), heard).min() > 99
    assert len(told(heard)) == 1
    heard, double = Heard(), with_hole(np.finfo(np.float64).min)
    assert read(write(tmp_path / "double.tif", double, kind="float64"), heard).mask.sum() == 16
    assert len(told(heard)) == 1


@pytest.mark.parametrize(
    "cells",
    [
        np.rint(hill(-10_005.0, 12.0)),  # a trench in whole metres, some of it at -9999
        with_hole(-9999, hill(-9800.0, 300.0)),
        with_hole(9999, hill(2000.0, 7900.0)),  # feet
        with_hole(-999, hill(-900.0, 900.0)),
    ],
)
def test_terrain_near_such_a_value_stays(tmp_path, cells):
    heard = Heard()
    found = read(write(tmp_path / "dem.tif", cells), heard)
    assert not told(heard) and not np.ma.is_masked(found)


def test_it_is_no_terrain_in_any_tool(tmp_path):
    path = write(tmp_path / "dem.tif", with_hole(-9999))
    random, clean = np.random.default_rng(1), write(tmp_path / "clean.tif", hill())
    x, y = random.uniform(2, SIDE - 2, (2, 900))
    y -= SIDE
    cells = hill()[np.floor(-y).astype(int), np.floor(x).astype(int)]
    cloud = write_points(tmp_path / "a.laz", x, y, cells - ORIGIN[2], 2, crs="EPSG:25832")
    heard, lines = Heard(), tmp_path / "lines.geojson"
    bare_earth.contours(path, lines, interval=2.0, progress=heard)
    heights = {one["properties"]["ELEV"] for one in json.loads(lines.read_text())["features"]}
    assert heights and min(heights) >= 100 and len(told(heard)) == 1
    heard = Heard()
    bare_earth.relief(path, tmp_path / "relief.tif", kind="slope", progress=heard)
    with rasterio.open(tmp_path / "relief.tif") as file:
        assert file.read(1, masked=True).max() < 70 and len(told(heard)) == 1
    heard = Heard()
    found = bare_earth.heights(cloud, tmp_path / "b.laz", dtm=path, progress=heard)
    assert found.maximum < 10 and len(told(heard)) == 1
    heard, places = Heard(), np.column_stack((x, y, cells - ORIGIN[2]))[::40] + ORIGIN
    wanted = bare_earth.check(cloud, checkpoints=places, dtm=clean)
    found = bare_earth.check(cloud, checkpoints=places, dtm=path, progress=heard)
    assert found.dtm_nva.rmse < 3 * wanted.dtm_nva.rmse + 0.1 and len(told(heard)) == 1
