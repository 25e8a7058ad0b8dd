"""Canopy heights: the highest height above the ground of each cell, and of two rasters."""

import json

import numpy as np
import pytest
from runs import Heard
from surveys import ORIGIN, write_points

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.rasters.content import NO_CELLS
from bare_earth.algorithms.rasters.geotiff import read_raster
from bare_earth.algorithms.tools.rasters import surfaces

rasterio = pytest.importorskip("rasterio")

SIDE, SLOPE = 60.0, 0.5  # metres; rise to the east
TREE = 8.0


def slope(path, tree=False, **more):
    """Write ground points of a slope, perhaps with trees 8 m high over a part of it."""
    random = np.random.default_rng(4)
    x, y = random.uniform(0.0, SIDE, (2, 20_000))
    z, classes = 100.0 + SLOPE * x, np.full(len(x), 2)
    if tree:
        crown = (x > 20) & (x < 40) & (y > 20) & (y < 40) & (random.random(len(x)) < 0.5)
        z[crown] += TREE
        classes[crown] = 5
    return write_points(path, x, y, z, classes, **more)


def cells(path):
    with rasterio.open(path) as raster:
        return raster.read(1, masked=True).astype(float).filled(np.nan)


@pytest.mark.rest(but="10.0")
@pytest.mark.parametrize("size", [0.5, 1.0, 5.0, 10.0])
def test_bare_slopes_have_no_canopy_in_cells_of_any_size(tmp_path, size):
    slope(tmp_path / "in.las")
    bare_earth.terrain(tmp_path / "in.las", chm=tmp_path / "chm.tif", dtm_cell_size=size)
    heights = cells(tmp_path / "chm.tif")
    assert np.count_nonzero(~np.isnan(heights)) > 0.8 * (SIDE / size) ** 2
    assert np.nanmax(heights) < 0.001


@pytest.mark.parametrize("size", [1.0, 5.0])
def test_trees_on_slopes_are_as_high_as_they_are(tmp_path, size):
    slope(tmp_path / "in.las", tree=True)
    bare_earth.terrain(tmp_path / "in.las", chm=tmp_path / "chm.tif", dtm_cell_size=size)
    heights = cells(tmp_path / "chm.tif")
    assert np.nanmax(heights) == pytest.approx(TREE, abs=0.06)
    assert (heights > TREE - 0.06).sum() * size**2 == pytest.approx(400.0, rel=0.12)


def test_units_and_all_returns_do_not_change_it(tmp_path):
    slope(tmp_path / "in.las", tree=True, crs="EPSG:6438+6360")  # US survey feet
    bare_earth.terrain(
        tmp_path / "in.las", chm=tmp_path / "chm.tif", dtm_cell_size=3.0, surface_returns="all",
        dtm_cell_unit="crs",
    )  # fmt: skip
    assert np.nanmax(cells(tmp_path / "chm.tif")) == pytest.approx(TREE, abs=0.1)


@pytest.mark.rest
def test_the_surface_and_the_canopy_have_values_in_the_same_cells(tmp_path):
    slope(tmp_path / "in.las", tree=True)
    files = {name: tmp_path / f"{name}.tif" for name in ("dtm", "dsm", "chm")}
    bare_earth.terrain(tmp_path / "in.las", **files, dtm_cell_size=0.25)
    dtm, dsm, chm = (cells(path) for path in files.values())
    assert np.array_equal(np.isnan(chm), np.isnan(dsm) | np.isnan(dtm))
    # Cells without a point are interpolated between heights above the ground.
    assert np.nanpercentile(np.abs(chm - np.maximum(dsm - dtm, 0.0)), 95) < 0.3


def test_strips_of_points_make_no_difference(tmp_path, monkeypatch):
    slope(tmp_path / "in.las", tree=True)
    made = []
    for count, tile in ((surfaces._POINTS_A_STRIP, surfaces.TILE), (2_000, 16)):
        monkeypatch.setattr(surfaces, "_POINTS_A_STRIP", count)
        monkeypatch.setattr(surfaces, "TILE", tile)  # strips of the canopy end at its multiples
        files = {name: tmp_path / f"{name}-{count}.tif" for name in ("dsm", "chm")}
        bare_earth.terrain(tmp_path / "in.las", **files, dtm_cell_size=0.7)
        made.append([cells(path) for path in files.values()])
    for whole, strips in zip(*made):
        assert np.isfinite(whole).any()
        np.testing.assert_allclose(strips, whole, atol=1e-4)


