"""Styles of contour lines, of errors at checkpoints, of water, and of places to review."""

from __future__ import annotations

from typing import Callable

from qgis.core import (
    QgsEditorWidgetSetup,
    QgsFillSymbol,
    QgsHashedLineSymbolLayer,
    QgsLineSymbol,
    QgsMarkerSymbol,
    QgsPalLayerSettings,
    QgsRuleBasedLabeling,
    QgsRuleBasedRenderer,
    QgsSingleSymbolRenderer,
    QgsTextBufferSettings,
    QgsTextFormat,
    QgsVectorLayer,
    QgsVectorLayerSimpleLabeling,
)
from qgis.PyQt.QtGui import QColor

from ...algorithms.survey.vector_files import ANSWER_FIELD, CLASS_FIELD
from ...algorithms.tools.check.results import COLOURS, NOT_COUNTED, limits_of
from ...algorithms.tools.contours import INDEX, Interval
from .. import compat
from ..i18n import mark, tr
from .reasons import in_own_language

_THIN = {"line_color": "110,72,36,160", "line_width": "0.2"}
_THICK = {"line_color": "110,72,36,220", "line_width": "0.35"}
_TICKS_APART = 4.0  # millimetres
_TICK = 1.0  # millimetres
# Fill and outline of water by its grade; the last one is that of all others.
_WATER = {
    "given": ("70,140,220,190", "20,80,170"),
    "certain": ("70,140,220,190", "20,80,170"),
    "likely": ("130,185,235,170", "20,80,170"),
    "doubtful": ("190,215,240,150", "150,90,30"),
}
_SHORE_COLOUR = "#1450aa"
_SHORE = {"line_color": _SHORE_COLOUR, "line_width": "0.4"}
# Of places to review, by their answer: text of the legend, and colour.
ANSWERS = {
    "": (mark("To review"), "#c23b3f"),
    "right": (mark("Right as it is"), "#2e8b57"),
    "not ground": (mark("Not ground"), "#d97a00"),
    "ground": (mark("Ground"), "#7a4a1e"),
    "skip": (mark("Skipped"), "#7d8794"),
}
_MOST_REASONS = 10_000  # that a project file holds in two languages
# Of the labels: colours of text and halo.
_TEXT = (96, 60, 28)
_HALO = (255, 255, 255, 200)
_SIZE = 7.0  # points
_HALO_SIZE = 0.7  # millimetres


def contours(interval: Interval) -> Callable[[QgsVectorLayer], None]:
    """Return a function that draws contour lines in brown, every fifth line thicker with label, and
    depressions with ticks that point down.
    """

    def dress(layer: QgsVectorLayer) -> None:
        root = QgsRuleBasedRenderer.Rule(None)
        is_index = f'round("ELEV" / {interval.height!r}) % {INDEX} = 0'
        is_depression = '"DEPRESSION" = 1'
        is_drawing = layer.fields().lookupField("ELEV") < 0
        if is_drawing:  # DXF has layers in place of fields
            is_index, is_depression = "\"Layer\" LIKE '%INDEX'", "\"Layer\" LIKE 'DEPRESSION%'"
        kinds = (_THICK, INDEX, is_index), (_THIN, 1, f"NOT ({is_index})")
        for properties, lines, rule in kinds:
            symbol = QgsLineSymbol.createSimple(properties)
            words = tr("Every {}").format(interval.in_words(lines))
            root.appendChild(QgsRuleBasedRenderer.Rule(symbol, 0, 0, rule, words))
        rule = QgsRuleBasedRenderer.Rule(_ticks(), 0, 0, is_depression, tr("Depression"))
        root.appendChild(rule)
        layer.setRenderer(QgsRuleBasedRenderer(root))
        if is_drawing:
            return
        labels = QgsRuleBasedLabeling.Rule(None)
        labels.appendChild(QgsRuleBasedLabeling.Rule(_height(), 0, 0, is_index))
        layer.setLabeling(QgsRuleBasedLabeling(labels))
        layer.setLabelsEnabled(True)

    return dress


