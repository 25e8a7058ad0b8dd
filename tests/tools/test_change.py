"""The change between two surveys: what changed is found with its volume, and nothing else is."""

import json
import re

import laspy
import numpy as np
import pytest
from runs import Heard, said
from surveys import write_points

import bare_earth
from bare_earth import BareEarthError, arrays

rasterio = pytest.importorskip("rasterio")

SIDE, WEST, NORTH = 160, 5e5, 5.7e6  # cells of 1 m


def land(x, y):
    return 100.0 + 3.0 * np.sin(x / 40.0) + 2.0 * np.cos(y / 30.0)


def heap(x, y, east=50.0, north=60.0, radius=12.0, height=2.0):
    """A round heap; its volume is 0.297 times that of the cylinder round it."""
    near = np.minimum(np.hypot(x - east, y - north) / radius, 1.0)
    return height / 2.0 * (1.0 + np.cos(np.pi * near))


def raster(path, heights, crs="EPSG:25832", west=WEST, size=1.0, unit=""):
    transform = rasterio.Affine(size, 0.0, west, 0.0, -size, NORTH)
    with rasterio.open(
        path, "w", driver="GTiff", width=heights.shape[1], height=heights.shape[0], nodata=-9999.0,
        dtype="float32", crs=crs, transform=transform, count=1,
    ) as file:  # fmt: skip
        file.write(np.where(np.isnan(heights), -9999.0, heights).astype("float32"), 1)
        if unit:
            file.units = (unit,)
    return path


def places(side=SIDE):
    """Return x and y of the centres of cells, in metres from the lower left corner."""
    x, y = np.meshgrid(np.arange(side) + 0.5, side - np.arange(side) - 0.5)
    return x, y


def terrain(seed, change=0.0, side=SIDE):
    """Return a terrain with errors of 3 cm that are correlated over a few cells."""
    from scipy import ndimage

    x, y = places(side)
    noise = np.random.default_rng(seed).normal(0.0, 1.0, (side, side))
    noise = ndimage.gaussian_filter(noise, 1.0)
    return land(x, y) + change + 0.03 * noise / noise.std()


def pair(folder, change=0.0, error=0.1, **more):
    """Write two terrains with expected errors; return the arguments of `change`."""
    raster(folder / "old.tif", terrain(1), **more)
    raster(folder / "new.tif", terrain(2, change), **more)
    raster(folder / "error.tif", np.full((SIDE, SIDE), error), **more)
    errors = {"old_error": folder / "error.tif", "new_error": folder / "error.tif"}
    return (folder / "old.tif", folder / "new.tif", folder / "out.tif"), errors


def cells(path):
    with rasterio.open(path) as file:
        return file.read(1, masked=True).astype(float).filled(np.nan)


def features(path):
    return json.loads(path.read_text(encoding="utf-8"))["features"]


@pytest.mark.parametrize("with_errors", [True, False])
def test_nothing_changed_on_stable_land(tmp_path, with_errors):
    files, errors = pair(tmp_path, 0.15)
    found = bare_earth.change(*files, **(errors if with_errors else {}))
    assert found.risen_area + found.sunk_area <= 0.01 * found.cell_count
    assert found.shift == pytest.approx(0.15, abs=0.01)


@pytest.mark.parametrize("with_errors", [True, False])
def test_a_heap_and_a_bank_have_their_volumes_under_shift_and_tilt(tmp_path, with_errors):
    x, y = places()
    bank = -1.5 * ((x > 110) & (x < 120) & (y > 40) & (y < 110))
    change = heap(x, y) + bank
    files, errors = pair(tmp_path, change + 0.15 + 1e-3 * x)
    out = {"places": tmp_path / "places.geojson", "limit": tmp_path / "limit.tif"}
    found = bare_earth.change(*files, **(errors if with_errors else {}), **out)
    for volume, error, truth in (
        (found.volume_up, found.volume_up_error, heap(x, y).sum()),
        (found.volume_down, found.volume_down_error, -bank.sum()),
    ):
        assert abs(volume - truth) <= error <= 0.2 * truth
    taken = cells(tmp_path / "out.tif") - change
    assert np.abs(np.median(taken)) < 0.01 and np.abs(taken).max() < 0.2
    told = features(tmp_path / "places.geojson")
    assert [one["properties"]["RANK"] for one in told] == [1, 2]
    assert {np.sign(one["properties"]["MEAN"]) for one in told} == {1, -1}
    assert cells(tmp_path / "limit.tif").shape == (SIDE, SIDE)


