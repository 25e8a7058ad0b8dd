"""The rasters of a survey are those of one triangulation, however it is cut into blocks."""

import json
import os
from types import SimpleNamespace

import laspy
import numpy as np
import pytest
from matrices import quick
from runs import CancelAt
from surveys import cut, strip, write, write_points

import bare_earth
from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.engine import blocks as blocks_module
from bare_earth.algorithms.engine.jobs import BlockJob
from bare_earth.algorithms.engine.step import Sink
from bare_earth.algorithms.engine.workers import Threads
from bare_earth.algorithms.tin.triangulation import Tin, hull_corners

pytestmark = pytest.mark.processes

rasterio = pytest.importorskip("rasterio")

SLOPE = {"method": "slope", "preset": "whitebox"}


def _cloud(x, y, z):
    """Return places in the steps of a file."""
    return tuple(np.round(values, 2) for values in (x, y, z))


def _hills(count, size=600.0, keep=None):
    x, y = np.random.default_rng(1).uniform(-size / 2, size / 2, (2, count))
    if keep is not None:
        x, y = x[keep(x, y)], y[keep(x, y)]
    return _cloud(x, y, 100.0 + 8.0 * np.sin(x / 60.0) + 0.05 * y)


def _made(cloud, folder, max_edge=None, names=("dtm",), cell=2.5):
    """Return the cells of the first raster of ground points, and x and y of their middles."""
    source = write_points(folder / "in.las", *cloud, 2, offset=(0.0, 0.0, 0.0))
    files = {name: folder / f"{name}.tif" for name in names}
    bare_earth.terrain(source, **files, dtm_cell_size=cell, max_edge=max_edge)
    with rasterio.open(files[names[0]]) as raster:
        values = raster.read(1, masked=True).filled(np.nan)
        rows, columns = np.mgrid[: raster.height, : raster.width]
        x, y = (np.array(places) for places in raster.xy(rows.ravel(), columns.ravel()))
    return values, x.reshape(values.shape), y.reshape(values.shape)


def _vertices_of(x, y, z, side):
    """Return the point nearest to the centre of each square that has any, and the hull."""
    column, row = np.floor(x / side), np.floor(y / side)
    distance = (x / side - column - 0.5) ** 2 + (y / side - row - 0.5) ** 2
    order = np.lexsort((z, distance, column, row))
    first = np.append(True, (np.diff(column[order]) != 0) | (np.diff(row[order]) != 0))
    return np.union1d(order[first], hull_corners(x, y))


def _of_tin(cloud, x, y, cell=2.5):
    vertices = _vertices_of(*cloud, cell / 2.0)
    tin = Tin(*(values[vertices] for values in cloud))
    return tin.interpolate(x.ravel(), y.ravel()).reshape(x.shape)


@pytest.fixture
def small_blocks(monkeypatch):
    monkeypatch.setattr(blocks_module, "_SIDE", 100.0)


def _is_lake(x, y, margin=0.0):
    # Along the hills, so that both shores are as high.
    return np.hypot(x / (80.0 + margin), y / (200.0 + margin)) < 1.0


CLOUDS = {
    "dense": _hills(14_000, 240.0),
    "uneven": _hills(9_000, keep=lambda x, y: np.random.default_rng(2).random(len(x)) > y / 600.0),
    "lake": _hills(18_000, keep=lambda x, y: ~_is_lake(x, y)),
    "sparse": _hills(90),
}


@pytest.mark.rest
@pytest.mark.parametrize("name", quick(CLOUDS, "uneven", "lake", "sparse"))
def test_a_terrain_model_in_blocks_is_that_of_one_tin(small_blocks, tmp_path, name):
    cloud = CLOUDS[name]
    found, x, y = _made(cloud, tmp_path)
    expected = _of_tin(cloud, x, y)
    lost = np.isnan(found) & ~np.isnan(expected)
    assert not (np.isnan(expected) & ~np.isnan(found)).any()
    # Cells along the border that only slivers of the hull reach have no value.
    reach, most = {"sparse": (100.0, 0.15), "uneven": (20.0, 0.03)}.get(name, (7.0, 0.03))
    border = max(cloud[0].max(), cloud[1].max()) - np.maximum(np.abs(x), np.abs(y))
    assert lost.mean() < most and (border[lost] < reach).all()
    wrong = np.abs(found - expected)
    assert np.nanquantile(wrong, 0.5) < 0.001
    # Over gaps wider than 50 m, cells along them stand for the points.
    assert np.nanquantile(wrong, 0.99) < {"lake": 0.15, "sparse": 0.4}.get(name, 0.05)
    assert np.nanmax(wrong) < 1.0


