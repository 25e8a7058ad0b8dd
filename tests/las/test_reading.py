import dataclasses

import laspy
import lazrs
import numpy as np
import pytest
from las_files import EVERY
from matrices import covering
from realdata import real
from runs import CancelAt, Heard, said

import bare_earth
from bare_earth import Cancelled
from bare_earth.algorithms.core import progress
from bare_earth.algorithms.crs.system import Crs
from bare_earth.algorithms.las.reading import read_cloud, read_parts


@pytest.mark.parametrize(("layout", "name"), covering(EVERY, ["in.las", "in.laz"]))
def test_each_column_is_what_the_bytes_say(las, layout, name):
    version, point_format = layout
    records = las.records(point_format, extra=2)
    cloud = read_cloud(las.make(name, version=version, point_format=point_format, records=records))
    xyz = records[:, :12].copy().view("<i4")
    for column, integers in zip((cloud.x, cloud.y, cloud.z), xyz.T):
        np.testing.assert_array_equal(column, integers)
    bits = records[:, 14]
    if point_format < 6:
        number, total = bits & 7, bits >> 3 & 7
        classes, withheld = records[:, 15] & 31, records[:, 15] & 0x80 > 0
    else:
        number, total = bits & 15, bits >> 4
        classes, withheld = records[:, 16], records[:, 15] & 4 > 0
    np.testing.assert_array_equal(cloud.return_number, number)
    np.testing.assert_array_equal(cloud.number_of_returns, total)
    np.testing.assert_array_equal(cloud.classification, classes)
    np.testing.assert_array_equal(cloud.withheld, withheld)
    assert withheld.any() and not withheld.all()
    assert (cloud.count, cloud.point_format) == (60, point_format)
    assert (cloud.scale, cloud.offset) == (las.SCALE, las.OFFSET)


@pytest.mark.parametrize("name", ["in.las", "in.laz"])
@pytest.mark.parametrize("point_format", range(11))
def test_with_its_records_a_cloud_is_the_same(las, point_format, name):
    try:
        path = las.make(name, version=4, point_format=point_format, extra=3)
    except lazrs.LazrsError:
        pytest.skip("this lazrs compresses no waveforms")
    cloud, kept = read_cloud(path), read_cloud(path, keep_records=True)
    for field in dataclasses.fields(cloud):
        if field.name != "records":
            one, other = getattr(cloud, field.name), getattr(kept, field.name)
            assert getattr(one, "dtype", None) == getattr(other, "dtype", None)
            assert np.array_equal(one, other) if isinstance(one, np.ndarray) else one == other
    np.testing.assert_array_equal(kept.records, las.split(path).records)


@pytest.mark.parametrize(
    ("pairs", "is_from_zero"),
    [
        ([(0, 1), (0, 2), (1, 2)], True),
        ([(0, 3), (1, 3), (2, 3)], True),
        ([(0, 0), (0, 1), (1, 1), (0, 2), (1, 2), (2, 2)], True),
        ([(0, 0), (0, 1), (1, 1)], True),
        ([(0, 1), (0, 2), (1, 2), (1, 1), (1, 2), (2, 2)], False),
        ([(0, 6)], False),
        ([(0, 0)], False),
        ([(0, 1), (1, 1)], False),
        ([(1, 1), (1, 2), (2, 2), (0, 0)], False),
        ([(1, 2), (2, 2), (0, 2)], False),
    ],
)
def test_return_numbers_begin_at_1_whatever_the_file_says(las, pairs, is_from_zero):
    records = las.records(6)
    records[:, 14] = [number | total << 4 for number, total in (pairs * 60)[:60]]
    cloud = read_cloud(las.make("in.laz", version=4, point_format=6, records=records))
    assert cloud.from_zero == is_from_zero
    np.testing.assert_array_equal(cloud.return_number, (records[:, 14] & 15) + is_from_zero)
    both = is_from_zero and (0, 0) in pairs
    np.testing.assert_array_equal(cloud.number_of_returns, (records[:, 14] >> 4) + both)
    (part,) = read_parts(cloud.file)
    np.testing.assert_array_equal(part.return_number, cloud.return_number)
    told = Heard()
    assert set(bare_earth.info(cloud.path, progress=told).returns) == {
        number for number, _ in pairs
    }
    assert any("begin at 0" in text for text in told.warnings) == is_from_zero


