"""Runs of one project are told apart: dialogs begin with the last one, and refuse two at once."""

import os
import time
from pathlib import Path

import pytest
from qgis.core import QgsProcessingOutputLayerDefinition, QgsProject, QgsRasterLayer
from support import ALGORITHM

SLOPE, TERRAIN, REVIEW = "bareearth:slopefilter", "bareearth:terrainmodel", "bareearth:review"
RESULTS = {
    "OUTPUT": "points.laz", "DTM": "dtm.tif", "EXPECTED_ERROR": "error.tif",
    "ERROR_CAUSE": "cause.tif",
}  # fmt: skip


@pytest.fixture
def run(registry, context, log, tmp_path):
    """What runs an algorithm into a folder, and returns the files that it was asked for."""

    def run(name, algorithm, source, results=RESULTS, **values):
        (tmp_path / name).mkdir(exist_ok=True)
        files = {field: str(tmp_path / name / results[field]) for field in results}
        parameters = {"INPUT": str(source), **values, **files}
        _, done = registry.createAlgorithmById(algorithm).run(parameters, context, log)
        assert done, log.text
        return files

    return run


def refused(registry, context, **values):
    """Return why Places to review refuses some inputs; empty if it does not."""
    algorithm = registry.createAlgorithmById(REVIEW)
    parameters = {"OUTPUT": "TEMPORARY_OUTPUT", "REPORT": "", **values}
    possible, text = algorithm.checkParameterValues(parameters, context)
    return "" if possible else text


def shown(dialog):
    values = {
        name: wrapper.parameterValue() for name, wrapper in dialog.mainWidget().wrappers.items()
    }
    return {name: values[name] or "" for name in ("INPUT", "DTM", "CAUSE", "POINTS")}


def test_places_to_review_begin_with_what_the_last_run_made(run, scene, dialog_of):
    project = QgsProject.instance()
    first = run("first", ALGORITHM, scene.path)
    others = [QgsRasterLayer(first[name], name) for name in ("DTM", "EXPECTED_ERROR")]
    project.addMapLayers(others)
    second = run("second", SLOPE, scene.path)
    layer = project.addMapLayer(QgsRasterLayer(second["EXPECTED_ERROR"], "Expected error"))
    assert shown(dialog_of(REVIEW)) == {
        "INPUT": layer.id(), "DTM": second["DTM"], "CAUSE": second["ERROR_CAUSE"],
        "POINTS": second["OUTPUT"],
    }  # fmt: skip
    dialog = dialog_of(REVIEW)
    dialog.setParameters({"INPUT": first["EXPECTED_ERROR"], "DTM": None})
    assert shown(dialog)["INPUT"] == others[1].id() and shown(dialog)["DTM"] == ""
    # A run that made less leaves fields empty: what an earlier run made is of another ground.
    less = {name: RESULTS[name] for name in ("OUTPUT", "EXPECTED_ERROR")}
    third = run("third", ALGORITHM, scene.path, less)
    found = shown(dialog_of(REVIEW))
    assert found["INPUT"] == third["EXPECTED_ERROR"] and found["DTM"] == found["CAUSE"] == ""
    Path(third["EXPECTED_ERROR"]).unlink()
    assert shown(dialog_of(REVIEW))["DTM"] == second["DTM"]


def test_without_a_run_the_dialog_shows_no_files_of_others(raster, dialog_of):
    found = shown(dialog_of(REVIEW))
    assert found["DTM"] == found["CAUSE"] == found["POINTS"] == ""


@pytest.fixture
def raster(tmp_path, context):
    import numpy as np
    from support import write_raster

    path = write_raster(tmp_path / "r.tif", np.ones((4, 4)))
    return QgsProject.instance().addMapLayer(QgsRasterLayer(path, "raster"))


