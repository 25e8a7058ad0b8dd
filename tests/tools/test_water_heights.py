"""The heights of water are the same in all that is handed over, and no cell of it is empty."""

import numpy as np
import pytest
import rasterio
from checkpoints import write
from independent_water import compare, corners_in_flat_water, features, share_at_level
from matrices import covering
from rasterio.features import geometry_mask
from water_scenes import LEVEL, Scene, lake, river, run

import bare_earth

pytest.importorskip("pyogrio")
WATERS = ("river", "lake")


@pytest.fixture(scope="module")
def surveys(tmp_path_factory):
    """Return what makes a survey with water of a kind, as one file and as four.

    The river crosses the survey from border to border. A wood stands on the shore of the lake.
    """
    folder, known = tmp_path_factory.mktemp("surveys"), {}

    def make(kind):
        if kind in known:
            return known[kind]
        scene = Scene(500.0, 300.0, 1.5) if kind == "river" else Scene(density=1.5)
        away = river if kind == "river" else lake
        scene.basin(away, (lambda x, y: LEVEL - 0.002 * x) if kind == "river" else LEVEL)
        scene.keep(scene.inside(away) > 0)
        wood = (scene.inside(away) < 30.0) & (scene.random.random(len(scene.x)) < 0.4)
        scene.z[wood] += scene.random.uniform(5.0, 20.0, wood.sum())
        scene.classes[wood] = 5
        columns = np.round(scene.x, 3), np.round(scene.y, 3), np.round(scene.z, 3), scene.classes
        tiles = folder / kind / "tiles"
        tiles.mkdir(parents=True)
        for number in range(4):
            there = (columns[0] >= 200.3) + 2 * (columns[1] >= 140.7) == number
            write(tiles / f"{number}.las", *(column[there] for column in columns))
        known[kind] = write(folder / kind / "one.las", *columns), tiles
        return known[kind]

    return make


@pytest.mark.rest
@pytest.mark.parametrize(("kind", "is_one"), covering(WATERS, [True, False]))
def test_each_cell_of_water_has_the_level_of_polygons_and_breaklines(
    surveys, tmp_path, kind, is_one
):
    source = surveys(kind)[0 if is_one else 1]
    water, lines = tmp_path / "water.gpkg", tmp_path / "lines.gpkg"
    dtm, dsm = tmp_path / "dtm.tif", tmp_path / "dsm.tif"
    run("water", source, water, "--breaklines-out", lines)
    run("terrain", source, "--dtm", dtm, "--dsm", dsm, "--water", "automatic")
    ((fields, _),) = features(water)
    assert (fields["KIND"], fields["GRADE"]) == (kind, "certain")
    (found,) = compare(water, lines, dtm, dsm).values()
    assert found.cells > 10_000 and found.missing == 0
    assert found.level < 0.01 and found.lines < 0.01, found
    # Nothing was measured in the water: its surface is that of the water, not of trees beside it.
    assert share_at_level(water, dsm) > 0.97


@pytest.mark.rest
def test_the_expected_error_of_ground_points_has_no_value_in_water(surveys, tmp_path):
    source, _ = surveys("lake")
    water, dtm, sure = (tmp_path / name for name in ("water.gpkg", "dtm.tif", "sure.tif"))
    run("water", source, water)
    run("terrain", source, "--dtm", dtm, "--expected-error", sure, "--water", "automatic")
    ((_, rings),) = features(water)
    polygon = {"type": "Polygon", "coordinates": [ring.tolist() for ring in rings]}
    with rasterio.open(dtm) as terrain, rasterio.open(sure) as error:
        heights, found = terrain.read(1, masked=True), error.read(1, masked=True)
        cells = [polygon], heights.shape, terrain.transform
        is_water, is_land = geometry_mask(*cells, invert=True), geometry_mask(*cells, True)
    assert not heights.mask[is_water].any() and found.mask[is_water].all()
    assert not found.mask[is_land & ~heights.mask].any()


@pytest.mark.rest
def test_no_contour_line_runs_through_flat_water(surveys, tmp_path):
    source, _ = surveys("lake")
    water, dtm = tmp_path / "water.gpkg", tmp_path / "dtm.tif"
    run("water", source, water)
    run("terrain", source, "--dtm", dtm, "--water", "automatic")
    ((fields, _),) = features(water)
    # A line just above the level, and one right at it.
    for number, interval in enumerate((LEVEL / 999.0, fields["LEVEL"] / 500.0)):
        contours = tmp_path / f"{number}.gpkg"
        bare_earth.contours(dtm, contours, contour_interval=interval)
        assert corners_in_flat_water(water, contours, dtm) == 0
