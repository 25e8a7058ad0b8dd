"""Heights above ground, key points and terrain models, from files whose truth is known."""

import json
import os

import laspy
import numpy as np
import pytest
from matrices import covering
from runs import CancelAt
from surveys import cut, strip, write_points
from surveys import write as write_strip

import bare_earth
from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.grids.canopy import canopy_height
from bare_earth.algorithms.tools.rasters import rows

FEET_WKT = (
    'PROJCS["feet",GEOGCS["g",DATUM["d",SPHEROID["s",6378137,298.257]],PRIMEM["Greenwich",0],'
    'UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],'
    'PARAMETER["latitude_of_origin",0],PARAMETER["central_meridian",9],PARAMETER["scale_factor",1],'
    'PARAMETER["false_easting",0],PARAMETER["false_northing",0],UNIT["foot",0.3048]]'
)


def scene(path, point_format=6, version="1.4", wkt=None, offset=0.0, count=30):
    """Write a tilted plane with a flat roof 10 above its middle, and one point of noise."""
    x, y = (axis.ravel() * 1.0 for axis in np.meshgrid(np.arange(count), np.arange(count)))
    plane = 100 + 0.1 * x + 0.2 * y
    roof = (x >= 10) & (x < 20) & (y >= 10) & (y < 20)
    z = np.append(np.where(roof, 120.0, plane), 300.0) - offset
    write_points(
        path, np.append(x, 15.0), np.append(y, 15.0), z, np.append(np.where(roof, 6, 2), 7),
        offset=(500_000.0, 5_700_000.0, offset), point_format=point_format, version=version,
        wkt=wkt, intensity=np.arange(len(z)),
    )  # fmt: skip
    return np.append(plane, 100 + 1.5 + 3.0), np.append(roof, False)


LAYOUTS = [(0, "1.2"), (3, "1.2"), (5, "1.3"), (6, "1.4"), (8, "1.4"), (10, "1.4")]


@pytest.mark.parametrize(("layout", "suffix"), covering(LAYOUTS, [".las", ".laz", ".copc.laz"]))
def test_heights_as_an_extra_dimension(tmp_path, layout, suffix):
    source, target = tmp_path / "in.las", tmp_path / f"out{suffix}"
    plane, _ = scene(source, *layout)
    summary = bare_earth.heights(source, target)
    before, after = laspy.read(source), laspy.read(target)
    order = np.argsort(np.asarray(after.intensity))
    heights = np.asarray(after["HeightAboveGround"])[order]
    assert heights.dtype == np.float32
    assert np.allclose(heights, np.asarray(before.z) - plane, atol=1e-4)
    assert (summary.point_count, summary.ground_count) == (901, 800)
    assert summary.minimum == pytest.approx(heights.min(), abs=1e-5)
    assert summary.maximum == pytest.approx(195.5, abs=1e-5)
    dimension = after.point_format.dimension_by_name("HeightAboveGround")
    assert dimension.description == "Above ground, metre"
    for name in ("X", "Y", "Z", "classification", "intensity", "return_number"):
        assert np.array_equal(np.asarray(after[name])[order], before[name]), name


@pytest.mark.parametrize("layout", LAYOUTS)
def test_heights_as_z(tmp_path, layout):
    source, target = tmp_path / "in.las", tmp_path / "out.laz"
    plane, _ = scene(source, *layout, offset=50.0)
    summary = bare_earth.heights(source, target, output_as="z")
    before, after = laspy.read(source), laspy.read(target)
    assert np.allclose(after.z, np.asarray(before.z) - plane, atol=0.0006)
    assert np.array_equal(after.header.scales, before.header.scales)
    assert np.array_equal(after.header.offsets, before.header.offsets)
    assert after.header.mins[2] == pytest.approx(summary.minimum, abs=0.0006)
    assert after.header.maxs[2] == pytest.approx(summary.maximum, abs=0.0006)
    assert np.array_equal(after.header.mins[:2], before.header.mins[:2])
    for name in set(before.point_format.dimension_names) - {"Z"}:
        assert np.array_equal(after[name], before[name]), name


