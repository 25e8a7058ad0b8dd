import builtins
import functools
import importlib.util
import os
import struct
import sys

import numpy as np
import pytest
from surveys import write_classified

from bare_earth import BareEarthError, info
from bare_earth.algorithms.core.files import check_output
from bare_earth.algorithms.las import backends, sources
from bare_earth.algorithms.las.backends import install_hint, missing_packages, require
from bare_earth.algorithms.las.reading import read_cloud
from bare_earth.algorithms.las.writing import check_writable


def refused(path, match, count=60, reads=(read_cloud, info)):
    """Read, describe and write a file; each must end with the same one sentence."""
    target = path.parent / "never.las"
    for action in (
        *(functools.partial(read, path) for read in reads),
        lambda: write_classified(path, target, np.zeros(count, np.uint8)),
    ):
        with pytest.raises(BareEarthError, match=match) as caught:
            action()
        assert "\n" not in str(caught.value)
        assert str(caught.value).endswith(".")
    assert not target.exists()
    assert not list(path.parent.glob(".*"))


def test_a_missing_file(tmp_path):
    refused(tmp_path / "none.las", "does not exist")


def test_a_folder(tmp_path):
    (tmp_path / "in.las").mkdir()
    refused(tmp_path / "in.las", "is a folder", reads=[read_cloud])
    with pytest.raises(BareEarthError, match="laz file is found in"):
        info(tmp_path / "in.las")


@pytest.mark.parametrize("content", [b"", b"LAS", b"PK\3\4" + bytes(500), b"x,y,z\n1,2,3\n"])
def test_what_is_not_las(tmp_path, content):
    path = tmp_path / "in.las"
    path.write_bytes(content)
    refused(path, "not a LAS or LAZ")


@pytest.mark.parametrize("name", ["in.las", "in.laz"])
@pytest.mark.parametrize("part", [4, 100, 226, 230, 300, 0.4, 0.6, 0.8, 0.95, -60, -9, -8, -1])
def test_a_file_that_is_cut_off(las, name, part):
    """At a byte from the start, at a share of the points, or so many bytes before the end."""
    data = las.bytes(
        compressed=name.endswith("laz"), count=3000, vlrs=[las.vlr(b"u", 1, b"d" * 90)]
    )
    path = las.folder / name
    path.write_bytes(data[: int(len(data) * part)] if isinstance(part, float) else data[:part])
    refused(path, "cut off", 3000)


@pytest.mark.parametrize("target", [None, "out.laz", "out.copc.laz"])
def test_a_laz_file_with_fewer_points_than_its_header_says(las, target):
    path = las.make("in.laz", count=60)
    data = bytearray(path.read_bytes())
    struct.pack_into("<I", data, 107, 90)
    path.write_bytes(data)
    with pytest.raises(BareEarthError, match="cut off"):
        if target is None:
            read_cloud(path)
        else:
            write_classified(path, las.folder / target, np.zeros(90, np.uint8))
    assert list(las.folder.iterdir()) == [path]


@pytest.mark.parametrize("name", ["in.las", "in.laz"])
def test_a_file_without_points(las, name):
    path = las.make(name, count=0)
    with pytest.raises(BareEarthError, match="holds no points"):
        read_cloud(path)
    assert info(path).point_count == 0


@pytest.mark.parametrize(("major", "minor"), [(1, 5), (2, 0), (0, 9)])
def test_an_unknown_version(las, major, minor):
    path = las.make()
    data = bytearray(path.read_bytes())
    data[24:26] = bytes((major, minor))
    path.write_bytes(data)
    refused(path, rf"is LAS {major}\.{minor}; LAS 1\.0 to 1\.4 can be read")


def test_an_unknown_point_format(las):
    path = las.make()
    data = bytearray(path.read_bytes())
    data[104] = 11
    path.write_bytes(data)
    refused(path, "has point format 11")


@pytest.mark.parametrize("scale", [0.0, -0.01, float("nan"), float("inf")])
def test_a_scale_that_makes_no_coordinates(las, scale):
    path = las.make()
    data = bytearray(path.read_bytes())
    struct.pack_into("<d", data, 131, scale)
    path.write_bytes(data)
    refused(path, "header of .* is damaged")


def test_a_record_shorter_than_its_format(las):
    path = las.make(point_format=1)
    data = bytearray(path.read_bytes())
    struct.pack_into("<H", data, 105, 27)
    path.write_bytes(data)
    refused(path, "header of .* is damaged")


def test_compressed_points_without_the_record_that_says_how(las):
    path = las.make("in.laz")
    data = path.read_bytes().replace(b"laszip encoded", b"something else")
    path.write_bytes(data)
    refused(path, "does not say how")


