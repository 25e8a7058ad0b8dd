"""The models that come with the plugin: that they run, and what they make."""

import json
from pathlib import Path

import laspy
import numpy as np
import pytest
from osgeo import gdal
from qgis.core import (
    QgsProcessingModelAlgorithm,
    QgsProcessingOutputLayerDefinition,
    QgsProcessingProvider,
    QgsProject,
    QgsProviderRegistry,
    QgsVectorLayer,
)
from support import ROOT, title_of

gdal.UseExceptions()

FILES = sorted((ROOT / "plugin" / "models").glob("*.model3"))
OUTPUTS = {
    "terraincontours": {
        "ground:OUTPUT": "ground.laz",
        "ground:DTM": "dtm.tif",
        "ground:HILLSHADE": "hillshade.tif",
        "contours:OUTPUT": "contours.gpkg",
    },
    "cloudheights": {
        "heights:OUTPUT": "heights.laz",
        "canopy:CHM": "chm.tif",
        "canopy:DTM": "dtm.tif",
    },
    "twomethods": {
        "tin:HILLSHADE": "tin.tif",
        "slope:HILLSHADE": "slope.tif",
        "differences:REPORT": "report.html",
        "differences:ERROR_MAP": "errors.tif",
    },
}


@pytest.fixture(params=["python", "qgis_process"])
def run(request, scene, tmp_path):
    """What runs a model on the scene, in both ways, and returns its output files."""
    run_process = request.getfixturevalue("qgis_process") if request.param != "python" else None

    def run(name, **given):
        import processing

        files = {key: str(tmp_path / file) for key, file in OUTPUTS[name].items()}
        parameters = {"INPUT": str(scene.path), **given, **files}
        if run_process is None:
            results = processing.run(f"bareearth:{name}", parameters)
        else:
            words = [f"{key}={value}" for key, value in parameters.items()]
            done = run_process("--json", "run", f"bareearth:{name}", "--", *words)
            assert done.returncode == 0, done.stdout + done.stderr
            results = json.loads(done.stdout[done.stdout.index("{") :])["results"]
        assert {key: results[key] for key in files} == files
        return files

    return run


def plane(x, y):
    return 100 + 0.05 * (x - 500_000) + 0.02 * (y - 5_700_000)


def cells_of(file):
    """Return the coordinates of the centres, and the values, of the cells that have one."""
    raster = gdal.Open(file)
    left, width, _, top, _, height = raster.GetGeoTransform()
    values = raster.ReadAsArray()
    row, column = np.nonzero(values != raster.GetRasterBand(1).GetNoDataValue())
    return left + (column + 0.5) * width, top + (row + 0.5) * height, values[row, column]


def test_from_cloud_to_terrain_and_contours(run):
    files = run("terraincontours", DTM_CELL_SIZE=2, INTERVAL=0.5)
    x, y, z = cells_of(files["ground:DTM"])
    assert len(z) == 40 * 40
    assert np.abs(z - plane(x, y)).max() < 0.01
    light = cells_of(files["ground:HILLSHADE"])[2]
    # Light from the north-west, 45° high, on this plane: 1 + 254 * 0.7211; its border apart.
    assert len(light) == len(z) and np.median(light) == 184
    lines = list(QgsVectorLayer(files["contours:OUTPUT"]).getFeatures())
    # From the first to the last centre of a cell, the plane rises from 100.07 to 105.53 m.
    assert sorted({row["ELEV"] for row in lines}) == [100.5 + 0.5 * n for n in range(11)]
    corners = np.array(
        [(at.x(), at.y(), line["ELEV"]) for line in lines for at in line.geometry().vertices()]
    )
    x, y, level = corners.T
    assert len(x) > 300
    assert np.abs(plane(x, y) - level).max() < 0.01


def test_from_cloud_to_heights(run, scene):
    files = run("cloudheights")
    cloud = laspy.read(files["heights:OUTPUT"])
    height = np.where(scene.ground, 0, 112 - plane(cloud.x, cloud.y))
    assert np.abs(cloud["HeightAboveGround"] - height).max() < 0.01
    x, y, canopy = cells_of(files["canopy:CHM"])
    x, y = x - 500_000, y - 5_700_000
    inside = (x > 31) & (x < 47) & (y > 21) & (y < 45)
    outside = (x < 29) | (x > 49) | (y < 19) | (y > 47)
    expected = 112 - plane(x + 500_000, y + 5_700_000)
    # The roof is level: its highest point above the ground need not be in the middle of the cell.
    assert np.abs(canopy - expected)[inside].max() < 0.03
    assert canopy[outside].max() < 0.001 and canopy[outside].min() >= 0


def test_two_methods_compared(run, registry):
    files = run("twomethods", DTM_CELL_SIZE=2)
    report = Path(files["differences:REPORT"]).read_text(encoding="utf-8")
    assert "Kappa" in report
    assert len(cells_of(files["tin:HILLSHADE"])[2]) == 40 * 40
    # On a plane with one house both find the same.
    assert cells_of(files["differences:ERROR_MAP"])[2].max() == 0


