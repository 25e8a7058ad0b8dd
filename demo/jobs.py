"""The land of the tutorials: for each job a small survey, and what somebody drew for it.

`make demo JOB=survey` writes `demo-output/survey/`: raw points, and what else the tutorial uses.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Callable, Mapping, NamedTuple, Sequence

import laspy
import numpy as np

from bare_earth.algorithms.core.points import Points
from benchmarks.scenes import Scene
from benchmarks.scenes.classes import BUILDING, GROUND, OTHER
from benchmarks.scenes.earthworks import earthworks_images
from benchmarks.scenes.landscape import FLAT, GABLE, VAULT, Box, Boxes, Deck, Landscape, Plants
from benchmarks.scenes.planting import single_trees, undergrowth, wood
from benchmarks.scenes.relief import smooth, waves
from benchmarks.scenes.scene import ORIGIN, Kind, Site, kind
from benchmarks.scenes.survey import Returns, survey

from .scene import checkpoints_of, las_of

_SEED = 7
# Metres by which the second strip of the survey lies too high.
_SECOND_STRIP = 0.02


def _house(terrain: Callable, x: float, y: float, *rest: float) -> Box:
    """Return a box that stands on the terrain; `rest` as in `Box`, without its base."""
    base = float(terrain(np.array([x]), np.array([y]))[0])
    length, width, angle, *others = rest
    return Box(x, y, length, width, angle, base, *others)


def _inside(x: np.ndarray, y: np.ndarray, west: float, south: float, east: float, north: float):
    return (x > west) & (x < east) & (y > south) & (y < north)


@kind(size=200.0, density=3.2, low_outliers=3e-4)
def survey_land(site: Site) -> Landscape:
    """A lake of 1 ha, a hall in a slope, houses, a wood, and birds."""
    roll, rough = waves(site.random, 0.8, 120.0), waves(site.random, 0.05, 8.0)

    def to_lake(x, y):
        angle = np.arctan2(y + 35.0, x - 35.0)
        return np.hypot(x - 35.0, y + 35.0) - 56.0 * (1.0 + 0.08 * np.sin(3 * angle))

    def terrain(x, y):
        # The hall is dug into a slope in the north-west.
        land = 102.5 + roll(x, y) + rough(x, y) + 9.0 * smooth((y - 42.0) / 40.0)
        return np.minimum(land, 100.0 + 0.3 * np.clip(to_lake(x, y), 0.0, None))

    hall = Box(-45.0, 52.0, 44.0, 26.0, 0.0, 105.5, 4.3, FLAT)
    houses = [
        _house(terrain, x, y, 13.0, 9.0, 0.3, 5.0, GABLE)
        for x, y in ((-80.0, -60.0), (-80.0, -30.0), (-50.0, -75.0))
    ]
    trees = wood(site, 7.0, 16.0, where=lambda x, y: _inside(x, y, 35.0, 45.0, 100.0, 100.0))
    birds = site.random.uniform(-95.0, 95.0, (2, 6))
    return Landscape(
        terrain, (Boxes([hall]), Boxes(houses)), trees=(trees,),
        plants=(undergrowth(site, 1.0, 0.5, 0.1),), water=lambda x, y: to_lake(x, y) < 0.0,
        stray=tuple(zip(*birds, site.random.uniform(145.0, 175.0, 6))),
    )  # fmt: skip


@kind(size=90.0, density=10.0, penetration=0.25, noise=0.02, low_outliers=0.0)
def archaeology_land(site: Site) -> Landscape:
    """A wood with a bank and a ditch, three barrows, a ruined wall, and stacks of logs."""
    roll, rough = waves(site.random, 1.2, 80.0), waves(site.random, 0.03, 5.0)
    mounds = ((-22.0, 20.0, 5.5, 1.0), (-8.0, 28.0, 4.5, 0.7), (-25.0, 34.0, 3.5, 0.5))

    def wall(x, y):
        ring = np.maximum(np.abs(x - 18.0) - 9.0, np.abs(y + 22.0) - 6.0)
        return 0.55 * (np.abs(ring) < 0.6)

    def terrain(x, y):
        z = 310.0 + 0.06 * x + roll(x, y) + rough(x, y)
        away = np.hypot(x - 50.0, y - 50.0) - 62.0
        z = z + 1.2 * np.exp(-((away / 2.2) ** 2)) - 0.9 * np.exp(-(((away - 6.0) / 2.2) ** 2))
        for east, north, radius, height in mounds:
            away = np.hypot(x - east, y - north) / radius
            z = z + height * np.clip(1.0 - away**2, 0.0, None)
        return z + wall(x, y)

    stacks = [
        _house(terrain, x, y, 12.0, 2.4, turn, 1.0, VAULT, 0.5, OTHER)
        for x, y, turn in ((-24.0, -22.0, 0.5), (-16.0, -30.0, 0.5))
    ]

    def clearing(x, y):
        return np.hypot(x + 20.0, y + 26.0) > 13.0

    hut = _house(terrain, -34.0, -6.0, 7.0, 5.0, 0.2, 2.6, GABLE)
    return Landscape(
        terrain, (Boxes(stacks), Boxes([hut])),
        trees=(wood(site, 6.0, 17.0, where=clearing, stem=0.4),),
        plants=(undergrowth(site, 0.7, 0.35, 0.25, 12.0),),
    )  # fmt: skip


@kind(size=100.0, density=5.0, penetration=0.15, slope=0.12)
def forestry_land(site: Site) -> Landscape:
    """Old conifers and broadleaves, young trees, a shed, and a rock as high as the young trees."""
    roll, rough = waves(site.random, 2.0, 90.0), waves(site.random, 0.08, 6.0)

    def terrain(x, y):
        out = np.hypot((x + 20.0) / 1.3, y + 38.0)
        rock = 3.2 * smooth((4.6 - out) / 2.2)
        return 520.0 + site.settings.slope * x + roll(x, y) + rough(x, y) + rock

    def old(x, y):
        return (x < -3.0) & (y > -20.0)

    def leafy(x, y):
        return (x > 3.0) & (y > -20.0)

    young = undergrowth(site, 3.2, 0.7, 0.85, 6.0)

    def young_top(x, y):
        is_rock = np.hypot((x + 20.0) / 1.3, y + 38.0) < 5.0
        return young.top(x, y) * _inside(x, y, -50.0, -50.0, 12.0, -26.0) * ~is_rock

    shed = _house(terrain, 32.0, -37.0, 14.0, 9.0, 0.1, 5.5, GABLE, 0.3)
    return Landscape(
        terrain, (Boxes([shed]),),
        trees=(
            wood(site, 4.5, 24.0, True, old, stem=0.25, radius=0.6),
            wood(site, 8.0, 18.0, where=leafy, stem=0.35),
        ),
        plants=(undergrowth(site, 1.2, 0.4, 0.25, 10.0), Plants(young_top, 0.75, 0.2)),
    )  # fmt: skip


@kind(size=150.0, density=3.5)
def flood_land(site: Site) -> Landscape:
    """A river with a road bridge, a levee, a pond of 850 m2 behind it, and houses."""
    rough, roll = waves(site.random, 0.05, 6.0), waves(site.random, 0.15, 60.0)
    middle = -35.0 + 6.0 * np.sin(-20.0 / 30.0)

    def to_river(x, y):
        return np.abs(y + 35.0 - 6.0 * np.sin(x / 30.0)) - 9.0

    def to_pond(x, y):
        return np.hypot(x - 45.0, (y - 45.0) * 1.2) - 18.0

    def terrain(x, y):
        plain = 42.0 + roll(x, y) + rough(x, y)
        levee = np.clip(2.5 - np.abs(to_river(x, y) - 16.0) / 2.5 + 0.6, 0.0, 2.5)
        z = plain + levee * (y > -35.0)
        z = np.minimum(z, 39.5 - 0.006 * x + 0.5 * np.clip(to_river(x, y), 0.0, None))
        road = 43.2 - np.clip(np.abs(x + 20.0) - 5.0, 0.0, None) / 1.5
        road = np.where(to_river(x, y) > 3.5, road, -np.inf)
        z = np.maximum(z, road - np.clip(np.abs(y - middle) - 20.0, 0.0, None) * 0.06)
        return np.minimum(z, 41.0 + 0.35 * np.clip(to_pond(x, y), 0.0, None))

    def water(x, y):
        return (to_river(x, y) < 0.0) | (to_pond(x, y) < 0.0)

    deck = Deck(-20.0, middle, np.pi / 2, 27.0, 8.0, lambda along, _: 43.2 + 0.0 * along)
    houses = [
        _house(terrain, x, y, 12.0, 9.0, turn, 5.0, GABLE)
        for x, y, turn in ((-50.0, 20.0, 0.1), (-30.0, 45.0, 0.4), (0, 22.0, 0), (-55.0, 55.0, 0))
    ]

    def clear(x, y):
        return water(x, y) | (np.hypot(x - 45.0, y - 45.0) < 22.0) | (y < -10.0)

    return Landscape(
        terrain, (Boxes(houses),), (deck,), trees=(single_trees(site, 40, 11.0, clear),),
        plants=(undergrowth(site, 0.8, 0.4, 0.1),), water=water,
    )  # fmt: skip


class Job(NamedTuple):
    """The data of a tutorial.

    Attributes
    ----------
    kind : Kind
        Its land.
    write : callable
        Writes the files of a scene into a folder.
    changes : mapping
        Settings that differ from those of the kind.
    """

    kind: Kind
    write: Callable[[Scene, Path], None]
    changes: Mapping[str, object] = MappingProxyType({})


def scene_of(name: str) -> Scene:
    """Return the scene of a tutorial, `name` as in `JOBS`."""
    job = JOBS[name]
    return job.kind.make(_SEED, **job.changes)


def write_job(name: str, folder: Path) -> None:
    """Write the data of a tutorial.

    Parameters
    ----------
    name : str
        As in `JOBS`.
    folder : Path
        Is made if it is missing.
    """
    folder.mkdir(parents=True, exist_ok=True)
    JOBS[name].write(scene_of(name), folder)


def _write_survey(scene: Scene, folder: Path) -> None:
    """Write two tiles of two strips each, and checkpoints."""
    las = _strips(scene)
    tiles = folder / "tiles"
    tiles.mkdir(exist_ok=True)
    is_west = np.asarray(las.x) < ORIGIN[0] + scene.settings.size / 2
    for tile, which in (("west", is_west), ("east", ~is_west)):
        part = laspy.LasData(las.header, las.points[which].copy())
        part.write(tiles / f"{tile}.laz")
    (folder / "checkpoints.csv").write_text(checkpoints_of(scene, 32, 8), encoding="utf-8")
    hall = (32.0, 138.0, 78.0, 166.0)
    _draw(folder / "corrections.geojson", [_rectangle(*hall)], [{"class": BUILDING}])


def _strips(scene: Scene) -> laspy.LasData:
    """Return the points of two flights over the same land, the second one a little too high."""
    half = replace(scene.settings, density=scene.settings.density / 2)
    landscape, random = JOBS["survey"].kind.landscape(_SEED, half)
    flights = [survey(landscape, half, random) for _ in range(2)]
    flights[1].z[:] += _SECOND_STRIP
    columns = Returns(*(np.concatenate(parts) for parts in zip(*flights)))
    points = Points(columns.x + scene.corner[0], columns.y + scene.corner[1], columns.z)
    both = replace(
        scene, points=points, classes=columns.classes, return_number=columns.number,
        number_of_returns=columns.count,
    )  # fmt: skip
    las = las_of(both)
    las.classification = np.zeros(len(points.x), dtype=np.uint8)
    las.point_source_id = np.repeat([1, 2], [len(flight.x) for flight in flights]).astype(np.uint16)
    return _within(las, scene.settings.size)


def _write_raw(scene: Scene, folder: Path) -> None:
    las = _within(las_of(scene), scene.settings.size)
    las.classification = np.zeros(len(las.points), dtype=np.uint8)
    las.write(folder / "tile.laz")


def _within(las: laspy.LasData, size: float) -> laspy.LasData:
    """Return the points in the square, as tiles are cut; crowns reach over its edge."""
    x, y = np.asarray(las.x) - ORIGIN[0], np.asarray(las.y) - ORIGIN[1]
    return laspy.LasData(las.header, las.points[_inside(x, y, 0.0, 0.0, size, size)].copy())


def _write_archaeology(scene: Scene, folder: Path) -> None:
    _write_raw(scene, folder)
    stacks = [_turned(x + 45.0, y + 45.0, 13.4, 3.8, 0.5) for x, y in ((-24, -22), (-16, -30))]
    _draw(folder / "corrections.geojson", stacks, [{"class": OTHER}] * 2)


def _write_forestry(scene: Scene, folder: Path) -> None:
    _write_raw(scene, folder)
    _draw(folder / "corrections.geojson", [_ellipse(30.0, 12.0, 6.2, 4.8)], [{"class": GROUND}])


def _write_flood(scene: Scene, folder: Path) -> None:
    """Write the points, and the river as one polygon, which also lies below the bridge."""
    _write_raw(scene, folder)
    x = np.linspace(0.0, 150.0, 51)
    middle = 40.0 + 6.0 * np.sin((x - 75.0) / 30.0)
    banks = [np.column_stack((x, middle + side)) for side in (-9.0, 9.0)]
    river = np.concatenate((banks[0], banks[1][::-1], banks[0][:1]))
    pond = _ellipse(120.0, 120.0, 18.0, 15.0)
    _draw(folder / "water.geojson", [river, pond], [{"name": "river"}, {"name": "pond"}])
    _draw(folder / "rivers.geojson", [np.column_stack((x, middle))], [{}], "LineString")


def _write_drone(scene: Scene, folder: Path) -> None:
    """Write a cloud as photogrammetry makes it: without CRS, returns and GPS times, in colours."""
    whole = _within(las_of(scene), scene.settings.size)
    header = laspy.LasHeader(point_format=2, version="1.2")
    header.scales, header.offsets = whole.header.scales, whole.header.offsets
    las = laspy.LasData(header)
    las.x, las.y, las.z = (np.asarray(axis) for axis in (whole.x, whole.y, whole.z))
    grey = np.asarray(whole.intensity).astype(np.uint16) * 40
    las.red, las.green, las.blue = grey, grey, grey
    las.write(folder / "cloud.laz")
    (folder / "checkpoints.csv").write_text(checkpoints_of(scene, 12, 0, True), encoding="utf-8")
    face = np.array([(0.2, 61.0), (0.2, 46.0), (8.0, 36.5), (11.5, 37.0), (6.0, 51.0), (0.2, 61.0)])
    drawn = [{"class": GROUND}, {"class": OTHER}]
    _draw(folder / "corrections.geojson", [face, _ellipse(47.0, 34.0, 5.0, 5.0)], drawn)


def _rectangle(west: float, south: float, east: float, north: float) -> np.ndarray:
    return np.array([(west, south), (east, south), (east, north), (west, north), (west, south)])


def _turned(x: float, y: float, length: float, width: float, angle: float) -> np.ndarray:
    """Return a rectangle round a place, metres from the west and the south of the square."""
    ring = _rectangle(-length / 2, -width / 2, length / 2, width / 2)
    cos, sin = np.cos(angle), np.sin(angle)
    return ring @ np.array([[cos, sin], [-sin, cos]]) + (x, y)


def _ellipse(x: float, y: float, along: float, across: float) -> np.ndarray:
    turn = np.linspace(0.0, 2 * np.pi, 25)
    return np.column_stack((x + along * np.cos(turn), y + across * np.sin(turn)))


def _draw(
    path: Path, shapes: Sequence[np.ndarray], attributes: Sequence[dict], form: str = "Polygon"
) -> None:
    """Write polygons or lines, as somebody drew them on the hillshade, in the CRS of the points."""
    places = [(shape + ORIGIN).round(2).tolist() for shape in shapes]
    features = [
        {
            "type": "Feature",
            "properties": values,
            "geometry": {"type": form, "coordinates": [place] if form == "Polygon" else place},
        }
        for place, values in zip(places, attributes)
    ]
    crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
    text = json.dumps({"type": "FeatureCollection", "crs": crs, "features": features}, indent=1)
    path.write_text(text + "\n", encoding="utf-8")


JOBS = {
    "survey": Job(survey_land, _write_survey),
    "archaeology": Job(archaeology_land, _write_archaeology),
    "forestry": Job(forestry_land, _write_forestry),
    "flood": Job(flood_land, _write_flood),
    "drone-site": Job(earthworks_images, _write_drone, {"size": 100.0, "density": 12.0}),
}
