"""How contour lines look."""

from __future__ import annotations

from qgis.core import QgsLineSymbol, QgsRuleBasedRenderer, QgsVectorLayer

_THIN = {"line_color": "110,72,36,150", "line_width": "0.15"}
_THICK = {"line_color": "110,72,36,220", "line_width": "0.4"}


def contours(layer: QgsVectorLayer) -> None:
    """Draw lines in brown, those that are marked as index contours thicker."""
    root = QgsRuleBasedRenderer.Rule(None)
    for properties, rule, label in (
        (_THICK, '"IS_INDEX" = 1', "Index contour"), (_THIN, '"IS_INDEX" = 0', "Contour"),
    ):  # fmt: skip
        symbol = QgsLineSymbol.createSimple(properties)
        root.appendChild(QgsRuleBasedRenderer.Rule(symbol, 0, 0, rule, label))
    layer.setRenderer(QgsRuleBasedRenderer(root))
