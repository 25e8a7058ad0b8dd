"""Files that lie about themselves: each ends in a sentence, none in an abort, a hang or a guess."""

import itertools
import json
import os
import shutil
import struct
import subprocess
import sys
import time

import laspy
import lazrs
import numpy as np
import pytest
import surveys
from las_files import GPS_TIMES, make_records
from runs import Heard
from surveys import write_classified

from bare_earth import BareEarthError, Progress, classify, info
from bare_earth.algorithms.crs.provider import to_wgs84
from bare_earth.algorithms.crs.system import crs_of_wkt
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.extrabytes import ExtraDimension
from bare_earth.algorithms.las.laszip import Compression
from bare_earth.algorithms.las.opening import open_las
from bare_earth.algorithms.las.reading import read_cloud, read_parts
from bare_earth.algorithms.las.writing import write_changed
from bare_earth.algorithms.survey.files import open_survey
from bare_earth.algorithms.survey.vector_files import read_boundary, read_lines
from bare_earth.algorithms.survey.vpc import read_vpc, write_vpc
from benchmarks.data import FOLDER

DAMAGED = FOLDER / "damaged"
METHOD = {"method": "slope", "preset": "whitebox"}
# Little memory and time: what takes more is an abort or a hang.
LIMITED = """
import contextlib, sys
from pathlib import Path
import numpy as np
with contextlib.suppress(ImportError, ValueError):  # Windows has no such limits, macOS not this one
    import resource
    resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))
from bare_earth import BareEarthError, info
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.writing import write_changed
classes = Edits(classification=np.zeros(60, np.uint8))
for source in map(Path, sys.argv[1:]):
    for action in (
        lambda: info(source),
        lambda: write_changed(source, source.with_name("out.laz"), classes),
    ):
        try:
            action()
            print("read", flush=True)
        except BareEarthError as error:
            print(error, flush=True)
"""


