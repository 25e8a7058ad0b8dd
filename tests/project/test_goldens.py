"""No output of any command or function changes by accident."""

import json
import os

import laspy
import numpy as np
import pytest

from bare_earth import __version__
from bare_earth.algorithms.library import names

pytest.importorskip("rasterio")
pytest.importorskip("pyogrio")

from benchmarks.goldens.agreed import AGREED, differences, read, write
from benchmarks.goldens.commands import COMMANDS
from benchmarks.goldens.digests import digest
from benchmarks.goldens.functions import FUNCTIONS
from benchmarks.goldens.running import command_names, of_everything


@pytest.mark.skipif(os.name == "nt", reason="messages have other slashes there")
def test_no_output_changes_by_accident(tmp_path):
    wrong = [*differences(read(AGREED), of_everything(tmp_path))]
    assert not wrong, (
        "Outputs are not as agreed. If they changed on purpose, write their digests anew by"
        " 'python -m benchmarks.goldens --write', and say why in the message of the commit:\n"
        + "\n".join(wrong)
    )


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


def test_a_raster_is_compared_to_a_thousandth(tmp_path):
    import rasterio

    def of(name, values, **about):
        values = np.asarray(values, np.float32).reshape(1, 2, 2)
        profile = dict(driver="GTiff", width=2, height=2, count=1, dtype="float32", **about)
        place = rasterio.Affine(1, 0, 5, 0, -1, 7)
        with rasterio.open(tmp_path / name, "w", transform=place, **profile) as raster:
            raster.write(values)
        return digest(tmp_path / name, tmp_path)

    heights = np.array([1.0, 2.5, 3.25, -9999.0])
    before = of("a.tif", heights, nodata=-9999)
    assert before == of("b.tif", heights + 1e-5, nodata=-9999, compress="lzw")
    wrong = (
        of("c.tif", heights + np.eye(4)[0] * 0.002, nodata=-9999),
        of("d.tif", heights, nodata=0),
    )
    lines = [line for found in wrong for line in differences({"a": before}, {"a": found})]
    assert lines == ["changed  a: cells", "changed  a: about"]


@pytest.mark.parametrize("suffix", [".html", ".json"])
def test_dates_paths_and_versions_of_texts_do_not_count(tmp_path, suffix):
    def of(folder, **changes):
        known = {"height": 12.3456, "at": "2026-11-26", "took": "1.2 s", "file": f"{folder}/a.las"}
        known.update({"made by": f"Bare Earth {__version__}", "count": 17, **changes})
        folder.mkdir(exist_ok=True)
        (folder / f"a{suffix}").write_text(json.dumps(known), encoding="utf-8")
        return digest(folder / f"a{suffix}", folder)

    before = of(tmp_path)
    assert before == of(tmp_path / "b", at="2027-01-02", took="13 s")
    assert before != of(tmp_path, count=18) and before != of(tmp_path, height=12.3476)


def test_differences_are_written_and_named(tmp_path):
    path, digests = tmp_path / "agreed.json", {"b/a.laz": "classes 1, header 2", "a": "3"}
    assert [*differences(read(path), digests)] == ["new      a", "new      b/a.laz"]
    write(path, digests)
    assert read(path) == digests and path.read_text().count("\n") == len(digests) + 2
    assert [*differences(digests, {"b/a.laz": "classes 1, header 5"})] == [
        "missing  a", "changed  b/a.laz: header",
    ]  # fmt: skip
