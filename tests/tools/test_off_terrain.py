import importlib.util
import json

import numpy as np
import pytest
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.rasters.geotiff import read_raster
from bare_earth.algorithms.tools import off_terrain
from bare_earth.algorithms.tools.off_terrain import (
    OffTerrain,
    remove_objects,
    remove_objects_file,
)

rasterio = pytest.importorskip("rasterio")

ROWS, COLUMNS = 120, 150
FEET = 0.3048
CELL = (1.0, 1.0)


def places():
    return np.meshgrid(np.arange(COLUMNS) + 0.5, np.arange(ROWS) + 0.5)


def terrain():
    """Return a slope with a hill 10 m high: about 13 degrees, as broad as a building."""
    x, y = places()
    return (
        200.0 + 0.08 * x - 0.05 * y + 10.0 * np.exp(-((x - 105) ** 2 + (y - 75) ** 2) / 2 / 25**2)
    )


def surface(seed=0):
    """Return the terrain, the same with a flat and a gabled roof and trees, and where these are."""
    x, y = places()
    ground = terrain()
    heights, objects = ground.copy(), np.zeros(ground.shape, bool)
    flat = (x > 20) & (x < 44) & (y > 20) & (y < 56)
    gable = (np.abs(x - 90) < 6) & (np.abs(y - 25) < 9)
    heights[flat] = ground[flat].max() + 7.0
    heights[gable] = ground[gable].max() + 4.0 + 0.4 * (6 - np.abs(x - 90))[gable]
    objects |= flat | gable
    random = np.random.default_rng(seed)
    for east, north in random.uniform((5, 65), (80, 115), (14, 2)):
        crown = np.hypot(x - east, y - north) < 3.5
        heights[crown] = ground[crown] + random.uniform(4.0, 9.0, int(crown.sum()))
        objects |= crown
    return ground, heights, objects


def write(path, heights, crs="EPSG:25832", nodata=-9999.0, unit="", **more):
    transform = more.pop("transform", rasterio.Affine(1.0, 0.0, 5e5, 0.0, -1.0, 5.7e6))
    values = np.where(np.isnan(heights), nodata, heights).astype(more.pop("dtype", "float32"))
    with rasterio.open(
        path, "w", driver="GTiff", width=values.shape[1], height=values.shape[0], nodata=nodata,
        dtype=values.dtype, crs=crs, transform=transform, count=more.pop("count", 1), **more,
    ) as raster:  # fmt: skip
        raster.write(values, raster.count)
        if unit:
            raster.units = (unit,) * raster.count
    return path


def test_buildings_and_trees_go_and_hill_and_slope_stay():
    ground, heights, objects = surface()
    bare, removed = remove_objects(heights, CELL)
    assert np.array_equal(removed, objects)
    assert np.abs(bare - ground).max() < 0.1
    assert np.array_equal(bare[~removed], heights[~removed].astype(np.float32))


def test_noise_does_not_change_that():
    ground, heights, objects = surface()
    heights += np.random.default_rng(1).normal(0.0, 0.03, heights.shape)
    bare, removed = remove_objects(heights, CELL)
    assert np.mean(removed != objects) < 0.002
    assert np.abs(bare - ground).max() < 0.25


@pytest.mark.parametrize("slope", [0.0, 0.3, 1.0])
def test_an_even_slope_stays_as_it_is(slope):
    x, _ = places()
    bare, removed = remove_objects(slope * x, CELL)
    assert not removed.any() and np.allclose(bare, slope * x)


def test_a_building_larger_than_the_largest_object_stays():
    ground, heights, _ = surface()
    bare, _ = remove_objects(heights, CELL, OffTerrain(max_object_size=12.0))
    assert (bare - ground)[35:40, 30:35].min() > 5.0
    assert np.abs(bare - ground)[20:30, 85:95].max() < 0.15


def test_the_slope_threshold_tells_a_hill_from_an_object():
    ground = terrain()
    assert not remove_objects(ground, CELL)[1].any()
    steep = OffTerrain(max_object_size=60.0, slope_threshold=2.0)
    assert remove_objects(ground, CELL, steep)[1][70:80, 100:110].any()


