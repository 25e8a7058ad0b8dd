import importlib.util
import json
import re
import struct
from urllib.request import pathname2url

import numpy as np
import pytest
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.crs import provider
from bare_earth.algorithms.crs.provider import to_wgs84, wkt_of_epsg
from bare_earth.algorithms.survey.files import find_files
from bare_earth.algorithms.survey.vpc import read_vpc, write_vpc

UTM = "EPSG:32632"


def wkt_of(code):
    return wkt_of_epsg(int(code.split(":")[1])) or pytest.skip("no library that knows EPSG codes")


def tile(las, name="a.laz", code=UTM, extent=(400_000, 5_000_000, 401_000, 5_001_000), **wanted):
    records = [las.vlr(b"LASF_Projection", 2112, wkt_of(code).encode() + b"\0")] if code else []
    vlrs = [*records, *wanted.pop("vlrs", ())]
    path = las.make(name, version=4, encoding=0x10, vlrs=vlrs, **wanted)
    west, south, east, north = extent
    data = bytearray(path.read_bytes())
    struct.pack_into("<6d", data, 179, east, west, north, south, 90.0, 10.0)
    path.write_bytes(data)
    return path


def written(las, *files, name="all.vpc"):
    target = las.folder / name
    heard = Heard()
    write_vpc(target, files, heard)
    return json.loads(target.read_text(encoding="utf-8")), heard


def test_headers_become_items(las):
    content, heard = written(las, tile(las, point_format=7, count=60))
    assert content["type"] == "FeatureCollection"
    (item,) = content["features"]
    assert (item["type"], item["stac_version"], item["id"]) == ("Feature", "1.0.0", "a")
    assert item["assets"]["data"] == {"href": "./a.laz", "roles": ["data"]}
    properties = item["properties"]
    assert properties["proj:bbox"] == [400_000, 5_000_000, 10, 401_000, 5_001_000, 90]
    assert (properties["pc:count"], properties["pc:encoding"]) == (60, "LASzip")
    assert properties["datetime"] == "2021-02-11T00:00:00Z"
    assert properties["proj:wkt2"] == wkt_of(UTM)
    names = [property_["name"] for property_ in properties["pc:schemas"]]
    assert len(set(names)) == len(names)
    assert {"X", "Classification", "GpsTime", "Red", "ScanChannel"} < set(names)
    assert heard.warnings == []


def test_the_place_on_the_globe_is_that_of_the_crs(las):
    pyproj = pytest.importorskip("pyproj")
    (item,) = written(las, tile(las))[0]["features"]
    ring = np.array(item["geometry"]["coordinates"][0])
    back = pyproj.Transformer.from_crs(4326, UTM, always_xy=True).transform(*ring.T)
    corners = [(4e5, 5e6), (401e3, 5e6), (401e3, 5.001e6), (4e5, 5.001e6), (4e5, 5e6)]
    np.testing.assert_allclose(np.column_stack(back), corners, atol=0.01)
    assert item["bbox"][:2] == ring.min(axis=0).tolist()
    assert item["bbox"][3:5] == ring.max(axis=0).tolist()
    assert 7.6 < item["bbox"][0] < item["bbox"][3] < 7.8
    assert item["bbox"][2::3] == [10, 90]


@pytest.mark.rest
def test_libraries_agree_on_places(monkeypatch):
    wkt = wkt_of_epsg(2927)
    places = np.array([(1_100_000.0, 600_000.0), (1_200_000.0, 7e5)])
    by_package = {"osgeo": provider._Gdal, "pyproj": provider._Pyproj}
    present = [by_package[name] for name in by_package if importlib.util.find_spec(name)]
    if not present:
        pytest.skip("no library that knows EPSG codes")
    expected = to_wgs84(wkt, places)
    for library in present:
        monkeypatch.setattr(provider, "library", lambda library=library: library)
        found = provider.transformed(wkt, "EPSG:4326", places)
        np.testing.assert_allclose(found, expected, atol=1e-6)
        assert provider.transformed("no CRS", "EPSG:4326", places) is None
    longitudes, latitudes = found.T
    assert ((longitudes > -125) & (longitudes < -122)).all()
    assert ((latitudes > 45) & (latitudes < 49)).all()


@pytest.mark.parametrize("code", [None, UTM])
def test_without_a_place_on_the_globe_the_crs_is_left_out(las, code, monkeypatch):
    source = tile(las, code=code)
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    content, heard = written(las, source)
    (item,) = content["features"]
    assert item["properties"]["proj:wkt2"] == ""
    assert item["geometry"] == item["properties"]["proj:geometry"]
    assert any("CRS of 1 of its 1 files" in text for text in heard.warnings)


