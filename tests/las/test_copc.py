import functools
import re
import struct
import tracemalloc

import laspy
import numpy as np
import pytest
from fulldisks import TELLS, become_full
from laspy import CopcReader
from matrices import covering
from runs import CancelAt, Heard
from surveys import write_classified

from bare_earth import BareEarthError, Cancelled, info
from bare_earth.algorithms.las import copc, copc_octree, copc_points, edits
from bare_earth.algorithms.las.copc_octree import TOP, Cube, SortedPoints, keys_of, nodes_of
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.extrabytes import ExtraDimension
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.las.records import read_records
from bare_earth.algorithms.las.writing import write_changed

NEW_FORMAT = {0: 6, 1: 6, 2: 7, 3: 7, 4: 6, 5: 7, 6: 6, 7: 7, 8: 8, 9: 6, 10: 8}
FOOT_CRS = 'PROJCS["feet",GEOGCS["g",UNIT["degree",0.0174]],UNIT["US survey foot",0.30480060960]]'
COMMON = ("X", "Y", "Z", "intensity", "return_number", "number_of_returns", "scan_direction_flag",
          "edge_of_flight_line", "user_data", "point_source_id", "synthetic", "key_point",
          "withheld")  # fmt: skip


def classes_of(count):
    return (np.arange(count) * 7 % 256).astype(np.uint8)


def order_of(points):
    return np.lexsort((points["X"], points["Y"], points["Z"], points["intensity"]))


def cloud_of(count, seed=3, spread=40_000):
    """Records of format 6 on a slope with a few high points."""
    noise = np.random.default_rng(seed)
    records = np.zeros((count, 30), np.uint8)
    xyz = np.empty((count, 3), "<i4")
    xyz[:, :2] = noise.integers(-spread, spread, (count, 2))
    xyz[:, 2] = xyz[:, 0] // 5 + noise.integers(0, 900, count) * (noise.random(count) < 0.2)
    records[:, :12] = xyz.view(np.uint8).reshape(count, 12)
    records[:, 12:14] = noise.integers(0, 256, (count, 2))
    records[:, 14] = 0x11
    return records


@pytest.mark.parametrize("name", ["in.las", "in.laz"])
@pytest.mark.parametrize("point_format", range(11))
def test_every_point_is_kept_with_all_its_fields(las, point_format, name):
    version = 4 if point_format > 5 else 3
    extra_record = las.vlr(b"LASF_Spec", 4, extra_bytes_vlr(b"amount"))
    source = las.make(
        name, version=version, point_format=point_format, extra=2, vlrs=[extra_record], count=500
    )
    target = las.folder / "out.copc.laz"
    write_classified(source, target, classes_of(500))
    before, after = laspy.read(source), laspy.read(target)
    assert after.header.point_format.id == NEW_FORMAT[point_format]
    assert str(after.header.version) == "1.4"
    np.testing.assert_array_equal(after.header.scales, las.SCALE)
    np.testing.assert_array_equal(after.header.offsets, las.OFFSET)
    one, other = order_of(before), order_of(after)
    names = [*COMMON, "amount"]
    both = set(before.point_format.dimension_names) & set(after.point_format.dimension_names)
    names += sorted(
        both & {"gps_time", "red", "green", "blue", "nir", "overlap", "scanner_channel"}
    )
    for key in names:
        np.testing.assert_array_equal(after[key][other], before[key][one], err_msg=key)
    np.testing.assert_array_equal(after.classification[other], classes_of(500)[one])
    if point_format < 6:
        degrees = np.asarray(before.scan_angle_rank)[one]
        np.testing.assert_allclose(after.scan_angle[other] * 0.006, degrees, atol=0.003)
        assert not np.asarray(after.overlap).any()
    else:
        np.testing.assert_array_equal(after.scan_angle[other], before.scan_angle[one])
    if point_format in (0, 2):
        assert not np.asarray(after.gps_time).any()


def extra_bytes_vlr(name):
    return struct.pack("<2sBB32s4s24s24s24s24s24s32s", b"", 3, 0, name, *[b""] * 7)


