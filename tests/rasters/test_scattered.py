"""Rasters that are written from the values of some cells."""

import numpy as np
import pytest

from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.core.progress import Progress
from bare_earth.algorithms.rasters import scattered
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.rasters.scattered import ScatteredCells, write_scattered

rasterio = pytest.importorskip("rasterio")


@pytest.mark.parametrize("kind", ["float32", "uint8"])
def test_cells_written_in_many_parts_are_those_of_one(tmp_path, monkeypatch, kind):
    random = np.random.default_rng(1)
    expected = np.zeros((1200, 1700), dtype=kind)
    near = random.integers(0, 200, (2, 500)), random.integers(1000, 1100, (2, 300))
    for row, column in near:
        expected[row, column] = random.integers(1, 200, len(row))
    expected[1199, 1699] = 7
    row, column = np.nonzero(expected)
    order = random.permutation(len(row))
    row, column = row[order], column[order]
    grid = RasterGrid(0.0, 1200.0, 1.0, 1700, 1200, Frame())
    files = [tmp_path / "one.tif", tmp_path / "many.tif"]
    for file, count in zip(files, (16_000_000, 1)):
        monkeypatch.setattr(scattered, "_CELLS", count)
        cells = ScatteredCells(row, column, expected[row, column])
        write_scattered(file, cells, grid, 0.0, Progress(), "Value")
        with rasterio.open(file) as raster:
            np.testing.assert_array_equal(raster.read(1), expected)
    assert files[0].read_bytes() == files[1].read_bytes()
