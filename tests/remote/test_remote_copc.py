"""Parts of remote COPC files: the same points as a clip of the whole file, or one sentence."""

import json
import struct

import laspy
import numpy as np
import pytest
from copcs import many_nodes
from las_files import evlr, las_bytes, make_records
from matrices import covering
from runs import CancelAt, said
from surveys import write_classified

import bare_earth
from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.las.records import read_records
from bare_earth.algorithms.remote import copc, files

BOX = (400_000.55, 5_000_000.05, 400_052.0, 5_000_000.65)


@pytest.fixture(scope="module")
def content(tmp_path_factory):
    return many_nodes(tmp_path_factory.mktemp("copc"), extra=3)


def points_of(path):
    """Return the records of a file, sorted, and places of them."""
    layout = open_las(path)
    records = np.concatenate([np.array(some) for some in read_records(layout)])
    integers = records[:, :12].copy().view("<i4")
    x, y, _ = (integers * layout.scale + layout.offset).T
    return records, x, y


def in_order(records):
    return records[np.lexsort(records.T)]


def clipped(path, box=BOX):
    records, x, y = points_of(path)
    return in_order(records[(x >= box[0]) & (x <= box[2]) & (y >= box[1]) & (y <= box[3])])


def check_header(path):
    """Compare what header and info record state with the points."""
    layout = open_las(path)
    with laspy.open(path) as file:
        points, header = file.read(), file.header
    assert header.point_count == len(points) == layout.count
    assert np.allclose(header.mins, [points.x.min(), points.y.min(), points.z.min()])
    assert np.allclose(header.maxs, [points.x.max(), points.y.max(), points.z.max()])
    counts = np.bincount(points.return_number, minlength=16)[1:16]
    assert header.number_of_points_by_return.tolist() == counts.tolist()
    if layout.is_copc:
        info = layout.vlrs[0].data
        times = struct.unpack_from("<2d", info, 56)
        assert times == (points.gps_time.min(), points.gps_time.max())
        with laspy.CopcReader.open(str(path)) as reader:
            assert len(reader.query()) == len(points)
    return layout


@pytest.mark.rest(but="part.laz-False")
@pytest.mark.parametrize("pages", [False, True])
@pytest.mark.parametrize("name", ["part.copc.laz", "part.laz"])
def test_a_part_has_the_same_points_as_a_clip(server, tmp_path, name, pages):
    source, target = tmp_path / "whole.copc.laz", tmp_path / name
    source.write_bytes(many_nodes(tmp_path, pages=pages, extra=3))
    address = server.add("whole.copc.laz", source.read_bytes())
    done = bare_earth.fetch(f"{address}?token=x", target, extent=BOX)
    assert np.array_equal(in_order(points_of(target)[0]), clipped(source))
    layout, whole = check_header(target), open_las(source)
    assert layout.is_copc == (name == "part.copc.laz") and layout.scale == whole.scale
    kept = [vlr.raw for vlr in whole.vlrs if vlr.key[0] != "copc"]
    assert [vlr.raw for vlr in layout.vlrs if vlr.key[0] != "copc"] == kept
    assert done.point_count == layout.count and done.request_count == len(server.asked)
    assert {path.name for path in tmp_path.iterdir()} <= {name, "whole.copc.laz", "plain.las",
                                                          "plain.copc.laz"}  # fmt: skip


def test_all_of_a_file_keeps_every_chunk(server, tmp_path, content):
    source, target = tmp_path / "whole.copc.laz", tmp_path / "part.copc.laz"
    source.write_bytes(content)
    bare_earth.fetch(server.add("whole.copc.laz", content), target)
    assert np.array_equal(points_of(target)[0], points_of(source)[0])
    assert open_las(target).chunk_table == open_las(source).chunk_table


@pytest.mark.rest
def test_a_resolution_takes_the_upper_levels(server, tmp_path, content):
    source, target = tmp_path / "whole.copc.laz", tmp_path / "part.copc.laz"
    source.write_bytes(content)
    spacing = struct.unpack_from("<d", open_las(source).vlrs[0].data, 32)[0]
    counts = []
    for factor in (1.0, 0.5, 0.01, 0.005):
        address = server.add("whole.copc.laz", content)
        bare_earth.fetch(address, target, resolution=spacing * factor)
        counts.append(check_header(target).count)
    with laspy.CopcReader.open(str(source)) as reader:
        assert counts[:2] == [len(reader.query(level=range(level))) for level in (1, 2)]
    assert counts[2] == counts[3] == 4000


