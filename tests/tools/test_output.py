"""Ground points only and heights above ground, in the run that classifies."""

import struct

import laspy
import numpy as np
import pytest
from las_files import EVERY
from matrices import covering

import bare_earth
from bare_earth import BareEarthError
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.las.edits import Edits
from bare_earth.algorithms.las.extrabytes import ExtraDimension
from bare_earth.algorithms.las.writing import write_changed
from bare_earth.algorithms.tools.heights import HEIGHT_DIMENSION


def masked(count=60):
    return np.random.default_rng(3).random(count) < 0.4


def returns_of(records, point_format):
    bits = 0x0F if point_format >= 6 else 0x07
    return np.bincount(records[:, 14] & bits, minlength=16)[1:16].tolist()


@pytest.mark.parametrize(("layout", "suffix"), covering(EVERY, ["las", "laz"]))
def test_of_the_points_that_are_kept_nothing_is_lost(las, layout, suffix):
    version, point_format = layout
    behind = [las.evlr(b"behind", 9, b"the points")] if version == 4 else ()
    source = las.make(
        f"in.{suffix}", version=version, point_format=point_format, extra=3, evlrs=behind,
        vlrs=[las.vlr(b"somebody", 7, b"else's data")],
    )  # fmt: skip
    target, kept = las.folder / f"out.{suffix}", masked()
    write_changed(source, target, Edits(kept=kept))
    before, after = las.split(source), las.split(target)
    assert np.array_equal(after.records, before.records[kept])
    # The record on the compression tells of the version of who compressed.
    assert after.vlrs[0] == before.vlrs[0] and len(after.vlrs) == len(before.vlrs)
    assert after.padding == before.padding
    if version == 4:
        assert after.tail == before.tail == behind[0]
        assert after.field("Q", 247) == kept.sum()
        counts = list(struct.unpack_from("<15Q", after.header, 255))
        assert counts == returns_of(after.records, point_format)
    legacy = version < 4 or point_format < 6
    assert after.field("I", 107) == (kept.sum() if legacy else 0)
    old = returns_of(after.records, point_format)[:5]
    assert list(struct.unpack_from("<5I", after.header, 111)) == (old if legacy else [0] * 5)
    xyz = np.ascontiguousarray(after.records[:, :12]).view("<i4") * las.SCALE + las.OFFSET
    extent = np.column_stack((xyz.max(axis=0), xyz.min(axis=0))).ravel()
    assert np.allclose(struct.unpack_from("<6d", after.header, 179), extent, rtol=0, atol=1e-6)
    assert after.header[:96] == before.header[:96]
    assert after.header[131:179] == before.header[131:179]


@pytest.mark.parametrize("suffix", ["las", "laz", "copc.laz"])
def test_other_programs_read_the_points_that_are_kept(las, suffix):
    source = las.make("in.laz", version=4, point_format=7, count=3000)
    kept, heights = masked(3000), np.arange(3000, dtype=np.float32)
    target = las.folder / f"out.{suffix}"
    extra = ExtraDimension("Height", "above something", heights)
    write_changed(source, target, Edits(kept=kept, extra=extra))
    before, after = laspy.read(source), laspy.read(target)
    assert len(after.points) == after.header.point_count == kept.sum()
    places = np.argsort(after["Height"])
    assert np.array_equal(after["Height"][places], heights[kept])
    for name in ("X", "Y", "Z", "intensity", "classification", "gps_time", "red"):
        assert np.array_equal(
            np.asarray(after[name])[places], np.asarray(before[name])[kept], equal_nan=True
        ), name
    assert np.allclose(after.header.mins, after.xyz.min(axis=0))
    assert np.allclose(after.header.maxs, after.xyz.max(axis=0))
    # What the file says of the range of the dimension is that of the points in it.
    record = next(record for record in after.vlrs if record.record_id == 4).record_data_bytes()
    assert struct.unpack_from("<d16xd", record, 64) == (heights[kept].min(), heights[kept].max())


def test_nothing_left_to_write_is_told_and_leaves_no_file(las):
    source, target = las.make(), las.folder / "out.las"
    with pytest.raises(BareEarthError, match=r"None of the points of .*in\.las"):
        write_changed(source, target, Edits(kept=np.zeros(60, bool)))
    assert not target.exists()


@pytest.fixture
def hut(las):
    """Return a file of a plane with a flat roof 6 m above it, and which points are the roof."""
    side = np.arange(0.0, 40.0, 0.5)
    x, y = (axis.ravel() for axis in np.meshgrid(side, side))
    roof = (np.abs(x - 20) < 5) & (np.abs(y - 20) < 5)
    records = las.records(6, len(x))
    z = 10 + 0.1 * x + np.where(roof, 6.0, 0.0)
    xyz = np.column_stack((x / 0.01, y / 0.01, z / 0.001)).round().astype("<i4")
    records[:, :12] = xyz.view(np.uint8)
    records[:, 14], records[:, 15], records[:, 16] = 0x11, 0, 1
    return las.make("hut.laz", version=4, point_format=6, records=records), roof


@pytest.mark.rest
def test_heights_are_those_of_the_product(hut, las):
    source, roof = hut
    once, classified, twice = (las.folder / f"{name}.laz" for name in ("once", "first", "twice"))
    bare_earth.classify(source, once, method="grid-minimum", height_above_ground=True)
    bare_earth.classify(source, classified, method="grid-minimum")
    bare_earth.heights(classified, twice)
    assert once.read_bytes() == twice.read_bytes()
    heights = laspy.read(once)[HEIGHT_DIMENSION]
    assert np.allclose(heights[roof], 6.0, atol=0.05)


@pytest.mark.rest
def test_the_command_writes_ground_alone_and_says_how_many_it_left_out(hut, las, capsys):
    source, roof = hut
    whole, alone = las.folder / "whole.laz", las.folder / "alone.laz"
    options = ["--method", "grid-minimum", "--verbose"]
    assert main(["classify", str(source), str(whole), *options]) == 0
    words = ["--ground-only", "--height-above-ground"]
    assert main(["classify", str(source), str(alone), *options, *words]) == 0
    ground = laspy.read(whole).classification == 2
    after = laspy.read(alone)
    assert len(after.points) == ground.sum() and (after.classification == 2).all()
    assert np.array_equal(after.X, laspy.read(whole).X[ground])
    assert np.allclose(after[HEIGHT_DIMENSION], 0.0, atol=1e-3)
    assert f"{(~ground).sum():,} points that are not ground" in capsys.readouterr().err
    summary = bare_earth.classify(source, alone, method="grid-minimum", ground_only=True)
    assert summary.class_counts == {2: ground.sum()}
    assert summary.point_count == len(roof)
