"""Roads that count as ground without changing their class, overlap, and classes of surfaces."""

import laspy
import numpy as np
import pytest
from matrices import quick
from realdata import real
from runs import FAST, FAST_WORDS, Heard, said
from surveys import heights_of, write_points

from bare_earth import classify, terrain

SIDE, ROAD, BRIDGE = 120, 11, 5.0
# The border of two blocks, at 500,000 m, runs through the scenes.
EAST, NORTH = 499_940.0, 5_700_000.0


def write(path, x, y, z, classes, overlap=0):
    return write_points(path, x, y, z, classes, offset=(EAST, NORTH, 0.0), overlap=overlap)


@pytest.fixture(scope="module")
def town(tmp_path_factory):
    """A plane with a cambered road of class 11, and a flyover of the same class across it."""
    x, y = (axis.ravel() * 1.0 + 0.5 for axis in np.meshgrid(np.arange(SIDE), np.arange(SIDE)))
    across = np.abs(y - 60.0)
    z = 50.0 + 0.02 * x + np.where(across < 12, 0.6 * (1 - across / 12), 0.0)
    fly_x, fly_y = (
        axis.ravel() + 0.25 for axis in np.meshgrid(np.arange(80.0, 90.0), np.arange(SIDE))
    )
    x, y = np.append(x, fly_x), np.append(y, fly_y)
    z = np.append(z, 50.0 + 0.02 * fly_x + BRIDGE)
    classes = np.append(np.where(across < 12, ROAD, 1), np.full(len(fly_x), ROAD))
    folder = tmp_path_factory.mktemp("town")
    write(folder / "one.las", x, y, z, classes)
    (folder / "many").mkdir()
    for name, part in {"west": x < 60.0, "east": x >= 60.0}.items():
        write(folder / "many" / f"{name}.las", x[part], y[part], z[part], classes[part])
    return folder


def outputs(folder):
    """Return the outputs of a run beside points."""
    rasters = {name: folder / f"{name}.tif" for name in ("dtm", "expected_error")}
    return {**rasters, "height_above_ground": True}


@pytest.mark.rest
def test_roads_on_the_ground_are_terrain_and_those_above_it_are_not(town, tmp_path):
    classify(town / "one.las", tmp_path / "out.las", **outputs(tmp_path))
    before, after = laspy.read(town / "one.las"), laspy.read(tmp_path / "out.las")
    roads = np.asarray(before.classification) == ROAD
    assert (np.asarray(after.classification)[roads] == ROAD).all()
    assert (np.asarray(after.classification)[~roads] == 2).all()
    dtm = heights_of(tmp_path / "dtm.tif")
    assert dtm.shape == (SIDE, SIDE)
    # The crown of the road, which no point of class 2 shows.
    crown = dtm[SIDE - 61, :70] - (50.0 + 0.02 * (np.arange(70) + 0.5))
    assert (np.abs(crown - 0.575) < 0.05).all()
    below = dtm[:, 80:90] - (50.0 + 0.02 * (np.arange(80, 90) + 0.5))
    assert (below < 0.7).all()
    heights, flyover = np.asarray(after["HeightAboveGround"]), len(before) - 10 * SIDE
    assert (heights[:flyover] == 0.0).all()
    assert (heights[flyover:] > BRIDGE - 0.7).all()


def test_reserved_classes_of_many_files_are_told_without_a_meaning(town, tmp_path):
    las, progress = laspy.read(town / "one.las"), Heard()
    (tmp_path / "in").mkdir()
    laspy.convert(las, point_format_id=1).write(tmp_path / "in" / "old.las")
    classify(tmp_path / "in", tmp_path / "out", **FAST, progress=progress)
    (told,) = (text for text in progress.warnings + progress.infos if "class 11" in text)
    assert "reserve these classes" in told and told in progress.warnings