def test_a_file_that_must_not_be_read(las, monkeypatch):
    path, real_open = las.make(), builtins.open

    def opened(name, *rest):
        if str(name) == str(path):
            raise PermissionError(13, "Permission denied", str(name))
        return real_open(name, *rest)

    monkeypatch.setattr(sources, "open", opened, raising=False)
    refused(path, "no permission to read")


def test_the_input_is_no_output_not_even_by_another_name(las):
    source, link = las.make(), las.folder / "link.las"
    link.symlink_to(source)
    hard = las.folder / "hard.las"
    os.link(source, hard)
    for target in (source, link, hard, las.folder / "." / "in.las"):
        with pytest.raises(BareEarthError, match="are the same file"):
            check_output(target, (source,))


GEOGRAPHIC = 'GEOGCS["WGS 84",DATUM["d",SPHEROID["s",6378137,298]],UNIT["degree",0.0174532925]]'
GEOGRAPHIC_2 = (
    'GEOGCRS["WGS 84",DATUM["d",ELLIPSOID["s",6378137,298]],CS[ellipsoidal,2],'
    'AXIS["latitude",north],AXIS["longitude",east],ANGLEUNIT["degree",0.0174532925]]'
)
KEYS = struct.pack("<12H", 1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, 4326)


@pytest.mark.parametrize(
    ("number", "data", "encoding"),
    [
        (2112, GEOGRAPHIC.encode(), 0x10),
        (2112, GEOGRAPHIC_2.encode() + b"\0", 0x10),
        (2112, f'COMPD_CS["both",{GEOGRAPHIC},VERT_CS["h",UNIT["metre",1]]]'.encode(), 0x10),
        (34735, KEYS, 0),
    ],
    ids=["WKT 1", "WKT 2", "compound", "GeoTIFF keys"],
)
def test_degrees_cannot_be_measured_in(las, number, data, encoding):
    source = las.make(encoding=encoding, vlrs=[las.vlr(b"LASF_Projection", number, data)])
    cloud = read_cloud(source)
    with pytest.raises(BareEarthError, match="projected CRS") as caught:
        cloud.points(np.ones(60, bool))
    assert "\n" not in str(caught.value) and str(source) in str(caught.value)


def without(monkeypatch, *names):
    found = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *rest: None if name in names else found(name)
    )


def test_missing_packages_are_told_with_the_command_that_installs_them(las, monkeypatch):
    packed, plain = las.make("in.laz"), las.make("in.las")
    without(monkeypatch, "lazrs")
    assert missing_packages() == ["lazrs"]
    for action in (
        lambda: read_cloud(packed),
        lambda: check_writable(las.folder / "out.laz"),
        lambda: check_writable(las.folder / "out.copc.laz"),
        lambda: write_classified(packed, las.folder / "out.las", np.zeros(60, np.uint8)),
    ):
        with pytest.raises(BareEarthError, match="pip install lazrs"):
            action()
    assert read_cloud(plain).count == 60
    check_writable(las.folder / "out.las")
    assert sorted(las.folder.iterdir()) == [plain, packed]


def test_all_missing_packages_are_told_at_once(monkeypatch):
    without(monkeypatch, "lazrs", "laspy")
    with pytest.raises(BareEarthError, match="laspy and lazrs"):
        require("laspy", "lazrs")


def test_inside_qgis_the_menu_is_named_for_lazrs(las, monkeypatch):
    monkeypatch.setitem(sys.modules, "qgis.core", object())
    without(monkeypatch, "lazrs")
    with pytest.raises(BareEarthError, match="LAZ support") as caught:
        read_cloud(las.make("in.laz"))
    assert "pip" not in str(caught.value)


@pytest.mark.parametrize(
    ("platform", "flatpak", "words"),
    [
        ("win32", False, "osgeo4w-setup -q -k -P python3-numpy,python3-scipy"),
        ("darwin", False, "pip install --user --no-deps numpy scipy"),
        ("linux", False, "install python3-numpy python3-scipy'"),
        ("linux", True, "--command=pip3 org.qgis.qgis install numpy scipy --user'"),
    ],
)
def test_inside_qgis_numpy_and_scipy_come_from_where_it_came(
    monkeypatch, tmp_path, platform, flatpak, words
):
    monkeypatch.setitem(sys.modules, "qgis.core", object())
    monkeypatch.setattr(sys, "platform", platform)
    monkeypatch.setattr(backends, "_FLATPAK", tmp_path if flatpak else tmp_path / "missing")
    assert words in install_hint(["numpy", "scipy"])
