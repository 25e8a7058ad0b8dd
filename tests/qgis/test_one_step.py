"""From a point cloud to all maps of its terrain, in the toolbox."""

import json
import os
import shlex
import shutil

import laspy
import numpy as np
import pytest
from osgeo import gdal, ogr
from qgis.core import (
    QgsProcessingException,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
)
from support import Log, layer_of, title_of, write_scene

ALL_IN_ONE = "bareearth:pointcloudtoterrain"
RASTERS = ("DTM", "DSM", "CHM", "HILLSHADE", "EXPECTED_ERROR", "RELIEF")


def everything(folder):
    paths = {name: str(folder / f"{name.lower()}.tif") for name in RASTERS}
    return {
        "OUTPUT": str(folder / "ground.laz"), **paths, "CONTOURS": str(folder / "lines.gpkg")
    }  # fmt: skip


def band(path):
    values = gdal.Open(path).ReadAsArray().astype(float)
    return np.where(values == -9999, np.nan, values)


def test_a_file_becomes_all_maps(scene, tmp_path):
    import processing

    outputs = everything(tmp_path)
    log = Log()
    results = processing.run(
        ALL_IN_ONE, {"INPUT": str(scene.path), **outputs, "CONTOUR_INTERVAL": 0.5}, feedback=log
    )
    assert {name: results[name] for name in outputs} == outputs
    assert results["POINT_COUNT"] == scene.count
    assert results["GROUND_COUNT"] == scene.ground_count
    assert np.array_equal(laspy.read(outputs["OUTPUT"]).classification == 2, scene.ground)
    # The scene is a plane with a roof 12 m above its foot.
    terrain, canopy = band(outputs["DTM"]), band(outputs["CHM"])
    assert np.nanmin(terrain) > 99.9 and np.nanmax(terrain) < 106.0
    assert np.nanmax(canopy) > 7.0
    assert np.nanmax(np.abs(band(outputs["RELIEF"])[20:60, 20:60])) < 0.05
    opened = ogr.Open(outputs["CONTOURS"])
    lines = opened[0]
    heights = sorted({line.GetField("ELEV") for line in lines})
    assert heights == [100.5 + 0.5 * step for step in range(11)] and lines.GetSpatialRef()
    assert f"{scene.ground_count:,} of {scene.count:,} points" in log.text
    assert not [key for key in os.listdir(tmp_path) if key.startswith(".") or "aux" in key]


def test_places_to_review_come_from_the_same_run(scene, tmp_path):
    import processing

    places, points = str(tmp_path / "places.gpkg"), str(tmp_path / "ground.laz")
    log = Log()
    results = processing.run(
        ALL_IN_ONE, {"INPUT": str(scene.path), "OUTPUT": points, "PLACES": places}, feedback=log
    )
    assert results["PLACES"] == places and "to review" in log.text
    opened = ogr.Open(places)
    found = opened[0]
    names = [field.name for field in found.schema]
    assert {"REASON", "answer", "class", "X1", "Y2"} <= set(names)
    assert "a large expected error" not in {place.GetField("REASON") for place in found}
    assert sorted(os.listdir(tmp_path)) == ["ground.laz", "places.gpkg", "scene.laz"]


def test_the_commands_at_the_end_of_the_log_do_the_same(scene, tmp_path):
    import processing

    from bare_earth.algorithms.cli import main

    outputs, log = everything(tmp_path), Log()
    given = {"INPUT": str(scene.path), "PRESET": "town", "DTM_CELL_SIZE": 2, "TO_CLASS": 8}
    processing.run(ALL_IN_ONE, {**given, **outputs}, feedback=log)
    before = {name: band(outputs[name]) for name in ("DTM", "DSM", "CHM", "HILLSHADE")}
    classes = laspy.read(outputs["OUTPUT"]).classification
    commands = [shlex.split(text) for text in log.said if text.startswith("bare-earth ")]
    assert [words[:2] for words in commands] == [["bare-earth", x] for x in ("classify", "terrain")]
    for value in outputs.values():
        os.remove(value)
    for words in commands:
        assert main(words[1:]) == 0
    assert np.array_equal(laspy.read(outputs["OUTPUT"]).classification, classes)
    for name, values in before.items():
        assert np.array_equal(band(outputs[name]), values, equal_nan=True)


def test_the_hillshade_has_four_lights_unless_told_otherwise(scene, tmp_path):
    import processing

    outputs = {name: everything(tmp_path)[name] for name in ("DTM", "HILLSHADE")}
    lit = {}
    for light in ({}, {"HILLSHADE_LIGHT": "one"}, {"HILLSHADE_LIGHT": "multidirectional"}):
        processing.run(ALL_IN_ONE, {"INPUT": str(scene.path), **light, **outputs})
        lit[light.get("HILLSHADE_LIGHT")] = band(outputs["HILLSHADE"])
    assert np.array_equal(lit[None], lit["multidirectional"])
    assert not np.array_equal(lit[None], lit["one"])