@pytest.mark.rest
def test_gaps_wider_than_the_longest_edge_stay_open(small_blocks, tmp_path):
    found, x, y = _made(CLOUDS["lake"], tmp_path, max_edge=30.0)
    assert np.isnan(found[_is_lake(x, y, -20.0)]).all()
    inside = ~_is_lake(x, y, 10.0) & (np.abs(x) < 290.0) & (np.abs(y) < 290.0)
    assert np.isfinite(found[inside]).all()


@pytest.mark.rest
@pytest.mark.parametrize("max_edge", quick([None, 20.0], 20.0))
def test_blocks_of_any_size_give_the_same_rasters(tmp_path, monkeypatch, max_edge):
    names = "dtm", "dsm", "chm", "hillshade"
    rasters = []
    for side in (2000.0, 100.0):
        monkeypatch.setattr(blocks_module, "_SIDE", side)
        _made(CLOUDS["dense"], tmp_path, max_edge, names)
        rasters += [_values(tmp_path / f"{name}.tif")[0] for name in names]
    for one, other in zip(rasters[:4], rasters[4:]):
        assert one.shape == other.shape
        most = 1 if one.dtype == np.uint8 else 0.001
        assert np.mean(np.abs(one.astype(float) - other) > most) < 1e-4


def _of_files(sources, folder, **options):
    folder.mkdir()
    names = "dtm", "dsm", "chm", "hillshade", "expected_error"
    files = {name: folder / f"{name}.tif" for name in names}
    bare_earth.terrain(sources, **files, **{"threads": 2, "memory": 2.0, **options})
    return [_values(path) for path in files.values()]


def _values(path):
    with rasterio.open(path) as raster:
        return raster.read(1), raster.transform


def _same(rasters, others):
    return all(
        np.array_equal(cells, other_cells) and transform == other_transform
        for (cells, transform), (other_cells, other_transform) in zip(rasters, others)
    )


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    """One classified file, and the same points in 12 of any extents."""
    folder = tmp_path_factory.mktemp("survey")
    points = strip(4000, 300.0, 170.0)
    write(folder / "one.laz", points, classes=np.where(points[:, 2] % 10, 2, 1))
    cut(folder / "many", points, 12)
    for path in (folder / "many").iterdir():
        las = laspy.read(path)
        las.classification[:] = np.where(np.round(np.asarray(las.z) * 100) % 10, 2, 1)
        las.write(str(path))
    return folder


@pytest.fixture(scope="module")
def of_one(survey):
    """The rasters of the one file, in blocks of the usual size."""
    return _of_files(survey / "one.laz", survey / "rasters")


def test_many_files_give_the_rasters_of_one_cell_by_cell(survey, small_blocks, tmp_path):
    one = _of_files(survey / "one.laz", tmp_path / "one")
    many = _of_files(survey / "many", tmp_path / "many")
    assert _same(one, many)
    names = "chm", "dsm", "dtm", "expected_error", "hillshade"
    assert sorted(os.listdir(tmp_path / "many")) == [f"{name}.tif" for name in names]


@pytest.mark.rest
def test_processes_give_the_rasters_of_threads(survey, of_one, tmp_path):
    many = _of_files(survey / "many", tmp_path / "more", scheduler="processes")
    assert _same(of_one, many)


@pytest.fixture
def raster_jobs(monkeypatch):
    """How many jobs of rasters began; a run is cancelled by that which makes them `most`."""
    jobs, submit = SimpleNamespace(count=0, most=None), Threads.submit

    def counting(workers, job):
        jobs.count += isinstance(job, BlockJob) and isinstance(job.output.grid.step, Sink)
        if jobs.count == jobs.most:
            raise Cancelled
        return submit(workers, job)

    monkeypatch.setattr(Threads, "submit", counting)
    return jobs


