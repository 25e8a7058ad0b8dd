"""Roads that count as ground without changing their class, overlap, and classes of surfaces."""

import laspy
import numpy as np
import pytest
from conftest import Heard
from realdata import real
from runs import said

from bare_earth.algorithms.engine.memory import Resources
from bare_earth.algorithms.rasters.geotiff import read_raster
from bare_earth.algorithms.runs.entry import classify, terrain
from bare_earth.algorithms.runs.requests import ClassifyRequest, TerrainRequest
from bare_earth.algorithms.survey.ground_classes import GroundClasses
from bare_earth.algorithms.survey.selection import Selection
from bare_earth.algorithms.tools.ground.output import Output
from bare_earth.algorithms.tools.rasters.parameters import SurfaceModel
from bare_earth.algorithms.tools.rasters.rows import RasterFiles

SIDE, ROAD, BRIDGE = 120, 11, 5.0
# The border of two blocks, at 500,000 m, runs through the scenes.
EAST, NORTH = 499_940.0, 5_700_000.0


def write(path, x, y, z, classes, overlap=0):
    header = laspy.LasHeader(point_format=6, version="1.4")
    header.scales, header.offsets = (0.001,) * 3, (EAST, NORTH, 0.0)
    las = laspy.LasData(header)
    las.x, las.y, las.z = x + EAST, y + NORTH, z
    las.classification[:] = classes
    las.overlap[:] = overlap
    las.return_number[:] = las.number_of_returns[:] = 1
    las.write(str(path))
    return path