def test_what_two_runs_made_is_refused_and_both_are_named(run, scene, registry, context):
    first, second = run("first", ALGORITHM, scene.path), run("second", SLOPE, scene.path)
    layer = QgsRasterLayer(second["DTM"], "Mine")
    QgsProject.instance().addMapLayer(layer)
    text = refused(registry, context, INPUT=first["EXPECTED_ERROR"], DTM=layer.id())
    assert text == (
        f'"{first["EXPECTED_ERROR"]}" is from the run "Classify ground (TIN densification),'
        f' {scene.path.name}", and "Mine" from "Classify ground (slope filter), {scene.path.name}":'
        " choose both from one run."
    )
    for name, result in (("CAUSE", "ERROR_CAUSE"), ("POINTS", "OUTPUT")):
        values = {"INPUT": first["EXPECTED_ERROR"], name: second[result]}
        assert "choose both from one run" in refused(registry, context, **values)
        assert not refused(registry, context, **{**values, name: first[result]})
    # The terrain before corrections is always of another run.
    values = {"INPUT": second["EXPECTED_ERROR"], "DTM": second["DTM"], "EARLIER": first["DTM"]}
    assert not refused(registry, context, **values)


def test_runs_with_other_settings_or_sources_are_told_apart(
    run, scene, registry, context, tmp_path
):
    first = run("first", ALGORITHM, scene.path)
    town = run("town", ALGORITHM, scene.path, PRESET="town")
    copy = tmp_path / "copy.laz"
    copy.write_bytes(scene.path.read_bytes())
    other = run("other", ALGORITHM, copy)
    for found in (town, other):
        values = {"INPUT": first["EXPECTED_ERROR"], "DTM": found["DTM"]}
        assert "choose both from one run" in refused(registry, context, **values)


def test_layers_have_the_names_of_their_source_and_run(scene, context, tmp_path):
    import processing

    project, other = QgsProject.instance(), tmp_path / "other.laz"
    other.write_bytes(scene.path.read_bytes())
    # Several layers, which are a group; a single one; and the same source, by other settings.
    rasters = ("DTM", "EXPECTED_ERROR")
    runs = (
        (ALGORITHM, scene.path, rasters), (ALGORITHM, other, rasters), (SLOPE, scene.path, rasters),
        (ALGORITHM, scene.path, rasters[1:]),
    )  # fmt: skip
    for number, (algorithm, source, names) in enumerate(runs):
        outputs = {name: str(tmp_path / f"{name}{number}.tif") for name in names}
        loading = {
            name: QgsProcessingOutputLayerDefinition(path, project)
            for name, path in outputs.items()
        }
        cloud = str(tmp_path / f"points{number}.las")
        values = {"INPUT": str(source), "OUTPUT": cloud, **loading}
        processing.runAndLoadResults(algorithm, values)
    names = [layer.name() for layer in project.mapLayers().values()]
    assert {name for name in names if "Expected error" in name} == {
        "scene: Expected error", "other: Expected error", "scene (2): Expected error",
        "scene (3): Expected error",
    }  # fmt: skip
    assert len(set(names)) == len(names)
    assert {"scene: Terrain model", "scene (2): Terrain model"} <= set(names)


def test_what_belongs_together_or_is_not_known_is_accepted(run, scene, registry, context):
    first = run("first", ALGORITHM, scene.path)
    # The same again, and a terrain model of the classified points.
    same = run("same", ALGORITHM, scene.path, HILLSHADE_AZIMUTH=90)
    drawn = run("drawn", TERRAIN, first["OUTPUT"], {"DTM": "dtm.tif"})
    for found in (same, drawn):
        assert not refused(registry, context, INPUT=first["EXPECTED_ERROR"], DTM=found["DTM"])
    # A file that was written anew since then, as by the command.
    second = run("second", SLOPE, scene.path)
    values = {"INPUT": first["EXPECTED_ERROR"], "DTM": second["DTM"]}
    assert refused(registry, context, **values)
    later = time.time() + 60.0
    os.utime(second["DTM"], (later, later))
    assert not refused(registry, context, **values)
