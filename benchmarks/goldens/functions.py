"""The functions of the library that are run, by their names; `out` is the folder of a function."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Callable

import bare_earth.algorithms as bare

_RAW, _TRUTH, _TILES = Path("raw.laz"), Path("truth.laz"), Path("truth")
_DTM = Path("terrain/file/dtm.tif")
_WINDOW = (569970.0, 5931970.0, 570030.0, 5932030.0)


def _classify(out: Path) -> Any:
    request = bare.ClassifyRequest(
        parameters=bare.SlopeFilter(preset="hilly"),
        corrections=bare.read_corrections(Path("corrections.geojson")),
        constraints=bare.Constraints(breaklines=bare.read_lines(Path("breaklines.geojson"))),
        rasters=bare.RasterFiles(dtm=out / "dtm.tif"),
        area=bare.Area(_WINDOW, bare.read_boundary(Path("boundary.geojson"))),
    )
    return bare.classify(_RAW, out / "a.laz", request)


def _deliver(out: Path) -> Any:
    request = bare.DeliveryRequest(
        delivery="drone-site", parameters=bare.SlopeFilter(), terrain=bare.DeliveryTerrain(1.0)
    )
    return bare.deliver(_RAW, out / "all", request)


def _check(out: Path) -> Any:
    request = bare.CheckRequest(
        checkpoints=bare.read_checkpoints("checkpoints.csv"),
        outputs=bare.CheckOutputs(table=out / "points.csv"),
    )
    return bare.check([_TRUTH], request)


def _water_classes(out: Path) -> Any:
    water = bare.WaterPolygons(bare.read_boundary(Path("water.geojson")))
    request = bare.PointRequest(bare.ClassifyWater(water=water))
    return bare.water_classes(_TRUTH, out / "a.las", request)


FUNCTIONS: dict[str, Callable[[Path], Any]] = {
    "classify": _classify,
    "deliver": _deliver,
    "check": _check,
    "terrain": lambda out: bare.terrain(
        [_TILES], bare.TerrainRequest(rasters=bare.RasterFiles(dsm=out / "dsm.tif"))
    ),
    "heights": lambda out: bare.heights(_TRUTH, out / "a.las"),
    "key_points": lambda out: bare.key_points(_TILES, out / "tiles"),
    "above_ground": lambda out: bare.above_ground(_TRUTH, out / "a.las"),
    "water_classes": _water_classes,
    "assess": lambda out: bare.assess(Path("classify/slope/a.laz"), _TRUTH),
    "quality": lambda out: bare.quality([_TILES], bare.QualityRequest(page=out / "page.html")),
    "find_water": lambda out: bare.find_water(
        [_TRUTH], out / "water.geojson", bare.WaterRequest(water=bare.Water(min_area=200.0))
    ),
    "compare_settings": lambda out: bare.compare_settings(
        [_RAW], out / "page.html", _WINDOW, bare.TrialOptions(("slope:automatic",))
    ),
    "write_contours": lambda out: bare.write_contours(_DTM, out / "lines.geojson"),
    "write_relief": lambda out: bare.write_relief(_DTM, out / "sky.tif", "sky-view"),
    "read_boundary": lambda out: bare.read_boundary(Path("boundary.geojson")),
    "read_lines": lambda out: bare.read_lines(Path("breaklines.geojson")),
    "read_corrections": lambda out: bare.read_corrections(Path("corrections.geojson")),
    "read_checkpoints": lambda out: bare.read_checkpoints("checkpoints.csv"),
}
