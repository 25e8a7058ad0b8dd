import json
import shlex
from html import unescape
from pathlib import Path

import pytest
from qgis.core import (
    QgsCoordinateReferenceSystem,
    QgsCoordinateTransform,
    QgsProcessingException,
    QgsProcessingOutputHtml,
    QgsProject,
    QgsRectangle,
    QgsReferencedRectangle,
)
from support import Log, write_scene

from bare_earth.algorithms.tools.compare_settings.settings import SETTINGS

ALGORITHM = "bareearth:comparesettings"
WINDOW = QgsRectangle(500_010, 5_700_010, 500_070, 5_700_070)
UTM = QgsCoordinateReferenceSystem.fromEpsgId(25832)


@pytest.fixture
def parameters(scene, tmp_path):
    return {
        "INPUT": str(scene.path), "EXTENT": QgsReferencedRectangle(WINDOW, UTM),
        "SETTINGS": ["slope:town", "tin-densification:automatic"],
        "OUTPUT": str(tmp_path / "page.html"),
    }  # fmt: skip


def test_run(registry, parameters, tmp_path, context, log):
    from bare_earth.algorithms.cli import main

    algorithm = registry.createAlgorithmById(ALGORITHM)
    results, done = algorithm.run(parameters, context, log)
    assert done, log.text
    # What is of this type is offered in the Results Viewer.
    assert isinstance(algorithm.outputDefinition("OUTPUT"), QgsProcessingOutputHtml)
    page = (tmp_path / "page.html").read_bytes()
    assert results["OUTPUT"].endswith("page.html") and b"Slope filter, Town" in page
    # The command line in the log writes the same page.
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    (tmp_path / "page.html").unlink()
    assert main(command[1:]) == 0
    assert (tmp_path / "page.html").read_bytes() == page


def test_without_a_window_the_middle_is_taken(registry, parameters, context, log):
    del parameters["EXTENT"]
    results, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done and Path(results["OUTPUT"]).is_file(), log.text
    # The scene is smaller than the window.
    (told,) = (text for text in log.said if text.startswith("Chosen automatically: window"))
    assert "x 500000.249 to 500079.751" in told
    command = next(text for text in log.said if text.startswith("bare-earth "))
    assert "--extent" not in command


def test_qgis_process_needs_no_window(qgis_process, parameters, tmp_path):
    words = f"INPUT={parameters['INPUT']}", f"OUTPUT={tmp_path / 'p.html'}", "SETTINGS=slope:town"
    done = qgis_process("run", ALGORITHM, "--", *words)
    assert done.returncode == 0 and (tmp_path / "p.html").is_file(), done.stderr


def test_the_order_of_the_parameters_is_that_of_the_dialog_only(
    registry, parameters, context, log, monkeypatch
):
    algorithm = registry.createAlgorithmById(ALGORITHM)
    sets = algorithm.parameter_sets()
    assert len(sets) > 1
    monkeypatch.setattr(type(algorithm), "parameter_sets", lambda self: sets[::-1])
    results, done = algorithm.create().run(parameters, context, log)
    assert done and Path(results["OUTPUT"]).is_file(), log.text


def test_the_window_is_transformed_to_the_crs_of_the_points(
    registry, parameters, tmp_path, context, log
):
    web = QgsCoordinateReferenceSystem.fromEpsgId(3857)
    transform = QgsCoordinateTransform(UTM, web, QgsProject.instance())
    box = transform.transformBoundingBox(WINDOW)
    parameters["EXTENT"] = QgsReferencedRectangle(box, web)
    _, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    command = next(shlex.split(line) for line in log.said if line.startswith("bare-earth "))
    extent = [float(value) for value in command[command.index("--extent") + 1 :][:4]]
    assert extent == pytest.approx([500_010, 5_700_010, 500_070, 5_700_070], abs=2)


NUMBERS = [list(SETTINGS).index(name) for name in ("slope:town", "slope:flat")]


@pytest.mark.parametrize(
    "given", ["slope:town,slope:flat", ["slope:town", "slope:flat"], NUMBERS], ids=str
)
def test_settings_are_names_or_numbers_of_the_list(registry, parameters, context, log, given):
    parameters["SETTINGS"] = given
    _, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    assert "slope:town" in log.text and "slope:flat" in log.text


def test_a_folder_is_one_survey_and_the_page_runs_as_it_says(parameters, tmp_path):
    import processing

    folder = tmp_path / "tiles"
    folder.mkdir()
    write_scene(folder / "west.laz")
    write_scene(folder / "east.laz", origin=(500_080.0, 5_700_000.0))
    parameters["INPUT"] = str(folder)
    parameters["EXTENT"] = QgsRectangle(500_050, 5_700_010, 500_110, 5_700_070)
    parameters["SETTINGS"] = ["slope:town"]
    made = processing.run(ALGORITHM, parameters)["OUTPUT"]
    page = unescape(Path(made).read_text(encoding="utf-8"))
    call = page.partition("processing.run(")[2].partition(")</pre>")[0]
    name, _, given = call.partition(", ")
    results = processing.run(name.strip("'"), json.loads(given.replace("'", '"')))
    assert results["TILE_COUNT"] == 2 and results["GROUND_COUNT"] > 0


def test_errors_are_one_line_and_a_cancel_leaves_nothing(registry, parameters, tmp_path, context):
    import processing

    with pytest.raises(QgsProcessingException, match="at most 1,000 m"):
        far = QgsReferencedRectangle(QgsRectangle(5e5, 57e5, 502_000, 5_702_000), UTM)
        processing.run(ALGORITHM, {**parameters, "EXTENT": far})
    with pytest.raises(QgsProcessingException, match=r"Settings .* one of"):
        processing.run(ALGORITHM, {**parameters, "SETTINGS": ["slope:moon"]})
    algorithm = registry.createAlgorithmById(ALGORITHM)
    assert algorithm.run(parameters, context, Log(cancel_at=50))[0] == {}
    assert not (tmp_path / "page.html").exists()
