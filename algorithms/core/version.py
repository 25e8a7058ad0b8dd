"""The version of the package, which stands in `metadata.txt`, where QGIS reads it."""

from pathlib import Path

_METADATA = Path(__file__).parents[2] / "metadata.txt"
__version__ = _METADATA.read_text(encoding="utf-8").partition("\nversion=")[2].split("\n")[0]
