"""The algorithms of QGIS, run by Processing, and what their dialogs show.

    tools/environment qgis /usr/bin/python3 -m benchmarks.goldens.dialogs FOLDER FILE

This writes the digests into a file. `python -m benchmarks.goldens` does it where there is QGIS.
"""

from __future__ import annotations

import json
import os
import re
import sys
from pathlib import Path
from typing import Any

from .digests import Digests, of_fixed_text, of_text
from .inputs import write_inputs
from .running import of_folder, working_in

_RASTERS = ("DTM", "DSM", "CHM", "HILLSHADE", "EXPECTED_ERROR")
_CLASSES = {"LOW_NOISE_CLASS": True, "HIGH_NOISE_CLASS": True, "BRIDGE_CLASS": 17}
_KNOWN = {
    "BREAKLINES": "breaklines.geojson", "WATER": "water.geojson", "RIVERS": "rivers.geojson",
    "NO_GROUND": "no-ground.geojson",
}  # fmt: skip

# Versions of QGIS that can show COPC get it in a delivery: these outputs depend on that.
_OF_VERSIONS = re.compile(r"delivery/(log|all/points/.*|all/\w+\.html|all/delivery\.json)")
_KINDS = {"pointCloudDestination": "fileDestination", "outputPointCloud": "outputFile"}
# Values that end so are paths. What begins with OUT is in the folder of the run.
_PATHS = (".laz", ".las", ".tif", ".geojson", ".gpkg", ".csv", ".html", ".vpc", "truth", "raw")
# The algorithm of each run, and its parameters.
RUNS: dict[str, tuple[str, dict[str, Any]]] = {
    "tin": ("tindensification", {
        "INPUT": "raw.laz", **_CLASSES, "HEIGHT_ABOVE_GROUND": True, "ABOVE_GROUND": "asprs",
        "OUTPUT": "OUT/a.laz", "DTM": "OUT/dtm.tif",
    }),
    "slope": ("slopefilter", {
        "INPUT": "raw.laz", "EXTENT": "569970,570020,5932470,5932530 [EPSG:25832]",
        "CORRECTIONS": "corrections.geojson", "CORRECTIONS_FIELD": "class", **_KNOWN,
        "OUTPUT": "OUT/a.laz", "DTM": "OUT/dtm.tif", "HILLSHADE": "OUT/shade.tif",
        "EXPECTED_ERROR": "OUT/error.tif",
    }),
    "grid-minimum": ("gridminimum", {
        "INPUT": "raw.laz", "BOUNDARY": "boundary.geojson", "AREA_ONLY": True,
        "OUTPUT": "OUT/a.copc.laz",
    }),
    "fetch": ("fetch", {
        "ADDRESS": "grid-minimum/a.copc.laz", "EXTENT": "569970,570020,5932470,5932530",
        "OUTPUT": "OUT/part.laz",
    }),
    "tiles": ("classifytiles", {
        "INPUT_FOLDER": "raw", **_CLASSES, "METHOD": "slope", "FORMAT": "las",
        "HEIGHT_ABOVE_GROUND": True, "ABOVE_GROUND": "ign", "OUTPUT_FOLDER": "OUT/tiles",
        "OUTPUT_VPC": "OUT/all.vpc", "DTM": "OUT/dtm.tif",
    }),
    "terrain-in-one-step": ("pointcloudtoterrain", {
        "INPUT": "raw.laz", "CONTOUR_INTERVAL": 0.5, "OUTPUT": "OUT/a.laz", "DTM": "OUT/dtm.tif",
        "CHM": "OUT/chm.tif", "RELIEF": "OUT/relief.tif", "CONTOURS": "OUT/lines.gpkg",
    }),
    "delivery": ("pointcloudtoterrain", {
        "INPUT_FOLDER": "raw", "DELIVERY": "flood", "MIN_AREA": 200, "DTM_CELL_SIZE": 1,
        "CHECKPOINTS": "checkpoints.csv", "DELIVERY_FOLDER": "OUT/all",
    }),
    "terrain": ("terrainmodel", {
        "INPUT": "truth.laz", **_KNOWN, **{name: f"OUT/{name.lower()}.tif" for name in _RASTERS},
    }),
    "relief": ("relief", {
        "INPUT": "terrain/dtm.tif", "KINDS": ["hillshade", "vat", "sky-view", "local-relief"],
        "OUTPUT_FOLDER": "OUT/all",
    }),
    "review": ("review", {
        "INPUT": "terrain/expected_error.tif", "DTM": "terrain/dtm.tif",
        "OUTPUT": "OUT/places.gpkg",
        "REPORT": "OUT/page.html",
    }),
    "contours": ("contours", {
        "INPUT": "terrain/dtm.tif", "CONTOUR_INTERVAL": 0.5, "OUTPUT": "OUT/lines.gpkg",
    }),
    "canopy": ("canopyheight", {
        "SURFACE": "terrain/dsm.tif", "TERRAIN": "terrain/dtm.tif", "OUTPUT": "OUT/chm.tif",
    }),
    "canopy-change": ("canopychange", {
        "OLD": "terrain/chm.tif", "NEW": "canopy/chm.tif", "LEAST_WIDTH": 1.0,
        "OUTPUT": "OUT/change.tif",
    }),
    "change": ("change", {
        "OLD": "terrain/dsm.tif", "NEW": "terrain/dtm.tif", "OUTPUT": "OUT/change.tif",
        "LIMIT": "OUT/limit.tif", "PLACES": "OUT/places.gpkg", "REPORT": "OUT/page.html",
    }),
    "off-terrain": ("removeoffterrainobjects", {"INPUT": "terrain/dsm.tif", "OUTPUT": "OUT/a.tif"}),
    "above-ground": ("classifyaboveground", {
        "INPUT": "truth.laz", "ABOVE_GROUND": "ign", "RECLASSIFY": True, "OUTPUT": "OUT/a.laz",
    }),
    "heights": ("heightaboveground", {"INPUT": "truth.laz", "OUTPUT": "OUT/a.laz"}),
    "clip": ("clip", {
        "INPUT": "truth.laz", "EXTENT": "569970,570020,5932470,5932530 [EPSG:25832]",
        "OUTPUT": "OUT/a.laz",
    }),
    "key-points": ("modelkeypoints", {"INPUT": "truth.laz", "OUTPUT": "OUT/a.laz"}),
    "water": ("water", {
        "INPUT": "truth.laz", "MIN_AREA": 200, "OUTPUT": "OUT/water.gpkg",
        "BREAKLINES": "OUT/lines.gpkg",
    }),
    "water-classes": ("waterclasses", {
        "INPUT": "truth.laz", "WATER": "water.geojson", "OUTPUT": "OUT/a.laz",
    }),
    "check": ("check", {
        "INPUT": "truth.laz", "CHECKPOINTS": "checkpoints.csv", "DTM": "terrain/dtm.tif",
        "HOLD_OUT": 0.1, "LOW_CONFIDENCE": "water.geojson", "OUTPUT": "OUT/points.gpkg",
        "REPORT": "OUT/page.html",
    }),
    "quality": ("quality", {
        "INPUT": "truth.laz", "SPECIFICATION": "lbs-ql2", "PAGE": "OUT/page.html",
        "FOLDER": "OUT/all", "LOW_CONFIDENCE_AREA": 100, "LOW_CONFIDENCE": "OUT/areas.gpkg",
    }),
    "assess": ("assess", {
        "CLASSIFIED": "tin/a.laz", "REFERENCE": "truth.laz", "REPORT": "OUT/page.html",
        "ERROR_MAP": "OUT/map.tif",
    }),
    "compare-settings": ("comparesettings", {
        "INPUT": "raw.laz", "SETTINGS": ["tin-densification:automatic", "slope:town"],
        "OUTPUT": "OUT/page.html",
    }),
    "contours-model": ("terraincontours", {
        "INPUT": "raw.laz", "INTERVAL": 0.5, "contours:OUTPUT": "OUT/lines.gpkg",
        "ground:DTM": "OUT/dtm.tif",
    }),
    "heights-model": ("cloudheights", {"INPUT": "raw.laz", "canopy:CHM": "OUT/chm.tif"}),
    "methods-model": ("twomethods", {"INPUT": "raw.laz", "differences:ERROR_MAP": "OUT/map.tif"}),
}  # fmt: skip


