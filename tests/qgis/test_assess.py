import shlex

import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import QgsProcessingException
from support import Log

ALGORITHM = "bareearth:assess"


@pytest.fixture
def files(scene, tmp_path):
    """The scene with its true classes, and one in which every tenth point of the ground is lost."""
    truth = laspy.read(scene.path)
    truth.classification = np.where(scene.ground, 2, 6)
    truth.write(str(tmp_path / "truth.laz"))
    lost = scene.ground & (np.cumsum(scene.ground) % 10 == 0)
    truth.classification = np.where(scene.ground & ~lost, 2, 1)
    truth.write(str(tmp_path / "found.laz"))
    return str(tmp_path / "found.laz"), str(tmp_path / "truth.laz"), int(lost.sum())


def test_run(registry, files, scene, tmp_path, context, log):
    from bare_earth.algorithms.cli import main

    found, truth, lost = files
    parameters = {
        "CLASSIFIED": found, "REFERENCE": truth, "IGNORED_CLASSES": "7, 18", "MAP_CELL_SIZE": 5,
        "REPORT": str(tmp_path / "report.html"), "ERROR_MAP": str(tmp_path / "errors.tif"),
    }  # fmt: skip
    algorithm = registry.createAlgorithmById(ALGORITHM)
    results, done = algorithm.run(parameters, context, log)
    assert done, log.text
    assert results["POINT_COUNT"] == scene.count
    assert results["TYPE_1_ERROR"] == pytest.approx(100 * lost / scene.ground_count)
    assert results["TYPE_2_ERROR"] == 0 and 0 < results["KAPPA"] < 100
    page = (tmp_path / "report.html").read_bytes()
    assert b"data:image/png;base64," in page and results["REPORT"].endswith("report.html")
    errors = gdal.Open(results["ERROR_MAP"])
    assert errors.GetGeoTransform()[1] == 5 and "25832" in errors.GetProjection()
    assert errors.ReadAsArray().max() == pytest.approx(0.1, abs=0.05)
    assert "kappa" in log.text
    # The command line in the log writes the same report.
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    (tmp_path / "report.html").unlink()
    assert main(command[1:]) == 0
    assert (tmp_path / "report.html").read_bytes() == page


def test_defaults_and_empty_outputs(files, tmp_path):
    import processing

    results = processing.run(ALGORITHM, {"CLASSIFIED": files[0], "REFERENCE": files[1]})
    assert results["TOTAL_ERROR"] > 0
    assert "ERROR_MAP" not in results and "REPORT" not in results
    results = processing.run(
        ALGORITHM, {"CLASSIFIED": files[0], "REFERENCE": files[1], "REPORT": "TEMPORARY_OUTPUT"}
    )
    assert results["REPORT"].endswith(".html")


def test_cancel_leaves_nothing(registry, files, tmp_path, context):
    (tmp_path / "out").mkdir()
    parameters = {
        "CLASSIFIED": files[0], "REFERENCE": files[1],
        "REPORT": str(tmp_path / "out" / "r.html"), "ERROR_MAP": str(tmp_path / "out" / "e.tif"),
    }  # fmt: skip
    for percent in (1, 70, 80, 90):
        algorithm = registry.createAlgorithmById(ALGORITHM)
        assert algorithm.run(parameters, context, Log(cancel_at=percent))[0] == {}
        assert list((tmp_path / "out").iterdir()) == []


def test_a_figure_without_points_is_left_out(files, scene, tmp_path):
    import processing

    parameters = {"CLASSIFIED": files[0], "REFERENCE": files[1], "IGNORED_CLASSES": [6]}
    results = processing.run(ALGORITHM, parameters)
    assert results["POINT_COUNT"] == scene.ground_count
    assert "TYPE_2_ERROR" not in results


def test_errors_are_one_line(files, scene, tmp_path):
    import processing

    missing = {"CLASSIFIED": files[0], "REFERENCE": str(tmp_path / "missing.laz")}
    with pytest.raises(QgsProcessingException, match=r"missing\.laz .*not exist"):
        processing.run(ALGORITHM, missing)
    moved = laspy.read(files[0])
    moved.x = np.asarray(moved.x) + 0.07
    moved.write(str(tmp_path / "moved.laz"))
    with pytest.raises(QgsProcessingException, match="same points"):
        processing.run(
            ALGORITHM, {"CLASSIFIED": str(tmp_path / "moved.laz"), "REFERENCE": files[1]}
        )


def test_a_clip_is_assessed_against_the_whole(files, scene, tmp_path):
    import processing

    clip = laspy.read(files[0])
    clip.points = clip.points[1000:4000]
    clip.write(str(tmp_path / "clip.laz"))
    results = processing.run(
        ALGORITHM, {"CLASSIFIED": str(tmp_path / "clip.laz"), "REFERENCE": files[1]}
    )
    assert (results["POINT_COUNT"], results["CLASSIFIED_ONLY"]) == (3000, 0)
    assert results["REFERENCE_ONLY"] == scene.count - 3000
