"""Refuses, before any work is done, outputs that could not be written at the end."""

from __future__ import annotations

from pathlib import Path
from typing import Callable, Iterable, Sequence

from ..core.errors import BareEarthError
from ..core.files import Outputs, check_distinct, check_output
from ..las.writing import check_writable
from ..rasters.virtual import folder_of, virtual_of
from ..rasters.writing import check_raster
from .feature_files import feature_writer, files_beside
from .vpc import check_vpc


def check_outputs(wanted: Iterable[tuple[str, Path]], sources: Sequence[Path] = ()) -> None:
    """Refuse outputs of a run, given their kinds and paths, if `check_kind` refuses one, or if two
    are the same file.
    """
    outputs = list(wanted)
    check_distinct(path for _, path in outputs)
    for kind, path in outputs:
        check_kind(kind, path, sources)


def check_kind(kind: str, path: Path, sources: Sequence[Path] = ()) -> None:
    """Refuse an output that has an unsuitable name or folder, is a source or in use, or has a
    format whose library is missing.
    """
    if kind == "folder":
        # A run makes it if its own folder exists.
        if not path.exists():
            check_output(path)
        return
    if kind == "points" and not path.suffix:
        if path.exists():
            raise BareEarthError(f"Cannot write {path}: it exists already. Choose a new folder.")
        check_output(path)
        return
    if kind == "list":
        check_vpc(path)
        # It may be in the folder that a run makes.
        if path.parent.parent.is_dir() and not path.parent.exists():
            return
    check_output(path, tuple(sources))
    _FORMATS[kind](path)
    if kind == "raster set":
        check_output(virtual_of(path), tuple(sources))
        folder = folder_of(path)
        if folder.exists() and not folder.is_dir():
            raise BareEarthError(f"Cannot write into {folder}: it is a file. Rename it.")


def place(outputs: Outputs, kind: str, path: Path) -> Path:
    """Return the path where an output is written until the run ends; files that describe an old
    output, such as statistics, are removed at the end.
    """
    if kind == "features":
        return outputs.files(path, files_beside(path))
    if kind == "points" and not path.suffix:
        return outputs.files(path)
    # With the statistics of the old cells, QGIS would stretch the colours of the new cells.
    return outputs.file(path, [f"{path.name}.aux.xml"] if kind == "raster" else [])


def _check_page(path: Path) -> None:
    if path.suffix.lower() not in (".html", ".htm"):
        raise BareEarthError(f"Cannot write {path}: the page is HTML, name it .html.")


def _check_table(path: Path) -> None:
    if path.suffix.lower() != ".csv":
        raise BareEarthError(f"Cannot write {path}: the table is CSV, name it .csv.")


def _check_points(path: Path) -> None:
    if path.suffix.lower() != ".laz":
        raise BareEarthError(
            f"Cannot write {path}: name it .copc.laz or .laz, or give a new folder for several"
            " files."
        )
    check_writable(path)


# Functions that refuse a name, or a format without its library, by kinds of outputs.
_FORMATS: dict[str, Callable[[Path], object]] = {
    "cloud": check_writable,
    "features": feature_writer,
    "list": check_vpc,
    "page": _check_page,
    "points": _check_points,
    "raster": check_raster,
    "raster set": check_raster,
    "table": _check_table,
}
