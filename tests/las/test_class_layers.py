"""Classes replaced in compressed points, of which nothing else is compressed again."""

import io
import struct

import lazrs
import numpy as np
import pytest
from surveys import write_classified

from bare_earth import BareEarthError
from bare_earth.algorithms.las import class_layers as module
from bare_earth.algorithms.las import copc_octree
from bare_earth.algorithms.las.class_layers import class_layers
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.lasfile import LASZIP
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.las.writing import write_changed

COUNT, CHUNK, CLASS_LAYER = 24_000, 10_000, 2
LAYERS = {6: 9, 7: 10, 8: 11}


def classes_of(count, seed=5):
    """Return classes that change often, and not at all for a while."""
    classes = np.random.default_rng(seed).choice([1, 2, 2, 2, 5, 200], count).astype(np.uint8)
    classes[count // 3 : count // 2] = 2
    return classes


def chunks_of(path):
    """Return the first point and the layers of each chunk of a file."""
    layout = open_las(path)
    with open(path, "rb") as file:
        file.seek(layout.points_start)
        table = lazrs.read_chunk_table(file, lazrs.LazVlr(layout.vlr(LASZIP).data))
        file.seek(layout.points_start + 8)
        chunks = [file.read(size) for _, size in table]
    number = LAYERS[layout.point_format] + layout.extra_bytes
    found = []
    for chunk in chunks:
        first, rest = chunk[: layout.record_length], chunk[layout.record_length :]
        count, *sizes = struct.unpack_from(f"<{1 + number}I", rest)
        ends = 4 + 4 * number + np.cumsum([0, *sizes])
        found.append((first, count, [rest[a:b] for a, b in zip(ends, ends[1:])]))
    return found


@pytest.mark.rest(but="6-0-False")
@pytest.mark.parametrize("in_memory", [True, False])
@pytest.mark.parametrize(("point_format", "extra"), [(6, 0), (7, 3), (8, 0)])
def test_only_the_layer_of_the_classes_is_another(las, monkeypatch, point_format, extra, in_memory):
    monkeypatch.setattr(module, "_POINTS_A_GROUP", 12_000)
    made = {"version": 4, "point_format": point_format, "extra": extra, "chunk_size": CHUNK}
    records = las.records(point_format, COUNT, extra)
    records[:, 15] &= 0xDF  # two scanner channels
    records[: COUNT // 4, 15] &= 0xCF  # of which the second is not there at first
    records[::97, 14] = 0  # return 0 of 0, as some writers have it
    source = las.make("in.laz", records=records, **made)
    target, classes = las.folder / "out.laz", classes_of(COUNT)
    cloud = read_cloud(source) if in_memory else None
    write_changed(source, target, Edits(classification=classes), cloud=cloud)
    records[:, 16] = classes
    np.testing.assert_array_equal(las.split(target).records, records)
    # As if all of it had been compressed anew.
    whole = las.make("all.laz", records=records, **made)
    assert target.read_bytes() == whole.read_bytes()
    pairs = list(zip(chunks_of(source), chunks_of(target)))
    assert len(pairs) == 3
    for (_, count, before), (first, same_count, after) in pairs:
        assert count == same_count and first[16] in (1, 2, 5, 200)
        differ = [
            number for number, layers in enumerate(zip(before, after)) if len(set(layers)) > 1
        ]
        assert differ == [CLASS_LAYER]


def test_classes_that_are_all_the_same_take_next_to_nothing(las):
    records = las.records(6, COUNT)
    source, target = (
        las.make("in.laz", version=4, point_format=6, records=records),
        las.folder / "o.laz",
    )
    write_classified(source, target, np.full(COUNT, 2, np.uint8))
    for first, _, layers in chunks_of(target):
        assert first[16] == 2 and len(layers[CLASS_LAYER]) < 5000  # mostly 0
    assert (las.split(target).records[:, 16] == 2).all()


@pytest.mark.rest
def test_chunks_of_any_size_stay_as_they_are(las, monkeypatch):
    """A COPC file has a chunk for each node, most of them small."""
    monkeypatch.setattr(module, "_POINTS_A_GROUP", 6_000)
    monkeypatch.setattr(copc_octree, "_LEAF_POINTS", 20_000)
    records = las.records(6, 40_000)
    plain = las.make("in.laz", version=4, point_format=6, records=records)
    copc, target = las.folder / "in.copc.laz", las.folder / "out.laz"
    write_classified(plain, copc, records[:, 16])
    order, classes = las.split(copc).records, classes_of(40_000)
    write_classified(copc, target, classes)
    order[:, 16] = classes
    np.testing.assert_array_equal(las.split(target).records, order)
    counts = [[count for _, count, _ in chunks_of(path)] for path in (copc, target)]
    assert counts[0] == counts[1] and len(set(counts[0])) > 1


def test_nothing_but_the_returns_is_decompressed_and_not_even_they_if_they_are_known(
    las, monkeypatch
):
    source, intensities = las.make("in.laz", version=4, point_format=6, count=5000), 4
    # One of the other layers holds what no decompressor understands.
    ((first, _, layers),) = chunks_of(source)
    data, start = source.read_bytes(), open_las(source).points_start + 8
    start += len(first) + 4 + 4 * len(layers) + sum(map(len, layers[:intensities]))
    noise = np.random.default_rng(1).bytes(len(layers[intensities]))
    source.write_bytes(data[:start] + noise + data[start + len(noise) :])
    cloud, classes, asked = read_cloud(source), classes_of(5000), []
    read = module.read_records

    def heard(layout, most, columns, pieces):
        asked.append(columns)
        return read(layout, most, columns=columns, pieces=pieces)

    monkeypatch.setattr(module, "read_records", heard)
    changes = Edits(classification=classes)
    write_changed(source, las.folder / "known.laz", changes, cloud=cloud)
    assert asked == []
    write_changed(source, las.folder / "read.laz", changes)
    assert asked == [()]
    assert (las.folder / "known.laz").read_bytes() == (las.folder / "read.laz").read_bytes()
    ((_, _, after),) = chunks_of(las.folder / "read.laz")
    assert after[intensities] == noise


@pytest.mark.parametrize("point_format", range(6))
def test_older_point_formats_have_no_layers(las, point_format):
    assert class_layers(open_las(las.make("in.laz", version=3, point_format=point_format))) is None
    assert class_layers(open_las(las.make("in.las", version=3, point_format=point_format))) is None


def test_chunks_that_are_made_otherwise_are_compressed_anew(las, monkeypatch):
    """Where lengths do not add up, the decompressor has to say what is in the file."""
    source = las.make("in.laz", version=4, point_format=6, count=2000)
    data, start = bytearray(source.read_bytes()), open_las(source).points_start
    # One more byte of the last layer than there are: the decompressor does not mind.
    place = start + 8 + 30 + 4 + 4 * 8
    (length,) = struct.unpack_from("<I", data, place)
    struct.pack_into("<I", data, place, length - 1)
    source.write_bytes(data)
    assert class_layers(open_las(source)) is None


def test_a_file_of_a_writer_that_could_not_go_back_is_read(las):
    """The place of the chunk table stands in the last eight bytes then."""
    records = las.records(6, COUNT)
    source = las.make("in.laz", version=4, point_format=6, records=records)
    data, start = bytearray(source.read_bytes()), open_las(source).points_start
    place = bytes(data[start : start + 8])
    data[start : start + 8] = b"\xff" * 8
    source.write_bytes(data + place)
    assert class_layers(open_las(source)) is not None
    records[:, 16] = classes_of(COUNT)
    target = las.folder / "out.laz"
    write_classified(source, target, classes_of(COUNT))
    np.testing.assert_array_equal(las.split(target).records, records)
    assert target.read_bytes()[start : start + 8] != b"\xff" * 8


def test_a_cut_off_file_is_told_and_leaves_nothing(las):
    source = las.make("in.laz", version=4, point_format=6, records=las.records(6, COUNT))
    layers = class_layers(open_las(source))
    data = source.read_bytes()
    source.write_bytes(data[: len(data) // 2])
    cloud_free = layers.write(io.BytesIO(), classes_of(COUNT))
    with pytest.raises(BareEarthError, match="cut off"):
        list(cloud_free)