def test_extra_bytes_are_dimensions(las):
    descriptor = struct.pack("<2sBB32s156x", b"", 9, 0, b"height")
    pair = struct.pack("<2sBB32s156x", b"", 3, 0x08, b"amplitude")
    source = tile(las, extra=6, vlrs=[las.vlr(b"LASF_Spec", 4, descriptor + pair)])
    schemas = written(las, source)[0]["features"][0]["properties"]["pc:schemas"]
    assert schemas[-2:] == [
        {"name": "height", "type": "floating", "size": 4},
        {"name": "amplitude", "type": "floating", "size": 8},
    ]


def test_what_is_written_is_read(las):
    (las.folder / "deep er").mkdir()
    files = [tile(las, "deep er/a%20.laz"), tile(las, "a.laz"), tile(las, "b.las")]
    (las.folder / "products").mkdir()
    content, _ = written(las, *files, name="products/all.vpc")
    assert len({item["id"] for item in content["features"]}) == 3
    found = read_vpc(las.folder / "products" / "all.vpc")
    assert [value.resolve() for value in found] == files


def vpc_of(las, *hrefs, **properties):
    path = las.folder / "by-hand.vpc"
    items = [{"properties": properties, "assets": {"data": {"href": href}}} for href in hrefs]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": items}))
    return path


def test_every_way_to_name_a_local_file_is_understood(las):
    file = las.make("a b.las")
    url = "file://" + pathname2url(str(file))
    path = vpc_of(las, "./a b.las", "a b.las", "a%20b.las", str(file), url, "../clouds/a b.las")
    assert [value.resolve() for value in read_vpc(path)] == [file] * 6


def test_the_points_are_taken_and_not_the_overview(las):
    path = las.folder / "overview.vpc"
    assets = {
        "an-overview": {"href": "./o.copc.laz", "roles": ["overview"]},
        "points": {"href": "./a.laz"},
    }
    item = {"properties": {}, "assets": assets}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [item]}))
    assert [file.name for file in read_vpc(path)] == ["a.laz"]


def test_the_files_of_a_folder_do_not_include_an_overview_of_them(las):
    file, overview = las.make("a.copc.laz"), las.make("all-overview.copc.laz")
    vpc_of(las, "./a.copc.laz").rename(las.folder / "all.vpc")
    assert find_files([las.folder]) == [file]
    # Without its list it is a file like others.
    (las.folder / "all.vpc").unlink()
    assert find_files([las.folder]) == [file, overview]


@pytest.mark.parametrize(
    "href", ["https://host/a.laz", "S3://bucket/a.laz", "/vsicurl/https://host/a.laz"]
)
def test_files_elsewhere_are_refused(las, href):
    with pytest.raises(BareEarthError, match="not on this computer"):
        read_vpc(vpc_of(las, href))


@pytest.mark.parametrize("href", ["./", ".", "", "../clouds"])
def test_an_entry_that_is_a_folder_is_named(las, href):
    las.make("a.las")
    path = vpc_of(las, "./a.las", href)
    with pytest.raises(BareEarthError, match="drive of Windows") as caught:
        read_vpc(path)
    assert re.search(rf'\b2 of {re.escape(str(path))} .*"{re.escape(href)}"', str(caught.value))
    content = json.loads(path.read_text())
    content["features"][1]["id"] = "t01"
    path.write_text(json.dumps(content))
    with pytest.raises(BareEarthError, match="The entry t01 of "):
        read_vpc(path)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("LASF", "not JSON"),
        ("[]", "not a feature collection"),
        ('{"type": "FeatureCollection"}', "names no file"),
        ('{"type": "FeatureCollection", "features": [{}]}', "names no file"),
        ('{"type": "FeatureCollection", "features": [7]}', "names no file"),
        ('{"type": "FeatureCollection", "features": []}', "lists no files"),
    ],
)
def test_what_is_no_virtual_point_cloud_is_told(las, text, told):
    path = las.folder / "odd.vpc"
    path.write_text(text)
    with pytest.raises(BareEarthError, match=told):
        read_vpc(path)


def test_a_missing_virtual_point_cloud_is_told(las):
    with pytest.raises(BareEarthError, match="does not exist"):
        read_vpc(las.folder / "none.vpc")


def test_a_failure_leaves_what_was_there(las):
    target = las.folder / "all.vpc"
    target.write_text("old")
    with pytest.raises(BareEarthError, match="does not exist"):
        write_vpc(target, [las.make(), las.folder / "none.laz"])
    with pytest.raises(BareEarthError, match="no files to list"):
        write_vpc(target, [])
    with pytest.raises(BareEarthError, match=r"name it \.vpc"):
        write_vpc(las.folder / "all.json", [las.make()])
    assert target.read_text() == "old"
    assert [path.name for path in las.folder.glob(".*")] == []