@pytest.mark.parametrize("how", ["file", "folder"])
def test_the_terrain_respects_lines_and_polygons(scene, tmp_path, how):
    import processing

    tiles = tmp_path / "tiles"
    tiles.mkdir()
    shutil.copy(scene.path, tiles)
    given = {"file": {"INPUT": str(scene.path)}, "folder": {"INPUT_FOLDER": str(tiles)}}[how]
    outputs = {name: str(tmp_path / f"{name}.tif") for name in ("DTM", "DSM", "RELIEF")}
    # A line 5 to 9 m above the slope, and a lake in it.
    x, y = 500_000.0, 5_700_000.0
    line = layer_of("LineStringZ", f"LINESTRINGZ({x + 5} {y + 60.5} 110, {x + 70} {y + 60.5} 110)")
    ring = [(5, 5), (25, 5), (25, 18), (5, 18), (5, 5)]
    corners = ", ".join(f"{x + east} {y + north}" for east, north in ring)
    known = {"BREAKLINES": line, "WATER": layer_of("Polygon", f"POLYGON(({corners}))")}
    log = Log()
    processing.run(ALL_IN_ONE, {**given, **outputs}, feedback=log)
    plain = band(outputs["DTM"])
    processing.run(ALL_IN_ONE, {**given, **outputs, **known}, feedback=log)
    fixed = band(outputs["DTM"])
    assert np.nanmax(plain) < 106.0 and np.nanmax(fixed) > 109.0
    # Rows from the north: y from 7 to 16 m above the south edge, x from 7 to 23 m.
    lake = np.s_[-16:-7, 7:23]
    assert np.ptp(fixed[lake]) < 0.01 < 0.5 < np.ptp(plain[lake])
    assert np.nanmax(band(outputs["RELIEF"])) > 2.0
    assert "--breaklines breaklines.geojson --water water.geojson" in log.text


@pytest.mark.parametrize("how", ["file", "folder"])
@pytest.mark.parametrize("field", ["extent", "boundary"])
def test_an_area_is_all_that_is_mapped(scene, tmp_path, how, field):
    import processing

    from bare_earth.algorithms.cli import main

    tiles, out = tmp_path / "tiles", tmp_path / "out"
    tiles.mkdir(), out.mkdir()
    shutil.copy(scene.path, tiles / "here.laz")
    write_scene(tiles / "away.laz", origin=(500_080.0, 5_700_000.0))
    given = {"file": {"INPUT": str(scene.path)}, "folder": {"INPUT_FOLDER": str(tiles)}}[how]
    # 20 x 40 m on open ground and on the roof.
    west, south = 500_020.0, 5_700_010.0
    if field == "extent":
        given["EXTENT"] = f"{west},{west + 20},{south},{south + 40} [EPSG:25832]"
    else:
        corners = [(0, 0), (20, 0), (20, 40), (0, 40), (0, 0)]
        ring = ", ".join(f"{west + x} {south + y}" for x, y in corners)
        given["BOUNDARY"] = layer_of("Polygon", f"POLYGON(({ring}))")
    outputs, log = everything(out), Log()
    results = processing.run(ALL_IN_ONE, {**given, **outputs}, feedback=log)
    path = results["OUTPUT"] if how == "file" else str(out / "ground" / "here.laz")
    las = laspy.read(path)
    x, y = np.asarray(las.x) - west, np.asarray(las.y) - south
    assert len(x) == results["POINT_COUNT"] == 80 * 40
    assert x.min() > 0 and x.max() < 20 and y.min() > 0 and y.max() < 40
    assert np.array_equal(las.classification == 2, ~((x > 10) & (y > 10) & (y < 36)))
    assert results["GROUND_COUNT"] == np.count_nonzero(las.classification == 2)
    if how == "folder":
        assert not (out / "ground" / "away.laz").exists()
    for name in ("DTM", "DSM", "RELIEF"):
        rows, columns = band(outputs[name]).shape
        assert 40 <= rows <= 41 and 20 <= columns <= 21
    assert "3,200 points in the area" in log.text
    (command,) = (shlex.split(text) for text in log.said if text.startswith("bare-earth classify"))
    assert "--area-only" in command
    if field == "extent":
        before = las.classification
        os.remove(path)
        assert main(command[1:]) == 0
        assert np.array_equal(laspy.read(path).classification, before)
    else:
        assert "--boundary boundary.geojson" in log.text


def test_every_output_may_be_left_out(scene, tmp_path):
    import processing

    for name, path in everything(tmp_path).items():
        if name != "CONTOURS":
            results = processing.run(ALL_IN_ONE, {"INPUT": str(scene.path), name: path})
            assert set(results) == {name, "POINT_COUNT", "GROUND_COUNT"}
            os.remove(path)
    lines = str(tmp_path / "lines.geojson")
    results = processing.run(ALL_IN_ONE, {"INPUT": str(scene.path), "CONTOURS": lines})
    assert results["CONTOURS"] == lines
    assert sorted(os.listdir(tmp_path)) == ["lines.geojson", scene.path.name]


