import importlib.util
import os
import re
import subprocess
import sys

import pytest
from qgis.core import (
    Qgis,
    QgsProcessingParameterDefinition,
    QgsProcessingParameterEnum,
    QgsProcessingParameterNumber,
)
from qgis.gui import QgsProcessingToolboxProxyModel
from qgis.PyQt.QtCore import QModelIndex
from qgis.PyQt.QtGui import QIcon
from support import ALGORITHM, ROOT

SHARED_PARAMETERS = [
    "FROM_CLASSES", "SEED_CLASSES", "TO_CLASS", "RETURNS", "OVERLAP", "OTHERS",
    "LOW_NOISE_CLASS", "LOW_NOISE_DEPTH", "HIGH_NOISE_CLASS", "HIGH_NOISE_HEIGHT",
        "BRIDGES", "BRIDGE_CLASS", "REMEMBER_CLASSES",
    "DTM_CELL_SIZE", "DTM_CELL_UNIT", "RASTER_NODATA",
        "HILLSHADE_LIGHT", "HILLSHADE_AZIMUTH", "HILLSHADE_ALTITUDE", "RELIEF_SMOOTHING",
        "ERROR_FACTOR", "MAX_EDGE",
    "GROUND_ONLY", "AREA_ONLY", "HEIGHT_ABOVE_GROUND",
    "ABOVE_GROUND", "MEDIUM_HEIGHT", "HIGH_HEIGHT", "LOW_HEIGHT", "BUILDINGS",
    "BUILDING_AREA", "BUILDING_HEIGHT", "MARK_BRIDGES", "MARK_HIGH_NOISE", "RECLASSIFY",
    "THREADS", "MEMORY",
    "CORRECTIONS", "CORRECTIONS_FIELD",
    "BREAKLINES", "WATER", "RIVERS", "NO_GROUND", "LIKE", "RASTER_EXTENT",
    "LIMIT", "OUTPUT", "DTM", "HILLSHADE", "EXPECTED_ERROR", "ERROR_CAUSE",
]  # fmt: skip
SHARED_OUTPUTS = [
    "OUTPUT", "DTM", "HILLSHADE", "EXPECTED_ERROR", "ERROR_CAUSE",
    "POINT_COUNT", "AREA_COUNT", "SELECTED_COUNT", "GROUND_COUNT",
]  # fmt: skip
PARAMETERS = {
    "bareearth:tindensification": [
        "INPUT", "CRS", "EXTENT", "BOUNDARY",
        "PRESET", "MAX_BUILDING_SIZE", "MAX_TERRAIN_ANGLE", "ITERATION_ANGLE",
        "ITERATION_DISTANCE", "CELL_SIZE", "REDUCE_ANGLE_EDGE", "STOP_EDGE", "NOISE_DISTANCE",
        "GROUND_TOLERANCE", "GROUND_TOLERANCE_BELOW", "SLOPE_TOLERANCE", "ONLY_KEY_POINTS",
        "KEY_POINT_TOLERANCE_ABOVE", "KEY_POINT_TOLERANCE_BELOW", "KEY_POINT_GRID_SIZE",
        *SHARED_PARAMETERS,
    ],
    "bareearth:pointcloudtoterrain": [
        "INPUT", "INPUT_FOLDER", "CRS", "EXTENT", "BOUNDARY",
        "DELIVERY", "METHOD", "PRESET",
        "DTM_CELL_SIZE", "DTM_CELL_UNIT", "RASTER_NODATA",
        "HILLSHADE_LIGHT", "HILLSHADE_AZIMUTH", "HILLSHADE_ALTITUDE",
        "RELIEF_SMOOTHING", "RELIEF_RADIUS", "ERROR_FACTOR",
        "CONTOUR_INTERVAL", "CONTOUR_SMOOTHING", "CONTOUR_MIN_LENGTH", "CONTOUR_KNOLLS",
        "FROM_CLASSES", "SEED_CLASSES", "TO_CLASS", "RETURNS", "OVERLAP", "OTHERS",
        "LOW_NOISE_CLASS", "LOW_NOISE_DEPTH", "HIGH_NOISE_CLASS", "HIGH_NOISE_HEIGHT",
        "BRIDGES", "BRIDGE_CLASS", "REMEMBER_CLASSES",
        "SURFACE_RETURNS", "SURFACE_CLASSES", "MAX_EDGE", "PIT_FREE", "THREADS", "MEMORY",
        "SPECIFICATION", "KEY_POINTS", "HOLD_OUT_SHARE", "MIN_AREA", "MIN_WIDTH", "WATER_CELL",
        "ACCURACY_CLASS", "SURVEY_ERROR",
        "CORRECTIONS", "CORRECTIONS_FIELD",
        "BREAKLINES", "WATER", "RIVERS", "NO_GROUND", "LIKE", "RASTER_EXTENT",
        "CHECKPOINTS", "Z_FIELD", "COVER_FIELD", "NAME_FIELD", "LIMIT",
        "DELIVERY_FOLDER",
        "OUTPUT", "DTM", "DSM", "CHM", "HILLSHADE", "EXPECTED_ERROR", "ERROR_CAUSE",
        "RELIEF", "CONTOURS", "PLACES",
    ],
    "bareearth:gridminimum": [
        "INPUT", "CRS", "EXTENT", "BOUNDARY",
        "PRESET", "CELL_SIZE", "HEIGHT_THRESHOLDS", "FINAL_HEIGHT", "MAX_OBJECT_SIZE",
        "GROUND_TOLERANCE", "SLOPE_TOLERANCE",
        *SHARED_PARAMETERS,
    ],
    "bareearth:slopefilter": [
        "INPUT", "CRS", "EXTENT", "BOUNDARY",
        "PRESET", "SEARCH_RADIUS", "MIN_NEIGHBOURS", "SLOPE_THRESHOLD", "HEIGHT_THRESHOLD",
        "SLOPE_NORM", "CELL_SIZE", "MAX_BUILDING_SIZE", "GROUND_TOLERANCE", "SLOPE_TOLERANCE",
        *SHARED_PARAMETERS,
    ],
    "bareearth:classifytiles": [
        "INPUT", "INPUT_FOLDER", "REMOTE", "CRS", "EXTENT", "BOUNDARY",
        "METHOD", "PRESET",
        "FROM_CLASSES", "SEED_CLASSES", "TO_CLASS", "RETURNS", "OVERLAP", "OTHERS",
        "LOW_NOISE_CLASS", "LOW_NOISE_DEPTH", "HIGH_NOISE_CLASS", "HIGH_NOISE_HEIGHT",
        "BRIDGES", "BRIDGE_CLASS", "REMEMBER_CLASSES",
        "RECURSIVE", "FORMAT", "RESUME",
        "GROUND_ONLY", "AREA_ONLY", "HEIGHT_ABOVE_GROUND",
        "ABOVE_GROUND", "MEDIUM_HEIGHT", "HIGH_HEIGHT", "LOW_HEIGHT", "BUILDINGS",
        "BUILDING_AREA", "BUILDING_HEIGHT", "MARK_BRIDGES", "MARK_HIGH_NOISE", "RECLASSIFY",
        "DTM_CELL_SIZE", "DTM_CELL_UNIT", "RASTER_NODATA",
        "HILLSHADE_LIGHT", "HILLSHADE_AZIMUTH", "HILLSHADE_ALTITUDE", "RELIEF_SMOOTHING",
        "ERROR_FACTOR", "MAX_EDGE", "RASTER_PER_FILE",
        "THREADS", "MEMORY", "CORRECTIONS", "CORRECTIONS_FIELD",
        "BREAKLINES", "WATER", "RIVERS", "NO_GROUND", "LIKE", "RASTER_EXTENT",
        "LIMIT", "OUTPUT_FOLDER", "OUTPUT_VPC", "DTM", "HILLSHADE", "EXPECTED_ERROR",
        "ERROR_CAUSE",
    ],
    "bareearth:heightaboveground": [
        "INPUT", "CRS", "GROUND_CLASSES", "OVERLAP", "OUTPUT_AS", "THREADS", "MEMORY", "DTM",
        "EXTENT", "LIMIT", "OUTPUT",
    ],
    "bareearth:classifyaboveground": [
        "INPUT", "CRS", "ABOVE_GROUND", "MEDIUM_HEIGHT", "HIGH_HEIGHT", "LOW_HEIGHT", "BUILDINGS",
        "BUILDING_AREA", "BUILDING_HEIGHT", "MARK_BRIDGES", "MARK_HIGH_NOISE", "RECLASSIFY",
        "GROUND_CLASSES", "OVERLAP", "THREADS", "MEMORY", "EXTENT", "LIMIT", "OUTPUT",
    ],
    "bareearth:modelkeypoints": [
        "INPUT", "CRS",
        "TOLERANCE_ABOVE", "TOLERANCE_BELOW", "GRID_SIZE",
        "GROUND_CLASSES", "OVERLAP", "MARK_AS", "KEY_CLASS",
        "THREADS", "MEMORY", "EXTENT", "LIMIT", "OUTPUT",
    ],
    "bareearth:water": [
        "INPUT", "CRS", "MIN_AREA", "MIN_WIDTH", "WATER_CELL", "GROUND_CLASSES", "OVERLAP",
        "EXTENT", "LIMIT", "OUTPUT", "BREAKLINES",
    ],
    "bareearth:waterclasses": [
        "INPUT", "WATER", "CRS", "SHORE_DISTANCE", "WATER_CLASS", "IGNORED_CLASS",
        "GROUND_CLASSES", "OVERLAP", "THREADS", "MEMORY", "EXTENT", "LIMIT", "OUTPUT",
    ],
    "bareearth:terrainmodel": [
        "INPUT", "CRS", "GROUND_CLASSES", "OVERLAP",
        "DTM_CELL_SIZE", "DTM_CELL_UNIT", "RASTER_NODATA",
        "HILLSHADE_LIGHT", "HILLSHADE_AZIMUTH", "HILLSHADE_ALTITUDE", "RELIEF_SMOOTHING",
        "ERROR_FACTOR", "SURFACE_RETURNS", "SURFACE_CLASSES", "MAX_EDGE", "PIT_FREE",
        "RASTER_PER_FILE", "THREADS", "MEMORY", "EXTENT", "BOUNDARY",
        "BREAKLINES", "WATER", "RIVERS", "NO_GROUND", "LIKE", "RASTER_EXTENT",
        "LIMIT", "DTM", "DSM", "CHM", "HILLSHADE", "EXPECTED_ERROR", "ERROR_CAUSE",
    ],
    "bareearth:comparesettings": [
        "INPUT", "EXTENT", "CRS", "SETTINGS", "CONTEXT", "THREADS", "MEMORY", "LIMIT",
        "OUTPUT",
    ],
    "bareearth:assess": [
        "CLASSIFIED", "REFERENCE", "CRS", "GROUND_CLASSES", "IGNORED_CLASSES", "MAP_CELL_SIZE",
        "EXTENT", "LIMIT", "REPORT", "ERROR_MAP",
    ],
    "bareearth:check": [
        "INPUT", "CHECKPOINTS", "Z_FIELD", "COVER_FIELD", "NAME_FIELD", "DTM", "CRS",
        "ACCURACY_CLASS", "SURVEY_ERROR", "MAX_EDGE", "HOLD_OUT",
        "GROUND_CLASSES", "OVERLAP", "VEGETATED", "EXPECTED_ERROR", "LOW_CONFIDENCE",
        "EXTENT", "LIMIT", "OUTPUT", "REPORT",
    ],
    "bareearth:review": [
        "INPUT", "DTM", "CAUSE", "POINTS", "EARLIER", "LEAST_ERROR", "LEAST_AREA", "MOST_PLACES",
        "CORRECTIONS", "CORRECTIONS_FIELD", "OUTPUT", "REPORT",
    ],
    "bareearth:change": [
        "OLD", "NEW", "OLD_ERROR", "NEW_ERROR", "LIKE", "CRS", "ALIGNMENT", "MOVE", "FIND_GROUND",
        "CELL_SIZE", "LEAST_AREA", "METHOD", "PRESET", "THREADS", "MEMORY", "OUTPUT", "LIMIT",
        "PLACES", "REPORT",
    ],
    "bareearth:fetch": [
        "ADDRESS", "EXTENT", "BOUNDARY", "RESOLUTION", "LIMIT", "SKIP_MISSING", "TO_UTM",
        "HEIGHT_UNIT", "FOLLOW", "OUTPUT",
    ],
    "bareearth:quality": [
        "INPUT", "CRS", "SPECIFICATION", "CELL_SIZE", "VOID_DISTANCE", "LOW_CONFIDENCE_AREA",
        "GROUND_CLASSES", "OVERLAP", "EXTENT", "LIMIT", "PAGE", "FOLDER", "LOW_CONFIDENCE",
    ],
    "bareearth:relief": [
        "INPUT", "KINDS", "RELIEF_RADIUS", "RELIEF_SMOOTHING",
        "HILLSHADE_LIGHT", "HILLSHADE_AZIMUTH", "HILLSHADE_ALTITUDE", "OUTPUT_FOLDER",
    ],
    "bareearth:removeoffterrainobjects": [
        "INPUT", "MAX_OBJECT_SIZE", "SLOPE_THRESHOLD", "BAND", "OUTPUT",
    ],
    "bareearth:clip": [
        "INPUT", "EXTENT", "BOUNDARY", "CRS", "THREADS", "MEMORY", "LIMIT", "OUTPUT",
    ],
    "bareearth:canopyheight": ["SURFACE", "TERRAIN", "PIT_FREE", "OUTPUT"],
    "bareearth:canopychange": [
        "OLD", "NEW", "LEAST_HEIGHT", "LEAST_WIDTH", "OUTPUT", "PLACES",
    ],
    "bareearth:contours": [
        "INPUT", "CONTOUR_INTERVAL", "CONTOUR_SMOOTHING", "CONTOUR_MIN_LENGTH", "CONTOUR_KNOLLS",
        "OUTPUT",
    ],
}  # fmt: skip
OUTPUTS = {
    "bareearth:tindensification": SHARED_OUTPUTS,
    "bareearth:gridminimum": SHARED_OUTPUTS,
    "bareearth:slopefilter": SHARED_OUTPUTS,
    "bareearth:classifytiles": [
        "OUTPUT_FOLDER",
        "OUTPUT_VPC",
        "DTM",
        "HILLSHADE",
        "EXPECTED_ERROR",
        "ERROR_CAUSE",
        "TILE_COUNT",
        "DONE_COUNT",
        "KEPT_COUNT",
        "POINT_COUNT",
        "GROUND_COUNT",
    ],
    "bareearth:pointcloudtoterrain": [
        "DELIVERY_FOLDER",
        "PAGE",
        "OUTPUT",
        "DTM",
        "DSM",
        "CHM",
        "HILLSHADE",
        "EXPECTED_ERROR",
        "ERROR_CAUSE",
        "RELIEF",
        "CONTOURS",
        "PLACES",
        "POINT_COUNT",
        "GROUND_COUNT",
        "VERDICT",
    ],
    "bareearth:heightaboveground": [
        "OUTPUT",
        "POINT_COUNT",
        "GROUND_COUNT",
        "MINIMUM",
        "MAXIMUM",
    ],
    "bareearth:classifyaboveground": [
        "OUTPUT",
        "POINT_COUNT",
        "GROUND_COUNT",
        "CHANGED_COUNT",
    ],
    "bareearth:modelkeypoints": ["OUTPUT", "POINT_COUNT", "GROUND_COUNT", "KEY_POINT_COUNT"],
    "bareearth:water": ["OUTPUT", "BREAKLINES", "LAKES", "RIVERS", "AREA"],
    "bareearth:waterclasses": ["OUTPUT", "POINT_COUNT", "WATER_COUNT", "IGNORED_COUNT"],
    "bareearth:terrainmodel": [
        "DTM",
        "DSM",
        "CHM",
        "HILLSHADE",
        "EXPECTED_ERROR",
        "ERROR_CAUSE",
        "GROUND_COUNT",
        "SURFACE_COUNT",
    ],
    "bareearth:comparesettings": ["OUTPUT"],
    "bareearth:assess": [
        "REPORT",
        "ERROR_MAP",
        "POINT_COUNT",
        "TYPE_1_ERROR",
        "KAPPA",
        "TYPE_2_ERROR",
        "TOTAL_ERROR",
        "CLASSIFIED_ONLY",
        "REFERENCE_ONLY",
    ],
    "bareearth:fetch": ["OUTPUT", "POINT_COUNT"],
    "bareearth:check": [
        "OUTPUT",
        "REPORT",
        "CHECKPOINT_COUNT",
        "COUNTED",
        "NVA_RMSE",
        "VVA_RMSE",
        "SHIFT",
        "HOLD_OUT_RMSE",
        "MEETS_CLASS",
        "VERDICT",
    ],
    "bareearth:quality": [
        "PAGE",
        "FOLDER",
        "LOW_CONFIDENCE",
        "PULSE_DENSITY",
        "GROUND_DENSITY",
        "LOW_CONFIDENCE_SHARE",
        "STRIP_RMS",
        "MEETS_SPECIFICATION",
        "VERDICT",
    ],
    "bareearth:change": [
        "OUTPUT",
        "LIMIT",
        "PLACES",
        "REPORT",
        "PLACE_COUNT",
        "VOLUME_UP",
        "VOLUME_UP_ERROR",
        "VOLUME_DOWN",
        "VOLUME_DOWN_ERROR",
        "SHIFT",
    ],
    "bareearth:review": ["OUTPUT", "REPORT", "PLACE_COUNT", "EXPECTED_RMSE"],
    "bareearth:relief": [
        "OUTPUT_FOLDER",
        "HILLSHADE",
        "RELIEF",
        "MULTI_SCALE_RELIEF",
        "SLOPE",
        "SKY_VIEW",
        "OPENNESS",
        "NEGATIVE_OPENNESS",
        "LOCAL_DOMINANCE",
        "VAT",
        "RED_RELIEF",
    ],
    "bareearth:removeoffterrainobjects": ["OUTPUT", "CELL_COUNT", "REMOVED_COUNT"],
    "bareearth:canopyheight": ["OUTPUT", "CELL_COUNT", "MAXIMUM"],
    "bareearth:canopychange": [
        "OUTPUT",
        "PLACES",
        "AREA_BEFORE",
        "AREA_AFTER",
        "PLACE_COUNT",
        "LOST_AREA",
        "GAINED_AREA",
        "GROWTH",
    ],
    "bareearth:clip": ["OUTPUT", "POINT_COUNT"],
    "bareearth:contours": ["OUTPUT", "LINE_COUNT", "HEIGHT"],
}
MODELS = {
    "bareearth:terraincontours": [
        "INPUT", "PRESET", "DTM_CELL_SIZE", "INTERVAL",
        "contours:OUTPUT", "ground:DTM", "ground:HILLSHADE", "ground:OUTPUT",
    ],
    "bareearth:cloudheights": [
        "INPUT", "PRESET", "DTM_CELL_SIZE", "canopy:CHM", "canopy:DTM", "heights:OUTPUT",
    ],
    "bareearth:twomethods": [
        "INPUT", "PRESET", "DTM_CELL_SIZE",
        "differences:ERROR_MAP", "differences:REPORT", "slope:HILLSHADE", "tin:HILLSHADE",
    ],
}  # fmt: skip


