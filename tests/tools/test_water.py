"""Water, on land where it is known."""

import json
import re

import numpy as np
import pytest
from checkpoints import write
from matrices import covering, quick
from realdata import real
from water_scenes import (
    LEVEL,
    Scene,
    contains,
    lake,
    lake_scene,
    overlap,
    river,
    run,
    written_water,
)

from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.tools.water.descent import isotonic
from bare_earth.algorithms.tools.water.grid import cell_for, grids_of


@pytest.mark.rest(but="empty")
@pytest.mark.parametrize("kind", ["empty", "sparse", "class 9"])
def test_a_lake_is_found_with_its_level(kind):
    (body,) = lake_scene(kind).water()
    assert body.kind == "lake"
    assert overlap([body], lake) > 0.9
    assert abs(body.level - LEVEL) < 0.2 and body.spread < 0.15
    assert body.grade == "certain"
    assert (body.class_share > 0.9) == (kind == "class 9")
    assert np.ptp(body.rings[0][:, 2]) == 0


def test_a_river_falls_by_a_metre_in_500_m():
    scene = Scene(500.0, 300.0)
    scene.basin(river, lambda x, y: LEVEL - 0.002 * x)
    scene.keep(scene.inside(river) > 0)
    (body,) = scene.water()
    assert body.kind == "river"
    assert overlap([body], river, (500.0, 300.0)) > 0.9
    (line,) = body.lines
    assert (np.diff(line[:, 2]) <= 0).all()
    x, _, level = line[2:-2].T
    assert np.abs(level - (LEVEL - 0.002 * x)).max() < 0.25
    assert body.level - body.lowest == pytest.approx(1.0, abs=0.25)
    assert 30 < body.width < 50
    assert scene.water(min_width=60.0) == []


def test_a_lake_that_is_open_to_an_empty_corner_of_the_survey_is_found():
    scene = Scene()
    scene.basin(lake)
    scene.keep((scene.inside(lake) > 0) & (scene.y > 0.7 * scene.x + 40.0))
    (body,) = scene.water()
    assert overlap([body], lambda x, y: np.maximum(lake(x, y), 0.7 * x + 40.0 - y)) > 0.9
    assert abs(body.level - LEVEL) < 0.2


def reservoir(x, y):
    """Return how far places are from a reservoir of 28 ha; negative inside."""
    east, north = x - 450.0, y - 500.0
    return np.hypot(east, north) - 300.0 * (1.0 + 0.2 * np.sin(3 * np.arctan2(north, east)))


@pytest.mark.rest(but="0.05")
@pytest.mark.parametrize("slope", [0.05, 0.5])
def test_a_reservoir_in_woods_is_found_in_few_points(slope):
    """Few of the points in a wood are ground, and some crowns hang over the water."""
    scene = Scene(1000.0, 1000.0, density=0.3, rolling=5.0)
    # A dam holds the water in the north.
    scene.z = np.where(scene.y > 700.0, scene.z, np.maximum(scene.z, LEVEL + 2.0))
    scene.basin(reservoir, slope=slope)
    away, chance = scene.inside(reservoir), scene.random.random(len(scene.x))
    crowns = (chance > 0.1) | (away < 0)
    scene.z[crowns] += 15.0
    scene.classes[crowns] = 5
    scene.keep((away > 0) | (chance < 0.01))
    (body,) = scene.water(cell=4.0)
    assert overlap([body], reservoir, (1000.0, 1000.0)) > 0.9
    assert abs(body.level - LEVEL) < 0.5 and body.kind == "lake"


def hall(scene):
    on = (np.abs(scene.x - 200) < 75) & (np.abs(scene.y - 200) < 60)
    scene.z[on], scene.classes[on] = LEVEL + 9.0, 6


def black_roof(scene):
    scene.keep((np.abs(scene.x - 200) > 75) | (np.abs(scene.y - 200) > 60))


def dense_forest(scene):
    wood = np.hypot(scene.x - 200, scene.y - 200) < 90
    scene.z[wood] += scene.random.uniform(5, 25, wood.sum())
    scene.classes[wood] = 5


def thin_forest(scene):
    """Few returns, all of them high."""
    dense_forest(scene)
    scene.keep((scene.classes == 2) | (scene.random.random(len(scene.x)) < 0.15))


def slanted_border(scene):
    scene.keep(scene.y > 0.7 * scene.x)