def test_polygons_cut_points_exactly(server, tmp_path, content):
    source, target = tmp_path / "whole.copc.laz", tmp_path / "part.copc.laz"
    source.write_bytes(content)
    ring = [[400_000, 5_000_000], [400_060, 5_000_000], [400_000, 5_000_060], [400_000, 5_000_000]]
    boundary = tmp_path / "area.geojson"
    boundary.write_text(json.dumps({"type": "Polygon", "coordinates": [ring]}))
    bare_earth.fetch(server.add("whole.copc.laz", content), target, boundary=boundary)
    records, x, y = points_of(source)
    inside = (x - 400_000) + (y - 5_000_000) < 60
    assert np.array_equal(in_order(points_of(target)[0]), in_order(records[inside]))
    check_header(target)


def test_records_behind_the_points_stay(server, tmp_path):
    wanted = {"version": 4, "point_format": 6, "records": make_records(6, 300)}
    plain, source = tmp_path / "plain.las", tmp_path / "whole.copc.laz"
    note = evlr(b"someone", 7, b"a note that stays")
    plain.write_bytes(las_bytes(**wanted, evlrs=[note]))
    write_classified(plain, source, np.full(300, 2, np.uint8))
    target = tmp_path / "part.copc.laz"
    bare_earth.fetch(server.add("whole.copc.laz", source.read_bytes()), target)
    assert note in target.read_bytes()
    kept = {record.key: record.length for record in open_las(target).evlrs}
    assert kept == {record.key: record.length for record in open_las(source).evlrs}


def test_the_command_tells_what_it_downloads(server, tmp_path, content):
    target, address = tmp_path / "part.copc.laz", server.add("whole.copc.laz", content)
    box = [*map(str, BOX)]
    code, out, errors = said("fetch", address, target, "--extent", *box, "--verbose")
    assert code == 0 and "Downloads " in errors and "points in 1 file" in out
    code, out, _ = said("fetch", address, target, "--extent", *box, "--json")
    told = json.loads(out)
    assert told["point_count"] == open_las(target).count and told["size"] == server.sent / 2
    # A path of this computer is cut out in the same way.
    (tmp_path / "whole.copc.laz").write_bytes(content)
    assert (
        said("fetch", tmp_path / "whole.copc.laz", tmp_path / "b.copc.laz", "--extent", *box)[0]
        == 0
    )
    assert (tmp_path / "b.copc.laz").read_bytes() == target.read_bytes()


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"limit": 0.0}, r"limit of 0\.0 kB"),
        ({"extent": (0, 0, 1, 1)}, "No point of whole.copc.laz"),
        ({"output": "part.las"}, ".copc.laz or .laz"),
        ({"address": "file:///a.copc.laz"}, "cannot be fetched"),
        ({"address": "nowhere.copc.laz"}, "does not exist"),
    ],
)
def test_what_cannot_be_is_refused(server, tmp_path, content, given, words):
    address = given.pop("address", server.add("whole.copc.laz", content))
    with pytest.raises(BareEarthError, match=words):
        bare_earth.fetch(address, tmp_path / given.pop("output", "part.copc.laz"), **given)
    assert not list(tmp_path.iterdir()) and server.sent <= 3 * len(content)


def test_a_file_that_is_no_copc_is_refused(server, tmp_path):
    address = server.add("a.laz", las_bytes(version=4, point_format=6, count=300))
    with pytest.raises(BareEarthError, match="is not COPC"):
        bare_earth.fetch(address, tmp_path / "part.laz")
    assert not list(tmp_path.iterdir())


FAULTS = ["no ranges", "gzip", "shifted", "fewer", "cut", "short", "503", "403", "old"]


@pytest.mark.rest(but="cut-5")
@pytest.mark.parametrize(("fault", "every"), covering(FAULTS, [1, 2, 5]))
def test_bad_answers_give_the_same_points_or_one_sentence(server, tmp_path, content, fault, every):
    source, target = tmp_path / "whole.copc.laz", tmp_path / "part.copc.laz"
    source.write_bytes(content)
    address = server.add("whole.copc.laz", content)
    server.fault = lambda number, path: fault if number % every == every - 1 else ""
    try:
        bare_earth.fetch(address, target, extent=BOX)
    except BareEarthError as error:
        assert str(error).endswith(".") and not target.exists()
        # The next run, when the server is well again, goes on.
        server.fault = lambda number, path: ""
        bare_earth.fetch(address, target, extent=BOX)
    assert np.array_equal(in_order(points_of(target)[0]), clipped(source))
    assert not (tmp_path / "part.copc.laz.parts").exists()


