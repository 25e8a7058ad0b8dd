"""The texts of the plugin in the user's language.

In the code they are English. `tr` translates a text when it is shown, and texts of fields and
declared parameters when the fields are made. `make translations` collects all texts in the files
bare_earth_*.ts for translators. `make package` compiles these for Qt (.qm).
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


def number(value: float) -> str:
    """Return a number as the user's language writes it, if the plugin speaks that language."""
    text = f"{value:g}"
    if QCoreApplication is None:
        return text
    language = _language()
    is_spoken = any(_FOLDER.glob(f"bare_earth_{language.name()[:2]}.*"))
    return text.replace(".", language.decimalPoint()) if is_spoken else text


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
