"""What may not change stays, byte by byte: by a parser of `struct` alone, and by LASzip as reader.

Every version, point format and container, with records before and behind the points, extra bytes of
all types, waveforms, every flag, and integers as large as can be; and the files of other projects.
"""

import itertools
import struct

import independent
import numpy as np
import pytest
from conftest import evlr, las_bytes, make_records, vlr
from independent import CLASS, meaning, without

from bare_earth.algorithms.las.writing import write_classified
from benchmarks.data import FOLDER

pytest.importorskip("laszip")

FORMATS = {0: (0, 1), 1: (0, 1), 2: range(4), 3: range(6), 4: range(11)}
EVERY = [(version, each) for version, formats in FORMATS.items() for each in formats]
AWKWARD = FOLDER / "awkward"
WAVEFORMS = struct.pack("<H16sHQ32s", 0, b"LASF_Spec", 65535, 500, b"waveforms") + bytes(500)
LASZIP, COPC = b"laszip encoded\0\0", b"copc".ljust(16, b"\0")
SPEC, WITH_WAVEFORMS = b"LASF_Spec".ljust(16, b"\0"), (4, 5, 9, 10)
LIMITS = (-(2**31), 2**31 - 1, 0, -1)
# Where the points, the waveforms and the EVLRs begin, how many VLRs and EVLRs there are, and the
# bits that mark compression.
POINTERS = (96, 104), (104, 105), (227, 247)


def everything(version, point_format, limits=True):
    """Return the bytes of a LAS file that has all that such a file may have."""
    kinds = [(0, 3), *enumerate(independent.EXTRA_SIZES, start=1)]
    descriptors = b"".join(
        struct.pack("<2xBB32s156x", kind, 3 if kind == 0 else 0, f"dimension {kind}".encode())
        for kind, _ in kinds
    )
    records = make_records(point_format, 300, sum(size for _, size in kinds))
    if limits:
        corners = np.array(list(itertools.product(LIMITS, LIMITS, LIMITS)), "<i4")
        records[: len(corners), :12] = corners.view(np.uint8)
    behind = [WAVEFORMS] if version == 3 and point_format > 3 else []
    if version == 4:
        behind = [evlr(b"somebody", 9, bytes(range(256)) * 300)]
        behind += [WAVEFORMS] if point_format in (4, 5, 9, 10) else []
        behind += [evlr(b"", 0, b"")]
    waves = struct.pack("<BBIIdd", 8, 0, 100, 1000, 1.0, 0.0)
    content = bytearray(
        las_bytes(
            version=version,
            point_format=point_format,
            records=records,
            vlrs=[
                vlr(b"LASF_Spec", 4, descriptors),
                *([vlr(b"LASF_Spec", 100, waves)] if point_format in WITH_WAVEFORMS else []),
                vlr(b"\xff not text", 65535, b"\0\xff" * 100, b"\xff" * 32),
                vlr(b"", 0, b""),
            ],
            evlrs=behind,
            encoding=0xFF1B if version == 4 else 0x0B,
            user_bytes=b"bytes of users",
            padding=b"\xdd\xdd and more",
        )
    )
    if WAVEFORMS in behind:
        struct.pack_into("<Q", content, 227, content.rindex(WAVEFORMS))
    return bytes(content)


def blank(header, *ranges):
    header = bytearray(header)
    for start, end in ranges:
        header[start:end] = bytes(len(header[start:end]))
    return bytes(header)


def others(records, *left_out):
    """Return records but for those of these users, which belong to a container."""
    return [each for each in records if each[2:18] not in left_out]


def kept_around(before, after, *changed):
    """Compare all that does not belong to the points, but for `changed` bytes of the header."""
    assert blank(after.header, *POINTERS, *changed) == blank(before.header, *POINTERS, *changed)
    assert others(after.vlrs, LASZIP, COPC) == others(before.vlrs, LASZIP, COPC)
    assert others(after.evlrs, COPC) == others(before.evlrs, COPC)
    assert after.waveforms == before.waveforms
    assert after.padding == before.padding
    assert after.format == before.format


def kept_in_copc(before, after, new):
    """Compare what COPC has room for: what each point says, in another order, and the records."""
    assert after.header[131:179] == before.header[131:179]
    one, other = meaning(before.points, before.format), meaning(after.points, after.format)
    if before.format in (0, 2):
        assert not other.pop(14).any()  # a time, which the points had not
    one.append(new)
    other.append(independent.classes(after.points, after.format))
    rows = [np.array([each.astype(np.int64) for each in columns]) for columns in (one, other)]
    assert np.array_equal(*(each[:, np.lexsort(each)] for each in rows))
    left_out = LASZIP, COPC, *([SPEC] if before.format in WITH_WAVEFORMS else [])
    assert others(after.vlrs, *left_out) == others(before.vlrs, *left_out)
    assert others(after.evlrs, *left_out) == others(before.evlrs, *left_out)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Return a function that writes a file of everything as one container, once."""
    folder, made = tmp_path_factory.mktemp("everything"), {}

    def write(version, point_format, container):
        key = version, point_format, container
        if key not in made:
            path = folder / f"{version}-{point_format}-{container}.{container.split()[-1]}"
            content = everything(version, point_format)
            if container == "LASzip laz":
                independent.write_laz(path, content)
            elif container == "laz":
                plain = write(version, point_format, "las")
                write_classified(plain, path, independent.classes(*_points(plain)))
            else:
                path.write_bytes(content)
            made[key] = path
        return made[key]

    return write


def _points(path):
    cloud = independent.read(path)
    return cloud.points, cloud.format


@pytest.mark.parametrize("target", ["las", "laz", "copc.laz"])
@pytest.mark.parametrize("source", ["las", "laz", "LASzip laz"])
@pytest.mark.parametrize(("version", "point_format"), EVERY)
def test_nothing_but_the_class_changes(written, tmp_path, version, point_format, source, target):
    path, out = written(version, point_format, source), tmp_path / f"out.{target}"
    new = (np.arange(300) * 7 % (32 if point_format < 6 else 256)).astype(np.uint8)
    write_classified(path, out, new)
    before, after = independent.read(path), independent.read(out)
    if target == "copc.laz":
        kept_in_copc(before, after, new)
        return
    kept_around(before, after)
    assert np.array_equal(independent.classes(after.points, point_format), new)
    bits = [without(each.points, point_format, CLASS) for each in (before, after)]
    assert np.array_equal(*bits)
    if source == target == "las":  # no pointer moves, nothing is written anew
        start = before.field("I", 96)
        rest = slice(start + before.points.size, None)
        assert (after.header, after.data[rest]) == (before.header, before.data[rest])
