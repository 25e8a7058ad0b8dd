"""Contour lines: marching squares, their smoothing, and the files of the lines."""

import json

import numpy as np
import pytest
from runs import CancelAt, Heard
from surveys import ORIGIN, write_points

from bare_earth import BareEarthError, Cancelled, classify, contours
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.grids.isolines import Isolines
from bare_earth.algorithms.tools import contours as contours_module
from bare_earth.algorithms.tools import map_tool
from bare_earth.algorithms.tools.contours import INDEX, Contours
from bare_earth.algorithms.tools.running import run

rasterio = pytest.importorskip("rasterio")
EAST, NORTH = ORIGIN[:2]


def lines_of(heights, interval, *edges):
    """Return the lines of a raster that is given in strips which begin at some rows."""
    found, rows = Isolines(interval, heights.shape[1]), len(heights) - 1
    edges = [0, *edges, rows]
    return [
        line
        for first, last in zip(edges, edges[1:])
        for line in found.add(heights[first : last + 1], first, last == rows)
    ]


def plain(lines):
    """Return lines in a form that does not depend on where rings begin, nor on their order."""
    rows = []
    for line in lines:
        places = line.places
        if line.is_closed:
            places = places[:-1]
            places = np.roll(places, -np.lexsort(places.T)[0], axis=0)
        rows.append((line.level, places.tolist()))
    return sorted(rows)


def bumps(rows=90, columns=110, seed=1):
    from scipy.ndimage import gaussian_filter

    heights = gaussian_filter(np.random.default_rng(seed).normal(size=(rows, columns)), 3) * 20
    heights[30:40, 60:80] = np.nan
    return heights


def test_a_cone_has_rings_of_the_right_size():
    rows, columns = np.mgrid[:101.0, :101.0]
    cone = 50.0 - np.hypot(rows - 50, columns - 50)
    rings = {line.level: line for line in lines_of(cone, 5.0) if line.level > 0}
    assert sorted(rings) == list(range(1, 10))
    for level, ring in rings.items():
        assert ring.is_closed
        radius = np.hypot(*(ring.places - 50.0).T)
        assert np.abs(radius - (50.0 - 5.0 * level)).max() < 0.05
        x, y = ring.places[:, 1], -ring.places[:, 0]
        area = np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) / 2
        # Higher ground is on the left, so that rings round a top run counterclockwise.
        assert area == pytest.approx(np.pi * (50.0 - 5.0 * level) ** 2, rel=0.01)


def test_lines_are_those_of_a_library():
    contourpy = pytest.importorskip("contourpy")
    heights = bumps()
    generator = contourpy.contour_generator(
        z=np.ma.masked_invalid(heights), name="serial", corner_mask=False
    )
    found = lines_of(heights, 0.5)
    for level in range(-30, 31):
        expected = generator.lines(level * 0.5)
        mine = [line.places for line in found if line.level == level]
        assert len(mine) == len(expected)
        for some in (mine, expected):
            some[:] = [np.hypot(*np.diff(shape, axis=0).T).sum() for shape in some]
        assert sorted(mine) == pytest.approx(sorted(expected), abs=1e-9)
    assert len(found) > 300


@pytest.mark.rest(but="edges1")
@pytest.mark.parametrize("edges", [(1,), (45,), (30, 31, 32), (5, 40, 88), tuple(range(1, 89))])
def test_strips_make_no_difference(edges):
    heights = bumps()
    assert plain(lines_of(heights, 0.5, *edges)) == plain(lines_of(heights, 0.5))


def test_level_ground_at_a_height_of_a_line_has_lines_along_its_border_only():
    heights = np.zeros((10, 10))
    heights[3:6, 3:6] = 1.0
    (ring,) = lines_of(heights, 1.0)
    assert ring.is_closed and ring.level == 1
    assert not lines_of(np.full((5, 5), 3.0), 1.0)
    assert not lines_of(np.full((5, 5), np.nan), 1.0)


