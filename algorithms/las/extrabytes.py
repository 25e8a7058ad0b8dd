"""Extra bytes: values of each point beyond its point format.

A record describes their names and types, with 192 bytes for each dimension: see the table "Extra
Bytes Descriptor" of the LAS 1.4 specification. Programs also read it in LAS 1.0 to 1.3.
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, replace

import numpy as np

from ..core.errors import BareEarthError
from .header_edits import with_record_length
from .lasfile import LARGEST_VLR, RECORD_LENGTHS, LasFile, Vlr, new_vlr, text_of

EXTRA_BYTES = ("LASF_Spec", 4)
_DESCRIPTOR = 192
# Bytes of each data type: undocumented, then integers of 1 to 8 bytes, float and double.
_SIZES = (0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8)
_KINDS = {9: "<f4", 10: "<f8"}
_BYTE = 1
_FLOAT = 9
# A dimension of one byte: the class that a run gave. If the present class differs, it was changed
# by hand after the run.
REMEMBERED = "BareEarthClass"
# Bits of the options of a descriptor.
_HAS_MINIMUM = 0x02
_HAS_MAXIMUM = 0x04
_HAS_SCALE = 0x08
_HAS_OFFSET = 0x10
_LARGEST_RECORD = 65535
_UNDOCUMENTED = "undocumented"
_MOST_UNDOCUMENTED = 231  # bytes that one descriptor describes here, in the place of the options


@dataclass(frozen=True)
class ExtraDimension:
    """A number for each point, stored in extra bytes."""

    name: str  # up to 32 bytes
    description: str  # up to 32 bytes
    values: np.ndarray  # float32 or uint8 (n,), in file order


@dataclass(frozen=True)
class RecordField:
    """First byte and type of a dimension in the record of a point."""

    start: int
    kind: np.dtype


def place_dimension(layout: LasFile, dimension: ExtraDimension) -> tuple[LasFile, RecordField]:
    """Return a file with a dimension, which is added if no dimension has that name, and its place
    in a record; refuse an unsuitable type.
    """
    descriptors = _descriptors(layout)
    if descriptors is None:
        raise BareEarthError(
            f"{layout.path} describes more extra bytes than its points have, so no dimension can"
            " be added. Repair its record on the extra bytes first."
        )
    start = RECORD_LENGTHS[layout.point_format]
    for number, descriptor in enumerate(descriptors):
        if text_of(descriptor[4:36]) == dimension.name:
            kind = _checked_kind(layout, dimension, descriptor)
            descriptors[number] = _descriptor(dimension, descriptor[2])
            return _with_record(layout, descriptors), RecordField(start, kind)
        start += _size(descriptor)
    # Bytes without a descriptor come before the new dimension, so they need one now.
    number = 0
    while start < layout.record_length:
        size, number = min(layout.record_length - start, _MOST_UNDOCUMENTED), number + 1
        if size & (_HAS_SCALE | _HAS_OFFSET):  # laspy would look for these, and refuse the file
            size = (size & ~0x1F) | 0x07
        name = _UNDOCUMENTED if number == 1 else f"{_UNDOCUMENTED} {number}"
        descriptors.append(struct.pack("<2xBB32s156x", 0, size, name.encode()))
        start += size
    is_byte = dimension.values.dtype == np.uint8
    descriptors.append(_descriptor(dimension, _BYTE if is_byte else _FLOAT))
    kind = np.dtype(np.uint8 if is_byte else _KINDS[_FLOAT])
    layout = with_record_length(layout, layout.record_length + kind.itemsize)
    return _with_record(layout, descriptors), RecordField(start, kind)


def extra_dimensions(layout: LasFile) -> list[tuple[str, str, int]]:
    """Return name, type ("unsigned", "signed" or "floating") and bytes of each dimension in extra
    bytes, in the terms of PDAL.
    """
    # Deprecated pairs and triples, and undescribed bytes, are left out.
    dimensions = []
    for descriptor in _descriptors(layout) or ():
        kind, options = descriptor[2], descriptor[3]
        if not 1 <= kind < len(_SIZES):
            continue
        name, size = text_of(descriptor[4:36]), _SIZES[kind]
        if kind in _KINDS:
            dimensions.append((name, "floating", size))
        elif options & (_HAS_SCALE | _HAS_OFFSET):
            dimensions.append((name, "floating", 8))
        else:
            dimensions.append((name, "unsigned" if kind % 2 else "signed", size))
    return dimensions


def dimension_names(layout: LasFile) -> list[str]:
    """Return the names of the dimensions in extra bytes, including bytes without a descriptor."""
    descriptors = _descriptors(layout) or []
    names = [text_of(described[4:36]) for described in descriptors if _size(described)]
    is_all = sum(map(_size, descriptors)) == layout.extra_bytes
    return names if is_all else [*names, _UNDOCUMENTED]


def runs_of_bytes(layout: LasFile) -> list[tuple[str, int]]:
    """Return the extra bytes of a point as runs with names and sizes; the dimension `REMEMBERED` is
    a run of its own.
    """
    count, start = layout.extra_bytes, 0
    for described in (_descriptors(layout) or ()) if count else ():
        if text_of(described[4:36]) == REMEMBERED and described[2] == _BYTE:
            runs = ("before", start), (REMEMBERED, 1), ("behind", count - start - 1)
            return [run for run in runs if run[1]]
        start += _size(described)
    return [("extra_bytes", count)] if count else []


def remembers(layout: LasFile) -> bool:
    """Return whether the points of a file have the dimension `REMEMBERED`."""
    return (REMEMBERED, 1) in runs_of_bytes(layout)


def _descriptors(layout: LasFile) -> list[bytes] | None:
    """Return the descriptors of a file; None if they describe more bytes than its points have."""
    record = layout.vlr(EXTRA_BYTES)
    data = b"" if record is None else record.data or b""
    whole = len(data) // _DESCRIPTOR * _DESCRIPTOR
    descriptors = [data[start : start + _DESCRIPTOR] for start in range(0, whole, _DESCRIPTOR)]
    return None if sum(map(_size, descriptors)) > layout.extra_bytes else descriptors


def _size(descriptor: bytes) -> int:
    """Return the bytes of a dimension; the types from 11 on are pairs and triples."""
    kind, options = descriptor[2], descriptor[3]
    if kind == 0:
        return options
    if kind > 30:  # reserved, of unknown size
        return _LARGEST_RECORD
    return _SIZES[(kind - 1) % 10 + 1] * ((kind - 1) // 10 + 1)


def _checked_kind(layout: LasFile, dimension: ExtraDimension, descriptor: bytes) -> np.dtype:
    kinds, lack = _KINDS, "neither float nor double"
    if dimension.values.dtype == np.uint8:
        kinds, lack = {_BYTE: "u1"}, "no byte"
    kind, options = descriptor[2], descriptor[3]
    if kind not in kinds or options & (_HAS_SCALE | _HAS_OFFSET):
        raise BareEarthError(
            f"{layout.path} has an extra dimension {dimension.name} that is {lack}. Remove or"
            " rename it first."
        )
    return np.dtype(kinds[kind])


def _descriptor(dimension: ExtraDimension, kind: int) -> bytes:
    values = dimension.values
    return struct.pack(
        "<2xBB32s4x24xd16xd16x48x32s",
        kind,
        _HAS_MINIMUM | _HAS_MAXIMUM,
        dimension.name.encode(),
        float(values.min()),
        float(values.max()),
        dimension.description.encode(),
    )


def _with_record(layout: LasFile, descriptors: list[bytes]) -> LasFile:
    """Return the layout with the descriptors in a VLR, in their former place or at the end."""
    data = b"".join(descriptors)
    if len(data) > LARGEST_VLR:
        raise BareEarthError(f"{layout.path} has too many extra dimensions to add one.")
    vlrs = list(layout.vlrs)
    keys = [vlr.key for vlr in vlrs]
    if EXTRA_BYTES in keys:
        place = keys.index(EXTRA_BYTES)
        head = bytearray(vlrs[place].raw[: -len(vlrs[place].data) or None])
        struct.pack_into("<H", head, 20, len(data))
        vlrs[place] = Vlr(bytes(head) + data)
    else:
        vlrs.append(new_vlr(EXTRA_BYTES, data, "Extra Bytes Record"))
    # A second record behind the points would contradict this one.
    evlrs = tuple(evlr for evlr in layout.evlrs if evlr.key != EXTRA_BYTES)
    return replace(layout, vlrs=tuple(vlrs), evlrs=evlrs)