def residuals(scale: float) -> Callable[[QgsVectorLayer], None]:
    """Return a function that colours checkpoints by their errors: blue below, red above."""
    limits = limits_of(scale)
    words = [
        f"< {limits[0]:+g} m",
        *(f"{low:+g} … {high:+g} m" for low, high in zip(limits, limits[1:])),
        f"> {limits[-1]:+g} m",
    ]
    bounds = [*(f'"ERROR" < {limit!r}' for limit in limits), '"ERROR" IS NOT NULL']

    def dress(layer: QgsVectorLayer) -> None:
        root = QgsRuleBasedRenderer.Rule(None)
        for colour, label, number in zip(COLOURS, words, range(len(words))):
            rule = f"\"STATE\" = 'counted' AND {bounds[number]}"
            if number:
                rule += f' AND "ERROR" >= {limits[number - 1]!r}'
            root.appendChild(QgsRuleBasedRenderer.Rule(_mark(colour), 0, 0, rule, label))
        others = _mark(NOT_COUNTED, "2")
        root.appendChild(QgsRuleBasedRenderer.Rule(others, 0, 0, "ELSE", tr("Not counted")))
        layer.setRenderer(QgsRuleBasedRenderer(root))

    return dress


def water(layer: QgsVectorLayer) -> None:
    """Draw water in blue, the paler the less certain."""
    words = {
        "given": tr("Given"), "certain": tr("Certain"), "likely": tr("Likely"),
        "doubtful": tr("Doubtful"),
    }  # fmt: skip
    root = QgsRuleBasedRenderer.Rule(None)
    for grade, (fill, outline) in _WATER.items():
        symbol = QgsFillSymbol.createSimple(
            {"color": fill, "outline_color": outline, "outline_width": "0.3"}
        )
        rule = f"\"GRADE\" = '{grade}'"
        root.appendChild(QgsRuleBasedRenderer.Rule(symbol, 0, 0, rule, words[grade]))
    layer.setRenderer(QgsRuleBasedRenderer(root))


def changes(layer: QgsVectorLayer) -> None:
    """Outline what rose in blue and what sank in red, thinner what is probably no earth."""
    root = QgsRuleBasedRenderer.Rule(None)
    is_meant = "(\"KIND\" = 'earth' OR \"KIND\" LIKE 'canopy %')"
    rules = (
        (tr("Risen"), "#21598f", f'"MEAN" >= 0 AND {is_meant}', "0.6"),
        (tr("Sunk"), "#9c2f2b", f'"MEAN" < 0 AND {is_meant}', "0.6"),
        (tr("Probably no earth"), "#5b5b5b", "ELSE", "0.3"),
    )
    for text, colour, rule, width in rules:
        symbol = QgsFillSymbol.createSimple(
            {"style": "no", "outline_color": colour, "outline_width": width}
        )
        root.appendChild(QgsRuleBasedRenderer.Rule(symbol, 0, 0, rule, text))
    layer.setRenderer(QgsRuleBasedRenderer(root))


def places(layer: QgsVectorLayer) -> None:
    """Draw places to review with their rank, coloured by their answer, which the form asks for."""
    root = QgsRuleBasedRenderer.Rule(None)
    for answer, (text, colour) in ANSWERS.items():
        fill = QColor(colour)
        fill.setAlpha(44)
        symbol = QgsFillSymbol.createSimple({"outline_color": colour, "outline_width": "0.5"})
        symbol.symbolLayer(0).setFillColor(fill)
        rule = f"coalesce(\"{ANSWER_FIELD}\", '') = '{answer}'"
        root.appendChild(QgsRuleBasedRenderer.Rule(symbol, 0, 0, rule, tr(text)))
    layer.setRenderer(QgsRuleBasedRenderer(root))
    layer.setLabeling(QgsVectorLayerSimpleLabeling(_rank()))
    layer.setLabelsEnabled(True)
    layer.setDisplayExpression('"RANK" || \': \' || represent_value("REASON")')
    choices = [{tr(text): answer} for answer, (text, _) in ANSWERS.items() if answer]
    classes = [{tr("Ground"): 2}, {tr("Not ground"): 1}, {tr("Low noise"): 7}, {tr("Water"): 9}]
    fields, form = layer.fields(), layer.editFormConfig()
    for number in range(fields.count()):
        form.setReadOnly(number, fields[number].name().lower() not in (ANSWER_FIELD, CLASS_FIELD))
    layer.setEditFormConfig(form)
    shown = {ANSWER_FIELD: choices, CLASS_FIELD: classes}
    if reasons := _reasons(layer):
        shown["REASON"] = reasons
    for name, values in shown.items():
        widget = QgsEditorWidgetSetup("ValueMap", {"map": values})
        layer.setEditorWidgetSetup(fields.lookupField(name), widget)


