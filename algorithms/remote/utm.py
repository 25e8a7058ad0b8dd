"""Transforms points in Web Mercator, such as those of 3DEP, to UTM, where lengths are right."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import temporary_folder
from ..core.points import Box
from ..core.progress import SILENT, Progress
from ..core.words import option
from ..crs.measurable import length_scale, wrong_lengths
from ..crs.provider import library, to_wgs84, transformed
from ..crs.stated import stated_wkt
from ..crs.system import Crs
from ..crs.wkt import read_wkt
from ..las import header as fields
from ..las.crs_records import CRS_RECORDS, WKT_RECORD
from ..las.edits import Edits
from ..las.header_edits import with_fields, with_statistics
from ..las.lasfile import LASZIP, LasFile, new_vlr
from ..las.opening import open_las
from ..las.records import HeaderCounts, column, read_records
from ..las.writing import write_changed

STATED = "stated"  # the word for the unit of heights that the CRS states
# The units of heights that a user can name, in metres.
HEIGHT_UNITS = {"metre": 1.0, "foot": 0.3048, "us-foot": 1200 / 3937}
_WKT = 0x10  # in the global encoding


@dataclass(frozen=True)
class Utm:
    """A transformation of points to a zone of UTM, and of their heights to metres."""

    source: str  # CRS of the points, as well-known text or code
    zone: str  # CRS of the zone, such as "EPSG:32618"
    height_unit: float  # unit of the heights in metres

    def write(self, source: Path, target: Path, progress: Progress = SILENT) -> None:
        """Write a LAZ file of points in this zone."""
        old = open_las(source)
        middle = np.mean([old.minimum[:2], old.maximum[:2]], axis=0)
        offset = np.floor(self._moved(middle[None])[0]).tolist()
        height = [old.scale[2] * self.height_unit, old.offset[2] * self.height_unit]
        vlrs = [vlr for vlr in old.vlrs if vlr.key not in (LASZIP, *CRS_RECORDS)]
        text = (stated_wkt(self.zone) or "").encode() + b"\0"
        vlrs.append(new_vlr(WKT_RECORD, text, "OGC WKT Coordinate System"))
        layout = with_fields(
            replace(old, vlrs=tuple(vlrs), padding=b"", evlrs=()),
            (fields.SCALE, [*old.scale[:2], height[0]]),
            (fields.OFFSET, [*offset, height[1]]),
            (fields.GLOBAL_ENCODING, [old.global_encoding | _WKT]),
        )
        with temporary_folder(target.parent) as folder:
            self._write_plain(old, layout, folder / "points.las", progress.part(0.0, 0.5))
            write_changed(folder / "points.las", target, Edits(), progress.part(0.5, 1.0))

    def _write_plain(self, old: LasFile, layout: LasFile, path: Path, progress: Progress) -> None:
        counts, done = HeaderCounts(layout), 0
        with open(path, "w+b") as file:
            file.write(layout.prefix(layout.vlrs, compressed=False))
            for records in read_records(old):
                axes = [column(records, 4 * axis, "<i4") for axis in (0, 1)]
                places = np.column_stack(axes) * old.scale[:2] + old.offset[:2]
                steps = (self._moved(places) - layout.offset[:2]) / layout.scale[:2]
                for axis, whole in zip(axes, np.rint(steps).T):
                    axis[:] = whole
                counts.add(records)
                file.write(records.data)
                done += len(records)
                progress(done / old.count)
            layout = with_statistics(
                layout, counts.lowest.tolist(), counts.highest.tolist(), counts.returns.tolist()
            )
            file.seek(0)
            file.write(layout.prefix(layout.vlrs, compressed=False))

    def _moved(self, places: np.ndarray) -> np.ndarray:
        moved = transformed(self.source, self.zone, places)
        if moved is None:
            raise BareEarthError(f"The points cannot be transformed to {self.zone}.")
        return moved


def states_height_unit(crs: Crs) -> bool:
    """Return whether a CRS states the unit of heights."""
    facts = read_wkt(crs.wkt or "")
    return facts is not None and bool(facts.vertical_unit)


def utm_of(name: str, crs: Crs, box: Box, height_unit: str) -> Utm | None:
    """Return the transformation to UTM of points in Web Mercator, None if lengths in their CRS are
    right; refuse heights whose unit is not known.
    """
    source = crs.wkt or f"EPSG:{crs.epsg}"
    if not wrong_lengths(length_scale(crs, box)):
        return None
    if library() is None:
        raise BareEarthError("Points are transformed to UTM by pyproj: pip install pyproj.")
    if height_unit == STATED and not states_height_unit(crs):
        raise BareEarthError(
            f"{name} does not state the unit of its heights. Look it up in the report of the"
            f" survey, and give it with {option('height_unit', of='fetch')}: metre, foot or"
            " us-foot."
        )
    west, south, east, north = box
    degrees = to_wgs84(source, np.array([[(west + east) / 2.0, (south + north) / 2.0]]))
    if degrees is None or abs(degrees[0, 1]) > 84.0:
        raise BareEarthError(f"There is no zone of UTM for {name}.")
    zone = min(int((degrees[0, 0] + 180.0) // 6.0) + 1, 60)
    metres = HEIGHT_UNITS.get(height_unit, crs.vertical_unit)
    return Utm(source, f"EPSG:{32600 + zone if degrees[0, 1] >= 0.0 else 32700 + zone}", metres)