@pytest.fixture(params=sorted(PARAMETERS))
def any_algorithm(request, registry):
    return registry.createAlgorithmById(request.param)


def test_the_provider_is_there(registry):
    provider = registry.providerById("bareearth")
    assert provider.name() == "Bare Earth"
    assert not provider.icon().isNull()
    assert os.path.exists(provider.svgIconPath())


def test_saved_models_depend_on_these_names(registry):
    # Names may be added. One that goes or changes breaks the models and scripts of users.
    listed = registry.providerById("bareearth").algorithms()
    # As one that runs: QGIS learns only then what a model is made of.
    algorithms = [registry.createAlgorithmById(key.id()) for key in listed]
    names = {
        algorithm.id(): [p.name() for p in algorithm.parameterDefinitions()]
        for algorithm in algorithms
    }
    assert names == {**PARAMETERS, **MODELS}
    outputs = {
        algorithm.id(): [o.name() for o in algorithm.outputDefinitions()]
        for algorithm in algorithms
    }
    assert {name: output for name, output in outputs.items() if name in PARAMETERS} == OUTPUTS


def test_an_algorithm_says_what_it_is(any_algorithm):
    assert re.fullmatch(r"[a-z0-9]+", any_algorithm.name())
    assert re.fullmatch(r"[a-z0-9]+", any_algorithm.groupId())
    assert any_algorithm.displayName() and any_algorithm.group() and any_algorithm.tags()
    assert any_algorithm.shortDescription() and "\n" not in any_algorithm.shortDescription()
    page = any_algorithm.helpUrl().rpartition("/docs/")[2].partition("#")[0]
    assert (ROOT / "docs" / page).is_file()
    assert not any_algorithm.icon().isNull()
    assert any_algorithm.flags() & any_algorithm.Flag.FlagCanCancel
    assert any_algorithm.flags() & any_algorithm.Flag.FlagSupportsBatch
    assert not any_algorithm.flags() & any_algorithm.Flag.FlagNoThreading


