import struct

import numpy as np
import pytest
from las_files import LasKit
from matrices import quick
from runs import CancelAt, Heard
from surveys import write_classified

from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.las import copc_nodes, copc_octree, reading, writing
from bare_earth.algorithms.las.copc import HIERARCHY_ENTRY
from bare_earth.algorithms.las.copc_nodes import find_nodes, read_hierarchy, read_pages
from bare_earth.algorithms.las.lasfile import COPC_INFO, VLR_HEADER
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.survey.window import read_window

POINTS = 9000
COLUMNS = ("x", "y", "z", "classification", "return_number", "number_of_returns", "withheld")
# The points of `las.make` lie from 399,990 on, one metre apart.
BOX = (399_993.0, 5_000_002.0, 399_999.0, 5_000_011.0)


def in_box(cloud, box):
    x = cloud.x * cloud.scale[0] + cloud.offset[0]
    y = cloud.y * cloud.scale[1] + cloud.offset[1]
    return (x >= box[0]) & (x <= box[2]) & (y >= box[1]) & (y <= box[3])


def assert_is_part(window, cloud, box):
    which = in_box(cloud, box)
    for name in COLUMNS:
        got, wanted = getattr(window, name), getattr(cloud, name)
        assert got.dtype == wanted.dtype
        np.testing.assert_array_equal(got, wanted[which], err_msg=name)
    for name in ("path", "scale", "offset", "point_format", "crs"):
        assert getattr(window, name) == getattr(cloud, name)
    return int(which.sum())


@pytest.mark.parametrize("name", ["in.las", "in.laz"])
@pytest.mark.parametrize("point_format", range(11))
def test_a_window_holds_what_masking_the_whole_gives(las, name, point_format, monkeypatch):
    monkeypatch.setattr(reading, "_CHUNK", 70)
    source = las.make(name, version=4, point_format=point_format, count=400, extra=3)
    assert assert_is_part(read_window(source, BOX), read_cloud(source), BOX) == 7 * 10


def test_the_border_belongs_to_the_window(las):
    source = las.make(count=400)
    assert read_window(source, (399_990.0, 5e6, 399_992.0, 5e6 + 1)).count == 3 * 2
    assert read_window(source, (399_990.01, 5e6 + 0.01, 399_991.99, 5e6 + 1.99)).count == 1


def test_a_window_without_points_is_an_empty_cloud(las):
    for name in ("in.las", "in.laz"):
        window = read_window(las.make(name), (0.0, 0.0, 1.0, 1.0))
        assert window.count == 0
        assert window.x.dtype == np.int32


def test_a_rectangle_that_is_none_is_refused(las):
    with pytest.raises(BareEarthError, match="XMIN below XMAX"):
        read_window(las.make(), (2.0, 0.0, 1.0, 1.0))


def test_a_wrong_header_is_told_and_hides_points_only_where_it_is_trusted(las):
    source, heard = with_extent(las.make(count=400), 1, 2, 3, 4), Heard()
    assert read_window(source, BOX, heard).count == 70
    assert any("smaller extent" in text for text in heard.warnings)
    assert read_window(source, BOX, trust_header=True).count == 0
    assert read_window(with_extent(source, 399_990, 5e6, 400_009, 5_000_019), BOX).count == 70


def with_extent(path, west, south, east, north):
    data = bytearray(path.read_bytes())
    struct.pack_into("<4d", data, 179, east, west, north, south)
    path.write_bytes(data)
    return path


def test_a_right_header_is_not_complained_of(las):
    source = with_extent(las.make(count=400), 399_990, 5e6, 400_009, 5_000_019)
    heard = Heard()
    assert read_window(source, BOX, heard, trust_header=True).count == 70
    assert not any("extent" in text for text in heard.warnings)


@pytest.mark.parametrize("name", ["in.las", "in.laz"])
def test_damage_is_told(las, name):
    source = las.make(name, count=5000)
    source.write_bytes(source.read_bytes()[:-3000])
    with pytest.raises(BareEarthError, match="damaged or cut off"):
        read_window(source, BOX)


