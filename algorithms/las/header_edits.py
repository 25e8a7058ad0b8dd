"""Changes of the header that follow from changes of the points."""

from __future__ import annotations

from dataclasses import replace
from typing import Sequence

from . import header as fields
from .lasfile import LasFile

_LEGACY_RETURN_COUNT, _LAST_LEGACY_FORMAT = 5, 5


def with_record_length(layout: LasFile, length: int) -> LasFile:
    """Return the layout with another record length."""
    header = bytearray(layout.header)
    fields.RECORD_LENGTH.put(header, length)
    return replace(layout, header=bytes(header))


def with_z_offset(layout: LasFile, offset: float) -> LasFile:
    """Return the layout with another offset of z."""
    header = bytearray(layout.header)
    fields.OFFSET.put(header, *layout.offset[:2], offset)
    return replace(layout, header=bytes(header))


def with_z_range(layout: LasFile, lowest: int, highest: int) -> LasFile:
    """Return the layout with another range of heights, given as integers."""
    header, scale, offset = bytearray(layout.header), layout.scale[2], layout.offset[2]
    extent = highest * scale + offset, lowest * scale + offset
    fields.Z_EXTENT.put(header, *extent)
    return replace(layout, header=bytes(header))


def with_count(layout: LasFile, count: int) -> LasFile:
    """Return the layout with another number of points; see `with_statistics` for the rest."""
    header = bytearray(layout.header)
    legacy = layout.minor_version < 4 or layout.point_format <= _LAST_LEGACY_FORMAT
    fields.LEGACY_COUNT.put(header, count if legacy and count < 1 << 32 else 0)
    if layout.minor_version >= 4:
        fields.COUNT.put(header, count)
    return replace(layout, header=bytes(header))


def with_statistics(
    layout: LasFile, lowest: Sequence[int], highest: Sequence[int], returns: Sequence[int]
) -> LasFile:
    """Return the layout with another extent (x, y and z as integers), and other numbers of first,
    second, ... returns, fifteen of them.
    """
    header = bytearray(layout.header)
    extent = [
        end[axis] * layout.scale[axis] + layout.offset[axis]
        for axis in range(3)
        for end in (highest, lowest)
    ]
    fields.EXTENT.put(header, *extent)
    legacy = layout.minor_version < 4 or layout.point_format <= _LAST_LEGACY_FORMAT
    old = [each if legacy and each < 1 << 32 else 0 for each in returns[:_LEGACY_RETURN_COUNT]]
    fields.LEGACY_RETURNS.put(header, *old)
    if layout.minor_version >= 4:
        fields.RETURNS.put(header, *returns)
    return replace(layout, header=bytes(header))
