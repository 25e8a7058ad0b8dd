"""Rasters without any value, and points from which none can be made."""

import re

import laspy
import numpy as np
import pytest
from runs import FAST_WORDS, said
from surveys import heights_of, write_points


@pytest.fixture(scope="module")
def on_a_line(tmp_path_factory):
    x, path = np.arange(100.0), tmp_path_factory.mktemp("line") / "in.laz"
    place = 500_000.0, 5_500_000.0, 0.0
    return write_points(path, x, np.full(100, 0.5), 50 + 0.1 * x, 2, offset=place)


def test_a_terrain_model_without_any_value_is_told(on_a_line, tmp_path):
    code, _, told = said("terrain", on_a_line, "--dtm", tmp_path / "o.tif")
    assert code == 0 and np.isnan(heights_of(tmp_path / "o.tif")).all()
    assert re.search(r"No cell .*\(DTM\)", told)


def test_a_raster_with_a_value_is_not_told(tmp_path):
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(20.0), np.arange(20.0)))
    source = write_points(
        tmp_path / "in.laz", x, y, 50 + x, 2, offset=(500_000.0, 5_500_000.0, 0.0)
    )
    words = ["--dtm", tmp_path / "o.tif", "--slope", tmp_path / "s.tif"]
    assert "No cell has a value" not in said("terrain", source, *words)[2]


def test_y_that_is_up_is_told(tmp_path):
    x, z = np.random.default_rng(1).uniform(0, 60, (2, 4_000))
    source = write_points(tmp_path / "in.laz", x, 100 + 0.1 * x, z, 1)
    code, _, told = said("classify", source, tmp_path / "o.laz", "--dtm", tmp_path / "o.tif")
    assert code == 0 and "whether y is up" in told


def test_an_upright_slab_with_values_is_told(tmp_path):
    x, z = np.random.default_rng(1).uniform(0, 60, (2, 4_000))
    y = np.random.default_rng(2).uniform(0, 12, 4_000)
    told = said("classify", write_points(tmp_path / "in.laz", x, y, z, 1), tmp_path / "o.laz")[2]
    assert re.search(r"heights .*60 m\b.* y is up", told)
    source = write_points(tmp_path / "in.laz", x, z, y, 1)
    told = said("classify", source, tmp_path / "p.laz", *FAST_WORDS)[2]
    assert "y is up" not in told


@pytest.mark.parametrize("axis", ["X", "Y", "Z"])
@pytest.mark.parametrize("value", [-(2**31), 2**31 - 1])
def test_coordinates_that_were_cut_off_are_refused(tmp_path, axis, value):
    x, y = np.random.default_rng(1).uniform(0, 60, (2, 4_000))
    source = write_points(tmp_path / "in.laz", x, y, 100 + 0.1 * x, 1)
    las = laspy.read(source)
    las[axis] = np.full(len(las), value, np.int32)
    las.write(source)
    code, _, told = said("classify", source, tmp_path / "o.laz", "--dtm", tmp_path / "o.tif")
    assert code == 1 and f"{axis.lower()} of all points" in told and "limit of the integ" in told


@pytest.mark.parametrize("axis", ["Y", "Z"])
@pytest.mark.parametrize("is_survey", [False, True])
def test_some_coordinates_that_were_cut_off_are_told(tmp_path, axis, is_survey):
    x, y = np.random.default_rng(1).uniform(0, 60, (2, 4_000))
    (tmp_path / "in").mkdir()
    source = write_points(tmp_path / "in" / "a.laz", x, y, 100 + 0.1 * x, 1)
    las = laspy.read(source)
    las[axis][:7] = 2**31 - 1
    las.write(source)
    target = tmp_path / ("out" if is_survey else "o.laz")
    source = source.parent if is_survey else source
    code, _, told = said("classify", source, target, *FAST_WORDS)
    assert code == 0 and f"{axis.lower()} of some points of a.laz" in told
