"""Files of a survey without ground: each is written and told; only a survey of such files fails."""

import json
import re

import laspy
import numpy as np
import pytest
from runs import FAST, Heard
from surveys import ORIGIN, bytes_of, classes_of, finished, heights_of, write_points

from bare_earth import (
    BareEarthError,
    above_ground,
    classify,
    deliver,
    heights,
    key_points,
    quality,
    terrain,
    water,
    water_classes,
)
from bare_earth.algorithms.cli import main

SIDE = 30.0


def tile(path, column, row=0, **columns):
    """Write the points of a square of land; the middle one of nine is the roof of a hall."""
    x, y = np.random.default_rng(3 * column + row).uniform(0, SIDE, (2, 2000))
    x, y = x + column * SIDE, y + row * SIDE
    z = 50 + 0.02 * x + 0.3 * np.sin(y / 9) + 9.0 * np.all(np.abs([x - 45, y - 45]) < 17, axis=0)
    return write_points(path, x, y, z, **columns)


@pytest.fixture(scope="module")
def roof(tmp_path_factory):
    """Nine files, that in the middle on a roof, and some whose points cannot be ground."""
    folder = tmp_path_factory.mktemp("roof")
    for column, row in np.ndindex(3, 3):
        tile(folder / f"t{column}{row}.laz", column, row)
    tile(folder / "water.laz", 4, classes=9)
    tile(folder / "withheld.laz", 5, withheld=1)
    tile(folder / "first.laz", 6, number_of_returns=2)
    return folder


@pytest.fixture(scope="module")
def classified(roof, tmp_path_factory):
    folder, progress = tmp_path_factory.mktemp("classified"), Heard()
    summary = classify(roof, folder, progress=progress)
    return folder, summary, progress.warnings


def test_a_file_without_ground_is_written_and_told(roof, classified):
    folder, summary, warnings = classified
    assert summary.done_count == summary.tile_count == 12 and not summary.failures
    assert sorted(bytes_of(folder)) == sorted(bytes_of(roof))
    before, after = (laspy.read(path / "t11.laz") for path in (roof, folder))
    assert np.array_equal(before.xyz, after.xyz) and set(after.classification) == {1}
    assert np.mean(classes_of(folder / "t00.laz") == 2) > 0.98
    for name in ("water.laz", "withheld.laz"):
        assert (folder / name).read_bytes() == (roof / name).read_bytes()
    told = sorted(text for text in warnings if "no ground" in text)
    fates = {
        "first": "unchanged .* last or single",
        "t11": "not ground",
        "water": "unchanged .* class 9",
        "withheld": "unchanged .* withheld",
    }
    assert len(told) == len(fates)
    for text, (name, fate) in zip(told, fates.items()):
        assert re.search(rf"^{name}\.laz has no ground.* 2,000 points .*{fate}\b", text)
    listed = json.loads((folder / "classified.vpc").read_text("utf-8"))["features"]
    assert len(listed) == 12
    without = {each.name: each.why_no_ground for each in summary.tiles if not each.found_ground}
    assert sorted(without) == ["first.laz", "t11.laz", "water.laz", "withheld.laz"]
    assert without["t11.laz"] == "" and without["water.laz"] == "All are of class 9."


def test_the_command_ends_well_and_its_json_tells(roof, tmp_path, capsys):
    words = ["classify", str(roof / "t00.laz"), str(roof / "water.laz"), str(tmp_path / "out")]
    for more in ([], ["--resume"]):
        assert main([*words, *more, "--json"]) == 0
        said = capsys.readouterr()
        assert said.err.count("water.laz has no ground: its 2,000 points") == 1
        found = {each["name"]: each["found_ground"] for each in json.loads(said.out)["tiles"]}
        assert found == {"t00.laz": True, "water.laz": False}


def test_of_the_ground_alone_files_without_any_are_named_and_not_written(roof, tmp_path):
    progress, out = Heard(), tmp_path / "out"
    files = [roof / name for name in ("t00.laz", "first.laz", "water.laz")]
    summary = classify(files, out, **FAST, ground_only=True, progress=progress)
    assert not summary.failures and list(bytes_of(out)) == ["t00.laz"]
    (told,) = (text for text in progress.warnings if "not written" in text)
    assert told.startswith("2 files have no ground: first.laz (2,000), water.laz (2,000).")
    with pytest.raises(BareEarthError, match="None of the 2 files has ground"):
        classify(files[1:], out, **FAST, ground_only=True)


@pytest.mark.rest
def test_an_area_tells_of_its_points_only(roof, tmp_path):
    west, south = ORIGIN[:2]
    area = {"extent": (west + 31, south + 31, west + 40, south + 70)}
    for only in (False, True):
        progress, out = Heard(), tmp_path / str(only)
        summary = classify(roof, out, **area, area_only=only, progress=progress)
        assert not summary.failures and "t11.laz" in bytes_of(out)
        (told,) = (text for text in progress.warnings if "no ground" in text)
        assert told.startswith("t11.laz has no ground in the area") and "not ground" in told
        count = int(re.search(r"([\d,]+) points", told).group(1).replace(",", ""))
        assert 200 < count < 800 and (only is False) == (count < len(classes_of(out / "t11.laz")))


