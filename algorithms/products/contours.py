"""Contour lines of a terrain model, made with GDAL."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from ..core.errors import BareEarthError
from ..core.files import check_output, replace_with_files_of, temporary_folder
from ..core.parameters import ParameterSet, parameter
from ..core.progress import SILENT, Progress
from ..rasters.libraries import GdalErrors

# A map with about so many lines is easy to read.
_LINES = 20
_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)
# A smaller interval would show noise.
_LEAST = 0.25
# One of so many lines is drawn thick.
INDEX = 5
# The formats that QGIS offers first, and their names in GDAL.
_DRIVERS = {".gpkg": "GPKG", ".shp": "ESRI Shapefile", ".geojson": "GeoJSON", ".fgb": "FlatGeobuf"}
CONTOUR_FORMATS = tuple(_DRIVERS)
# Further files of these formats. Old indices and journals would do harm to new lines.
_BESIDE = {
    ".shp": (".dbf", ".shx", ".prj", ".cpg", ".qpj", ".qix", ".sbn", ".sbx"),
    ".gpkg": (".gpkg-wal", ".gpkg-shm", ".gpkg-journal"),
}


@dataclass(frozen=True)
class Contours(ParameterSet):
    """How contour lines are drawn."""

    contour_interval: float | None = parameter(
        None,
        kind="number",
        label="Contour interval",
        unit="m or ft",
        minimum=0.001,
        maximum=10_000.0,
        advanced=True,
        empty="automatic",
        help="The height between contour lines, in the vertical unit of the CRS. Empty: a value"
        f" that gives about {_LINES} lines.",
    )

    def interval(self, low: float, high: float) -> float:
        """Return the interval for terrain between two heights.

        >>> Contours().interval(130.0, 172.0)
        2.0
        >>> Contours(contour_interval=0.3).interval(130.0, 172.0)
        0.3
        """
        if self.contour_interval is not None:
            return self.contour_interval
        wanted = max((high - low) / _LINES, _LEAST)
        power = 10.0 ** math.floor(math.log10(wanted))
        return min((step * power for step in _STEPS), key=lambda each: abs(each - wanted))


class Interval(NamedTuple):
    """The height between contour lines.

    Attributes
    ----------
    height : float
        In the unit of the raster.
    unit : str
        Symbol of that unit; empty if the raster does not state it.
    """

    height: float
    unit: str = ""

    def text(self, lines: int = 1) -> str:
        """Return the height between a number of lines, with its unit.

        >>> Interval(2.0, "m").text(5)
        '10 m'
        """
        return f"{lines * self.height:g} {self.unit}".rstrip()


def check_contour_output(target: Path, sources: tuple[Path, ...] = ()) -> None:
    """Refuse, before any work is done, contour lines that could not be written at the end.

    Raises
    ------
    BareEarthError
        If the format is unknown, or as for `check_output`.
    """
    if target.suffix.lower() not in _DRIVERS:
        formats = ", ".join(_DRIVERS)
        raise BareEarthError(f"Cannot write {target}: name it with one of the endings {formats}.")
    check_output(target, sources)


def write_contours(
    source: Path, target: Path, contours: Contours = Contours(), progress: Progress = SILENT
) -> Interval:
    """Write the contour lines of a raster, each with its height in the field ELEV.

    Parameters
    ----------
    source : Path
        The raster of heights.
    target : Path
        The file to make: .gpkg, .shp, .geojson or .fgb.
    contours : Contours
        The interval.
    progress : Progress
        Receives progress and messages.

    Returns
    -------
    Interval
        The height between the lines.

    Raises
    ------
    BareEarthError
        If GDAL is missing or cannot write the lines; nothing is left behind.
    """
    try:
        from osgeo import gdal
    except ImportError:
        raise BareEarthError("Contour lines need GDAL with Python, which QGIS has.") from None
    target = Path(target)
    check_contour_output(target)
    raster = gdal.Open(str(source))
    band = raster.GetRasterBand(1)
    # The description that `write_geotiff` gives to bands of terrain models.
    unit = band.GetDescription().partition(", ")[2]
    interval = Interval(contours.interval(*band.ComputeRasterMinMax(False)), unit)
    with temporary_folder(target.parent) as folder:
        with GdalErrors(gdal, "write") as errors:
            count = _draw(raster, folder / target.name, interval.height)
            errors.check(target)
        progress.info(f"{count:,} contour lines, one every {interval.text()}")
        progress(1.0)
        suffix = target.suffix.lower()
        beside = [f"{target.stem}{each}" for each in _BESIDE.get(suffix, ())]
        replace_with_files_of(folder, target, beside)
    return interval


def _draw(raster: Any, target: Path, interval: float) -> int:
    """Write the lines to a new file; return how many there are."""
    from osgeo import gdal, ogr

    band = raster.GetRasterBand(1)
    options = [f"LEVEL_INTERVAL={interval}", "ID_FIELD=0", "ELEV_FIELD=1"]
    options += [f"NODATA={band.GetNoDataValue()}"] if band.GetNoDataValue() is not None else []
    made = ogr.GetDriverByName(_DRIVERS[target.suffix.lower()]).CreateDataSource(str(target))
    if made is None:
        return 0
    lines = made.CreateLayer("contours", raster.GetSpatialRef(), ogr.wkbLineString)
    lines.CreateField(ogr.FieldDefn("ID", ogr.OFTInteger))
    lines.CreateField(ogr.FieldDefn("ELEV", ogr.OFTReal))
    # One transaction, since a GeoPackage would otherwise commit each line.
    lines.StartTransaction()
    gdal.ContourGenerateEx(band, lines, options=options)
    lines.CommitTransaction()
    return lines.GetFeatureCount()
