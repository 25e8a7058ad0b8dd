"""An area: of one file and of many, all points written or those of the area alone."""

import json

import laspy
import numpy as np
import pytest
from runs import FAST, Heard
from surveys import (
    bytes_of,
    cut,
    finished,
    heights_of,
    points_of,
    strip,
    write,
    write_points,
)

from bare_earth import BareEarthError, classify
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.survey.area import Area

EAST, NORTH = 500_000.0, 5_700_000.0
# It crosses several of the files, and leaves out the last ones.
TRIANGLE = np.add([(20.0, 10.0), (170.0, 20.0), (60.0, 120.0)], (EAST, NORTH))
AREA = Area(polygons=((TRIANGLE,),))
# `test_classification.py` has an area with what each method sees of the points round it.
ALL = {**FAST, "boundary": [(TRIANGLE,)]}
ONLY = {**ALL, "area_only": True}


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """One file, the same points in six, and the former classified in the area."""
    folder, points = tmp_path_factory.mktemp("area"), strip(12_000, 300.0, 150.0)
    cut(folder / "in", points, 6)
    write(folder / "one.laz", points)
    classify(folder / "one.laz", folder / "all.laz", **ALL)
    return folder


def in_area(las):
    return AREA.contains(np.asarray(las.x), np.asarray(las.y))


@pytest.mark.parametrize("suffix", [".las", ".laz", ".copc.laz"])
def test_of_one_file_the_points_of_the_area_are_written_as_they_would_be(inputs, tmp_path, suffix):
    target = tmp_path / f"out{suffix}"
    summary = classify(inputs / "one.laz", target, **ONLY)
    whole, part = laspy.read(inputs / "all.laz"), laspy.read(target)
    inside = in_area(whole)
    assert 1000 < inside.sum() < 0.5 * len(inside)
    expected = points_of([inputs / "all.laz"])
    expected = expected[AREA.contains(EAST + expected[:, 0] / 100, NORTH + expected[:, 1] / 100)]
    assert np.array_equal(points_of([target]), expected)
    if suffix != ".copc.laz":
        assert np.array_equal(part.X, whole.X[inside])
    header = part.header
    assert header.point_count == header.number_of_points_by_return[0] == inside.sum()
    for axis, name in enumerate("xyz"):
        assert header.mins[axis] == pytest.approx(part[name].min(), abs=1e-9)
        assert header.maxs[axis] == pytest.approx(part[name].max(), abs=1e-9)
    assert (summary.point_count, summary.area_count) == (len(inside), inside.sum())
    assert summary.ground_count == summary.area_ground_count == (part.classification == 2).sum()
    assert sum(summary.class_counts.values()) == inside.sum()


def test_copc_of_an_area_is_read_by_window(inputs, tmp_path):
    classify(inputs / "one.laz", tmp_path / "out.copc.laz", **ONLY)
    with laspy.CopcReader.open(tmp_path / "out.copc.laz") as reader:
        assert len(reader.query(None)) == in_area(laspy.read(inputs / "all.laz")).sum()


def test_many_files_are_classified_in_the_area_as_one(inputs, tmp_path):
    summary = classify([inputs / "in"], tmp_path, **ALL)
    assert np.array_equal(points_of(finished(tmp_path)), points_of([inputs / "all.laz"]))
    assert summary.done_count == summary.tile_count == 6 and not summary.failures


def test_of_many_files_those_outside_are_not_written(inputs, tmp_path):
    one, many, progress = tmp_path / "one.laz", tmp_path / "many", Heard()
    classify(inputs / "one.laz", one, **ONLY)
    summary = classify([inputs / "in"], many, **ONLY, progress=progress)
    assert np.array_equal(points_of(finished(many)), points_of([one]))
    assert sorted(bytes_of(many)) == ["0.laz", "1.laz", "2.laz", "3.laz"]
    listed = json.loads((many / "classified.vpc").read_text())["features"]
    names = [feature["assets"]["data"]["href"].rpartition("/")[2] for feature in listed]
    assert names == sorted(bytes_of(many))
    assert (summary.done_count, summary.tile_count) == (4, 4) and not summary.failures
    assert summary.point_count == in_area(laspy.read(inputs / "all.laz")).sum()
    assert summary.ground_count == (laspy.read(one).classification == 2).sum()
    assert any("2 files are not written" in text for text in progress.infos)


def test_a_file_within_the_bounds_but_without_a_point_is_not_written(inputs, tmp_path):
    # In the corner of the bounds that the triangle leaves out.
    (tmp_path / "in").mkdir()
    for path in (inputs / "in").iterdir():
        (tmp_path / "in" / path.name).write_bytes(path.read_bytes())
    corner = np.array([[14_000, 11_000, 6800], [14_100, 11_100, 6800], [14_200, 11_000, 6800]])
    write(tmp_path / "in" / "corner.laz", corner)
    assert AREA.may_touch((EAST + 140, NORTH + 110, EAST + 142, NORTH + 111))
    summary = classify([tmp_path / "in"], tmp_path / "out", **ONLY)
    assert sorted(bytes_of(tmp_path / "out")) == ["0.laz", "1.laz", "2.laz", "3.laz"]
    assert not summary.failures


