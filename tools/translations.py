"""Writes what there is to translate into plugin/i18n/*.ts, and the .qm files that QGIS reads.

Translations that are there stay, those of texts that are gone go. Runs beside QGIS, as `make
translations` does: the texts of fields are those that the algorithms ask for.
"""

from __future__ import annotations

import ast
import os
import sys
from pathlib import Path
from xml.sax.saxutils import escape

import qm

ROOT = Path(__file__).parents[1]
FILES = sorted((ROOT / "plugin" / "i18n").glob("*.ts"))
# The functions of plugin/i18n that get the texts.
_FUNCTIONS = ("tr", "mark")


def written_texts() -> set[str]:
    """Return the texts that the code of the plugin asks for by name, of rasters and of reviews."""
    from bare_earth.algorithms.tools.review import reasons

    found = _raster_texts() | set(reasons.TEXTS)
    for path in (ROOT / "plugin").rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") in _FUNCTIONS:
                found |= {text.value for text in node.args if isinstance(text, ast.Constant)}
    return found


def _raster_texts() -> set[str]:
    """Return titles and legends of rasters, which stand in their rows."""
    from bare_earth.algorithms.rasters.looks import Categories
    from bare_earth.algorithms.tools.quality.rasters import QUALITY_RASTERS
    from bare_earth.algorithms.tools.rasters.rows import RASTERS

    rows = [*RASTERS.values(), *QUALITY_RASTERS.values()]
    found = {row.title for row in rows}
    # Parts of the descriptions of bands, except units; the last are those of rasters without a row.
    found |= {part for row in rows for part in row.shows.split(", ")} - {"{unit}", "1/m2"}
    found |= {"Class", "Share of wrong points"}
    styles = [row.look.style for row in rows if isinstance(row.look.style, Categories)]
    labels = {label for style in styles for _, label, _ in style.entries}
    return found | {label for label in labels if not label.isdigit()}


def asked_texts() -> set[str]:
    """Return the texts that the algorithms ask for when QGIS lists them; needs a QGIS."""
    from qgis.core import QgsApplication
    from qgis.PyQt.QtCore import QCoreApplication, QTranslator

    from bare_earth.plugin import i18n

    asked = set()

    class Recorder(QTranslator):
        def translate(self, context, text, disambiguation=None, n=-1):
            if context == "BareEarth":
                asked.add(text)
            return None

    recorder = Recorder()
    QCoreApplication.installTranslator(recorder)
    provider = QgsApplication.processingRegistry().providerById("bareearth")
    for algorithm in provider.algorithms():
        visible_texts(algorithm.create())
        i18n.tr(algorithm.tool.run_name if hasattr(algorithm, "tool") else "")  # of layers
    QCoreApplication.removeTranslator(recorder)
    return asked


def visible_texts(algorithm) -> list[str]:
    """Return the texts in the user's language that an algorithm shows before it runs."""
    texts = [algorithm.displayName(), algorithm.group(), algorithm.shortDescription()]
    texts += algorithm.tags()
    for field in algorithm.parameterDefinitions():
        texts += [field.description(), *field.metadata().get("labels", [])]
    return texts + [field.description() for field in algorithm.outputDefinitions()]


def update(path: Path, texts: set[str]) -> int:
    """Write a .ts file with these texts; return how many of them have no translation yet."""
    known = {message.source: message.translation for message in qm.read_ts(path.read_bytes())}
    language = path.stem.rpartition("_")[2]
    lines = [
        '<?xml version="1.0" encoding="utf-8"?>', "<!DOCTYPE TS>",
        f'<TS version="2.1" language="{language}" sourcelanguage="en">', "<context>",
        "    <name>BareEarth</name>",
    ]  # fmt: skip
    for text in sorted(texts):
        state = "" if known.get(text) else ' type="unfinished"'
        lines += [
            "    <message>",
            f"        <source>{escape(text)}</source>",
            f"        <translation{state}>{escape(known.get(text, ''))}</translation>",
            "    </message>",
        ]
    lines += ["</context>", "</TS>", ""]
    path.write_bytes("\n".join(lines).encode())
    path.with_suffix(".qm").write_bytes(qm.compiled(qm.read_ts(path.read_bytes())))
    return sum(not known.get(text) for text in texts)


def main() -> None:
    """Update all files."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    from qgis.core import QgsApplication

    application = QgsApplication([], False)
    application.initQgis()
    # Outputs of the models are known only when the algorithms of Processing are registered.
    sys.path.append(str(Path(application.pkgDataPath()) / "python" / "plugins"))
    from processing.core.Processing import Processing

    from bare_earth import classFactory

    Processing.initialize()
    plugin = classFactory(None)
    plugin.initProcessing()
    texts = written_texts() | asked_texts()
    for path in FILES:
        print(f"{path.relative_to(ROOT)}: {len(texts)} texts, {update(path, texts)} to translate")
    plugin.unload()


if __name__ == "__main__":
    main()
