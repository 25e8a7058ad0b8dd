"""Choices in dialogs show labels, and give ids."""

import pytest
from qgis.core import QgsApplication, QgsProcessingContext
from qgis.PyQt import sip
from qgis.PyQt.QtCore import QCoreApplication, QEvent, Qt
from qgis.PyQt.QtWidgets import QComboBox
from support import remove

from bare_earth.plugin.processing.request import Request

TIN = "bareearth:tindensification"


@pytest.fixture
def dialog(plugin):
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    made = []

    def dialog(name=TIN):
        made.append(AlgorithmDialog(QgsApplication.processingRegistry().createAlgorithmById(name)))
        return made[-1]

    yield dialog
    for path in made:
        remove(path)


def box_of(dialog, text):
    boxes = dialog.findChildren(QComboBox)
    return next(box for box in boxes if box.findText(text) >= 0)


def test_labels_are_shown_and_ids_given(dialog, scene):
    dialog = dialog()
    dialog.setParameters({"INPUT": str(scene.path)})
    box = box_of(dialog, "Steep or rugged terrain")
    assert box.findText("steep") < 0 and box.currentText() == "Automatic"
    box.setCurrentIndex(box.findText("Steep or rugged terrain"))
    values = dialog.createProcessingParameters()
    assert values["PRESET"] == "steep" and values["RETURNS"] == "last"


@pytest.mark.parametrize("given", ["hilly", 2, "2"])
def test_values_of_a_run_before_are_chosen(dialog, scene, given):
    dialog = dialog()
    dialog.setParameters({"INPUT": str(scene.path), "PRESET": given})
    assert box_of(dialog, "Steep or rugged terrain").currentText() == "Hilly land, forest"
    assert dialog.createProcessingParameters()["PRESET"] == "hilly"


def test_the_table_of_batch_mode_has_labels_too(plugin):
    from processing.gui.BatchAlgorithmDialog import BatchAlgorithmDialog

    algorithm = QgsApplication.processingRegistry().createAlgorithmById(TIN)
    dialog = BatchAlgorithmDialog(algorithm)
    assert box_of(dialog, "Steep or rugged terrain").currentText() == "Automatic"
    remove(dialog)


@pytest.mark.rest
@pytest.mark.parametrize("name", [TIN, "bareearth:classifytiles", "bareearth:relief"])
def test_a_saved_table_of_batch_mode_can_be_run(name, plugin):
    from processing.gui.BatchAlgorithmDialog import BatchAlgorithmDialog

    dialog = BatchAlgorithmDialog(QgsApplication.processingRegistry().createAlgorithmById(name))
    panel = dialog.mainWidget()
    # As it loads a file: rows are replaced, and the old widgets are deleted later.
    for rows in (5, 2, 9):
        panel.clear()
        panel.addRow(rows)
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        wrappers = [wrapper for row in panel.wrappers for wrapper in row if wrapper is not None]
        assert len(panel.wrappers) == rows and not any(map(sip.isdeleted, wrappers))
        for wrapper in wrappers:
            wrapper.parameterValue()
    remove(dialog)


@pytest.mark.parametrize("value", ["steep", 3, "3"])
def test_numbers_of_the_list_are_accepted(algorithm, value, scene, tmp_path):
    field = algorithm.parameterDefinition("PRESET")
    context = QgsProcessingContext()
    assert field.checkValueIsAcceptable(value, context)
    assert field.clone().checkValueIsAcceptable(value, context)
    values = {"INPUT": str(scene.path), "OUTPUT": str(tmp_path / "o.las"), "PRESET": value}
    assert algorithm.checkParameterValues(values, context) == (True, "")
    assert algorithm.sets_of(Request(algorithm, values, context))[0].preset == "steep"


@pytest.mark.parametrize("value", ["steeper", 8, "99", -1])
def test_others_are_not(algorithm, value):
    assert not algorithm.parameterDefinition("PRESET").checkValueIsAcceptable(
        value, QgsProcessingContext()
    )


COMPARE = "bareearth:comparesettings"
SETTINGS = ["tin-densification:automatic", "slope:town"]
LABELS = ["TIN densification, Automatic", "Slope filter, Town"]


@pytest.mark.parametrize("given", [SETTINGS, ",".join(SETTINGS), None])
def test_several_choices_show_labels_and_give_ids(dialog, scene, given):
    dialog = dialog(COMPARE)
    values = {
        "INPUT": str(scene.path), "OUTPUT": "a.html",
        "EXTENT": "500010,500070,5700010,5700070 [EPSG:25832]",
    }  # fmt: skip
    dialog.setParameters({**values, **({"SETTINGS": given} if given else {})})
    box = box_of(dialog, LABELS[1])
    assert box.findText("slope:town") < 0
    if given is None:
        assert len(dialog.createProcessingParameters()["SETTINGS"]) == 3
        for place in range(box.count()):
            is_chosen = box.itemText(place) in LABELS
            state = Qt.CheckState.Checked if is_chosen else Qt.CheckState.Unchecked
            box.setItemData(place, state, Qt.ItemDataRole.CheckStateRole)
    values = dialog.createProcessingParameters()
    assert values["SETTINGS"] == SETTINGS
    algorithm = QgsApplication.processingRegistry().createAlgorithmById(COMPARE)
    context = QgsProcessingContext()
    assert algorithm.checkParameterValues(values, context) == (True, "")
    assert list(algorithm.sets_of(Request(algorithm, values, context))[0].settings) == SETTINGS


def test_a_table_of_several_choices_has_labels_too(plugin):
    from processing.gui.BatchAlgorithmDialog import BatchAlgorithmDialog

    dialog = BatchAlgorithmDialog(QgsApplication.processingRegistry().createAlgorithmById(COMPARE))
    assert box_of(dialog, LABELS[1]).currentText().startswith(f"{LABELS[0]}; ")
    remove(dialog)
