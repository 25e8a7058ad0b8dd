"""No output of any command or function changes by accident."""

import contextlib
import json
import os
import sqlite3
import subprocess
import sys

import laspy
import numpy as np
import pytest

from bare_earth import __version__
from bare_earth.algorithms.library import names

pytest.importorskip("rasterio")
pytest.importorskip("pyogrio")

from benchmarks.goldens.agreed import AGREED, ROOT, differences, read, write
from benchmarks.goldens.commands import COMMANDS
from benchmarks.goldens.digests import digest, of_text
from benchmarks.goldens.functions import FUNCTIONS
from benchmarks.goldens.processors import LEVELS, environment
from benchmarks.goldens.running import command_names, of_everything

# What other instructions of a processor may do to a number.
_LAST_BITS = 4 * 2.0**-24


@pytest.fixture(scope="module")
def outputs(tmp_path_factory):
    """All outputs, and their digests."""
    folder = tmp_path_factory.mktemp("goldens")
    return folder, of_everything(folder)


@pytest.mark.rest
@pytest.mark.skipif(os.name == "nt", reason="messages have other slashes there")
def test_no_output_changes_by_accident(outputs):
    wrong = [*differences(read(AGREED), outputs[1])]
    assert not wrong, (
        "Outputs are not as agreed. If they changed on purpose, write their digests anew by"
        " 'python -m benchmarks.goldens --write', and say why in the message of the commit:\n"
        + "\n".join(wrong)
    )


@pytest.mark.long
@pytest.mark.skipif(os.name == "nt", reason="messages have other slashes there")
@pytest.mark.parametrize("level", LEVELS)
def test_no_output_changes_on_other_processors(level):
    limits = environment(level)
    if not limits:
        pytest.skip(f"this processor, or NumPy, computes {level} anyway")
    test = f"{__file__}::{test_no_output_changes_by_accident.__name__}"
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-m", "rest", test]
    found = subprocess.run(
        command, cwd=ROOT, env={**os.environ, **limits}, capture_output=True, text=True
    )
    assert found.returncode == 0 and "1 passed" in found.stdout, found.stdout


def _moved(values, random, share, by):
    """Return numbers that moved by up to a share of them, and one of them that moved by more."""
    values = np.array(values)
    moved = values * (1.0 + random.uniform(-share, share, values.shape))
    is_known = np.isfinite(values) & (np.abs(values) < 9e3)
    if by and is_known.any():
        moved.flat[random.choice(np.flatnonzero(is_known))] += by
    return np.where(is_known, moved, values).astype(values.dtype)


def _move_raster(path, *how):
    import rasterio

    with rasterio.open(path, "r+", IGNORE_COG_LAYOUT_BREAK="YES") as raster:
        is_measured = raster.dtypes[0] == "float32"
        if is_measured:
            raster.write(_moved(raster.read(), *how))
    return is_measured


def _move_points(path, *how):
    cloud = laspy.read(path)
    names = {*cloud.point_format.dimension_names} & {"HeightAboveGround"}
    for name in names:
        cloud[name] = _moved(cloud[name], *how)
        cloud.write(path)
    return bool(names)


def _move_features(path, *how):
    found = False
    with contextlib.closing(sqlite3.connect(path)) as base:
        for (name,) in base.execute(
            "SELECT name FROM sqlite_master WHERE type = 'trigger'"
        ).fetchall():
            base.execute(f'DROP TRIGGER "{name}"')  # these call functions of GDAL
        for (table,) in base.execute("SELECT table_name FROM gpkg_geometry_columns").fetchall():
            columns = base.execute(f'PRAGMA table_info("{table}")').fetchall()
            for name in [name for _, name, kind, *_ in columns if kind in ("REAL", "DOUBLE")]:
                rows = base.execute(
                    f'SELECT fid, "{name}" FROM "{table}" WHERE "{name}" NOT NULL'
                ).fetchall()
                found |= bool(rows)
                for (number, _), value in zip(rows, _moved([row[1] for row in rows], *how)):
                    values = (float(value), number)
                    base.execute(f'UPDATE "{table}" SET "{name}" = ? WHERE fid = ?', values)
        base.commit()
    return found


@pytest.mark.rest
@pytest.mark.skipif(os.name == "nt", reason="sqlite keeps its files open there")
def test_last_bits_of_no_output_count_and_two_millimetres_of_any_do(outputs):
    folder, random = outputs[0], np.random.default_rng(3)
    ways = {".tif": _move_raster, ".laz": _move_points, ".gpkg": _move_features}
    files = [
        path
        for path in sorted(folder.rglob("*"))
        if path.suffix in ways and ".copc" not in path.name
    ]
    files = [path for path in files if path.parent.parent != folder or "raw" not in path.name]
    before, seen = {}, 0
    for share, by in ((0.0, 0.0), (_LAST_BITS, 0.0), (_LAST_BITS, 0.002)):
        for path in files:
            if ways[path.suffix](path, random, share, by):
                # The first time only as others write the file, and laspy the header.
                found = digest(path, folder).partition(", header")[0]
                wrong = [*differences({"a": before.setdefault(path, found)}, {"a": found})]
                assert bool(wrong) == bool(by), (path, wrong)
                seen += 1
    assert seen > 200


def test_all_commands_and_functions_are_run():
    assert {words.split()[0] for words in COMMANDS.values()} == {*command_names()}
    assert {*FUNCTIONS} == {*names()}


