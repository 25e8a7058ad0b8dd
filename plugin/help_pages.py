"""Addresses of help pages: in the plugin, or else in its repository."""

from __future__ import annotations

import configparser
from pathlib import Path

from qgis.PyQt.QtCore import QUrl

_ROOT = Path(__file__).parents[1]
# Only in the package, made by `make package`; not in a clone of the repository.
_HELP = _ROOT / "help"


def address_of(page: str) -> str:
    """Return the address of a page of docs/, named without ending, perhaps with a section."""
    name, mark, section = page.partition("#")
    anchor = mark + section
    file = _HELP / f"{name}.html"
    if file.is_file():
        return QUrl.fromLocalFile(str(file)).toString() + anchor
    metadata = configparser.ConfigParser(interpolation=None)
    metadata.read(_ROOT / "metadata.txt", encoding="utf-8")
    return f"{metadata['general']['repository']}/blob/main/docs/{name}.md{anchor}"
