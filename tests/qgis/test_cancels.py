"""Runs that the user cancels, at any moment, and contour lines that cannot be drawn.

`BARE_EARTH_CANCELS=6` cancels that many runs of each algorithm: a third at any progress, a third
from another thread, and a third near the end.
"""

import errno
import os
import random
import threading
import time
from pathlib import Path

import laspy
import numpy as np
import pytest
from osgeo import gdal, ogr
from qgis.core import QgsCoordinateReferenceSystem, QgsRectangle, QgsReferencedRectangle
from support import Log, write_scene

POINTS = 25_600  # of a scene
CANCELS = int(os.environ.get("BARE_EARTH_CANCELS", "1"))
WINDOW = QgsReferencedRectangle(
    QgsRectangle(500_010, 5_700_010, 500_070, 5_700_070),
    QgsCoordinateReferenceSystem.fromEpsgId(25832),
)
RASTERS = {name: f"OUT/{name.lower()}.tif" for name in ("DTM", "DSM", "CHM", "HILLSHADE")}
CLASSIFY = {"INPUT": "IN/raw.laz", "OUTPUT": "OUT/out.laz", "DTM": "OUT/dtm.tif"}
# What each algorithm is given; IN and OUT are folders.
GIVEN = {
    "tindensification": CLASSIFY,
    "slopefilter": {**CLASSIFY, "OUTPUT": "OUT/out.copc.laz"},
    "gridminimum": CLASSIFY,
    "pointcloudtoterrain": {
        "INPUT": "IN/raw.laz", "OUTPUT": "OUT/out.laz", **RASTERS, "RELIEF": "OUT/relief.tif",
        "CONTOURS": "OUT/lines.gpkg",
    },
    "pointcloudtoterrain of many": {
        "INPUT_FOLDER": "IN/tiles", "OUTPUT": "OUT/out.laz", **RASTERS, "RELIEF": "OUT/relief.tif",
        "CONTOURS": "OUT/lines.gpkg",
    },
    "classifytiles": {"INPUT_FOLDER": "IN/tiles", "OUTPUT_FOLDER": "OUT/out", "DTM": "OUT/dtm.tif"},
    "heightaboveground": {"INPUT": "IN/ground.laz", "OUTPUT": "OUT/out.laz"},
    "classifyaboveground": {"INPUT": "IN/ground.laz", "OUTPUT": "OUT/out.laz"},
    "waterclasses": {"INPUT": "IN/ground.laz", "OUTPUT": "OUT/out.laz"},
    "modelkeypoints": {"INPUT": "IN/ground.laz", "OUTPUT": "OUT/out.laz"},
    "terrainmodel": {"INPUT": "IN/ground.laz", **RASTERS},
    "comparesettings": {
        "INPUT": "IN/raw.laz", "EXTENT": WINDOW, "OUTPUT": "OUT/page.html",
        "SETTINGS": ["slope:town", "tin-densification:automatic"],
    },
    "assess": {
        "CLASSIFIED": "IN/ground.laz", "REFERENCE": "IN/ground.laz", "REPORT": "OUT/page.html",
        "ERROR_MAP": "OUT/map.tif",
    },
    "removeoffterrainobjects": {"INPUT": "IN/surface.tif", "OUTPUT": "OUT/dtm.tif"},
    "clip": {"INPUT": "IN/ground.laz", "EXTENT": WINDOW, "OUTPUT": "OUT/out.laz"},
    "contours": {"INPUT": "IN/surface.tif", "OUTPUT": "OUT/lines.gpkg"},
    "canopyheight": {
        "SURFACE": "IN/surface.tif", "TERRAIN": "IN/surface.tif", "OUTPUT": "OUT/chm.tif",
    },
}  # fmt: skip
# Of these what is finished stays.
SURVEYS = ("pointcloudtoterrain of many", "classifytiles")


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    folder = tmp_path_factory.mktemp("in")
    ground = write_scene(folder / "raw.laz")
    las = laspy.read(folder / "raw.laz")
    las.classification[:] = np.where(ground, 2, 6)
    las.write(str(folder / "ground.laz"))
    (folder / "tiles").mkdir()
    for number in range(3):
        write_scene(folder / "tiles" / f"{number}.laz", origin=(5e5 + 80 * number, 5_700_000.0))
    heights = np.full((60, 60), 300.0, np.float32)
    heights[20:40, 30:50] = 320.0
    raster = gdal.GetDriverByName("GTiff").Create(
        str(folder / "surface.tif"), 60, 60, 1, gdal.GDT_Float32
    )
    raster.SetGeoTransform((500_000.0, 1.0, 0.0, 5_700_000.0, 0.0, -1.0))
    raster.GetRasterBand(1).WriteArray(heights)
    raster.FlushCache()
    return folder


