"""Dialogs on a small screen: nothing leaves it, in no language."""

import pytest
from qgis.core import QgsApplication
from qgis.PyQt.QtWidgets import QScrollArea
from support import remove

# The width that QGIS gives a dialog, and the height of a small screen.
WIDTH, HEIGHT = 688, 600


@pytest.mark.parametrize("locale", ["en", "de", "fr"])
def test_all_dialogs_fit(registry, speak, locale):
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    speak(locale)
    for each in registry.providerById("bareearth").algorithms():
        dialog = AlgorithmDialog(registry.createAlgorithmById(each.id()))
        settings = dialog.mainWidget().wrappers.get("SETTINGS")
        if settings:
            options = settings.parameterDefinition().options()
            settings.wrappedWidget()
            dialog.setParameters({"SETTINGS": list(options)})
        dialog.resize(WIDTH, HEIGHT)
        dialog.show()
        QgsApplication.processEvents()
        least = dialog.minimumSizeHint()
        assert least.width() <= WIDTH and least.height() <= HEIGHT, each.id()
        for area in dialog.findChildren(QScrollArea):
            if area.widget() and area.isVisible():
                bar = area.verticalScrollBar().sizeHint().width()
                wanted = area.widget().minimumSizeHint().width()
                assert wanted <= area.width() - bar, f"{each.id()}: {wanted} of {area.width()}"
        remove(dialog)
