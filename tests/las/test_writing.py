import errno
import struct

import laspy
import numpy as np
import pytest
from las_files import EVERY
from matrices import covering
from realdata import real
from runs import CancelAt, Heard
from surveys import write_classified

from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.las import edits
from bare_earth.algorithms.las import records as records_module
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.las.writing import check_writable

REAL = ("mixed_conifer.laz", "forest_topography.laz", "ign_pf8.las")


def new_classes(count, largest=31):
    return (np.arange(count) * 7 % (largest + 1)).astype(np.uint8)


def expected(records, point_format, classes):
    """The records with other classes, by the tables of the specification."""
    records = records.copy()
    if point_format < 6:
        for record, value in zip(records, classes):
            record[15] = (record[15] & 0b1110_0000) + value
    else:
        records[:, 16] = classes
    return records


def blank(header, *ranges):
    header = bytearray(header)
    for start, end in ranges:
        header[start:end] = bytes(end - start)
    return bytes(header)


@pytest.mark.parametrize(
    ("layout", "read", "written"), covering(EVERY, ["las", "laz"], ["las", "laz"])
)
def test_only_the_class_changes(las, layout, read, written):
    version, point_format = layout
    own = las.vlr(b"somebody", 7, b"else's data", b"\xff not text")
    source = las.make(
        f"in.{read}",
        version=version,
        point_format=point_format,
        extra=3,
        vlrs=[own, las.vlr(b"", 0, b"")],
        evlrs=[las.evlr(b"behind", 9, b"the points")] if version == 4 else (),
    )
    target = las.folder / f"out.{written}"
    classes = new_classes(60, 31 if point_format < 6 else 255)
    write_classified(source, target, classes)
    before, after = las.split(source), las.split(target)
    np.testing.assert_array_equal(after.records, expected(before.records, point_format, classes))
    assert after.tail == before.tail
    assert after.padding == before.padding
    if read == written:
        if read == "las":
            assert after.header == before.header
            assert after.vlrs == before.vlrs
        else:  # the record of lazrs is written anew, and the length of the points changes
            assert blank(after.header, (235, 243)) == blank(before.header, (235, 243))
            assert after.vlrs[:2] == before.vlrs[:2] and len(after.vlrs) == 3
    else:
        # Where points and EVLRs start, how many VLRs there are, and the mark of compression.
        changed = (96, 105), (235, 243)
        assert blank(after.header, *changed) == blank(before.header, *changed)
        assert after.field("B", 104) == point_format | (0x80 if written == "laz" else 0)
        assert after.vlrs[:2] == before.vlrs[:2]
        assert len(after.vlrs) == (3 if written == "laz" else 2)


@pytest.mark.parametrize("written", ["las", "laz"])
def test_nothing_is_told_where_nothing_is_left_out(las, written):
    heard = Heard()
    write_classified(las.make("in.las"), las.folder / f"out.{written}", new_classes(60), heard)
    assert (heard.infos, heard.warnings) == ([], [])


@pytest.mark.parametrize(("version", "point_format"), EVERY)
def test_to_laz_and_back_gives_the_same_bytes(las, version, point_format):
    source = las.make(
        version=version,
        point_format=point_format,
        vlrs=[las.vlr(b"somebody", 7, b"data")],
        padding=b"\xdd\xdd",
        evlrs=[las.evlr(b"a", 1, b"one"), las.evlr(b"b", 2, b"two")] if version == 4 else (),
    )
    classes = read_cloud(source).classification
    packed, back = las.folder / "packed.laz", las.folder / "back.las"
    write_classified(source, packed, classes)
    write_classified(packed, back, classes)
    assert back.read_bytes() == source.read_bytes()


@pytest.mark.parametrize("name", ["in.las", "in.laz"])
def test_what_others_read_is_what_was_written(las, name):
    source = las.make(name, version=4, point_format=8, extra=2)
    target = las.folder / "out.laz"
    write_classified(source, target, new_classes(60, 255))
    before, after = laspy.read(source), laspy.read(target)
    np.testing.assert_array_equal(after.classification, new_classes(60, 255))
    for name in set(before.point_format.dimension_names) - {"classification"}:
        np.testing.assert_array_equal(after[name], before[name], err_msg=name)


@pytest.mark.parametrize("written", ["las", "laz"])
def test_bytes_that_users_added_to_header_and_padding_stay(las, written):
    source = las.make(
        user_bytes=b"our own", padding=b"\xdd\xdd and more", vlrs=[las.vlr(b"u", 1, b"d")]
    )
    target = las.folder / f"out.{written}"
    write_classified(source, target, new_classes(60))
    after = las.split(target)
    assert after.header.endswith(b"our own")
    assert after.padding == b"\xdd\xdd and more"
    assert laspy.read(target).header.point_count == 60


