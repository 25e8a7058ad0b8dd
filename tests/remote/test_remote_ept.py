"""Parts of remote EPT data sets and of lists: the same points, or one sentence."""

import io
import json
import re

import laspy
import numpy as np
import pytest
from copcs import many_nodes
from ept_sets import MERCATOR, SCHEMA, WKT, add_ept, kinds_of
from matrices import covering
from runs import said

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.las.crs_records import read_crs
from bare_earth.algorithms.las.opening import open_las

BOX = (500_020.0, 5_600_010.0, 500_060.0, 5_600_055.0)


def table_of(path):
    cloud = laspy.read(path)
    columns = cloud.x, cloud.y, cloud.z, cloud.classification, cloud.OriginId
    found = np.column_stack([np.asarray(column, dtype=float) for column in columns])
    assert np.array_equal(np.asarray(cloud.gps_time), found[:, 4] * 0.5)
    return found[np.argsort(found[:, 4])]


def clip(points, box=BOX):
    x, y = points[:, :2].T
    return points[(x >= box[0]) & (x <= box[2]) & (y >= box[1]) & (y <= box[3])]


@pytest.mark.rest(but="1-part.copc.laz")
@pytest.mark.parametrize("name", ["part.laz", "part.copc.laz"])
@pytest.mark.parametrize("point_format", [1, 6])
def test_a_part_has_the_same_points_as_a_clip(server, tmp_path, name, point_format):
    points, address = add_ept(server, point_format=point_format)
    done = bare_earth.fetch(f"{address}?sig=SECRET", tmp_path / name, extent=BOX)
    found = table_of(tmp_path / name)
    assert np.allclose(found, clip(points), atol=1e-6) and done.point_count == len(found)
    layout = open_las(tmp_path / name)
    assert read_crs(layout).epsg == 25832 and layout.minor_version == 4
    assert layout.point_format == (point_format if name == "part.laz" else 6)
    # Each tile once, each file of the hierarchy once, with the query of the description.
    asked = [path for path, *_ in server.asked]
    assert len(asked) == len(set(asked)) and {query for *_, query in server.asked} == {"sig=SECRET"}
    tiles = [path for path in asked if "ept-data" in path]
    assert len(tiles) == 1 + 4 + 9 and done.request_count == len(asked)
    needed = sum(len(server.files[path]) for path in tiles)
    other = sum(len(server.files[path]) for path in set(asked) - set(tiles))
    assert server.sent - other <= 1.05 * needed
    assert [path.name for path in tmp_path.iterdir()] == [name]


@pytest.mark.rest(but="part.laz")
@pytest.mark.parametrize("name", ["part.laz", "part.copc.laz"])
def test_tiles_of_plain_rows_are_read_by_the_schema(server, tmp_path, name):
    points, address = add_ept(server, kind="binary")
    bare_earth.fetch(address, tmp_path / name, extent=BOX)
    assert np.allclose(table_of(tmp_path / name), clip(points), atol=1e-6)
    cloud = laspy.read(tmp_path / name)
    assert cloud.point_format.id == 7 and np.all(cloud.withheld == 1) and np.all(cloud.overlap == 0)
    assert set(cloud.red) == {300} and np.allclose(cloud.scan_angle * 0.006, -12)
    tile = next(path for path in server.files if "ept-data" in path)
    server.files[tile] = server.files[tile][:-5]
    with pytest.raises(BareEarthError, match=r"0-0-0-0 .*damaged"):
        bare_earth.fetch(address, tmp_path / "again.laz")


def test_a_resolution_takes_the_upper_levels(server, tmp_path):
    address = add_ept(server)[1]
    for resolution, levels in ((100 / 16, 1), (100 / 32, 2), (0.5, 3)):
        done = bare_earth.fetch(address, tmp_path / "part.laz", resolution=resolution)
        assert done.point_count == 1000 * levels


