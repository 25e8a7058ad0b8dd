"""Pictures of the relief: sky view, openness, local dominance, slope, and those made of several."""

import importlib.util
import shutil
import subprocess
import warnings

import laspy
import numpy as np
import pytest
from matrices import quick
from surveys import write_points

import bare_earth
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.grids import outline
from bare_earth.algorithms.relief import horizons
from bare_earth.algorithms.relief.hillshade import hillshade, slope
from bare_earth.algorithms.relief.horizons import (
    local_dominance,
    openness,
    sky_view,
    sky_view_and_openness,
)
from bare_earth.algorithms.relief.local_relief import multi_scale_relief
from bare_earth.algorithms.relief.pictures import archaeological_topography, red_relief
from bare_earth.algorithms.tools import relief as relief_module
from bare_earth.algorithms.tools.relief import KINDS

RELIEF = [*KINDS.values()]
METRES = 1.0, 1.0
MIDDLE = 30, 30


def level(size=61):
    return np.full((size, size), 200.0)


def plane(east, size=61, cell=1.0):
    return 200.0 + np.tile(np.arange(size) * cell * east, (size, 1))


def trench(depth=1.0, width=2):
    """Return level land with a trench from north to south through the middle."""
    heights = level()
    heights[:, 30 - width // 2 : 31 + width // 2] -= depth
    return heights


def rough(seed=1, shape=(90, 100)):
    """Return smooth hills on a slope."""
    from scipy.ndimage import gaussian_filter

    noise = np.random.default_rng(seed).normal(0, 20, shape)
    return gaussian_filter(noise, 3) + 0.2 * np.arange(shape[1]) + 300.0


def test_level_land_sees_the_whole_sky():
    assert np.all(sky_view(level(), METRES, 10.0) == 1.0)
    for heights in (level(), -level()):
        assert openness(heights, METRES, 10.0) == pytest.approx(90.0)
    assert local_dominance(level(), METRES, 10.0) == pytest.approx(1.0, abs=1e-5)
    assert np.all(slope(level(), METRES) == 0.0)


def test_the_foot_of_a_straight_wall_sees_what_geometry_says():
    # A wall without end, 1 m away: its horizon falls with the angle to the wall.
    height, angles = 4.0, 2 * np.pi * np.arange(16) / 16
    heights = level()
    heights[:, 31:] += height
    towards = np.cos(angles)
    rises = np.where(towards > 1e-9, height * towards, 0.0)
    # Places are centres of cells, so that the nearest one of the wall may be farther.
    expected = np.mean(1 - np.sin(np.arctan(rises)))
    assert sky_view(heights, METRES, 20.0)[MIDDLE] == pytest.approx(expected, abs=0.03)
    assert sky_view(heights, METRES, 20.0)[30, 31] == 1.0


def test_the_bottom_of_a_pit_is_as_open_as_its_rim_is_low():
    row, column = np.mgrid[-30:31, -30:31]
    heights = np.where(np.hypot(row, column) < 7.6, 0.0, 8.0)
    assert openness(heights, METRES, 12.0)[MIDDLE] == pytest.approx(45.0, abs=2.0)
    assert openness(-heights, METRES, 12.0)[MIDDLE] == pytest.approx(90.0)
    assert openness(-heights, METRES, 12.0)[30, 40] < 89.0


def test_a_slope_is_nearly_as_open_as_level_land():
    # Not quite: the nearest cells of a direction zigzag about it, and the steepest one counts.
    inner = np.s_[15:-15, 15:-15]
    for sign in (1, -1):
        assert openness(sign * plane(0.5), METRES, 10.0)[inner] == pytest.approx(90.0, abs=4.0)
        assert np.ptp(openness(sign * plane(0.5), METRES, 10.0)[inner]) < 1e-3
    assert np.all(sky_view(plane(0.5), METRES, 10.0)[inner] < 0.95)


@pytest.mark.parametrize(("east", "degrees"), [(1.0, 45.0), (np.tan(np.radians(20)), 20.0)])
def test_slope_is_in_degrees_up_to_the_edge(east, degrees):
    # The corners have too few neighbours; cells need not be square.
    for cell, sides in ((0.5, 0.5), (2.0, (2.0, 1.0))):
        found = slope(plane(east, cell=cell), sides)
        assert found[1:-1] == pytest.approx(degrees, abs=1e-3)
        assert found[:, 1:-1] == pytest.approx(degrees, abs=1e-3)


def test_local_dominance_tells_mounds_from_hollows():
    mound, pit = trench(-0.5), trench(0.5)
    assert local_dominance(mound, METRES, 10.0)[MIDDLE] > 1.2
    assert local_dominance(pit, METRES, 10.0)[MIDDLE] < 0.8
    # From 2.2 m instead of 1.7 m one looks down as much more steeply.
    expected = 2.2 / 1.7
    row, column = np.mgrid[-30:31, -30:31]
    small = level() + 0.5 * (np.hypot(row, column) < 5.0)
    assert local_dominance(small, METRES, 10.0)[MIDDLE] == pytest.approx(expected, abs=1e-4)


def test_the_multi_scale_relief_shows_the_narrow_and_the_wide():
    row, column = np.mgrid[-100:101, -100:101].astype(float)
    distance = np.hypot(row + 50, column)
    heights = 0.3 * plane(1.0, 201) + np.exp(-((distance / 25.0) ** 2))
    heights[160:, 99:102] += 0.5
    found = multi_scale_relief(heights, METRES, 8.0)
    assert found[50, 100] > 0.15 and found[180, 100] > 0.15
    assert np.abs(found[100:140, 180]).max() < 0.05


@pytest.mark.parametrize("slope", [0.0, 0.2])
@pytest.mark.parametrize("is_cut", [False, True])
def test_there_are_no_steps_along_the_border_of_the_data(slope, is_cut):
    """Directions that end at the border were left out, one after the other."""
    row, column = np.mgrid[:90, :90]
    heights = slope * column + 0.1 * slope * row
    if is_cut:
        heights[(row + column < 40) | (np.hypot(row - 60, column - 60) < 9.0)] = np.nan
    known = np.isfinite(heights)
    for make in (sky_view, openness, local_dominance):
        assert np.ptp(make(heights, METRES, 10.0)[known]) < 1e-3, make.__name__
    inside = np.s_[1:-1, 1:-1]  # the light of a hillshade has steps of one cell
    picture = archaeological_topography(heights, METRES, 10.0)[inside]
    assert np.ptp(picture[known[inside]].astype(int)) <= 1


def test_what_is_unknown_hides_nothing():
    heights = plane(0.0)
    heights[:, 40:] = np.nan
    heights[5, 5] = np.nan
    for make in (sky_view, openness, local_dominance):
        found = make(heights, METRES, 10.0)
        assert np.array_equal(np.isnan(found), np.isnan(heights))
        assert np.ptp(found[np.isfinite(heights)]) < 1e-4
    lone = np.full((9, 9), np.nan)
    lone[4, 4] = 3.0
    assert np.nansum(sky_view(lone, METRES, 3.0)) == 1.0  # as level land


@pytest.mark.parametrize("cells", [(1.0, 2.1), (3.0, 1.0), (0.3, 0.7)])
@pytest.mark.parametrize("radius", [0.1, 1.0, 5.3])
def test_cells_need_not_be_square(cells, radius):
    wide = np.repeat(np.arange(20.0)[None], 15, axis=0)
    assert np.isfinite(sky_view(wide, cells, radius)).all()
    assert np.isfinite(local_dominance(wide, cells, radius)).all()


def rvt():
    """Return the functions of the Relief Visualization Toolbox, without what needs GDAL."""
    package = importlib.util.find_spec("rvt")
    if package is None:
        pytest.skip("rvt-py is not installed")
    (folder,) = package.submodule_search_locations
    spec = importlib.util.spec_from_file_location("rvt_vis", f"{folder}/vis.py")
    module = importlib.util.module_from_spec(spec)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        spec.loader.exec_module(module)
    return module


def differs(found, expected, border):
    """Return the largest difference in relation to the range; edges are treated otherwise."""
    inner = np.s_[border:-border, border:-border]
    return np.abs(found - expected)[inner].max() / np.ptp(expected[inner])


@pytest.mark.parametrize(("cell", "count"), [(1.0, 10), (0.5, 20), (2.0, 5)])
def test_horizons_are_those_of_rvt(cell, count):
    vis, heights = rvt(), rough().astype(np.float32)
    for noise, nearest in ((0, 0.0), (3, round(0.4 * count) * cell)):
        theirs = vis.sky_view_factor(
            heights.copy(), cell, compute_opns=True, svf_r_max=count, svf_noise=noise
        )
        sky, zenith = sky_view_and_openness(heights, (cell, cell), (nearest, count * cell))
        assert differs(sky, theirs["svf"], count) < 1e-3
        assert differs(zenith, theirs["opns"], count) < 1e-3
    theirs = vis.sky_view_factor(-heights, cell, False, True, svf_r_max=count)
    assert differs(openness(-heights, (cell, cell), count * cell), theirs["opns"], count) < 1e-3


def test_local_dominance_is_that_of_rvt():
    vis, heights = rvt(), rough().astype(np.float32)
    theirs = vis.local_dominance(heights.copy(), min_rad=10, max_rad=20)
    assert differs(local_dominance(heights, METRES, 10.0), theirs, 20) < 1e-3


def test_vat_is_the_mean_of_those_of_rvt_for_hilly_and_level_land():
    vis = rvt()
    heights = (200.0 + 0.1 * (rough(2) - 300.0)).astype(np.float32)
    steep = vis.slope_aspect(heights.copy(), output_units="degree")["slope"]

    def stretched(values, low, high):
        return np.clip((values - low) / (high - low), 0.0, 1.0)

    def blended(sky, zenith, steepest, altitude, count, noise):
        shade = vis.hillshade(heights.copy(), 1, 1, sun_azimuth=315, sun_elevation=altitude)
        both = vis.sky_view_factor(
            heights.copy(), 1.0, compute_opns=True, svf_r_max=count, svf_noise=noise
        )
        below = 0.5 * np.clip(shade, 0, 1) + 0.5 * (1 - stretched(steep, 0, steepest))
        active = stretched(both["opns"], *zenith)
        over = np.where(below > 0.5, 1 - (1 - 2 * (below - 0.5)) * (1 - active), 2 * below * active)
        below = 0.5 * over + 0.5 * below
        return 0.25 * below * stretched(both["svf"], *sky) + 0.75 * below

    hilly = blended((0.7, 1.0), (68, 93), 50, 35, 10, 0)
    flat = blended((0.9, 1.0), (85, 93), 15, 15, 20, 3)
    found = archaeological_topography(heights, METRES, 10.0)
    # Their gradient takes two neighbours, Horn's eight.
    apart = np.abs((found - 1.0) / 254.0 - (hilly + flat) / 2)[20:-20, 20:-20]
    assert np.median(apart) < 0.005 and apart.max() < 0.05


def test_vat_shows_a_wall_along_the_light_that_a_hillshade_hides():
    heights = level()
    diagonal = np.arange(61)
    for beside in (-1, 0, 1):
        inside = (diagonal + beside >= 0) & (diagonal + beside < 61)
        heights[diagonal[inside], diagonal[inside] + beside] += 0.5
    # Beside the wall, which runs towards the light, and far from it.
    beside, far = (30, 33), (30, 55)
    found = archaeological_topography(heights, METRES, 10.0).astype(int)
    assert found[far] - found[beside] > 8
    shade = hillshade(heights, 1.0).astype(int)
    assert abs(shade[far] - shade[beside]) <= 1


def test_red_relief_is_red_on_slopes_bright_on_ridges_and_dark_in_hollows():
    red, green, blue = red_relief(plane(0.7), METRES, 10.0).astype(int)[:, 30, 30]
    assert green == blue and red > green + 100
    grey = red_relief(level(), METRES, 10.0)[:, 30, 30].astype(int)
    assert np.ptp(grey) == 0
    hollow, ridge = (red_relief(trench(depth), METRES, 10.0)[0, 30, 30] for depth in (1.0, -1.0))
    assert hollow < grey[0] - 30 and ridge > grey[0] + 20


def test_pieces_of_rows_change_nothing(monkeypatch):
    heights = rough()
    whole = sky_view(heights, METRES, 8.0), local_dominance(heights, METRES, 4.0)
    monkeypatch.setattr(horizons, "PIECE", 300)
    pieces = sky_view(heights, METRES, 8.0), local_dominance(heights, METRES, 4.0)
    assert all(np.array_equal(*pair) for pair in zip(whole, pieces))


# Files.

rasterio = pytest.importorskip("rasterio")
SIDE = 60.0
NAMES = [name for name in RELIEF if name not in ("hillshade", "relief")]


def write(path, west=0.0, east=SIDE, unit=1.0):
    """Write ground with a bank and a pit, as points of a class."""
    x, y = np.meshgrid(np.arange(0.25, SIDE, 0.5), np.arange(0.25, SIDE, 0.5))
    x, y = x.ravel(), y.ravel()
    z = 100.0 + 0.05 * x + 0.6 * (np.abs(x - y) < 3.0) - 0.8 * (np.hypot(x - 45, y - 15) < 4.0)
    inside = (x >= west) & (x < east)
    return write_points(path, *(axis[inside] / unit for axis in (x, y, z)), 2, offset=(0, 0, 0))


def option(name):
    return f"--{name.replace('_', '-')}"


def drawn(sources, folder, *words):
    """Make all rasters of the relief; return them by name."""
    folder.mkdir()
    paths = {name: folder / f"{name}.tif" for name in ("dtm", *NAMES)}
    outputs = [f"{option(name)}={path}" for name, path in paths.items()]
    sizes = ["--relief-radius", "4", "--threads", "1"]
    assert main(["terrain", *map(str, sources), *outputs, *sizes, *words]) == 0
    return {name: cells(path) for name, path in paths.items() if path.exists()}


def cells(path):
    with rasterio.open(path) as raster:
        return raster.read()


@pytest.mark.rest
def test_files_and_strips_make_no_seams(tmp_path, monkeypatch):
    whole = drawn([write(tmp_path / "in.laz")], tmp_path / "a")
    monkeypatch.setattr(outline, "_CELLS_A_SPAN", 1)
    monkeypatch.setattr(outline, "_ROWS", 7)
    parts = [write(tmp_path / f"{n}.laz", 20.0 * n, 20.0 * n + 20) for n in range(3)]
    many = drawn(parts, tmp_path / "b")
    for name in NAMES:
        if name == "multi_scale_relief":
            # Sums over a wide reach differ by rounding.
            assert np.abs(many[name] - whole[name]).max() < 1e-4
        else:
            assert np.array_equal(many[name], whole[name]), name


@pytest.mark.rest
def test_each_file_gets_its_part_of_three_bands_too(tmp_path):
    parts = [write(tmp_path / f"{n}.laz", 30.0 * n, 30.0 * n + 30) for n in range(2)]
    whole = drawn(parts, tmp_path / "one")
    drawn(parts, tmp_path / "per", "--raster-per-file")
    for name in ("red_relief", "sky_view"):
        assert np.array_equal(cells(tmp_path / "per" / f"{name}.vrt"), whole[name])
    with rasterio.open(tmp_path / "per" / "red_relief.vrt") as raster:
        colours = [colour.name for colour in raster.colorinterp]
    assert colours == ["red", "green", "blue"]


@pytest.mark.rest
def test_classify_makes_them_in_the_same_run(tmp_path):
    source, target = write(tmp_path / "in.laz"), tmp_path / "out.laz"
    outputs = [f"--vat={tmp_path / 'vat.tif'}", f"--sky-view={tmp_path / 'sky.tif'}"]
    assert main(["classify", str(source), str(target), *outputs]) == 0
    with rasterio.open(tmp_path / "vat.tif") as raster:
        assert raster.dtypes == ("uint8",) and raster.nodata == 0
    sky = cells(tmp_path / "sky.tif")
    assert 0.5 < sky[sky > 0].min() < sky.max() <= 1.0


@pytest.mark.rest
def test_a_high_tolerance_keeps_narrow_walls(tmp_path):
    # What the page on relief recommends to archaeologists.
    draw = np.random.default_rng(2)
    x, y = draw.uniform(0, 100, (2, 80_000))
    wall = (np.abs(y - 50) < 0.5) & (x > 20) & (x < 80)
    z = 100.0 + 0.1 * x + 1.5 * np.sin(y / 25) + 0.7 * wall + draw.normal(0, 0.02, x.size)
    write_points(tmp_path / "in.laz", x, y, z, offset=(0, 0, 0))
    kept = []
    for tolerance in ("0.18", "0.8"):
        words = [str(tmp_path / "in.laz"), str(tmp_path / "out.laz")]
        assert main(["classify", *words, "--ground-tolerance", tolerance]) == 0
        kept.append(np.mean(laspy.read(tmp_path / "out.laz").classification[wall] == 2))
    assert kept[0] < 0.5 and kept[1] > 0.99


def test_red_relief_is_a_picture_in_colours(tmp_path):
    drawn([write(tmp_path / "in.laz")], tmp_path / "a")
    with rasterio.open(tmp_path / "a" / "red_relief.tif") as raster:
        assert [colour.name for colour in raster.colorinterp] == ["red", "green", "blue"]
        assert raster.nodatavals == (0.0, 0.0, 0.0)
        assert raster.tags(ns="IMAGE_STRUCTURE")["LAYOUT"] == "COG"
        assert raster.descriptions[0] == "Red relief"


@pytest.mark.rest(but="openness")
@pytest.mark.parametrize("kind", quick(sorted(KINDS), "openness", "red-relief", "vat"))
def test_the_command_makes_each_kind_of_any_raster(tmp_path, monkeypatch, kind):
    name = "relief" if kind == "local-relief" else kind.replace("-", "_")
    source = write(tmp_path / "in.laz")
    dtm, beside, target = (tmp_path / f"{key}.tif" for key in ("dtm", "beside", "target"))
    words = ["--relief-radius", "4", "--hillshade-light", "multidirectional"]
    outputs = [f"--dtm={dtm}", f"{option(name)}={beside}"]
    assert main(["terrain", str(source), *outputs, *words]) == 0
    assert main(["relief", str(dtm), str(target), "--kind", kind, *words]) == 0
    assert np.allclose(cells(target), cells(beside), atol=2e-3)
    with rasterio.open(target) as one, rasterio.open(beside) as other:
        assert one.descriptions == other.descriptions and one.nodata == other.nodata
    monkeypatch.setattr(relief_module, "_CELLS", 500)
    bare_earth.relief(dtm, tmp_path / "strips.tif", kind=kind, relief_radius=4.0)
    assert np.allclose(cells(tmp_path / "strips.tif"), cells(target), atol=2e-3)


def test_feet_change_nothing_but_heights(tmp_path):
    dtm, feet = tmp_path / "dtm.tif", tmp_path / "feet.tif"
    assert main(["terrain", str(write(tmp_path / "in.laz")), f"--dtm={dtm}"]) == 0
    with rasterio.open(dtm) as raster:
        profile, heights = raster.profile, raster.read(1)
    with rasterio.open(feet, "w", **profile) as raster:
        raster.write(np.where(heights == raster.nodata, heights, heights / 0.3048), 1)
        raster.units = ("ft",)
    for kind in ("sky-view", "slope", "local-dominance"):
        for source in (dtm, feet):
            bare_earth.relief(source, source.with_suffix(".out.tif"), kind=kind)
        metres, in_feet = (cells(value.with_suffix(".out.tif")) for value in (dtm, feet))
        assert np.abs(metres - in_feet).max() < 2e-3
    with rasterio.open(tmp_path / "feet.out.tif") as raster:
        assert raster.units == (None,)


def test_a_picture_is_no_terrain(tmp_path, capsys):
    values = np.random.default_rng(1).integers(0, 255, (3, 30, 30)).astype(np.uint8)
    for name, driver in (("shot.png", "PNG"), ("shot.tif", "GTiff")):
        more = {"photometric": "RGB"} if driver == "GTiff" else {}
        with rasterio.open(
            tmp_path / name, "w", driver=driver, width=30, height=30, count=3, dtype="uint8",
            transform=rasterio.Affine(1, 0, 0, 0, -1, 30), **more,
        ) as file:  # fmt: skip
            file.write(values)
        assert main(["relief", str(tmp_path / name), str(tmp_path / "vat.tif"), "--kind", "vat"])
        assert "a picture in colours" in capsys.readouterr().err
        assert not (tmp_path / "vat.tif").exists()


def test_an_unknown_kind_is_refused(tmp_path):
    with pytest.raises(Exception, match="one of hillshade"):
        bare_earth.relief(tmp_path / "dtm.tif", tmp_path / "out.tif", kind="shadow")


@pytest.mark.rest
@pytest.mark.skipif(shutil.which("gdaldem") is None, reason="gdaldem is not installed")
def test_slope_is_that_of_gdaldem(tmp_path):
    whole = drawn([write(tmp_path / "in.laz")], tmp_path / "a")
    target = tmp_path / "gdal.tif"
    dtm = tmp_path / "a" / "dtm.tif"
    subprocess.run(["gdaldem", "slope", dtm, target, "-q"], check=True)
    inner = np.s_[:, 2:-2, 2:-2]
    assert np.abs(cells(target) - whole["slope"])[inner].max() < 0.01