def test_each_algorithm_has_an_icon_of_its_own(registry):
    provider = registry.providerById("bareearth")
    algorithms = [algorithm for algorithm in provider.algorithms() if algorithm.id() in PARAMETERS]
    paths = {algorithm.id(): algorithm.svgIconPath() for algorithm in algorithms}
    assert len({*paths.values(), provider.svgIconPath()}) == len(paths) + 1
    for name, path in paths.items():
        assert f"{name.partition(':')[2]}.svg" == os.path.basename(path)
        picture = QIcon(path).pixmap(16, 16).toImage()
        rows = [[picture.pixelColor(x, y) for x in range(16)] for y in range(16)]
        drawn = [colour for row in rows for colour in row if colour.alpha() > 200]
        # As large as the others, and neither near white nor near black: it stands out in themes of
        # either kind.
        assert len(drawn) > 50, name
        assert all(50 < colour.lightness() < 205 for colour in drawn), name


@pytest.mark.parametrize(
    "words",
    [
        "smrf",
        "pmf",
        "csf",
        "lasground",
        "noise",
        "ground filter",
        "bare earth",
        "dtm",
        "dem",
        "lidar",
        "drone",
        "ept",
    ],
)
def test_the_search_of_the_toolbox_finds_what_people_type(registry, words):
    assert {ALGORITHM, "bareearth:pointcloudtoterrain"} <= found_by(registry, words)