@pytest.mark.rest
def test_heights_and_rasters_are_those_of_the_area(inputs, tmp_path):
    found = []
    for source, target, name in (("one.laz", "one.laz", "a"), ("in", "many", "b")):
        rasters = {"dtm": tmp_path / f"{name}.tif", "dsm": tmp_path / f"{name}-dsm.tif"}
        classify(inputs / source, tmp_path / target, **ONLY, height_above_ground=True, **rasters)
        files = finished(tmp_path / target) if source == "in" else [tmp_path / target]
        clouds = [laspy.read(path) for path in files]
        rows = [np.column_stack((c.x, c.y, c.z, c["HeightAboveGround"])) for c in clouds]
        rows = np.concatenate(rows).round(3)
        found.append(rows[np.lexsort(rows[:, :3].T)])
    assert np.allclose(found[0], found[1], atol=1e-3)
    assert np.ptp(found[0][:, 3]) > 5.0
    for name in ("", "-dsm"):
        one, many = (tmp_path / f"{run}{name}.tif" for run in "ab")
        assert one.read_bytes() == many.read_bytes()
    with pytest.importorskip("rasterio").open(tmp_path / "a.tif") as raster:
        bounds = raster.bounds
    lowest, highest = TRIANGLE.min(axis=0), TRIANGLE.max(axis=0)
    assert np.all(np.abs(np.array(bounds[:2]) - lowest) < 5.0)
    assert np.all(np.abs(np.array(bounds[2:]) - highest) < 5.0)


def test_ground_of_the_area_alone(inputs, tmp_path):
    classify(inputs / "one.laz", tmp_path / "one.laz", **ONLY, ground_only=True)
    classify([inputs / "in"], tmp_path / "many", **ONLY, ground_only=True)
    ground = points_of([tmp_path / "one.laz"])
    whole = laspy.read(inputs / "all.laz")
    assert len(ground) == (in_area(whole) & (whole.classification == 2)).sum()
    assert np.array_equal(points_of(finished(tmp_path / "many")), ground)


@pytest.mark.rest
def test_a_run_goes_on_in_the_same_area_only(inputs, tmp_path):
    classify([inputs / "in"], tmp_path, **ONLY)
    before = bytes_of(tmp_path)
    (tmp_path / "1.laz").unlink()
    summary = classify([inputs / "in"], tmp_path, **ONLY, resume=True)
    assert (summary.kept_count, summary.done_count) == (3, 4)
    assert bytes_of(tmp_path) == before
    larger = {**FAST, "extent": AREA.bounds, "area_only": True, "resume": True}
    assert classify([inputs / "in"], tmp_path, **larger).kept_count == 0
    assert np.any(points_of(finished(tmp_path))[:, 0] > 15_000)
    assert classify([inputs / "in"], tmp_path, **ALL, resume=True).kept_count == 0


def test_an_area_that_meets_no_point_is_told(inputs, tmp_path):
    elsewhere = EAST + 5000.0, NORTH, EAST + 5100.0, NORTH + 100.0
    for source in (inputs / "one.laz", [inputs / "in"]):
        for only in (True, False):
            with pytest.raises(BareEarthError, match="area in the CRS"):
                classify(source, tmp_path / "out.laz", extent=elsewhere, area_only=only, **FAST)
    # Between the files' points, though within their bounds.
    x, y, _ = strip(12_000, 300.0, 150.0)[0] / 100
    gap = EAST + x + 0.002, NORTH + y + 0.002, EAST + x + 0.008, NORTH + y + 0.008
    with pytest.raises(BareEarthError, match="None of the files has points"):
        classify([inputs / "in"], tmp_path / "many", extent=gap, area_only=True, **FAST)
    progress = Heard()
    classify([inputs / "in"], tmp_path / "all", extent=gap, progress=progress, **FAST)
    assert [text for text in progress.warnings if "No point lies in the area" in text]


def test_the_area_alone_needs_an_area(inputs, tmp_path, capsys):
    words = [str(inputs / "one.laz"), str(tmp_path / "out.laz"), "--area-only"]
    assert main(["classify", *words]) != 0
    assert "extent or a boundary" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.rest