def gap(scene):
    scene.keep(np.abs(scene.y - 200 - 0.2 * scene.x) > 25)


def sparser_half(scene):
    scene.keep((scene.x < 200) | (scene.random.random(len(scene.x)) < 0.15))


@pytest.mark.rest(but="dense_forest")
@pytest.mark.parametrize(
    ("changed", "slope_and_waves"),
    covering(
        [hall, black_roof, dense_forest, thin_forest, slanted_border, gap, sparser_half],
        [(0.0, 0.0), (0.03, 1.0), (0.0, 1.0), (0.03, 0.0)],
    ),
)
def test_what_is_not_water_is_not_found(changed, slope_and_waves):
    slope, rolling = slope_and_waves
    scene = Scene(slope=slope, rolling=rolling)
    changed(scene)
    assert scene.water(min_area=1000.0, min_width=10.0) == []


def test_isotonic_regression_is_that_of_least_squares():
    random = np.random.default_rng(4)
    values = np.cumsum(random.normal(0.1, 1.0, 200))
    fitted = isotonic(values)
    assert (np.diff(fitted) >= 0).all()
    assert fitted.sum() == pytest.approx(values.sum())
    # The least squares: residuals are at right angles to the fit.
    assert ((values - fitted) * fitted).sum() == pytest.approx(0.0, abs=1e-6)


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    """A lake with points of class 9 along its shore, in one file, and in four."""
    scene, folder = Scene(), tmp_path_factory.mktemp("survey")
    scene.basin(lake)
    scene.keep(scene.inside(lake) > 0)
    order = np.lexsort((scene.y, scene.x))
    scene.keep(order)
    tiles = folder / "tiles"
    tiles.mkdir()
    columns = np.round(scene.x, 3), np.round(scene.y, 3), np.round(scene.z, 3), scene.classes
    write(folder / "in.laz", *columns)
    for number in range(4):
        there = (columns[0] >= 200.3) + 2 * (columns[1] >= 190.7) == number
        write(tiles / f"{number}.laz", *(column[there] for column in columns))
    return folder


@pytest.mark.rest
def test_many_files_give_the_same_as_one(survey, tmp_path, capsys):
    run("water", survey / "in.laz", tmp_path / "one.geojson", "--json")
    figures = json.loads(capsys.readouterr().out)
    assert figures["lakes"] == 1 and figures["rivers"] == 0
    assert figures["grades"] == {"certain": 1}
    run("water", survey / "tiles", tmp_path / "many.geojson")
    one, many = (json.loads((tmp_path / f"{name}.geojson").read_text()) for name in ("one", "many"))
    assert one["features"] == many["features"]
    assert one["crs"]["properties"]["name"].endswith(":25832")
    (feature,) = one["features"]
    assert feature["properties"]["KIND"] == "lake"
    assert feature["properties"]["LEVEL"] == pytest.approx(LEVEL, abs=0.2)
    ring = np.array(feature["geometry"]["coordinates"][0])
    assert (ring[0] == ring[-1]).all()
    assert np.abs(ring.mean(axis=0) - (500_200, 5_600_210)).max() < 20


@pytest.mark.rest(but=".geojson")
@pytest.mark.parametrize("suffix", quick([".gpkg", ".geojson", ".shp", ".fgb"], ".geojson", ".shp"))
def test_polygons_and_breaklines_are_read_again(survey, tmp_path, suffix):
    from bare_earth.algorithms.survey.vector_files import read_boundary, read_lines

    if suffix != ".geojson":
        pytest.importorskip("pyogrio")
    target, lines = tmp_path / f"water{suffix}", tmp_path / f"lines{suffix}"
    run("water", survey / "in.laz", target, "--breaklines-out", lines)
    ((ring, *_),) = read_boundary(target)
    (line, *_) = read_lines(lines)
    assert np.allclose(ring, line[:, :2], atol=0.002)
    assert np.ptp(line[:, 2]) == 0 and abs(line[0, 2] - LEVEL) < 0.2