@pytest.mark.rest
def test_a_cancelled_survey_goes_on_with_the_rasters_that_are_left(
    small_blocks, tmp_path, raster_jobs
):
    # Blocks 5 km apart are two jobs.
    near, source = strip(3000, 60.0, 40.0), tmp_path / "in"
    source.mkdir()
    for number in range(2):
        write(source / f"{number}.laz", near + np.array([500_000 * number, 0, 0]))
    once, more = tmp_path / "once.tif", tmp_path / "more.tif"
    bare_earth.classify(source, tmp_path / "once", dtm=once, threads=1, **SLOPE)
    count = raster_jobs.count
    raster_jobs.count, raster_jobs.most = 0, count
    run = {"dtm": more, "threads": 1, **SLOPE}
    with pytest.raises(Cancelled):
        bare_earth.classify(source, tmp_path / "more", **run)
    assert not more.exists()
    raster_jobs.count, raster_jobs.most = 0, None
    bare_earth.classify(source, tmp_path / "more", resume=True, **run)
    assert _same([_values(more)], [_values(once)])
    assert count > 1 and raster_jobs.count == 1
    assert not list((tmp_path / "more").rglob("*.npz"))


@pytest.mark.rest
@pytest.mark.parametrize("source", quick(["one.laz", "many"], "many"))
def test_files_that_do_not_fit_into_memory_give_the_same_rasters(survey, of_one, tmp_path, source):
    assert _same(of_one, _of_files(survey / source, tmp_path / "other", memory=0.001))


@pytest.mark.rest
def test_classified_tiles_give_the_terrain_model_of_one_file(survey, tmp_path):
    dtm, shade, many = tmp_path / "dtm.tif", tmp_path / "shade.tif", tmp_path / "out"
    one = tmp_path / "1.tif"
    bare_earth.classify(survey / "many", many, method="slope", dtm=dtm, hillshade=shade)
    bare_earth.classify(survey / "one.laz", tmp_path / "one.laz", method="slope", dtm=one)
    assert _same([_values(dtm)], [_values(one)])
    assert shade.exists() and not list(many.glob("*.npz"))


@pytest.mark.rest
def test_the_terrain_command_takes_a_folder(survey, tmp_path, capsys, threads_for_processes):
    words = ["terrain", str(survey / "many"), "--dtm", str(tmp_path / "dtm.tif"), "--json"]
    assert main(words) == 0
    assert json.loads(capsys.readouterr().out)["columns"] == 300
    words = ["classify", str(survey / "many"), str(tmp_path / "out"), "--method", "slope"]
    assert main([*words, "--hillshade", str(tmp_path / "out" / "shade.tif")]) == 0
    assert (tmp_path / "out" / "shade.tif").exists()


@pytest.mark.rest(but="0.1")
@pytest.mark.parametrize("fraction", [0.1, 0.5, 0.9])
def test_a_cancel_leaves_nothing(survey, tmp_path, fraction):
    with pytest.raises(Cancelled):
        _of_files(survey / "many", tmp_path / "out", progress=CancelAt(fraction))
    assert os.listdir(tmp_path / "out") == []


@pytest.mark.rest
def test_the_expected_error_is_large_across_gaps_and_small_where_ground_is_dense(tmp_path):
    found, x, y = _made(CLOUDS["lake"], tmp_path, names=("expected_error",), cell=1.0)
    within, beyond = _is_lake(x, y, -30.0), ~_is_lake(x, y, 30.0) & (np.abs(x) < 270)
    assert np.nanmedian(found[within]) > 2.0 * np.nanmedian(found[beyond])


@pytest.mark.rest
def test_the_expected_error_has_no_data_where_the_terrain_has_none(tmp_path):
    along, off = np.mgrid[0:200.0, 0:60.0].reshape(2, -1)
    stripe = _cloud((along + off) / 2, (along - off) / 2, np.zeros(len(along)))
    terrain, _, _ = _made(stripe, tmp_path, cell=1.0)
    found, _, _ = _made(stripe, tmp_path, names=("expected_error",), cell=1.0)
    assert 0.3 < np.isnan(terrain).mean() < 0.7
    assert np.array_equal(np.isnan(found), np.isnan(terrain))


def test_the_file_is_cloud_optimised(tmp_path):
    _made(CLOUDS["dense"], tmp_path, cell=0.45)
    with rasterio.open(tmp_path / "dtm.tif") as raster:
        assert raster.overviews(1) == [2, 4]
        assert raster.profile["tiled"] and raster.profile["compress"] == "deflate"
        assert raster.tags(ns="IMAGE_STRUCTURE")["LAYOUT"] == "COG"