def said(*paths):
    """Return what reading and writing files says, in a process that could not take QGIS along."""
    command = [sys.executable, "-c", LIMITED, *map(str, paths)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    return done.stdout.splitlines()


def damage(path, layout, *places_and_values):
    data = bytearray(path.read_bytes())
    for place, value in places_and_values:
        struct.pack_into(f"<{layout}", data, place, value)
    path.write_bytes(data)
    return path


def refused(*paths):
    lines = said(*paths)
    assert len(lines) == 2 * len(paths)
    for line in lines:
        assert "damaged or cut off" in line, line


@pytest.fixture
def make(las):
    """Return a function that makes a file of 60 points under another name each time."""
    numbers = itertools.count()

    def make(suffix=".laz", point_format=1, **wanted):
        name = f"{next(numbers)}{suffix}"
        return las.make(name, version=4, point_format=point_format, **wanted)

    return make


def chunk_table(path):
    data = path.read_bytes()
    return struct.unpack_from("<q", data, struct.unpack_from("<I", data, 96)[0])[0]


def laszip_record(path):
    return path.read_bytes().index(b"laszip encoded") + 52


@pytest.mark.rest
def test_a_number_of_chunks_that_cannot_be(make):
    paths = []
    for point_format, chunks in itertools.product((1, 6), (0, 2**32 - 1, 10**6, 200)):
        path = make(point_format=point_format)
        paths.append(damage(path, "I", (chunk_table(path) + 4, chunks)))
    refused(*paths)


@pytest.mark.rest
def test_chunks_of_a_size_that_cannot_be(make):
    def with_sizes(*sizes):
        for point_format, size in itertools.product((1, 6), sizes):
            path = make(point_format=point_format)
            yield damage(path, "I", (laszip_record(path) + 12, size))

    refused(*with_sizes(0, 7))
    # One chunk, whose number of points follows from that of the file.
    assert said(*with_sizes(10**8, 2**32 - 2)) == ["read"] * 8


@pytest.mark.rest
def test_more_points_than_a_file_can_hold(make):
    counts = (2**59, 2**63, 2**64 - 1, 10**9, 60_000)
    files = itertools.product((".las", ".laz"), counts)
    refused(*(damage(make(suffix, 6), "Q", (247, count)) for suffix, count in files))


@pytest.mark.rest
def test_more_points_than_chunks_of_any_size_can_hold(make):
    source = make(".las", 6)
    path = source.with_name("in.copc.laz")
    write_classified(source, path, np.zeros(60, np.uint8))
    refused(damage(path, "Q", (247, 2**40)))


@pytest.mark.rest
def test_a_chunk_longer_than_the_file(make):
    path = make(point_format=6)
    with open(path, "r+b") as file:
        file.seek(chunk_table(path))
        lazrs.write_chunk_table(file, [(60, 2**40)], lazrs.LazVlr(open_las(path).laszip))
    refused(path)


@pytest.mark.rest
def test_more_records_than_there_are(make):
    paths = [
        damage(make(suffix), "I", (100, number))
        for suffix in (".las", ".laz")
        for number in (2**32 - 1, 10**6)
    ]
    assert said(*paths) == ["read"] * 8


@pytest.mark.rest
def test_a_compression_that_is_none(make):
    paths = []
    for at, value in ((0, 1), (0, 9), (32, 0), (32, 60_000), (36, 7)):
        path = make()
        paths.append(damage(path, "H", (laszip_record(path) + at, value)))
    for line in said(*paths):
        assert "damaged or cut off" in line or "compressed in a way" in line


@pytest.mark.rest
def test_a_compression_of_another_point_format(make):
    old, new = make(point_format=1, extra=2), make(point_format=6)  # 30 bytes a point, both
    refused(damage(old, "B", (104, 0x80 | 6)), damage(new, "B", (104, 0x80 | 1)))


@pytest.mark.rest
def test_parts_of_a_point_of_another_type_than_their_length(make):
    def with_type(point_format, part, kind):
        path = make(point_format=point_format, extra=2)
        return damage(path, "H", (laszip_record(path) + 34 + 6 * part, kind))

    # Wave packets as colours, colours with near infrared as such without, extra bytes as colours.
    paths = [with_type(10, 2, 11), with_type(8, 1, 11), with_type(7, 2, 11), with_type(7, 1, 14)]
    # A time as colours, colours as a time, a time as extra bytes.
    paths += [with_type(1, 1, 8), with_type(2, 1, 7), with_type(3, 1, 0)]
    refused(*paths)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -float("inf"), 1e300, 1e13])
@pytest.mark.parametrize("place", [*range(131, 155, 8), *range(155, 179, 8)])
def test_scales_and_offsets_with_which_nothing_can_be_calculated(las, place, value):
    path = damage(las.make(), "d", (place, value))
    for action in (info, read_cloud):
        with pytest.raises(BareEarthError, match=r"header .* damaged"):
            action(path)


def test_extra_bytes_of_no_type_and_no_length(las):
    record = las.vlr(b"LASF_Spec", 4, struct.pack("<2xBB32s156x", 0, 0, b"nothing"))
    source, target = las.make(vlrs=[record], extra=2), las.folder / "out.las"
    assert info(source).extra_dimensions == ["undocumented"]
    values = np.arange(60, dtype=np.float32)
    write_changed(source, target, Edits(extra=ExtraDimension("height", "of it", values)))
    records = las.split(target).records
    assert np.array_equal(records[:, :-4], las.split(source).records)
    assert np.array_equal(np.ascontiguousarray(records[:, -4:]).view("<f4")[:, 0], values)


UNPACKED = """
import sys
from pathlib import Path
import numpy as np
from bare_earth import BareEarthError
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.writing import write_changed
classes = Edits(classification=np.zeros(3000, np.uint8))
for source in map(Path, sys.argv[1:]):
    try:
        write_changed(source, source.with_name("out.las"), classes)
        print("read", flush=True)
    except BareEarthError as error:
        print(error, flush=True)
"""


def with_blank_block(path, start, length=4096):
    """Put bytes into a file as a disk has them where nothing was written."""
    data = bytearray(path.read_bytes())
    data[start : start + length] = b"\xff" * length
    path.write_bytes(data)
    return path


