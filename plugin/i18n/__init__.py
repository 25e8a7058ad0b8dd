"""The texts of the plugin in the user's language.

They are English in the code, which asks for each by `tr` when it is shown; those of fields, also of
declared parameters, where the fields are made. `make translations` looks for all of them and writes
the files bare_earth_*.ts, for translators; `make package` makes of them what Qt reads (.qm).
"""

from __future__ import annotations

from pathlib import Path

try:
    from qgis.core import QgsApplication
    from qgis.PyQt.QtCore import QCoreApplication, QLocale, QTranslator
except ImportError:  # what gets lazrs works without QGIS, too
    QCoreApplication = None

CONTEXT = "BareEarth"
_FOLDER = Path(__file__).parent


def tr(text: str) -> str:
    """Return a text in the user's language, or as it is where there is no translation."""
    if QCoreApplication is None or not text:
        return text
    return QCoreApplication.translate(CONTEXT, text)


def mark(text: str) -> str:
    """Return a text as it is; `tr` gets it later, when it is shown."""
    return text


def install(folder: Path = _FOLDER) -> QTranslator | None:
    """Let `tr` find the translations into the language of QGIS.

    Returns
    -------
    QTranslator or None
        To be kept, and removed in the end; None if there are no translations.
    """
    translator = QTranslator()
    language = QLocale(QgsApplication.instance().locale())
    if not translator.load(language, "bare_earth", "_", str(folder)):
        return None
    QCoreApplication.installTranslator(translator)
    return translator
