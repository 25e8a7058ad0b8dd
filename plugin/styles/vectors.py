"""Style of contour lines."""

from __future__ import annotations

from typing import Callable

from qgis.core import QgsLineSymbol, QgsRuleBasedRenderer, QgsVectorLayer

from ...algorithms.products.contours import INDEX, Interval
from ..i18n import tr

_THIN = {"line_color": "110,72,36,160", "line_width": "0.2"}
_THICK = {"line_color": "110,72,36,220", "line_width": "0.35"}


def contours(interval: Interval) -> Callable[[QgsVectorLayer], None]:
    """Return a function that draws contour lines in brown, every fifth line thicker."""

    def dress(layer: QgsVectorLayer) -> None:
        root = QgsRuleBasedRenderer.Rule(None)
        rule = f'round("ELEV" / {interval.height!r}) % {INDEX} = 0'
        for properties, lines in ((_THICK, INDEX), (_THIN, 1)):
            symbol = QgsLineSymbol.createSimple(properties)
            words = tr("Every {}").format(interval.text(lines))
            each = QgsRuleBasedRenderer.Rule(symbol, 0, 0, rule, words)
            root.appendChild(each)
            rule = "ELSE"
        layer.setRenderer(QgsRuleBasedRenderer(root))

    return dress
