"""Pictures of the relief: smoothed where it is noisy, sharp elsewhere, and without seams."""

import numpy as np
import pytest
from realdata import real
from surveys import write_points

import bare_earth
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.grids import outline
from bare_earth.algorithms.relief.hillshade import hillshade
from bare_earth.algorithms.relief.local_relief import local_trend
from bare_earth.algorithms.relief.smoothing import smoothing_reach, without_noise
from bare_earth.algorithms.tools import relief as relief_module

rasterio = pytest.importorskip("rasterio")
CELL = 0.5


def ground(rows=200, columns=240):
    """Return a slope with a ditch 2 m wide and 0.6 m deep, and a wall of 0.4 m."""
    row, column = np.mgrid[: float(rows), : float(columns)]
    heights = 100.0 + 0.05 * column * CELL
    ditch = np.abs(column + 0.3 * row - 90.0) * CELL / 1.04
    heights -= 0.6 * np.clip(1.5 - ditch, 0.0, 1.0)
    return heights + 0.4 * (row > 150)


def noise(shape, size, seed=3):
    return np.random.default_rng(seed).normal(0, size, shape)


def test_noise_of_a_forest_is_smoothed():
    row, column = np.mgrid[:200.0, :240.0]
    slope = 100.0 + 0.2 * column * CELL - 0.1 * row * CELL
    noisy = slope + noise(slope.shape, 0.1)
    found = without_noise(noisy, CELL)
    assert np.std(found - slope) < 0.35 * np.std(noisy - slope)
    before, after = (np.std(hillshade(heights, CELL).astype(float)) for heights in (noisy, found))
    assert after < 0.3 * before


def test_ditches_and_walls_of_open_ground_stay_sharp():
    plain = ground()
    for heights in (plain, plain + noise(plain.shape, 0.01)):
        assert np.std(without_noise(heights, CELL) - heights) < 0.006
        away = np.s_[20:130, 10:230]
        assert np.abs(without_noise(heights, CELL) - heights)[away].max() < 0.06


def test_a_ditch_in_a_forest_stays():
    plain = ground()
    found = without_noise(plain + noise(plain.shape, 0.06), CELL)
    bottom = plain < 100.0 + 0.05 * np.arange(plain.shape[1]) * CELL - 0.55
    assert np.mean((found - plain)[bottom & (np.arange(len(plain)) < 140)[:, None]]) < 0.06


def test_a_plane_and_its_edges_do_not_change():
    row, column = np.mgrid[:120.0, :140.0]
    plane = 500.0 + 0.5 * column - 0.3 * row
    plane[(row - 60) ** 2 + (column - 70) ** 2 < 400] = np.nan
    plane[:, :7] = np.nan
    for found in (without_noise(plane, CELL), local_trend(plane, (5.0, 3.0))):
        assert np.array_equal(np.isnan(found), np.isnan(plane))
        assert np.nanmax(np.abs(found - plane)) < 1e-6


def test_a_cell_does_not_depend_on_what_lies_beyond_the_reach():
    heights = ground() + noise((200, 240), 0.1)
    heights[60:64, 100:130] = np.nan
    whole, reach = without_noise(heights, CELL), smoothing_reach(CELL)
    for row, column in ((0, 0), (80, 90), (150, 200)):
        first = max(row - reach, 0), max(column - reach, 0)
        part = without_noise(
            heights[first[0] : row + 40 + reach, first[1] : column + 40 + reach], CELL
        )
        part = part[row - first[0] :, column - first[1] :][:40, :40]
        assert np.array_equal(part, whole[row : row + 40, column : column + 40], equal_nan=True)


def test_large_cells_are_not_smoothed():
    heights = noise((30, 30), 1.0)
    assert smoothing_reach(5.0) == 0 and np.array_equal(without_noise(heights, 5.0), heights)
    assert np.isnan(without_noise(np.full((3, 3), np.nan), CELL)).all()


def write(path, west=0.0, east=60.0, seed=5):
    random = np.random.default_rng(seed)
    x, y = random.uniform(0, 60, (2, 20_000))
    z = 100 + 0.2 * x + random.normal(0, 0.1, len(x)) - (np.abs(y - 30) < 1)
    keep = (x >= west) & (x < east)
    return write_points(path, x[keep], y[keep], z[keep], 2)