def of_dialogs(folder: Path) -> Digests:
    """Return the digests of all runs in an empty folder, and of all dialogs."""
    from qgis.core import QgsApplication

    write_inputs(folder)
    algorithms = QgsApplication.processingRegistry().providerById("bareearth").algorithms()
    found = {f"dialogs/{one.name()}": of_fixed_text(_dialog(one), folder) for one in algorithms}
    with working_in(folder):
        for name in RUNS:
            found.update(_of_run(name, folder))
    return found


def _of_run(name: str, folder: Path) -> Digests:
    import processing
    from qgis.core import QgsProcessingFeedback

    algorithm, given = RUNS[name]
    (folder / name).mkdir()
    parameters = {key: placed(value, folder, name) for key, value in given.items()}
    feedback = QgsProcessingFeedback(False)
    results = processing.run(f"bareearth:{algorithm}", parameters, feedback=feedback)
    texts = {}
    if not name.endswith("-model"):  # those name steps and temporary files, as QGIS words it
        texts["results"] = json.dumps({key: str(value) for key, value in results.items()})
        # Threads tell of their files in any order, and versions of QGIS of what they cannot show.
        lines = sorted(feedback.textLog().splitlines())
        texts["log"] = "\n".join(line for line in lines if "This QGIS" not in line)
    found = {f"{name}/{key}": of_text(text, folder) for key, text in texts.items()}
    found.update(of_folder(folder, name))
    return {key: value for key, value in found.items() if not _OF_VERSIONS.fullmatch(key)}


