"""Outputs that a run could not write are refused before it, in the words of the run."""

import os

import pytest
from qgis.core import QgsProcessingOutputLayerDefinition, QgsProject
from qgis.PyQt.QtWidgets import QCheckBox
from support import ALGORITHM, Log, remove, write_scene

WHOLE = "bareearth:pointcloudtoterrain"
CASES = [
    (ALGORITHM, "OUTPUT", "missing/ground.laz"),
    (ALGORITHM, "OUTPUT", "ground.tif"),
    (ALGORITHM, "DTM", "missing/dtm.tif"),
    ("bareearth:slopefilter", "HILLSHADE", "missing/shade.tif"),
    ("bareearth:gridminimum", "HILLSHADE", "shade.txt"),
    (WHOLE, "OUTPUT", "ground.txt"),
    (WHOLE, "RELIEF", "missing/relief.tif"),
    (WHOLE, "CONTOURS", "contours.kml"),
    (WHOLE, "CONTOURS", "missing/contours.gpkg"),
    ("bareearth:classifytiles", "OUTPUT_VPC", "list.txt"),
    ("bareearth:classifytiles", "OUTPUT_FOLDER", "missing/deep"),
    ("bareearth:heightaboveground", "OUTPUT", "missing/heights.laz"),
    ("bareearth:classifyaboveground", "OUTPUT", "missing/classes.laz"),
    ("bareearth:waterclasses", "OUTPUT", "missing/water.laz"),
    ("bareearth:modelkeypoints", "OUTPUT", "keys"),
    ("bareearth:terrainmodel", "CHM", "missing/chm.tif"),
    ("bareearth:assess", "REPORT", "report.pdf"),
    ("bareearth:assess", "ERROR_MAP", "missing/errors.tif"),
    ("bareearth:comparesettings", "OUTPUT", "page.png"),
    ("bareearth:comparesettings", "OUTPUT", "missing/page.html"),
]


def values_of(name, folder):
    """Return the inputs of an algorithm, and outputs that can be written."""
    cloud = str(folder / "scene.laz")
    write_scene(cloud)
    if name == "bareearth:assess":
        return {"CLASSIFIED": cloud, "REFERENCE": cloud}
    if name == "bareearth:classifytiles":
        return {"INPUT": [cloud], "OUTPUT_FOLDER": str(folder / "out")}
    page = {"OUTPUT": str(folder / "ok.html")}
    outputs = {"bareearth:terrainmodel": {}, "bareearth:comparesettings": page, WHOLE: {}}
    return {"INPUT": cloud, **outputs.get(name, {"OUTPUT": str(folder / "ok.laz")})}


@pytest.mark.parametrize(("name", "output", "file"), CASES)
@pytest.mark.parametrize("of_dialog", [False, True])
def test_an_output_is_refused_before_the_run_as_by_the_run(
    name, output, file, of_dialog, registry, tmp_path, context
):
    values, path = values_of(name, tmp_path), str(tmp_path / file)
    algorithm = registry.createAlgorithmById(name)
    assert algorithm.checkParameterValues(values, context) == (True, "")
    # A dialog wraps the path, to say where the layer goes.
    given = QgsProcessingOutputLayerDefinition(path, QgsProject.instance()) if of_dialog else path
    possible, text = algorithm.checkParameterValues({**values, output: given}, context)
    assert not possible and text.startswith("Cannot write") and path in text
    log = Log()
    assert algorithm.create().run({**values, output: path}, context, log)[1] is False
    assert text in log.said
    assert sorted(os.listdir(tmp_path)) == ["scene.laz"]


def test_what_qgis_names_itself_is_not_refused(registry, tmp_path, context):
    values = values_of(ALGORITHM, tmp_path)
    for given in ("TEMPORARY_OUTPUT", None, ""):
        assert registry.createAlgorithmById(ALGORITHM).checkParameterValues(
            {**values, "DTM": given, "HILLSHADE": given}, context
        ) == (True, "")


def test_file_dialogs_offer_what_can_be_written(registry):
    algorithm = registry.createAlgorithmById(WHOLE)
    offered = algorithm.parameterDefinition("CONTOURS").createFileFilter()
    kinds = [word for word in offered.split(";;") if "*.*" not in word]
    assert [kind.partition("(")[2] for kind in kinds] == [
        "*.gpkg)", "*.geojson)", "*.shp)", "*.fgb)", "*.dxf)",
    ]  # fmt: skip
    for name in ("terrainmodel", "heightaboveground", "comparesettings"):
        field = registry.createAlgorithmById(f"bareearth:{name}").parameterDefinition("INPUT")
        assert "*.vpc" in field.createFileFilter()


def test_what_has_always_a_value_is_not_called_optional(registry, context):
    from processing.gui.AlgorithmDialog import AlgorithmDialog
    from qgis.PyQt.QtWidgets import QLabel

    dialog = AlgorithmDialog(registry.createAlgorithmById("bareearth:classifytiles"))
    wrappers = dialog.mainWidget().wrappers
    box = wrappers["RECURSIVE"].wrappedWidget()
    assert isinstance(box, QCheckBox) and box.text() == "Include subfolders"
    assert box.toolTip() and not box.isChecked()
    box.setChecked(True)
    assert wrappers["RECURSIVE"].parameterValue() is True
    wrappers["RECURSIVE"].setParameterValue("false", context)
    assert not box.isChecked()
    labels = [widget.text() for widget in dialog.findChildren((QLabel, QCheckBox))]
    labels = [label for label in labels if label.endswith("[optional]")]
    for name, wrapper in wrappers.items():
        parameter = wrapper.parameterDefinition()
        if type(parameter).__name__ in ("ChoiceParameter", "QgsProcessingParameterBoolean"):
            assert f"{parameter.description()} [optional]" not in labels, name
    assert "Low noise class [optional]" not in labels and labels
    remove(dialog)


@pytest.mark.parametrize(
    ("output", "file"),
    [
        ("ground:DTM", "missing/dtm.tif"),
        ("ground:OUTPUT", "missing/ground.laz"),
        ("contours:OUTPUT", "lines.kml"),
    ],
)
def test_models_refuse_outputs_too(output, file, registry, tmp_path, context):
    cloud = str(tmp_path / "scene.laz")
    write_scene(cloud)
    model = registry.createAlgorithmById("bareearth:terraincontours")
    names = [definition.name() for definition in model.destinationParameterDefinitions()]
    values = {"INPUT": cloud, **dict.fromkeys(names, "TEMPORARY_OUTPUT")}
    assert model.checkParameterValues(values, context) == (True, "")
    values[output] = str(tmp_path / file)
    possible, text = model.checkParameterValues(values, context)
    assert not possible and text.startswith("Cannot write")
