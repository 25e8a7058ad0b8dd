"""Corrections by hand, as polygons or in the file, hold whatever the filter makes of the points."""

import json

import laspy
import numpy as np
import pytest
from copc_edits import give_class
from matrices import quick
from surveys import ORIGIN, classes_of, cut, finished, heights_of, points_of, write

from bare_earth import BareEarthError, classify, key_points
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.filters import METHODS

# Objects narrower than so many metres go: at 8 m hall and mound stay ground, at 60 m none does.
KEPT, GONE = 8.0, 60.0
HALL, MOUND = (20.0, 30.0, 60.0, 70.0), (113.0, 43.0, 127.0, 57.0)
DISK = {"threads": 2, "memory": 0.001}


@pytest.fixture(scope="module")
def integers():
    """Return a slope with a hall, which is not ground, and a mound, which is."""
    random, count = np.random.default_rng(4), 6000
    x, y = random.uniform(0, 160, count), random.uniform(0, 100, count)
    z = 60 + 0.03 * x + random.normal(0, 0.03, count)
    z[_within(HALL, x, y)] += 6.0
    z[_within(MOUND, x, y)] += 5.0
    return np.round(np.column_stack((x, y, z)) * 100).astype(np.int64)


@pytest.fixture
def cloud(integers, tmp_path):
    return write(tmp_path / "cloud.laz", integers)


def _within(box, x, y):
    return (x > box[0]) & (x < box[2]) & (y > box[1]) & (y < box[3])


def _ring(west, south, east, north):
    corners = [(west, south), (east, south), (east, north), (west, north), (west, south)]
    return [[x + ORIGIN[0], y + ORIGIN[1]] for x, y in corners]


def _size(metres, method="slope"):
    """Return a method, and how narrow its objects are."""
    return {"method": method, METHODS[method].size_parameter: metres}


def _classes(path, box):
    las = laspy.read(path)
    x, y = np.asarray(las.x) - ORIGIN[0], np.asarray(las.y) - ORIGIN[1]
    return np.asarray(las.classification)[_within(box, x, y)]


