"""Our algorithms in the window where models are drawn."""

import pytest
from qgis.core import (
    QgsProcessingContext,
    QgsProcessingModelAlgorithm,
    QgsProcessingModelParameter,
    QgsProcessingParameterFile,
    QgsProcessingParameterPointCloudLayer,
)
from qgis.PyQt.QtWidgets import QComboBox, QToolButton
from support import ALGORITHM, remove

CLOUDS = {
    "tindensification": ["INPUT"],
    "gridminimum": ["INPUT"],
    "slopefilter": ["INPUT"],
    "pointcloudtoterrain": ["INPUT"],
    "terrainmodel": ["INPUT"],
    "heightaboveground": ["INPUT"],
    "classifyaboveground": ["INPUT"],
    "waterclasses": ["INPUT"],
    "modelkeypoints": ["INPUT"],
    "comparesettings": ["INPUT"],
    "assess": ["CLASSIFIED", "REFERENCE"],
}


@pytest.fixture
def model():
    """A model that has a file and a layer as inputs, and nothing in it."""
    model = QgsProcessingModelAlgorithm("Model", "tests")
    for field in (
        QgsProcessingParameterFile("file", "A file"),
        QgsProcessingParameterPointCloudLayer("layer", "A layer"),
    ):
        model.addModelParameter(field, QgsProcessingModelParameter(field.name()))
    return model


@pytest.fixture
def designer(model, registry):
    """What opens the window for an algorithm in the model; those that are there are closed."""
    from processing.modeler.ModelerParametersDialog import ModelerParametersDialog

    dialogs = []

    def opened(name, child_id=None):
        algorithm = registry.createAlgorithmById(name)
        dialogs.append(ModelerParametersDialog(algorithm, model, child_id))
        return dialogs[-1]

    yield opened
    for dialog in dialogs:
        remove(dialog)


def field_of(dialog, name):
    return dialog.widget.widget.wrappers[name]


def choose(field, kind, label):
    """Choose what a field takes, and of that the one with a label, as a mouse would."""
    menu = next(widget for widget in field.findChildren(QToolButton) if widget.menu()).menu()
    menu.aboutToShow.emit()
    next(action for action in menu.actions() if action.text() == kind).trigger()
    box = next(widget for widget in field.findChildren(QComboBox) if widget.findText(label) >= 0)
    box.setCurrentIndex(box.findText(label))


def add(model, dialog):
    child = dialog.createAlgorithm()
    model.addChildAlgorithm(child)
    return child.childId()


def test_the_window_opens_for_every_algorithm(registry, designer):
    for algorithm in registry.providerById("bareearth").algorithms():
        names = [definition.name() for definition in algorithm.parameterDefinitions()]
        dialog = designer(algorithm.id())
        assert all(field_of(dialog, name) is not None for name in names)


@pytest.mark.parametrize("source", ["A file", "A layer"])
@pytest.mark.parametrize("name", CLOUDS)
def test_files_and_layers_can_be_wired(name, source, model, designer):
    dialog = designer(f"bareearth:{name}")
    for field in CLOUDS[name]:
        choose(field_of(dialog, field), "Model Input", source)
    sources = dialog.createAlgorithm().parameterSources()
    for field in CLOUDS[name]:
        assert [path.parameterName() for path in sources[field]] == [source[2:]]


def test_files_can_be_wired_to_the_many(model, designer):
    dialog = designer("bareearth:classifytiles")
    choose(field_of(dialog, "INPUT_FOLDER"), "Model Input", "A file")
    sources = dialog.createAlgorithm().parameterSources()
    assert sources["INPUT_FOLDER"][0].parameterName() == "file"


def test_choices_are_kept(model, designer):
    dialog = designer(ALGORITHM)
    choose(field_of(dialog, "INPUT"), "Model Input", "A file")
    choose(field_of(dialog, "PRESET"), "Value", "steep")
    child = add(model, dialog)
    sources = model.childAlgorithm(child).parameterSources()
    assert sources["PRESET"][0].staticValue() == "steep"
    # The window opened again shows them, and gives them back.
    again = designer(ALGORITHM, child)
    again.setPreviousValues()
    sources = again.createAlgorithm().parameterSources()
    assert sources["PRESET"][0].staticValue() == "steep"
    assert sources["INPUT"][0].parameterName() == "file"


def test_what_is_drawn_runs(model, designer, scene, log):
    dialog = designer(ALGORITHM)
    choose(field_of(dialog, "INPUT"), "Model Input", "A file")
    classify = add(model, dialog)
    dialog = designer("bareearth:heightaboveground")
    boxes = field_of(dialog, "INPUT").findChildren(QComboBox)
    labels = [box.itemText(i) for box in boxes for i in range(box.count())]
    (label,) = (text for text in labels if "Classified point cloud" in text)
    choose(field_of(dialog, "INPUT"), "Algorithm Output", label)
    heights = add(model, dialog)
    results, done = model.create().run({"file": str(scene.path)}, QgsProcessingContext(), log)
    assert done, log.text
    children = results["CHILD_RESULTS"]
    assert children[classify]["GROUND_COUNT"] == scene.ground_count
    assert children[heights]["POINT_COUNT"] == scene.count
    (source,) = model.childAlgorithm(heights).parameterSources()["INPUT"]
    assert (source.outputChildId(), source.outputName()) == (classify, "OUTPUT")