def test_a_missing_tile_stops_or_is_counted(server, tmp_path):
    address = add_ept(server)[1]
    gone = server.files.pop("set/ept-data/2-1-1-0.laz")
    count = laspy.read(io.BytesIO(gone)).header.point_count
    with pytest.raises(BareEarthError, match="skip_missing=True"):
        bare_earth.fetch(address, tmp_path / "part.laz")
    kept = [path.name for path in (tmp_path / "part.laz.parts" / "0").glob("[0-9]*.laz")]
    assert kept
    asked = len(server.asked)
    code, _, errors = said("fetch", address, tmp_path / "part.laz", "--skip-missing")
    assert code == 0 and re.search(f"1 tile of set .*{count:,} points", errors)
    assert len(table_of(tmp_path / "part.laz")) == 3000 - count
    # What was there was not asked for again.
    again = [path for path, *_ in server.asked[asked:] if "ept-data" in path]
    assert again and not {f"set/ept-data/{name}" for name in kept} & {*again}
    assert [path.name for path in tmp_path.iterdir()] == ["part.laz"]


@pytest.mark.rest(but="gzip-3")
@pytest.mark.parametrize(
    ("fault", "every"), covering(["cut", "short", "503", "gzip", "old"], [1, 3])
)
def test_bad_answers_give_the_same_points_or_one_sentence(server, tmp_path, fault, every):
    points, address = add_ept(server)
    server.fault = lambda number, path: fault if number % every == every - 1 else ""
    try:
        bare_earth.fetch(address, tmp_path / "part.laz", extent=BOX)
    except BareEarthError as error:
        assert str(error).endswith(".") and not (tmp_path / "part.laz").exists()
        server.fault = lambda number, path: ""
        bare_earth.fetch(address, tmp_path / "part.laz", extent=BOX)
    assert np.allclose(table_of(tmp_path / "part.laz"), clip(points), atol=1e-6)


@pytest.mark.rest
@pytest.mark.parametrize("kind", ["laszip", "binary"])
@pytest.mark.parametrize("fault", ["cut", "short", "gzip"])
@pytest.mark.parametrize("every", [2, 10])
def test_bad_tiles_are_asked_for_again_or_one_sentence(server, tmp_path, kind, fault, every):
    points, address = add_ept(server, kind=kind)
    tiles = [path for path in server.files if "ept-data" in path]
    bad = {path for number, path in enumerate(tiles) if number % every == 0}
    for wanted in ("all", "once"):
        target = tmp_path / f"{wanted}.laz"
        first = {*bad}

        def answer(number, path, wanted=wanted, first=first):
            is_bad = path in bad and (wanted == "all" or path in first)
            first.discard(path)
            return fault if is_bad else ""

        server.fault = answer
        try:
            bare_earth.fetch(address, target)
        except BareEarthError as error:
            assert str(error).endswith(".") and not target.exists()
            server.fault = lambda number, path: ""
            bare_earth.fetch(address, target)
        assert np.allclose(table_of(target), points, atol=1e-6)


@pytest.mark.rest(but="True")
@pytest.mark.parametrize("states_unit", [False, True])
def test_web_mercator_is_kept_with_a_warning(server, tmp_path, states_unit):
    heights = 'VERT_CS["h",VERT_DATUM["d",2005],UNIT["metre",1]]'
    wkt = f'COMPD_CS["c",{MERCATOR},{heights}]' if states_unit else MERCATOR
    points, address = add_ept(server, srs={"wkt": wkt})
    code, _, errors = said("fetch", address, tmp_path / "part.laz")
    assert code == 0 and "Mercator projection" in errors and "--to-utm" in errors
    assert ("unit of its heights" in errors) == (not states_unit)
    assert np.allclose(table_of(tmp_path / "part.laz"), points, atol=1e-6)


@pytest.mark.rest(but="copc.laz")
@pytest.mark.parametrize("ending", ["laz", "copc.laz"])
def test_web_mercator_becomes_utm_and_heights_metres(server, tmp_path, ending):
    pyproj = pytest.importorskip("pyproj")
    mercator = pyproj.CRS.from_epsg(3857)
    points, address = add_ept(server, srs={"wkt": mercator.to_wkt("WKT1_GDAL")})
    target = tmp_path / f"part.{ending}"
    with pytest.raises(BareEarthError, match=r"'height_unit'.* metre"):
        bare_earth.fetch(address, target, extent=BOX, to_utm=True)
    assert not [path for path, *_ in server.asked if "ept-data" in path]
    done = bare_earth.fetch(address, target, extent=BOX, to_utm=True, height_unit="us-foot")
    # x = 500,000 is a longitude of 4.5 degrees.
    crs = read_crs(open_las(target))
    assert crs.epsg == 32631 and done.point_count == len(clip(points))
    expected = clip(points)
    move = pyproj.Transformer.from_crs(mercator, 32631, always_xy=True)
    expected[:, :2] = np.column_stack(move.transform(*expected[:, :2].T))
    expected[:, 2] *= 1200 / 3937
    found = table_of(target)
    assert np.abs(found - expected).max() < 0.0051
    assert np.abs(found[:, 2] - expected[:, 2]).max() < 1e-6


