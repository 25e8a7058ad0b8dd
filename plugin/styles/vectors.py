"""How contour lines look."""

from __future__ import annotations

from typing import Callable

from qgis.core import QgsLineSymbol, QgsRuleBasedRenderer, QgsVectorLayer

from ...algorithms.products.contours import INDEX
from ..i18n import tr

_THIN = {"line_color": "110,72,36,160", "line_width": "0.2"}
_THICK = {"line_color": "110,72,36,220", "line_width": "0.35"}


def contours(interval: float) -> Callable[[QgsVectorLayer], None]:
    """Return what draws contour lines in brown, each fifth of them thicker."""

    def dress(layer: QgsVectorLayer) -> None:
        root = QgsRuleBasedRenderer.Rule(None)
        rule = f'round("ELEV" / {interval!r}) % {INDEX} = 0'
        for properties, step in ((_THICK, INDEX * interval), (_THIN, interval)):
            symbol = QgsLineSymbol.createSimple(properties)
            words = tr("Each {:g}").format(step)
            each = QgsRuleBasedRenderer.Rule(symbol, 0, 0, rule, words)
            root.appendChild(each)
            rule = "ELSE"
        layer.setRenderer(QgsRuleBasedRenderer(root))

    return dress
