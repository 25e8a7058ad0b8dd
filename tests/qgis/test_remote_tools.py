"""Remote point clouds as the inputs of all tools: what is told, refused, downloaded and kept."""

import json
from pathlib import Path

import laspy
import numpy as np
import pytest
from ept_sets import MERCATOR, add_ept
from osgeo import gdal
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsPointCloudLayer,
    QgsProcessingContext,
    QgsProcessingException,
    QgsProcessingModelAlgorithm,
    QgsProcessingModelChildAlgorithm,
    QgsProcessingModelChildParameterSource,
    QgsProcessingModelOutput,
    QgsProcessingModelParameter,
    QgsProcessingOutputLayerDefinition,
    QgsProcessingParameterExtent,
    QgsProcessingParameterString,
    QgsProject,
    QgsProviderRegistry,
    QgsRectangle,
)
from remote_server import serving
from support import ALGORITHM, Log, write_scene

from bare_earth.algorithms.las import copc_octree
from bare_earth.plugin.plugin import BareEarthPlugin

ONE_STEP = "bareearth:pointcloudtoterrain"
EXTENT = "500010,500050,5700010,5700060 [EPSG:25832]"
providers = QgsProviderRegistry.instance().providerList()
# What each tool is given beside its points and the extent.
GIVEN = {
    "tindensification": {"OUTPUT": "out.laz", "DTM": "dtm.tif"},
    "slopefilter": {"OUTPUT": "out.laz"},
    "gridminimum": {"OUTPUT": "out.laz"},
    "pointcloudtoterrain": {"OUTPUT": "out.laz", "DTM": "dtm.tif", "CONTOURS": "lines.gpkg"},
    "classifytiles": {"OUTPUT_FOLDER": "out", "DTM": "dtm.tif"},
    "heightaboveground": {"OUTPUT": "out.laz"},
    "classifyaboveground": {"OUTPUT": "out.laz"},
    "waterclasses": {"OUTPUT": "out.laz"},
    "modelkeypoints": {"OUTPUT": "out.laz"},
    "clip": {"OUTPUT": "out.laz"},
    "terrainmodel": {"DTM": "dtm.tif", "CHM": "chm.tif"},
    "comparesettings": {"OUTPUT": "page.html", "SETTINGS": ["slope:town", "slope:steep"]},
    "water": {"OUTPUT": "water.gpkg"},
    "quality": {"PAGE": "page.html"},
    "check": {"HOLD_OUT": 0.1, "REPORT": "page.html"},
    "assess": {"REPORT": "page.html"},
}


