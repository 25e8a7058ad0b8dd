"""Blocks of a survey are tasks that run anywhere, and give what a run on all files gives."""

import pickle

import laspy
import numpy as np
import pytest
from remote_server import serving
from surveys import ORIGIN, strip, write, write_classified

import bare_earth
from bare_earth import arrays
from bare_earth.algorithms.engine import blocks as engine_blocks

pytestmark = pytest.mark.processes

# Looks only a few metres round a point.
NEAR = {"method": "slope", "preset": "whitebox", "search_radius": 3.0}
RASTERS = ("dtm", "dsm", "hillshade", "expected_error", "red_relief")


@pytest.fixture(scope="module")
def survey(tmp_path_factory):
    """Two files with a hole as wide as a building, and their classified copies."""
    folder = tmp_path_factory.mktemp("survey")
    (folder / "raw").mkdir()
    points = strip(15_000, 600.0)
    x, y = points[:, 0] / 100, points[:, 1] / 100
    points = points[(np.abs(x - 330) > 35) | (np.abs(y - 60) > 30)]
    for name, inside in (("a", points[:, 0] < 25_000), ("b", points[:, 0] >= 25_000)):
        write(folder / "raw" / f"{name}.laz", points[inside])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(engine_blocks, "_SIDE", 100.0)
        bare_earth.classify(folder / "raw", folder / "done", **NEAR)
    return folder


@pytest.fixture
def small_blocks(monkeypatch):
    monkeypatch.setattr(engine_blocks, "_SIDE", 100.0)


def rows(*tables):
    """Return coordinates and classes of all points, in order."""
    names = ("X", "Y", "Z", "Classification")
    found = np.concatenate([np.column_stack([table[name] for name in names]) for table in tables])
    return found[np.lexsort(found.T)]


def rows_of(folder):
    files = [laspy.read(str(path)) for path in sorted(folder.glob("*.laz"))]
    names = dict(X="x", Y="y", Z="z", Classification="classification")
    return rows(*({name: np.asarray(las[own]) for name, own in names.items()} for las in files))


def test_all_blocks_have_the_labels_of_the_survey(survey, small_blocks):
    blocks = arrays.blocks(survey / "raw", **NEAR)
    assert {len(block.sources) for block in blocks} == {1, 2} and len(blocks) >= 12
    for block in blocks:
        west, south, east, north = np.subtract(block.window, block.extent)
        assert west < -3 and south < -3 and east > 3 and north > 3
    tables = [pickle.loads(pickle.dumps(block))() for block in blocks]
    assert np.array_equal(rows(*tables), rows_of(survey / "done"))
    table = next(table for table in tables if len(table["X"]))
    ground = table["Classification"] == 2
    assert np.array_equal(arrays.heights(table)[ground], np.zeros(ground.sum()))
    x, y = table["X"], table["Y"]
    (block,) = (block for block in blocks if block.extent[0] <= x[0] < block.extent[2]
                and block.extent[1] <= y[0] < block.extent[3])  # fmt: skip
    assert x.min() >= block.extent[0] and y.max() < block.extent[3]


