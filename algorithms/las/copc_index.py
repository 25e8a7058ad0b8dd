"""The index of a COPC file whose chunks change in size but not in order.

References
----------
COPC specification 1.0, https://copc.io
"""

from __future__ import annotations

import struct
from typing import BinaryIO, Mapping, Sequence

import numpy as np

from .class_layers import Chunk
from .copc_nodes import OctreeError, read_hierarchy, read_pages
from .lasfile import COPC_EXTENTS, COPC_INFO, VLR_HEADER, LasFile

# Position of the start of the first page in the info record.
_ROOT = 40


class CopcIndex:
    """The pages of the hierarchy of a COPC file, which give the position of the points of each
    node; `OctreeError` if they are damaged or cannot be kept.
    """

    def __init__(self, layout: LasFile) -> None:
        self._layout, self._pages = layout, read_pages(read_hierarchy(layout))
        if layout.vlr(COPC_EXTENTS) is not None:
            raise OctreeError(f"The index of {layout.path} says which classes there are.")
        if min(self._pages) < layout.tail_start:
            raise OctreeError(f"The index of {layout.path} does not stand behind the points.")

    def fits(self, chunks: Sequence[Chunk]) -> bool:
        """Return whether each node is one of the chunks of the file."""
        known = {(chunk.place, chunk.size, chunk.end - chunk.start) for chunk in chunks}
        nodes = np.concatenate(list(self._pages.values()))
        nodes = nodes[nodes["count"] > 0]
        columns = (nodes[name].tolist() for name in ("start", "size", "count"))
        return known.issuperset(zip(*columns))

    def write(self, file: BinaryIO, moved: Mapping[int, tuple[int, int]], shift: int) -> None:
        """Write the index into a file whose chunks have moved, given their new positions and sizes
        by their old positions; the records behind them have moved by `shift` bytes.
        """
        for start, entries in self._pages.items():
            entries = entries.copy()
            for entry in entries:
                if entry["count"] > 0:
                    entry["start"], entry["size"] = moved[int(entry["start"])]
                elif entry["count"] < 0:
                    entry["start"] = int(entry["start"]) + shift  # unsigned: shift may be negative
            file.seek(start + shift)
            file.write(entries.tobytes())
        place = len(self._layout.header)
        for vlr in self._layout.vlrs:
            if vlr.key == COPC_INFO:
                (root,) = struct.unpack_from("<Q", vlr.data, _ROOT)
                file.seek(place + VLR_HEADER + _ROOT)
                file.write(struct.pack("<Q", root + shift))
            place += len(vlr.raw)