def test_only_web_mercator_becomes_utm(server, tmp_path):
    points, address = add_ept(server)
    bare_earth.fetch(address, tmp_path / "part.laz", to_utm=True)
    assert np.allclose(table_of(tmp_path / "part.laz"), points, atol=1e-6)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"dataType": "zstandard"}, "cannot be read here"),
        ({"dataType": "binary", "schema": [{"name": "X"}]}, "schema cannot be read"),
        ({"dataType": "binary"}, "does not exist"),
        ({"span": 0}, "cube has no size"),
        ({"bounds": [1]}, "cube has no size"),
        ({"bounds": None}, "description"),
        ({"boundsConforming": [1]}, "extent cannot be read"),
    ],
)
def test_a_damaged_description_is_refused(server, tmp_path, change, words):
    address = add_ept(server)[1]
    about = {**json.loads(server.files["set/ept.json"]), **change}
    server.files["set/ept.json"] = json.dumps(about).encode()
    with pytest.raises(BareEarthError, match=words):
        bare_earth.fetch(address, tmp_path / "part.laz")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("text", ["{", "[]", '{"0-0-0-0": "a"}', '{"a": 1}', '{"1-9-0-0": 5}'])
def test_a_damaged_hierarchy_is_refused(server, tmp_path, text):
    address = add_ept(server)[1]
    server.files["set/ept-hierarchy/0-0-0-0.json"] = text.encode()
    with pytest.raises(BareEarthError, match=r"EPT|no point cloud"):
        bare_earth.fetch(address, tmp_path / "part.laz")


def test_a_tile_that_is_no_cloud_is_refused(server, tmp_path):
    address = add_ept(server)[1]
    name = "set/ept-data/0-0-0-0.laz"
    server.files[name] = server.files[name][:-300]
    with pytest.raises(BareEarthError, match="damaged or cut off"):
        bare_earth.fetch(address, tmp_path / "part.laz")
    assert not (tmp_path / "part.laz").exists()


@pytest.mark.parametrize("count", [-1, -7])
@pytest.mark.parametrize("page", ["0-0-0-0", "1-0-0-0"])
def test_a_page_that_names_itself_is_refused(server, tmp_path, count, page):
    address, name = add_ept(server)[1], f"set/ept-hierarchy/{page}.json"
    server.files[name] = json.dumps({**json.loads(server.files[name]), page: count}).encode()
    with pytest.raises(BareEarthError, match=f"{page}.json .*itself"):
        bare_earth.fetch(address, tmp_path / "part.laz")


@pytest.mark.rest(but="packed")
@pytest.mark.parametrize("fault", ["packed", ""])
def test_documents_may_be_compressed_and_are_asked_for_twice(server, tmp_path, fault):
    points, address = add_ept(server)
    first = {"set/ept-hierarchy/0-0-0-0.json", "set/ept-data/2-1-1-0.laz"}

    def answer(number, path):
        if fault:
            return fault * path.endswith("json")
        is_first = path in first
        first.discard(path)
        return "wrong" * is_first

    server.fault = answer
    bare_earth.fetch(address, tmp_path / "part.laz")
    assert np.allclose(table_of(tmp_path / "part.laz"), points, atol=1e-6)


def test_a_document_that_unpacks_to_too_much_is_refused(server, tmp_path):
    address = add_ept(server)[1]
    server.files["set/ept.json"] = b"[" + bytes(1 << 23)
    server.fault = lambda number, path: "packed"
    with pytest.raises(BareEarthError, match="4,194,304 bytes"):
        bare_earth.fetch(address, tmp_path / "part.laz")


