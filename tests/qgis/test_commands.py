"""The commands at the end of the log run as they stand, and write the same outputs."""

import shlex
import shutil
from pathlib import Path

import pytest
from qgis.core import QgsApplication
from support import Log

from benchmarks.goldens.dialogs import RUNS, placed
from benchmarks.goldens.inputs import write_inputs
from benchmarks.goldens.running import said_by, working_in

ENDINGS = {
    "rasterDestination": ".tif", "vectorDestination": ".gpkg", "pointCloudDestination": ".laz",
    "folderDestination": "", "fileDestination": ".html",
}  # fmt: skip
# Layers of files, which the commands read.
MORE = {"terrain-in-one-step": {
    "BOUNDARY": "boundary.geojson", "WATER": "water.geojson", "CORRECTIONS": "corrections.geojson",
}}  # fmt: skip
# Models log the commands of their steps, whose files are temporary.
NAMES = [name for name in RUNS if not name.endswith("-model")]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("goldens")
    write_inputs(folder)
    return folder


def parameters_of(name, folder):
    """Return the parameters of a run, with all outputs of the dialog."""
    algorithm, given = RUNS[name]
    given = {**given, **MORE.get(name, {})}
    parameters = {key: placed(value, folder, name) for key, value in given.items()}
    found = QgsApplication.processingRegistry().algorithmById(f"bareearth:{algorithm}")
    for output in found.destinationParameterDefinitions():
        ending = ENDINGS[output.type()]
        if output.name() in ("OUTPUT", "OUTPUT_VPC") and output.type() == "fileDestination":
            ending = ".laz"  # before QGIS 3.26
        of_delivery = "DELIVERY" in given or output.name() == "DELIVERY_FOLDER"
        if not of_delivery and output.name() != "OUTPUT_VPC":
            path = folder / name / f"{output.name().lower()}{ending}"
            parameters.setdefault(output.name(), str(path))
    return parameters


@pytest.mark.parametrize("name", NAMES)
def test_the_logged_commands_run_as_they_stand(name, folder):
    import processing

    (folder / name).mkdir()
    parameters, log = parameters_of(name, folder), Log()
    results = processing.run(f"bareearth:{RUNS[name][0]}", parameters, feedback=log)
    made = [Path(value) for key, value in results.items() if parameters.get(key) == value]
    commands = [shlex.split(line)[1:] for line in log.said if line.startswith("bare-earth ")]
    assert commands and made and all(path.exists() for path in made)
    shutil.rmtree(folder / name)
    (folder / name).mkdir()
    with working_in(folder):
        for words in commands:
            code, *texts = said_by(words)
            assert code == 0, f"{words} {texts}"
    assert [path for path in made if not path.exists()] == []