def cells(path):
    with rasterio.open(path) as raster:
        return raster.read(1)


PICTURES = ("dtm", "hillshade", "relief")


def drawn(source, folder, **how):
    folder.mkdir()
    files = {name: folder / f"{name}.tif" for name in PICTURES}
    bare_earth.terrain(source, **files, dtm_cell_size=CELL, relief_radius=4.0, **how)
    return {name: cells(folder / f"{name}.tif") for name in PICTURES}


@pytest.mark.rest
def test_the_terrain_model_is_the_same_and_the_pictures_are_smoother(tmp_path):
    source = write(tmp_path / "in.laz")
    smooth = drawn(source, tmp_path / "a")
    plain = drawn(source, tmp_path / "b", relief_smoothing="none")
    assert np.array_equal(smooth["dtm"], plain["dtm"])
    inner = np.s_[5:40, 5:-5]
    for name in ("hillshade", "relief"):
        assert np.std(smooth[name][inner]) < 0.7 * np.std(plain[name][inner])


@pytest.mark.long
def test_strips_and_files_make_no_seams(tmp_path, monkeypatch):
    whole = drawn(write(tmp_path / "in.laz"), tmp_path / "a")
    monkeypatch.setattr(outline, "_CELLS_A_SPAN", 1)
    monkeypatch.setattr(outline, "_ROWS", 7)
    parts = [write(tmp_path / f"{n}.laz", 20.0 * n, 20.0 * n + 20) for n in range(3)]
    many = drawn(parts, tmp_path / "b")
    for name in PICTURES:
        assert np.array_equal(many[name], whole[name]), name


@pytest.mark.rest
def test_each_file_gets_its_part_of_the_pictures(tmp_path):
    for number in range(2):
        write(tmp_path / f"{number}.laz", 30.0 * number, 30.0 * number + 30)
    sources = [str(tmp_path / f"{number}.laz") for number in range(2)]
    words = ["--dtm-cell-size", "0.5", "--threads", "1"]
    for name, more in (("one", []), ("per", ["--raster-per-file"])):
        (tmp_path / name).mkdir()
        targets = [
            f"--{picture}={tmp_path / name / picture}.tif" for picture in ("hillshade", "relief")
        ]
        assert main(["terrain", *sources, *targets, *words, *more]) == 0
    for picture in ("hillshade", "relief"):
        whole = tmp_path / "one" / f"{picture}.tif"
        with rasterio.open(whole) as one:
            for number in range(2):
                with rasterio.open(tmp_path / "per" / picture / f"{number}.tif") as part:
                    values = one.read(1, window=one.window(*part.bounds))
                    assert np.array_equal(part.read(1), values)


@pytest.mark.rest
def test_the_command_makes_the_relief_of_a_raster(tmp_path, monkeypatch):
    found = drawn(write(tmp_path / "in.laz"), tmp_path / "a")
    target, source = tmp_path / "relief.tif", tmp_path / "a" / "dtm.tif"
    assert main(["relief", str(source), str(target), "--relief-radius", "4"]) == 0
    relief = cells(target)
    known = relief > -9000
    assert np.array_equal(known, found["relief"] > -9000)
    assert np.abs(relief - found["relief"])[known].max() < 1e-4
    monkeypatch.setattr(relief_module, "_CELLS", 500)
    bare_earth.relief(source, tmp_path / "strips.tif", relief_radius=4.0)
    assert np.array_equal(cells(tmp_path / "strips.tif"), relief)
    with rasterio.open(target) as raster:
        assert raster.descriptions == ("Local relief, m",)


@pytest.mark.long
@pytest.mark.parametrize(("name", "most"), [("hawaii_forest", 0.75), ("conifer_1", 0.75)])
def test_real_forests_are_less_speckled(tmp_path, name, most):
    path = tmp_path / "dtm.tif"
    bare_earth.terrain(real(f"real/{name}.laz"), dtm=path, dtm_cell_size=CELL)
    with rasterio.open(path) as raster:
        heights = raster.read(1, masked=True).filled(np.nan)[:400, :400]
    before, after = (
        hillshade(model, CELL).astype(float) for model in (heights, without_noise(heights, CELL))
    )
    speckle = [np.abs(np.diff(shade, axis=0)).mean() for shade in (before, after)]
    assert speckle[1] < most * speckle[0]
