"""Water below bridges, on land where it is known."""

import json
import re

import numpy as np
import pytest
from checkpoints import EAST, NORTH, write
from water_scenes import LEVEL, Scene, contains, lake, overlap, river, run

import bare_earth

LONG, HIGH, MIDDLE = 500.0, 300.0, 250.0


def level(x, y):
    return LEVEL - 0.002 * x


def valley():
    """Return land with the valley of a river that falls by a metre."""
    scene = Scene(LONG, HIGH)
    scene.basin(river, level)
    return scene


def build(scene, away, half=5.0, middle=MIDDLE, skew=0.0, start=3.0):
    """Build a road whose deck begins so many metres from the water."""
    across = np.abs(scene.x - middle - skew * (scene.y - 150.0)) - half
    on = (across < 0) & (away(scene.x, scene.y) < 40.0)
    scene.z[on] = LEVEL + 5.0 + scene.random.normal(0, 0.03, on.sum())
    scene.classes[on & (away(scene.x, scene.y) < start)] = 17


def flood(scene, away, kind="empty"):
    """Take the returns from water that lies open, or make them class 9."""
    wet = (away(scene.x, scene.y) < 0) & (scene.classes != 17)
    if kind == "empty":
        scene.keep(~wet)
    else:
        scene.z[wet] = level(scene.x, scene.y)[wet] + scene.random.normal(0, 0.03, wet.sum())
        scene.classes[wet] = 9


def bridged(kind="empty", **bridge):
    scene = valley()
    if kind == "two carriageways":
        build(scene, river, 6.0, MIDDLE - 8.0)
        build(scene, river, 6.0, MIDDLE + 8.0)
    else:
        build(scene, river, **bridge)
    flood(scene, river, "class 9" if kind == "class 9" else "empty")
    return scene


BRIDGES = [
    ("empty", {"half": 2.0}),
    ("class 9", {}),
    ("two carriageways", {}),
    *(
        pytest.param("empty", how, marks=pytest.mark.long)
        for how in ({}, {"half": 12.0}, {"skew": 0.7})
    ),
]


@pytest.mark.rest(but="empty-bridge0")
@pytest.mark.parametrize("kind, bridge", BRIDGES)
def test_a_river_goes_on_below_a_bridge(kind, bridge):
    scene = bridged(kind, **bridge)
    (body,) = scene.water()
    assert body.kind == "river" and body.grade == "certain"
    assert overlap([body], river, (LONG, HIGH)) > 0.9
    (line,) = body.lines
    x, _, found = line[2:-2].T
    assert np.ptp(x) > 350 and np.abs(found - level(x, 0)).max() < 0.25
    assert (np.diff(line[:, 2]) <= 0).all()
    # Below the deck as well, where the truth is 40 m wide.
    x, y = np.meshgrid(np.arange(MIDDLE - 12.0, MIDDLE + 13.0), np.arange(0.5, HIGH))
    true, found = river(x, y) < 0, contains(body, x, y)
    assert (true & found).sum() > 0.85 * (true | found).sum()


@pytest.mark.rest(but="empty")
@pytest.mark.parametrize(("half", "kind"), [(12.0, "empty"), (20.0, "class 9")])
def test_a_stream_narrower_than_its_bridge_goes_on_below_it(half, kind):
    def stream(x, y):
        return river(x, y) + 16.0

    scene = Scene(LONG, HIGH)
    scene.basin(stream, level)
    build(scene, stream, half)
    flood(scene, stream, kind)
    (body,) = scene.water(min_area=1000.0, min_width=5.0)
    assert body.kind == "river" and body.grade == "certain"
    # In places of a metre, since the stream is 8 m wide.
    assert overlap([body], stream, (LONG, HIGH), 500) > 0.9


def test_points_of_other_classes_are_no_deck():
    scene = bridged()
    scene.classes[scene.classes == 17] = 1
    assert len(scene.water()) == 2


def asphalt(scene):
    scene.keep((river(scene.x, scene.y) > 0) | (scene.random.random(len(scene.x)) < 0.6))


@pytest.mark.parametrize("floor", [lambda scene: None, asphalt])
def test_below_a_bridge_over_land_is_no_water(floor):
    scene = valley()
    build(scene, river)
    floor(scene)
    assert scene.water(min_area=300.0, min_width=3.0) == []


def test_a_deck_along_a_shore_adds_nothing():
    """A viaduct passes 4 m from a lake."""
    scene = Scene()
    scene.basin(lake)
    build(scene, lambda x, y: np.abs(y - 200) - 200, middle=285.0)
    flood(scene, lake)
    (body,) = scene.water()
    scene.classes[scene.classes == 17] = 1
    (without,) = scene.water()
    assert body.area == pytest.approx(without.area, rel=0.01)


def basin(x, y):
    """Return how far places are from a lake of 3 ha; negative inside."""
    return np.maximum(np.abs(x - 200.0) - 110.0, np.abs(y - 200.0) - 70.0)


def test_a_causeway_parts_two_lakes():
    def lakes(x, y):
        return np.maximum(basin(x, y), 8.0 - np.abs(x - 200.0))

    scene = Scene()
    scene.basin(lakes)
    flood(scene, lakes)
    assert [body.kind for body in scene.water()] == ["lake", "lake"]