def test_the_search_of_the_toolbox_finds_single_tools(registry):
    assert "bareearth:pointcloudtoterrain" in found_by(registry, "stockpile")
    assert "bareearth:fetch" in found_by(registry, "reproject")


def found_by(registry, words):
    model = QgsProcessingToolboxProxyModel(None, registry)
    model.setFilterString(words)
    return set(found_below(model, QModelIndex()))


# Not a function in `found_by` that calls itself: it would keep the model until the garbage is
# collected. Until then QGIS resets it with all others, and in the middle of that it can go.
def found_below(model, parent):
    for row in range(model.rowCount(parent)):
        index = model.index(row, 0, parent)
        if algorithm := model.toolboxModel().algorithmForIndex(model.mapToSource(index)):
            yield algorithm.id()
        yield from found_below(model, index)


def test_an_instance_is_of_the_same_kind(any_algorithm):
    assert type(any_algorithm.create()) is type(any_algorithm)


def test_the_help_speaks_of_every_parameter(any_algorithm):
    for parameter in any_algorithm.parameterDefinitions():
        assert len(parameter.help()) > 20, parameter.name()
        assert f"<b>{parameter.description()}</b>: " in any_algorithm.shortHelpString()


def test_numbers_have_ranges_and_names_are_upper_case(any_algorithm):
    for parameter in any_algorithm.parameterDefinitions():
        assert re.fullmatch(r"[A-Z][A-Z0-9_]*", parameter.name())
        # A value for no data may be any number of 32 bits.
        is_length = parameter.name() != "RASTER_NODATA"
        if isinstance(parameter, QgsProcessingParameterNumber) and is_length:
            assert parameter.minimum() > -1e6 and parameter.maximum() < 1e6, parameter.name()
        if isinstance(parameter, QgsProcessingParameterEnum):
            assert parameter.usesStaticStrings()


