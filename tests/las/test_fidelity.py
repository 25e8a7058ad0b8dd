"""What may not change stays, byte by byte: by a parser of `struct` alone, and by LASzip as reader.

Every version, point format and container, with records before and behind the points, extra bytes of
all types, waveforms, every flag, and integers as large as can be; and the files of other projects.
"""

import itertools
import shutil
import struct

import independent
import numpy as np
import pytest
from copcs import many_nodes
from independent import CLASS, KEY_POINT, copc_nodes, in_any_order, meaning, without
from las_files import EVERY, evlr, las_bytes, make_records, vlr
from matrices import covering
from runs import said, temporary_in
from surveys import write_classified

from benchmarks.data import FOLDER

pytest.importorskip("laszip")

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
    return [record for record in records if record[2:18] not in left_out]


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
    rows = [np.array([column.astype(np.int64) for column in columns]) for columns in (one, other)]
    assert np.array_equal(*(row[:, np.lexsort(row)] for row in rows))
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


# What LASzip wrote, in each layout, becomes each container; test_writing.py has the others daily.
@pytest.mark.rest(but="LASzip")
@pytest.mark.parametrize(
    ("layout", "source", "target"),
    covering(EVERY, ["las", "laz", "LASzip laz"], ["las", "laz", "copc.laz"]),
)
def test_nothing_but_the_class_changes(written, tmp_path, layout, source, target):
    version, point_format = layout
    path, out = written(version, point_format, source), tmp_path / f"out.{target}"
    new = (np.arange(300) * 7 % (32 if point_format < 6 else 256)).astype(np.uint8)
    write_classified(path, out, new)
    before, after = independent.read(path), independent.read(out)
    if target == "copc.laz":
        kept_in_copc(before, after, new)
        return
    kept_around(before, after)
    assert np.array_equal(independent.classes(after.points, point_format), new)
    bits = [without(las.points, point_format, CLASS) for las in (before, after)]
    assert np.array_equal(*bits)
    if source == target == "las":  # no pointer moves, nothing is written anew
        start = before.field("I", 96)
        rest = slice(start + before.points.size, None)
        assert (after.header, after.data[rest]) == (before.header, before.data[rest])


# Through the commands


def command(name, source, target):
    return {
        "classify": ["classify", source, target, "--method", "slope"],
        "height": ["height", source, target],
        "height in z": ["height", source, target, "--output-as", "z"],
        "key points": ["key-points", source, target],
        "key points by flag": ["key-points", source, target, "--mark-as", "flag"],
    }[name]


COMMANDS = ("classify", "height", "height in z", "key points", "key points by flag")
# What each may change: bits of the points, bytes of the header.
BITS = {"classify": (CLASS,), "key points": (CLASS,), "key points by flag": (KEY_POINT,)}
EXTENT_OF_Z = 211, 227
RECORD_LENGTH, VLR_COUNT = (105, 107), (100, 104)
EXTRA_BYTES = SPEC + b"\4\0"


def kept_by(name, before, after):
    """Compare all bytes of a file that a command may not change."""
    points, old = after.points, before.points
    header = []
    if name == "height":
        # A dimension is added, and described behind the others, if it is not there already.
        header = [RECORD_LENGTH, VLR_COUNT]
        points, added = points[:, : old.shape[1]], points.shape[1] - old.shape[1]
        assert added == 4
        before, after = (
            las._replace(
                vlrs=[vlr for vlr in las.vlrs if vlr[2:20] != EXTRA_BYTES],
                evlrs=[vlr for vlr in las.evlrs if vlr[2:20] != EXTRA_BYTES],
            )
            for las in (before, after)
        )
    elif name == "height in z":
        header = [EXTENT_OF_Z]
        points, old = points.copy(), old.copy()
        points[:, 8:12] = old[:, 8:12] = 0
    kept_around(before, after, *header)
    bits = BITS.get(name, ())
    old, points = (without(values, before.format, *bits) for values in (old, points))
    if any(record[2:18] == COPC for record in after.vlrs):
        if any(record[2:18] == COPC for record in before.vlrs) and name == "classify":
            assert np.array_equal(old, points)  # all but the layer of the classes is copied
        old, points = in_any_order(old), in_any_order(points)
    assert np.array_equal(old, points)


# Those that are not left to `make test-long`: each container, old and new formats, with waveforms.
SOME = {(2, 3, "las"), (3, 5, "LASzip laz"), (4, 8, "laz")}


@pytest.mark.rest
@pytest.mark.parametrize(
    ("version", "point_format", "container"),
    [
        pytest.param(*value, marks=() if value in SOME else pytest.mark.long)
        for value in ((*pair, kind) for pair in EVERY for kind in ("las", "laz", "LASzip laz"))
    ],
)
def test_commands_change_what_they_are_for_and_nothing_else(
    tmp_path, version, point_format, container
):
    suffix = container.split()[-1]
    plain, source = tmp_path / "in.las", tmp_path / f"source.{suffix}"
    plain.write_bytes(everything(version, point_format, limits=False))
    if container == "LASzip laz":
        independent.write_laz(source, plain.read_bytes())
    else:
        write_classified(plain, source, np.full(300, 2, np.uint8))
    for name in COMMANDS:
        target = tmp_path / f"out.{suffix}"
        if name == "height" and container == "LASzip laz":
            source = tmp_path / "classified.laz"
            assert said(*command("classify", tmp_path / "source.laz", source))[0] == 0
        code, _, errors = said(*command(name, source, target))
        assert code == 0, errors
        kept_by(name, independent.read(source), independent.read(target))