@pytest.mark.rest
def test_a_terrain_model_with_the_water_that_is_found(survey, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    run("terrain", survey / "in.laz", "--dtm", tmp_path / "dtm.tif", "--water", "automatic")
    with rasterio.open(tmp_path / "dtm.tif") as raster:
        heights = raster.read(1)
        x, y = np.meshgrid(*(np.arange(0.5, side) * raster.res[0] for side in raster.shape[::-1]))
        west, north = raster.bounds.left - 500_000, raster.bounds.top - 5_600_000
    inside = lake(x + west, north - y) < -5.0
    assert np.ptp(heights[inside]) < 0.001
    assert abs(heights[inside][0] - LEVEL) < 0.3


@pytest.mark.rest
def test_the_command_prints_what_it_found_and_the_limits_if_it_found_nothing(
    survey, tmp_path, capsys
):
    run("water", survey / "in.laz", tmp_path / "one.geojson")
    assert re.search(r"one\.geojson: 1 lake .*\b0 .* 1\.6 ha \(1 ", capsys.readouterr().out)
    run("water", survey / "in.laz", tmp_path / "none.geojson", "--min-area", 20_000)
    assert re.search("no lake of 20,000 m².* river", capsys.readouterr().out)


def test_what_cannot_be_done_is_said(survey, tmp_path, capsys):
    source, target = survey / "in.laz", tmp_path / "water.gpkg"
    assert main(["water", str(source), str(tmp_path / "water.tif")]) == 1
    assert ".gpkg" in capsys.readouterr().err
    assert main(["water", str(source), str(target), "--ground-classes", "17"]) == 1
    assert "no ground points" in capsys.readouterr().err
    assert main(["water", str(source), str(target), "--breaklines-out", str(target)]) == 1
    output = str(tmp_path / "out.laz")
    assert main(["classify", str(source), output, "--water", "automatic"]) == 2
    assert re.search("--water automatic .*'bare-earth terrain'", capsys.readouterr().err)
    assert not any(tmp_path.iterdir())


def test_too_many_cells_are_refused():
    with pytest.raises(BareEarthError, match="Choose cells of 13 m"):
        grids_of([(0.0, 0.0, 1e5, 1e5)], 1.0)
    with pytest.raises(BareEarthError, match="Choose cells of 13 m"):
        grids_of([(0.0, 0.0, 1e5, 5e4), (1e7, 0.0, 1e7 + 1e5, 5e4)], 1.0)
    assert cell_for(1e6, 100_000_000) == 1.0
    assert cell_for(1e6, 250_000, 2.0) == 2.0


@pytest.mark.rest
def test_water_in_feet_has_its_level_in_feet(tmp_path):
    scene = lake_scene("empty")
    feet = 0.3048
    places = (np.round(axis / feet, 3) for axis in (scene.x, scene.y, scene.z))
    write(tmp_path / "in.laz", *places, scene.classes, crs="EPSG:2223")  # Arizona, feet
    run("water", tmp_path / "in.laz", tmp_path / "water.geojson", "--crs", "EPSG:2223+8228")
    (feature,) = json.loads((tmp_path / "water.geojson").read_text())["features"]
    assert feature["properties"]["LEVEL"] == pytest.approx(LEVEL / feet, abs=0.7)
    assert feature["properties"]["AREA"] == pytest.approx(15_800, rel=0.05)


@pytest.mark.rest
@pytest.mark.parametrize("number", quick([0, 2], 2))
def test_a_pond_full_of_returns_is_found_without_its_class(number, tmp_path):
    import laspy

    las = laspy.read(real("real/pond_powerline.laz"))
    near = (las.y - las.y.min() > 190) & (las.y - las.y.min() < 430)
    las.points = las.points[near]
    las.write(tmp_path / "truth.laz")
    classes = np.array(las.classification)
    classes[classes == 9] = number
    las.classification = classes
    las.write(tmp_path / "wiped.laz")
    found = []
    for name in ("truth", "wiped"):
        (body,) = written_water(tmp_path / f"{name}.laz", tmp_path)
        found.append(body)
    x, y = np.meshgrid(np.arange(las.x.min(), las.x.max()), np.arange(las.y.min(), las.y.max()))
    true, again = (contains(body, x, y) for body in found)
    assert (true & again).sum() >= 0.88 * (true | again).sum()
    assert found[1].grade != "certain" and abs(found[0].level - found[1].level) < 0.05


@pytest.mark.parametrize("slope", [0.0, 0.002])
def test_a_flat_field_is_no_water(slope):
    """Ditches are lower than the field, and land beside it is as high."""
    scene = Scene(slope=slope, rolling=0.0)
    scene.z[(np.abs(scene.x - 100) < 2) | (np.abs(scene.y - 300) < 2)] -= 1.0
    assert scene.water() == []