def test_lines_are_offered_in_the_formats_that_can_be_written(registry):
    algorithm = registry.createAlgorithmById("bareearth:pointcloudtoterrain")
    field = algorithm.parameterDefinition("CONTOURS")
    expected = ["gpkg", "geojson", "shp", "fgb", "dxf"]
    assert field.supportedOutputVectorLayerExtensions() == expected
    assert field.defaultFileExtension() == "gpkg"
    assert "kml" not in field.createFileFilter()


def test_a_dialog_shows_eight_fields_at_most(any_algorithm):
    advanced = QgsProcessingParameterDefinition.Flag.FlagAdvanced
    fields = [p for p in any_algorithm.parameterDefinitions() if not p.flags() & advanced]
    if any_algorithm.id() == "bareearth:pointcloudtoterrain":
        # It is there to make them all, and QGIS cannot fold outputs away.
        fields = [p for p in fields if not p.isDestination()]
    assert len(fields) <= 8, [p.name() for p in fields]


def test_what_users_look_for_is_in_front(registry):
    advanced = QgsProcessingParameterDefinition.Flag.FlagAdvanced

    def seen(name):
        algorithm = registry.createAlgorithmById(f"bareearth:{name}")
        fields = [p for p in algorithm.parameterDefinitions() if not p.isDestination()]
        return [p.name() for p in fields if not p.flags() & advanced]

    for name in ("tindensification", "gridminimum", "slopefilter"):
        assert seen(name)[:2] == ["INPUT", "EXTENT"]
    assert seen("pointcloudtoterrain") == [
        "INPUT", "INPUT_FOLDER", "EXTENT", "DELIVERY", "METHOD", "PRESET", "DTM_CELL_SIZE",
        "CONTOUR_INTERVAL",
    ]  # fmt: skip
    whole = registry.createAlgorithmById("bareearth:pointcloudtoterrain")
    interval = whole.parameterDefinition("CONTOUR_INTERVAL").description()
    assert interval == "Contour interval [m or ft]"