@pytest.mark.rest
def test_rasters_are_lazy_and_equal_to_those_of_the_survey(survey, small_blocks, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    xarray, dask = pytest.importorskip("xarray"), pytest.importorskip("dask")
    paths = {name: str(tmp_path / f"{name}.tif") for name in RASTERS}
    how = dict(max_edge=5.0, dtm_cell_size=2.0)
    bare_earth.terrain(survey / "done", crs="EPSG:25832", raster_nodata=None, **how, **paths)
    blocks = arrays.blocks(survey / "raw", crs="EPSG:25832", **NEAR)
    rasters = arrays.terrain(blocks, rasters=RASTERS, **how)
    lazy = [raster.to_xarray() for raster in rasters.values()]
    assert all(isinstance(one, xarray.DataArray) for one in lazy)
    assert all(one.data.npartitions >= 6 for one in lazy)
    for (name, path), whole in zip(paths.items(), dask.compute(*lazy)):
        cells = whole.values
        with rasterio.open(path) as file:
            wanted = file.read().reshape(cells.shape)
            assert np.array_equal(cells, wanted, equal_nan=cells.dtype.kind == "f")
            assert tuple(rasters[name].transform) == tuple(file.transform)
            assert rasters[name].shows == file.descriptions[0]
    part = (ORIGIN[0] + 90, ORIGIN[1] + 20, ORIGIN[0] + 250, ORIGIN[1] + 70)
    piece = arrays.terrain(blocks, extent=part, **how)["dtm"]
    assert piece.values.shape == (25, 80)
    west, south, east, north = part
    same = rasters["dtm"].to_xarray().sel(x=slice(west, east), y=slice(north, south))
    assert np.array_equal(*dask.compute(piece.values, same.data), equal_nan=True)


@pytest.mark.rest
def test_gaps_of_the_survey_are_filled_as_in_a_run(survey, small_blocks, tmp_path):
    rasterio = pytest.importorskip("rasterio")
    pytest.importorskip("dask.array")
    bare_earth.terrain(survey / "done", dtm=tmp_path / "dtm.tif", raster_nodata=None)
    blocks = arrays.blocks(survey / "done", classified=True)
    cells = arrays.terrain(blocks)["dtm"].values.compute()
    with rasterio.open(tmp_path / "dtm.tif") as file:
        assert np.array_equal(cells, file.read(1), equal_nan=True)


@pytest.mark.rest
def test_dask_and_joblib_run_them_in_processes(tmp_path):
    joblib, dask = pytest.importorskip("joblib"), pytest.importorskip("dask")
    (tmp_path / "raw").mkdir()
    # On both sides of a border of blocks, which are 2 km wide.
    write(tmp_path / "raw" / "a.laz", strip() - np.array((15_000, 0, 0)))
    bare_earth.classify(tmp_path / "raw", tmp_path / "done", **NEAR)
    blocks = [block for block in arrays.blocks(tmp_path / "raw", **NEAR)]
    tables = joblib.Parallel(2)(joblib.delayed(block)() for block in blocks)
    assert sum(len(table["X"]) > 0 for table in tables) == 2
    assert np.array_equal(rows(*tables), rows_of(tmp_path / "done"))
    again = dask.compute(*(dask.delayed(block)() for block in blocks), scheduler="processes")
    assert np.array_equal(rows(*again), rows_of(tmp_path / "done"))


@pytest.mark.rest
def test_blocks_of_addresses_fetch_their_own_points(survey, small_blocks, tmp_path, monkeypatch):
    monkeypatch.setenv("BARE_EARTH_CACHE", str(tmp_path / "cache"))
    (tmp_path / "done").mkdir()
    plain, remote = tmp_path / "plain.las", tmp_path / "a.copc.laz"
    integers = strip(60_000, 600.0)
    # No point lies in the window of a block.
    integers = integers[np.abs(integers[:, 0] - 25_000) > 6_000]
    write(plain, integers)
    write_classified(plain, remote, np.ones(len(integers), np.uint8))
    bare_earth.classify(remote, tmp_path / "done" / "a.laz", **NEAR)
    box = (ORIGIN[0] + 110, ORIGIN[1] + 10, ORIGIN[0] + 390, ORIGIN[1] + 90)
    with serving() as server:
        address = server.add(remote.name, remote.read_bytes())
        blocks = arrays.blocks(f"{address}?sig=s3cr3t", extent=box, **NEAR)
        planned = len(server.asked)
        assert planned <= 2 and len(blocks) == 3
        assert "s3cr3t" not in repr(blocks)
        tables = [block() for block in blocks]
        assert len(server.asked) > planned and not len(tables[1]["X"])
        again = len(server.asked)
        blocks[0]()
        assert len(server.asked) <= again + 1  # it is in the cache
    wanted = rows_of(tmp_path / "done")
    west, south, east, north = blocks[0].extent[:2] + blocks[-1].extent[2:]
    inside = (wanted[:, 0] >= west) & (wanted[:, 0] < east)
    inside &= (wanted[:, 1] >= south) & (wanted[:, 1] < north)
    assert np.array_equal(rows(*tables), wanted[inside]) and inside.sum() > 5_000


def joined_to_files(blocks):
    """Join points to the records of their files, by Source and Index; return which were met."""
    met = {}
    for block in blocks:
        table = block()
        assert {*np.unique(table["Source"])} <= {*range(len(block.sources))}
        for number, path in enumerate(block.paths()):
            mine = table["Source"] == number
            if mine.any():
                las, index = laspy.read(str(path)), table["Index"][mine]
                for name, axis in zip("XYZ", "xyz"):
                    assert np.array_equal(np.asarray(las[axis])[index], table[name][mine])
                met.setdefault(block.sources[number], []).append(index)
    return {source: np.sort(np.concatenate(indices)) for source, indices in met.items()}


@pytest.mark.rest
@pytest.mark.parametrize("classified", [False, True])
def test_points_of_blocks_know_their_file_and_their_place_in_it(survey, small_blocks, classified):
    folder = survey / ("done" if classified else "raw")
    met = joined_to_files(arrays.blocks(folder, classified=classified, **NEAR))
    assert sorted(met) == [str(folder / "a.laz"), str(folder / "b.laz")]
    for source, indices in met.items():
        assert np.array_equal(indices, np.arange(laspy.read(source).header.point_count))


@pytest.mark.rest
def test_so_do_those_of_copc_files_here_and_elsewhere(survey, small_blocks, tmp_path, monkeypatch):
    monkeypatch.setenv("BARE_EARTH_CACHE", str(tmp_path / "cache"))
    plain, copc = write(tmp_path / "a.las", strip(60_000, 600.0)), tmp_path / "a.copc.laz"
    write_classified(plain, copc, np.ones(60_000, np.uint8))
    blocks = arrays.blocks(copc, **NEAR)
    assert len(blocks) > 5
    assert np.array_equal(joined_to_files(blocks)[str(copc)], np.arange(60_000))
    with serving() as server:
        address = server.add(copc.name, copc.read_bytes())
        met = joined_to_files(arrays.blocks(address, **NEAR)[:2])
    assert list(met) == [address]


def test_errors_are_sentences(survey, small_blocks, tmp_path):
    blocks = arrays.blocks(survey / "raw", **NEAR)
    with pytest.raises(bare_earth.BareEarthError, match="their own ground"):
        arrays.terrain(blocks, ground=[True])
    with pytest.raises(bare_earth.BareEarthError, match="heights of all points"):
        arrays.terrain(blocks, breaklines=[np.array([(0.0, 0.0, 1.0), (9.0, 9.0, 1.0)])])
    with pytest.raises(bare_earth.BareEarthError, match="No block"):
        arrays.blocks(survey / "raw", extent=(0, 0, 9, 9))
    with pytest.raises(bare_earth.BareEarthError, match=r"only terrain\(\)"):
        arrays.heights(blocks)
    (tmp_path / "a.laz").write_bytes((survey / "raw" / "a.laz").read_bytes())
    (tmp_path / "b.laz").write_bytes(b"LASF")
    with pytest.raises(bare_earth.BareEarthError, match=r"b\.laz"):
        arrays.blocks(tmp_path)