@pytest.fixture(scope="module")
def town(tmp_path_factory):
    """A plane with a cambered road of class 11, and a flyover of the same class across it."""
    x, y = (each.ravel() * 1.0 + 0.5 for each in np.meshgrid(np.arange(SIDE), np.arange(SIDE)))
    across = np.abs(y - 60.0)
    z = 50.0 + 0.02 * x + np.where(across < 12, 0.6 * (1 - across / 12), 0.0)
    fly_x, fly_y = (
        each.ravel() + 0.25 for each in np.meshgrid(np.arange(80.0, 90.0), np.arange(SIDE))
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


def request(folder, **more):
    rasters = RasterFiles(dtm=folder / "dtm.tif", confidence=folder / "confidence.tif")
    return ClassifyRequest(rasters=rasters, output=Output(height_above_ground=True), **more)


def test_roads_on_the_ground_are_terrain_and_those_above_it_are_not(town, tmp_path):
    classify(town / "one.las", tmp_path / "out.las", request(tmp_path))
    before, after = laspy.read(town / "one.las"), laspy.read(tmp_path / "out.las")
    roads = np.asarray(before.classification) == ROAD
    assert (np.asarray(after.classification)[roads] == ROAD).all()
    assert (np.asarray(after.classification)[~roads] == 2).all()
    dtm = read_raster(tmp_path / "dtm.tif").heights
    assert dtm.shape == (SIDE, SIDE)
    # The crown of the road, which no point of class 2 shows.
    crown = dtm[SIDE - 61, :70] - (50.0 + 0.02 * (np.arange(70) + 0.5))
    assert (np.abs(crown - 0.575) < 0.05).all()
    below = dtm[:, 80:90] - (50.0 + 0.02 * (np.arange(80, 90) + 0.5))
    assert (below < 0.7).all()
    heights, flyover = np.asarray(after["HeightAboveGround"]), len(before) - 10 * SIDE
    assert (heights[:flyover] == 0.0).all()
    assert (heights[flyover:] > BRIDGE - 0.7).all()


def test_many_files_give_the_roads_of_one(town, tmp_path, threads_for_processes):
    for name in ("one", "many"):
        (tmp_path / name).mkdir()
    classify(town / "one.las", tmp_path / "one" / "out.las", request(tmp_path / "one"))
    classify(town / "many", tmp_path / "many" / "out", request(tmp_path / "many"))
    for name in ("dtm", "confidence"):
        one, many = (
            read_raster(tmp_path / each / f"{name}.tif").heights for each in ("one", "many")
        )
        np.testing.assert_array_equal(one, many)
    whole = laspy.read(tmp_path / "one" / "out.las")
    for name in ("west", "east"):
        part = laspy.read(tmp_path / "many" / "out" / f"{name}.las")
        same = (
            np.asarray(whole.x) < 500_000.0 if name == "west" else np.asarray(whole.x) >= 500_000.0
        )
        for each in ("classification", "HeightAboveGround"):
            np.testing.assert_array_equal(np.asarray(whole[each])[same], np.asarray(part[each]))


def test_roads_that_wait_on_disk_are_the_same(town, tmp_path):
    for name, memory in (("memory", 4.0), ("disk", 0.001)):
        (tmp_path / name).mkdir()
        how, heard = request(tmp_path / name, resources=Resources(memory=memory)), Heard()
        classify(town / "one.las", tmp_path / name / "out.las", how, heard)
        waits = any("wait in a temporary file" in text for text in heard.infos)
        assert waits == (name == "disk")
    for name in ("out.las", "dtm.tif", "confidence.tif"):
        one, other = ((tmp_path / each / name).read_bytes() for each in ("memory", "disk"))
        assert one == other, name


def test_known_ground_that_keeps_its_class_is_ground_for_the_rasters(town, tmp_path):
    selection = Selection(seed_classes=(ROAD,))
    classify(town / "one.las", tmp_path / "out.las", request(tmp_path, selection=selection))
    dtm = read_raster(tmp_path / "dtm.tif").heights
    # The user says that all of it is ground, also the flyover.
    assert dtm[5, 85] > 50.0 + BRIDGE


@pytest.mark.parametrize("source", ["one.las", "many"])
def test_water_stays_and_the_log_says_so(tmp_path, source, threads_for_processes):
    file, folder = real("field/water-class9.laz"), tmp_path / "many"
    folder.mkdir()
    las = laspy.read(file)
    las.write(tmp_path / "one.las")
    las.write(folder / "one.las")
    water = np.asarray(las.classification) == 9
    assert np.count_nonzero(water) == 4727
    out = tmp_path / ("out.las" if source == "one.las" else "out")
    for words, stays in (((), True), (("--from-classes", "all"), False)):
        code, text, told = said("classify", tmp_path / source, out, "--verbose", *words)
        assert code == 0
        found = laspy.read(out if source == "one.las" else out / "one.las")
        assert (np.asarray(found.classification)[water] == 9).all() == stays
        line = "4,727 points of class 9 (water) keep their class and do not take part."
        assert (line in text + told) == stays
        assert ("(--from-classes all)" in text + told) == stays


def test_overlap_that_is_left_out_is_in_no_raster(tmp_path):
    x, y = (each.ravel() + 0.5 for each in np.meshgrid(np.arange(40.0), np.arange(40.0)))
    both = np.concatenate([x, x[x > 20] + 0.2]), np.concatenate([y, y[x > 20]])
    strip = np.arange(len(both[0])) >= len(x)
    # The second strip is 0.1 m too high.
    source = write(tmp_path / "in.las", *both, 100.0 + 0.1 * strip, 1, strip)
    for overlap, highest in (("use", 100.1), ("leave-out", 100.0)):
        folder = tmp_path / overlap
        folder.mkdir()
        rasters = RasterFiles(dtm=folder / "dtm.tif", dsm=folder / "dsm.tif")
        selection = Selection(overlap=overlap)
        run = ClassifyRequest(rasters=rasters, selection=selection)
        classify(source, folder / "out.las", run)
        classes = np.asarray(laspy.read(folder / "out.las").classification)
        assert (classes[strip] == (2 if overlap == "use" else 1)).any()
        assert overlap == "use" or (classes[strip] == 1).all()
        assert read_raster(folder / "dsm.tif").heights.max() == pytest.approx(highest)
        # The same of a file in which both strips are ground.
        ground = GroundClasses(overlap=overlap)
        again = RasterFiles(dtm=folder / "dtm2.tif", dsm=folder / "dsm2.tif")
        terrain(tmp_path / "use" / "out.las", TerrainRequest(rasters=again, ground=ground))
        for name in ("dtm2", "dsm2"):
            assert read_raster(folder / f"{name}.tif").heights.max() == pytest.approx(highest)


def test_the_classes_of_the_surface_can_be_chosen(tmp_path):
    x, y = (each.ravel() + 0.5 for each in np.meshgrid(np.arange(20.0), np.arange(20.0)))
    places = np.tile(x, 3), np.tile(y, 3)
    classes = np.repeat([2, 6, 5], len(x))
    source = write(tmp_path / "in.las", *places, np.repeat([100.0, 104.0, 109.0], len(x)), classes)
    for chosen, height in ((None, 109.0), ((2, 6), 104.0), ((2,), 100.0)):
        files = RasterFiles(dsm=tmp_path / f"{height}.tif")
        terrain(source, TerrainRequest(rasters=files, surface=SurfaceModel(surface_classes=chosen)))
        assert (read_raster(files.wanted["dsm"]).heights == height).all()
    code, _, told = said("terrain", source, "--dsm", tmp_path / "no.tif", "--surface-classes", "41")
    assert code and "Choose other classes for the surface" in told


@pytest.mark.parametrize(("classes", "lowest"), [((2, 40), 6.0), ((2,), 9.8)])
def test_water_above_its_bottom_is_no_canopy(tmp_path, classes, lowest):
    source = real("field2/topobathy.laz")
    files = RasterFiles(dsm=tmp_path / "dsm.tif", chm=tmp_path / "chm.tif")
    request = TerrainRequest(rasters=files, ground=GroundClasses(ground_classes=classes))
    heard = Heard()
    terrain(source, request, heard)
    assert np.nanmax(read_raster(files.wanted["chm"]).heights) < 0.3
    assert np.nanmin(read_raster(files.wanted["dsm"]).heights) == pytest.approx(lowest, abs=0.1)
    told = [text for text in heard.infos if "left out of the surface model" in text]
    assert told[0].startswith("9,060 points" if 40 in classes else "1,569 points")