def test_the_help_has_the_order_of_the_dialog(any_algorithm):
    advanced = QgsProcessingParameterDefinition.Flag.FlagAdvanced
    fields = list(any_algorithm.parameterDefinitions())
    # The outputs follow below what is folded away.
    fields.sort(key=lambda p: (p.isDestination(), bool(p.flags() & advanced)))
    places = [any_algorithm.shortHelpString().index(f"<b>{p.description()}</b>") for p in fields]
    assert places == sorted(places)


def test_the_values_of_presets_are_told_before_a_run(algorithm, registry):
    help_text = algorithm.shortHelpString()
    row = help_text.partition("<td>Steep or rugged terrain</td>")[2].partition("</tr>")[0]
    assert row == "<td>30 / 25 / 2 / 1</td>"
    columns = (
        "Maximum building size [m] / Iteration angle [°] / Iteration distance [m] / Cell size [m]"
    )
    assert f'<tr><td colspan="2">{columns}</td></tr>' in help_text
    tables = {"gridminimum": 1, "slopefilter": 1, "classifytiles": 3, "pointcloudtoterrain": 3}
    for name, count in tables.items():
        text = registry.createAlgorithmById(f"bareearth:{name}").shortHelpString()
        assert text.count("<td>Steep or rugged terrain</td>") == count
        # Those for any method have neither the presets of one, nor fields for the values.
        if count == 3:
            assert "<td>LiDAR360's" not in text and "left empty" not in text
    assert "&#x27;" not in help_text and "<td>LiDAR360's values</td>" in help_text


