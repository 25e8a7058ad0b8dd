import json
from pathlib import Path

import numpy as np
import pytest
from runs import Heard

from bare_earth import BareEarthError
from bare_earth.algorithms.crs.system import Crs
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.survey import area as area_module
from bare_earth.algorithms.survey.area import Area
from bare_earth.algorithms.survey.shapes import Place
from bare_earth.algorithms.survey.vector_files import read_boundary

SQUARE = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)]
HOLE = [(4, 4), (4, 6), (6, 6), (6, 4), (4, 4)]


def ring(corners, east=0.0, north=0.0):
    return np.array(corners, float) + np.array([east, north])


def places(count=20_000, low=-2.0, high=12.0, seed=1):
    return np.random.default_rng(seed).uniform(low, high, (2, count))


def star(corners=41, radius=9.0, seed=3):
    """Return a ring that crosses itself nowhere, with as many spikes as corners."""
    angle = np.linspace(0.0, 2.0 * np.pi, corners, endpoint=False)
    length = radius * np.random.default_rng(seed).uniform(0.2, 1.0, corners)
    return np.column_stack((length * np.cos(angle), length * np.sin(angle)))


def by_path(rings, x, y):
    path = pytest.importorskip("matplotlib.path")
    odd = np.zeros(len(x), bool)
    for corners in rings:
        odd ^= path.Path(corners).contains_points(np.column_stack((x, y)))
    return odd


def test_a_rectangle_holds_its_border():
    x, y = np.array([0, 10, 10.001, 5, 5]), np.array([0, 5, 5, 5, -0.001])
    assert Area((0, 0, 10, 5)).contains(x, y).tolist() == [True, True, False, True, False]


@pytest.mark.parametrize("direction", [1, -1])
def test_a_polygon_with_a_hole(direction):
    x, y = places()
    rings = (ring(SQUARE)[::direction], ring(HOLE))
    expected = (x > 0) & (x < 10) & (y > 0) & (y < 10) & ~(
        (x > 4) & (x < 6) & (y > 4) & (y < 6)
    )  # fmt: skip
    assert np.array_equal(Area(polygons=(rings,)).contains(x, y), expected)


def test_rings_need_not_be_closed():
    x, y = places()
    closed, opened = (Area(polygons=((ring(value),),)) for value in (SQUARE, SQUARE[:-1]))
    assert np.array_equal(closed.contains(x, y), opened.contains(x, y))


@pytest.mark.parametrize("seed", range(5))
def test_any_polygon_against_another_implementation(seed, monkeypatch):
    monkeypatch.setattr(area_module, "_POINTS_A_STEP", 1000)
    x, y = places(5000, -10.0, 10.0, seed)
    rings = (star(60, 9.5, seed), star(12, 4.0, seed + 50))
    assert np.array_equal(Area(polygons=(rings,)).contains(x, y), by_path(rings, x, y))


def test_a_ring_that_crosses_itself_goes_by_even_and_odd():
    bow_tie = ring([(0, 0), (10, 10), (10, 0), (0, 10)])
    x, y = np.array([1.0, 5.0, 9.0, 5.0]), np.array([5.0, 1.0, 5.0, 9.0])
    assert Area(polygons=((bow_tie,),)).contains(x, y).tolist() == [True, False, True, False]


def test_polygons_that_overlap_hold_what_they_share():
    area = Area(polygons=((ring(SQUARE),), (ring(SQUARE, 5, 5),)))
    x, y = np.array([2.0, 7.0, 13.0, 2.0]), np.array([2.0, 7.0, 13.0, 13.0])
    assert area.contains(x, y).tolist() == [True, True, True, False]
    assert area.bounds == (0, 0, 15, 15)


def test_each_place_on_a_shared_border_belongs_to_one_polygon():
    # A fan of triangles; many places lie on its spokes and corners exactly.
    outside = ring([(8, 0), (6, 6), (0, 8), (-6, 6), (-8, 0), (-6, -6), (0, -8), (6, -6)])
    fan = [np.array([(0, 0), a, b]) for a, b in zip(outside, np.roll(outside, -1, axis=0))]
    x, y = (axis.ravel().astype(float) for axis in np.mgrid[-5:6, -5:6])
    held = np.sum([Area(polygons=((corners,),)).contains(x, y) for corners in fan], axis=0)
    assert (held == 1).all()


def test_a_rectangle_and_polygons_hold_what_is_in_both():
    area = Area((5, -5, 20, 5), ((ring(SQUARE),),))
    x, y = places()
    assert np.array_equal(area.contains(x, y), (x >= 5) & (x < 10) & (y >= 0) & (y <= 5))
    assert area.bounds == (5, 0, 10, 5)
    assert area.buffered_box(2.5) == (2.5, -2.5, 12.5, 7.5)
    assert not Area((50, 50, 60, 60), ((ring(SQUARE),),)).contains(x, y).any()


def test_the_order_of_places_does_not_matter():
    area = Area(polygons=((star(),),))
    x, y = places(3000, -10, 10)
    mixed = np.random.default_rng(2).permutation(len(x))
    assert np.array_equal(area.contains(x[mixed], y[mixed]), area.contains(x, y)[mixed])


def test_places_of_no_number():
    assert Area(polygons=((ring(SQUARE),),)).contains(np.empty(0), np.empty(0)).shape == (0,)


def test_points_of_a_cloud_lie_where_scale_and_offset_say(monkeypatch):
    monkeypatch.setattr(area_module, "_POINTS_A_STEP", 3)
    x = np.arange(8, dtype=np.int32) * 100
    cloud = PointCloud(
        Path("in.las"), x, x, x, (0.01, 0.02, 1.0), (500.0, 700.0, 0.0), *[x.astype(np.uint8)] * 3,
        np.zeros(8, bool), 6, Crs(),
    )  # fmt: skip
    inside = Area((502.0, 700.0, 510.0, 710.0)).of(cloud)
    assert np.flatnonzero(inside).tolist() == [2, 3, 4, 5]


