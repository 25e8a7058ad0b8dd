"""Canopy that was lost, gained or grew is found, and what flips at the edges of crowns is not."""

import json

import numpy as np
import pytest
from runs import said

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.tools import canopy

rasterio = pytest.importorskip("rasterio")

SIDE, WEST, NORTH = 120, 5e5, 5.7e6
FELLED, PLANTED = np.s_[20:40, 30:60], np.s_[80:90, 80:100]  # 600 m2 and 200 m2
GROWTH = 0.7


def raster(path, heights, west=WEST, size=1.0, unit=""):
    transform = rasterio.Affine(size, 0.0, west, 0.0, -size, NORTH)
    with rasterio.open(
        path, "w", driver="GTiff", width=heights.shape[1], height=heights.shape[0], nodata=-9999.0,
        dtype="float32", crs="EPSG:25832", transform=transform, count=1,
    ) as file:  # fmt: skip
        file.write(np.where(np.isnan(heights), -9999.0, heights).astype("float32"), 1)
        if unit:
            file.units = (unit,)
    return path


def forest():
    """Return heights of a forest of 15 m with a clearing, before and after."""
    old = np.full((SIDE, SIDE), 15.0)
    old[70:100, 70:110] = 0.3
    old[:5] = np.nan
    new = np.where(old > 2.0, old + GROWTH, old)
    new[FELLED], new[PLANTED] = 0.2, 3.0
    return old, new


def pair(folder, **more):
    return [raster(folder / f"{name}.tif", of, **more) for name, of in zip("ab", forest())]


def cells(path):
    with rasterio.open(path) as file:
        return file.read(1, masked=True).astype(float).filled(np.nan)


def test_what_was_felled_planted_and_grew_is_told(tmp_path):
    old, new = pair(tmp_path)
    found = bare_earth.canopy_change(
        old, new, tmp_path / "out.tif", places=tmp_path / "out.geojson"
    )
    known = (SIDE - 5) * SIDE
    assert found.known_area == known and found.area_before == known - 30 * 40
    assert found.area_after == found.area_before - 600 + 200
    assert (found.place_count, found.lost_area, found.gained_area) == (2, 600.0, 200.0)
    assert found.growth == pytest.approx(GROWTH, abs=1e-3) and type(found.growth) is float
    np.testing.assert_allclose(cells(tmp_path / "out.tif"), np.subtract(*forest()[::-1]), atol=1e-5)
    told = [
        one["properties"] for one in json.loads((tmp_path / "out.geojson").read_text())["features"]
    ]
    assert [(one["RANK"], one["KIND"], one["AREA"]) for one in told] == [
        (1, "canopy lost", 600.0), (2, "canopy gained", 200.0),
    ]  # fmt: skip
    assert told[0]["MEAN"] == pytest.approx(-14.8, abs=1e-3)


def test_edges_of_crowns_that_flip_are_no_places_and_narrow_ones_are_if_asked(tmp_path):
    old, new = forest()
    new[50:52, 10:60] = 0.0  # a strip of 2 m
    new[70:72, 10:12] = 0.0
    files = raster(tmp_path / "a.tif", old), raster(tmp_path / "b.tif", new), tmp_path / "out.tif"
    assert bare_earth.canopy_change(*files).place_count == 2
    assert bare_earth.canopy_change(*files, least_width=2.0).lost_area == 600.0 + 100.0 + 4.0
    # A hedge of 3 m is canopy of 2 m and none of 4 m.
    assert bare_earth.canopy_change(*files, least_height=4.0).gained_area == 0.0


def test_places_and_figures_are_the_same_in_pieces(tmp_path, monkeypatch):
    files = [*pair(tmp_path), tmp_path / "out.tif"]
    whole = bare_earth.canopy_change(*files)
    monkeypatch.setattr(canopy, "_CELLS", 7 * SIDE)
    assert bare_earth.canopy_change(*files) == whole


def test_feet_and_other_grids_are_reconciled(tmp_path):
    old, _ = pair(tmp_path)
    feet = raster(tmp_path / "feet.tif", forest()[1] / 0.3048, unit="ft")
    found = bare_earth.canopy_change(old, feet, tmp_path / "out.tif")
    assert found.growth == pytest.approx(GROWTH, abs=1e-3) and found.lost_area == 600.0
    shifted = raster(tmp_path / "shifted.tif", forest()[1], west=WEST + 0.25)
    found = bare_earth.canopy_change(old, shifted, tmp_path / "out.tif")
    assert found.lost_area == pytest.approx(600.0, rel=0.1)


@pytest.mark.parametrize(
    ("heights", "west", "words"),
    [
        (forest()[1] + 600.0, WEST, "canopy height model"),
        (forest()[1], WEST + 1e4, "No cell .* both"),
        (np.full((SIDE, SIDE), np.nan), WEST, "No cell|empty"),
    ],
)
def test_what_cannot_be_compared_is_refused_in_a_sentence(tmp_path, heights, west, words):
    old, _ = pair(tmp_path)
    other = raster(tmp_path / "other.tif", heights, west=west)
    with pytest.raises(BareEarthError, match=words):
        bare_earth.canopy_change(old, other, tmp_path / "out.tif")
    assert not (tmp_path / "out.tif").exists()


def test_the_command_prints_what_was_found_and_places_can_be_missing(tmp_path):
    bare = raster(tmp_path / "bare.tif", np.zeros((SIDE, SIDE)))
    code, printed, _ = said("canopy-change", bare, bare, tmp_path / "out.tif")
    assert not code and "0 places: 0 m² lost" in printed and "stays" not in printed
    code, printed, _ = said("canopy-change", bare, bare, tmp_path / "out.tif", "--json")
    assert json.loads(printed)["growth"] is None
