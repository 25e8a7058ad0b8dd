"""COPC files edited in place as QGIS does it from 3.42 on: chunks anew, all else as it was.

Its `QgsCopcUpdate` copies header and VLRs, writes the chunks in their order, those with changes
compressed anew, then the chunk table, the hierarchy, and the other EVLRs. The edits of QGIS 3.44.15
gave the bytes that these functions give, but for the description of the record of the hierarchy.
"""

import io
import struct

import lazrs
import numpy as np

_POINTS_START, _RECORD_LENGTH, _EVLRS, _ROOT = 96, 105, 235, 469
_CLASS = 16


def edit(path, change):
    """Change the records of a COPC file, of shape (k, record length), chunk by chunk."""
    data = path.read_bytes()
    (start,) = struct.unpack_from("<I", data, _POINTS_START)
    (length,) = struct.unpack_from("<H", data, _RECORD_LENGTH)
    first_evlr, evlr_count = struct.unpack_from("<QI", data, _EVLRS)
    vlr = lazrs.LazVlr(_laszip(data, start))
    file = io.BytesIO(data)
    file.seek(start)
    chunks = lazrs.read_chunk_table(file, vlr)
    out, place, moved, table = io.BytesIO(data[:start] + bytes(8)), start + 8, {}, []
    out.seek(0, 2)
    for count, size in chunks:
        chunk = data[place : place + size]
        records = np.zeros((count, length), dtype=np.uint8)
        lazrs.decompress_points_with_chunk_table(
            chunk, vlr.record_data(), records.reshape(-1), [(count, size)]
        )
        before = records.copy()
        change(records)
        if not np.array_equal(before, records):
            chunk = _compressed(records, vlr)
        moved[place] = out.tell(), len(chunk)
        table.append((count, len(chunk)))
        out.write(chunk)
        place += size
    end = out.tell()
    lazrs.write_chunk_table(out, table, vlr)
    last, tail, hierarchy = out.tell(), data[first_evlr:], None
    out.write(tail)
    at = 0
    for _ in range(evlr_count):
        user, number, size = struct.unpack_from("<2x16sHQ", tail, at)
        if (user.rstrip(b"\0"), number) == (b"copc", 1000):
            hierarchy = at + 60, size
        at += 60 + size
    body, size = hierarchy
    for entry in range(body, body + size, 32):
        old, _, count = struct.unpack_from("<Qii", tail, entry + 16)
        assert count >= 0  # one page
        out.seek(last + entry + 16)
        if count:
            out.write(struct.pack("<Qi", *moved[old]))
    (root,) = struct.unpack_from("<Q", data, _ROOT)
    for where, value in ((start, end), (_EVLRS, last), (_ROOT, root + last - first_evlr)):
        out.seek(where)
        out.write(struct.pack("<Q", value))
    path.write_bytes(out.getvalue())


def give_class(path, value, where):
    """Set the class of the points that a function of x and y, as integers, picks."""

    def change(records):
        x, y = np.ascontiguousarray(records[:, :8]).view("<i4").T
        records[where(x, y), _CLASS] = value

    edit(path, change)


def _laszip(data, points_start):
    (at,) = struct.unpack_from("<H", data, 94)
    while at < points_start:
        number, size = struct.unpack_from("<18xHH", data, at)
        if number == 22204:
            return data[at + 54 : at + 54 + size]
        at += 54 + size
    raise AssertionError("no laszip record")


def _compressed(records, vlr):
    out = io.BytesIO()
    compressor = lazrs.LasZipCompressor(out, vlr)
    compressor.compress_chunks([records.reshape(-1)])
    compressor.done()
    (end,) = struct.unpack_from("<q", out.getvalue())
    return out.getvalue()[8:end]
