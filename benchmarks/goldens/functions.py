"""The functions of the library that are run, by their names; `out` is the folder of a function."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Callable

import bare_earth as bare

_RAW, _TRUTH, _TILES = Path("raw.laz"), Path("truth.laz"), Path("truth")
_DTM = Path("terrain/file/dtm.tif")
_WINDOW = (569970.0, 5932470.0, 570030.0, 5932530.0)

FUNCTIONS: dict[str, Callable[[Path], Any]] = {
    "classify": lambda out: bare.classify(
        _RAW, out / "a.laz", method="slope", preset="hilly", dtm=out / "dtm.tif",
        corrections="corrections.geojson", breaklines="breaklines.geojson", extent=_WINDOW,
        boundary="boundary.geojson",
    ),
    "deliver": lambda out: bare.deliver(
        _RAW, out / "all", delivery="drone-site", method="slope", dtm_cell_size=1.0
    ),
    "check": lambda out: bare.check(
        _TRUTH, checkpoints="checkpoints.csv", table=out / "points.csv"
    ),
    "terrain": lambda out: bare.terrain(_TILES, dsm=out / "dsm.tif"),
    "heights": lambda out: bare.heights(_TRUTH, out / "a.las"),
    "key_points": lambda out: bare.key_points(_TILES, out / "tiles"),
    "above_ground": lambda out: bare.above_ground(_TRUTH, out / "a.las"),
    "water_classes": lambda out: bare.water_classes(
        _TRUTH, out / "a.las", water="water.geojson"
    ),
    "clip": lambda out: bare.clip(_TRUTH, out / "a.las", extent=_WINDOW),
    "assess": lambda out: bare.assess("classify/slope/a.laz", _TRUTH),
    "quality": lambda out: bare.quality(_TILES, page=out / "page.html"),
    "water": lambda out: bare.water(_TRUTH, out / "water.geojson", min_area=200.0),
    "compare_settings": lambda out: bare.compare_settings(
        _RAW, out / "page.html", extent=_WINDOW, settings=["slope:automatic"]
    ),
    "review": lambda out: bare.review(
        "terrain/file/error.tif", out / "places.geojson", least_area=1.0
    ),
    "contours": lambda out: bare.contours(_DTM, out / "lines.geojson"),
    "canopy": lambda out: bare.canopy("terrain/file/dsm.tif", _DTM, out / "chm.tif"),
    "canopy_change": lambda out: bare.canopy_change(
        "terrain/file/chm.tif", "canopy/chm.tif", out / "change.tif", least_width=1.0
    ),
    "change": lambda out: bare.change(
        "terrain/file/dsm.tif", _DTM, out / "change.tif", places=out / "places.geojson"
    ),
    "relief": lambda out: bare.relief(_DTM, out / "sky.tif", kind="sky-view"),
    "remove_off_terrain_objects": lambda out: bare.remove_off_terrain_objects(
        "terrain/file/dsm.tif", out / "dtm.tif"
    ),
    "fetch": lambda out: bare.fetch(
        "classify/key-points/a.copc.laz", out / "a.laz", extent=_WINDOW, resolution=5.0
    ),
    "info": lambda out: bare.info("truth.laz"),
}  # fmt: skip