@pytest.mark.rest(but="classify-7")
@pytest.mark.parametrize(
    ("name", "point_format"),
    [
        pytest.param(*case, marks=() if case[1] == 7 else pytest.mark.long)
        for case in itertools.product(COMMANDS, (6, 7, 8))
    ],
)
def test_copc_with_sub_pages_stays_whole(tmp_path, name, point_format):
    source, target = tmp_path / "in.copc.laz", tmp_path / "out.copc.laz"
    source.write_bytes(many_nodes(tmp_path, point_format))
    assert copc_nodes(independent.read(source))[1] > 3
    if name != "classify":
        classified = tmp_path / "classified.copc.laz"
        assert said(*command("classify", source, classified))[0] == 0
        source = classified
    code, _, errors = said(*command(name, source, target))
    assert code == 0, errors
    before, after = independent.read(source), independent.read(target)
    kept_by(name, before, after)
    nodes_are_whole(after)


def nodes_are_whole(cloud):
    """Compare the nodes of a COPC file with its length: they lie side by side and hold all."""
    nodes, pages = copc_nodes(cloud)
    start = cloud.field("I", 96) + 8
    for place, length, _ in nodes:
        assert place == start
        start += length
    assert start == struct.unpack_from("<q", cloud.data, cloud.field("I", 96))[0]
    assert sum(count for *_, count in nodes) == len(cloud.points)
    return pages


# Files of other projects


def awkward():
    """Return the files; a parameter that is skipped where they are not here."""
    found = sorted(AWKWARD.glob("*.la[sz]")) if AWKWARD.is_dir() else []
    missing = pytest.mark.skip(reason=f"{AWKWARD} is not here")
    return [pytest.param(value, id=value.name) for value in found] or [
        pytest.param(None, marks=missing)
    ]


def outputs(path):
    """Return what each command writes of a file: words, and the cloud it writes."""
    folder, suffix = path.parent, ".las" if path.suffix == ".las" else ".laz"
    classified, dtm = folder / f"classified{suffix}", folder / "dtm.tif"
    box = ("--extent", "-99999999", "-99999999", "99999999", "99999999")
    clouds = {
        ".las": folder / "as.las", ".laz": folder / "as.laz", ".copc.laz": folder / "as.copc.laz",
    }  # fmt: skip
    yield "info", ["info", path], None
    yield "classify", command("classify", path, classified), classified
    for target in clouds.values():
        yield "classify", command("classify", path, target), target
    coarse = ("--dtm", dtm, "--dtm-cell-size", "20")
    yield "classify", [*command("classify", path, folder / "r.las"), *coarse], folder / "r.las"
    yield "tiles", ["classify", path, folder / "tiles", "--method", "slope"], None
    for name in COMMANDS[1:]:
        target = folder / f"{name}{suffix}".replace(" ", "-")
        yield name, command(name, classified, target), target
    yield "terrain", ["terrain", classified, *coarse, "--dsm", folder / "dsm.tif"], None
    yield "assess", ["assess", classified, classified, "--report", folder / "a.html"], None
    yield "compare", ["compare-settings", path, folder / "page.html", *box], None
    yield "objects", ["remove-off-terrain-objects", dtm, folder / "bare.tif"], None


@pytest.mark.long
@pytest.mark.parametrize("original", awkward())
def test_files_of_other_projects_keep_what_they_say_or_are_refused_in_a_sentence(
    original, tmp_path, capfd, record_property
):
    source = tmp_path / original.name
    shutil.copy(original, source)
    data, done = source.read_bytes(), 0
    for name, words, target in outputs(source):
        before = {path: path.stat() for path in tmp_path.rglob("*")}
        code, _, errors = said(*words)
        assert source.read_bytes() == data
        assert not temporary_in(tmp_path)
        if code == 0:
            done += 1
        else:
            lines = [line for line in errors.splitlines() if not line.startswith("Warning: ")]
            assert code == 1 and len(lines) == 1, (words, errors)
            assert "Unexpected" not in errors and errors.rstrip().endswith("."), errors
            made = [path for path in tmp_path.rglob("*") if path not in before and path.is_file()]
            assert not made, words
            continue
        if target is not None:
            compare_real(name, source, words, target)
        elif name == "tiles":
            assert np.array_equal(
                independent.read(tmp_path / "tiles" / source.name).points,
                independent.read(tmp_path / f"classified{target_suffix(source)}").points,
            )
    assert capfd.readouterr().err == ""
    record_property("commands", done)


def target_suffix(source):
    return ".las" if source.suffix == ".las" else ".laz"


def compare_real(name, source, words, target):
    """Compare what a command made of a file of another project; LASzip must be able to read it."""
    try:
        before = independent.read(words[1])
    except RuntimeError:  # LASzip does not read what lazrs does
        return
    after = independent.read(target)
    if target.name.endswith(".copc.laz"):
        nodes_are_whole(after)
        assert len(after.points) == len(before.points)
        if before.format >= 6:
            bits = (CLASS,)
            old, new = (without(las.points, las.format, *bits) for las in (before, after))
            assert np.array_equal(in_any_order(old), in_any_order(new))
        return
    kept_by(name, before, after)