def raster(path, heights, epsg=25832, unit=None):
    """Write a raster with cells of half a metre."""
    rows, columns = heights.shape
    transform = rasterio.transform.from_origin(EAST, NORTH, 0.5, 0.5)
    profile = {"width": columns, "height": rows, "count": 1, "dtype": "float32"}
    with rasterio.open(
        path, "w", driver="GTiff", nodata=np.nan, crs=f"EPSG:{epsg}", transform=transform, **profile
    ) as file:
        file.write(heights.astype(np.float32), 1)
        file.units = (unit,)
    return path


def noisy_slope(size=300, noise=0.15, seed=4):
    rows, columns = np.mgrid[: float(size), : float(size)]
    slope = 100.0 + 0.04 * columns + 0.02 * rows
    return slope + np.random.default_rng(seed).normal(0, noise, slope.shape)


def read(path):
    content = json.loads(path.read_text(encoding="utf-8"))
    shapes = [np.array(feature["geometry"]["coordinates"]) for feature in content["features"]]
    return content, [feature["properties"] for feature in content["features"]], shapes


@pytest.mark.rest
def test_noise_makes_no_specks_and_lines_stay_where_they_are(tmp_path):
    noisy = noisy_slope()
    noisy[100:110, 100:110] = np.nan
    path, lines = raster(tmp_path / "dtm.tif", noisy), tmp_path / "lines.geojson"
    contours(path, lines, interval=1.0, contour_smoothing=0.0, contour_min_length=0.0)
    many = len(read(lines)[2])
    contours(path, lines, interval=1.0)
    _, values, shapes = read(lines)
    assert many > 1000 and len(shapes) < 30
    for value, shape in zip(values, shapes):
        column, row = (shape[:, 0] - EAST) / 0.5 - 0.5, (NORTH - shape[:, 1]) / 0.5 - 0.5
        expected = 100.0 + 0.04 * column + 0.02 * row
        assert np.abs(expected - value["ELEV"]).max() < 0.12
        assert value["INDEX"] == (round(value["ELEV"]) % INDEX == 0)


def test_small_rings_are_left_out_and_large_ones_stay(tmp_path):
    rows, columns = np.mgrid[:200.0, :200.0]
    heights = np.full((200, 200), 10.2)
    for row, column, radius in ((40, 40, 2), (40, 150, 8), (150, 100, 30)):
        heights += np.maximum(0.0, 1.0 - np.hypot(rows - row, columns - column) / radius)
    path, lines = raster(tmp_path / "dtm.tif", heights), tmp_path / "lines.geojson"
    lengths = {}
    for least in (0.0, 4.6, 18.0):
        contours(
            path, lines, interval=0.5, contour_smoothing=0, contour_min_length=least,
            contour_knolls=False,
        )  # fmt: skip
        lengths[least] = [np.hypot(*np.diff(shape, axis=0).T).sum() for shape in read(lines)[2]]
        assert min(lengths[least]) >= least
    assert [len(value) for value in lengths.values()] == [6, 4, 2]


# Row, column, height and standard deviation in cells: two knolls and two pits of 4 and 20 m².
FORMS = ((30, 30, -1.1, 1.9), (30, 90, 1.1, 1.9), (90, 30, -2.0, 4.3), (90, 90, 2.0, 4.3))


def knolls_and_pits(noise=0.03):
    rows, columns = np.mgrid[:120.0, :120.0]
    heights = 100.2 + 0.01 * columns
    for row, column, height, sigma in FORMS:
        away = np.hypot(rows - row, columns - column)
        heights += height * np.exp(-(away**2) / 2 / sigma**2)
    return heights + np.random.default_rng(6).normal(0.0, noise, heights.shape)