def test_the_help_tells_what_choices_are_in_scripts(algorithm, registry):
    text = algorithm.parameterDefinition("PRESET").help()
    assert "In scripts: automatic; flat: Flat land, fields; hilly: Hilly land, forest;" in text
    assert "In scripts" not in algorithm.parameterDefinition("MAX_BUILDING_SIZE").help()
    compare = registry.createAlgorithmById("bareearth:comparesettings")
    assert "; slope:flat; slope:hilly; " in compare.parameterDefinition("SETTINGS").help()


def test_units_and_rare_parameters(algorithm):
    size = algorithm.parameterDefinition("MAX_BUILDING_SIZE")
    edge = algorithm.parameterDefinition("STOP_EDGE")
    advanced = QgsProcessingParameterDefinition.Flag.FlagAdvanced
    optional = QgsProcessingParameterDefinition.Flag.FlagOptional
    assert size.description() == "Maximum building size [m]"
    assert algorithm.parameterDefinition("ITERATION_ANGLE").description().endswith("[°]")
    assert not size.flags() & advanced and edge.flags() & advanced
    assert size.flags() & optional and edge.flags() & optional
    assert not algorithm.parameterDefinition("MAX_TERRAIN_ANGLE").flags() & optional


def test_copies_of_the_input_take_files_too(algorithm, scene, context):
    copy = algorithm.parameterDefinition("INPUT").clone()
    assert copy.checkValueIsAcceptable(str(scene.path), context)
    assert copy.clone().checkValueIsAcceptable(str(scene.path), context)
    assert "*.laz" in copy.createFileFilter()
    assert not copy.checkValueIsAcceptable(str(scene.path) + "x", context)
    assert not copy.checkValueIsAcceptable(None, context)