@pytest.mark.rest
def test_damaged_bytes_are_never_points(server, tmp_path, content):
    address, random = server.add("whole.copc.laz", content), np.random.default_rng(1)
    source = tmp_path / "whole.copc.laz"
    source.write_bytes(content)
    count, refused = len(clipped(source)), 0
    for number in range(40):
        damaged = bytearray(content)
        start = int(random.integers(0, len(content) - 8))
        damaged[start : start + 8] = random.bytes(8)
        server.files["whole.copc.laz"] = bytes(damaged)
        server.etags["whole.copc.laz"] = f'"{number}"'
        target = tmp_path / "part.copc.laz"
        try:
            bare_earth.fetch(address, target, extent=BOX)
        except BareEarthError:
            refused += 1
            assert not target.exists()
            continue
        # Damaged coordinates can lie elsewhere; no point is lost silently from whole nodes.
        assert abs(open_las(target).count - count) <= 150
        target.unlink()
    assert refused


def test_the_extent_in_the_header_decides_nothing(server, tmp_path, content):
    source, wrong = tmp_path / "whole.copc.laz", bytearray(content)
    source.write_bytes(content)
    low, high = open_las(source).minimum, open_las(source).maximum
    struct.pack_into("<4d", wrong, 179, low[0] + 1, low[0], low[1] + 1, low[1])
    address, target = server.add("whole.copc.laz", bytes(wrong)), tmp_path / "part.copc.laz"
    bare_earth.fetch(address, target, extent=(low[0] + 2, low[1], high[0], high[1]))
    found = clipped(source, (low[0] + 2, low[1], high[0], high[1]))
    assert np.array_equal(in_order(points_of(target)[0]), found)
    assert bare_earth.fetch(address, target).point_count == 4000
    check_header(target)


def test_a_page_that_would_be_huge_is_not_asked_for(server, tmp_path, content, monkeypatch):
    monkeypatch.setattr(copc, "_LARGEST_PAGES", -1)
    with pytest.raises(BareEarthError, match=r"octree .* [\d,]+ bytes"):
        bare_earth.fetch(server.add("whole.copc.laz", content), tmp_path / "part.laz")


@pytest.mark.rest(but="0.2")
@pytest.mark.parametrize("share", [0.0, 0.2, 0.75])
def test_a_cancel_leaves_no_file_and_the_next_run_goes_on(
    server, tmp_path, content, share, monkeypatch
):
    monkeypatch.setattr(files, "_MOST", 20_000)
    monkeypatch.setattr(files, "_FIRST", 4_000)
    address, target = server.add("whole.copc.laz", content), tmp_path / "part.copc.laz"
    progress, source = CancelAt(share), tmp_path / "whole.copc.laz"
    with pytest.raises(Cancelled):
        bare_earth.fetch(address, target, progress=progress)
    assert not target.exists()
    kept = [path for path in tmp_path.rglob("[0-9]*-*") if path.parent.name == "0"]
    assert bool(progress.warnings) == bool(kept) == (share > 0)
    assert not kept or "same command" in progress.warnings[-1]
    size = sum(path.stat().st_size for path in kept)
    # Not what the server was asked for or sent: requests that were cancelled come late.
    assert bare_earth.fetch(address, target).size <= len(content) + 30_000 - size
    source.write_bytes(content)
    assert np.array_equal(points_of(target)[0], points_of(source)[0])
    assert not (tmp_path / "part.copc.laz.parts").exists()


def test_other_libraries_read_the_same_points(tmp_path, content):
    copclib = pytest.importorskip("copclib")
    pytest.importorskip("laszip")
    source, target = tmp_path / "whole.copc.laz", tmp_path / "part.copc.laz"
    source.write_bytes(content)
    bare_earth.fetch(source, target, extent=BOX)
    reader = copclib.FileReader(str(target))
    assert reader.ValidateSpatialBounds() and len(reader.GetAllPoints()) == open_las(target).count
    bare_earth.fetch(source, tmp_path / "part.laz", extent=BOX)
    for path in (target, tmp_path / "part.laz"):
        cloud = laspy.read(path, laz_backend=laspy.LazBackend.Laszip)
        assert np.array_equal(in_order(np.array(cloud.points.array).view(np.uint8).reshape(
            len(cloud.points), -1)), clipped(source))  # fmt: skip
