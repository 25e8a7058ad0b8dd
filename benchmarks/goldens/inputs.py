"""The small survey that all tools are run on, and what somebody drew and measured for it."""

from __future__ import annotations

import json
import struct
from datetime import date
from pathlib import Path

import laspy
import numpy as np

from benchmarks.scenes import Scene
from benchmarks.scenes.landscape import FLAT, GABLE, Box, Boxes, Deck, Landscape
from benchmarks.scenes.planting import undergrowth, wood
from benchmarks.scenes.relief import smooth, waves
from benchmarks.scenes.scene import Site, kind
from demo.scene import las_of

# On the border of two blocks, so that one file has a seam, too; four would take twice the time.
MIDDLE = (570_000.0, 5_932_500.0)
_SEED, _SIZE, _STRIP_TWO, _DAY = 5, 84.0, 0.02, date(2024, 5, 6)
# Metres from the middle: what is drawn by hand.
_POND, _POND_RADIUS = (24.0, -22.0), 14.0
_SHAPES = {
    "boundary": [("Polygon", [(-36, -38), (38, -30), (30, 37), (-30, 30)], {})],
    "corrections": [
        ("Polygon", [(-39, -6), (-30, -6), (-30, 4), (-39, 4)], {"class": 2}),
        ("Polygon", [(-16, 8), (-4, 8), (-4, 18), (-16, 18)], {"class": 6}),
    ],
    "breaklines": [("LineString", [(-40, -24.5, 103), (0, -24.5, 103.4), (6, -33, 103.2)], {})],
    "rivers": [("LineString", [(12, -30), (36, -12)], {})],
    "no-ground": [("Polygon", [(-20, -20), (-12, -20), (-12, -10), (-20, -10)], {})],
}


@kind(size=_SIZE, density=0.9, low_outliers=6e-4)
def golden_land(site: Site) -> Landscape:
    """A slope with a bank, a pond, a hall, a house, a bridge over a ditch, a wood, and birds."""
    roll, rough = waves(site.random, 0.6, 70.0), waves(site.random, 0.04, 6.0)

    def to_pond(x, y):
        return np.hypot(x - _POND[0], y - _POND[1]) - _POND_RADIUS

    def terrain(x, y):
        z = 102.5 + 0.04 * x + roll(x, y) + rough(x, y) + 5.0 * smooth((y - 18.0) / 6.0)
        z = z - 3.0 * np.clip(1.5 - np.abs(x + 22.0) / 4.0, 0.0, 1.0) * (y < 8.0)
        return np.minimum(z, 100.0 + 0.4 * np.clip(to_pond(x, y), 0.0, None))

    def foot(x, y):
        return float(terrain(np.array([x]), np.array([y]))[0])

    hall = Box(8.0, 6.0, 24.0, 14.0, 0.1, foot(8.0, 6.0), 6.0, FLAT)
    house = Box(-10.0, 12.0, 11.0, 8.0, 0.4, foot(-10.0, 12.0), 4.0, GABLE)
    deck = Deck(-22.0, -18.0, 0.0, 18.0, 7.0, lambda along, _: 102.3 + 0.0 * along)
    trees = wood(site, 6.0, 13.0, where=lambda x, y: (x > 8.0) & (y > 22.0))
    birds = site.random.uniform(-38.0, 38.0, (2, 3))
    return Landscape(
        terrain, (Boxes([hall, house]),), (deck,), trees=(trees,),
        plants=(undergrowth(site, 0.9, 0.4, 0.15),), water=lambda x, y: to_pond(x, y) < 0.0,
        stray=tuple(zip(*birds, site.random.uniform(160.0, 190.0, 3))),
    )  # fmt: skip


def write_inputs(folder: Path) -> None:
    """Write all inputs: raw points and those with true classes, in one file and in four."""
    scene = golden_land.make(_SEED)
    truth = _las(scene)
    raw = laspy.LasData(truth.header, truth.points.copy())
    # Classes with a meaning stay, so some are there from the start.
    raw.classification = np.where(np.arange(len(raw.points)) % 97 == 0, 12, 1).astype(np.uint8)
    for name, las in (("raw", raw), ("truth", truth)):
        _write(las, folder / f"{name}.laz")
        _write_cut(folder / name, las)
    _write_old(folder / "old.las", truth)
    _write_drawn(folder)
    _write_checkpoints(folder / "checkpoints.csv", scene)