@pytest.mark.parametrize("written", ["las", "laz"])
def test_evlrs_behind_laz_points_are_found_where_the_header_says(las, written):
    source = las.make(
        "in.laz", version=4, point_format=6, evlrs=[las.evlr(b"behind", 9, b"x" * 5000)]
    )
    target = las.folder / f"out.{written}"
    write_classified(source, target, new_classes(60))
    with laspy.open(target) as file:
        (record,) = file.evlrs
        assert (record.user_id, record.record_id) == ("behind", 9)
        assert record.record_data_bytes() == b"x" * 5000


def waveform_file(las, name):
    """A file with waveform packets inside, in the one record that LAS 1.3 has for them."""
    packets = las.evlr(b"LASF_Spec", 65535, bytes(range(200)))
    plain = las.bytes(version=3, point_format=4, compressed=name.endswith(".laz"))
    path = las.folder / name
    data = bytearray(plain + packets)
    struct.pack_into("<Q", data, 227, len(plain))
    path.write_bytes(data)
    return path, packets


@pytest.mark.parametrize("written", ["las", "laz"])
@pytest.mark.parametrize("read", ["las", "laz"])
def test_waveforms_inside_the_file_move_with_their_pointer(las, read, written):
    source, packets = waveform_file(las, f"in.{read}")
    target = las.folder / f"out.{written}"
    write_classified(source, target, new_classes(60))
    data = target.read_bytes()
    assert data.endswith(packets)
    assert struct.unpack_from("<Q", data, 227)[0] == len(data) - len(packets)


@pytest.mark.parametrize("written", ["las", "laz"])
@pytest.mark.parametrize("stale", [1, 227, 10**15])
def test_a_stale_waveform_pointer_is_copied_and_cuts_nothing_off(las, stale, written):
    source = las.make("in.laz", version=3, point_format=1, waveform_start=stale)
    target = las.folder / f"out.{written}"
    write_classified(source, target, new_classes(60))
    after = las.split(target)
    assert after.field("Q", 227) == stale
    np.testing.assert_array_equal(
        after.records, expected(las.split(source).records, 1, new_classes(60))
    )


def test_waveforms_in_a_file_beside_are_told(las):
    heard = Heard()
    source = las.make(version=3, point_format=4, encoding=0x04)
    write_classified(source, las.folder / "out.las", new_classes(60), heard)
    assert any("in.wdp" in text and "out.wdp" in text for text in heard.warnings)


def test_waveforms_in_a_file_beside_are_told_with_the_name_of_the_output(las, capsys):
    from bare_earth.algorithms.cli import main

    source = las.make("in.las", version=3, point_format=4, encoding=0x04)
    main(["classify", str(source), str(las.folder / "named.las")])
    assert "copy in.wdp to named.wdp" in capsys.readouterr().err


def test_bytes_after_the_points_of_las_stay(las):
    source = las.make(tail=b"whatever this is")
    target = las.folder / "out.las"
    write_classified(source, target, new_classes(60))
    assert target.read_bytes().endswith(b"whatever this is")


def test_several_chunks_are_joined_in_order(las, monkeypatch):
    read = records_module.read_records
    monkeypatch.setattr(edits, "read_records", lambda layout: read(layout, 17))
    source, target = las.make("in.laz", count=60), las.folder / "out.laz"
    write_classified(source, target, new_classes(60))
    np.testing.assert_array_equal(
        las.split(target).records, expected(las.split(source).records, 1, new_classes(60))
    )


@pytest.mark.parametrize("point_format", range(6))
def test_a_class_above_31_is_refused_where_the_format_has_no_room(las, point_format):
    source = las.make(version=3, point_format=point_format)
    target = las.folder / "out.las"
    with pytest.raises(BareEarthError, match=rf"format {point_format} .* 31\b"):
        write_classified(source, target, np.full(60, 32, np.uint8))
    assert list(las.folder.iterdir()) == [source]


@pytest.mark.parametrize("point_format", [9, 10])
def test_waveforms_of_several_channels_are_not_garbled_but_refused_as_laz(las, point_format):
    records = las.records(point_format)
    records[::2, 15] |= 0x10
    source = las.make(version=4, point_format=point_format, records=records)
    with pytest.raises(BareEarthError, match=r"scanner channels.* \.las\b"):
        write_classified(source, las.folder / "out.laz", new_classes(60))
    assert list(las.folder.iterdir()) == [source]
    write_classified(source, las.folder / "out.las", new_classes(60))
    np.testing.assert_array_equal(
        las.split(las.folder / "out.las").records, expected(records, point_format, new_classes(60))
    )