def test_header_and_info_say_what_the_points_are(las):
    source = las.make(version=4, point_format=7, count=400)
    target = las.folder / "out.copc.laz"
    write_classified(source, target, classes_of(400))
    before = laspy.read(source)
    with CopcReader.open(target) as reader:
        header, info = reader.header, reader.copc_info
        for axis in range(3):
            values = np.asarray(before.xyz[:, axis])
            assert header.mins[axis] == pytest.approx(values.min(), abs=1e-9)
            assert header.maxs[axis] == pytest.approx(values.max(), abs=1e-9)
        assert header.point_count == 400
        numbers = np.bincount(before.return_number, minlength=16)[1:]
        np.testing.assert_array_equal(header.number_of_points_by_return, numbers)
        assert (info.gps_min, info.gps_max) == (before.gps_time.min(), before.gps_time.max())
        assert (header.mins >= info.center - info.halfsize - 1e-6).all()
        assert (header.maxs <= info.center + info.halfsize + 1e-6).all()
        assert info.spacing == pytest.approx(2 * info.halfsize / 128)
        assert header.system_identifier == "a system"
        assert header.generating_software == "some software"
        assert (header.creation_date.year, header.file_source_id) == (2021, 77)


@pytest.fixture
def small_leaves(monkeypatch):
    monkeypatch.setattr(copc_octree, "_LEAF_POINTS", 3000)
    monkeypatch.setattr(copc_octree, "_SMALL_NODE", 50)
    monkeypatch.setattr(copc, "_BATCH", 5000)


def test_levels_get_denser_and_a_query_of_a_box_is_complete(las, small_leaves):
    records = cloud_of(60_000)
    source = las.make(version=4, point_format=6, records=records)
    target = las.folder / "out.copc.laz"
    write_classified(source, target, classes_of(60_000))
    before = laspy.read(source)
    with CopcReader.open(target) as reader:
        levels = [len(reader.query(level=level)) for level in range(6)]
        assert len(levels) - levels.count(0) >= 3
        assert sum(levels) == 60_000
        box = laspy.copc.Bounds(mins=np.array([399_900.0, 4_999_950.0]),
                                maxs=np.array([400_020.0, 5_000_100.0]))  # fmt: skip
        found = reader.query(bounds=box)
    x, y = np.asarray(before.x), np.asarray(before.y)
    inside = (x >= 399_900) & (x <= 400_020) & (y >= 4_999_950) & (y <= 5_000_100)
    assert inside.sum() > 1000
    assert len(found) == inside.sum()


def test_an_independent_library_finds_every_point_inside_its_node(las, small_leaves):
    copclib = pytest.importorskip("copclib")
    source = las.make(version=4, point_format=6, records=cloud_of(30_000))
    target = las.folder / "out.copc.laz"
    write_classified(source, target, classes_of(30_000))
    reader = copclib.FileReader(str(target))
    nodes = reader.GetAllNodes()
    assert len(nodes) > 10
    assert sum(node.point_count for node in nodes) == 30_000
    assert reader.ValidateSpatialBounds()


def xyz_of(records):
    return records[:, :12].copy().view("<i4") * 0.01


def octree_of(records):
    """Return the cube, and the key and the records of each node."""
    xyz = xyz_of(records)
    corner = xyz.min(axis=0)
    cube = Cube(corner, float((xyz.max(axis=0) - corner).max()), (0.01,) * 3, (0.0,) * 3)
    nodes = list(nodes_of(SortedPoints.of(TOP, records, cube)))
    keys = map(tuple, keys_of([node for node, _ in nodes]).tolist())
    return cube, dict(zip(keys, (found for _, found in nodes)))


def test_no_two_points_of_a_node_above_others_share_a_cell(small_leaves):
    records = cloud_of(20_000)
    cube, nodes = octree_of(records)

    def cells_of(some):
        cells = np.floor((xyz_of(some) - cube.corner) / cube.side * 128)
        return len(np.unique(cells.clip(0, 127).astype(int), axis=0))

    # The small children that stay with the node above come on top of one a cell.
    top = nodes[0, 0, 0, 0]
    assert cells_of(top) == cells_of(records)
    assert len(top) - cells_of(top) < 8 * 50
    assert all(map(len, nodes.values()))


def nodes_by_the_rule(records, cube):
    """Return the points of each node, worked out point by point and node by node."""
    within = (xyz_of(records) - cube.corner) / cube.side
    cells = np.floor(within * (1 << 21)).clip(0, (1 << 21) - 1).astype(int)
    nodes, todo = {}, [((0, 0, 0, 0), list(range(len(records))))]
    while todo:
        key, mine = todo.pop()
        seen, taken, left = set(), [], {}
        for point in mine:
            cell = tuple(cells[point] >> (14 - key[0]))
            if len(mine) <= 3000 or key[0] == 14 or cell not in seen:
                seen.add(cell)
                taken.append(point)
            else:
                left.setdefault(tuple(cells[point] >> (20 - key[0])), []).append(point)
        for child, points in left.items():
            if len(points) < 50:
                taken += points
            else:
                todo.append(((key[0] + 1, *child), points))
        nodes[key] = records[sorted(taken)]
    return nodes