@pytest.mark.rest
@pytest.mark.parametrize(
    "point_format", [1, 6, *(pytest.param(n, marks=pytest.mark.long) for n in (3, 4, 7))]
)
def test_a_blank_block_among_the_gps_times_does_not_fill_the_stack(make, point_format):
    records = make_records(point_format, 3000)
    times = 1e8 + np.arange(3000) // 3 * 1e-3 + np.arange(3000) % 2 * 50.0
    place = GPS_TIMES[point_format]
    records[:, place : place + 8] = times.astype("<f8").view(np.uint8).reshape(-1, 8)
    sound = make(point_format=point_format, records=records)
    start = open_las(sound).points_start + 8
    if point_format < 6:
        places = start + np.arange(200, 20_000, 2500)
    else:
        _, *layers = struct.unpack_from("<10I", sound.read_bytes(), start + records.shape[1])
        count = Compression.of(open_las(sound).laszip).layers
        places = [start + records.shape[1] + 4 + 4 * count + sum(layers[:8])]
    paths = []
    for at in places:
        path = make(point_format=point_format, records=records)
        length = min(4096, layers[8]) if point_format > 5 else 4096
        paths.append(with_blank_block(path, int(at), length))
    command = [sys.executable, "-c", UNPACKED, *map(str, (sound, *paths))]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    first, *others = done.stdout.splitlines()
    assert first == "read" and len(others) == len(paths)
    assert all("damaged or cut off" in line for line in others)


def test_the_files_that_broke_it_once(tmp_path):
    names = ("chunk-count.laz", "chunk-size.laz", "vlr-count.laz", "extra-bytes-zero.laz")
    if not all((DAMAGED / name).is_file() for name in names):
        pytest.skip(f"{DAMAGED} is not here")
    lines = said(*(shutil.copy(DAMAGED / name, tmp_path) for name in names))
    assert len(lines) == 2 * len(names)
    for line in lines:
        assert line == "read" or line.endswith(".")


@pytest.mark.parametrize("point_format", [4, 5])
def test_wave_packets_are_compressed_as_laszip_reads_them(las, point_format):
    source, target = las.make(version=3, point_format=point_format), las.folder / "out.laz"
    write_classified(source, target, np.full(60, 2, np.uint8))
    record = open_las(target).laszip
    items = [struct.unpack_from("<HHH", record, at) for at in range(34, len(record), 6)]
    assert items[-1] == (9, 29, 1)
    found = laspy.read(target)
    assert set(found.classification) == {2}
    assert np.array_equal(found.wavepacket_index, laspy.read(source).wavepacket_index)


# An input that another file takes the place of


def replace_by_another(path, kind):
    """Put other points of the same number into a file, or in its place."""
    before, data = path.stat(), bytearray(path.read_bytes())
    data[-1] ^= 0xFF
    if kind == "renamed":
        other = path.with_name("other")
        other.write_bytes(data)
        os.utime(other, ns=(before.st_atime_ns, before.st_mtime_ns))
        other.replace(path)
    elif kind == "header only":
        data[-1] ^= 0xFF
        data[30] ^= 0xFF
        path.write_bytes(data)
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))
    else:
        path.write_bytes(data)


@pytest.mark.parametrize("kind", ["renamed", "written", "header only"])
@pytest.mark.parametrize(("name", "point_format"), [("a.las", 1), ("a.laz", 1), ("a.laz", 6)])
@pytest.mark.parametrize("keep", [False, True])
def test_an_input_that_changed_since_it_was_read_is_refused(las, kind, name, point_format, keep):
    source = las.make(name, version=4, point_format=point_format)
    target = las.folder / f"out{source.suffix}"
    cloud, layout = read_cloud(source, keep_records=keep), open_las(source)
    classes = Edits(classification=np.zeros(60, np.uint8))
    write_changed(source, target, classes, cloud=cloud)
    target.unlink()
    replace_by_another(source, kind)
    for given in (cloud, None):
        with pytest.raises(BareEarthError, match=r"a\.la[sz] has changed"):
            write_changed(layout, target, classes, cloud=given)
    assert list(las.folder.iterdir()) == [source]


