import laspy
import numpy as np
import pytest
from qgis.core import QgsProcessingException
from support import Log

ALGORITHM = "bareearth:quality"


@pytest.fixture
def cloud(scene, tmp_path):
    """The scene with its true classes."""
    las = laspy.read(scene.path)
    las.classification = np.where(scene.ground, 2, 1)
    las.write(str(tmp_path / "ground.laz"))
    return tmp_path / "ground.laz"


def test_run_with_page_and_rasters(registry, cloud, tmp_path, context, log):
    algorithm = registry.createAlgorithmById(ALGORITHM)
    page, folder = tmp_path / "page.html", tmp_path / "rasters"
    parameters = {
        "INPUT": str(cloud), "SPECIFICATION": 2, "PAGE": str(page), "FOLDER": str(folder),
    }  # fmt: skip
    results, ok = algorithm.run(parameters, context, log)
    assert ok, log.text
    assert results["PULSE_DENSITY"] > results["GROUND_DENSITY"] > 0
    assert "Lidar Base Specification, QL2" in page.read_text(encoding="utf-8")
    assert len(list(folder.glob("*.tif"))) == 7
    assert "--specification lbs-ql2" in log.text


def test_a_page_that_is_no_page_is_refused(registry, cloud, tmp_path, context):
    algorithm, log = registry.createAlgorithmById(ALGORITHM), Log()
    parameters = {"INPUT": str(cloud), "PAGE": str(tmp_path / "page.pdf")}
    try:
        _, ok = algorithm.run(parameters, context, log)
    except QgsProcessingException:
        ok = False
    assert not ok and not (tmp_path / "page.pdf").exists()
