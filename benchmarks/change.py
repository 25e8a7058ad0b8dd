"""Measures `change`: what it calls change on stable land, and what it finds of generated changes.

The real tiles are thinned by halves, pulse by pulse. Both halves are classified by themselves, so
all that differs is noise of points and of the filter. Generated changes move points of one half.
"""

from __future__ import annotations

import argparse
import json
import tempfile
from pathlib import Path
from typing import Callable, Iterator, NamedTuple, Sequence

import laspy
import numpy as np

import bare_earth
from bare_earth.algorithms.rasters.content import NO_CELLS
from bare_earth.algorithms.rasters.geotiff import read_raster
from bare_earth.algorithms.rasters.sampling import HeightRaster, HeightSampler
from bare_earth.algorithms.tools.change import ChangeSummary

from . import data, tables

# Two cities, a cliff, two open forests, four conifer and mountain forests, a rain forest, crops,
# and two clouds of images.
TILES = (
    "ahn3_urban", "ign_sparse_urban", "corse_cliff", "megaplot", "forest_topography", "conifer_1",
    "oregon_conifer", "mountain_forest", "rainforest_ridge", "tall_crops", "yard_photogrammetry",
    "hillside_images",
)  # fmt: skip
KINDS = ("heap", "pit", "bank", "trench", "landslide")
SIZES = (3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 13.0, 18.0)  # metres, half of the width
HEIGHTS = (0.2, 0.5, 1.0, 2.0, 5.0)  # metres
OBJECTS = ("roof", "trees", "crops", "lorry")
SHIFT, TILT = 0.15, 1e-4
_CUT = ("pit", "bank", "trench", *OBJECTS)
_STEEPEST = 0.4  # height of a heap or a landslide in relation to half of its width
_AREA = 8.0  # square metres over the limit from which a place should be found
_SHARE = 0.5  # of a change that must be over the limit
_ROOM = 3.0  # metres between changes
_PARTS = ("stable", "rasters", "canopy", "terrains", "changes", "objects")
_TITLES = {
    "stable": "Halves of points, nothing changed",
    "rasters": "Terrain models of these halves, without their expected errors",
}
_MOST = 8  # changes of a tile

Shape = Callable[[np.ndarray, np.ndarray], np.ndarray]


class Case(NamedTuple):
    """A change that was put in, and what was found of it."""

    tile: str
    kind: str
    size: float
    height: float
    is_over: bool  # whether it should be found
    found: bool
    truth: float  # cubic metres
    volume: float
    error: float  # 95 %
    called: tuple[str, ...]  # what the found places are