def marked(values, shapes):
    """Return whether there is a closed line round each form, and what these are marked as."""
    found = []
    for row, column, _, _ in FORMS:
        middle = EAST + 0.5 * (column + 0.5), NORTH - 0.5 * (row + 0.5)
        found.append(
            {
                value["DEPRESSION"]
                for value, shape in zip(values, shapes)
                if (shape[0] == shape[-1]).all() and (np.abs(shape - middle) < 6.0).all()
            }
        )
    return found


def test_small_knolls_and_pits_stay_and_depressions_are_marked(tmp_path):
    path, lines = raster(tmp_path / "dtm.tif", knolls_and_pits()), tmp_path / "lines.geojson"
    summary = contours(path, lines, interval=0.5)
    _, values, shapes = read(lines)
    assert marked(values, shapes) == [{1}, {0}, {1}, {0}]
    assert summary.line_count == len(values)
    is_open = [not (shape[0] == shape[-1]).all() for shape in shapes]
    assert any(is_open) and not any(
        value["DEPRESSION"] for value, opened in zip(values, is_open) if opened
    )
    # Nothing else is round and small.
    assert len(values) - sum(is_open) < 20
    contours(path, lines, interval=0.5, contour_knolls=False)
    assert marked(*read(lines)[1:])[1:] == [set(), {1}, {0}]


@pytest.mark.parametrize("turned", [(1, -1), (-1, 1), (-1, -1)])
def test_depressions_do_not_depend_on_how_rows_run(turned, tmp_path):
    heights = knolls_and_pits()
    path = raster(tmp_path / "dtm.tif", heights[:: turned[0], :: turned[1]])
    with rasterio.open(path, "r+") as file:
        file.transform = rasterio.Affine(
            0.5 * turned[1], 0.0, EAST + (60.0 if turned[1] < 0 else 0.0),
            0.0, -0.5 * turned[0], NORTH - (60.0 if turned[0] < 0 else 0.0),
        )  # fmt: skip
    lines = tmp_path / "lines.geojson"
    contours(path, lines, interval=0.5)
    _, values, shapes = read(lines)
    assert marked(values, shapes) == [{1}, {0}, {1}, {0}]
    for value, shape in zip(values, shapes):
        if (shape[0] == shape[-1]).all():  # higher ground is on the left
            x, y = (shape - shape[0]).T
            area = np.sum(x[:-1] * y[1:] - x[1:] * y[:-1])
            assert (area < 0) == bool(value["DEPRESSION"])


@pytest.mark.rest
def test_strips_make_no_difference_to_knolls(tmp_path, monkeypatch):
    path = raster(tmp_path / "dtm.tif", knolls_and_pits())
    contours(path, tmp_path / "one.geojson", interval=0.25)
    monkeypatch.setattr(contours_module, "_CELLS", 500)
    contours(path, tmp_path / "many.geojson", interval=0.25)
    one, many = (
        sorted(
            (value["ELEV"], value["DEPRESSION"], len(shape))
            for value, shape in zip(*read(tmp_path / f"{name}.geojson")[1:])
        )
        for name in ("one", "many")
    )
    assert one == many and len(one) > 10


def test_smoothing_moves_heights_by_a_quarter_of_the_interval_at_most(tmp_path):
    rows, columns = np.mgrid[:80.0, :120.0]
    # A bank 2 m wide and 1 m high, which smoothing over 6 m alone would nearly level.
    heights = 100.1 + np.where(np.abs(rows - 40) < 2, 1.0, 0.0) + 0.0 * columns
    path, lines = raster(tmp_path / "dtm.tif", heights), tmp_path / "lines.geojson"
    contours(path, lines, interval=0.5, contour_smoothing=6.0)
    assert {value["ELEV"] for value in read(lines)[1]} == {100.5}


def groups_of(path):
    """Return the polylines of a drawing: layer, flags, elevation and corners (x, y, z)."""
    words = [line.strip() for line in path.read_text(encoding="ascii").splitlines()]
    found, entity, groups = [], "", {}
    for code, value in [*zip(words[::2], words[1::2]), ("0", "")]:
        if code != "0":
            groups[code] = value
            continue
        place = tuple(float(groups.get(key, 0)) for key in ("10", "20", "30"))
        if entity == "POLYLINE":
            found.append((groups["8"], int(groups["70"]), place[2], []))
        elif entity == "VERTEX":
            found[-1][3].append(place)
        entity, groups = value, {}
    return found


