"""Writes checkpoints with their errors: as a page, a table and a layer of points."""

from __future__ import annotations

import csv
import io
from pathlib import Path
from typing import Any, Iterator, NamedTuple

import numpy as np

from ...core.errors import BareEarthError, printable
from ...core.files import Outputs, check_distinct, check_output
from ...core.progress import SILENT, Progress
from ...report.page import check_page
from ...survey.feature_files import Feature, Layer, check_features, feature_writer, files_beside
from ...survey.files import Survey
from .checkpoints import Checkpoints
from .page import checkpoint_html
from .results import Check, Residuals

# Fields of the layer. Heights are in the unit of the points, errors in metres.
FIELDS: dict[str, type] = {
    "NAME": str, "COVER": str, "KIND": str, "STATE": str, "Z": float, "GROUND": float,
    "ERROR": float, "DTM": float, "DTM_ERROR": float,
}  # fmt: skip


class CheckOutputs(NamedTuple):
    """The files to write, each of which can be None.

    Attributes
    ----------
    report : Path
        A web page (.html).
    table : Path
        A table of all checkpoints (.csv).
    residuals : Path
        The checkpoints with their errors as points (.gpkg, .geojson, .shp or .fgb).
    """

    report: Path | None = None
    table: Path | None = None
    residuals: Path | None = None

    def check(self, sources: tuple[Path, ...], checkpoints: Checkpoints | None) -> None:
        """Refuse, before any work is done, files that could not be written at the end.

        Raises
        ------
        BareEarthError
            If a name or folder is unsuitable, or there is nothing to write.
        """
        check_distinct(self)
        if checkpoints is None and (self.table or self.residuals):
            raise BareEarthError(
                "Points that are held out have no table and no layer, only a page. Give"
                " checkpoints."
            )
        if self.report:
            check_page(self.report, sources)
        if self.table:
            check_output(self.table, sources)
            if self.table.suffix.lower() != ".csv":
                raise BareEarthError(f"Cannot write {self.table}: the table is CSV, name it .csv.")
        if self.residuals:
            check_features(self.residuals, sources)

    def write(
        self, check: Check, found: Residuals | None, survey: Survey, progress: Progress = SILENT
    ) -> None:
        """Write the files: all of them or none.

        Parameters
        ----------
        check : Check
            The figures.
        found : Residuals or None
            The checkpoints with their errors.
        survey : Survey
            The files that were checked.
        progress : Progress
            Receives progress and messages.

        Raises
        ------
        BareEarthError
            If a file cannot be written.
        """
        with Outputs() as outputs:
            if self.residuals and found is not None:
                layer = outputs.files(self.residuals, files_beside(self.residuals))
                _write_layer(layer, found, survey, progress)
            if self.table and found is not None:
                table = outputs.file(self.table)
                # Excel knows by the byte order mark that it is UTF-8.
                with open(table, "w", encoding="utf-8-sig", newline="") as file:
                    file.write(_table_of(found))
            if self.report:
                page = outputs.file(self.report)
                page.write_text(checkpoint_html(check, found, survey), encoding="utf-8")
            progress(1.0)  # the last moment to cancel


def _rows_of(found: Residuals) -> Iterator[tuple[Any, ...]]:
    """Yield x, y, and the values of `FIELDS` of each checkpoint."""
    points = found.checkpoints
    rounded = [np.round(each, 4).tolist() for each in (
        found.ground, found.errors, found.dtm, found.dtm_errors)]  # fmt: skip
    places = points.xyz.tolist()
    for place, *others in zip(
        places, points.names, found.written, found.kinds, found.states, *rounded
    ):
        yield (*place[:2], *others[:4], place[2], *others[4:])


def _write_layer(target: Path, found: Residuals, survey: Survey, progress: Progress) -> None:
    layer = Layer("checkpoints", "Point Z", FIELDS, survey.crs.wkt, survey.crs.epsg)
    places = found.checkpoints.places
    features = (Feature(row[2:], place) for row, place in zip(_rows_of(found), places))
    feature_writer(target)(target, features, layer, progress)


def _table_of(found: Residuals) -> str:
    """Return the table as CSV, with empty cells where there is no value."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["x", "y", *map(str.lower, FIELDS)])
    for row in _rows_of(found):
        writer.writerow(["" if each != each else _cell(each) for each in row])
    return text.getvalue()


def _cell(value: Any) -> Any:
    """Return a value for a cell; a name must not look like a formula to a spreadsheet."""
    if not isinstance(value, str):
        return value
    value = printable(value)
    return f"'{value}" if value[:1] in ("=", "+", "-", "@") else value