def test_a_way_one_cell_wide_does_not_save_a_roof():
    ground = np.full((60, 60), 50.0)
    heights, x = ground.copy(), np.arange(60)
    heights[20:40, 30:50] = 54.0
    heights[30, 10:30] = 50.0 + 0.2 * (x[10:30] - 10)
    bare, _ = remove_objects(heights, CELL)
    assert np.abs(bare - ground).max() < 0.3
    heights[20:40, 10:30] = 50.0 + 0.2 * (x[10:30] - 10)
    assert not remove_objects(heights, CELL)[1][21:39].any()


def test_no_data_stays_and_does_not_hide_objects():
    ground, heights, objects = surface()
    gap = np.zeros(heights.shape, bool)
    gap[50:70, 40:60] = gap[:10] = True
    heights[gap] = np.nan
    bare, removed = remove_objects(heights, CELL)
    assert np.array_equal(np.isnan(bare), gap)
    assert not removed[gap].any()
    assert np.mean((removed != objects)[~gap]) < 0.001
    assert np.abs(bare - ground)[~gap].max() < 0.3


def test_oblong_cells_are_measured_as_they_are():
    ground, heights, objects = surface()
    # Every second row: cells of 1 x 2 m.
    bare, removed = remove_objects(heights[::2], (1.0, 2.0))
    assert np.array_equal(removed, objects[::2])
    assert np.abs(bare - ground[::2]).max() < 0.2


def test_grids_without_anything():
    empty = np.full((4, 5), np.nan)
    bare, removed = remove_objects(empty, CELL)
    assert np.isnan(bare).all() and not removed.any()
    assert remove_objects(np.array([[3.0]]), CELL)[0] == 3.0


def test_the_file_keeps_grid_crs_and_what_stays(tmp_path):
    ground, heights, objects = surface()
    heights[:5, :5] = np.nan
    write(tmp_path / "dsm.tif", heights, dtype="float64")
    removal = remove_objects_file(tmp_path / "dsm.tif", tmp_path / "dtm.tif")
    assert removal.cell_count == heights.size - 25
    assert removal.removed_count == objects.sum()
    with (
        rasterio.open(tmp_path / "dsm.tif") as before,
        rasterio.open(tmp_path / "dtm.tif") as raster,
    ):
        assert (raster.transform, raster.crs) == (before.transform, before.crs)
        assert raster.profile["tiled"] and raster.profile["compress"] == "deflate"
        assert raster.dtypes == ("float32",)
        bare = raster.read(1, masked=True)
        assert np.array_equal(bare.mask, np.isnan(heights))
        assert np.abs(bare - ground).max() < 0.1
        kept = ~objects & ~bare.mask
        assert np.array_equal(bare.data[kept], heights.astype(np.float32)[kept])
    assert sorted(path.name for path in tmp_path.iterdir()) == ["dsm.tif", "dtm.tif"]


@pytest.mark.parametrize("unit", ["ft", ""])
def test_feet_are_honoured(tmp_path, unit):
    # NAD83 / Texas Central in US survey feet: cells and heights in feet give the same result.
    ground, heights, objects = surface()
    feet = rasterio.Affine(1 / FEET, 0.0, 3e6, 0.0, -1 / FEET, 1e7)
    write(tmp_path / "dsm.tif", heights / FEET, "EPSG:2277", transform=feet, unit=unit)
    removal = remove_objects_file(tmp_path / "dsm.tif", tmp_path / "dtm.tif")
    assert removal.removed_count == objects.sum()
    with rasterio.open(tmp_path / "dtm.tif") as raster:
        assert np.abs(raster.read(1) - ground / FEET).max() < 0.1 / FEET
        assert (raster.units[0] or "") == unit


def test_the_unit_of_the_band_goes_before_that_of_the_crs(tmp_path):
    write(tmp_path / "a.tif", terrain(), unit="US survey foot")
    frame = read_raster(tmp_path / "a.tif").frame
    assert frame.horizontal_unit == 1.0
    assert frame.vertical_unit == pytest.approx(1200 / 3937)


def test_scaled_whole_numbers_masks_and_bands(tmp_path):
    with rasterio.open(
        write(tmp_path / "a.tif", np.full((3, 4), 7.0), dtype="int16", nodata=-1, count=2), "r+"
    ) as raster:
        raster.scales, raster.offsets = (1.0, 0.1), (0.0, 100.0)
        raster.write(np.full((3, 4), -1, np.int16), 1)
    assert np.isnan(read_raster(tmp_path / "a.tif", 1).heights).all()
    assert np.allclose(read_raster(tmp_path / "a.tif", 2).heights, 100.7)
    with pytest.raises(BareEarthError, match="no band 3: it has 2"):
        read_raster(tmp_path / "a.tif", 3)