def test_a_drawing_has_layers_heights_and_closed_lines(tmp_path):
    path = raster(tmp_path / "dtm.tif", knolls_and_pits())
    heard = Heard()
    contours(path, tmp_path / "lines.dxf", interval=0.5, progress=heard)
    contours(path, tmp_path / "lines.geojson", interval=0.5)
    assert any("EPSG:25832" in text for text in heard.infos)
    _, values, shapes = read(tmp_path / "lines.geojson")
    drawn = groups_of(tmp_path / "lines.dxf")
    assert len(drawn) == len(values) >= 10
    for (layer, flags, elevation, corners), value, shape in zip(drawn, values, shapes):
        name = "DEPRESSION" if value["DEPRESSION"] else "CONTOUR"
        assert layer == name + ("_INDEX" if value["INDEX"] else "")
        is_closed = bool((shape[0] == shape[-1]).all())
        assert flags == int(is_closed) and elevation == value["ELEV"]
        assert np.allclose(np.array(corners)[:, :2], shape[: len(shape) - is_closed], atol=6e-4)
        assert {corner[2] for corner in corners} == {value["ELEV"]}


def test_a_raster_without_heights_is_told(tmp_path):
    path, heard = raster(tmp_path / "dtm.tif", np.full((9, 9), np.nan)), Heard()
    assert contours(path, tmp_path / "lines.geojson", progress=heard).line_count == 0
    assert any("has no cell with a height" in text for text in heard.warnings)


@pytest.mark.rest(but=".fgb")
@pytest.mark.parametrize("suffix", [".gpkg", ".shp", ".fgb", ".geojson"])
def test_all_formats_hold_the_same_lines(tmp_path, suffix):
    pyogrio = pytest.importorskip("pyogrio")
    path = raster(tmp_path / "dtm.tif", bumps() + 100.0)
    target = tmp_path / f"lines{suffix}"
    for _ in range(2):  # also in the place of an old file
        contours(path, target, interval=1.0)
    contours(path, tmp_path / "expected.geojson", interval=1.0)
    _, values, shapes = read(tmp_path / "expected.geojson")
    about, _, found, fields = pyogrio.raw.read(str(target))
    assert about["crs"] == "EPSG:25832" and about["geometry_type"] == "LineString"
    found_values = sorted(zip(*(field.tolist() for field in fields)))
    assert found_values == sorted(tuple(value.values()) for value in values)
    assert len(found) == len(shapes) > 20


@pytest.mark.rest
def test_strips_of_a_raster_make_no_difference(tmp_path, monkeypatch):
    path = raster(tmp_path / "dtm.tif", bumps(120, 90))
    contours(path, tmp_path / "one.geojson")
    monkeypatch.setattr(contours_module, "_CELLS", 900)
    contours(path, tmp_path / "many.geojson")
    one, many = (
        sorted(
            (value["ELEV"], len(shape), shape.mean(axis=0).round(2).tolist())
            for value, shape in zip(*read(tmp_path / f"{name}.geojson")[1:])
        )
        for name in ("one", "many")
    )
    # The mean of a ring depends on the place at which it begins.
    assert [item[:2] for item in one] == [item[:2] for item in many] and len(one) > 10


def test_intervals_are_one_two_or_five(tmp_path):
    for span in np.geomspace(0.01, 9000.0, 300):
        interval = Contours().interval(100.0, 100.0 + span)
        assert f"{interval:e}"[0] in "125" and float(f"{interval:.0e}") == interval
        assert interval >= 0.2 and (interval == 0.2 or 8 <= span / interval <= 32)
    assert Contours().interval(100.0, 101.0, 0.3048) == 0.5  # feet