@pytest.mark.rest
@pytest.mark.parametrize("name", ["out.laz", "out.copc.laz"])
def test_returns_from_zero_give_the_ground_and_stay_as_they_are(tmp_path, name):
    source, target = real("field2/returns-from-zero.laz"), tmp_path / name
    code, _, told = said("classify", source, target)
    assert code == 0 and told.count("begin at 0") == 1 and "no return number" not in told
    one, other = laspy.read(source), laspy.read(target)
    order = [
        np.lexsort((value.return_number, value.gps_time, value.Y, value.X))
        for value in (one, other)
    ]
    number, truth = (np.asarray(one[key])[order[0]] for key in ("return_number", "user_data"))
    np.testing.assert_array_equal(np.asarray(other.return_number)[order[1]], number)
    ground = np.asarray(other.classification)[order[1]] == 2
    assert ground[truth == 1].mean() > 0.99 and ground[truth == 0].mean() < 0.01


def test_several_chunks_are_joined_in_order(las, monkeypatch):
    monkeypatch.setattr(progress, "_FIRST_PIECE", 17)
    records, told = las.records(1), Heard()
    cloud = read_cloud(las.make("in.laz", records=records), told)
    np.testing.assert_array_equal(cloud.x, records[:, :4].copy().view("<i4")[:, 0])
    assert told.fractions == pytest.approx([17 / 60, 51 / 60, 1])


def test_reading_can_be_cancelled(las):
    with pytest.raises(Cancelled):
        read_cloud(las.make(), CancelAt())


def test_points_are_metres_from_a_round_place_near_the_corner_of_the_cloud(las):
    cloud = read_cloud(las.make())
    points = cloud.points(np.arange(cloud.count) % 2 == 0)
    truth = laspy.read(cloud.path).xyz
    origin = np.array([*cloud.frame.origin, 0.0])
    np.testing.assert_allclose(
        np.column_stack((points.x, points.y, points.z)) + origin, truth[::2], atol=1e-8
    )
    assert (origin[:2] % 10_000 == 0).all()
    assert ((origin <= truth.min(axis=0)) & (truth.min(axis=0) < origin + 10_000))[:2].all()


def test_points_in_feet_become_metres_with_heights_in_their_own_unit(las):
    cloud = read_cloud(las.make())
    everything = np.ones(cloud.count, bool)
    metres = cloud.points(everything)
    cloud.crs = Crs(horizontal_unit=1200 / 3937, vertical_unit=0.3048)
    feet = cloud.points(everything)
    np.testing.assert_allclose(feet.x, metres.x * 1200 / 3937, rtol=1e-12)
    np.testing.assert_allclose(feet.y, metres.y * 1200 / 3937, rtol=1e-12)
    np.testing.assert_allclose(feet.z, metres.z * 0.3048, rtol=1e-12)


@pytest.mark.parametrize("name", ["in.las", "in.laz"])
def test_inspect_describes_the_file(las, name):
    source = las.make(
        name, version=4, point_format=7, vlrs=[las.vlr(b"somebody", 7, b"data")],
        evlrs=[las.evlr(b"behind", 9, b"x")],
    )  # fmt: skip
    described, truth = bare_earth.info(source), laspy.read(source)
    assert described.point_count == sum(described.classes.values()) == 60
    assert described.returns == {
        int(value): int(count)
        for value, count in zip(*np.unique(truth.return_number, return_counts=True))
    }
    assert described.minimum == pytest.approx(tuple(truth.xyz.min(axis=0)))
    assert described.maximum == pytest.approx(tuple(truth.xyz.max(axis=0)))
    assert described.withheld == np.count_nonzero(truth.withheld)
    area = np.prod(np.ptp(truth.xyz[:, :2], axis=0))
    assert described.density == pytest.approx(60 / area)
    assert "somebody 7 made by hand" in described.records
    assert "behind 9 made by hand" in described.records
    text = "\n".join(described.lines())
    assert "LAS 1.4" in text and "point format 7" in text and str(source) in text
    assert described.as_dict()["encoding"] == ("LAZ" if name.endswith("laz") else "uncompressed")