def _las(scene: Scene) -> laspy.LasData:
    """Return the points with their true classes, and something in each field that a file has."""
    las = las_of(scene)
    header = las.header
    header.offsets = np.array([*(middle - _SIZE / 2 for middle in MIDDLE), 0.0])
    header.creation_date = _DAY
    header.vlrs.append(laspy.VLR("golden", 7, "must stay", b"any bytes \x00\xff"))
    random = np.random.default_rng(_SEED)
    las = laspy.LasData(header, las.points)
    number = np.arange(len(las.points))
    las.point_source_id = np.where(number % 2 == 0, 1, 2).astype(np.uint16)
    las.Z = np.asarray(las.Z) + (number % 2) * round(1000 * _STRIP_TWO)
    las.scan_angle = random.integers(-3000, 3000, len(number)).astype(np.int16)
    las.user_data = random.integers(0, 255, len(number)).astype(np.uint8)
    las.withheld = number % 211 == 5
    las.overlap = (number % 2 == 1) & (np.asarray(las.X) > 70_000)
    las.add_extra_dim(laspy.ExtraBytesParams("reflectance", "f4", "made by hand"))
    las.reflectance = np.linspace(-20.0, 0.0, len(number)).astype(np.float32)
    return las


def _write_cut(folder: Path, las: laspy.LasData) -> None:
    """Write the points into four files whose borders are no borders of blocks."""
    folder.mkdir()
    east, north = np.asarray(las.X) > 35_000, np.asarray(las.Y) > 52_000
    for name, which in (
        ("sw", ~east & ~north), ("se", east & ~north), ("nw", ~east & north), ("ne", east & north),
    ):  # fmt: skip
        _write(laspy.LasData(las.header, las.points[which].copy()), folder / f"{name}.laz")


def _write_old(path: Path, truth: laspy.LasData) -> None:
    """Write classified points as old programs do: LAS 1.2, without CRS, key points in class 8."""
    header = laspy.LasHeader(point_format=1, version="1.2")
    header.scales, header.offsets = truth.header.scales, truth.header.offsets
    header.creation_date = truth.header.creation_date
    header.generating_software = truth.header.generating_software
    las = laspy.LasData(header)
    las.X, las.Y, las.Z = truth.X, truth.Y, truth.Z
    las.classification = np.minimum(truth.classification, 12).astype(np.uint8)
    las.return_number = np.minimum(truth.return_number, 7)
    las.number_of_returns = np.minimum(truth.number_of_returns, 7)
    las.gps_time, las.intensity = truth.gps_time, truth.intensity
    _write(las, path)


def _write(las: laspy.LasData, path: Path) -> None:
    """Write a file with the date of its header, in place of which old versions of laspy put that
    of today.
    """
    las.write(path)
    with path.open("r+b") as file:
        file.seek(90)
        file.write(struct.pack("<HH", _DAY.timetuple().tm_yday, _DAY.year))


def _write_drawn(folder: Path) -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 25)[:-1]
    shore = _POND + (_POND_RADIUS + 0.5) * np.column_stack((np.cos(turn), np.sin(turn)))
    shapes = {**_SHAPES, "water": [("Polygon", shore.round(2).tolist(), {"name": "pond"})]}
    for name, drawn in shapes.items():
        features = []
        for shape, places, attributes in drawn:
            path = [[x + MIDDLE[0], y + MIDDLE[1], *z] for x, y, *z in places]
            coordinates = [[*path, path[0]]] if shape == "Polygon" else path
            geometry = {"type": shape, "coordinates": coordinates}
            features.append({"type": "Feature", "properties": attributes, "geometry": geometry})
        crs = {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}}
        content = {"type": "FeatureCollection", "crs": crs, "features": features}
        (folder / f"{name}.geojson").write_text(json.dumps(content), encoding="utf-8")


def _write_checkpoints(path: Path, scene: Scene) -> None:
    random = np.random.default_rng(_SEED)
    x, y = random.uniform(-0.46, 0.46, (2, 30)) * scene.settings.size
    z = scene.bare_earth(x, y) + random.normal(0.0, 0.02, len(x))
    rows = [
        f"P{number},{MIDDLE[0] + x[number]:.3f},{MIDDLE[1] + y[number]:.3f},{z[number]:.3f},"
        f"{'forest' if x[number] > 8 and y[number] > 22 else 'open'}"
        for number in range(len(x))
    ]
    path.write_text("\n".join(["Name,East,North,Height,Land cover", *rows]), encoding="utf-8")