def scattered(count, side=60_000, seed=5):
    noise = np.random.default_rng(seed)
    records = noise.integers(0, 256, (count, 30), dtype=np.uint8)
    xyz = np.column_stack([*noise.integers(0, side, (2, count)), noise.integers(0, 900, count)])
    records[:, :12] = xyz.astype("<i4").view(np.uint8)
    records[:, 14] = 0x21
    return records


@pytest.fixture(scope="module")
def octree_bytes(tmp_path_factory):
    las = LasKit(tmp_path_factory.mktemp("octree"))
    target = las.folder / "many.copc.laz"
    with pytest.MonkeyPatch.context() as patch:
        # At depth 0 the usual grid would take nearly all of so few points.
        for name, value in {"LEAF_POINTS": 700, "SMALL_NODE": 100, "GRID_BITS": 3}.items():
            patch.setattr(copc_octree, f"_{name}", value)
        patch.setattr(copc_octree, "_DEEPEST", 18)
        source = las.make(version=4, point_format=6, records=scattered(POINTS))
        write_classified(source, target, (np.arange(POINTS) % 256).astype(np.uint8))
    return target.read_bytes()


@pytest.fixture
def octree(las, octree_bytes):
    """600 m x 600 m of points in a COPC file of many small nodes."""
    path = las.folder / "many.copc.laz"
    path.write_bytes(octree_bytes)
    return path


def boxes_in_octree():
    noise = np.random.default_rng(8)
    for _ in range(3):
        x, y = 400_000 + noise.random(2) * 500, 5_000_000 + noise.random(2) * 500
        yield (x.min(), y.min(), x.max() + 0.02, y.max() + 0.02)
    yield (400_000.0, 5_000_000.0, 400_300.0, 5_000_300.0)
    yield (399_000.0, 4_999_000.0, 401_000.0, 5_001_000.0)


def test_a_window_of_copc_holds_what_masking_the_whole_gives(octree, monkeypatch):
    monkeypatch.setattr(copc_nodes, "_BATCH", 3000)
    cloud, heard = read_cloud(octree), Heard()
    counts = [
        assert_is_part(read_window(octree, box, heard), cloud, box) for box in boxes_in_octree()
    ]
    assert counts[-1] == POINTS
    assert all(0 <= fraction <= 1 for fraction in heard.fractions)
    assert not any("octree" in text for text in heard.warnings)


def test_a_small_window_of_copc_reads_only_its_nodes(octree):
    box, nowhere = (400_100.0, 5_000_100.0, 400_140.0, 5_000_140.0), (0.0, 0.0, 1.0, 1.0)
    whole, hierarchy = read_cloud(octree), read_hierarchy(open_las(octree))
    # Of all other nodes the points are damaged: whoever reads them is refused.
    wanted = find_nodes(hierarchy, box)["start"]
    assert find_nodes(hierarchy, nowhere).size == 0
    data, heard = bytearray(octree.read_bytes()), Heard()
    for node in find_nodes(hierarchy, (399_000.0, 4_999_000.0, 401_000.0, 5_001_000.0)):
        start, size = int(node["start"]), int(node["size"])
        if start not in wanted:
            data[start : start + size] = bytes(size)
    octree.write_bytes(data)
    assert 20 < assert_is_part(read_window(octree, box, heard), whole, box) < 100
    assert read_window(octree, nowhere, heard).count == 0
    assert not any("octree" in text for text in heard.warnings)
    with pytest.raises(BareEarthError, match="damaged"):
        read_window(octree, (400_000.0, 5_000_000.0, 400_600.0, 5_000_600.0))


