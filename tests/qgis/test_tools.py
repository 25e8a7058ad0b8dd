"""A tool for points that is declared is in the toolbox, and runs."""

import laspy
import numpy as np
import pytest
from support import Scene
from toy_tool import TOOL, add_toy

ID = f"bareearth:{TOOL.identifier}"


@pytest.fixture
def provider(registry, monkeypatch):
    provider = registry.providerById("bareearth")
    add_toy(monkeypatch)
    provider.refreshAlgorithms()
    yield provider
    monkeypatch.undo()
    provider.refreshAlgorithms()


def test_a_new_tool_is_in_the_toolbox_with_its_help(registry, provider):
    algorithm = registry.createAlgorithmById(ID)
    assert (algorithm.displayName(), algorithm.group()) == (TOOL.title, "Products")
    assert algorithm.shortDescription() == TOOL.line and "toy" in algorithm.tags()
    names = [definition.name() for definition in algorithm.parameterDefinitions()]
    assert names[:2] == ["INPUT", "CRS"] and names[-1] == "OUTPUT"
    assert {"NEW_CLASS", "GROUND_CLASSES", "THREADS"} <= set(names)
    assert [definition.name() for definition in algorithm.outputDefinitions()][1:] == [
        "POINT_COUNT",
        "NEW_COUNT",
    ]
    text = algorithm.shortHelpString()
    assert text.startswith(TOOL.help) and "The class that ground points get." in text


def test_a_new_tool_runs(registry, provider, scene, tmp_path):
    import processing

    scene.with_classes(scene.path)
    values = {"INPUT": str(scene.path), "NEW_CLASS": 40, "OUTPUT": str(tmp_path / "new.las")}
    results = processing.run(ID, values)
    assert results["NEW_COUNT"] == np.count_nonzero(scene.ground)
    found = np.asarray(laspy.read(results["OUTPUT"]).classification)
    assert np.array_equal(found == 40, scene.ground)


def test_without_it_the_toolbox_is_as_before(registry):
    assert registry.createAlgorithmById(ID) is None


def test_a_check_of_other_values_leaves_a_prepared_run_alone(
    registry, scene, tmp_path, context, log
):
    other = Scene(tmp_path, ".las")
    scene.with_classes(scene.path)
    values = {"INPUT": str(scene.path), "OUTPUT": str(tmp_path / "heights.laz")}
    algorithm = registry.createAlgorithmById("bareearth:heightaboveground")
    assert algorithm.prepare(values, context, log)
    others = {"INPUT": str(other.path), "OUTPUT": str(tmp_path / "others.laz")}
    assert algorithm.checkParameterValues(others, context)[0]
    results = algorithm.runPrepared(values, context, log)
    assert results["OUTPUT"] == values["OUTPUT"]
    assert f"{scene.path} {values['OUTPUT']}" in log.text and "scene.las" not in log.text
