"""Dialogs on a small screen: no button leaves it."""

import pytest
from qgis.core import QgsApplication
from qgis.PyQt.QtWidgets import QComboBox, QScrollArea
from support import remove

# The width that QGIS gives a dialog, and the height of a small screen.
WIDTH, HEIGHT = 688, 600


def dialogs(registry):
    """Yield all dialogs, with all settings chosen where some can be compared."""
    from processing.gui.AlgorithmDialog import AlgorithmDialog

    for algorithm in registry.providerById("bareearth").algorithms():
        dialog = AlgorithmDialog(registry.createAlgorithmById(algorithm.id()))
        settings = dialog.mainWidget().wrappers.get("SETTINGS")
        if settings:
            dialog.setParameters({"SETTINGS": list(settings.parameterDefinition().options())})
        dialog.resize(WIDTH, HEIGHT)
        dialog.show()
        QgsApplication.processEvents()
        try:
            yield algorithm.id(), dialog
        finally:
            remove(dialog)


def test_all_dialogs_fit(registry):
    for name, dialog in dialogs(registry):
        least = dialog.minimumSizeHint()
        assert least.width() <= WIDTH and least.height() <= HEIGHT, name
        for area in dialog.findChildren(QScrollArea):
            if area.widget() and area.isVisible():
                bar = area.verticalScrollBar().sizeHint().width()
                wanted = area.widget().minimumSizeHint().width()
                assert wanted <= area.width() - bar, f"{name}: {wanted} of {area.width()}"


@pytest.mark.rest
@pytest.mark.parametrize("locale", ["de", "fr"])
def test_long_choices_do_not_make_a_dialog_wide(registry, speak, locale):
    # Labels above fields are wider in these languages, QGIS's own ones too.
    speak(locale)
    for name, dialog in dialogs(registry):
        for wrapper in dialog.mainWidget().wrappers.values():
            widget = getattr(wrapper, "wrappedWidget", lambda: None)()
            if isinstance(widget, QComboBox):
                assert widget.minimumSizeHint().width() < WIDTH / 2, name