def placed(value: Any, folder: Path, name: str) -> Any:
    """Return the value of a parameter, with the folders of the inputs and of a run."""
    if not isinstance(value, str):
        return value
    if value.startswith("OUT/"):
        return str(folder / name / value[4:])
    return str(folder / value) if value.endswith(_PATHS) else value


def _dialog(algorithm: Any) -> str:
    """Return what a dialog shows: names, kinds, defaults and help of parameters and outputs."""
    parameters = [
        [
            defined.name(), _kind(defined), defined.description(), defined.help(),
            repr(defined.defaultValue()), bool(defined.flags() & defined.FlagOptional),
            bool(defined.flags() & defined.FlagAdvanced), defined.isDestination(),
        ]
        for defined in algorithm.parameterDefinitions()
    ]  # fmt: skip
    outputs = [
        [output.name(), _kind(output), output.description()]
        for output in algorithm.outputDefinitions()
    ]
    about = [algorithm.displayName(), algorithm.group(), algorithm.shortHelpString()]
    return "\n".join(map(repr, [*about, algorithm.tags(), *parameters, *outputs]))


def _kind(declared: Any) -> str:
    """Return the kind of a parameter or an output, as QGIS 3.22 has it."""
    return _KINDS.get(declared.type(), declared.type())


def main(folder: str, target: str) -> None:
    """Write the digests of all dialogs into a file."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from qgis.core import QgsApplication

    application = QgsApplication([], True, folder)
    application.initQgis()
    sys.path.append(str(Path(application.pkgDataPath()) / "python" / "plugins"))
    from processing.core.Processing import Processing

    from bare_earth import classFactory

    Processing.initialize()
    plugin = classFactory(None)
    plugin.initProcessing()
    work = Path(folder).resolve() / "work"
    work.mkdir()
    Path(target).write_text(json.dumps(of_dialogs(work)), encoding="utf-8")
    plugin.unload()


if __name__ == "__main__":
    main(*sys.argv[1:])