def with_fine_z(path, scale, offset):
    """Write the scene with another scale and offset of z, and the same heights."""
    scene(path)
    las = laspy.read(path)
    z = np.minimum(np.asarray(las.z), 125.0)
    las.header.scales = np.array([*las.header.scales[:2], scale])
    las.header.offsets = np.array([*las.header.offsets[:2], offset])
    las.points.scales, las.points.offsets = las.header.scales, las.header.offsets
    las.z = z
    las.write(path)
    return las


@pytest.mark.parametrize("ending", [".las", ".laz", ".copc.laz"])
def test_heights_that_do_not_fit_the_offset_of_z_get_another_and_the_scale_stays(tmp_path, ending):
    source, target, extra = (tmp_path / name for name in ("in.las", f"out{ending}", "extra.las"))
    before = with_fine_z(source, 2.5e-8, 75.0)
    assert -(2**31) * 2.5e-8 + 75.0 > 0.0  # the ground has height 0
    bare_earth.heights(source, extra)
    summary = bare_earth.heights(source, target, output_as="z")
    after, heights = laspy.read(target), np.asarray(laspy.read(extra)["HeightAboveGround"])
    assert np.array_equal(after.header.scales, before.header.scales)
    assert after.header.offsets.tolist() == [*before.header.offsets[:2], 0.0]
    assert after.header.mins[2] == pytest.approx(summary.minimum, abs=1e-6)
    assert after.header.maxs[2] == pytest.approx(summary.maximum, abs=1e-6)
    order = [np.lexsort((las.Y, las.X)) for las in (before, after)]
    for axis in "XY":
        assert np.array_equal(before[axis][order[0]], after[axis][order[1]])
    assert np.allclose(np.asarray(after.z)[order[1]], heights[order[0]], atol=1e-5)


def test_heights_that_fit_no_offset_are_told(tmp_path):
    source = tmp_path / "in.las"
    with_fine_z(source, 2.5e-8, 75.0)
    data = bytearray(source.read_bytes())
    data[147:155] = np.float64(1e-9).tobytes()  # integers reach no farther than 4.3 m
    source.write_bytes(data)
    las = laspy.read(source)
    las.points.array["Z"][np.asarray(las.classification) != 2] = 2**31 - 1
    las.points.array["Z"][np.asarray(las.classification) == 2] = -(2**31)
    las.write(source)
    with pytest.raises(BareEarthError, match="scale 1e-09 of z"):
        bare_earth.heights(source, tmp_path / "out.las", output_as="z")
    assert not (tmp_path / "out.las").exists()
    bare_earth.heights(source, tmp_path / "out.las")


def test_heights_are_in_the_vertical_unit(tmp_path):
    source, target = tmp_path / "in.las", tmp_path / "out.las"
    plane, _ = scene(source, wkt=FEET_WKT)
    summary = bare_earth.heights(source, target)
    after = laspy.read(target)
    assert summary.unit == "foot"
    assert np.allclose(after["HeightAboveGround"], np.asarray(after.z) - plane, atol=1e-4)
    dimension = after.point_format.dimension_by_name("HeightAboveGround")
    assert dimension.description == "Above ground, foot"


def test_a_second_run_replaces_the_dimension(tmp_path):
    one, two, three = (tmp_path / f"{name}.laz" for name in ("one", "two", "three"))
    scene(one)
    bare_earth.heights(one, two)
    bare_earth.heights(two, three, ground_classes=(6,))
    again = laspy.read(three)
    assert list(again.point_format.extra_dimension_names) == ["HeightAboveGround"]
    roof = np.asarray(again.classification) == 6
    assert np.allclose(again["HeightAboveGround"][roof], 0.0, atol=1e-5)
    bare_earth.heights(three, tmp_path / "four.laz")
    assert (tmp_path / "four.laz").read_bytes() == two.read_bytes()


