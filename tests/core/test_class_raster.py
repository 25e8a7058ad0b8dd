"""Rasters of the classes of a point cloud."""

import laspy
import numpy as np
import pytest

from bare_earth.algorithms.products.class_raster import NO_CLASS, ClassCells, write_class_raster
from bare_earth.algorithms.rasters.geotiff import read_raster

pytest.importorskip("rasterio")


def test_a_cell_is_ground_if_half_of_its_points_are_and_else_what_says_most():
    points = {0: [2, 1], 1: [2, 1, 5], 2: [1, 1], 3: [6, 2, 1, 1], 5: [2]}
    cells = np.repeat(list(points), [len(each) for each in points.values()])
    classes = np.concatenate(list(points.values())).astype(np.uint8)
    whole = ClassCells(6)
    whole.add(cells, classes)
    assert whole.values().tolist() == [2, 5, 1, 6, NO_CLASS, 2]
    # However the points come.
    order = np.random.default_rng(1).permutation(len(cells))
    parts = ClassCells(6)
    for some in np.array_split(order, 4):
        parts.add(cells[some], classes[some])
    assert np.array_equal(parts.values(), whole.values())


@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_a_file_becomes_a_raster_with_each_class_in_its_place(tmp_path, suffix):
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = (0.01,) * 3, (500_000.0, 5_700_000.0, 0.0)
    las = laspy.LasData(header)
    side = np.arange(0.25, 20.0, 0.5)
    x, y = (each.ravel() for each in np.meshgrid(side, side))
    las.x, las.y, las.z = x + 500_000, y + 5_700_000, np.zeros_like(x)
    las.classification = np.where(x < 5, 2, np.where(y > 15, 6, 1)).astype(np.uint8)
    source, target = tmp_path / f"cloud{suffix}", tmp_path / "classes.tif"
    las.write(str(source))
    write_class_raster(source, target)
    values = read_raster(target).heights
    inside = values[~np.isnan(values)].reshape(20, 20)
    assert (inside[:, :5] == 2).all()
    assert (inside[:5, 5:] == 6).all() and (inside[5:, 5:] == 1).all()
