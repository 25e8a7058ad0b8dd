"""The command that OpenDroneMap calls in place of PDAL's SMRF."""

import os
import re
import shlex
import subprocess
from pathlib import Path

import laspy
import numpy as np
import pytest
from runs import command, environment, said

from bare_earth.algorithms.filters.smrf import SmrfValues
from bare_earth.algorithms.filters.tin import PRESETS, TinDensification
from benchmarks.scenes import make

PAGE = Path(__file__).parents[2] / "docs" / "odm.md"


@pytest.fixture(scope="module")
def scene():
    return make("drone_images", seed=4, size=24.0, density=60.0)


@pytest.fixture
def cloud(scene, tmp_path):
    """Write the points as OpenDroneMap does, with classes of an earlier run."""
    header = laspy.LasHeader(point_format=7, version="1.4")
    header.scales, header.offsets = (0.001,) * 3, (1000.0, 2000.0, 0.0)
    las = laspy.LasData(header)
    las.x, las.y, las.z = scene.points
    las.return_number[:] = las.number_of_returns[:] = 1
    las.red[:] = np.arange(len(las.x)) % 65536
    las.classification[:] = np.arange(len(las.x)) % 7
    las.classification[::50], las.classification[1::50] = 7, 64
    path = tmp_path / "odm georeferenced.laz"
    las.write(str(path))
    return path


def check_points(path, before, scene):
    """Assert that points are the same, and that classes are those of a good filter."""
    after = laspy.read(path)
    for name in ("X", "Y", "Z", "red", "return_number"):
        np.testing.assert_array_equal(after[name], before[name])
    noise = np.asarray(before.classification) == 7
    classes = np.asarray(after.classification)
    assert (classes[noise] == 7).all() and set(classes[~noise]) == {1, 2}
    assert (classes[scene.ground & ~noise] == 2).mean() > 0.97
    assert (classes[~scene.ground & ~noise] == 1).mean() > 0.9


def test_the_function_of_the_page_classifies_a_cloud_in_place(cloud, scene):
    before, called = laspy.read(cloud), []
    code = re.search(
        r"```python\n(def run_pdaltranslate_smrf.+?)```", PAGE.read_text("utf-8"), re.S
    )

    class System:
        """As `opendm.system`, whose commands are run by a shell."""

        @staticmethod
        def run(words):
            called.append(shlex.split(words))

    names = {"system": System, "double_quote": lambda text: f'"{text}"'}
    exec(code[1], names)
    path = str(cloud)
    names["run_pdaltranslate_smrf"](path, path, 1.25, 0.15, 0.5, 18.0)
    words = called[0][called[0].index("odm") :]
    assert words[1:3] == [path, path] and "--window" in words
    done = subprocess.run(command(*words), env=environment(), capture_output=True, check=False)
    assert done.returncode == 0, done.stderr
    check_points(cloud, before, scene)
    assert os.listdir(cloud.parent) == [cloud.name]


def test_a_file_that_cannot_be_classified_stays_as_it_is(cloud):
    cloud.write_bytes(cloud.read_bytes()[:400])
    before = cloud.read_bytes()
    code, _, errors = said("odm", cloud, cloud)
    assert code == 1 and errors.count("bare-earth: ") == 1
    assert cloud.read_bytes() == before and os.listdir(cloud.parent) == [cloud.name]


def test_another_output_leaves_the_input_alone(cloud, scene, tmp_path):
    before = cloud.read_bytes()
    out = tmp_path / "ground.las"
    code, printed, _ = said("odm", cloud, out, "--preset", "site", "--json")
    assert code == 0 and '"ground_count"' in printed
    assert cloud.read_bytes() == before
    check_points(out, laspy.read(cloud), scene)


@pytest.mark.parametrize("preset", [name for name in PRESETS if name != "lidar360"])
def test_the_defaults_of_opendronemap_are_those_of_the_preset(preset):
    found, preset_values = SmrfValues(preset=preset).as_tin(), PRESETS[preset]
    assert found.max_building_size == 36.0
    assert found.iteration_angle == pytest.approx(preset_values.iteration_angle)
    for name in ("ground_tolerance", "ground_tolerance_below", "slope_tolerance"):
        assert getattr(found, name) == pytest.approx(getattr(TinDensification(), name))


def test_values_of_smrf_change_what_acts_alike():
    usual = SmrfValues().as_tin()
    found = SmrfValues(scalar=2.5, slope=0.3, threshold=1.0, window=10.0).as_tin()
    assert found.max_building_size == 20.0
    assert found.iteration_angle == pytest.approx(2 * usual.iteration_angle)
    for name in ("ground_tolerance", "ground_tolerance_below", "slope_tolerance"):
        assert getattr(found, name) == pytest.approx(2 * getattr(usual, name))
    steep = SmrfValues(slope=5.0, threshold=50.0, scalar=100.0).as_tin()
    assert steep.iteration_angle == 90.0 and steep.slope_tolerance == 10.0