def shape(kind: str, r: float, h: float) -> Shape:
    """Return the change in metres at places from the middle of a change."""

    def of(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        q = np.minimum(np.hypot(x, y) / r, 1.0)
        if kind == "heap":
            return h / 2.0 * (1.0 + np.cos(np.pi * q))
        if kind == "pit":
            return -h * np.minimum(1.0, 3.0 * (1.0 - q))
        if kind == "bank":
            return -h * np.clip(1.0 - x / r, 0.0, 1.0) * ((x > 0.0) & (np.abs(y) < 1.5 * r))
        if kind == "trench":
            return -h * ((np.abs(x) < 1.0 + r / 10.0) & (np.abs(y) < 1.5 * r))
        inside = (np.abs(x) < r) & (np.abs(y) < 1.5 * r)
        return -h * np.sin(np.pi * y / (1.5 * r)) * np.cos(np.pi * x / (2.0 * r)) * inside

    return of


def halves(name: str, seed: int = 1) -> tuple[laspy.LasData, laspy.LasData]:
    """Return both halves of a tile, pulse by pulse where these are known."""
    las = laspy.read(next(data.FOLDER.glob(f"real/{name}.la?")))
    dimensions = set(las.point_format.dimension_names)
    times = np.asarray(las.gps_time) if "gps_time" in dimensions else np.zeros(len(las))
    pulses, number = np.unique(times, return_inverse=True)
    if len(pulses) < len(las) / 10:
        number = np.arange(len(las))
    first = (np.random.default_rng(seed).random(number.max() + 1) < 0.5)[number]
    return _part(las, first), _part(las, ~first)


def _part(las: laspy.LasData, chosen: np.ndarray) -> laspy.LasData:
    part = laspy.LasData(las.header, las.points[chosen].copy())
    part.classification[:] = 0
    return part


def run(old: laspy.LasData, new: laspy.LasData, folder: Path, **more: object) -> ChangeSummary:
    """Compare two clouds; rasters and places are in the folder."""
    old.write(folder / "old.las")
    new.write(folder / "new.las")
    return bare_earth.change(
        folder / "old.las", folder / "new.las", folder / "difference.tif",
        limit=folder / "limit.tif", places=folder / "places.geojson", **more,
    )  # fmt: skip


def terrains(halved: tuple[laspy.LasData, laspy.LasData], folder: Path) -> list[tuple[Path, Path]]:
    """Return the terrain models of both halves of a tile, and their expected errors."""
    files = []
    for number, half in enumerate(halved):
        half.write(folder / "half.las")
        made = {key: folder / f"{key}{number}.tif" for key in ("dtm", "expected_error")}
        bare_earth.classify(folder / "half.las", folder / "half.laz", **made)
        files.append((made["dtm"], made["expected_error"]))
    return files


def stable(name: str, folder: Path, of_points: bool = True) -> dict[str, object]:
    """Return what is called change between both halves of a tile, in percent: of their points, or
    of their terrain models without expected errors.
    """
    if of_points:
        found = run(*halves(name), folder)
    else:
        (old, _), (new, _) = terrains(halves(name), folder)
        found = bare_earth.change(
            old, new, folder / "difference.tif", limit=folder / "limit.tif",
            places=folder / "places.geojson",
        )  # fmt: skip
    area = found.cell_count * _cell(folder) ** 2
    places = _places(folder)
    share = 100.0 * sum(one["AREA"] for one in places) / area
    earth = sum(one["AREA"] for one in places if one["KIND"] == "earth")
    return {
        "tile": name, "share": share, "earth": 100.0 * earth / area, "places": found.place_count,
        "left out": found.left_out, "nmad": found.nmad, "limit": found.median_limit,
    }  # fmt: skip


def canopy(name: str, folder: Path) -> str:
    """Return a line about the canopy of both halves of a tile: the cells that flip, what is called
    lost and gained in percent of the canopy, and the growth.
    """
    grid: dict[str, Path] = {}
    for number, half in enumerate(halves(name)):
        half.write(folder / "half.las")
        bare_earth.classify(folder / "half.las", folder / "half.laz")
        bare_earth.terrain(folder / "half.laz", chm=folder / f"chm{number}.tif", **grid)
        grid = {"like": folder / "chm0.tif"}
    models = folder / "chm0.tif", folder / "chm1.tif", folder / "difference.tif"
    # Without a least width each cell that flips is a place.
    flips = bare_earth.canopy_change(*models, least_width=0.0)
    found = bare_earth.canopy_change(*models)
    shares = (flips.lost_area, found.lost_area, found.gained_area)
    told = " | ".join(f"{100.0 * area / max(found.area_before, 1.0):.2f}" for area in shares)
    after = 100.0 * found.area_after / max(found.area_before, 1.0) - 100.0
    growth = tables.NONE if found.growth is None else f"{found.growth:+.2f}"
    return f"| {name} | {told} | {after:+.2f} | {growth} |"


def _cell(folder: Path) -> float:
    return read_raster(folder / "limit.tif", window=NO_CELLS).cell_metres[0]


def _places(folder: Path) -> list[dict[str, object]]:
    told = json.loads((folder / "places.geojson").read_text(encoding="utf-8"))
    return [
        {**one["properties"], "rings": [np.array(ring) for ring in one["geometry"]["coordinates"]]}
        for one in told["features"]
    ]


class _Put(NamedTuple):
    """A change at a place of a tile."""

    kind: str
    size: float
    height: float
    x: float
    y: float
    angle: float

    def turned(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        dx, dy, c, s = x - self.x, y - self.y, np.cos(self.angle), np.sin(self.angle)
        return dx * c + dy * s, dy * c - dx * s

    def change(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        return shape(self.kind, self.size, self.height)(*self.turned(x, y))


def _drawn(las: laspy.LasData, random: np.random.Generator, kinds: tuple[str, ...]) -> list[_Put]:
    """Draw changes that lie apart, within the tile, on at most a third of it."""
    x, y = np.asarray(las.x), np.asarray(las.y)
    west, east, south, north = x.min(), x.max(), y.min(), y.max()
    room, put = (east - west) * (north - south) / 4.0, list[_Put]()
    for _ in range(300):
        size = float(random.choice(SIZES))
        reach, area = 1.9 * size + _ROOM, (3.0 * size) ** 2
        if area > room or 2.5 * reach > min(east - west, north - south):
            continue
        at = (
            random.uniform(west + reach, east - reach),
            random.uniform(south + reach, north - reach),
        )
        if any(np.hypot(at[0] - p.x, at[1] - p.y) < reach + 1.9 * p.size for p in put):
            continue
        kind = str(random.choice(kinds))
        # Loose earth is no steeper than 40 degrees; cuts can be.
        stands = [h for h in HEIGHTS if kind in _CUT or h <= _STEEPEST * size]
        height = float(random.choice(stands))
        put.append(_Put(kind, size, height, *at, random.uniform(0.0, 2.0 * np.pi)))
        room -= area
        if len(put) == _MOST:
            break
    return put


def generated(name: str, folder: Path, seed: int, is_moved: bool) -> Iterator[Case]:
    """Yield changes that were put into a half of a tile."""
    old, new = halves(name)
    put = _drawn(new, np.random.default_rng(seed), KINDS)
    x, y = np.asarray(new.x), np.asarray(new.y)
    change = sum((one.change(x, y) for one in put), np.zeros(len(x)))
    if is_moved:
        change = change + SHIFT + TILT * (x - x.mean())
    unit = _unit(new)
    new.z = np.asarray(new.z) + change / unit
    run(old, new, folder)
    yield from _cases(name, put, folder)


def in_terrains(name: str, folder: Path, seeds: Sequence[int]) -> Iterator[Case]:
    """Yield changes that were put into the terrain model of a half of a tile, so that the filter
    has no part in it; in every second run, shift and tilt too.
    """
    import rasterio

    halved = halves(name)
    (old, old_error), (new, new_error) = terrains(halved, folder)
    with rasterio.open(new) as raster:
        heights, profile = raster.read(1, masked=True), raster.profile
        column, row = np.meshgrid(np.arange(raster.width) + 0.5, np.arange(raster.height) + 0.5)
        x, y = raster.transform * (column, row)
    for number, seed in enumerate(seeds):
        put = _drawn(halved[1], np.random.default_rng(seed), KINDS)
        change = sum((one.change(x, y) for one in put), np.zeros(x.shape))
        change += (number % 2) * (SHIFT + TILT * (x - x.mean()))
        with rasterio.open(folder / "changed.tif", "w", **profile) as raster:
            raster.write(heights + change / _unit(halved[1]), 1)
        bare_earth.change(
            old, folder / "changed.tif", folder / "difference.tif", limit=folder / "limit.tif",
            places=folder / "places.geojson", old_error=old_error, new_error=new_error,
        )  # fmt: skip
        yield from _cases(name, put, folder)


def _cases(name: str, put: Sequence[_Put], folder: Path) -> Iterator[Case]:
    """Yield what was found of changes."""
    places = _places(folder)
    sampler = HeightSampler(HeightRaster.of(folder / "limit.tif"))
    for one in put:
        for sign in (1, -1) if one.kind == "landslide" else ((1,) if one.kind == "heap" else (-1,)):
            yield _case(name, one, sign, places, sampler)


def _unit(las: laspy.LasData) -> float:
    crs = las.header.parse_crs()
    return 1.0 if crs is None else crs.axis_info[-1].unit_conversion_factor


def _case(
    name: str, one: _Put, sign: int, places: list[dict[str, object]], sampler: HeightSampler
) -> Case:
    """Compare a change with the places of the same direction that meet it."""
    step, reach = 0.5, 1.9 * one.size
    side = np.arange(-reach, reach, step) + step / 2.0
    x, y = (axis.ravel() for axis in np.meshgrid(one.x + side, one.y + side))
    change = np.maximum(sign * one.change(x, y), 0.0)
    limit = sampler.heights(x, y)
    over, part = change > limit, change > 0.0
    met = [
        place for place in places if place["MEAN"] * sign > 0 and _meets(place, x[part], y[part])
    ]
    return Case(
        name, one.kind, one.size, one.height,
        bool(over.sum() * step**2 >= _AREA and over.sum() >= _SHARE * part.sum()),
        bool(met), float(sign * change.sum() * step**2), float(sum(p["VOLUME"] for p in met)),
        float(np.sqrt(sum(p["VOLUME_ERR"] ** 2 for p in met))),
        tuple(str(place["KIND"]) for place in met),
    )  # fmt: skip


def _meets(place: dict[str, object], x: np.ndarray, y: np.ndarray) -> bool:
    """Return whether a place holds any of some points."""
    from matplotlib.path import Path as Outline

    return bool(Outline(place["rings"][0]).contains_points(np.column_stack((x, y))).any())


def objects(name: str, folder: Path, seed: int) -> Iterator[Case]:
    """Yield things that are no earth and were put into a half of a tile."""
    old, new = halves(name)
    random = np.random.default_rng(seed)
    put = _drawn(new, random, OBJECTS)
    x, y, z = (np.array(axis, dtype=float) for axis in (new.x, new.y, new.z))
    for one in put:
        along, across = one.turned(x, y)
        z += _raised(one, along, across, z, random)
    new.z = z
    run(old, new, folder)
    places = _places(folder)
    for one in put:
        met = [place for place in places if _meets(place, *_inside(one))]
        called = tuple(str(place["KIND"]) for place in met)
        yield Case(name, one.kind, one.size, 0.0, True, bool(met), 0.0, 0.0, 0.0, called)


def _half(one: _Put) -> tuple[float, float]:
    """Return half of the length and of the width of a thing."""
    return (6.0, 1.25) if one.kind == "lorry" else (one.size, 0.7 * one.size)


def _inside(one: _Put) -> tuple[np.ndarray, np.ndarray]:
    length, width = _half(one)
    a, b = (axis.ravel() for axis in np.meshgrid(*(np.arange(-s, s, 0.5) for s in (length, width))))
    c, s = np.cos(one.angle), np.sin(one.angle)
    return one.x + a * c - b * s, one.y + a * s + b * c


def _raised(
    one: _Put, along: np.ndarray, across: np.ndarray, z: np.ndarray, random: np.random.Generator
) -> np.ndarray:
    """Return by how much points rise onto a roof, into trees or crops, or onto a lorry."""
    length, width = _half(one)
    inside = (np.abs(along) < length) & (np.abs(across) < width)
    raised = np.zeros(len(z))
    if not inside.any():
        return raised
    count = int(np.count_nonzero(inside))
    if one.kind in ("roof", "lorry"):
        # All points lie on it, whatever lay below.
        eaves = np.quantile(z[inside], 0.2) + (3.5 if one.kind == "lorry" else 4.0)
        slope = 0.0 if one.kind == "lorry" else 0.4
        raised[inside] = eaves + slope * (width - np.abs(across[inside])) - z[inside]
        return raised
    share, high = (0.8, 12.0) if one.kind == "trees" else (0.85, 0.8)
    low = 0.5 if one.kind == "trees" else 0.3
    raised[inside] = np.where(random.random(count) < share, random.uniform(low, high, count), 0.0)
    return raised


def report(seeds: int, tiles: tuple[str, ...], parts: set[str]) -> Iterator[str]:
    """Yield the lines of the tables."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for part in ("stable", "rasters"):
            if part not in parts:
                continue
            yield f"\n{_TITLES[part]}:\n"
            yield "| Tile | called change, % | earth, % | places | left out | NMAD, m | limit, m |"
            yield "|---|--:|--:|--:|--:|--:|--:|"
            for name in tiles:
                found = stable(name, folder, part == "stable")
                yield (
                    f"| {name} | {found['share']:.2f} | {found['earth']:.2f} | {found['places']} |"
                    f" {found['left out']} | {found['nmad']:.3f} | {found['limit']:.2f} |"
                )
        if "canopy" in parts:
            yield "\nCanopy of these halves, % of the canopy:\n"
            yield "| Tile | cells that flip | lost | gained | area | growth, m |"
            yield "|---|--:|--:|--:|--:|--:|"
            yield from (canopy(name, folder) for name in tiles)
        if "terrains" in parts:
            cases = list[Case]()
            for place, name in enumerate(tiles):
                some = [7000 + 100 * number + place for number in range(4 * seeds)]
                cases += in_terrains(name, folder, some)
            yield "\nIn terrain models:"
            yield from _of_changes(cases)
        cases, things = list[Case](), list[Case]()
        for number in range(seeds):
            for place, name in enumerate(tiles):
                if "changes" in parts:
                    is_moved = (number + place) % 2 == 1
                    cases += generated(name, folder, 100 * number + place, is_moved)
                if "objects" in parts:
                    things += objects(name, folder, 5000 + 100 * number + place)
        if cases:
            yield "\nIn points:"
            yield from _of_changes(cases)
        if things:
            yield from _of_things(things)


def _of_changes(cases: list[Case]) -> Iterator[str]:
    yield "\n| Change | over the limit | found, % | volume within its error, % | of all, found |"
    yield "|---|--:|--:|--:|--:|"
    for kind in (*KINDS, "all"):
        every = [case for case in cases if kind in (case.kind, "all")]
        over = [case for case in every if case.is_over]
        met = [case for case in over if case.found]
        within = [abs(case.volume - case.truth) <= case.error for case in met]
        yield (
            f"| {kind} | {len(over)} | {100 * len(met) / max(len(over), 1):.1f} |"
            f" {100 * np.mean(within) if within else 0.0:.1f} |"
            f" {sum(case.found for case in every)} of {len(every)} |"
        )
    for case in cases:
        if case.is_over and not case.found:
            yield f"missed: {case.tile}, {case.kind}, {case.size:g} m, {case.height:g} m"
        elif case.is_over and abs(case.volume - case.truth) > case.error:
            yield (
                f"volume: {case.tile}, {case.kind}, {case.size:g} m, {case.height:g} m:"
                f" {case.volume:.0f} ± {case.error:.0f}, true {case.truth:.0f}"
            )


def _of_things(things: list[Case]) -> Iterator[str]:
    yield "\n| Thing | cases | no change | called what it is not earth | called earth, % |"
    yield "|---|--:|--:|--:|--:|"
    for kind in (*OBJECTS, "all"):
        every = [case for case in things if kind in (case.kind, "all")]
        earth = sum("earth" in case.called for case in every)
        other = sum(bool(case.called) and "earth" not in case.called for case in every)
        none = len(every) - earth - other
        share = 100.0 * earth / max(len(every), 1)
        yield f"| {kind} | {len(every)} | {none} | {other} | {share:.1f} |"
    for case in things:
        if "earth" in case.called:
            yield f"earth: {case.tile}, {case.kind}, {case.size:g} m"


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__, prog="python -m benchmarks.change")
    parser.add_argument("--tiles", nargs="+", default=TILES)
    parser.add_argument("--seeds", type=int, default=1, help="runs of each tile with changes")
    parser.add_argument(
        "--parts", nargs="+", choices=_PARTS, default=_PARTS,
    )  # fmt: skip
    given = parser.parse_args()
    for line in report(given.seeds, tuple(given.tiles), set(given.parts)):
        print(line, flush=True)


if __name__ == "__main__":
    main()