# One raster for each file


@pytest.fixture
def named(tmp_path):
    names = "dtm", "hillshade", "chm"
    return {name: tmp_path / f"{name}.tif" for name in names}


@pytest.mark.rest
def test_the_rasters_of_single_files_are_cut_from_that_of_all(survey, named, tmp_path):
    bare_earth.terrain(survey / "many", **named)
    whole = {name: _values(path) for name, path in named.items()}
    for path in named.values():
        path.unlink()
    bare_earth.terrain(survey / "many", **named, raster_per_file=True)
    files = sorted(path.stem for path in (survey / "many").iterdir())
    for name, (cells, transform) in whole.items():
        assert not (tmp_path / f"{name}.tif").exists()
        assert sorted(path.stem for path in (tmp_path / name).iterdir()) == files
        # Cells in gaps can differ by a rounding: they are interpolated in other groups.
        most = 1 if cells.dtype == np.uint8 else 1e-4
        for file in files:
            with laspy.open(survey / "many" / f"{file}.laz") as reader:
                west, north = reader.header.mins[0], reader.header.maxs[1]
            part, place = _values(tmp_path / name / f"{file}.tif")
            assert 0 <= west - place.c < 1.0 and 0 <= place.f - north < 1.0
            column, row = round(place.c - transform.c), round(transform.f - place.f)
            expected = cells[row:, column:][: part.shape[0], : part.shape[1]]
            assert np.abs(part.astype(float) - expected).max() <= most
        # Programs see all of them as one.
        with rasterio.open(tmp_path / f"{name}.vrt") as joined:
            assert joined.transform == transform and joined.crs == part_crs(tmp_path / name)
            seen, covered = joined.read(1), np.zeros(cells.shape, bool)
            covered[seen != joined.nodata] = True
            assert np.abs(seen.astype(float) - cells)[covered].max() <= most
            # What lies between the extents of the files is in none of them.
            assert 0.9 < np.mean(covered) / np.mean(cells != joined.nodata) <= 1.0


def part_crs(folder):
    with rasterio.open(next(folder.iterdir())) as raster:
        return raster.crs


@pytest.mark.rest
def test_the_commands_make_one_raster_for_each_file(survey, tmp_path, threads_for_processes):
    out = tmp_path / "out"
    words = ["classify", survey / "many", out, "--method", "slope", "--dtm", out / "dtm.tif"]
    assert main([*map(str, words), "--raster-per-file"]) == 0
    assert len(list((out / "dtm").glob("*.tif"))) == 12 and (out / "dtm.vrt").exists()
    words = ["terrain", survey / "many", "--dtm", tmp_path / "dtm.tif", "--raster-per-file"]
    assert main([*map(str, words)]) == 0
    assert len(list((tmp_path / "dtm").glob("*.tif"))) == 12
    # One file has one raster in any case.
    words = ["terrain", survey / "one.laz", "--dtm", tmp_path / "1.tif", "--raster-per-file"]
    assert main([*map(str, words)]) == 0 and (tmp_path / "1.tif").exists()


def test_rasters_of_single_files_that_would_do_harm_are_refused(survey, named, tmp_path):
    (tmp_path / "dtm").write_bytes(b"")
    with pytest.raises(BareEarthError, match=r"dtm: .* a file"):
        bare_earth.terrain(survey / "many", **named, raster_per_file=True)
    (tmp_path / "dtm").unlink()
    alike = [write(tmp_path / f"a.{suffix}", strip(300), classes=2) for suffix in ("las", "laz")]
    with pytest.raises(BareEarthError, match=r"become a\.tif"):
        bare_earth.terrain(alike, **named, raster_per_file=True)
    with pytest.raises(BareEarthError, match=r"become a\.tif"):
        bare_earth.classify(alike, tmp_path / "out", **named, raster_per_file=True, **SLOPE)
    assert sorted(os.listdir(tmp_path)) == ["a.las", "a.laz"]


@pytest.mark.rest
def test_a_cancel_leaves_no_raster_and_no_folder_of_single_files(survey, named, tmp_path):
    with pytest.raises(Cancelled):
        bare_earth.terrain(survey / "many", **named, progress=CancelAt(0.97), raster_per_file=True)
    assert os.listdir(tmp_path) == []