def test_a_step_on_a_breakline_has_no_canopy(tmp_path):
    random = np.random.default_rng(5)
    x, y = random.uniform(0.0, 40.0, (2, 6_000))
    upper = x > 20.0
    write_points(tmp_path / "in.las", x, y, np.where(upper, 103.0, 100.0), np.where(upper, 1, 2))
    edge = [[east + ORIGIN[0], north + ORIGIN[1], height] for east, height in ((20.0, 100.0),
            (20.05, 103.0)) for north in (0.0, 40.0)]  # fmt: skip
    lines = {"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {},
         "geometry": {"type": "LineString", "coordinates": edge[start : start + 2]}}
        for start in (0, 2)
    ]}  # fmt: skip
    (tmp_path / "edge.geojson").write_text(json.dumps(lines), encoding="utf-8")
    bare_earth.terrain(
        tmp_path / "in.las", chm=tmp_path / "chm.tif", breaklines=tmp_path / "edge.geojson"
    )
    west = cells(tmp_path / "chm.tif")[:, :19]
    assert np.nanmax(west) < 0.01


def raster(path, heights, west=5e5, size=1.0, crs="EPSG:25832"):
    transform = rasterio.Affine(size, 0.0, west, 0.0, -size, 5.7e6)
    with rasterio.open(
        path, "w", driver="GTiff", width=heights.shape[1], height=heights.shape[0], nodata=-9999.0,
        dtype="float32", crs=crs, transform=transform, count=1,
    ) as file:  # fmt: skip
        file.write(np.where(np.isnan(heights), -9999.0, heights).astype("float32"), 1)
    return path


def pair(folder, **terrain):
    """Write a terrain of 1 % and a surface 6 m above a part of it; return the expected canopy."""
    column = np.arange(40) + 0.5
    land = np.tile(100.0 + 0.01 * column, (30, 1))
    surface = land - 0.2
    surface[5:15, 10:25] = land[5:15, 10:25] + 6.0
    surface[20, 20] = np.nan
    raster(folder / "dsm.tif", surface)
    raster(folder / "dtm.tif", **{"heights": land, **terrain})
    return np.where(surface > land, 6.0, np.where(np.isnan(surface), np.nan, 0.0))


def test_canopy_of_two_rasters(tmp_path, capsys):
    expected = pair(tmp_path)
    words = ["canopy", "dsm.tif", "dtm.tif", "chm.tif"]
    assert main([words[0], *(str(tmp_path / name) for name in words[1:]), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["cell_count"] == 1199 and told["maximum"] == pytest.approx(6.0, abs=1e-4)
    chm = tmp_path / "chm.tif"
    assert np.allclose(cells(chm), expected, atol=1e-4, equal_nan=True)
    one, other = (read_raster(path, window=NO_CELLS) for path in (tmp_path / "dsm.tif", chm))
    assert (one.whole, one.geotransform) == (other.whole, other.geotransform)
    assert other.crs.epsg == 25832


def test_a_terrain_on_another_grid_is_interpolated_and_told(tmp_path):
    centres = 500_000.0 - 1.25 + 2.5 * (np.arange(20) + 0.5)
    land = np.tile(100.0 + 0.01 * (centres - 500_000.0), (14, 1))
    expected = pair(tmp_path, heights=land, west=5e5 - 1.25, size=2.5)
    heard = Heard()
    bare_earth.canopy(
        tmp_path / "dsm.tif", tmp_path / "dtm.tif", tmp_path / "chm.tif", progress=heard
    )
    assert any("dtm.tif is not on the grid" in text for text in heard.infos)
    assert np.allclose(cells(tmp_path / "chm.tif"), expected, atol=1e-3, equal_nan=True)


def test_pits_of_two_rasters_are_filled(tmp_path):
    pair(tmp_path)
    heights = cells(tmp_path / "dsm.tif")
    heights[10, 15] -= 5.0
    raster(tmp_path / "dsm.tif", heights)
    paths = tmp_path / "dsm.tif", tmp_path / "dtm.tif", tmp_path / "chm.tif"
    bare_earth.canopy(*paths)
    assert cells(paths[2])[10, 15] == pytest.approx(1.0, abs=1e-3)
    bare_earth.canopy(*paths, pit_free=True)
    assert cells(paths[2])[10, 15] == pytest.approx(6.0, abs=1e-3)


@pytest.mark.parametrize(
    ("terrain", "swapped", "message"),
    [
        ({"crs": "EPSG:25833"}, False, "Reproject"),
        ({"west": 6e5}, False, "No cell .* both"),
        ({"heights": np.full((30, 40), 110.0)}, False, "surface model first"),
        ({"heights": np.full((30, 40), 90.0)}, True, "surface model first"),
    ],
)
def test_rasters_that_do_not_belong_together_are_refused(tmp_path, terrain, swapped, message):
    pair(tmp_path, **terrain)
    names = ("dtm.tif", "dsm.tif") if swapped else ("dsm.tif", "dtm.tif")
    with pytest.raises(BareEarthError, match=message):
        bare_earth.canopy(*(tmp_path / name for name in names), tmp_path / "chm.tif")
    assert not (tmp_path / "chm.tif").exists()