def test_a_window_of_copc_by_another_writer(las):
    copclib = pytest.importorskip("copclib")
    path = las.folder / "other.copc.laz"
    config = copclib.CopcConfigWriter(6, (0.01,) * 3, (400_000.0, 5_000_000.0, 0.0))
    config.las_header.min = (400_000.0, 5_000_000.0, 0.0)
    config.las_header.max = (400_600.0, 5_000_600.0, 9.0)
    info = config.copc_info
    info.center_x, info.center_y, info.center_z, info.halfsize = 400_300.0, 5_000_300.0, 0.0, 300.0
    writer = copclib.FileWriter(str(path), config)
    noise = np.random.default_rng(4)
    # Each node of depth 2 on a page of its own, so that pages are nested.
    for key in [(0, 0, 0, 0), *[(2, x, y, 0) for x in range(4) for y in range(4)]]:
        side = 600 / 2 ** key[0]
        points = copclib.Points(config.las_header)
        for x, y, z in noise.random((50, 3)):
            point = points.CreatePoint()
            point.x = 400_000 + (key[1] + x) * side
            point.y = 5_000_000 + (key[2] + y) * side
            point.z = z
            point.classification = int(x * 100)
            points.AddPoint(point)
        parent = copclib.VoxelKey(key) if key[0] else copclib.VoxelKey(0, 0, 0, 0)
        writer.AddNode(copclib.VoxelKey(key), points, parent)
    writer.Close()
    cloud, heard = read_cloud(path), Heard()
    for box in boxes_in_octree():
        assert_is_part(read_window(path, box, heard), cloud, box)
    assert not any("octree" in text for text in heard.warnings)


def test_nested_pages_are_followed_only_where_the_window_is(octree):
    small, large = (
        (400_010.0, 5_000_010.0, 400_010.0 + side, 5_000_010.0 + side) for side in (90.0, 580.0)
    )
    cloud, heard = read_cloud(octree), Heard()
    nest_pages(octree)
    assert_is_part(read_window(octree, large, heard), cloud, large)
    # All pages but the first, and that of the corner, are damaged: whoever reads them tells of it.
    hierarchy, data = read_hierarchy(open_las(octree)), bytearray(octree.read_bytes())
    for start, entries in read_pages(hierarchy).items():
        depth, *place = entries["key"][0].tolist()
        if start != hierarchy.root[0] and any(value >> (depth - 1) for value in place[:2]):
            data[start : start + 4] = struct.pack("<i", -1)
    octree.write_bytes(data)
    assert_is_part(read_window(octree, small, heard), cloud, small)
    assert not any("octree" in text for text in heard.warnings)
    assert_is_part(read_window(octree, large, heard), cloud, large)
    assert any("octree" in text for text in heard.warnings)


@pytest.mark.rest
@pytest.mark.parametrize("nested", quick([False, True], True))
def test_other_classes_leave_the_octree_as_it_is(las, octree, nested, monkeypatch):
    count = 1 + (nest_pages(octree) if nested else 0)
    monkeypatch.setattr(writing, "write_copc", None)
    target, classes = las.folder / "out.copc.laz", (np.arange(POINTS) * 7 % 251).astype(np.uint8)
    write_classified(octree, target, classes)
    before, after = las.split(octree), las.split(target)
    before.records[:, 16] = classes
    np.testing.assert_array_equal(after.records, before.records)
    cloud, heard = read_cloud(target), Heard()
    for box in boxes_in_octree():
        assert_is_part(read_window(target, box, heard), cloud, box)
    assert not any("octree" in text for text in heard.warnings)
    pages = [read_pages(read_hierarchy(open_las(path))) for path in (octree, target)]
    assert len(pages[0]) == len(pages[1]) == count
    for one, other in zip(*(np.concatenate(list(page.values())) for page in pages)):
        assert one["count"] == other["count"] and (one["key"] == other["key"]).all()
    classes[:] = cloud.classification
    write_classified(target, las.folder / "again.copc.laz", classes)
    assert (las.folder / "again.copc.laz").read_bytes() == target.read_bytes()
    # One class takes fewer bytes: all that stands behind moves towards the start of the file.
    less = las.folder / "less.copc.laz"
    write_classified(target, less, np.full(POINTS, 2, np.uint8))
    assert less.stat().st_size < octree.stat().st_size
    before.records[:, 16] = 2
    np.testing.assert_array_equal(las.split(less).records, before.records)
    for box in boxes_in_octree():
        assert_is_part(read_window(less, box, heard), read_cloud(less), box)
    assert not any("octree" in text for text in heard.warnings)