def test_a_rotated_raster(tmp_path):
    transform = rasterio.Affine(0.6, 0.8, 5e5, 0.8, -0.6, 5.7e6)
    _, heights, objects = surface()
    write(tmp_path / "dsm.tif", heights, transform=transform)
    assert read_raster(tmp_path / "dsm.tif").cell_metres == pytest.approx((1.0, 1.0))
    removal = remove_objects_file(tmp_path / "dsm.tif", tmp_path / "dtm.tif")
    assert removal.removed_count == objects.sum()
    with rasterio.open(tmp_path / "dtm.tif") as raster:
        assert raster.transform.almost_equals(transform)


NORTHERN = rasterio.Affine(1.0, 0.0, 3e6, 0.0, -1.0, 8_399_000.0)
BAD = {
    "geographic": (lambda path: write(path, terrain(), "EPSG:4326"), "projected CRS"),
    "Web Mercator": (
        lambda path: write(path, terrain(), "EPSG:3857", transform=NORTHERN),
        r"2\.00 times",
    ),
    "empty": (lambda path: path.write_bytes(b""), "Cannot read"),
    "text": (lambda path: path.write_text("not a raster"), "Cannot read"),
    "missing": (lambda path: None, "does not exist"),
    "no data": (lambda path: write(path, np.full((9, 9), np.nan)), "band 1"),
    "complex": (lambda path: write(path, terrain(), dtype="complex64"), "not heights"),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_bad_raster_gives_one_line_and_leaves_nothing(kind, tmp_path):
    make, words = BAD[kind]
    make(tmp_path / "bad.tif")
    with pytest.raises(BareEarthError, match=words) as error:
        remove_objects_file(tmp_path / "bad.tif", tmp_path / "out.tif")
    assert "bad.tif" in str(error.value) and "\n" not in str(error.value)
    assert not (tmp_path / "out.tif").exists()


def test_without_a_crs_metres_are_taken_with_a_warning(tmp_path):
    heard = Heard()
    write(tmp_path / "a.tif", terrain(), None)
    assert read_raster(tmp_path / "a.tif", progress=heard).frame.horizontal_unit == 1.0
    assert "taken as metres" in heard.warnings[0]


def test_the_input_is_not_overwritten(tmp_path, capsys):
    path = str(tmp_path / "a.tif")
    write(path, terrain())
    assert main(["remove-off-terrain-objects", path, path]) == 1
    assert "same file" in capsys.readouterr().err


def test_a_missing_library_is_told(tmp_path, monkeypatch):
    write(tmp_path / "a.tif", terrain())
    monkeypatch.setattr(importlib.util, "find_spec", lambda name, *_: None)
    with pytest.raises(BareEarthError, match="needs rasterio"):
        read_raster(tmp_path / "a.tif")


def test_the_command(tmp_path, capsys):
    write(tmp_path / "dsm.tif", surface()[1])
    words = ["remove-off-terrain-objects", str(tmp_path / "dsm.tif"), str(tmp_path / "dtm.tif")]
    assert main([*words, "--json", "--max-object-size", "30"]) == 0
    assert json.loads(capsys.readouterr().out)["removed_count"] > 500
    assert main([*words, "--slope-threshold", "95"]) == 2
    assert "at most 88 deg" in capsys.readouterr().err


def test_a_raster_that_takes_more_memory_than_is_free_is_refused(tmp_path, monkeypatch):
    source, target = tmp_path / "in.tif", tmp_path / "out.tif"
    with rasterio.open(
        source, "w", driver="GTiff", height=ROWS, width=COLUMNS, count=1, dtype="float32"
    ) as raster:
        raster.write(terrain().astype(np.float32), 1)
    monkeypatch.setattr(off_terrain, "free_memory", lambda: 100_000)
    with pytest.raises(BareEarthError, match=r"150 x 120 cells.* 0\.0 GB"):
        remove_objects_file(source, target)
    assert not target.exists()
    monkeypatch.setattr(off_terrain, "free_memory", lambda: 1_000_000)
    remove_objects_file(source, target)
    assert target.exists()
