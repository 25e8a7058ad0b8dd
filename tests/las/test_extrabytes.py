"""An extra dimension and other heights in files of every version and format."""

import struct

import laspy
import numpy as np
import pytest
from las_files import EVERY
from matrices import covering

from bare_earth import BareEarthError
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.extrabytes import ExtraDimension
from bare_earth.algorithms.las.writing import write_changed

VALUES = np.linspace(-1.5, 40.0, 60).astype(np.float32)
HEIGHTS = Edits(extra=ExtraDimension("HeightAboveGround", "Above ground, metre", VALUES))


def descriptor(name, kind, options=0):
    return struct.pack("<2xBB32s156x", kind, options, name)


def described(las, *descriptors):
    return las.vlr(b"LASF_Spec", 4, b"".join(descriptors), b"as it was")


@pytest.mark.parametrize(
    ("layout", "read", "written"), covering(EVERY, ["las", "laz"], ["las", "laz"])
)
def test_four_bytes_are_added_and_the_rest_stays(las, layout, read, written):
    version, point_format = layout
    source = las.make(
        f"in.{read}",
        version=version,
        point_format=point_format,
        extra=3,
        vlrs=[las.vlr(b"somebody", 7, b"data")],
        evlrs=[las.evlr(b"behind", 9, b"the points")] if version == 4 else (),
        user_bytes=b"ours",
        padding=b"\xdd\xdd",
    )
    target = las.folder / f"out.{written}"
    write_changed(source, target, HEIGHTS)
    before, after = las.split(source), las.split(target)
    assert np.array_equal(after.records[:, :-4], before.records)
    assert np.array_equal(after.records[:, -4:].copy().view("<f4")[:, 0], VALUES)
    assert after.field("H", 105) == before.field("H", 105) + 4
    assert after.tail == before.tail and after.padding == before.padding
    assert (
        after.header[:96] == before.header[:96] and after.header[107:227] == before.header[107:227]
    )
    assert after.header.endswith(b"ours")
    assert before.vlrs[0] in after.vlrs
    read_again = laspy.read(target)
    assert np.array_equal(read_again["HeightAboveGround"], VALUES)
    # What nothing was said of comes before, and is described now.
    assert read_again["undocumented"].shape == (60, 3)


def test_a_dimension_is_added_behind_those_that_are_there(las):
    record = described(las, descriptor(b"amplitude", 3), descriptor(b"vector", 23))
    source = las.make("in.laz", version=4, point_format=7, extra=8, vlrs=[record])
    target = las.folder / "out.laz"
    write_changed(source, target, HEIGHTS)
    before, after = las.split(source), las.split(target)
    names = list(laspy.read(target).point_format.extra_dimension_names)
    assert names == ["amplitude", "vector", "HeightAboveGround"]
    assert np.array_equal(after.records[:, :-4], before.records)
    # In the place of the record, with its description, and what was in it.
    assert after.vlrs[0][54:].startswith(record[54:])
    assert after.vlrs[0][22:54] == record[22:54]


@pytest.mark.parametrize("kind, size", [(9, 4), (10, 8)])
def test_a_dimension_that_is_there_is_replaced_in_its_type(las, kind, size):
    record = described(las, descriptor(b"HeightAboveGround", kind), descriptor(b"last", 1))
    source = las.make(version=4, point_format=6, extra=size + 1, vlrs=[record])
    target = las.folder / "out.las"
    write_changed(source, target, HEIGHTS)
    before, after = las.split(source), las.split(target)
    assert np.array_equal(after.records[:, :30], before.records[:, :30])
    assert np.array_equal(after.records[:, -1], before.records[:, -1])
    found = after.records[:, 30 : 30 + size].copy().view(f"<f{size}")[:, 0]
    assert np.array_equal(found, VALUES)
    assert after.header == before.header
    again = las.folder / "again.las"
    write_changed(target, again, HEIGHTS)
    assert again.read_bytes() == target.read_bytes()


def test_the_range_and_the_description_are_told(las):
    source, target = las.make(version=4, point_format=6), las.folder / "out.las"
    write_changed(source, target, HEIGHTS)
    (record,) = las.split(target).vlrs
    data = record[54:]
    assert len(data) == 192 and data[2:4] == bytes([9, 0x06])
    assert struct.unpack_from("<d", data, 64) == (-1.5,)
    assert struct.unpack_from("<d", data, 88) == (40.0,)
    assert data[160:].rstrip(b"\0") == b"Above ground, metre"