@pytest.mark.parametrize("given", [(), ("old_error",), ("old_error", "new_error")])
def test_limits_that_follow_from_stable_land_alone_are_doubted(tmp_path, given):
    files, errors = pair(tmp_path, 0.0)
    progress = Heard()
    bare_earth.change(*files, **{name: errors[name] for name in given}, progress=progress)
    assert len(progress.warnings) == (len(given) < 2)
    assert all("too small in gaps" in text for text in progress.warnings)


def test_a_change_below_the_limit_is_not_told(tmp_path):
    files, errors = pair(tmp_path, heap(*places(), height=0.3), error=0.8)
    found = bare_earth.change(*files, **errors)
    assert found.place_count == 0 and found.can_tell[0.3] == 0.0 and found.can_tell[1.0] > 0.9


def test_the_page_shows_map_places_profiles_and_stable_land(tmp_path):
    files, errors = pair(tmp_path, heap(*places()))
    bare_earth.change(*files, page=tmp_path / "page.html", **errors)
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    for title in ("Where the ground changed", "Places of change", "Profiles", "Stable land"):
        assert f"<h2>{title}</h2>" in page
    assert "data:image/png" in page and page.count("<svg") == 2
    assert re.search(r"change.* 1\.00 m in 100%", page, re.DOTALL)


def test_a_horizontal_shift_is_told_and_taken_off_if_asked(tmp_path):
    x, y = places()
    raster(tmp_path / "old.tif", 5.0 * np.sin(x / 9.0) + 5.0 * np.cos(y / 11.0))
    raster(tmp_path / "new.tif", 5.0 * np.sin((x - 0.6) / 9.0) + 5.0 * np.cos((y + 0.4) / 11.0))
    files = (tmp_path / "old.tif", tmp_path / "new.tif", tmp_path / "out.tif")
    told = bare_earth.change(*files)
    assert told.alignment.east == pytest.approx(0.6, abs=0.1)
    assert told.alignment.north == pytest.approx(-0.4, abs=0.1)
    before = np.nanstd(cells(tmp_path / "out.tif"))
    bare_earth.change(*files, move=True)
    assert np.nanstd(cells(tmp_path / "out.tif")[3:-3, 3:-3]) < 0.3 * before


def test_an_object_is_not_called_earth(tmp_path):
    x, y = places()
    house = 5.0 * ((np.abs(x - 80) < 8) & (np.abs(y - 80) < 6))
    files, errors = pair(tmp_path, house)
    found = bare_earth.change(*files, places=tmp_path / "places.geojson", **errors)
    assert found.place_count == 1 and found.volume_up == 0.0
    (only,) = features(tmp_path / "places.geojson")
    assert only["properties"]["KIND"] == "building or other object, new"


def test_other_grids_and_units_are_reconciled(tmp_path):
    x, y = places()
    (old, _, out), _ = pair(tmp_path)
    feet = terrain(2, heap(x, y) + 0.15) / 0.3048
    raster(tmp_path / "feet.tif", feet[:, 20:], west=WEST + 20.25, unit="ft")
    found = bare_earth.change(old, tmp_path / "feet.tif", out)
    assert found.cell_count == SIDE * (SIDE - 20)
    assert found.volume_up == pytest.approx(heap(x, y).sum(), rel=0.05)
    assert cells(out).shape == (SIDE, SIDE)