@pytest.mark.parametrize("name", ["water.laz", "withheld.laz", "first.laz"])
def test_a_survey_without_any_ground_is_refused_with_the_reason(name, roof, tmp_path):
    with pytest.raises(BareEarthError, match=f"^{name} has no ground.* other classes"):
        classify([roof / name], tmp_path / "out", **FAST)
    assert not finished(tmp_path / "out") and not (tmp_path / "out" / "classified.vpc").exists()
    both = [roof / name, roof / ("first.laz" if name != "first.laz" else "water.laz")]
    with pytest.raises(BareEarthError, match=r"^None of the 2 files has ground.* No point"):
        classify(both, tmp_path / "new", **FAST)
    assert not (tmp_path / "new").exists()


@pytest.mark.rest(but="water_classes-unchanged")
@pytest.mark.parametrize(
    ("tool", "fate"),
    [
        (heights, "measured"),
        (above_ground, "classified"),
        (key_points, "unchanged"),
        (water_classes, "unchanged"),
    ],
)
def test_other_tools_write_files_without_ground_and_tell(tool, fate, classified, tmp_path):
    folder, progress, more = classified[0], Heard(), {}
    if tool is water_classes:
        corners = np.add([(0, 0), (50, 0), (50, 50), (0, 50)], ORIGIN[:2])
        more = {"water": [[corners]]}
    files = [folder / f"t{column}{row}.laz" for column in range(3) for row in range(3)]
    summary = tool(files, tmp_path / "out", **more, progress=progress)
    assert summary.done_count == 9 and not summary.failures
    (told,) = (text for text in progress.warnings if "t11" in text)
    assert re.search(rf"^t11\.laz has no ground.* class 2\b.* 2,000 .*{fate}", told)
    written = laspy.read(tmp_path / "out" / "t11.laz")
    assert len(written.points) == 2000
    if tool is heights:
        assert np.percentile(written["HeightAboveGround"], 5) > 8.0
    if tool is above_ground:
        assert np.mean(written.classification == 6) > 0.95
    with pytest.raises(BareEarthError, match=r"^t11\.laz .*no ground.* class 2\b"):
        tool([folder / "t11.laz"], tmp_path / "alone", **more)
    assert not finished(tmp_path / "alone")


def test_a_survey_without_any_ground_is_refused_in_the_plural(roof, tmp_path):
    with pytest.raises(BareEarthError, match=r"^the files have no ground"):
        water(roof, tmp_path / "water.geojson")


def test_points_far_from_any_ground_have_no_height_and_are_told(classified, tmp_path):
    far, progress = tile(tmp_path / "far.laz", 300), Heard()
    summary = heights([classified[0] / "t00.laz", far], tmp_path / "out", progress=progress)
    assert not summary.failures
    assert np.isnan(laspy.read(tmp_path / "out" / "far.laz")["HeightAboveGround"]).all()
    told = [text for text in progress.warnings if text.startswith("far.laz: ")]
    assert len(told) == 1 and re.search(r"2,000 of 2,000 .*\bNaN\b", told[0])


def test_a_raster_need_not_cover_all_files(classified, tmp_path):
    folder, progress, dtm = classified[0], Heard(), tmp_path / "dtm.tif"
    terrain(folder / "t00.laz", dtm=dtm)
    files = [folder / "t00.laz", folder / "t22.laz"]
    summary = heights(files, tmp_path / "out", dtm=dtm, progress=progress)
    assert not summary.failures
    assert np.isnan(laspy.read(tmp_path / "out" / "t22.laz")["HeightAboveGround"]).all()
    (told,) = (text for text in progress.warnings if "have no height (NaN)" in text)
    assert "t22.laz" in told
    with pytest.raises(BareEarthError, match=r"no value .* the files"):
        heights(files[1:], tmp_path / "alone", dtm=dtm)


@pytest.mark.rest
def test_rasters_and_quality_have_the_file(classified, tmp_path):
    folder = classified[0]
    terrain(folder, dtm=tmp_path / "dtm.tif", dsm=tmp_path / "dsm.tif", raster_per_file=True)
    for name in ("dtm", "dsm"):
        assert len(list((tmp_path / name).glob("*.tif"))) == 12
    assert np.nanmedian(heights_of(tmp_path / "dsm" / "t11.tif")) > 58.0
    assert quality(folder).points == 24_000


@pytest.mark.rest
def test_a_delivery_has_the_file(roof, tmp_path):
    files = [roof / f"t{column}{row}.laz" for column in range(3) for row in range(3)]
    summary = deliver(files, tmp_path / "out", delivery="forestry")
    assert not summary.failures and summary.point_count == 18_000
    assert "t11.laz" in bytes_of(tmp_path / "out" / "points")
    told = "t11.laz has no ground: its 2,000 points are written as not ground."
    assert told in summary.warnings
    assert told in (tmp_path / "out" / "index.html").read_text("utf-8")