def test_an_input_that_changes_while_it_is_written_is_refused(las):
    source, target = las.make("a.laz", version=4, point_format=6), las.folder / "out.las"

    class Meanwhile(Heard):
        def report(self, fraction):
            replace_by_another(source, "renamed")

    with pytest.raises(BareEarthError, match="has changed"):
        write_classified(source, target, np.zeros(60, np.uint8), Meanwhile())
    assert list(las.folder.iterdir()) == [source]


@pytest.mark.parametrize("memory", [4.0, 0.001])
@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_an_input_that_changes_while_it_is_classified_is_refused(tmp_path, suffix, memory):
    source = surveys.write(tmp_path / f"in{suffix}", surveys.strip(20_000))

    class Meanwhile(Progress):
        done = False

        def report(self, fraction):
            if fraction > 0.5 and not self.done:
                self.done = True
                replace_by_another(source, "renamed")

    progress, target = Meanwhile(), tmp_path / "out.laz"
    with pytest.raises(BareEarthError, match=r"in\.la[sz] has changed"):
        classify(source, target, threads=1, memory=memory, progress=progress, **METHOD)
    assert progress.done and list(tmp_path.iterdir()) == [source]


def test_parts_and_all_points_know_their_file(las):
    source = las.make("a.laz")
    layout = open_las(source)
    assert read_cloud(layout).file is layout
    assert [part.file for part in read_parts(layout)] == [layout]


# COPC


def test_the_copc_file_with_sub_pages_of_another_program(tmp_path):
    source = FOLDER / "awkward" / "simple_with_page.copc.laz"
    if not source.is_file():
        pytest.skip(f"{source} is not here")
    count, target = open_las(source).count, tmp_path / "out.copc.laz"
    write_classified(source, target, np.full(count, 2, np.uint8))
    with laspy.CopcReader.open(target) as reader:
        assert len(reader.query()) == count


def test_a_crs_too_long_for_copc_stays_where_it_is(las):
    text = f'LOCAL_CS["{"x" * 65_600}",UNIT["metre",1]]'.encode()
    record = las.evlr(b"LASF_Projection", 2112, text)
    source = las.make(version=4, point_format=6, encoding=0x10, evlrs=[record])
    progress, target = Heard(), las.folder / "out.copc.laz"
    write_classified(source, target, np.zeros(60, np.uint8), progress)
    assert any("too long" in text for text in progress.warnings)
    assert open_las(target).vlr(("LASF_Projection", 2112)).data == text


# The CRS


@pytest.mark.parametrize(
    "text",
    [
        "COMPD_CS[" * 4000 + 'PROJCS["p",UNIT["metre",1]]',
        'PROJCS["p",' * 4000,
        "PROJCS[" + "[" * 100_000,
    ],
)
def test_brackets_in_brackets_are_no_crs(text):
    assert crs_of_wkt(text) is None or crs_of_wkt(text).horizontal_unit == 1.0


def test_a_crs_that_the_library_for_rasters_does_not_know_is_told_and_not_printed(las, capfd):
    pytest.importorskip("rasterio")
    record = las.vlr(b"LASF_Projection", 2112, b'PROJCS["p",UNIT["metre",1]]')
    source = las.make(version=4, point_format=6, encoding=0x10, vlrs=[record])
    progress, out = Heard(), las.folder / "dtm.tif"
    how = {"from_classes": range(256), "dtm": out, "progress": progress}  # of random numbers
    classify(source, las.folder / "out.las", **how, **METHOD)
    assert any("without a CRS" in text for text in progress.warnings)
    assert out.is_file() and capfd.readouterr().err == ""


@pytest.mark.parametrize("code", ["9" * 60_000, "²", "-1", "4.5", "1e3"])
def test_codes_that_are_none_are_left_out(code):
    crs = crs_of_wkt(f'PROJCS["p",UNIT["metre",1],AUTHORITY["EPSG","{code}"]]')
    assert (crs.name, crs.epsg) == ("p", None)


@pytest.mark.parametrize("unit", ["1e308", "1e-308", "nan", "-1", "0", "1e7"])
def test_units_that_are_none_are_told(unit):
    progress = Heard()
    crs = crs_of_wkt(f'PROJCS["p",UNIT["metre",{unit}]]', progress)
    assert crs.horizontal_unit == 1.0 and "is not known" in progress.warnings[0]