def test_the_command_writes_the_area_alone(inputs, tmp_path, capsys):
    boundary = tmp_path / "boundary.geojson"
    rings = [[*TRIANGLE.tolist(), TRIANGLE[0].tolist()]]
    boundary.write_text(json.dumps({"type": "Polygon", "coordinates": rings}))
    words = ["--method", "slope", "--boundary", str(boundary), "--area-only"]
    for source, target in (("one.laz", "one.laz"), ("in", "many")):
        files = [str(inputs / source), str(tmp_path / target)]
        assert main(["classify", *files, *words, "--verbose"]) == 0
        assert "outside of the area" in capsys.readouterr().err or source == "in"
    one = points_of([tmp_path / "one.laz"])
    assert np.array_equal(points_of(finished(tmp_path / "many")), one)
    assert len(one) == in_area(laspy.read(inputs / "all.laz")).sum()


@pytest.mark.rest
def test_corrections_that_meet_no_point_are_told_once(inputs, tmp_path):
    between = EAST + 50.001, NORTH + 50.001, EAST + 50.002, NORTH + 50.002
    for box, count in ((between, 1), ((EAST, NORTH, EAST + 9.0, NORTH + 9.0), 0)):
        west, south, east, north = box
        ring = [(west, south), (east, south), (east, north), (west, north), (west, south)]
        polygon = {"type": "Polygon", "coordinates": [ring]}
        known = tmp_path / "known.geojson"
        known.write_text(
            json.dumps({"type": "Feature", "properties": {"class": 6}, "geometry": polygon})
        )
        for number, source in enumerate((inputs / "one.laz", [inputs / "in"])):
            progress, out = Heard(), tmp_path / f"{count}-{number}.laz"
            classify(source, out, method="slope", corrections=known, progress=progress)
            told = [text for text in progress.warnings if "the corrections" in text]
            assert len(told) == count


def hall(folder):
    """Write a hall on even land, as one file and as four; the middle of the hall is in them all."""
    x, y = np.random.default_rng(4).uniform(0, 120, (2, 20_000))
    z = 50 + 0.03 * x + 0.2 * np.sin(y / 7) + 8.0 * np.all(np.abs([x - 60, y - 60]) < 16, axis=0)
    write_points(folder / "one.laz", x, y, z)
    (folder / "in").mkdir()
    for number in range(4):
        part = 2 * (x > 60) + (y > 60) == number
        write_points(folder / "in" / f"{number}.laz", x[part], y[part], z[part])
    return folder


@pytest.mark.rest
def test_the_terrain_of_an_area_that_cuts_a_building_is_that_of_the_whole(tmp_path):
    folder, whole, (west, south) = hall(tmp_path), tmp_path / "whole.tif", (EAST, NORTH)
    classify(folder / "one.laz", folder / "whole.laz", dtm=whole)
    expected = heights_of(whole)[120 - 59 : 120 - 20, 20:59]
    assert np.isfinite(expected).all()
    # It ends on the roof, so that all ground beyond lies outside, and in other files.
    area = {"extent": (west + 20, south + 20, west + 59, south + 59)}
    before = laspy.read(folder / "one.laz").classification
    for only in (False, True):
        made = []
        for source, target in (("one.laz", f"{only}.laz"), ("in", f"{only}")):
            dtm, out = tmp_path / f"{target}.tif", tmp_path / target
            classify(folder / source, out, dtm=dtm, **area, area_only=only)
            made.append(dtm)
            if source == "in":
                assert sorted(bytes_of(out)) == [f"{n}.laz" for n in range(1 if only else 4)]
                # Of a run that goes on, too.
                dtm, points = tmp_path / f"{target}-again.tif", bytes_of(out)
                summary = classify(
                    folder / source, out, dtm=dtm, **area, area_only=only, resume=True
                )
                assert summary.kept_count == len(points) and bytes_of(out) == points
                made.append(dtm)
        found = heights_of(made[0])
        assert found.shape == expected.shape and np.abs(found - expected).max() < 0.01
        assert len({path.read_bytes() for path in made}) == 1
    # The points outside keep their class all the same.
    written = laspy.read(tmp_path / "False.laz")
    outside = (written.x > west + 59) | (written.y > south + 59)
    assert np.array_equal(written.classification[outside], before[outside])
    assert np.count_nonzero(written.classification == 2) > 1000


@pytest.mark.rest
def test_heights_beside_the_border_are_above_the_ground_round_the_area(tmp_path):
    folder, (west, south) = hall(tmp_path), (EAST, NORTH)
    # On the roof alone: all ground lies outside.
    area = {"extent": (west + 50, south + 50, west + 70, south + 70), "area_only": True}
    for source, target in (("one.laz", "out.laz"), ("in", "out")):
        classify(folder / source, tmp_path / target, **area, height_above_ground=True)
        files = [tmp_path / target] if source == "one.laz" else finished(tmp_path / target)
        for path in files:
            assert np.abs(laspy.read(path)["HeightAboveGround"] - 8.0).max() < 1.0