@pytest.mark.parametrize("kind", ["f8", "u2"])
def test_a_dimension_of_another_type(tmp_path, kind):
    source, target = tmp_path / "in.las", tmp_path / "out.laz"
    plane, _ = scene(source)
    las = laspy.read(source)
    las.add_extra_dims(
        [laspy.ExtraBytesParams(name, kind) for name in ("first", "HeightAboveGround", "last")]
    )
    las.first[:], las.last[:] = np.arange(901), np.arange(901) + 5
    las.write(str(source))
    if kind == "u2":
        with pytest.raises(BareEarthError, match=r"HeightAboveGround.* float"):
            bare_earth.heights(source, target)
        assert not target.exists()
        return
    bare_earth.heights(source, target)
    after = laspy.read(target)
    assert np.allclose(after["HeightAboveGround"], np.asarray(after.z) - plane, atol=1e-4)
    assert np.array_equal(after["first"], np.arange(901))
    assert np.array_equal(after["last"], np.arange(901) + 5)


def test_outside_the_hull_the_nearest_ground_point_counts(tmp_path):
    source, target = tmp_path / "in.las", tmp_path / "out.las"
    scene(source)
    las = laspy.read(source)
    las.classification[np.asarray(las.x) > 500_020.5] = 1
    las.write(str(source))
    bare_earth.heights(source, target)
    after = laspy.read(target)
    east = (np.asarray(after.x) == 500_029) & (np.asarray(after.classification) == 1)
    # The plane rises by 0.1 a metre, and the last ground is 9 metres west of there.
    assert np.allclose(after["HeightAboveGround"][east], 0.9, atol=1e-4)


def test_a_single_ground_point_is_enough(tmp_path):
    source, target = tmp_path / "in.las", tmp_path / "out.las"
    scene(source)
    las = laspy.read(source)
    las.classification[1:] = 1
    las.write(str(source))
    bare_earth.heights(source, target)
    after = laspy.read(target)
    assert np.allclose(after["HeightAboveGround"], np.asarray(after.z) - 100, atol=1e-4)


def test_no_ground_is_told(tmp_path):
    scene(tmp_path / "in.las")
    source, out, ground = tmp_path / "in.las", tmp_path / "out.las", {"ground_classes": (9,)}
    with pytest.raises(BareEarthError, match=r"class 9\b.* classes 2, 6, 7"):
        bare_earth.heights(source, out, **ground)
    with pytest.raises(BareEarthError, match=r"Classify .*ground first"):
        bare_earth.key_points(source, out, **ground)
    with pytest.raises(BareEarthError, match=r"Classify .*ground first"):
        bare_earth.terrain(source, dtm=tmp_path / "a.tif", **ground)
    assert [path.name for path in tmp_path.iterdir()] == ["in.las"]


@pytest.mark.parametrize(("layout", "suffix"), covering(LAYOUTS, [".las", ".laz", ".copc.laz"]))
def test_key_points_get_a_class(tmp_path, layout, suffix):
    source, target = tmp_path / "in.las", tmp_path / f"out{suffix}"
    _, roof = scene(source, *layout)
    summary = bare_earth.key_points(source, target)
    before, after = laspy.read(source), laspy.read(target)
    classes = np.asarray(after.classification)[np.argsort(np.asarray(after.intensity))]
    keys = classes == 8
    assert summary.key_point_count == np.count_nonzero(keys) < 30
    assert (summary.point_count, summary.ground_count) == (901, 800)
    assert np.array_equal(classes[~keys], np.asarray(before.classification)[~keys])
    assert not keys[roof].any() and not keys[-1]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_key_points_get_a_flag(tmp_path, layout):
    source, target = tmp_path / "in.las", tmp_path / "out.laz"
    scene(source, *layout)
    las = laspy.read(source)
    las.key_point[:] = 1
    las.write(str(source))
    summary = bare_earth.key_points(source, target, mark_as="flag")
    before, after = laspy.read(source), laspy.read(target)
    assert np.array_equal(after.classification, before.classification)
    keys, ground = np.asarray(after.key_point) == 1, np.asarray(after.classification) == 2
    assert np.count_nonzero(keys & ground) == summary.key_point_count < 30
    assert keys[~ground].all()
    for name in set(before.point_format.dimension_names) - {"key_point"}:
        assert np.array_equal(after[name], before[name]), name


def test_key_points_once_more_are_the_same(tmp_path):
    one, two, three, four = (tmp_path / f"{number}.las" for number in range(4))
    scene(one)
    bare_earth.key_points(one, two)
    bare_earth.key_points(two, three)
    assert two.read_bytes() == three.read_bytes()
    bare_earth.key_points(two, four, grid_size=5.0)
    bare_earth.key_points(one, three, grid_size=5.0)
    assert four.read_bytes() == three.read_bytes() != two.read_bytes()


