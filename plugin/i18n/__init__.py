"""The texts of the plugin in the user's language.

In the code they are English. `tr` translates a text when it is shown, and labels of fields and
declared parameters when the fields are made. The help of tools and fields stays English. `make
translations` collects all texts in the files bare_earth_*.ts for translators; one without a
translation is shown in English. `make package` compiles the files for Qt (.qm).
"""

from __future__ import annotations

from pathlib import Path

try:
    from qgis.core import QgsApplication
    from qgis.PyQt.QtCore import QCoreApplication, QLocale, QTranslator
except ImportError:  # the code that installs lazrs also works without QGIS
    QCoreApplication = None

CONTEXT = "BareEarth"
_FOLDER = Path(__file__).parent


def tr(text: str) -> str:
    """Return a text in the user's language; unchanged if there is no translation."""
    if QCoreApplication is None or not text:
        return text
    return QCoreApplication.translate(CONTEXT, text)


def mark(text: str) -> str:
    """Mark a text for translation by `tr`, and return it unchanged."""
    return text


def _language() -> QLocale:
    """Return the language that QGIS speaks: that of `qgis --lang`, or of the settings."""
    application = QgsApplication.instance()
    return QLocale(application.translation() or application.locale())


def install(folder: Path = _FOLDER) -> QTranslator | None:
    """Install the translations into the language of QGIS for `tr`, if there are any; keep the
    translator, and remove it when the plugin is unloaded.
    """
    translator = QTranslator()
    if not translator.load(_language(), "bare_earth", "_", str(folder)):
        return None
    QCoreApplication.installTranslator(translator)
    return translator