def test_a_point_cloud_says_which_part_of_it_changed(las, tmp_path):
    path = las.make("a.laz", version=4, point_format=6)
    cloud, before = laspy.read(path), digest(path, tmp_path)
    cloud.write(tmp_path / "packed.las")
    cloud.classification[3] ^= 1
    cloud.write(tmp_path / "classes.laz")
    cloud.gps_time[3] += 1.0
    cloud.write(tmp_path / "times.laz")
    files = ("packed.las", "classes.laz", "times.laz")
    packed, classes, times = (digest(tmp_path / name, tmp_path) for name in files)
    changed = [*differences({"a": packed, "b": classes}, {"a": classes, "b": times})]
    assert changed == ["changed  a: classes", "changed  b: others"]
    assert before.split(", ")[:3] == packed.split(", ")[:3]  # but laspy mends the header


def test_a_raster_says_which_squares_changed_and_by_how_much(tmp_path):
    import rasterio

    def of(values, **about):
        rows, columns = values.shape
        profile = dict(driver="GTiff", width=columns, height=rows, count=1, dtype=values.dtype)
        place = rasterio.Affine(1, 0, 5, 0, -1, 7)
        with rasterio.open(tmp_path / "a.tif", "w", transform=place, **profile, **about) as raster:
            raster.write(values[None])
        return {"a": digest(tmp_path / "a.tif", tmp_path)}

    # At the edges of all ways of rounding, and beside no data.
    heights = (100.0 + np.arange(400.0).reshape(20, 20) / 8000).astype(np.float32)
    heights[0, :3] = -9999.0
    before = of(heights, nodata=-9999)
    up = np.where(heights > 0, heights + 2 * np.spacing(heights), heights)
    assert not [*differences(before, of(up, nodata=-9999, compress="lzw"))]
    for row, column, by in ((7, 19, 0.002), (0, 0, 9999.0), (3, 3, np.nan)):
        changed = heights.copy()
        changed[row, column] += by
        (line,) = differences(before, of(changed, nodata=-9999))
        assert line.startswith(f"changed  a: cells (1 of groups of 16: {row // 6}/{column // 6} by")
    assert [*differences(before, of(heights, nodata=0))] == ["changed  a: about"]
    labels = (heights > 100.02).astype(np.uint8)
    assert [*differences(of(labels), of(labels ^ (up > 100.049)))] == ["changed  a: labels"]


@pytest.mark.parametrize(
    ("agreed", "found", "wrong"),
    [
        ("Mean \u22120.01 m of 17 points", "Mean 0.00 m of 17 points", ""),
        (
            "1,234.5 m\u00b2, 1.995 m",
            "1,234.6 m\u00b2, 2.004 m",
            " numbers (1 of 2: 1.995 is 2.004)",
        ),
        ("1.5 m", "1.50 m", " numbers (1 of 1: 1.5 is 1.50)"),
        ("0.5 m of 17 points", "0.5 m of 18 points", ""),
        ('{"rmse": 1.141, "n": 4}', '{"rmse": 1.14, "n": 4}', ""),
        ('{"rmse": 1.141, "n": 4}', '{"rmse": 1.143, "n": 4}', " values (1 of 1: 1.141 is 1.143)"),
        ('{"share": 0.01656}', '{"share": 0.01659}', " values (1 of 1: 0.01656 is 0.01659)"),
        ('{"y": 5932457.12345678}', '{"y": 5932457.12345679}', ""),
    ],
)
def test_words_and_counts_are_compared_exactly_and_numbers_to_the_last_place(
    agreed, found, wrong, tmp_path
):
    of = [{"a": of_text(text, tmp_path)} for text in (agreed, found)]
    is_count = "points" in agreed and "18" in found
    expected = ["changed  a"] if is_count else [f"changed  a:{wrong}"] if wrong else []
    assert [*differences(*of)] == expected


@pytest.mark.parametrize("suffix", [".html", ".json"])
def test_dates_paths_and_versions_of_texts_do_not_count(tmp_path, suffix):
    def of(folder, **changes):
        known = {"height": 12.3456, "at": "2026-11-26", "took": "1.2 s", "file": f"{folder}/a.las"}
        known.update({"made by": f"Bare Earth {__version__}", "count": 17, **changes})
        folder.mkdir(exist_ok=True)
        (folder / f"a{suffix}").write_text(json.dumps(known), encoding="utf-8")
        return digest(folder / f"a{suffix}", folder)

    before = {"a": of(tmp_path)}
    assert not [*differences(before, {"a": of(tmp_path / "b", at="2027-01-02", took="13 s")})]
    for changes in ({"count": 18}, {"height": 12.3476}):
        assert [*differences(before, {"a": of(tmp_path, **changes)})]


def test_differences_are_written_and_named(tmp_path):
    path, digests = tmp_path / "agreed.json", {"b/a.laz": "classes 1, header 2", "a": "3"}
    assert [*differences(read(path), digests)] == ["new      a", "new      b/a.laz"]
    write(path, digests)
    assert read(path) == digests and path.read_text().count("\n") == len(digests) + 2
    assert [*differences(digests, {"b/a.laz": "classes 1, header 5"})] == [
        "missing  a", "changed  b/a.laz: header",
    ]  # fmt: skip
