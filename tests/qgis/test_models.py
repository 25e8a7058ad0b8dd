"""The algorithm inside models, in batch mode and in its dialog."""

import os

import pytest
from qgis.core import (
    QgsProcessingContext,
    QgsProcessingModelAlgorithm,
    QgsProcessingModelChildAlgorithm,
    QgsProcessingModelChildParameterSource,
    QgsProcessingModelOutput,
    QgsProcessingModelParameter,
    QgsProcessingOutputLayerDefinition,
    QgsProcessingParameterFile,
    QgsProcessingParameterNumber,
)
from support import ALGORITHM, remove

VALUES = {"MAX_TERRAIN_ANGLE": 80.0, "OTHERS": "unclassified", "FROM_CLASSES": "1"}


def make_model(algorithm, path=None):
    """Return a model round the algorithm; its input is a file, or stands in it."""
    # The designer writes all defaults into the model, too.
    values = {
        definition.name(): definition.defaultValue()
        for definition in algorithm.parameterDefinitions()
        if not definition.isDestination()
    }
    model = QgsProcessingModelAlgorithm("Terrain", "tests")
    child = QgsProcessingModelChildAlgorithm(ALGORITHM)
    child.setChildId("classify")
    if path is None:
        model.addModelParameter(
            QgsProcessingParameterFile("cloud", "Cloud"), QgsProcessingModelParameter("cloud")
        )
        source = QgsProcessingModelChildParameterSource.fromModelParameter("cloud")
    else:
        source = QgsProcessingModelChildParameterSource.fromStaticValue(path)
    child.addParameterSources("INPUT", [source])
    model.addModelParameter(
        QgsProcessingParameterNumber("size", "Size", defaultValue=30),
        QgsProcessingModelParameter("size"),
    )
    size = QgsProcessingModelChildParameterSource.fromModelParameter("size")
    child.addParameterSources("MAX_BUILDING_SIZE", [size])
    for name, value in {**values, **VALUES}.items():
        if name in ("INPUT", "MAX_BUILDING_SIZE"):
            continue
        source = QgsProcessingModelChildParameterSource.fromStaticValue(value)
        child.addParameterSources(name, [source])
    outputs = {}
    for name in ("OUTPUT", "DTM"):
        output = QgsProcessingModelOutput(name, name)
        output.setChildId("classify")
        output.setChildOutputName(name)
        outputs[name] = output
    child.setModelOutputs(outputs)
    model.addChildAlgorithm(child)
    model.updateDestinationParameters()
    return model


@pytest.mark.parametrize("fixed", [False, True])
def test_a_model_survives_saving_and_runs(fixed, algorithm, scene, tmp_path, context, log):
    file = str(tmp_path / "terrain.model3")
    assert make_model(algorithm, str(scene.path) if fixed else None).toFile(file)
    model = QgsProcessingModelAlgorithm()
    assert model.fromFile(file)
    sources = model.childAlgorithm("classify").parameterSources()
    for name, value in VALUES.items():
        assert sources[name][0].staticValue() == value
    assert model.validate() == (True, [])
    # The designer's output names differ with the version: "dtm" or "classify:DTM".
    files = {"dtm": str(tmp_path / "dtm.tif"), "output": str(tmp_path / "ground.laz")}
    outputs = {
        definition.name(): files[definition.name().lower().rpartition(":")[2]]
        for definition in model.destinationParameterDefinitions()
    }
    assert len(outputs) == 2
    parameters = {"size": 36, **outputs}
    if not fixed:
        parameters["cloud"] = str(scene.path)
    model = model.create()
    results, done = model.run(parameters, context, log)
    assert done, log.text
    assert results["CHILD_RESULTS"]["classify"]["GROUND_COUNT"] == scene.ground_count
    assert all(os.path.getsize(path) for path in files.values())


def step(name, algorithm, fixed, linked, outputs):
    """Return a step of a model with values, links to outputs of steps, and outputs of the model."""
    child, sources = (
        QgsProcessingModelChildAlgorithm(algorithm),
        QgsProcessingModelChildParameterSource,
    )
    child.setChildId(name)
    for field, value in fixed.items():
        child.addParameterSources(field, [sources.fromStaticValue(value)])
    for field, (other, output) in linked.items():
        child.addParameterSources(field, [sources.fromChildOutput(other, output)])
    made = {}
    for output in outputs:
        made[output] = QgsProcessingModelOutput(output, output)
        made[output].setChildId(name)
        made[output].setChildOutputName(output)
    child.setModelOutputs(made)
    return child


@pytest.mark.parametrize("blank", ["", QgsProcessingOutputLayerDefinition("")])
def test_a_step_makes_what_later_ones_need_though_its_cell_is_blank(
    blank, scene, tmp_path, context, log
):
    classified = scene.with_classes(tmp_path / "classified.las")
    model = QgsProcessingModelAlgorithm("Relief", "tests")
    model.addChildAlgorithm(
        step("terrain", "bareearth:terrainmodel", {"INPUT": str(classified)}, {}, ["DTM"])
    )
    link = {"INPUT": ("terrain", "DTM")}
    kinds = {"KINDS": ["hillshade"]}
    model.addChildAlgorithm(step("relief", "bareearth:relief", kinds, link, ["OUTPUT_FOLDER"]))
    model.updateDestinationParameters()
    names = [field.name() for field in model.destinationParameterDefinitions()]
    terrain = next(name for name in names if name.lower().endswith("dtm"))
    folder = next(name for name in names if name != terrain)
    parameters = {terrain: blank, folder: str(tmp_path / "relief")}
    _, done = model.create().run(parameters, context, log)
    assert done, log.text
    assert len(list((tmp_path / "relief").glob("*.tif"))) == 1


def test_the_dialog_gives_back_what_is_chosen(algorithm, scene, plugin):
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    dialog = AlgorithmDialog(algorithm)
    try:
        dialog.setParameters({"INPUT": str(scene.path), "TO_CLASS": 9})
        values = dialog.createProcessingParameters()
        # The dialog takes the algorithm along.
        assert algorithm.checkParameterValues(values, QgsProcessingContext())[0]
    finally:
        remove(dialog)
    assert values["INPUT"] == str(scene.path)
    assert values["TO_CLASS"] == 9
    assert "DTM" in values and "HILLSHADE" in values


def test_batch_mode_takes_files(algorithm, scene, tmp_path, plugin):
    from processing.gui.BatchAlgorithmDialog import BatchAlgorithmDialog

    dialog = BatchAlgorithmDialog(algorithm)
    try:
        panel = dialog.mainWidget()
        assert panel.batchRowCount() == 1
        columns = [definition.name() for definition in algorithm.parameterDefinitions()]
        assert "INPUT" in columns
        wrapper = panel.wrappers[0][panel.parameter_to_column["INPUT"]]
        wrapper.setParameterValue(str(scene.path), panel.processing_context)
        assert wrapper.parameterValue() == str(scene.path)
    finally:
        remove(dialog)