def test_the_log_tells_each_thing_once_and_ends_with_named_classes(tmp_path):
    import processing

    ground = write_scene(tmp_path / "scene.laz", epsg=None)
    log = Log()
    values = {"INPUT": str(tmp_path / "scene.laz"), **everything(tmp_path)}
    processing.run(ALL_IN_ONE, values, feedback=log)
    (units,) = (text for text in log.said if "taken as metres" in text)
    assert units.startswith("scene.laz does not say its CRS")
    counts = [text for text in log.said if "Class " in text]
    assert counts[0].startswith(f"Class 2 (ground): {np.count_nonzero(ground):,} points")
    assert counts[1].startswith("Class 1 (")


@pytest.mark.parametrize("how", ["folder", "input", "list"])
def test_a_folder_is_one_survey(tmp_path, how):
    import processing

    tiles, out = tmp_path / "tiles", tmp_path / "out"
    tiles.mkdir(), out.mkdir()
    ground = [
        write_scene(tiles / f"{place}.laz", origin=(500_000.0 + 80 * place, 5_700_000.0))
        for place in range(2)
    ]
    (tmp_path / "list.txt").write_text(f"{tiles}\n")
    inputs = {
        "folder": {"INPUT_FOLDER": str(tiles)},
        "input": {"INPUT": str(tiles)},
        "list": {"INPUT": str(tmp_path / "list.txt")},
    }
    results = processing.run(ALL_IN_ONE, {**inputs[how], **everything(out)})
    assert results["OUTPUT"] == str(out / "ground" / "classified.vpc")
    assert results["GROUND_COUNT"] == sum(map(np.count_nonzero, ground))
    names = [name for name in sorted(os.listdir(out / "ground")) if name[0] != "."]
    assert names == ["0.laz", "1.laz", "classified.vpc"]
    assert band(results["DTM"]).shape[1] >= 159


def test_layers_are_styled_and_the_terrain_is_shown(scene, tmp_path, context):
    import processing

    project = QgsProject.instance()
    outputs = {
        name: QgsProcessingOutputLayerDefinition(path, project)
        for name, path in everything(tmp_path).items()
    }
    processing.runAndLoadResults(ALL_IN_ONE, {"INPUT": str(scene.path), **outputs})
    (group,) = project.layerTreeRoot().children()
    assert group.name() == "scene: terrain"
    titles = [title_of(child) for child in group.children()]
    assert titles == [
        "Contour lines", "Classes", "Expected error", "Local relief", "Canopy height",
        "Surface model", "Terrain model", "Hillshade",
    ]  # fmt: skip
    shown = [title for title, child in zip(titles, group.children()) if child.isVisible()]
    assert shown == ["Contour lines", "Terrain model", "Hillshade"]


def test_without_an_input_it_says_what_to_do(algorithm, registry, context):
    one = registry.createAlgorithmById(ALL_IN_ONE)
    possible, text = one.checkParameterValues({}, context)
    assert not possible and text == "Choose a point cloud, or a folder of them."
    possible, text = one.checkParameterValues({"INPUT": "/nowhere.laz"}, context)
    assert not possible and "does not exist" in text


def test_a_format_that_lines_cannot_have_leaves_nothing(scene, tmp_path):
    import processing

    wrong = {"INPUT": str(scene.path), "CONTOURS": str(tmp_path / "lines.docx")}
    with pytest.raises(QgsProcessingException, match="gpkg"):
        processing.run(ALL_IN_ONE, wrong)
    assert os.listdir(tmp_path) == [scene.path.name]


def test_it_is_the_first_of_the_toolbox(registry):
    provider = registry.providerById("bareearth")
    groups = sorted({algorithm.group() for algorithm in provider.algorithms()})
    first = [
        algorithm.id() for algorithm in provider.algorithms() if algorithm.group() == groups[0]
    ]
    assert first == [ALL_IN_ONE]


def test_by_qgis_process(scene, tmp_path, qgis_process):
    paths = {"INPUT": str(scene.path), "DTM": str(tmp_path / "d.tif"), "METHOD": "grid-minimum"}
    words = [f"{name}={value}" for name, value in paths.items()]
    done = qgis_process("--json", "run", ALL_IN_ONE, "--", *words)
    assert done.returncode == 0, done.stderr
    results = json.loads(done.stdout[done.stdout.index("{") :])["results"]
    assert results["DTM"] == paths["DTM"] and results["POINT_COUNT"] == scene.count


def test_what_is_not_made_of_a_file_without_points_is_not_loaded(tmp_path, context):
    import processing

    from bare_earth.plugin import compat

    empty, log = tmp_path / "empty.las", Log()
    laspy.LasData(laspy.LasHeader(point_format=6, version="1.4")).write(str(empty))
    project = QgsProject.instance()
    context.setProject(project)
    outputs = {
        name: QgsProcessingOutputLayerDefinition(path, project)
        for name, path in everything(tmp_path).items()
    }
    processing.run(ALL_IN_ONE, {"INPUT": str(empty), **outputs}, context=context, feedback=log)
    assert "holds no points" in log.text
    loaded = [path for path in context.layersToLoadOnCompletion() if not os.path.exists(path)]
    assert loaded == [] and (compat.can_load("x.laz") or "cannot show" in log.text)
