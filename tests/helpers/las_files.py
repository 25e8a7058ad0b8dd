"""Point cloud files of every version and format, made byte by byte: no library has a say."""

import struct
from dataclasses import dataclass

import numpy as np

from bare_earth.algorithms.las.laszip import with_chunk_size

LENGTHS = (20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67)
HEADER_SIZES = (227, 227, 227, 235, 375)
# The formats that each version defines.
FORMATS = {0: (0, 1), 1: (0, 1), 2: range(4), 3: range(6), 4: range(11)}
EVERY = [(version, point_format) for version, kinds in FORMATS.items() for point_format in kinds]
GPS_TIMES = {1: 20, 3: 20, 4: 20, 5: 20, 6: 22, 7: 22, 8: 22, 9: 22, 10: 22}
SCALE, OFFSET = (0.01, 0.01, 0.001), (400_000.0, 5_000_000.0, 100.0)


@dataclass
class Parts:
    """A file cut into what stands in it."""

    header: bytes
    vlrs: list
    padding: bytes
    records: np.ndarray
    tail: bytes

    def field(self, layout, start):
        return struct.unpack_from("<" + layout, self.header, start)[0]


def vlr(user, number, data, description=b"made by hand"):
    return struct.pack("<H16sHH32s", 0xAABB, user, number, len(data), description) + data


def evlr(user, number, data):
    return struct.pack("<H16sHQ32s", 0xAABB, user, number, len(data), b"made by hand") + data


def make_records(point_format, count=60, extra=0, seed=1):
    """Points on a small slope; all that is not a coordinate or a return number is noise."""
    noise = np.random.default_rng(seed)
    records = noise.integers(0, 256, (count, LENGTHS[point_format] + extra), dtype=np.uint8)
    side = int(np.ceil(np.sqrt(count)))
    x, y = np.arange(count) % side * 100, np.arange(count) // side * 100
    z = x // 10 + noise.integers(0, 300, count)
    xyz = np.column_stack((x - 1000, y, z)).astype("<i4")
    records[:, :12] = xyz.view(np.uint8).reshape(count, 12)
    total = noise.integers(1, 6, count)
    number = noise.integers(1, total + 1)
    if point_format < 6:
        records[:, 14] = number | total << 3 | (records[:, 14] & 0xC0)
    else:
        records[:, 14] = number | total << 4
    if point_format in (9, 10):
        records[:, 15] &= 0xCF  # one scanner channel: lazrs garbles waveforms of several
    if point_format in GPS_TIMES:
        start = GPS_TIMES[point_format]
        times = (1e8 + noise.random(count) * 100).astype("<f8")
        records[:, start : start + 8] = times.view(np.uint8).reshape(count, 8)
    return records


def las_bytes(
    version=2,
    point_format=1,
    records=None,
    compressed=False,
    extra=0,
    vlrs=(),
    evlrs=(),
    encoding=0,
    user_bytes=b"",
    padding=b"",
    waveform_start=0,
    tail=b"",
    count=60,
    chunk_size=None,
):
    if records is None:
        records = make_records(point_format, count, extra)
    vlrs, body = list(vlrs), records.tobytes()
    header = bytearray(HEADER_SIZES[version]) + user_bytes
    if compressed:
        import lazrs

        laszip = lazrs.LazVlr.new_for_compression(
            point_format, records.shape[1] - LENGTHS[point_format]
        )
        if chunk_size is not None:
            laszip = lazrs.LazVlr(with_chunk_size(bytes(laszip.record_data()), chunk_size))
        vlrs.append(vlr(b"laszip encoded", 22204, bytes(laszip.record_data())))
    start = len(header) + sum(map(len, vlrs)) + len(padding)
    if compressed:
        body = compress(laszip, records, start)
    header[:4] = b"LASF"
    struct.pack_into("<HH16s", header, 4, 77, encoding, b"0123456789abcdef")
    struct.pack_into("<BB32s32s", header, 24, 1, version, b"a system", b"some software")
    struct.pack_into("<HHHII", header, 90, 42, 2021, len(header), start, len(vlrs))
    legacy = version < 4 or point_format < 6
    mark = 0x80 if compressed else 0
    length, old_count = records.shape[1], len(records) if legacy else 0
    struct.pack_into("<BHI", header, 104, point_format | mark, length, old_count)
    struct.pack_into("<6d", header, 131, *SCALE, *OFFSET)
    struct.pack_into("<6d", header, 179, 1, 2, 3, 4, 5, 6)  # wrong on purpose: copied, not trusted
    if version >= 3:
        struct.pack_into("<Q", header, 227, waveform_start)
    if version >= 4:
        struct.pack_into(
            "<QIQ", header, 235, start + len(body) if evlrs else 0, len(evlrs), len(records)
        )
    return bytes(header) + b"".join(vlrs) + padding + body + b"".join(evlrs) + tail


def compress(laszip, records, start):
    import io

    import lazrs

    # The place of the chunk table is counted from the start of the file.
    file = io.BytesIO(bytes(start))
    file.seek(start)
    compressor = lazrs.LasZipCompressor(file, laszip)
    compressor.compress_many(records.reshape(-1))
    compressor.done()
    return file.getvalue()[start:]


def split(path):
    """Cut a file into its parts; what follows LAZ points is known only where EVLRs are."""
    data = path.read_bytes()
    version, (header_size,) = data[25], struct.unpack_from("<H", data, 94)
    start, number = struct.unpack_from("<II", data, 96)
    point_format, length, count = struct.unpack_from("<BHI", data, 104)
    if version >= 4:
        count = struct.unpack_from("<Q", data, 247)[0]
    vlrs, at = [], header_size
    for _ in range(number):
        end = at + 54 + struct.unpack_from("<H", data, at + 20)[0]
        vlrs.append(data[at:end])
        at = end
    padding, records, tail = data[at:start], np.empty((count, length), np.uint8), b""
    if point_format & 0x80:
        import lazrs

        laszip = next(record[54:] for record in vlrs if record[2:16] == b"laszip encoded")
        with open(path, "rb") as file:
            file.seek(start)
            lazrs.LasZipDecompressor(file, laszip).decompress_many(records.reshape(-1))
        if version >= 4 and struct.unpack_from("<I", data, 243)[0]:
            tail = data[struct.unpack_from("<Q", data, 235)[0] :]
    else:
        end = start + count * length
        records[:] = np.frombuffer(data[start:end], np.uint8).reshape(count, length)
        tail = data[end:]
    return Parts(data[:header_size], vlrs, padding, records, tail)


class LasKit:
    """What the tests of files need, in one fixture: `las.make("a.laz", version=4)`."""

    vlr, evlr = staticmethod(vlr), staticmethod(evlr)
    bytes, records, split = staticmethod(las_bytes), staticmethod(make_records), staticmethod(split)
    FORMATS, SCALE, OFFSET = FORMATS, SCALE, OFFSET

    def __init__(self, folder):
        self.folder = folder

    def make(self, name="in.las", **wanted):
        path = self.folder / name
        path.write_bytes(las_bytes(compressed=name.endswith(".laz"), **wanted))
        return path
