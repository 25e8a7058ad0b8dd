"""What `info` says of files, and what its checks count."""

import json
import struct

import laspy
import numpy as np
import pytest
from runs import said

import bare_earth
from bare_earth.algorithms.tools import info

COUNT = 60
HOUR = 3.2e8  # an adjusted standard time


def write(path, edit=lambda las: None, point_format=7, version="1.4", header=b"", at=0):
    """Write points in two strips that are right in all respects, then edited."""
    las = laspy.LasData(laspy.LasHeader(point_format=point_format, version=version))
    las.header.scales, las.header.offsets = (0.01,) * 3, (500_000.0, 5_600_000.0, 0.0)
    las.header.global_encoding.gps_time_type = laspy.header.GpsTimeType.STANDARD
    if point_format >= 6:
        las.header.add_crs(pytest.importorskip("pyproj").CRS("EPSG:25832"))
    number = np.arange(COUNT)
    las.x, las.y = 500_000.0 + number % 10, 5_600_000.0 + number // 10
    las.z, las.classification = 100.0 + 0.1 * number, np.where(number < 40, 2, 5)
    las.return_number, las.number_of_returns = number % 2 + 1, np.full(COUNT, 2)
    las.gps_time = HOUR + 0.1 * (number // 2)
    las.point_source_id = np.where(number < 30, 11, 12)
    las.intensity, las.red, las.scan_direction_flag = number + 1, 300 * number, number % 2
    edit(las)
    las.write(str(path))
    if header:
        content = bytearray(path.read_bytes())
        content[at : at + len(header)] = header
        path.write_bytes(bytes(content))
    return path


def put(name, value, which=slice(3)):
    """Return an edit of some points."""

    def edit(las):
        values = np.array(las[name])
        values[which] = value
        las[name] = values

    return edit


def repeat_places(las):
    las.X[50], las.Y[50], las.Z[50] = las.X[0], las.Y[0], las.Z[0]
    las.X[51], las.Y[51] = las.X[0], las.Y[0]  # another height, and not ground: it is right
    las.X[20], las.Y[20] = las.X[19], las.Y[19]


def break_strip(las):
    las.gps_time[20:] += 30.0


def spread_scale(las):
    las.header.scales = (0.01, 0.01, 0.003)


def at_the_limit(las):
    las.Y[:] = np.iinfo(np.int32).min


def add_text(las):
    las.header.vlrs.append(laspy.vlrs.known.WktCoordinateSystemVlr("PROJCS[...]"))


FAULTS = {
    "duplicate_points": (1, {"edit": repeat_places}),
    "ground_at_one_place": (1, {"edit": repeat_places}),
    "return_number_0": (3, {"edit": put("return_number", 0)}),
    "return_number_too_large": (3, {"edit": put("return_number", 5)}),
    "repeated_returns": (1, {"edit": put("return_number", 1, slice(1, 2))}),
    "gps_time_0": (3, {"edit": put("gps_time", 0.0)}),
    "gps_time_impossible": (COUNT, {"header": b"\x10", "at": 6}),
    "gps_time_gaps": (1, {"edit": break_strip}),
    "scan_angle_impossible": (3, {"edit": put("scan_angle", -31_000)}),
    "colours_of_8_bits": (COUNT, {"edit": put("red", 200, slice(None))}),
    "reserved_classes": (3, {"edit": put("classification", 30)}),
    "coordinate_limits": (COUNT, {"edit": at_the_limit}),
    "outside_box": (12, {"header": struct.pack("<d", 500_007.0), "at": 179}),
    "box_too_large": (1, {"header": struct.pack("<d", 500_012.0), "at": 179}),
    "header_counts": (1, {"header": struct.pack("<Q", 5), "at": 255}),
    "unusual_scale": (1, {"edit": spread_scale}),
    "no_crs": (1, {"point_format": 3}),
    "crs_record_unlike_header": (1, {"edit": add_text, "point_format": 3}),
}


@pytest.fixture
def right(tmp_path):
    return write(tmp_path / "right.las")


def test_what_is_right_passes_all_checks(right):
    found = bare_earth.info(right)
    assert set(found.checks.values()) == {0}
    assert any("18 of 18 passed" in line for line in found.lines())
    assert found.strips == {11: 30, 12: 30} and found.all_zero == [
        "scan_angle", "edge_of_flight_line", "green", "blue",
    ]  # fmt: skip


@pytest.mark.parametrize("name", FAULTS)
@pytest.mark.parametrize("suffix", [".las", ".laz"])
def test_what_is_wrong_is_counted(name, suffix, tmp_path):
    count, changed = FAULTS[name]
    path = write(tmp_path / f"wrong{suffix}", **changed)
    code, text, _ = said("info", path)
    assert code == 0 and f"{name}: {count} (" in text
    code, text, _ = said("info", path, "--json")
    assert json.loads(text)["checks"][name] == count


def test_large_files_are_compared_on_disk(right, tmp_path, monkeypatch):
    path = write(tmp_path / "wrong.las", repeat_places)
    expected = bare_earth.info(path).checks
    monkeypatch.setattr(info, "_MOST_IN_MEMORY", 10)
    monkeypatch.setattr(info, "_MOST_RECORDS", 7)
    monkeypatch.setattr("bare_earth.algorithms.survey.repeated_points._SORTED_TOGETHER", 8)
    assert bare_earth.info(path).checks == expected
    assert bare_earth.info(right).checks["duplicate_points"] == 0


def test_gps_times_have_range_order_and_gaps(tmp_path):
    def edit(las):
        las.gps_time[:30] += 100.0

    times = bare_earth.info(write(tmp_path / "a.laz", edit)).gps_time
    assert times.minimum == pytest.approx(HOUR + 1.5) and not times.in_order
    assert times.gaps == 1 and times.longest_gap == pytest.approx(97.1)


def test_points_without_times_are_not_checked_for_them(tmp_path):
    def edit(las):
        las.gps_time = np.zeros(COUNT)

    found = bare_earth.info(write(tmp_path / "zero.laz", edit))
    assert found.gps_time is None and "gps_time" in found.all_zero
    assert found.checks["gps_time_0"] == 0 and found.checks["gps_time_gaps"] is None


def test_many_files_are_described_and_compared(tmp_path):
    folder = tmp_path / "tiles"
    folder.mkdir()
    write(folder / "a.laz")
    write(folder / "b.laz", put("return_number", 0))
    write(folder / "c.las", point_format=3)
    (folder / "d.laz").write_bytes(b"no point cloud")
    found = bare_earth.info(folder)
    assert found.point_count == 3 * COUNT and found.overlapping == 3
    assert found.checks["return_number_0"] == 3 and found.checks["no_crs"] == 1
    assert found.differences["point_format"] == ["3", "7"]
    assert [*found.unreadable] == [str(folder / "d.laz")]
    code, text, _ = said("info", folder)
    assert code == 0 and "in all     return_number_0: 3 (" in text and "d.laz: " in text
    code, text, _ = said("info", folder / "a.laz", folder / "b.laz", "--json")
    assert code == 0 and [file["point_count"] for file in json.loads(text)["files"]] == [COUNT] * 2