@pytest.mark.parametrize(
    ("box", "polygons", "word"),
    [
        ((0, 0, 0, 1), (), "XMIN below XMAX"),
        ((0, 2, 1, 1), (), "XMIN .* YMAX, not 0 2 1 1"),
        ((0, 0, float("nan"), 1), (), "XMIN YMIN XMAX YMAX"),
        (None, (), "holds no polygon"),
        (None, ((),), "holds no polygon"),
        (None, ((ring([(0, 0), (1, 0), (1, float("inf"))]),),), "not a finite number"),
    ],
)
def test_what_is_no_area_is_refused(box, polygons, word):
    with pytest.raises(BareEarthError, match=word):
        Area(box, polygons)


def geojson(kind, **members):
    return json.dumps({"type": kind, **members})


POLYGON = {"type": "Polygon", "coordinates": [SQUARE, HOLE]}
MULTI = {"type": "MultiPolygon", "coordinates": [[SQUARE, HOLE], [[[20, 0, 5], [30, 0], [25, 9]]]]}
TWO_FEATURES = {
    "type": "FeatureCollection",
    "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::25832"}},
    "features": [
        {"type": "Feature", "properties": {}, "geometry": MULTI},
        {"type": "Feature", "properties": None, "geometry": None},
        {"type": "Feature", "geometry": {"type": "Point", "coordinates": [1, 2]}},
    ],
}


@pytest.mark.parametrize(
    ("name", "text", "expected"),
    [
        ("a.geojson", json.dumps(POLYGON), [2]),
        ("a.json", json.dumps(MULTI), [2, 1]),
        ("a.GEOJSON", json.dumps(TWO_FEATURES), [2, 1]),
        ("a.geojson", geojson("Feature", geometry=POLYGON), [2]),
        ("a.geojson", geojson("GeometryCollection", geometries=[POLYGON]), [2]),
        ("a.geojson", "\ufeff" + json.dumps(POLYGON), [2]),
    ],
)  # fmt: skip
def test_boundaries_are_read(name, text, expected, tmp_path):
    path = tmp_path / name
    path.write_text(text, encoding="utf-8")
    polygons = read_boundary(path)
    assert [len(polygon) for polygon in polygons] == expected
    x, y = np.array([1.0, 5.0, 11.0]), np.array([1.0, 5.0, 5.0])
    with_hole = expected[0] == 2
    assert Area(polygons=polygons).contains(x, y).tolist() == [True, not with_hole, False]


@pytest.mark.parametrize(
    ("name", "text", "word"),
    [
        ("a.shp", "", "Cannot read"),
        ("a.gpkg", "", "Cannot read"),
        ("a.gml", "<gml/>", "is XML"),
        ("a.geojson", '{"type": "Polygon", "crs": {"type": "link"}}', "Cannot read"),
        ("a.geojson", "", "Cannot read"),
        ("a.geojson", "{", "Cannot read"),
        ("a.geojson", "[]", "Cannot read"),
        ("a.geojson", "[" * 100_000, "Cannot read"),
        ("a.geojson", '{"features": []}', "Cannot read"),
        ("a.geojson", geojson("Polygon", coordinates=[[[1], [2]]]), "Cannot read"),
        ("a.geojson", geojson("Polygon", coordinates=[[["a", 1]]]), "Cannot read"),
        ("a.geojson", geojson("Polygon", coordinates=3), "Cannot read"),
        ("a.geojson", geojson("FeatureCollection", features=[]), "holds no polygon"),
        ("a.geojson", geojson("Polygon", coordinates=[]), "holds no polygon"),
        ("a.wkt", "POLYGON ((0 0, 1 0, 1 1))", "is WKT"),
        ("b.geojson", None, "b.geojson does not exist"),
    ],
)
def test_what_cannot_be_read_gives_one_sentence(name, text, word, tmp_path):
    path = tmp_path / name
    if text is not None:
        path.write_text(text, encoding="utf-8")
    with pytest.raises(BareEarthError, match=word) as caught:
        read_boundary(path)
    assert "\n" not in str(caught.value) and name in str(caught.value)


def test_a_boundary_that_is_no_text(tmp_path):
    path = tmp_path / "a.geojson"
    path.write_bytes(bytes(range(128, 256)))
    with pytest.raises(BareEarthError, match="Cannot read"):
        read_boundary(path)


TWICE = [(0, 0), (60, 0), (60, 40), (20, 40), (20, -20), (40, -20), (40, 60), (0, 60)]
BOW_TIE = [(0, 0), (40, 40), (40, 0), (0, 40), (0, 0)]
PLAIN = [(0, 0), (40, 0), (40, 40), (20, 10), (0, 40), (0, 0)]


@pytest.mark.parametrize(
    ("ring", "is_told"),
    [(TWICE, True), (TWICE[::-1], True), (PLAIN[:-1] * 2, True), (BOW_TIE, False), (PLAIN, False)],
)
def test_a_ring_that_overlaps_itself_is_told_and_a_bow_tie_is_not(ring, is_told):
    heard, area = Heard(), Area(None, ((np.array(ring, dtype=np.float64) + 500_000.0,),))
    area.located(Place("points", Crs(epsg=25832)), heard)
    assert any("overlaps itself" in text for text in heard.warnings) == is_told
    if ring is TWICE:
        told = float(heard.warnings[0].partition("about ")[2].split()[0])
        assert told == pytest.approx(800, rel=0.05)