def test_all_packages_are_here(algorithm):
    assert algorithm.canExecute() == (True, "")


@pytest.mark.parametrize("package", ["laspy", "scipy"])
def test_a_missing_package_is_told(algorithm, monkeypatch, package):
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *_: None if name == package else find(name)
    )
    possible, text = algorithm.canExecute()
    assert not possible and package in text
    # laspy travels in the zip, scipy comes with QGIS.
    assert ("zip" in text) == (package == "laspy")


@pytest.mark.rest
@pytest.mark.parametrize("package", ["laspy", "lazrs", "copclib", "scipy"])
def test_the_plugin_loads_without(package):
    # In a QGIS of its own, as in this one the package is imported already.
    code = f"""
import sys
sys.modules[{package!r}] = None
from qgis.core import QgsApplication
app = QgsApplication([], False)
app.initQgis()
from bare_earth import classFactory
plugin = classFactory(None)
plugin.initProcessing()
algorithm = app.processingRegistry().createAlgorithmById({ALGORITHM!r})
print("loaded", algorithm.displayName(), "laspy" in sys.modules and {package!r} != "laspy")
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "loaded Classify ground (TIN densification) False" in done.stdout, done.stderr


def test_the_version_is_told(registry):
    print(Qgis.QGIS_VERSION)
    assert registry.providerById("bareearth").versionInfo()


def test_the_pages_hold_every_parameter_and_output(any_algorithm):
    parameters = (ROOT / "docs" / "parameters.md").read_text(encoding="utf-8")
    for declared in any_algorithm.parameter_sets():
        for parameter in declared.declarations():
            assert f"| **{parameter.label}** `{parameter.name.upper()}` | " in parameters
    name = any_algorithm.helpUrl().rpartition("/")[2].partition("#")[0]
    page = (ROOT / "docs" / name).read_text(encoding="utf-8")
    if any_algorithm.name() in ("slopefilter", "gridminimum"):
        page += (ROOT / "docs" / "tin-densification.md").read_text(encoding="utf-8")
    outputs = [definition.name() for definition in any_algorithm.outputDefinitions()]
    assert all(f"`{name}`" in page for name in outputs)


@pytest.mark.parametrize("name", [ALGORITHM, "bareearth:terraincontours"])
def test_unknown_parameters_are_told(name, registry, scene, tmp_path, context, log):
    algorithm = registry.createAlgorithmById(name)
    given = {"INPUT": str(scene.path), "PRESETT": "flat", "NOSUCH": 1}
    outputs = [definition.name() for definition in algorithm.destinationParameterDefinitions()]
    files = {output: str(tmp_path / output.replace(":", "_")) for output in outputs}
    endings = {"OUTPUT": ".laz", "DTM": ".tif", "HILLSHADE": ".tif", "ground:OUTPUT": ".laz"}
    files = {key: f"{path}{endings.get(key, '.tif')}" for key, path in files.items()}
    if "contours:OUTPUT" in files:
        files["contours:OUTPUT"] = str(tmp_path / "contours.gpkg")
    assert algorithm.run({**given, **files}, context, log)[1], log.text
    told = [text for text in log.said if text.startswith("There is no parameter")]
    assert len(told) == 2
    assert "NOSUCH" in told[0] and "Did you mean" not in told[0]
    assert re.search(r"\bPRESETT\b.* PRESET\b", told[1])


@pytest.mark.rest
def test_qgis_process_tells_of_unknown_parameters(qgis_process, scene, tmp_path):
    words = f"INPUT={scene.path}", f"OUTPUT={tmp_path / 'ground.laz'}", "OUPUT=x.laz"
    done = qgis_process("run", ALGORITHM, "--", *words)
    assert done.returncode == 0, done.stderr
    assert re.search(r"no parameter OUPUT\b.* OUTPUT\b", done.stdout + done.stderr)


def test_qgis_process_prints_an_error_once(qgis_process, scene, tmp_path):
    # No point of the scene is ground, as the run finds out.
    words = f"INPUT={scene.path}", f"DTM={tmp_path / 'dtm.tif'}"
    done = qgis_process("run", "bareearth:terrainmodel", "--", *words)
    assert done.returncode != 0
    assert (done.stdout + done.stderr).count("has no ground points") == 1, done.stderr