@pytest.mark.rest(but="f4")
@pytest.mark.parametrize("kind", ["f8", "i8", "f4"])
def test_coordinates_of_other_types_are_read(server, tmp_path, kind):
    points, address = add_ept(server, kind="binary")
    about = json.loads(server.files["set/ept.json"])
    old = kinds_of(SCHEMA)
    new = np.dtype([(name, f"<{kind}" if name in "XYZ" else old[name]) for name in old.names])
    for row in about["schema"][:3]:
        row["type"] = {"f": "float", "i": "signed"}[kind[0]]
        row["size"] = int(kind[1])
        if kind[0] == "f":
            del row["scale"], row["offset"]
        elif kind == "i8":
            row["offset"] = 0.0
    server.files["set/ept.json"] = json.dumps(about).encode()
    for path in [path for path in server.files if path.endswith(".bin")]:
        rows = np.frombuffer(server.files[path], old)
        moved = rows.astype(new)
        for row, axis in zip(SCHEMA, "XYZ"):
            if kind[0] == "f":
                moved[axis] = rows[axis] * row["scale"] + row["offset"]
            elif kind == "i8":
                moved[axis] = rows[axis].astype("i8") + round(row["offset"] / row["scale"])
        server.files[path] = moved.tobytes()
    bare_earth.fetch(address, tmp_path / "part.laz")
    found = table_of(tmp_path / "part.laz")
    assert np.allclose(found, points, atol=0.5 if kind == "f4" else 1e-6)


@pytest.mark.rest
@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("ept-hierarchy/0-0-0-0.json", b'{"0-0-0-0": 200000000}', "200,000,000 points"),
        ("ept-hierarchy/0-0-0-0.json", b" " * (1 << 24) + b"{}", "too much"),
        ("ept.json", b"[" + b"[]," * (1 << 20) + b"0]", "ept.json cannot be read"),
    ],
)
def test_sizes_are_checked_before_they_are_read(server, tmp_path, name, text, words):
    address = add_ept(server)[1]
    server.files[f"set/{name}"] = text
    with pytest.raises(BareEarthError, match=words):
        bare_earth.fetch(address, tmp_path / "part.laz")


def test_a_crs_as_text_is_read_and_missing_points_are_told(server, tmp_path):
    address = add_ept(server, srs=WKT)[1]
    about = json.loads(server.files["set/ept.json"])
    server.files["set/ept.json"] = json.dumps({**about, "points": 3001}).encode()
    errors = said("fetch", address, tmp_path / "part.laz")[2]
    assert re.search(r"set .* 3,000 points, not 3,001\b", errors)
    assert read_crs(open_las(tmp_path / "part.laz")).epsg == 25832


# Lists


def item_of(href, name="a", **properties):
    return {
        "type": "Feature",
        "stac_version": "1.0.0",
        "id": name,
        "properties": properties,
        "assets": {"data": {"href": href, "roles": ["data"]}},
        "links": [],
    }


def text_of(*items):
    return json.dumps({"type": "FeatureCollection", "features": items}).encode()


@pytest.fixture
def copc(server, tmp_path_factory):
    content = many_nodes(tmp_path_factory.mktemp("copc"))
    server.add("clouds/a.copc.laz", content)
    server.add("clouds/b.copc.laz", content)
    return content


@pytest.fixture
def tiles(server, copc):
    return server.add(
        "all.vpc", text_of(item_of("clouds/a.copc.laz"), item_of("clouds/b.copc.laz"))
    )


def test_each_cloud_of_a_list_becomes_a_file(tiles, tmp_path):
    with pytest.raises(BareEarthError, match="Name a new folder"):
        bare_earth.fetch(tiles, tmp_path / "all.laz")
    done = bare_earth.fetch(tiles, tmp_path / "all")
    assert sorted(path.name for path in (tmp_path / "all").iterdir()) == [
        "a.copc.laz",
        "b.copc.laz",
    ]
    assert done.file_count == 2 and done.point_count == 8000
    assert [path.name for path in tmp_path.iterdir()] == ["all"]
    with pytest.raises(BareEarthError, match="exists already"):
        bare_earth.fetch(tiles, tmp_path / "all")