def test_a_wrong_number_of_classes_is_refused(las):
    source = las.make()
    with pytest.raises(BareEarthError, match="has changed while"):
        write_classified(source, las.folder / "out.las", new_classes(59))
    assert list(las.folder.iterdir()) == [source]


@pytest.mark.parametrize("name", ["out.las", "out.laz", "out.copc.laz"])
def test_a_cancel_in_the_middle_leaves_the_old_output_and_nothing_else(las, name):
    source, target = las.make(), las.folder / name
    target.write_bytes(b"old")
    with pytest.raises(Cancelled):
        write_classified(source, target, new_classes(60), CancelAt())
    assert target.read_bytes() == b"old"
    assert sorted(las.folder.iterdir()) == sorted([source, target])


@pytest.mark.parametrize("name", ["out.las", "out.laz", "out.copc.laz"])
@pytest.mark.parametrize("room", [0, 300, 900])
def test_a_full_disk_is_told_and_leaves_nothing(las, monkeypatch, name, room):
    """A file that takes only so many bytes stands in for the full disk."""
    real_open = open

    class Full:
        def __init__(self, file):
            self._file = file

        def write(self, data):
            if self._file.tell() + memoryview(data).nbytes > room:
                raise OSError(errno.ENOSPC, "No space left on device")
            return self._file.write(data)

        def __enter__(self):
            return self

        def __exit__(self, *_):
            self._file.close()

        def __getattr__(self, name):
            return getattr(self._file, name)

    def opened(path, mode="r", *rest):
        file = real_open(path, mode, *rest)
        return Full(file) if "w" in mode else file

    source = las.make(count=400)
    for module in ("writing", "copc"):
        monkeypatch.setattr(f"bare_earth.algorithms.las.{module}.open", opened, raising=False)
    with pytest.raises(BareEarthError, match=r"out\.\S+: .*disk.* full"):
        write_classified(source, las.folder / name, new_classes(400))
    assert list(las.folder.iterdir()) == [source]


@pytest.mark.parametrize("name", ["out.txt", "out", "out.las.zip", "las"])
def test_another_suffix_is_refused(tmp_path, name):
    with pytest.raises(BareEarthError, match=r"\.las, \.laz or \.copc\.laz"):
        check_writable(tmp_path / name)


@pytest.mark.parametrize("name", ["OUT.LAS", "out.Laz", "out.COPC.LAZ"])
def test_the_case_of_the_suffix_does_not_matter(las, name):
    source = las.make()
    write_classified(source, las.folder / name, new_classes(60))
    with laspy.open(las.folder / name) as file:
        assert file.header.are_points_compressed == name.lower().endswith("laz")


def test_a_missing_folder_is_told(las):
    source = las.make()
    with pytest.raises(BareEarthError, match="Cannot write"):
        write_classified(source, las.folder / "none" / "out.las", new_classes(60))
    assert list(las.folder.iterdir()) == [source]


@pytest.mark.rest(but="ign_pf8.las-las")
@pytest.mark.parametrize(("name", "written"), covering(REAL, ["las", "laz"]))
def test_real_files_keep_all_but_the_class(las, name, written):
    source = real(f"real/{name}")
    target = las.folder / f"out.{written}"
    cloud = read_cloud(source)
    classes = new_classes(cloud.count)
    write_classified(source, target, classes)
    before, after = laspy.read(source), laspy.read(target)
    np.testing.assert_array_equal(after.classification, classes)
    for dimension in set(before.point_format.dimension_names) - {"classification"}:
        np.testing.assert_array_equal(after[dimension], before[dimension], err_msg=dimension)
    one, other = las.split(source), las.split(target)
    point_format = one.field("B", 104) & 0x3F
    changed = 15 if point_format < 6 else 16
    rest = [column for column in range(one.records.shape[1]) if column != changed]
    np.testing.assert_array_equal(other.records[:, rest], one.records[:, rest])
    mark = b"laszip encoded"
    assert [record for record in other.vlrs if record[2:16] != mark] == [
        record for record in one.vlrs if record[2:16] != mark
    ]
    assert blank(other.header, (96, 105), (235, 243)) == blank(one.header, (96, 105), (235, 243))
    if written == "las":
        back = las.folder / "back.laz"
        write_classified(target, back, classes)
        np.testing.assert_array_equal(las.split(back).records, other.records)