def test_the_unit_of_feet_is_told(tmp_path):
    path = raster(tmp_path / "dtm.tif", bumps() * 3, epsg=2264, unit="US survey foot")
    progress = Heard()
    interval = contours(path, tmp_path / "a.geojson", progress=progress)
    assert interval.unit == "US survey ft" and "US survey ft" in progress.infos[-1]


def test_the_commands_draw_the_same_lines(tmp_path):
    x, y = np.random.default_rng(2).uniform(0, 100, (2, 9000))
    write_points(tmp_path / "in.laz", x, y, 50 + 0.1 * x + 2 * np.sin(y / 9), 2)
    source, dtm = str(tmp_path / "in.laz"), str(tmp_path / "dtm.tif")
    words = ["--contour-interval", "0.5"]
    names = [str(tmp_path / f"{letter}.geojson") for letter in "abc"]
    assert main(["terrain", source, "--dtm", dtm, "--contours", names[0], *words]) == 0
    assert main(["contours", dtm, names[1], "--interval", "0.5", "--json"]) == 0
    assert main(["terrain", source, "--contours", names[2], *words]) == 0
    one, two, three = ((tmp_path / f"{letter}.geojson").read_bytes() for letter in "abc")
    assert one == two == three and one.count(b"LineString") > 20
    out = str(tmp_path / "out.laz")
    assert main(["classify", source, out, "--contours", names[0]]) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "a.geojson", "b.geojson", "c.geojson", "dtm.tif", "in.laz", "out.laz",
    ]  # fmt: skip


@pytest.mark.rest(but="False")
@pytest.mark.parametrize("many", [False, True])
def test_a_cancel_while_lines_are_drawn_leaves_no_raster(many, tmp_path):
    x, y = np.random.default_rng(1).uniform(0.0, 60.0, (2, 4000))
    (tmp_path / "in").mkdir()
    source = write_points(tmp_path / "in" / "a.las", x, y, 100.0 + x / 9.0)
    maps = {"dtm": tmp_path / "dtm.tif", "contours": tmp_path / "lines.geojson"}
    given = (source.parent, tmp_path / "out") if many else (source, tmp_path / "out.las")
    with pytest.raises(Cancelled):
        classify(*given, method="slope", progress=CancelAt(0.95), **maps)
    names = {path.name for path in tmp_path.iterdir()} - {"in"}
    assert names == ({"out"} if many else set())  # finished tiles stay


def test_points_that_nobody_asks_for_are_not_kept(tmp_path):
    x, y = np.random.default_rng(1).uniform(0.0, 60.0, (2, 4000))
    source = write_points(tmp_path / "a.las", x, y, 100.0 + x / 9.0)
    outputs = {"dtm": tmp_path / "dtm.tif"}
    done = run(map_tool("classify"), {"input": source}, outputs, [METHODS["slope"].parameters()])
    assert done.class_counts[2] > 3000
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.las", "dtm.tif"]


def test_what_cannot_be_drawn_is_one_sentence(tmp_path, capsys, monkeypatch):
    path = raster(tmp_path / "dtm.tif", bumps())
    lines = tmp_path / "lines.geojson"
    lines.write_text("old")
    for words, text in (
        ((str(path), str(tmp_path / "a.kml")), "are written as .gpkg"),
        ((str(tmp_path / "b.tif"), str(lines)), "does not exist"),
        ((str(path), str(tmp_path / "no" / "a.gpkg")), "does not exist"),
    ):
        assert main(["contours", *words]) == 1 and text in capsys.readouterr().err
    steep = raster(tmp_path / "steep.tif", bumps() * 100)
    with pytest.raises(BareEarthError, match="Choose a larger one"):
        contours(steep, lines, interval=0.001)
    assert lines.read_text() == "old"
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(BareEarthError, match="pip install pyogrio"):
        contours(path, tmp_path / "a.gpkg")