def test_a_list_does_not_say_where_files_are_written(server, copc, tmp_path):
    names = ["clouds/a.copc.laz", "clouds/..%2F..%2Fevil.copc.laz", "clouds/..%5Ca.copc.laz"]
    for name in names:
        server.add(name, copc)
    address = server.add("all.vpc", text_of(*map(item_of, names)))
    (tmp_path / "in").mkdir()
    bare_earth.fetch(address, tmp_path / "in" / "all")
    written = {path.name for path in (tmp_path / "in" / "all").iterdir()}
    assert written == {"a.copc.laz", "_.._evil.copc.laz", "_a.copc.laz"}
    assert [path.name for path in tmp_path.iterdir()] == ["in"]


def test_clouds_outside_of_the_area_are_not_asked_for(server, copc, tmp_path):
    far = item_of("clouds/b.copc.laz", **{"proj:bbox": [0, 0, 0, 1, 1, 1], "proj:epsg": 25832})
    address = server.add("all.vpc", text_of(item_of("clouds/a.copc.laz"), far))
    box = (400_000, 5_000_000, 400_050, 5_000_050)
    bare_earth.fetch(address, tmp_path / "part.laz", extent=box)
    assert {path for path, *_ in server.asked} == {"all.vpc", "clouds/a.copc.laz"}


@pytest.mark.parametrize("href", ["s3://127.0.0.1/a.copc.laz", "http://127.0.0.1:9/a.copc.laz"])
def test_another_port_or_scheme_is_another_server(server, tmp_path, href):
    address = server.add("all.vpc", text_of(item_of(href)))
    with pytest.raises(BareEarthError, match=f"{href[:14]}.*follow=True"):
        bare_earth.fetch(address, tmp_path / "part.laz")


@pytest.mark.rest(but="about0")
@pytest.mark.parametrize("about", [{"proj:epsg": 4326}, {"proj:code": "EPSG:4326"}, {}])
def test_an_extent_in_degrees_says_nothing(server, copc, tmp_path, about):
    pair = [
        item_of(f"clouds/{name}.copc.laz", **{"proj:bbox": [2.0, 45.1, 2.1, 45.2], **about})
        for name in ("a", "b")
    ]
    address = server.add("all.vpc", text_of(*pair))
    box = (400_000, 5_000_000, 400_050, 5_000_050)
    assert bare_earth.fetch(address, tmp_path / "all", extent=box).file_count == 2
    # In another CRS that is not in degrees, nothing is near, so that the clouds are asked.
    other = item_of("clouds/a.copc.laz", **{"proj:bbox": [1, 1, 2, 2], "proj:epsg": 3857})
    server.add("all.vpc", text_of(other))
    assert bare_earth.fetch(address, tmp_path / "part.laz", extent=box).file_count == 1


def test_one_file_of_an_item_is_fetched(server, copc, tmp_path):
    add_ept(server)
    item = item_of("clouds/a.copc.laz")
    item["assets"]["ept"] = {"href": "set/ept.json"}
    address = server.add("all.vpc", text_of(item))
    code, _, errors = said("fetch", address, tmp_path / "part.laz")
    assert code == 0 and re.search("1 item .*EPT.* COPC is taken", errors)
    assert len(laspy.read(tmp_path / "part.laz")) == 4000


def test_a_list_that_would_fill_the_memory_is_refused(server, tmp_path):
    text = b'{"type": "FeatureCollection", "features": [' + b"{}," * 6_000 + b"{}]}"
    with pytest.raises(BareEarthError, match="5,000 point clouds"):
        bare_earth.fetch(server.add("all.vpc", text), tmp_path / "part.laz")
    with pytest.raises(BareEarthError, match="neither a point cloud"):
        server.add("all.vpc", text.replace(b"{},", b"{}," * 1000))
        bare_earth.fetch(server.address("all.vpc"), tmp_path / "part.laz")


def test_items_and_collections_of_stac_are_followed(server, copc, tmp_path):
    points, _ = add_ept(server)
    item = item_of("../set/ept.json")
    server.add("stac/item.json", json.dumps(item).encode())
    links = [{"rel": "item", "href": "./item.json"}, {"rel": "self", "href": "http://nowhere/"}]
    collection = {"type": "Collection", "links": links}
    address = server.add("stac/collection.json", json.dumps(collection).encode())
    done = bare_earth.fetch(address, tmp_path / "part.laz")
    assert done.point_count == len(points)


