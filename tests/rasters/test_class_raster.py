"""Rasters of the classes of a point cloud."""

import numpy as np
import pytest
from surveys import heights_of, write_points

from bare_earth.algorithms.survey.vpc import write_vpc
from bare_earth.algorithms.tools.rasters.class_raster import (
    NO_CLASS,
    ClassCells,
    write_class_raster,
)

pytest.importorskip("rasterio")


def test_a_cell_is_ground_if_half_of_its_points_are_and_else_what_says_most():
    points = {0: [2, 1], 1: [2, 1, 5], 2: [1, 1], 3: [6, 2, 1, 1], 5: [2]}
    cells = np.repeat(list(points), [len(classes) for classes in points.values()])
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


def write_cloud(path, west=0.0):
    """Write a square of 20 m with ground in the west, buildings in the north, and other points."""
    side = np.arange(0.25, 20.0, 0.5)
    x, y = (axis.ravel() for axis in np.meshgrid(side, side))
    write_points(path, x + west, y, 0 * x, np.where(x < 5, 2, np.where(y > 15, 6, 1)))


def check_square(values):
    assert (values[:, :5] == 2).all()
    assert (values[:5, 5:] == 6).all() and (values[5:, 5:] == 1).all()


@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_a_file_becomes_a_raster_with_each_class_in_its_place(tmp_path, suffix):
    source, target = tmp_path / f"cloud{suffix}", tmp_path / "classes.tif"
    write_cloud(source)
    assert write_class_raster(source, target) == [1, 2, 6]
    values = heights_of(target)
    check_square(values[~np.isnan(values)].reshape(20, 20))


def test_the_files_of_a_survey_become_one_raster(tmp_path):
    files = [tmp_path / "east.laz", tmp_path / "west.las"]
    write_cloud(files[0], west=30.0)
    write_cloud(files[1])
    write_vpc(tmp_path / "all.vpc", files)
    assert write_class_raster(tmp_path / "all.vpc", tmp_path / "classes.tif") == [1, 2, 6]
    values = heights_of(tmp_path / "classes.tif")[-20:, :50]
    check_square(values[:, :20])
    check_square(values[:, 30:])
    assert np.isnan(values[:, 20:30]).all()