@pytest.mark.rest
def test_a_reserved_class_is_no_road(town, tmp_path):
    las = laspy.read(town / "one.las")
    flyover = slice(len(las) - 10 * SIDE, None)
    las.classification[flyover] = 1
    laspy.convert(las, point_format_id=1).write(tmp_path / "old.las")
    classify(tmp_path / "old.las", tmp_path / "out.las", **outputs(tmp_path))
    dtm = heights_of(tmp_path / "dtm.tif")
    # The crown of the road is no terrain.
    assert not (dtm[SIDE - 61, :70] - (50.0 + 0.02 * (np.arange(70) + 0.5)) > 0.1).any()


@pytest.mark.long
def test_many_files_give_the_roads_of_one(town, tmp_path):
    for name in ("one", "many"):
        (tmp_path / name).mkdir()
    classify(town / "one.las", tmp_path / "one" / "out.las", **outputs(tmp_path / "one"))
    classify(town / "many", tmp_path / "many" / "out", **outputs(tmp_path / "many"))
    for name in ("dtm", "expected_error"):
        one, many = (tmp_path / run / f"{name}.tif" for run in ("one", "many"))
        np.testing.assert_array_equal(heights_of(one), heights_of(many))
    whole = laspy.read(tmp_path / "one" / "out.las")
    for name in ("west", "east"):
        part = laspy.read(tmp_path / "many" / "out" / f"{name}.las")
        same = (np.asarray(whole.x) < 500_000.0) == (name == "west")
        for column in ("classification", "HeightAboveGround"):
            np.testing.assert_array_equal(np.asarray(whole[column])[same], np.asarray(part[column]))


@pytest.mark.rest
def test_roads_that_wait_on_disk_are_the_same(town, tmp_path):
    for name, memory in (("memory", 4.0), ("disk", 0.001)):
        (tmp_path / name).mkdir()
        progress, how = Heard(), outputs(tmp_path / name)
        out = tmp_path / name / "out.las"
        classify(town / "one.las", out, memory=memory, progress=progress, **how)
        waits = any("wait in a temporary file" in text for text in progress.infos)
        assert waits == (name == "disk")
    for name in ("out.las", "dtm.tif", "expected_error.tif"):
        memory, disk = ((tmp_path / run / name).read_bytes() for run in ("memory", "disk"))
        assert memory == disk, name


@pytest.mark.rest
def test_known_ground_that_keeps_its_class_is_ground_for_the_rasters(town, tmp_path):
    classify(town / "one.las", tmp_path / "out.las", seed_classes=(ROAD,), **outputs(tmp_path))
    dtm = heights_of(tmp_path / "dtm.tif")
    # The user says that all of it is ground, also the flyover.
    assert dtm[5, 85] > 50.0 + BRIDGE


@pytest.mark.parametrize("source", quick(["one.las", "many"], "one.las"))
def test_water_stays_and_the_log_says_so(tmp_path, source):
    file, folder = real("field/water-class9.laz"), tmp_path / "many"
    folder.mkdir()
    las = laspy.read(file)
    las.write(tmp_path / "one.las")
    las.write(folder / "one.las")
    water = np.asarray(las.classification) == 9
    assert np.count_nonzero(water) == 4727
    out = tmp_path / ("out.las" if source == "one.las" else "out")
    for words, stays in (((), True), (("--from-classes", "all"), False)):
        code, text, told = said(
            "classify", tmp_path / source, out, "--verbose", *FAST_WORDS, *words
        )
        assert code == 0
        found = laspy.read(out if source == "one.las" else out / "one.las")
        assert (np.asarray(found.classification)[water] == 9).all() == stays
        line = "4,727 points of class 9 (water) keep their class and do not take part."
        assert (line in text + told) == stays
        assert ("give --from-classes all." in text + told) == stays