@pytest.mark.rest(but="0.0")
@pytest.mark.parametrize("drop", [0.0, 3.0])
def test_only_water_with_one_level_is_one_lake(drop):
    """A bridge crosses a lake, or a weir between two lakes."""
    scene = Scene()
    scene.basin(basin, lambda x, y: LEVEL - drop * (x > 200.0))
    build(scene, basin, 6.0, 200.0)
    flood(scene, basin)
    levels = sorted(body.level for body in scene.water())
    assert levels == pytest.approx([LEVEL - drop, LEVEL] if drop else [LEVEL], abs=0.25)


def test_abutments_are_no_shore():
    """Of a reach of 100 m by 20 m they are a quarter of the banks."""

    def reach(x, y):
        return np.maximum(np.abs(x - 75.0) - 50.0, np.abs(y - 75.0) - 10.0)

    for seed in (1, 2):
        scene = Scene(150.0, 150.0, seed=seed)
        scene.basin(reach, lambda x, y: LEVEL - 0.004 * x)
        build(scene, reach, 12.0, 75.0, start=0.0)
        flood(scene, reach)
        (body,) = scene.water(min_area=500.0, min_width=5.0)
        assert body.kind == "river" and overlap([body], reach, (150.0, 150.0)) > 0.9


@pytest.mark.rest
def test_the_terrain_has_no_dam_below_a_bridge(tmp_path):
    rasterio = pytest.importorskip("rasterio")
    """The river begins and ends within the survey, because rasters end where the points do."""

    def away(x, y):
        return np.maximum(river(x, y), np.abs(x - MIDDLE) - 200.0)

    scene = Scene(LONG, HIGH, density=2.0)
    scene.basin(away, level)
    build(scene, away, 8.0, start=0.0)
    flood(scene, away)
    columns = (np.round(axis, 3) for axis in (scene.x, scene.y, scene.z))
    write(tmp_path / "in.laz", *columns, scene.classes)
    errors = {}
    for name, water in (("with", ("--water", "automatic")), ("without", ())):
        run("terrain", tmp_path / "in.laz", "--dtm", tmp_path / f"{name}.tif", *water)
        with rasterio.open(tmp_path / f"{name}.tif") as raster:
            heights = raster.read(1)
            x, y = np.meshgrid(
                *(np.arange(0.5, side) * raster.res[0] for side in raster.shape[::-1])
            )
            x, y = x + raster.bounds.left - 500_000, raster.bounds.top - 5_600_000 - y
        below = (np.abs(x - MIDDLE) < 12.0) & (river(x, y) < -3.0)
        errors[name] = np.abs(heights - level(x, y))[below].max()
    assert errors["with"] < 0.3 and errors["without"] > 4.0


@pytest.mark.rest
def test_bridges_without_water_below_them_are_told(tmp_path, capsys):
    told = []
    for name, is_wet in (("dry", False), ("wet", True)):
        scene = Scene(LONG, HIGH, density=1.0)
        scene.basin(river, level)
        build(scene, river, 8.0)
        if is_wet:
            flood(scene, river)
        columns = (np.round(axis, 3) for axis in (scene.x, scene.y, scene.z))
        write(tmp_path / f"{name}.laz", *columns, scene.classes)
        run("water", tmp_path / f"{name}.laz", tmp_path / f"{name}.geojson")
        told.append(capsys.readouterr().err)
    place = re.search(r"1 bridge .* water .*\(at (\d+) (\d+)\)", told[0])
    assert [int(value) for value in place.groups()] == pytest.approx(
        [EAST + MIDDLE, NORTH + 150], abs=15
    )
    assert "bridge has no water" not in told[1]


@pytest.mark.rest
def test_the_page_of_a_flood_model_begins_with_bridges_that_may_dam_a_stream(tmp_path):
    scene = Scene(LONG, HIGH, density=1.0)
    scene.basin(river, level)
    build(scene, river, 8.0)
    scene.keep(np.hypot(scene.x - MIDDLE, scene.y - 150.0) < 60.0)
    columns = (np.round(axis, 3) for axis in (scene.x, scene.y, scene.z))
    write(tmp_path / "dry.laz", *columns, scene.classes)
    folder = tmp_path / "out"
    how = {"delivery": "flood", "method": "slope", "bridges": "keep", "hold_out_share": None}
    bare_earth.deliver(tmp_path / "dry.laz", folder, **how)
    words = (folder / "index.html").read_text("utf-8").split("</h1>")[1]
    assert words.index("1 bridge has no water below it") < words.index("decks of bridges are")
    assert "bridges are removed" not in words and "(at " in words
    record = json.loads((folder / "delivery.json").read_text("utf-8"))
    assert record["water"]["dry_bridges"] == 1


def test_a_short_reach_that_falls_is_a_river():
    """It is 95 m long and 18 m wide. A lake of that form stays a lake."""

    def reach(x, y):
        return np.maximum(np.abs(x - 75.0) - 47.5, np.abs(y - 75.0) - 9.0)

    for seed, (fall, kind) in enumerate([(0.6, "river")] * 4 + [(0.0, "lake")] * 4):
        scene = Scene(150.0, 150.0, seed=seed)
        scene.basin(reach, lambda x, y, fall=fall: LEVEL - fall * x / 95.0)
        flood(scene, reach)
        (body,) = scene.water(1.5, min_area=1000.0, min_width=5.0)
        assert body.kind == kind
        assert body.width == pytest.approx(18.0, abs=3.0)
        assert body.level - body.lowest == pytest.approx(0.84 * fall, abs=0.15)
