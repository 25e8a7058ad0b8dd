import numpy as np
import pytest
from qgis.core import QgsExpression, QgsExpressionContext, QgsExpressionContextUtils, QgsVectorLayer
from qgis.PyQt.QtCore import QCoreApplication, QTranslator
from support import write_raster

from bare_earth.algorithms.tools.review.reasons import TEXTS, parts_of

ALGORITHM = "bareearth:review"


@pytest.fixture
def error(tmp_path):
    """Write an expected error of 0.1 m, with two places of 1 and 2 m."""
    values = np.full((60, 80), 0.1)
    values[5:15, 10:20], values[30:40, 50:70] = 1.0, 2.0
    return write_raster(tmp_path / "error.tif", values)


def places_of(path):
    layer = QgsVectorLayer(path, "places", "ogr")
    assert layer.isValid()
    return layer


def test_places_are_found_and_those_with_an_answer_left_out(
    registry, error, tmp_path, context, log
):
    import processing

    places = str(tmp_path / "places.gpkg")
    parameters = {"INPUT": error, "LEAST_ERROR": 0.5, "OUTPUT": places,
                  "REPORT": str(tmp_path / "page.html")}  # fmt: skip
    results, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    assert results["PLACE_COUNT"] == 2
    found = list(places_of(places).getFeatures())
    assert [feature["RANK"] for feature in found] == [1, 2]
    assert found[0]["ERROR"] == 2.0 and found[0].geometry().area() == pytest.approx(200.0, abs=3)
    assert (tmp_path / "page.html").exists()

    layer = places_of(places)
    field = layer.fields().lookupField("class")
    assert layer.dataProvider().changeAttributeValues({found[0].id(): {field: 2}})
    # The answer in another CRS, as a user may keep it.
    answered = str(tmp_path / "answered.gpkg")
    reprojected = {"INPUT": layer, "TARGET_CRS": "EPSG:4326", "OUTPUT": answered}
    processing.run("native:reprojectlayer", reprojected)
    parameters |= {"CORRECTIONS": answered,
                   "OUTPUT": str(tmp_path / "left.gpkg")}  # fmt: skip
    results, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    assert results["PLACE_COUNT"] == 1 and "1 place had an answer" in log.text


def test_answers_count_before_classes_and_are_carried_over(registry, error, tmp_path, context, log):
    places, again = str(tmp_path / "places.gpkg"), str(tmp_path / "again.gpkg")
    parameters = {"INPUT": error, "LEAST_ERROR": 0.5, "OUTPUT": places}
    _, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    layer = places_of(places)
    first = next(layer.getFeatures())
    answer, field = (layer.fields().lookupField(name) for name in ("answer", "class"))
    values = {first.id(): {answer: "right", field: 1}}
    assert layer.dataProvider().changeAttributeValues(values)
    parameters |= {"CORRECTIONS": layer, "OUTPUT": again}
    results, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    assert results["PLACE_COUNT"] == 1
    new, old = places_of(again).getFeatures()
    assert (new["RANK"], old["RANK"]) == (1, 2)
    assert old["answer"] == "right" and old["REASON"] == first["REASON"]
    assert old["X1"] == first["X1"] and old["ERROR"] == first["ERROR"]


def test_the_layer_shows_the_reason_and_asks_for_a_class(registry, error, tmp_path, context, log):
    from bare_earth.plugin.styles import layers

    places = str(tmp_path / "places.gpkg")
    parameters = {"INPUT": error, "OUTPUT": places}
    _, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    layer = places_of(places)
    layers.look_of("places").dress(layer)
    field = layer.fields().lookupField("class")
    assert layer.editorWidgetSetup(field).type() == "ValueMap"
    assert "REASON" in layer.displayExpression()


GERMAN = {
    "a large expected error": "ein großer erwarteter Fehler",
    "{rise} of relief": "{rise} Relief",
    "beside water or the border of the survey": "neben Wasser oder dem Rand",
}


class German(QTranslator):
    """Translates the parts of a reason."""

    def translate(self, context, text, disambiguation=None, n=-1):
        return GERMAN.get(text)


@pytest.fixture
def german():
    translator = German()
    QCoreApplication.installTranslator(translator)
    yield
    QCoreApplication.removeTranslator(translator)


def shown_for(layer, feature):
    """Return what the list of features of a layer shows for one of them."""
    context = QgsExpressionContext(QgsExpressionContextUtils.globalProjectLayerScopes(layer))
    context.setFeature(feature)
    return QgsExpression(layer.displayExpression()).evaluate(context)


def reviewed(registry, error, tmp_path, context, log):
    from bare_earth.plugin.styles import layers

    dtm = write_raster(tmp_path / "dtm.tif", np.tile(np.arange(80.0) / 10, (60, 1)))
    places = str(tmp_path / "places.gpkg")
    parameters = {"INPUT": error, "DTM": dtm, "LEAST_ERROR": 0.5, "OUTPUT": places}
    _, done = registry.createAlgorithmById(ALGORITHM).run(parameters, context, log)
    assert done, log.text
    layer = places_of(places)
    layers.look_of("places").dress(layer)
    return layer


def test_reasons_are_shown_in_german_and_kept_in_english(
    registry, german, error, tmp_path, context, log
):
    from bare_earth.plugin.review.panel import Panel
    from bare_earth.plugin.review.session import Session

    layer = reviewed(registry, error, tmp_path, context, log)
    feature = next(layer.getFeatures())
    assert feature["REASON"] == "a large expected error, 1.90 m of relief"
    assert shown_for(layer, feature) == "1: ein großer erwarteter Fehler, 1.90 m Relief"
    panel = Panel()
    panel.show_session(Session(layer))
    assert panel.reason.text() == "Ein großer erwarteter Fehler, 1.90 m Relief"


def test_in_english_reasons_are_shown_as_they_are(registry, error, tmp_path, context, log):
    layer = reviewed(registry, error, tmp_path, context, log)
    feature = next(layer.getFeatures())
    assert shown_for(layer, feature) == f"1: {feature['REASON']}"
    # A reason in the user's own words stays as it is.
    assert parts_of("a large tree") == []


@pytest.mark.parametrize("end", ["", ", beside water or the border of the survey"])
def test_the_parts_of_all_reasons_are_found(end):
    for text in TEXTS[:-2]:
        for relief in ("", ", 1,234.50 ft of relief"):
            reason = text.format(width="12 m", error="0.31 m") + relief + end
            parts = parts_of(reason)
            assert parts[0][0] == text
            assert ", ".join(part.format(**figures) for part, figures in parts) == reason