@pytest.mark.rest
def test_overlap_that_is_left_out_is_in_no_raster(tmp_path):
    x, y = (axis.ravel() + 0.5 for axis in np.meshgrid(np.arange(40.0), np.arange(40.0)))
    both = np.concatenate([x, x[x > 20] + 0.2]), np.concatenate([y, y[x > 20]])
    strip = np.arange(len(both[0])) >= len(x)
    # The second strip is 0.1 m too high.
    source = write(tmp_path / "in.las", *both, 100.0 + 0.1 * strip, 1, strip)
    for overlap, highest in (("use", 100.1), ("leave-out", 100.0)):
        folder = tmp_path / overlap
        folder.mkdir()
        dsm = folder / "dsm.tif"
        classify(source, folder / "out.las", dtm=folder / "dtm.tif", dsm=dsm, overlap=overlap)
        classes = np.asarray(laspy.read(folder / "out.las").classification)
        assert (classes[strip] == (2 if overlap == "use" else 1)).any()
        assert overlap == "use" or (classes[strip] == 1).all()
        assert heights_of(dsm).max() == pytest.approx(highest)
        # The same of a file in which both strips are ground.
        again = {name: folder / f"{name}2.tif" for name in ("dtm", "dsm")}
        terrain(tmp_path / "use" / "out.las", overlap=overlap, **again)
        for path in again.values():
            assert heights_of(path).max() == pytest.approx(highest)


def test_the_classes_of_the_surface_can_be_chosen(tmp_path):
    x, y = (axis.ravel() + 0.5 for axis in np.meshgrid(np.arange(20.0), np.arange(20.0)))
    places = np.tile(x, 3), np.tile(y, 3)
    classes = np.repeat([2, 6, 5], len(x))
    source = write(tmp_path / "in.las", *places, np.repeat([100.0, 104.0, 109.0], len(x)), classes)
    for chosen, height in ((None, 109.0), ((2, 6), 104.0), ((2,), 100.0)):
        terrain(source, dsm=(dsm := tmp_path / f"{height}.tif"), surface_classes=chosen)
        assert (heights_of(dsm) == height).all()
    code, _, told = said("terrain", source, "--dsm", tmp_path / "no.tif", "--surface-classes", "41")
    assert code and "other classes" in told


@pytest.mark.rest(but="6.0")
@pytest.mark.parametrize(("classes", "lowest"), [((2, 40), 6.0), ((2,), 9.8)])
def test_water_above_its_bottom_is_no_canopy(tmp_path, classes, lowest):
    source = real("field2/topobathy.laz")
    dsm, chm, progress = tmp_path / "dsm.tif", tmp_path / "chm.tif", Heard()
    terrain(source, dsm=dsm, chm=chm, ground_classes=classes, progress=progress)
    assert np.nanmax(heights_of(chm)) < 0.3
    assert np.nanmin(heights_of(dsm)) == pytest.approx(lowest, abs=0.1)
    told = [text for text in progress.infos if "surface model" in text]
    assert told[0].startswith("9,060 points" if 40 in classes else "1,569 points")


@pytest.mark.parametrize(("bottom", "point_format"), [(26, 1), (26, 6), (40, 6)])
def test_the_water_above_the_bottom_in_files_of_noaa_is_no_canopy(tmp_path, bottom, point_format):
    x, y = (axis.ravel() + 0.5 for axis in np.meshgrid(np.arange(30.0), np.arange(30.0)))
    wet = x > 15
    heights = np.append(np.where(wet, 97.0, 100.0), np.full(wet.sum(), 100.0))
    surface = bottom + 1
    classes = np.append(np.where(wet, bottom, 2), np.full(wet.sum(), surface))
    places = np.append(x, x[wet] + 0.2), np.append(y, y[wet])
    source = write_points(tmp_path / "in.las", *places, heights, 1, offset=(EAST, NORTH, 0.0))
    las = laspy.convert(laspy.read(source), point_format_id=point_format)
    las.classification = classes
    las.write(source)
    code, text, told = said(
        "terrain", source, "--chm", tmp_path / "c.tif", "--ground-classes", 2, bottom, "--verbose"
    )
    assert code == 0
    is_known = (bottom, point_format) != (26, 6)  # producers give their own meanings to 26
    assert (np.nanmax(heights_of(tmp_path / "c.tif")) < 0.1) == is_known
    line = (
        f"{wet.sum()} points on or in water are left out of the surface model (classes {surface})"
    )
    assert (line in text + told) == is_known
