"""The CRS of the points of a run: what the user states, or what the files do."""

from __future__ import annotations

import functools
from contextlib import suppress
from pathlib import Path

from qgis.core import QgsCoordinateReferenceSystem

from ...algorithms.core.errors import BareEarthError
from ...algorithms.crs.system import Crs
from ...algorithms.las.crs_records import read_crs
from ...algorithms.las.opening import open_las
from ...algorithms.survey.files import find_files, open_survey
from .. import compat


class CloudCrs:
    """The CRS of the point clouds of a run, stated by the user or read when it is first needed."""

    def __init__(self, *sources: Path, recursive: bool = False, stated: str | None = None) -> None:
        self._sources, self._recursive, self.stated = sources, recursive, stated

    @property
    def is_known(self) -> bool:
        """Whether it is stated, or there are files; remote points are not here yet."""
        return bool(self.stated or self._sources)

    @functools.cached_property
    def value(self) -> QgsCoordinateReferenceSystem:
        """The CRS, or if no file states one, an invalid one, so that nothing is transformed."""
        if self.stated:
            return QgsCoordinateReferenceSystem(self.stated)
        crs = self._of_files()
        if crs.epsg:
            return QgsCoordinateReferenceSystem.fromEpsgId(crs.epsg)
        return QgsCoordinateReferenceSystem.fromWkt(crs.wkt or "")

    def _of_files(self) -> Crs:
        """Return the CRS of the first file that states one; all files must have the same."""
        paths = find_files(self._sources, self._recursive)
        for path in paths:
            with suppress(BareEarthError):  # The run reports files that cannot be read.
                crs = read_crs(open_las(path))
                if crs != Crs():
                    return crs
        return open_survey(paths).crs  # This raises an error if no file can be read.


def text_of(crs: QgsCoordinateReferenceSystem) -> str:
    """Return a known CRS as code, or else as well-known text."""
    return crs.authid() if crs.authid().startswith("EPSG:") else crs.toWkt(compat.WKT)
