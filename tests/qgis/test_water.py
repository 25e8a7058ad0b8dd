import laspy
import numpy as np
import pytest
from qgis.core import QgsProject
from support import write_scene

ALGORITHM = "bareearth:water"


@pytest.fixture
def cloud(tmp_path):
    """A basin with a lake of 0.9 ha at 50 m, without any point on it."""
    write_scene(tmp_path / "scene.las")  # for its CRS
    header = laspy.read(tmp_path / "scene.las").header
    las = laspy.LasData(header)
    random = np.random.default_rng(1)
    x, y = random.uniform(0, 200, (2, 160_000))
    far = np.hypot(x - 100, y - 100)
    x, y, far = (each[far > 54] for each in (x, y, far))
    las.points = laspy.ScaleAwarePointRecord.zeros(len(x), header=header)
    las.x, las.y = x + 500_000, y + 5_700_000
    las.z = 50 + 0.2 * (far - 54) + random.normal(0, 0.02, len(x))
    las.classification[:] = 2
    las.return_number[:] = las.number_of_returns[:] = 1
    las.write(str(tmp_path / "in.las"))
    return tmp_path / "in.las"


def test_a_lake_is_found_and_drawn_in_blue(registry, cloud, tmp_path):
    import processing

    outputs = {name: str(tmp_path / f"{name}.gpkg") for name in ("OUTPUT", "BREAKLINES")}
    results = processing.runAndLoadResults(ALGORITHM, {"INPUT": str(cloud), **outputs})
    assert results["LAKES"] == 1 and results["RIVERS"] == 0
    assert results["AREA"] == pytest.approx(np.pi * 54**2, rel=0.03)
    layers = {each.name(): each for each in QgsProject.instance().mapLayers().values()}
    (water,) = layers["Water"].getFeatures()
    assert water["LEVEL"] == pytest.approx(50.1, abs=0.15) and water["GRADE"] == "certain"
    assert water.geometry().area() == pytest.approx(results["AREA"], rel=0.02)
    rules = layers["Water"].renderer().rootRule().children()
    assert [each.label() for each in rules] == ["Certain", "Likely", "Doubtful"]
    (line,) = layers["Breaklines"].getFeatures()
    assert line.geometry().constGet().is3D() and line["KIND"] == "shore"
    assert line.geometry().constGet().pointN(0).z() == pytest.approx(water["LEVEL"], abs=0.002)
    QgsProject.instance().clear()