def other_terrain(folder, kind):
    """Write a terrain that cannot be compared with the first one."""
    path = folder / "other.tif"
    if kind == "apart":
        return raster(path, terrain(2), west=WEST + 1e4)
    if kind == "empty":
        return raster(path, np.full((SIDE, SIDE), np.nan))
    if kind == "feet":
        return raster(path, terrain(2) / 0.3048)
    if kind == "map":
        return raster(path, terrain(2), crs="EPSG:25833")
    if kind == "ellipsoid":
        return raster(path, terrain(2) + 45.0)
    return raster(path, terrain(2) + np.random.default_rng(3).uniform(-40, 40, (SIDE, SIDE)))


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("apart", "No cell .* both"),
        ("empty", "neither .* empty"),
        ("feet", "metres and feet"),
        ("map", "another CRS"),
        ("ellipsoid", "same datum"),
        ("noise", "stable"),
    ],
)
def test_what_cannot_be_compared_is_refused_in_a_sentence(tmp_path, kind, words):
    (old, _, out), errors = pair(tmp_path)
    other = other_terrain(tmp_path, kind)
    given = errors if kind == "noise" else {}
    with pytest.raises(BareEarthError, match=words):
        bare_earth.change(old, other, out, page=tmp_path / "page.html", **given)
    assert not out.exists() and not (tmp_path / "page.html").exists()


def test_other_vertical_datums_are_refused(tmp_path):
    raster(tmp_path / "old.tif", terrain(1), crs="EPSG:25832+7837")
    raster(tmp_path / "new.tif", terrain(2), crs="EPSG:25832+5621")
    code, _, errors = said(
        "change", tmp_path / "old.tif", tmp_path / "new.tif", tmp_path / "out.tif"
    )
    assert code and "not above the same datum" in errors and not (tmp_path / "out.tif").exists()


def cloud(path, seed, change=lambda x, y: 0.0, bush=False, side=100.0, classes=2, west=0.0):
    """Write ground points, and a bush as unclassified or as ground."""
    random = np.random.default_rng(seed)
    x, y = random.uniform(0.0, side, (2, int(4 * side**2)))
    z = land(x, y) + change(x, y) + random.normal(0.0, 0.02, len(x))
    classes = np.full(len(x), classes)
    inside = np.hypot(x - 25.0, y - 75.0) < 5.0
    z[inside] += random.uniform(0.8, 1.2, np.count_nonzero(inside))
    classes[inside] = 2 if bush else 1
    return write_points(path, x + west, y, z, classes)


def test_what_the_points_of_both_dates_show_is_no_change(tmp_path):
    old = cloud(tmp_path / "old.las", 1)
    new = cloud(tmp_path / "new.las", 2, lambda x, y: heap(x, y, 60.0, 40.0, 8.0, 1.5), bush=True)
    heard = Heard()
    found = bare_earth.change(
        old, new, tmp_path / "out.tif", find_ground=False, page=tmp_path / "page.html",
        places=tmp_path / "places.geojson", progress=heard,
    )  # fmt: skip
    assert found.left_out == 1 and found.place_count == 1
    truth = heap(*places(100), 60.0, 40.0, 8.0, 1.5).sum()
    assert abs(found.volume_up - truth) <= found.volume_up_error < 0.2 * truth
    assert "new points" in (tmp_path / "page.html").read_text(encoding="utf-8")
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "new.las", "old.las", "out.tif", "page.html", "places.geojson",
    ]  # fmt: skip
    assert heard.fractions[-1] == 1.0


def test_plants_with_points_down_to_the_ground_are_no_change(tmp_path):
    random = np.random.default_rng(5)

    def crops(x, y):
        inside = (np.abs(x - 60.0) < 12.0) & (np.abs(y - 50.0) < 15.0)
        return np.where(inside, random.uniform(0.0, 1.2, x.shape), 0.0)

    old, new = cloud(tmp_path / "old.las", 1), cloud(tmp_path / "new.las", 2, crops)
    found = bare_earth.change(old, new, tmp_path / "out.tif", find_ground=False)
    assert np.count_nonzero(cells(tmp_path / "out.tif") > 0.3) > 300
    assert found.left_out and found.volume_up == 0.0


def test_the_ground_of_clouds_is_found_first(tmp_path):
    old = cloud(tmp_path / "old.las", 1, classes=0)
    new = cloud(tmp_path / "new.las", 2, lambda x, y: heap(x, y, 60.0, 40.0, 8.0, 1.5), classes=0)
    found = bare_earth.change(old, new, tmp_path / "out.tif", method="slope", crs="EPSG:25832")
    assert "25832" in rasterio.open(tmp_path / "out.tif").crs.to_string()
    assert found.volume_up == pytest.approx(heap(*places(100), 60, 40, 8, 1.5).sum(), rel=0.1)
    assert found.by_error


