"""Changes of the header that follow from changes of the points."""

from __future__ import annotations

from dataclasses import replace
from typing import Sequence

from . import header as fields
from .lasfile import LasFile

# Before LAS 1.4 a header counted the points of five returns, and point formats ended at 5.
_LEGACY_RETURN_COUNT = 5
_LAST_LEGACY_FORMAT = 5


def with_fields(layout: LasFile, *changes: tuple[fields.Field, Sequence[float]]) -> LasFile:
    """Return the layout with other values of fields of the header."""
    header = bytearray(layout.header)
    for field, values in changes:
        field.put(header, *values)
    return replace(layout, header=bytes(header))


def with_record_length(layout: LasFile, length: int) -> LasFile:
    """Return the layout with another record length."""
    return with_fields(layout, (fields.RECORD_LENGTH, [length]))


def with_z_offset(layout: LasFile, offset: float) -> LasFile:
    """Return the layout with another offset of z."""
    return with_fields(layout, (fields.OFFSET, [*layout.offset[:2], offset]))


def with_z_range(layout: LasFile, lowest: int, highest: int) -> LasFile:
    """Return the layout with another range of heights, given as integers."""
    scale, offset = layout.scale[2], layout.offset[2]
    return with_fields(
        layout, (fields.Z_EXTENT, [end * scale + offset for end in (highest, lowest)])
    )


def with_count(layout: LasFile, count: int) -> LasFile:
    """Return the layout with another number of points; see `with_statistics` for the rest."""
    counts = [(fields.LEGACY_COUNT, _legacy(layout, [count]))]
    if layout.minor_version >= 4:
        counts.append((fields.COUNT, [count]))
    return with_fields(layout, *counts)


def with_statistics(
    layout: LasFile, lowest: Sequence[int], highest: Sequence[int], returns: Sequence[int]
) -> LasFile:
    """Return the layout with another extent (x, y and z as integers), and other numbers of points
    by return number, from 1 to 15.
    """
    extent = [
        end[axis] * layout.scale[axis] + layout.offset[axis]
        for axis in range(3)
        for end in (highest, lowest)
    ]
    changes: list[tuple[fields.Field, Sequence[float]]] = [(fields.EXTENT, extent)]
    changes.append((fields.LEGACY_RETURNS, _legacy(layout, returns[:_LEGACY_RETURN_COUNT])))
    if layout.minor_version >= 4:
        changes.append((fields.RETURNS, returns))
    return with_fields(layout, *changes)


def _legacy(layout: LasFile, counts: Sequence[int]) -> list[int]:
    """Return counts for the fields before LAS 1.4, or 0 for counts that do not fit into them."""
    has_legacy = layout.minor_version < 4 or layout.point_format <= _LAST_LEGACY_FORMAT
    return [count if has_legacy and count < 1 << 32 else 0 for count in counts]
