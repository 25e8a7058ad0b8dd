"""Point cloud files as `struct` and LASzip read them: no code of ours, laspy or lazrs has a say.

Offsets and bits are those of the LAS specification, revision 15, and of the COPC specification.
"""

import struct
from typing import NamedTuple

import numpy as np

# Bytes of a point of each format, and where it has its time, colours and near infrared.
LENGTHS = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
TIMES = {1: 20, 3: 20, 4: 20, 5: 20, 6: 22, 7: 22, 8: 22, 9: 22, 10: 22}
COLOURS = {2: 20, 3: 28, 5: 28, 7: 30, 8: 30, 10: 30}
# What an extra dimension of each type takes: one number, two, three.
EXTRA_SIZES = [size * count for count in (1, 2, 3) for size in (1, 1, 2, 2, 4, 4, 8, 8, 4, 8)]
# Bits of a point: where its class and the flag of key points stand, in formats 0 to 5 and since.
CLASS = {True: (15, 0b0001_1111), False: (16, 0b1111_1111)}
KEY_POINT = {True: (15, 0b0100_0000), False: (15, 0b0000_0010)}


class Cloud(NamedTuple):
    """A file, cut into what stands in it; `points` has a row of bytes for each point."""

    data: bytes
    header: bytes
    vlrs: list
    padding: bytes
    points: np.ndarray
    evlrs: list
    waveforms: bytes

    @property
    def format(self):
        """The point format."""
        return self.header[104] & 0x3F

    def field(self, layout, start):
        """Return a field of the header."""
        return struct.unpack_from(f"<{layout}", self.header, start)[0]


def read(path):
    """Read a LAS file by struct; the points of a LAZ or COPC file by LASzip."""
    with open(path, "rb") as file:
        data = file.read()
    (size, start), minor = struct.unpack_from("<HI", data, 94), data[25]
    header, vlrs, at = data[:size], [], size
    for _ in range(struct.unpack_from("<I", data, 100)[0]):
        end = at + 54 + struct.unpack_from("<H", data, at + 20)[0] if at + 54 <= start else at
        if not at < end <= start:
            break
        vlrs.append(data[at:end])
        at = end
    (length,) = struct.unpack_from("<H", data, 105)
    count = struct.unpack_from("<Q", data, 247)[0] if minor >= 4 else 0
    count = count or struct.unpack_from("<I", data, 107)[0]
    if data[104] & 0xC0:
        points = _unzipped(path, count, length)
    else:
        points = np.frombuffer(data, np.uint8, count * length, start)
    evlrs = []
    place, number = struct.unpack_from("<QI", data, 235) if minor >= 4 else (0, 0)
    for _ in range(number):
        record = _evlr(data, place)
        if record is None:
            break
        evlrs.append(record)
        place += len(record)
    wave = struct.unpack_from("<Q", data, 227)[0] if minor >= 3 else 0
    record = _evlr(data, wave) if wave else None
    if record is None or record[2:20] != b"LASF_Spec".ljust(16, b"\0") + b"\xff\xff":
        record = b""
    return Cloud(data, header, vlrs, data[at:start], points.reshape(-1, length), evlrs, record)


def _evlr(data, start):
    if start + 60 > len(data):
        return None
    end = start + 60 + struct.unpack_from("<Q", data, start + 20)[0]
    return data[start:end] if end <= len(data) else None


def _unzipped(path, count, length):
    import laszip

    points = np.zeros(count * length, np.uint8)
    with open(path, "rb") as file:
        laszip.LasUnZipper(file).decompress_into(points)
    return points


def write_laz(path, content):
    """Write an uncompressed file, without what lies behind its points, as LASzip compresses it."""
    import laszip

    start, length = *struct.unpack_from("<I", content, 96), *struct.unpack_from("<H", content, 105)
    (count,) = struct.unpack_from("<Q" if content[25] >= 4 else "<I", content, (
        247 if content[25] >= 4 else 107))  # fmt: skip
    points = np.frombuffer(content, np.uint8, count * length, start)
    with open(path, "wb") as file:
        zipper = laszip.LasZipper(file, content[:start])
        zipper.compress(points)
        zipper.done()


def without(points, point_format, *bits):
    """Return points with some bits cleared, such as `CLASS`."""
    points = points.copy()
    for bit in bits:
        place, mask = bit[point_format < 6]
        points[:, place] &= 0xFF ^ mask
    return points


def classes(points, point_format):
    """Return the class of each point."""
    place, mask = CLASS[point_format < 6]
    return points[:, place] & mask


def in_any_order(points):
    """Return points sorted by their bytes."""
    return np.sort(np.ascontiguousarray(points).view(f"V{points.shape[1]}").ravel())


def meaning(points, point_format):
    """Return what points of any format say, as columns of numbers: classes are left out."""

    def at(start, kind):
        size = np.dtype(kind).itemsize
        return np.ascontiguousarray(points[:, start : start + size]).view(kind)[:, 0]

    first, second = at(14, "u1").astype(int), at(15, "u1").astype(int)
    if point_format < 6:
        returns = first & 7, first >> 3 & 7, first >> 6 & 1, first >> 7
        flags = second >> 5 & 1, second >> 6 & 1, second >> 7
        degrees, rest = at(16, "i1").astype(float), (at(17, "u1"), at(18, "<u2"))
    else:
        returns = first & 15, first >> 4, second >> 6 & 1, second >> 7
        flags = second & 1, second >> 1 & 1, second >> 2 & 1
        degrees, rest = np.round(at(18, "<i2") * 0.006), (at(17, "u1"), at(20, "<u2"))
    columns = [*(at(4 * axis, "<i4") for axis in range(3)), at(12, "<u2"), *returns, *flags]
    columns += [degrees, *rest]
    if point_format in TIMES:
        columns.append(at(TIMES[point_format], "<i8"))
    if point_format in COLOURS:
        columns += [at(COLOURS[point_format] + 2 * number, "<u2") for number in range(3)]
    columns += list(points[:, LENGTHS[point_format] :].T)
    return columns


def copc_nodes(cloud):
    """Return the nodes of a COPC file (where each begins, its bytes and points), and its pages."""
    info = next(
        record[54:]
        for record in cloud.vlrs
        if record[2:7] == b"copc\0" and record[18:20] == b"\1\0"
    )
    waiting, nodes, pages = [struct.unpack_from("<2Q", info, 40)], [], 0
    while waiting:
        start, size = waiting.pop()
        pages += 1
        for at in range(start, start + size, 32):
            *_, place, length, count = struct.unpack_from("<4iQ2i", cloud.data, at)
            if count == -1:
                waiting.append((place, length))
            elif count:
                nodes.append((place, length, count))
    return sorted(nodes), pages
