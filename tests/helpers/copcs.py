"""COPC files made by hand: with a hierarchy of several pages, as large clouds have it."""

import struct

import numpy as np
from las_files import las_bytes, make_records
from surveys import write_classified

from bare_earth.algorithms.las import copc_octree

_ENTRY = struct.Struct("<4iQ2i")
# The info record is the first VLR: in it, where the first page begins and how many bytes it has.
_ROOT = 375 + 54 + 40


def with_sub_pages(content, depth=1):
    """Return a COPC file whose nodes of a depth, and those below them, stand on pages of their own.

    The hierarchy has to be the last record of the file.
    """
    data = bytearray(content)
    start, size = struct.unpack_from("<2Q", data, _ROOT)
    if start + size != len(data):
        raise ValueError("the hierarchy is not at the end")
    entries = [_ENTRY.unpack_from(data, at) for at in range(start, start + size, _ENTRY.size)]
    above = [record for record in entries if record[0] < depth]
    pages = {}
    for entry in entries:
        if entry[0] >= depth:
            branch = tuple(part >> (entry[0] - depth) for part in entry[1:4])
            pages.setdefault(branch, []).append(entry)
    first = (len(above) + len(pages)) * _ENTRY.size
    at, pointers, rest = start + first, [], b""
    for branch, members in pages.items():
        page = b"".join(_ENTRY.pack(*member) for member in members)
        pointers.append((depth, *branch, at, len(page), -1))
        at, rest = at + len(page), rest + page
    data[start:] = b"".join(_ENTRY.pack(*value) for value in (*above, *pointers)) + rest
    struct.pack_into("<Q", data, _ROOT + 8, first)
    struct.pack_into("<Q", data, start - 60 + 20, len(data) - start)
    return bytes(data)


def many_nodes(folder, point_format=7, pages=True, **wanted):
    """Return a COPC file of a few thousand points in many nodes, on several pages if wanted."""
    records = make_records(point_format, 4000)
    # Four places far from each other, each of points so near that a node cannot hold all.
    number = np.arange(4000)
    x = number // 4 % 32 * 10 + number % 2 * 5000
    y = number // 4 // 32 * 10 + number // 2 % 2 * 5000
    records[:, :8] = np.column_stack((x, y)).astype("<i4").view(np.uint8)
    plain, path = folder / "plain.las", folder / "plain.copc.laz"
    wanted = {"version": 4, "point_format": point_format, "records": records, **wanted}
    plain.write_bytes(las_bytes(**wanted))
    before = copc_octree._LEAF_POINTS, copc_octree._SMALL_NODE
    copc_octree._LEAF_POINTS, copc_octree._SMALL_NODE = 150, 10
    try:
        write_classified(plain, path, np.full(4000, 1, np.uint8))
    finally:
        copc_octree._LEAF_POINTS, copc_octree._SMALL_NODE = before
    content = path.read_bytes()
    return with_sub_pages(content) if pages else content
