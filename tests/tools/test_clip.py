"""Clips of point clouds: the points of an area, with all bytes that files have of them."""

import json

import laspy
import numpy as np
import pytest
from las_files import EVERY, OFFSET, SCALE, LasKit
from matrices import covering
from runs import said
from surveys import ORIGIN, cut, strip, write_points

import bare_earth
from bare_earth import BareEarthError

EAST, NORTH = ORIGIN[:2]
# Of the made files: columns of points every metre, from 10 m west of the offset on.
WEST = (OFFSET[0] - 8.5, OFFSET[1] - 1.0, OFFSET[0] - 5.0, OFFSET[1] + 99.0)


@pytest.mark.parametrize(("layout", "suffix"), covering(EVERY, [".las", ".laz"]))
def test_bytes_and_order_of_points_stay_and_the_header_tells_of_them(layout, suffix, tmp_path):
    version, point_format = layout
    las = LasKit(tmp_path)
    more = {"evlrs": [las.evlr(b"theirs", 7, b"more")]} if version == 4 else {}
    source = las.make(
        f"in{suffix}", version=version, point_format=point_format, extra=3,
        vlrs=[las.vlr(b"theirs", 5, b"record")], **more,
    )  # fmt: skip
    summary = bare_earth.clip(source, tmp_path / f"out{suffix}", extent=WEST)
    before, after = las.split(source), las.split(tmp_path / f"out{suffix}")
    places = before.records[:, :12].copy().view("<i4") * SCALE + OFFSET
    inside = (places[:, 0] >= WEST[0]) & (places[:, 0] <= WEST[2])
    assert 10 < inside.sum() < 40 and summary.point_count == inside.sum()
    assert summary.input_count == len(inside)
    assert np.array_equal(after.records, before.records[inside])
    kept = [[vlr for vlr in parts.vlrs if b"laszip" not in vlr] for parts in (before, after)]
    assert kept[0] == kept[1] and len(after.vlrs) == len(before.vlrs)
    assert after.tail == before.tail
    assert after.header[:96] == before.header[:96]  # ids, versions, names and the date
    found = laspy.read(tmp_path / f"out{suffix}")
    assert found.header.point_count == inside.sum()
    assert np.allclose(found.header.mins, places[inside].min(axis=0))
    assert np.allclose(found.header.maxs, places[inside].max(axis=0))
    returns = np.bincount(found.return_number, minlength=16)[1:]
    assert np.array_equal(found.header.number_of_points_by_return[:5], returns[:5])


def cloud(path, **more):
    x, y = np.random.default_rng(3).uniform(0.0, 100.0, (2, 6000))
    classes = np.random.default_rng(4).integers(1, 7, len(x))
    return write_points(path, x, y, 50.0 + 0.1 * x, classes, crs="EPSG:25832", **more)


def test_polygons_with_holes_in_another_crs_and_a_rectangle(tmp_path):
    pyproj = pytest.importorskip("pyproj")
    source = cloud(tmp_path / "in.laz")
    outer = [(10, 10), (90, 10), (90, 90), (10, 90), (10, 10)]
    hole = [(30, 30), (70, 30), (70, 70), (30, 70), (30, 30)]
    turn = pyproj.Transformer.from_crs(25832, 4326, always_xy=True)
    rings = [[turn.transform(EAST + x, NORTH + y) for x, y in ring] for ring in (outer, hole)]
    polygon = {"type": "Polygon", "coordinates": rings}
    (tmp_path / "area.geojson").write_text(json.dumps(polygon), encoding="utf-8")
    extent = EAST, NORTH, EAST + 60.0, NORTH + 100.0
    bare_earth.clip(source, tmp_path / "out.laz", boundary=tmp_path / "area.geojson", extent=extent)
    before, after = laspy.read(source), laspy.read(tmp_path / "out.laz")
    x, y = np.asarray(before.x) - EAST, np.asarray(before.y) - NORTH
    inside = (x > 10) & (x < 60) & (y > 10) & (y < 90)
    inside &= ~((x > 30) & (x < 70) & (y > 30) & (y < 70))
    assert np.array_equal(after.points.array, before.points.array[inside])


def test_an_octree_holds_the_same_points(tmp_path):
    source = cloud(tmp_path / "in.laz")
    extent = EAST + 20.0, NORTH + 20.0, EAST + 50.0, NORTH + 50.0
    bare_earth.clip(source, tmp_path / "part.copc.laz", extent=extent)
    bare_earth.clip(source, tmp_path / "part.las", extent=extent)
    bare_earth.clip(tmp_path / "part.copc.laz", tmp_path / "again.copc.laz", extent=extent)
    rows = []
    for name in ("part.las", "part.copc.laz", "again.copc.laz"):
        las = laspy.read(tmp_path / name)
        values = np.column_stack((las.X, las.Y, las.Z, las.classification))
        rows.append(values[np.lexsort(values.T)])
    assert len(rows[0]) > 400
    assert np.array_equal(rows[0], rows[1]) and np.array_equal(rows[0], rows[2])


def test_many_files_become_those_that_have_points_there(tmp_path):
    (tmp_path / "in").mkdir()
    cut(tmp_path / "in", strip())
    extent = [EAST + 40.0, NORTH + 20.0, EAST + 190.0, NORTH + 60.0]
    code, told, errors = said(
        "clip", tmp_path / "in", tmp_path / "out", "--extent", *extent, "--json", "--verbose"
    )
    assert code == 0, errors
    whole, parts = {}, {}
    for folder, found in ((tmp_path / "in", whole), (tmp_path / "out", parts)):
        for path in sorted(folder.glob("*.la[sz]")):
            las = laspy.read(path)
            x, y = np.asarray(las.x), np.asarray(las.y)
            inside = (x >= extent[0]) & (x <= extent[2]) & (y >= extent[1]) & (y <= extent[3])
            if inside.any():
                found[path.name] = las.points.array[inside]
            assert folder.name == "in" or inside.all()
    assert whole.keys() == parts.keys() and len(parts) > 1
    assert all(np.array_equal(parts[name], whole[name]) for name in whole)
    assert f"{6 - len(parts)} files are not written" in errors
    assert (tmp_path / "out" / "clipped.vpc").is_file()
    assert sum(map(len, parts.values())) == json.loads(told)["point_count"]


@pytest.mark.parametrize("many", [False, True])
def test_what_cannot_be_clipped_is_one_sentence_and_no_file(many, tmp_path):
    (tmp_path / "in").mkdir()
    source = cloud(tmp_path / "in" / "a.laz")
    source, target = (source.parent, tmp_path / "out") if many else (source, tmp_path / "out.laz")
    with pytest.raises(BareEarthError, match="extent or a boundary"):
        bare_earth.clip(source, target)
    with pytest.raises(BareEarthError, match="area in the CRS"):
        bare_earth.clip(source, target, extent=(0.0, 0.0, 10.0, 10.0))
    # Inside of the extent of the points, between these.
    speck = EAST + 50.0, NORTH + 50.0, EAST + 50.0001, NORTH + 50.0001
    with pytest.raises(BareEarthError, match="in the area"):
        bare_earth.clip(source, target, extent=speck)
    assert not list(tmp_path.glob("out*/*.laz")) and not (tmp_path / "out.laz").exists()