def test_key_points_of_nothing_but_key_points(tmp_path):
    one, two = tmp_path / "one.las", tmp_path / "two.las"
    scene(one)
    las = laspy.read(one)
    las.classification[las.classification == 2] = 8
    las.write(str(one))
    summary = bare_earth.key_points(one, two)
    assert summary.class_counts[8] == summary.key_point_count < 30
    assert summary.class_counts[2] == 800 - summary.key_point_count


def test_no_ground_class_is_told(tmp_path):
    scene(tmp_path / "in.las")
    with pytest.raises(BareEarthError, match="one ground class"):
        bare_earth.heights(tmp_path / "in.las", tmp_path / "out.las", ground_classes=())


def test_a_class_that_does_not_fit_is_told(tmp_path):
    scene(tmp_path / "in.las", 1, "1.2")
    with pytest.raises(BareEarthError, match="31, not 40"):
        bare_earth.key_points(tmp_path / "in.las", tmp_path / "out.las", key_class=40)


rasterio = pytest.importorskip("rasterio")


def all_files(folder):
    folder.mkdir(exist_ok=True)
    return {name: folder / f"{name}.tif" for name in ("dtm", "dsm", "chm", "hillshade")}


def read(path):
    with rasterio.open(path) as raster:
        values = raster.read(1).astype(float)
        return np.where(values == raster.nodata, np.nan, values), raster.transform


def test_terrain_surface_and_canopy(tmp_path):
    scene(tmp_path / "in.las")
    files = all_files(tmp_path / "out")
    summary = bare_earth.terrain(tmp_path / "in.las", **files)
    dtm, transform = read(files["dtm"])
    dsm, same = read(files["dsm"])
    chm, _ = read(files["chm"])
    shade, _ = read(files["hillshade"])
    assert transform == same and dtm.shape == dsm.shape == chm.shape == shade.shape
    assert (summary.ground_count, summary.surface_count) == (800, 900)
    assert (summary.rows, summary.columns) == dtm.shape
    rows, columns = np.nonzero(~np.isnan(dtm))
    x, y = transform.c + columns + 0.5, transform.f - rows - 0.5
    plane = 100 + 0.1 * (x - 500_000) + 0.2 * (y - 5_700_000)
    assert np.allclose(dtm[rows, columns], plane, atol=1e-3)
    roof = (abs(x - 500_015) < 4) & (abs(y - 5_700_015) < 4)
    assert np.allclose(dsm[rows, columns][roof], 120.0)
    assert np.nanmax(dsm) == 120.0  # the noise above is left out
    # Points lie in the southwestern corners of cells; each is measured above the ground under it.
    assert np.allclose(chm[rows, columns][roof], 120.0 - plane[roof] + 0.15, atol=1e-3)
    assert 0.0 <= np.nanmin(chm) < 0.2
    assert np.array_equal(np.isnan(chm), np.isnan(dsm) | np.isnan(dtm))
    assert np.array_equal(np.isnan(shade), np.isnan(dtm))


def test_a_canopy_is_never_negative():
    terrain = np.array([1.0, 5.0, np.nan, 2.0])
    height = canopy_height(np.array([4.0, 4.5, 3.0, np.nan]), terrain)
    assert np.array_equal(height, [3.0, 0.0, np.nan, np.nan], equal_nan=True)


@pytest.mark.rest(but="dsm")
@pytest.mark.parametrize("name", ["dtm", "dsm", "chm", "hillshade"])
def test_each_raster_alone_is_the_same(tmp_path, name):
    scene(tmp_path / "in.las")
    files = all_files(tmp_path / "out")
    bare_earth.terrain(tmp_path / "in.las", **files)
    alone = tmp_path / "alone.tif"
    bare_earth.terrain(tmp_path / "in.las", **{name: alone})
    one, other = read(alone), read(files[name])
    assert np.array_equal(one[0], other[0], equal_nan=True) and one[1] == other[1]


