from qgis.core import QgsPointCloudLayer, QgsProcessingContext, QgsProcessingFeedback

from bare_earth.plugin.processing.outputs import ClassStyle


def test_classes_without_a_usual_colour_are_shown_too():
    layer = QgsPointCloudLayer()
    ClassStyle([26, 2, 200]).postProcessLayer(
        layer, QgsProcessingContext(), QgsProcessingFeedback()
    )
    categories = layer.renderer().categories()
    assert [(each.value(), each.label()) for each in categories] == [
        (2, "Ground"), (26, "26"), (200, "200"),
    ]  # fmt: skip
    assert len({each.color().name() for each in categories}) == 3