@pytest.mark.rest
@pytest.mark.parametrize("spread", [100, 3000, 40_000])
def test_each_node_has_the_points_that_the_rule_gives_it_in_file_order(small_leaves, spread):
    records = cloud_of(5_000, spread=spread)
    records[0, :12] = np.array([10**7, 0, 0], "<i4").view(np.uint8)  # far away
    cube, nodes = octree_of(records)
    wanted = nodes_by_the_rule(records, cube)
    assert nodes.keys() == wanted.keys() and len(nodes) > 5
    assert all(np.array_equal(nodes[key], wanted[key]) for key in wanted)


def test_every_node_comes_after_the_one_above_it(small_leaves):
    _, nodes = octree_of(cloud_of(20_000))
    seen = set()
    for depth, x, y, z in nodes:
        assert not depth or (depth - 1, x // 2, y // 2, z // 2) in seen
        seen.add((depth, x, y, z))
    assert len(seen) >= 5


@pytest.fixture
def few_in_memory(small_leaves, monkeypatch):
    """No more points in memory than a node may have, and fewer are sorted at a time."""
    monkeypatch.setattr(copc_points, "_MOST_AT_ONCE", 700)


def both_ways(las, source, changes):
    """Write a file with all of its points in memory, and with as few as can be."""
    targets = [las.folder / f"{name}.copc.laz" for name in ("much", "little")]
    heard = [Heard(), Heard()]
    for target, memory, progress in zip(targets, (None, 1), heard):
        write_changed(source, target, changes, progress, memory=memory)
    assert {path.name for path in las.folder.iterdir()} == {
        source.name, *(target.name for target in targets)
    }  # fmt: skip
    return targets, heard


@pytest.mark.parametrize("count", [1, 2, 5000])
def test_points_in_one_place_end_the_octree_all_the_same(las, few_in_memory, count):
    records = cloud_of(count, spread=1)
    records[:, :12] = 1
    source = las.make(version=4, point_format=6, records=records)
    (much, little), _ = both_ways(las, source, Edits(classification=classes_of(count)))
    assert read_cloud(much).count == count
    assert much.read_bytes() == little.read_bytes()


@pytest.mark.rest(but="50-0")
@pytest.mark.parametrize(("spread", "stray"), covering([50, 3000, 40_000], [0, 2]))
def test_the_same_bytes_however_few_points_fit_into_memory(las, few_in_memory, spread, stray):
    records = cloud_of(15_000, spread=spread)
    # So far that all others lie in few of the cells that are told apart at a time.
    records[:stray, :12] = np.array([[2**30, 5, 0], [0, -(2**30), 9]], "<i4").view(np.uint8)[:stray]
    source = las.make(version=4, point_format=6, records=records,
                      evlrs=[las.evlr(b"behind", 9, b"the points")])  # fmt: skip
    changes = Edits(classification=classes_of(15_000))
    (much, little), progress = both_ways(las, source, changes)
    assert much.read_bytes() == little.read_bytes()
    with CopcReader.open(little) as reader:
        found = reader.query()
    assert np.array_equal(order_of(found), order_of(laspy.read(little)))
    assert len(np.unique(found["X"])) == len(np.unique(laspy.read(source)["X"]))
    for told in progress:
        assert told.fractions == sorted(told.fractions) and told.fractions[-1] == 1.0
    assert len(progress[1].fractions) > 50


@pytest.mark.rest(but="0-in.las")
@pytest.mark.parametrize(("point_format", "name"), covering([0, 3, 5, 8, 10], ["in.las", "in.laz"]))
def test_the_same_bytes_of_other_formats_and_edits(las, few_in_memory, point_format, name):
    version = 4 if point_format > 5 else 3
    extra_record = las.vlr(b"LASF_Spec", 4, extra_bytes_vlr(b"amount"))
    source = las.make(
        name, version=version, point_format=point_format, extra=2, vlrs=[extra_record], count=9000
    )
    noise = np.random.default_rng(4)
    changes = Edits(
        classification=classes_of(9000) % 32,
        z=noise.integers(0, 9000, 9000).astype(np.int32),
        extra=ExtraDimension("height", "of it", noise.random(9000).astype(np.float32)),
        kept=noise.random(9000) < 0.7,
    )
    (much, little), _ = both_ways(las, source, changes)
    assert much.read_bytes() == little.read_bytes()
    assert laspy.read(little).header.point_count == changes.kept.sum() > 6000


@pytest.mark.rest(but="None-1")
@pytest.mark.parametrize(
    ("extent", "reads"),
    [
        (None, 1),
        ((400_000.1, 399_999.9, 5_000_000.1, 4_999_999.9, 1.0, -1.0), 2),
        ((-1.0, 1.0, -1.0, 1.0, -1.0, 1.0), 2),
        ((400_400.0, 399_600.0, 5_000_400.0, 4_999_600.0, 1.7e308, -1.7e308), 2),
        ((float("nan"),) * 6, 2),
    ],
)
def test_a_header_may_be_wrong_about_the_extent(las, few_in_memory, monkeypatch, extent, reads):
    source, begun = las.make(version=4, point_format=6, records=cloud_of(30_000)), []
    if extent is None:
        points = laspy.read(source)
        extent = np.column_stack((points.xyz.max(axis=0), points.xyz.min(axis=0))).ravel()
    data = bytearray(source.read_bytes())
    struct.pack_into("<6d", data, 179, *extent)
    source.write_bytes(data)

    def noting(*arguments):
        begun.append(arguments)
        return read_records(*arguments)

    monkeypatch.setattr(edits, "read_records", noting)
    (much, little), progress = both_ways(las, source, Edits(classification=classes_of(30_000)))
    assert much.read_bytes() == little.read_bytes()
    assert len(begun) == 1 + reads
    assert progress[1].fractions == sorted(progress[1].fractions)


@pytest.mark.rest
def test_memory_is_bounded_whatever_the_number_of_points(las, monkeypatch):
    monkeypatch.setattr(copc_octree, "_LEAF_POINTS", 20_000)
    monkeypatch.setattr(copc_points, "_MOST_AT_ONCE", 20_000)
    few = functools.partial(read_records, most=20_000)
    monkeypatch.setattr(edits, "read_records", few)
    peaks = []
    for count in (100_000, 400_000):
        source = las.make(version=4, point_format=6, records=cloud_of(count))
        changes = Edits(classification=np.ones(count, np.uint8))
        tracemalloc.start()
        write_changed(source, las.folder / "out.copc.laz", changes, memory=2_000_000)
        peaks.append(tracemalloc.get_traced_memory()[1])
        tracemalloc.stop()
        assert info(las.folder / "out.copc.laz").point_count == count
    # Of 300,000 points more, the records alone would take 9 MB.
    assert peaks[1] - peaks[0] < 3e6


@pytest.mark.parametrize("fraction", [0.0, 0.1, 0.2, 0.35, 0.5, 0.9])
def test_a_cancel_while_points_wait_on_disk_leaves_nothing(las, few_in_memory, fraction):
    source = las.make(version=4, point_format=6, records=cloud_of(20_000))
    changes = Edits(classification=classes_of(20_000))
    with pytest.raises(Cancelled):
        write_changed(source, las.folder / "out.copc.laz", changes, CancelAt(fraction), memory=1)
    assert list(las.folder.iterdir()) == [source]


@TELLS
def test_a_disk_without_room_for_the_points_that_wait_is_told(
    las, few_in_memory, monkeypatch, tells
):
    become_full(monkeypatch, 300_000, tells)
    source = las.make(version=4, point_format=6, records=cloud_of(20_000))
    changes = Edits(classification=classes_of(20_000))
    with pytest.raises(BareEarthError, match=r"out\.copc\.laz: .*disk.* full"):
        write_changed(source, las.folder / "out.copc.laz", changes, memory=1)
    assert list(las.folder.iterdir()) == [source]


@pytest.mark.parametrize("written", ["las", "laz"])
def test_copc_becomes_plain_in_its_own_order(las, small_leaves, written):
    source = las.folder / "in.copc.laz"
    records = cloud_of(10_000)
    behind = [las.evlr(b"behind", 9, b"the points")]
    plain = las.make(version=4, point_format=6, records=records, evlrs=behind)
    write_classified(plain, source, np.full(10_000, 5, np.uint8))
    target, progress = las.folder / f"out.{written}", Heard()
    write_classified(source, target, classes_of(10_000), progress)
    before, after = laspy.read(source), laspy.read(target)
    np.testing.assert_array_equal(after.xyz, before.xyz)
    np.testing.assert_array_equal(after.intensity, before.intensity)
    np.testing.assert_array_equal(after.classification, classes_of(10_000))
    assert [vlr.user_id for vlr in after.vlrs if vlr.user_id == "copc"] == []
    with laspy.open(target) as file:
        assert [(record.user_id, record.record_data_bytes()) for record in file.evlrs] == [
            ("behind", b"the points")
        ]
    assert any("order of the COPC file" in text for text in progress.infos)
    assert info(target).encoding == {"las": "uncompressed", "laz": "LAZ"}[written]


def test_copc_becomes_copc_again(las, small_leaves):
    first, second = las.folder / "a.copc.laz", las.folder / "b.copc.laz"
    plain = las.make(version=4, point_format=6, records=cloud_of(10_000))
    write_classified(plain, first, np.full(10_000, 5, np.uint8))
    write_classified(first, second, np.full(10_000, 2, np.uint8))
    described = info(second)
    assert described.classes == {2: 10_000} and described.encoding == "COPC"
    assert sum("copc" in record for record in described.records) == 2
    # Nothing else has to change then, not even the order of the points.
    one, other = laspy.read(first), laspy.read(second)
    for name in ("X", "Y", "Z", "intensity"):
        np.testing.assert_array_equal(one[name], other[name])
    with CopcReader.open(second) as reader:
        assert len(reader.query(level=0)) == len(CopcReader.open(first).query(level=0)) < 10_000
        assert (reader.query().classification == 2).all()


def test_records_of_others_stay_and_the_crs_is_kept_word_for_word(las):
    wkt = las.vlr(b"LASF_Projection", 2112, FOOT_CRS.encode() + b"\0")
    other = las.vlr(b"somebody", 7, b"else's data")
    source = las.make(version=4, point_format=6, encoding=0x11, vlrs=[other, wkt],
                      evlrs=[las.evlr(b"behind", 9, b"the points")])  # fmt: skip
    target = las.folder / "out.copc.laz"
    write_classified(source, target, classes_of(60))
    assert {other, wkt} <= set(las.split(target).vlrs)
    assert target.read_bytes().endswith(las.evlr(b"behind", 9, b"the points"))
    with laspy.open(target) as file:
        assert [record.user_id for record in file.evlrs] == ["copc", "behind"]
    assert las.split(target).field("H", 6) == 0x11


def geokeys(*keys):
    return struct.pack(f"<{4 + 4 * len(keys)}H", 1, 1, 0, len(keys), *sum(keys, ()))


def test_geotiff_keys_become_text_with_the_unit_of_the_heights(las):
    pytest.importorskip("pyproj")
    keys = geokeys((1024, 0, 1, 1), (3072, 0, 1, 32632), (4099, 0, 1, 9003))
    source = las.make(vlrs=[las.vlr(b"LASF_Projection", 34735, keys)])
    target, progress = las.folder / "out.copc.laz", Heard()
    write_classified(source, target, classes_of(60), progress)
    before, after = read_cloud(source).crs, read_cloud(target).crs
    assert (before.horizontal_unit, before.vertical_unit) == (1.0, 1200 / 3937)
    assert after.epsg in (None, 32632) and after.horizontal_unit == 1.0
    assert after.vertical_unit == pytest.approx(1200 / 3937, rel=1e-12)
    assert any("well-known text" in text for text in progress.infos)
    assert not any("34735" in record for record in info(target).records)


def test_geotiff_keys_that_no_text_is_known_for_stay(las):
    keys = geokeys((1024, 0, 1, 1), (3072, 0, 1, 32767), (3076, 0, 1, 9002))
    source = las.make(vlrs=[las.vlr(b"LASF_Projection", 34735, keys)])
    target, progress = las.folder / "out.copc.laz", Heard()
    write_classified(source, target, classes_of(60), progress)
    assert any("GeoTIFF keys" in text for text in progress.warnings)
    assert read_cloud(target).crs.horizontal_unit == 0.3048


@pytest.mark.parametrize("point_format", [4, 5, 9, 10])
def test_waveforms_that_are_left_out_are_told(las, point_format):
    version = 4 if point_format > 5 else 3
    descriptor = las.vlr(b"LASF_Spec", 100, bytes(26))
    source = las.make(version=version, point_format=point_format, vlrs=[descriptor], encoding=0x04)
    target, progress = las.folder / "out.copc.laz", Heard()
    write_classified(source, target, classes_of(60), progress)
    assert sum("waveforms" in text for text in progress.warnings) == 1
    assert not any(record[2:11] == b"LASF_Spec" for record in las.split(target).vlrs)
    assert las.split(target).field("H", 6) & 0x06 == 0


def test_a_changed_format_and_lost_header_bytes_are_told(las):
    source, progress = las.make(point_format=3, user_bytes=b"our own"), Heard()
    write_classified(source, las.folder / "out.copc.laz", classes_of(60), progress)
    assert any(re.search(r"format 3 .*\b7\b.* COPC", text) for text in progress.infos)
    assert any("added to the header" in text for text in progress.warnings)