@pytest.mark.rest
def test_gaps_are_filled_up_to_the_maximum_edge(tmp_path):
    scene(tmp_path / "in.las")
    las = laspy.read(tmp_path / "in.las")
    las = las[np.asarray(las.classification) == 2]
    las.write(str(tmp_path / "hole.las"))
    files = all_files(tmp_path / "out")
    bare_earth.terrain(tmp_path / "hole.las", **files)
    dtm, dsm = read(files["dtm"])[0], read(files["dsm"])[0]
    assert not np.isnan(dtm[5:25, 5:25]).any() and not np.isnan(dsm[5:25, 5:25]).any()
    bare_earth.terrain(tmp_path / "hole.las", **files, max_edge=3.0)
    dtm, dsm = read(files["dtm"])[0], read(files["dsm"])[0]
    assert np.isnan(dtm[12:18, 12:18]).all() and np.isnan(dsm[12:18, 12:18]).all()
    assert not np.isnan(dtm[1:8, 1:28]).any()


@pytest.mark.rest
def test_the_surface_of_first_or_of_all_returns(tmp_path):
    scene(tmp_path / "in.las")
    las = laspy.read(tmp_path / "in.las")
    las.number_of_returns[:] = 2
    las.return_number[np.asarray(las.classification) == 6] = 2
    las.write(str(tmp_path / "in.las"))
    files = {"dsm": tmp_path / "dsm.tif"}
    bare_earth.terrain(tmp_path / "in.las", **files)
    assert np.nanmax(read(files["dsm"])[0]) < 110
    bare_earth.terrain(tmp_path / "in.las", **files, surface_returns="all")
    assert np.nanmax(read(files["dsm"])[0]) == 120
    las.return_number[:] = 2
    las.write(str(tmp_path / "in.las"))
    with pytest.raises(BareEarthError, match="Take all returns"):
        bare_earth.terrain(tmp_path / "in.las", **files)


def test_rasters_are_in_the_units_of_the_crs(tmp_path):
    scene(tmp_path / "in.las", wkt=FEET_WKT)
    files = all_files(tmp_path / "out")
    bare_earth.terrain(tmp_path / "in.las", **files, dtm_cell_size=0.6096)
    chm, transform = read(files["chm"])
    with (
        rasterio.open(files["dtm"]) as dtm,
        rasterio.open(files["hillshade"]) as shade,
    ):
        assert dtm.descriptions == ("Height, ft",)
        assert shade.descriptions == ("Brightness, 1 to 255",)
    assert transform.a == pytest.approx(2.0)
    assert np.nanmax(chm) == pytest.approx(120 - 103, abs=0.5)


@pytest.mark.rest
def test_all_rasters_or_none(tmp_path, monkeypatch):
    scene(tmp_path / "in.las")

    def fail(*_):
        raise BareEarthError("the disk is full")

    monkeypatch.setattr(rows, "hillshade", fail)
    files = all_files(tmp_path / "out")
    with pytest.raises(BareEarthError, match="the disk is full"):
        bare_earth.terrain(tmp_path / "in.las", **files)
    assert list((tmp_path / "out").iterdir()) == []


@pytest.mark.parametrize(
    "files, text",
    [
        ({}, "at least one raster"),
        ({"dtm": "a.tif", "dsm": "a.tif"}, "the same file"),
        ({"chm": "a.png"}, r"a\.png: .*\.tif"),
        ({"dsm": "none/a.tif"}, "does not exist"),
    ],
)
def test_rasters_that_cannot_be_made(tmp_path, files, text):
    scene(tmp_path / "in.las")
    files = {name: tmp_path / path for name, path in files.items()}
    with pytest.raises(BareEarthError, match=text):
        bare_earth.terrain(tmp_path / "in.las", **files)


@pytest.mark.rest(but="0.0")
@pytest.mark.parametrize("fraction", [0.0, 0.3, 0.6, 0.8, 0.95, 1.0])
def test_a_cancel_leaves_nothing(tmp_path, fraction):
    scene(tmp_path / "in.las")
    progress = CancelAt(fraction)
    files, out = all_files(tmp_path / "out"), tmp_path / "out" / "out.laz"
    for run in (
        lambda: bare_earth.heights(tmp_path / "in.las", out, progress=progress),
        lambda: bare_earth.key_points(tmp_path / "in.las", out, progress=progress),
        lambda: bare_earth.terrain(tmp_path / "in.las", **files, progress=progress),
    ):
        with pytest.raises(Cancelled):
            run()
        assert list((tmp_path / "out").iterdir()) == []