def test_other_servers_are_followed_only_if_the_user_says_so(server, copc, tmp_path):
    href = server.address("clouds/a.copc.laz", "localhost")
    address = server.add("all.vpc", text_of(item_of(href)))
    local = tmp_path / "local.vpc"
    local.write_bytes(text_of(item_of(server.address("clouds/a.copc.laz"))))
    for given, host in ((address, "localhost"), (local, "127.0.0.1")):
        with pytest.raises(BareEarthError, match=f"http://{host}:.*follow=True"):
            bare_earth.fetch(given, tmp_path / "part.laz")
        assert {path for path, *_ in server.asked} <= {"all.vpc"}
    for given in (address, local):
        assert bare_earth.fetch(given, tmp_path / "part.laz", follow=True).point_count == 4000


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (text_of(item_of("file:///etc/passwd.copc.laz")), "cannot be fetched"),
        (text_of(item_of("a.txt")), "lists no COPC"),
        (text_of(), "lists no COPC"),
        (b"<html></html>", "neither a point cloud"),
        (b"[]", "neither a point cloud"),
        (json.dumps({"type": "Feature", "assets": [1]}).encode(), "lists no COPC"),
    ],
)
def test_a_list_without_remote_clouds_is_refused(server, tmp_path, content, words):
    with pytest.raises(BareEarthError, match=words):
        bare_earth.fetch(server.add("all.json", content), tmp_path / "part.laz")
    assert not list(tmp_path.iterdir())


def test_a_list_on_this_computer_may_name_its_files(copc, tmp_path):
    (tmp_path / "a.copc.laz").write_bytes(copc)
    (tmp_path / "all.vpc").write_bytes(text_of(item_of("./a.copc.laz")))
    assert bare_earth.fetch(tmp_path / "all.vpc", tmp_path / "part.laz").point_count == 4000


@pytest.mark.rest(but="3-403")
@pytest.mark.parametrize("fault", ["cut", "short", "403", "old"])
@pytest.mark.parametrize("every", [1, 3])
def test_bad_answers_to_a_list_give_all_clouds_or_one_sentence(
    server, tiles, tmp_path, fault, every
):
    server.fault = lambda number, path: fault if number % every == every - 1 else ""
    try:
        done = bare_earth.fetch(tiles, tmp_path / "all")
    except BareEarthError as error:
        assert str(error).endswith(".") and not (tmp_path / "all").exists()
        server.fault = lambda number, path: ""
        done = bare_earth.fetch(tiles, tmp_path / "all")
    assert done.file_count == 2 and done.point_count == 8000


@pytest.mark.rest
@pytest.mark.parametrize("fault", ["cut", "short"])
@pytest.mark.parametrize("every", [10])
@pytest.mark.parametrize("place", ["set/ept.json", "all.vpc"])
def test_what_is_kept_of_bad_answers_is_whole(
    server, tiles, tmp_path, monkeypatch, fault, every, place
):
    monkeypatch.setenv("BARE_EARTH_CACHE", str(tmp_path / "cache"))
    add_ept(server)
    target = tmp_path / ("out.laz" if place == "set/ept.json" else "out")
    words = "key-points", server.address(place), target, "--ground-classes", "0", "1", "2"
    server.fault = lambda number, path: fault if number % every == every - 1 else ""
    code, _, errors = said(*words)
    kept = [laspy.read(path).header.point_count for path in (tmp_path / "cache").rglob("*.laz")
            if "parts" not in path.parts]  # fmt: skip
    assert {*kept} <= ({3000} if place == "set/ept.json" else {4000})
    if code:
        assert errors.splitlines()[-1].endswith(".") and not target.exists()
        server.fault = lambda number, path: ""
        code, _, errors = said(*words)
    assert code == 0, errors


def test_a_data_set_is_an_input_like_a_file(server, tmp_path, monkeypatch):
    monkeypatch.setenv("BARE_EARTH_CACHE", str(tmp_path))
    add_ept(server)
    address = server.address("set/ept.json")
    assert bare_earth.info(address).point_count == 3000
    kept = [path for path in tmp_path.rglob("*.laz") if "parts" not in path.parts]
    assert [path.name for path in kept] == ["set.laz"]
    server.asked.clear()
    assert bare_earth.info(f"{address}?sig=x").point_count == 3000
    assert len(server.asked) == 1