def _reasons(layer: QgsVectorLayer) -> list[dict[str, str]]:
    """Return the reasons in a layer by what is shown for them; none if this is the same."""
    values = layer.uniqueValues(layer.fields().lookupField("REASON"), _MOST_REASONS)
    texts = sorted(str(value) for value in values if not compat.is_null(value))
    shown = [{in_own_language(text): text} for text in texts]
    return shown if any({text: text} != one for text, one in zip(texts, shown)) else []


def low_confidence(layer: QgsVectorLayer) -> None:
    """Draw low confidence areas hatched, so that what lies below is seen."""
    symbol = QgsFillSymbol.createSimple(
        {
            "style": "b_diagonal", "color": "120,60,140", "outline_color": "120,60,140",
            "outline_width": "0.4",
        }
    )  # fmt: skip
    layer.setRenderer(QgsSingleSymbolRenderer(symbol))


def breaklines(layer: QgsVectorLayer) -> None:
    """Draw breaklines of water in dark blue."""
    # Not a symbol for the renderer that is there: the legend would keep the random colour of QGIS.
    layer.setRenderer(QgsSingleSymbolRenderer(QgsLineSymbol.createSimple(_SHORE)))
    compat.colour_profile(layer, _SHORE_COLOUR)


def _mark(colour: str, size: str = "3") -> QgsMarkerSymbol:
    return QgsMarkerSymbol.createSimple(
        {"name": "circle", "color": colour, "size": size, "outline_color": "#333333"}
    )


def _ticks() -> QgsLineSymbol:
    """Return ticks on the right of a line, where a contour line has the lower land."""
    ticks = QgsHashedLineSymbolLayer(True, _TICKS_APART)
    ticks.setSubSymbol(QgsLineSymbol.createSimple(_THIN))
    ticks.setHashLength(_TICK)
    ticks.setOffset(_TICK / 2)
    symbol = QgsLineSymbol()
    symbol.changeSymbolLayer(0, ticks)
    return symbol


def _rank() -> QgsPalLayerSettings:
    """Return the settings of labels of places: the rank, and whether there is an answer."""
    settings = _label(9.0, QColor("#5a1414"))
    marks = (
        f"WHEN \"{ANSWER_FIELD}\" = 'skip' THEN ' …' WHEN \"{ANSWER_FIELD}\" > '' THEN ' ✓' ELSE ''"
    )
    settings.fieldName, settings.isExpression = f'"RANK" || CASE {marks} END', True
    settings.centroidInside = True
    compat.place_over_points(settings)
    return settings


def _label(size: float, colour: QColor) -> QgsPalLayerSettings:
    """Return the settings of labels with a white halo."""
    halo = QgsTextBufferSettings()
    halo.setEnabled(True)
    halo.setSize(_HALO_SIZE)
    halo.setColor(QColor(*_HALO))
    text = QgsTextFormat()
    text.setSize(size)
    text.setColor(colour)
    text.setBuffer(halo)
    settings = QgsPalLayerSettings()
    settings.setFormat(text)
    return settings


def _height() -> QgsPalLayerSettings:
    """Return the settings of labels of contour lines: the height, on the line."""
    settings = _label(_SIZE, QColor(*_TEXT))
    settings.fieldName = "ELEV"
    compat.place_on_line(settings)
    return settings