def test_an_octree_that_is_damaged_is_made_anew(las, octree):
    def more(entries):
        entries["count"][-1] += 1

    cloud = read_cloud(octree)
    change_entries(octree, more)
    target = las.folder / "out.copc.laz"
    write_classified(octree, target, cloud.classification)
    assert read_cloud(target).count == POINTS
    assert_is_part(read_window(target, (0, 0, 1e7, 1e7)), read_cloud(target), (0, 0, 1e7, 1e7))


def nest_pages(path):
    """Move each branch of depth 1 to a page of its own at the end of the file."""
    layout = open_las(path)
    info = layout.vlr(COPC_INFO).data
    start, size = struct.unpack_from("<2Q", info, 40)
    data = bytearray(path.read_bytes())
    entries = np.frombuffer(bytes(data[start : start + size]), HIERARCHY_ENTRY)
    depth = entries["key"][:, 0]
    above = entries["key"][:, 1:] >> np.maximum(depth - 1, 0)[:, None]
    root = [entries[depth == 0]]
    branches = np.unique(above[depth > 0], axis=0)
    for branch in branches:
        page = entries[(depth > 0) & (above == branch).all(axis=1)]
        pointer = np.array([((1, *branch), len(data), page.nbytes, -1)], HIERARCHY_ENTRY)
        root.append(pointer)
        data += page.tobytes()
    root = np.concatenate(root)
    place = bytes(data).index(info[:56])
    struct.pack_into("<2Q", data, place + 40, len(data), root.nbytes)
    path.write_bytes(data + root.tobytes())
    return len(branches)


def change_entries(path, change):
    layout = open_las(path)
    start, size = struct.unpack_from("<2Q", layout.vlr(COPC_INFO).data, 40)
    data = bytearray(path.read_bytes())
    entries = np.frombuffer(bytes(data[start : start + size]), HIERARCHY_ENTRY).copy()
    change(entries)
    data[start : start + size] = entries.tobytes()
    path.write_bytes(data)


def lose_a_node(entries):
    entries["count"][-1] = entries["size"][-1] = 0


def swap_two_nodes(entries):
    entries["key"][[-1, -2]] = entries["key"][[-2, -1]]


def name_itself(entries):
    entries["count"][0] = -1


def leave_the_file(entries):
    entries["start"][3] = 1 << 62


def go_astray(entries):
    entries["key"][5] = (1, 9, 0, 0)


def overlap(entries):
    entries["start"][4] = entries["start"][3]


DAMAGES = [lose_a_node, swap_two_nodes, name_itself, leave_the_file, go_astray, overlap]


@pytest.mark.rest(but="name_itself")
@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_octree_is_told_and_loses_no_point(octree, damage):
    cloud, heard = read_cloud(octree), Heard()
    change_entries(octree, damage)
    box = (400_000.0, 5_000_000.0, 400_600.0, 5_000_600.0)
    assert_is_part(read_window(octree, box, heard), cloud, box)
    assert any(f"octree of {octree} is damaged" in text for text in heard.warnings)


@pytest.mark.parametrize("field", [3, 0, 5])
def test_a_wrong_cube_is_told_and_loses_no_point(octree, field):
    data = bytearray(octree.read_bytes())
    place = 375 + VLR_HEADER + 8 * field
    if field == 5:
        struct.pack_into("<Q", data, place, 1 << 63)
    else:
        struct.pack_into("<d", data, place, 7.0)
    cloud, heard = read_cloud(octree), Heard()
    octree.write_bytes(data)
    box = (400_000.0, 5_000_000.0, 400_300.0, 5_000_300.0)
    assert_is_part(read_window(octree, box, heard), cloud, box)
    assert any("is damaged" in text for text in heard.warnings)


def test_damaged_nodes_are_an_error(octree):
    data = bytearray(octree.read_bytes())
    start = open_las(octree).points_start
    data[start + 60 : start + 20_000] = bytes(20_000 - 60)
    octree.write_bytes(data)
    with pytest.raises(BareEarthError, match="damaged"):
        read_window(octree, (400_000.0, 5_000_000.0, 400_300.0, 5_000_300.0))


def test_reading_a_window_can_be_cancelled(octree):
    with pytest.raises(Cancelled):
        read_window(octree, (400_000.0, 5_000_000.0, 400_300.0, 5_000_300.0), CancelAt())