def test_the_input_is_not_overwritten(tmp_path):
    source = tmp_path / "in.las"
    scene(source)
    for run in (bare_earth.heights, bare_earth.key_points):
        with pytest.raises(BareEarthError, match="same file"):
            run(source, source)


def test_the_commands(tmp_path, capsys):
    source = tmp_path / "in.las"
    scene(source)
    out = [str(tmp_path / name) for name in ("h.laz", "z.laz", "k.laz", "d.tif", "c.tif")]
    assert main(["height", str(source), out[0], "--json"]) == 0
    summary = json.loads(capsys.readouterr().out)
    assert (summary["point_count"], summary["unit"]) == (901, "metre")
    assert main(["height", str(source), out[1], "--output-as", "z"]) == 0
    assert laspy.read(tmp_path / "z.laz").Z.max() == 195_500
    assert main(["key-points", str(source), out[2], "--grid-size", "5", "--json"]) == 0
    count = json.loads(capsys.readouterr().out)["key_point_count"]
    assert np.count_nonzero(laspy.read(tmp_path / "k.laz").classification == 8) == count
    words = ["--dtm", out[3], "--chm", out[4], "--dtm-cell-size", "2", "--max-edge", "none"]
    assert main(["terrain", str(source), *words, "--ground-classes", "2", "9", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["columns"] == 15
    assert main(["terrain", str(source)]) == 1
    assert "at least one raster" in capsys.readouterr().err
    assert main(["key-points", str(source), out[2], "--tolerance-above", "-1"]) == 2
    assert "Tolerance above" in capsys.readouterr().err


@pytest.mark.rest
@pytest.mark.parametrize("as_z", [False, True])
def test_heights_of_many_files_are_those_of_one(tmp_path, as_z):
    points = strip(6000, 240.0, 120.0)
    ground = np.where(points[:, 2] % 10, 2, 1)
    write_strip(tmp_path / "one.laz", points, classes=ground)
    cut(tmp_path / "many", points, 8)
    for path in (tmp_path / "many").iterdir():
        las = laspy.read(path)
        las.classification[:] = np.where(np.round(np.asarray(las.z) * 100) % 10, 2, 1)
        las.write(str(path))
    words = ["--output-as", "z"] if as_z else []
    assert main(["height", str(tmp_path / "one.laz"), str(tmp_path / "h.laz"), *words]) == 0
    assert main(["height", str(tmp_path / "many"), str(tmp_path / "out"), *words]) == 0
    names = sorted(os.listdir(tmp_path / "out"))
    assert names == [".bare-earth", *(f"{n}.laz" for n in range(8)), "heights.vpc"]

    def heights(paths):
        rows = []
        for path in paths:
            las = laspy.read(path)
            rows.append(np.column_stack((las.x, las.y, las.z if as_z else las.HeightAboveGround)))
        rows = np.round(np.concatenate(rows), 4)
        return rows[np.lexsort(rows.T)]

    many = heights(sorted((tmp_path / "out").glob("*.laz")))
    one = heights([tmp_path / "h.laz"])
    assert np.allclose(one, many, atol=0.011 if as_z else 1e-4)
    assert np.ptp(one[:, 2]) > 5.0


def test_two_inputs_of_one_name_are_refused(tmp_path, capsys):
    for name in ("a", "b"):
        (tmp_path / name).mkdir()
        scene(tmp_path / name / "in.las")
    words = ["height", *(str(tmp_path / name) for name in ("a", "b")), str(tmp_path / "out")]
    assert main(words) == 1
    assert "would both become" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_heights_do_not_go_into_the_folder_of_the_inputs(tmp_path, capsys):
    (tmp_path / "in").mkdir()
    scene(tmp_path / "in" / "in.las")
    assert main(["height", str(tmp_path / "in"), str(tmp_path / "in")]) == 1
    assert "in the same folder" in capsys.readouterr().err
    assert os.listdir(tmp_path / "in") == ["in.las"]