def test_no_limit_is_given_where_a_date_has_no_ground_points(tmp_path):
    old, new = cloud(tmp_path / "old.las", 1, side=60.0), tmp_path / "new.las"
    las = laspy.read(cloud(new, 2, side=60.0))
    roof = (np.abs(las.x - WEST - 30.0) < 8.0) & (np.abs(las.y - NORTH - 30.0) < 10.0)
    las.z[roof] += 6.0
    las.classification[roof] = 6
    las.write(new)
    files = old, new, tmp_path / "out.tif"
    found = bare_earth.change(*files, limit=tmp_path / "limit.tif", find_ground=False)
    gap = np.isnan(cells(tmp_path / "limit.tif")) & np.isfinite(cells(files[2]))
    hidden = np.count_nonzero(gap[24:36, 26:34])
    assert hidden == gap[24:36, 26:34].size and np.count_nonzero(gap) <= 16 * 20
    assert found.unseen == pytest.approx(np.mean(gap), abs=0.01)
    assert found.can_tell[1.0] <= 1.0 - found.unseen and f"{found.unseen:.0%} has" in found.text


@pytest.mark.rest(but="True")
@pytest.mark.parametrize("find_ground", [True, False])
def test_surveys_of_many_files_have_the_change_of_one(tmp_path, find_ground):
    def change(x, y):
        return heap(x, y, 50.0, 40.0, 8.0, 1.5)

    for name, seed, put in (("old", 1, lambda x, y: 0.0), ("new", 2, change)):
        (tmp_path / name).mkdir()
        whole = cloud(tmp_path / name / "west.las", seed, put)
        las = laspy.read(whole)
        is_west = np.asarray(las.x) < WEST + 50.0
        for part, points in (("west", is_west), ("east", ~is_west)):
            laspy.LasData(las.header, las.points[points]).write(tmp_path / name / f"{part}.las")
    folders = tmp_path / "old", tmp_path / "new"
    found = bare_earth.change(
        *folders, tmp_path / "out.tif", find_ground=find_ground, method="slope"
    )
    truth = heap(*places(100), 50.0, 40.0, 8.0, 1.5).sum()
    assert found.volume_up == pytest.approx(truth, rel=0.1) and found.place_count == 1


def test_surveys_apart_are_refused_before_the_work(tmp_path):
    old, new = cloud(tmp_path / "old.las", 1), cloud(tmp_path / "new.las", 2, west=500.0)
    with pytest.raises(BareEarthError, match="no common area"):
        bare_earth.change(old, new, tmp_path / "out.tif")
    assert not (tmp_path / "out.tif").exists()


def test_a_cloud_and_a_raster_are_compared_on_the_grid_of_the_raster(tmp_path):
    x, y = places(100)
    old = raster(tmp_path / "old.tif", land(x, y), west=5e5, crs=None)
    with rasterio.open(old, "r+") as file:
        file.transform = rasterio.Affine(1.0, 0.0, 5e5, 0.0, -1.0, 5.7e6 + 100.0)
    new = cloud(tmp_path / "new.las", 2, lambda x, y: heap(x, y, 60.0, 40.0, 8.0, 1.5))
    found = bare_earth.change(old, new, tmp_path / "out.tif", find_ground=False)
    assert found.volume_up == pytest.approx(heap(x, y, 60.0, 40.0, 8.0, 1.5).sum(), rel=0.1)
    assert cells(tmp_path / "out.tif").shape == (100, 100) and not found.by_error


def test_rasters_in_memory_have_the_same_change(tmp_path):
    files, errors = pair(tmp_path, heap(*places()))
    bare_earth.change(*files, **errors, limit=tmp_path / "limit.tif")
    transform = rasterio.Affine(1.0, 0.0, WEST, 0.0, -1.0, NORTH)
    old, new, error = (
        arrays.Raster(cells(tmp_path / f"{name}.tif"), transform, "EPSG:25832")
        for name in ("old", "new", "error")
    )
    found = arrays.change(old, new, old_error=error, new_error=error)
    for name, path in (("difference", files[2]), ("limit", tmp_path / "limit.tif")):
        np.testing.assert_array_equal(np.asarray(found[name]), cells(path).astype(np.float32))