def filled_in(name, inputs, out):
    """Return the parameters, and the files of a run before, which are written."""
    given, old = {"THREADS": 2}, {}
    for key, value in GIVEN[name].items():
        if isinstance(value, str):
            value = value.replace("IN/", f"{inputs}/").replace("OUT/", f"{out}/")
            becomes_folder = key == "OUTPUT" and name in SURVEYS
            if value.startswith(str(out)) and Path(value).suffix and not becomes_folder:
                Path(value).write_bytes(b"old")
                old[value] = b"old"
        given[key] = value
    return given, old


@pytest.mark.parametrize("name", GIVEN)
def test_a_cancel_leaves_old_files_and_nothing_else(name, registry, inputs, tmp_path, context):
    out, chance = tmp_path / "out", random.Random(name)
    out.mkdir()

    def run(log):
        given, old = filled_in(name, inputs, out)
        algorithm = registry.createAlgorithmById(f"bareearth:{name.split()[0]}")
        return algorithm.run(given, context, log)[0], old

    whole, begun = Log(), time.monotonic()
    assert run(whole)[0] and ".~" not in whole.text
    duration = time.monotonic() - begun
    moments = sorted({when for when in whole.moments if when < 100})
    cancelled = 0
    for number in range(CANCELS):
        by_time = number % 3 == 1
        # The first is early enough for a word on the progress to follow.
        early = moments[: len(moments) // 2 + 1]
        among = moments[-3:] if number % 3 == 2 else moments if number else early
        moment = chance.choice(among)
        log = Log(cancel_at=None if by_time else moment)
        before = set(context.layersToLoadOnCompletion())
        timer = threading.Timer(chance.uniform(0.0, duration), log.cancel)
        if by_time:
            timer.start()
        results, old = run(log)
        timer.cancel()
        left = [path for path in out.rglob("*") if path.name.startswith(".")]
        assert not [path for path in left if path.name != ".bare-earth"], log.text
        now = {path: Path(path).read_bytes() for path in old}
        if results:  # the end came first
            assert all(value != b"old" for value in now.values())
            assert ".~" not in log.text
            continue
        cancelled += 1
        assert "Cancelled" in log.text
        assert set(context.layersToLoadOnCompletion()) == before
        if "nothing was written" in log.text:
            assert now == old, log.text
        if name not in SURVEYS:
            assert sorted(map(str, out.iterdir())) == sorted(old)
        for path in out.rglob("*.laz"):
            assert path.read_bytes() == b"old" or len(laspy.read(path)) == POINTS
    print(f"{name}: {cancelled} of {CANCELS} runs were cancelled before their end")
    assert cancelled


@pytest.mark.parametrize("suffix", [".gpkg", ".shp", ".geojson", ".fgb"])
def test_contours_replace_old_ones_or_leave_them(suffix, inputs, tmp_path, monkeypatch):
    import bare_earth
    from bare_earth import BareEarthError, Cancelled, Progress

    class CancelAtTheEnd(Progress):
        def report(self, fraction):
            raise Cancelled

    lines, surface = tmp_path / f"lines{suffix}", inputs / "surface.tif"
    bare_earth.contours(surface, lines, contour_interval=5.0)
    names = set(os.listdir(tmp_path))
    before = {name: (tmp_path / name).read_bytes() for name in names}
    with pytest.raises(Cancelled):
        bare_earth.contours(surface, lines, progress=CancelAtTheEnd())

    def refuse(source, target):
        raise OSError(errno.EBUSY, "busy")

    with monkeypatch.context() as patch:
        patch.setattr(os, "replace", refuse)
        with pytest.raises(BareEarthError, match="another program"):
            bare_earth.contours(surface, lines)
    assert {name: (tmp_path / name).read_bytes() for name in os.listdir(tmp_path)} == before
    index = tmp_path / "lines.qix"
    index.write_bytes(b"of the old lines")
    bare_earth.contours(surface, lines, contour_interval=2.0)
    made = ogr.Open(str(lines))  # which must live as long as its layer
    assert {layer.GetField("ELEV") for layer in made[0]} >= {302.0, 304.0}
    del made
    assert set(os.listdir(tmp_path)) == names | ({index.name} if suffix != ".shp" else set())