@pytest.fixture(scope="module")
def cloud(tmp_path_factory):
    """A classified COPC file."""
    import processing

    folder = tmp_path_factory.mktemp("remote")
    source, path = folder / "scene.laz", folder / "far.copc.laz"
    write_scene(source)
    points = laspy.read(source)
    # So that it is larger than what is read of it first.
    points.intensity[:] = np.random.default_rng(1).integers(0, 65_536, len(points))
    points.write(str(source))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(copc_octree, "_LEAF_POINTS", 2_000)
        processing.run(ALGORITHM, {"INPUT": str(source), "OUTPUT": str(path)})
    return path


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setenv("BARE_EARTH_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


@pytest.fixture
def server(cache):
    with serving() as running:
        yield running


@pytest.fixture
def address(server, cloud):
    return f"{server.add(cloud.name, cloud.read_bytes())}?sig=SECRET"


def run(name, values, folder, log=None, **more):
    import processing

    paths = (".laz", ".tif", ".html", ".gpkg", "out")
    values = {
        key: str(folder / value) if isinstance(value, str) and value.endswith(paths) else value
        for key, value in values.items()
    }
    return processing.run(f"bareearth:{name}", {**values, **more}, feedback=log or Log())


def heights_in(path):
    raster = gdal.Open(str(path))
    return raster.ReadAsArray(), raster.GetGeoTransform()


@pytest.mark.parametrize("name", GIVEN)
def test_every_tool_reads_a_remote_point_cloud(name, address, server, tmp_path, log, registry):
    field = "CLASSIFIED" if name == "assess" else "INPUT"
    field = "REMOTE" if name == "classifytiles" else field
    more = {field: address, "EXTENT": EXTENT}
    if name == "assess":
        more["REFERENCE"] = address
    algorithm = registry.algorithmById(f"bareearth:{name}")
    assert run(name, GIVEN[name], tmp_path, log, **more)
    assert "Downloads " in log.text and " request" in log.text
    for output in algorithm.destinationParameterDefinitions():
        if output.name() in GIVEN[name]:
            assert (tmp_path / GIVEN[name][output.name()]).exists()
    assert "SECRET" not in log.text
    assert "The same without QGIS:\nbare-earth " in log.text and "http://127.0.0.1" in log.text
    # What is here is not downloaded again.
    server.asked.clear()
    run(name, GIVEN[name], tmp_path, **more)
    assert len(server.asked) == (2 if name == "assess" else 1)


def test_all_tools_with_points_are_tested(registry):
    of_points = {
        algorithm.name()
        for algorithm in registry.providerById("bareearth").algorithms()
        if (limit := algorithm.parameterDefinition("LIMIT")) and limit.type() == "number"
    }
    assert of_points == {*GIVEN, "fetch"}


def test_the_terrain_is_that_of_the_file(address, cloud, tmp_path):
    values = {"DTM": "far.tif", "EXTENT": EXTENT}
    run("pointcloudtoterrain", values, tmp_path, INPUT=address)
    run("pointcloudtoterrain", {**values, "DTM": "near.tif"}, tmp_path, INPUT=str(cloud))
    far, near = heights_in(tmp_path / "far.tif"), heights_in(tmp_path / "near.tif")
    assert np.array_equal(far[0], near[0]) and far[1] == near[1]


def test_without_an_extent_nothing_is_asked_for(address, server, tmp_path):
    for name in ("pointcloudtoterrain", "heightaboveground"):
        with pytest.raises(QgsProcessingException, match="far is not on this computer"):
            run(name, GIVEN[name], tmp_path, INPUT=address)
    assert not server.asked


def test_more_than_the_limit_is_refused(address, tmp_path, cache):
    with pytest.raises(
        QgsProcessingException,
        match=r"1\.0 kB\. .*'Limit of the download \[GB\]' \(0\.1\)",
    ):
        run("tindensification", GIVEN["tindensification"], tmp_path, INPUT=address, EXTENT=EXTENT,
            LIMIT=1e-6)  # fmt: skip
    assert not list(cache.rglob("*.laz")) and not list(tmp_path.glob("out*"))


def test_only_the_extent_is_used_where_there_is_no_area(address, tmp_path):
    done = run("heightaboveground", {"OUTPUT": "out.laz"}, tmp_path, INPUT=address, EXTENT=EXTENT)
    points = laspy.read(done["OUTPUT"])
    assert points.x.min() >= 500_010.0 and points.x.max() <= 500_050.0
    assert points.y.min() >= 5_700_010.0 and points.y.max() <= 5_700_060.0


@pytest.mark.parametrize("name", ["tindensification", "classifytiles"])
def test_only_the_points_of_the_extent_are_written(name, address, tmp_path, log):
    # More are downloaded, since they help to judge.
    field = "REMOTE" if name == "classifytiles" else "INPUT"
    run(name, GIVEN[name], tmp_path, log, **{field: address, "EXTENT": EXTENT})
    found = [*tmp_path.glob("out.laz"), *tmp_path.glob("out/*.laz")]
    (path,) = found
    points = laspy.read(path)
    assert 6_000 < len(points) < 9_000 and not np.any(points.classification == 0)
    assert points.x.min() >= 500_010.0 and points.x.max() <= 500_050.0
    assert points.y.min() >= 5_700_010.0 and points.y.max() <= 5_700_060.0
    assert "--area-only" in log.text


@pytest.mark.skipif("copc" not in providers, reason="shows no such layers")
def test_a_layer_of_a_map_in_another_crs(address, tmp_path, log):
    layer = QgsPointCloudLayer(address, "far away", "copc")
    assert layer.isValid() and QgsProject.instance().addMapLayer(layer)
    west, east, south, north = map(float, EXTENT.partition(" ")[0].split(","))
    mercator = QgsCoordinateReferenceSystem("EPSG:3857")
    move = QgsCoordinateTransform(layer.crs(), mercator, QgsProject.instance())
    box = move.transformBoundingBox(QgsRectangle(west, south, east, north))
    edges = box.xMinimum(), box.xMaximum(), box.yMinimum(), box.yMaximum()
    extent = f"{','.join(map(repr, edges))} [EPSG:3857]"
    run("pointcloudtoterrain", {"DTM": "dtm.tif"}, tmp_path, log, INPUT=layer.id(), EXTENT=extent)
    heights, (x, *_) = heights_in(tmp_path / "dtm.tif")
    assert heights.shape[0] < 60 and abs(x - 500_010.0) < 5.0
    assert "--extent" in log.text and "SECRET" not in log.text
    QgsProject.instance().clear()


@pytest.mark.skipif("ept" not in providers, reason="shows no such layers")
def test_a_layer_of_tiles(server, tmp_path, log):
    points, address = add_ept(server)
    about = {**json.loads(server.files["set/ept.json"]), "hierarchyType": "json", "points": 3000}
    server.add("set/ept.json", json.dumps(about).encode())
    layer = QgsPointCloudLayer(address, "tiles", "ept")
    assert layer.isValid() and QgsProject.instance().addMapLayer(layer)
    extent = "500020,500060,5600010,5600055"
    done = run(
        "heightaboveground", {"OUTPUT": "out.laz"}, tmp_path, log, INPUT=layer, EXTENT=extent
    )
    assert 100 < len(laspy.read(done["OUTPUT"])) < len(points)
    QgsProject.instance().clear()


def test_web_mercator_is_refused_before_the_download(server, tmp_path):
    _, address = add_ept(server, srs={"wkt": MERCATOR})
    server.asked.clear()
    with pytest.raises(
        QgsProcessingException,
        match=r"Mercator.* 'Transform Web Mercator to UTM' of '",
    ):
        run("terrainmodel", {"DTM": "dtm.tif"}, tmp_path, INPUT=address,
            EXTENT="500020,500060,5600010,5600055")  # fmt: skip
    assert not [path for path, *_ in server.asked if "ept-data" in path]
    # The way out.
    wkt = QgsCoordinateReferenceSystem("EPSG:3857").toWkt()
    _, address = add_ept(server, "another", srs={"wkt": wkt})
    part = run("fetch", {"OUTPUT": "part.laz"}, tmp_path, ADDRESS=address, TO_UTM=True,
               HEIGHT_UNIT="foot")["OUTPUT"]  # fmt: skip
    assert run("terrainmodel", {"DTM": "dtm.tif"}, tmp_path, INPUT=part)
    assert (tmp_path / "dtm.tif").exists()


def add_list(server, cloud):
    """Put a virtual point cloud of two files on the server, and return its address."""
    items = []
    for number in range(2):
        server.add(f"{number}.copc.laz", cloud.read_bytes())
        about = {"proj:bbox": [5e5, 5.7e6, 5e5 + 80, 5.7e6 + 80], "proj:epsg": 25832}
        assets = {"data": {"href": f"./{number}.copc.laz"}}
        items.append({"type": "Feature", "properties": about, "assets": assets})
    content = {"type": "FeatureCollection", "features": items}
    return server.add("all.vpc", json.dumps(content).encode())


def test_a_list_is_a_survey(server, cloud, tmp_path):
    address = add_list(server, cloud)
    run("terrainmodel", {"DTM": "dtm.tif"}, tmp_path, INPUT=address, EXTENT=EXTENT)
    assert (tmp_path / "dtm.tif").exists()
    with pytest.raises(QgsProcessingException, match="all lists 2 point clouds"):
        run("slopefilter", GIVEN["slopefilter"], tmp_path, INPUT=address, EXTENT=EXTENT)


def test_a_cancel_while_it_downloads(address, server, tmp_path):
    server.fault, log = lambda number, path: "slow", Log(cancel_at=6)
    done = run("tindensification", GIVEN["tindensification"], tmp_path, log, INPUT=address,
               EXTENT=EXTENT)  # fmt: skip
    assert not done.get("OUTPUT") and "nothing was written" in log.text
    assert max(log.moments) < 50.0 and not list(tmp_path.glob("out*"))


def test_secrets_are_in_no_project(address, tmp_path, log):
    project, context = QgsProject.instance(), QgsProcessingContext()
    context.setProject(project)
    import processing

    target = QgsProcessingOutputLayerDefinition(str(tmp_path / "dtm.tif"), project)
    values = {"INPUT": address, "EXTENT": EXTENT, "DTM": target}
    processing.runAndLoadResults(ONE_STEP, values, feedback=log, context=context)
    (layer,) = project.mapLayers().values()
    abstract = layer.metadata().abstract()
    assert "http://127.0.0.1" in abstract and "bare-earth classify" in abstract
    assert project.write(str(tmp_path / "p.qgs"))
    project.clear()
    for path in tmp_path.rglob("*"):
        assert path.is_dir() or b"SECRET" not in path.read_bytes(), path
    assert "SECRET" not in log.text


def test_secrets_are_in_no_history(address, server, registry):
    algorithm, context = registry.createAlgorithmById(ONE_STEP), QgsProcessingContext()
    context.setProject(QgsProject.instance())
    field = algorithm.parameterDefinition("INPUT")
    values, shown = {"INPUT": address, "EXTENT": EXTENT}, server.address("far.copc.laz")
    texts = [
        algorithm.asPythonCommand(values, context),
        field.valueAsPythonString(address, context),
    ]
    if hasattr(algorithm, "asQgisProcessCommand"):
        texts += [algorithm.asQgisProcessCommand(values, context)[0]]
        texts += [str(algorithm.asMap(values, context))]
    assert all("SECRET" not in text and shown in text for text in texts)
    assert not server.asked
    if "copc" in providers:
        layer = QgsPointCloudLayer(address, "far away", "copc")
        QgsProject.instance().addMapLayer(layer)
        assert field.valueAsPythonString(layer.id(), context) == repr(layer.id())
        QgsProject.instance().clear()
    assert field.valueAsPythonString("/a/b.laz", context) == "'/a/b.laz'"


def test_errors_name_the_address(address, server, tmp_path):
    extent = "500010.01,500010.02,5700010.01,5700010.02"
    with pytest.raises(QgsProcessingException) as told:
        run("tindensification", GIVEN["tindensification"], tmp_path, INPUT=address, EXTENT=extent)
    assert f"No point of {server.address('far.copc.laz')} " in str(told.value)


def test_qgis_process_reads_an_address(address, tmp_path, qgis_process):
    target = tmp_path / "dtm.tif"
    words = (f"--INPUT={address}", f"--EXTENT={EXTENT}", f"--DTM={target}")
    done = qgis_process("run", ONE_STEP, *words)
    assert done.returncode == 0, done.stdout + done.stderr
    assert target.exists() and "Downloads " in done.stdout
    done = qgis_process("run", ONE_STEP, words[0], words[2])
    assert done.returncode and "not on this computer" in done.stdout + done.stderr


def test_a_model_reads_an_address(address, tmp_path, log):
    model, child = QgsProcessingModelAlgorithm("m", "m"), QgsProcessingModelChildAlgorithm(ONE_STEP)
    for field in (
        QgsProcessingParameterString("where", "Where"), QgsProcessingParameterExtent("part", "Part")
    ):  # fmt: skip
        model.addModelParameter(field, QgsProcessingModelParameter(field.name()))
    for name, field in (("INPUT", "where"), ("EXTENT", "part")):
        source = QgsProcessingModelChildParameterSource.fromModelParameter(field)
        child.addParameterSources(name, [source])
    child.setChildId("terrain")
    output = QgsProcessingModelOutput("dtm", "dtm")
    output.setChildId("terrain")
    output.setChildOutputName("DTM")
    child.setModelOutputs({"dtm": output})
    model.addChildAlgorithm(child)
    model.updateDestinationParameters()
    context = QgsProcessingContext()
    context.setProject(QgsProject.instance())
    target = str(tmp_path / "dtm.tif")
    values = {"where": address, "part": EXTENT, "terrain:dtm": target}
    _, is_done = model.run(values, context, log)
    assert is_done and Path(target).exists() and "SECRET" not in log.text


def test_the_menu_removes_what_was_downloaded(address, cache, tmp_path):
    run("heightaboveground", {"OUTPUT": "out.laz"}, tmp_path, INPUT=address, EXTENT=EXTENT)
    assert list(cache.rglob("*.laz"))

    class Window:
        def messageBar(self):
            return self

        def pushMessage(self, title, text, level):
            self.said = text

    window = Window()
    BareEarthPlugin(window).clear_cache()
    assert not cache.exists() and "kB were removed from " in window.said