def test_they_are_there_by_themselves(registry):
    """Nothing is put into the profile: they come and go with the plugin."""
    provider = registry.providerById("bareearth")
    assert isinstance(provider, QgsProcessingProvider)
    listed = {algorithm.name() for algorithm in provider.algorithms()}
    assert {file.stem.replace("_", "") for file in FILES} == set(OUTPUTS) <= listed
    for name in OUTPUTS:
        model = registry.createAlgorithmById(f"bareearth:{name}")
        assert model.canExecute() == (True, "")
        assert "Model" not in model.displayName() and model.group() == "Models"
        assert model.shortDescription() and model.tags() and not model.icon().isNull()
        page = model.helpUrl().rpartition("/docs/")[2].partition("#")[0]
        assert (ROOT / "docs" / page).is_file()
        for field in model.parameterDefinitions():
            assert f"<b>{field.description()}</b>: " in model.shortHelpString()
            assert len(field.help()) > 20


@pytest.mark.parametrize(
    ("name", "group", "titles", "shown"),
    [
        (
            "terraincontours", "Terrain, hillshade and contours",
            ["Contour lines", "Classes", "Terrain model", "Hillshade"],
            ["Contour lines", "Terrain model", "Hillshade"],
        ),
        (
            "twomethods", "Two methods compared",
            ["Errors", "Hillshade, TIN densification", "Hillshade, slope filter"],
            ["Errors", "Hillshade, TIN densification", "Hillshade, slope filter"],
        ),
    ],
)  # fmt: skip
def test_their_layers_are_a_group_with_names_and_colours(
    name, group, titles, shown, scene, tmp_path, context
):
    import processing

    project = QgsProject.instance()
    outputs = {
        key: QgsProcessingOutputLayerDefinition(str(tmp_path / file), project)
        for key, file in OUTPUTS[name].items()
        if not file.endswith("html")
    }
    outputs = {"INTERVAL": 0.5, "differences:REPORT": str(tmp_path / "r.html"), **outputs}
    if name == "terraincontours":
        outputs["ground:OUTPUT"] = str(tmp_path / "ground.copc.laz")
        if "copc" in QgsProviderRegistry.instance().providerList():
            path = outputs["ground:OUTPUT"]
            outputs["ground:OUTPUT"] = QgsProcessingOutputLayerDefinition(path, project)
    processing.runAndLoadResults(f"bareearth:{name}", {"INPUT": str(scene.path), **outputs})
    (tree,) = project.layerTreeRoot().children()
    assert tree.name() == f"scene: {group}"
    layers = {title_of(child): child for child in tree.children()}
    assert sorted(layers) == sorted(titles)
    assert [layer for layer in layers if not layer.startswith("Hillshade, ")] == [
        words for words in titles if not words.startswith("Hillshade, ")
    ]
    assert {title for title, value in layers.items() if value.isVisible()} == set(shown)
    if name == "terraincontours":
        rules = layers["Contour lines"].layer().renderer().rootRule().children()
        assert [rule.label() for rule in rules] == ["Every 2.5 m", "Every 0.5 m", "Depression"]


@pytest.mark.parametrize("name", OUTPUTS)
def test_their_outputs_are_known_before_a_run(name, registry):
    """As `processing.algorithmHelp` and the toolbox see them."""
    registered = registry.algorithmById(f"bareearth:{name}")
    listed = {definition.name() for definition in registered.outputDefinitions()}
    assert set(OUTPUTS[name]) <= listed
    assert {
        definition.name() for definition in registered.destinationParameterDefinitions()
    } == set(OUTPUTS[name])


def test_qgis_process_tells_their_outputs(qgis_process):
    done = qgis_process("help", "bareearth:terraincontours")
    arguments, _, outputs = done.stdout.partition("Outputs")
    for output in OUTPUTS["terraincontours"]:
        assert output in arguments and output in outputs


@pytest.mark.parametrize("name", OUTPUTS)
def test_without_outputs_they_make_all_of_them_in_temporary_files(name, scene, context, log):
    import processing

    results = processing.run(f"bareearth:{name}", {"INPUT": str(scene.path)}, context=context)
    for output in OUTPUTS[name]:
        assert Path(results[output]).is_file()


def test_their_dialogs_make_every_output(registry):
    for name in OUTPUTS:
        model = registry.createAlgorithmById(f"bareearth:{name}")
        for definition in model.destinationParameterDefinitions():
            assert definition.createByDefault(), definition.name()


def test_their_presets_have_labels_and_numbers(run, registry):
    model = registry.createAlgorithmById("bareearth:terraincontours")
    preset = model.parameterDefinition("PRESET")
    assert preset.options()[3] == "steep" and preset.defaultValue() == "automatic"
    assert preset.metadata()["labels"][3] == "Steep or rugged terrain"
    assert "steep: Steep or rugged terrain" in preset.help()
    for given in ("3", "steep"):
        assert Path(run("terraincontours", PRESET=given)["ground:OUTPUT"]).exists()


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_the_designer_finds_no_fault(file):
    """Opened in the designer, nothing is missing, and what is not chosen is the default."""
    model = QgsProcessingModelAlgorithm()
    assert model.fromFile(str(file))
    assert model.validate() == (True, [])
    for child in model.childAlgorithms().values():
        for name, sources in child.parameterSources().items():
            field = child.algorithm().parameterDefinition(name)
            for source in sources:
                if not source.parameterName() and not source.outputChildId():
                    assert source.staticValue() == field.defaultValue(), name