def _geojson(path, *features):
    """Write boxes with their properties."""
    features = [
        {
            "type": "Feature",
            "properties": properties,
            "geometry": {"type": "Polygon", "coordinates": [_ring(*box)]},
        }
        for box, properties in features
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
    return path


@pytest.fixture
def corrections(tmp_path):
    """Return a file that says that the hall is a building, and the mound ground."""
    return _geojson(tmp_path / "known.geojson", (HALL, {"class": "6"}), (MOUND, {"class": 2.0}))


# Polygons


@pytest.mark.rest
@pytest.mark.parametrize(
    ("method", "size"),
    [
        ("tin-densification", KEPT),
        ("slope", GONE),
        *(
            pytest.param(*row, marks=pytest.mark.long)
            for row in (("grid-minimum", GONE), ("slope", KEPT))
        ),
    ],
)
def test_polygons_hold_in_memory_from_disk_and_in_tiles(
    method, size, cloud, integers, corrections, tmp_path
):
    raw, known = tmp_path / "raw.laz", tmp_path / "known.laz"
    classify(cloud, raw, **_size(size, method))
    # Wrong in one place or the other.
    assert np.mean(_classes(raw, HALL) == 2) > 0.9 or np.mean(_classes(raw, MOUND) != 2) > 0.9
    how = {**_size(size, method), "corrections": corrections}
    classify(cloud, known, **how)
    assert set(_classes(known, HALL)) == {6}
    assert set(_classes(known, MOUND)) == {2}
    disk, tiles = tmp_path / "disk.laz", tmp_path / "tiles"
    classify(cloud, disk, **how, **DISK)
    np.testing.assert_array_equal(classes_of(disk), classes_of(known))
    classify([cut(tmp_path / "in", integers, 6)], tiles, **how)
    np.testing.assert_array_equal(points_of(finished(tiles)), points_of([known]))


@pytest.mark.rest(but="8.0")
@pytest.mark.parametrize("size", [KEPT, GONE])
def test_the_terrain_model_follows(size, cloud, corrections, tmp_path):
    dtm = tmp_path / "dtm.tif"
    classify(cloud, tmp_path / "out.laz", corrections=corrections, dtm=dtm, **_size(size))
    assert heights_of(dtm)[50, [40, 120]] == pytest.approx([61.2, 68.6], abs=0.15)


def test_what_is_known_to_be_none_does_not_mislead_the_filter(integers, tmp_path):
    """Wrong points below the ground take it away round them, unless they are known."""
    random, box = np.random.default_rng(1), (65.0, 10.0, 73.0, 18.0)
    x, y = random.uniform(65, 73, 64), random.uniform(10, 18, 64)
    below = np.round(np.column_stack((x, y, 58.5 + 0.03 * x)) * 100).astype(np.int64)
    source = write(tmp_path / "in.laz", np.concatenate((integers, below)))
    west, south, east, north = box
    shares = []
    out, known = tmp_path / "out.laz", _geojson(tmp_path / "known.geojson", (box, {"class": 7}))
    for corrections in (None, known):
        classify(source, out, method="grid-minimum", preset="paper", corrections=corrections)
        sides = (west - 8, south, west, north), (east, south, east + 8, north)
        beside = [_classes(out, side) for side in sides]
        shares.append(np.mean(np.concatenate(beside) == 2))
    assert shares[0] < 0.9
    assert shares[1] > 0.98


def test_a_later_polygon_counts_and_noise_and_first_returns_stay(tmp_path):
    integers = np.column_stack((np.tile(np.arange(30), 30), np.repeat(np.arange(30), 30)))
    path = write(tmp_path / "in.las", np.pad(integers * 100, ((0, 0), (0, 1))))
    las = laspy.read(path)
    las.classification[:4] = 7
    las.number_of_returns[4:8] = 2  # of which they are the first
    las.withheld[8:12] = 1
    las.write(str(path))
    known = _geojson(
        tmp_path / "known.geojson",
        ((-1, -1, 40, 20.5), {"class": 64}), ((-1, -1, 40, 10.5), {"class": 2}),
    )  # fmt: skip
    out = tmp_path / "out.las"
    classify(path, out, corrections=known, **_size(GONE))
    classes = classes_of(out)
    assert classes[:12].tolist() == [7] * 4 + [1] * 8
    assert set(classes[12 : 11 * 30]) == {2} and set(classes[11 * 30 : 21 * 30]) == {64}
    las = laspy.convert(laspy.read(path), point_format_id=1, file_version="1.2")
    las.write(str(tmp_path / "old.las"))
    with pytest.raises(BareEarthError, match="31, not 64"):
        classify(tmp_path / "old.las", out, corrections=known, **_size(GONE))


@pytest.mark.rest
def test_other_polygons_make_finished_tiles_anew(integers, corrections, tmp_path):
    folder, out = cut(tmp_path / "in", integers, 6), tmp_path / "out"
    how = {**_size(GONE), "corrections": corrections, "resume": True}
    assert classify([folder], out, **how).kept_count == 0
    assert classify([folder], out, **how).kept_count == 6
    _geojson(corrections, (HALL, {"class": 6}), ((114.0, 44.0, 128.0, 58.0), {"class": 2}))
    assert classify([folder], out, **how).kept_count == 0


def test_the_command_line_takes_polygons_of_a_file(cloud, corrections, tmp_path, capsys):
    out, words = tmp_path / "out.laz", ["--method", "slope", "--max-building-size", "60"]
    assert main(["classify", str(cloud), str(out), "--corrections", str(corrections), *words]) == 0
    assert set(_classes(out, HALL)) == {6} and set(_classes(out, MOUND)) == {2}
    far = _geojson(tmp_path / "far.geojson", ((900.0, 0.0, 910.0, 10.0), {"class": 2}))
    assert main(["classify", str(cloud), str(out), "--corrections", str(far), *words]) == 1
    assert "polygons of the corrections" in capsys.readouterr().err


@pytest.mark.parametrize("properties", [{"class": "ground"}, {"class": 256}, {"class": 2.5}])
def test_polygons_without_a_proper_class_are_refused(properties, cloud, tmp_path):
    out, path = tmp_path / "out.laz", _geojson(tmp_path / "known.geojson", (HALL, properties))
    with pytest.raises(BareEarthError, match="from 0 to 255"):
        classify(cloud, out, corrections=path)
    with pytest.raises(BareEarthError, match=r"WKT.* GeoPackage"):
        classify(cloud, out, corrections=tmp_path / "known.wkt")


# Classes changed in the file


@pytest.fixture
def edited(cloud, tmp_path):
    """Return a COPC file of which QGIS gave the hall class 6, and the mound class 2."""
    path = tmp_path / "edited.copc.laz"
    classify(cloud, path, remember_classes=True, **_size(GONE))
    for box, value in ((HALL, 6), (MOUND, 2)):
        give_class(path, value, lambda x, y, box=box: _within(box, x / 100, y / 100))
    return path


@pytest.mark.rest
@pytest.mark.parametrize("method", quick(METHODS, "grid-minimum"))
def test_classes_changed_in_the_file_hold_run_after_run(method, edited, tmp_path):
    once, twice = tmp_path / "once.copc.laz", tmp_path / "twice.laz"
    classify(edited, once, **_size(KEPT, method))
    classify(once, twice, **_size(GONE, method))
    for path in (once, twice):
        assert set(_classes(path, HALL)) == {6}
        assert set(_classes(path, MOUND)) == {2}
    disk = tmp_path / "disk.laz"
    classify(once, disk, **DISK, **_size(GONE, method))
    np.testing.assert_array_equal(classes_of(disk), classes_of(twice))


@pytest.mark.rest
def test_a_run_remembers_its_classes_and_nothing_else_changes(edited, tmp_path):
    before, out = laspy.read(edited), tmp_path / "out.copc.laz"
    dimension = np.asarray(before["BareEarthClass"])
    changed = dimension != before.classification
    assert changed.any() and set(np.unique(dimension[~changed])) <= {1, 2}
    classify(edited, out, **_size(KEPT))
    after = laspy.read(out)
    assert list(after.point_format.dimension_names) == list(before.point_format.dimension_names)
    order = [np.lexsort((las.Z, las.Y, las.X)) for las in (before, after)]
    for name in set(before.point_format.dimension_names) - {"classification", "BareEarthClass"}:
        np.testing.assert_array_equal(
            *(np.asarray(a[name])[o] for a, o in zip((before, after), order))
        )
    still = np.asarray(after["BareEarthClass"]) != after.classification
    np.testing.assert_array_equal(still[order[1]], changed[order[0]])


@pytest.mark.rest
def test_points_that_nobody_changed_are_judged_anew(cloud, tmp_path):
    remembered, out, plain = (tmp_path / f"{name}.laz" for name in ("first", "second", "plain"))
    classify(cloud, remembered, remember_classes=True, **_size(GONE))
    classify(remembered, out, **_size(KEPT))
    classify(cloud, plain, **_size(KEPT))
    assert "BareEarthClass" not in laspy.read(plain).point_format.dimension_names
    np.testing.assert_array_equal(classes_of(out), classes_of(plain))


@pytest.mark.rest
def test_a_point_set_to_never_classified_is_judged_anew(edited, tmp_path):
    give_class(edited, 0, lambda x, y: _within(HALL, x / 100, y / 100))
    out = tmp_path / "out.laz"
    classify(edited, out, **_size(KEPT))
    assert np.mean(_classes(out, HALL) == 2) > 0.9
    assert set(_classes(out, MOUND)) == {2}


@pytest.mark.rest
def test_a_polygon_counts_more_than_the_file_which_does_not_remember_it(edited, tmp_path):
    out, again = tmp_path / "out.laz", tmp_path / "again.laz"
    known = _geojson(tmp_path / "known.geojson", (HALL, {"class": 2}), (MOUND, {"class": 9}))
    classify(edited, out, corrections=known, **_size(GONE))
    assert set(_classes(out, HALL)) == {2} and set(_classes(out, MOUND)) == {9}
    classify(out, again, others="unclassified", **_size(GONE))
    assert set(_classes(again, HALL)) == {1} and set(_classes(again, MOUND)) == {9}
    again.unlink()
    classify(out, again, others="unclassified", from_classes=range(256), **_size(GONE))
    assert set(_classes(again, HALL)) == set(_classes(again, MOUND)) == {1}


@pytest.mark.rest
def test_changes_in_files_hold_in_tiles_and_with_heights(edited, integers, tmp_path):
    one, tiles = tmp_path / "one.laz", tmp_path / "tiles"
    how = {**_size(KEPT), "height_above_ground": True}
    classify(edited, one, **how)
    names = list(laspy.read(one).point_format.extra_dimension_names)
    assert sorted(names) == ["BareEarthClass", "HeightAboveGround"]
    (tmp_path / "in").mkdir()
    edited.rename(tmp_path / "in" / "a.copc.laz")
    # Beside it a file without the dimension.
    write(tmp_path / "in" / "b.laz", integers + np.array((16_000, 0, 480)))
    classify([tmp_path / "in"], tiles, **how)
    found = tiles / "a.copc.laz"
    assert set(_classes(found, HALL)) == {6} and set(_classes(found, MOUND)) == {2}
    names = list(laspy.read(found).point_format.extra_dimension_names)
    assert sorted(names) == ["BareEarthClass", "HeightAboveGround"]
    assert set(laspy.read(tiles / "b.laz").point_format.extra_dimension_names) == {
        "HeightAboveGround"
    }


@pytest.mark.rest
def test_key_points_are_no_changes_by_hand(edited, tmp_path):
    marked, out = tmp_path / "marked.laz", tmp_path / "out.laz"
    key_points(edited, marked, mark_as="class")
    assert np.any(classes_of(marked) == 8)
    classify(marked, out, **_size(GONE))
    # Those on the mound are not known any more.
    left = [np.count_nonzero(classes == 8) for classes in (classes_of(out), _classes(out, MOUND))]
    assert left[0] == left[1]
    assert set(_classes(out, HALL)) == {6}


def test_a_dimension_of_that_name_that_is_no_byte_is_refused(cloud, tmp_path):
    las = laspy.read(cloud)
    las.add_extra_dim(laspy.ExtraBytesParams("BareEarthClass", "f4"))
    las.write(str(tmp_path / "in.laz"))
    classify(tmp_path / "in.laz", tmp_path / "out.laz", **_size(GONE))
    with pytest.raises(BareEarthError, match="BareEarthClass"):
        classify(tmp_path / "in.laz", tmp_path / "out.laz", remember_classes=True, **_size(GONE))