def test_many_undocumented_bytes_get_several_descriptors(las):
    source, target = las.make(version=4, point_format=6, extra=300), las.folder / "out.laz"
    write_changed(source, target, HEIGHTS)
    after = las.split(target)
    assert np.array_equal(after.records[:, :-4], las.split(source).records)
    assert len(after.vlrs[0][54:]) == 3 * 192
    assert [after.vlrs[0][54 + 192 * k + 3] for k in (0, 1)] == [231, 69]


@pytest.mark.parametrize("extra", [1, 7, 8, 16, 24, 31, 40, 255, 300])
def test_laspy_reads_what_has_undocumented_bytes(las, extra):
    source, target = las.make(version=4, point_format=6, extra=extra), las.folder / "out.laz"
    write_changed(source, target, HEIGHTS)
    read = laspy.read(target)
    assert np.array_equal(read["HeightAboveGround"], VALUES)
    names = [*read.point_format.extra_dimension_names][:-1]
    raw = np.column_stack([np.asarray(read[name]).reshape(60, -1) for name in names])
    assert np.array_equal(raw, las.split(source).records[:, -extra:])


@pytest.mark.parametrize("written", ["out.las", "out.laz", "out.copc.laz"])
def test_a_record_behind_the_points_moves_before_them(las, written):
    data = descriptor(b"amplitude", 3)
    evlrs = [las.evlr(b"a", 1, b"one"), las.evlr(b"LASF_Spec", 4, data), las.evlr(b"b", 2, b"two")]
    source = las.make(version=4, point_format=6, extra=2, evlrs=evlrs)
    target = las.folder / written
    write_changed(source, target, HEIGHTS)
    with laspy.open(target) as file:
        names = list(file.header.point_format.extra_dimension_names)
        assert names == ["amplitude", "HeightAboveGround"]
        behind = [
            (record.user_id, record.record_data_bytes())
            for record in file.evlrs
            if record.user_id != "copc"
        ]
    assert ("a", b"one") in behind and ("b", b"two") in behind
    assert "LASF_Spec" not in dict(behind)


@pytest.mark.parametrize(
    "descriptors, text",
    [
        ([(b"too long", 10, 0)], "more extra bytes"),
        ([(b"unknown", 99, 0)], "more extra bytes"),
        ([(b"HeightAboveGround", 3, 0)], "HeightAboveGround.* float"),
        ([(b"HeightAboveGround", 9, 0x08)], "HeightAboveGround.* float"),
    ],
)
def test_what_cannot_be_followed_is_refused(las, descriptors, text):
    record = described(las, *(descriptor(*value) for value in descriptors))
    source = las.make(version=4, point_format=6, extra=4, vlrs=[record])
    with pytest.raises(BareEarthError, match=text):
        write_changed(source, las.folder / "out.las", HEIGHTS)
    assert list(las.folder.iterdir()) == [source]


@pytest.mark.parametrize(("layout", "name"), covering(EVERY, ["in.las", "in.laz"]))
def test_other_heights_change_z_and_its_range(las, layout, name):
    version, point_format = layout
    source = las.make(name, version=version, point_format=point_format, extra=2)
    target = las.folder / "out.las"
    z = np.arange(60, dtype=np.int32) * 100 - 500
    write_changed(source, target, Edits(z=z))
    before, after = las.split(source), las.split(target)
    assert np.array_equal(after.records[:, 8:12].copy().view("<i4")[:, 0], z)
    rest = np.r_[0:8, 12 : before.records.shape[1]]
    assert np.array_equal(after.records[:, rest], before.records[:, rest])
    assert after.field("d", 211) == pytest.approx(5400 * 0.001 + 100)
    assert after.field("d", 219) == pytest.approx(-500 * 0.001 + 100)
    assert after.header[107:211] == before.header[107:211]


@pytest.mark.parametrize("point_format", range(11))
def test_a_flag_is_set_cleared_or_left(las, point_format):
    source = las.make(version=4, point_format=point_format)
    target = las.folder / "out.las"
    wanted = (np.arange(60) % 3 - 1).astype(np.int8)
    write_changed(source, target, Edits(key_points=wanted))
    before, after = las.split(source).records, las.split(target).records
    bit = 0x40 if point_format < 6 else 0x02
    assert (after[wanted == 1, 15] & bit).all() and not (after[wanted == 0, 15] & bit).any()
    assert np.array_equal(after[wanted == -1], before[wanted == -1])
    after[:, 15] |= bit
    before[:, 15] |= bit
    assert np.array_equal(after, before)


def test_values_of_another_file_are_refused(las):
    source = las.make(count=59)
    with pytest.raises(BareEarthError, match="has changed while"):
        write_changed(source, las.folder / "out.las", HEIGHTS)