@pytest.mark.parametrize("value", [1e300, 1e17, float("inf"), float("nan")])
def test_places_off_the_earth_have_no_longitude(value):
    wkt = 'PROJCS["p",GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],'
    wkt += 'PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION['
    wkt += '"Transverse_Mercator"],PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",'
    wkt += '9],PARAMETER["scale_factor",0.9996],PARAMETER["false_easting",500000],PARAMETER['
    wkt += '"false_northing",0],UNIT["metre",1]]'
    assert to_wgs84(wkt, np.array([[value, 5e6], [5e5, 5e6]])) is None


# Surveys


@pytest.mark.parametrize("value", [1e300, 1e17, float("nan"), float("inf")])
@pytest.mark.parametrize("place", range(179, 211, 8))
def test_an_extent_that_the_points_cannot_have(las, place, value):
    ends = [(at, x) for at, x in zip(range(179, 211, 8), (4e5, 4e5 - 10, 5e6 + 10, 5e6))]
    sound = damage(las.make("a.las"), "d", *ends)
    odd = damage(las.make("b.las"), "d", *ends, (place, value))
    found = open_survey([sound, odd])
    assert [tile.path for tile in found.tiles] == [sound]
    assert "extent" in found.broken[0].reason
    with pytest.raises(BareEarthError, match="not state the extent"):
        write_vpc(las.folder / "all.vpc", [odd])


@pytest.mark.parametrize(
    "change",
    [
        {"href": "a\0b.laz"},
        {"href": "x" * 5000},
        {"href": "%" + "x" * 5000},
        {"href": 7},
        {"href": "\ud800.laz"},
        {"pc:count": 1e400},
        {"pc:count": "many"},
        {"proj:bbox": [0, 1, "x", 3]},
    ],
)
def test_virtual_point_clouds_that_name_what_cannot_be(tmp_path, change):
    properties = {"pc:count": 5, **{k: v for k, v in change.items() if ":" in k}}
    asset = {"href": change.get("href", "./a.laz")}
    feature = {"properties": properties, "assets": {"data": asset}}
    path = tmp_path / "a.vpc"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    with pytest.raises(BareEarthError) as caught:
        open_survey([path])
    assert "\n" not in str(caught.value) and str(caught.value).endswith(".")


# Polygons and lines


@pytest.mark.parametrize("corner", ["[1e999, 1]", "[NaN, 1]", f"[{'9' * 400}, 1]", "[null, 1]"])
@pytest.mark.parametrize(("kind", "read"), [("Polygon", read_boundary), ("LineString", read_lines)])
def test_corners_that_are_no_places_are_refused(tmp_path, corner, kind, read):
    corners = f"[[0, 0], {corner}, [1, 1]]"
    coordinates = f"[{corners}]" if kind == "Polygon" else corners
    path = tmp_path / "a.geojson"
    path.write_text(f'{{"type": "{kind}", "coordinates": {coordinates}}}')
    with pytest.raises(BareEarthError, match=r"is not valid|Cannot read"):
        read(path)


@pytest.mark.rest
def test_many_shapes_are_read_in_a_time_that_grows_with_their_number(tmp_path):
    path = tmp_path / "a.geojson"
    lines = [{"type": "LineString", "coordinates": [[0, 0], [1, 1]]}] * 30_000
    path.write_text(json.dumps({"type": "GeometryCollection", "geometries": lines}))
    begun = time.monotonic()
    assert len(read_lines(path)) == 30_000
    assert time.monotonic() - begun < 30  # with the square of their number it takes minutes


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names here")
@pytest.mark.parametrize("name", ["a.las", "a.laz", "a.vpc", "a.txt", "a.geojson"])
def test_a_pipe_is_not_waited_for(tmp_path, name):
    path = tmp_path / name
    os.mkfifo(path)
    readers = {".vpc": read_vpc, ".txt": lambda path: open_survey([path])}
    readers[".geojson"] = read_boundary
    with pytest.raises(BareEarthError, match="pipe"):
        readers.get(path.suffix, read_cloud)(path)
