"""Tables with the values of the presets, for the help."""

from __future__ import annotations

from html import escape
from typing import Collection, Sequence

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.filters import METHODS
from ...algorithms.filters.method import Method
from ...algorithms.tools.ground.method import TileMethod
from ..i18n import tr
from .fields import title_of

_BETWEEN = " / "
# Between the values of a list; a comma can be a part of a number.
_AMONG = "; "


def presets_of(sets: Sequence[type[ParameterSet]]) -> str:
    """Return the values of all presets of some parameters as HTML; empty if there are none."""
    is_short = TileMethod in sets
    methods = [method for method in METHODS.values() if method.parameters in sets or is_short]
    # With `TileMethod` there are no fields for the values, and only presets of all methods.
    offered = next(
        declared.choices for declared in TileMethod.declarations() if declared.name == "preset"
    )
    tables = "".join(
        f"{tr(method.label)}:{_table(method, offered if is_short else method.presets)}"
        for method in methods
        if method.presets
    )
    words = "<b>Values of the presets</b>"
    if not is_short:
        words += " for fields that are left empty"
    return f"{words}<br/>{tables}" if tables else ""


def _table(method: Method, offered: Collection[str]) -> str:
    declared = {parameter.name: parameter for parameter in method.parameters.declarations()}
    labels = declared["preset"].choices
    rows = {name: preset._asdict() for name, preset in method.presets.items() if name in offered}
    # Only parameters in which the presets differ. The classic preset is not compared, since it
    # differs in all of them, and that many columns would not fit.
    usual = [row for name, row in rows.items() if name != method.classic]
    columns = [name for name in declared if len({row.get(name) for row in usual}) > 1]
    # All values share one column, and the titles are above both columns, because there is little
    # space beside the fields of a dialog.
    head = _BETWEEN.join(escape(title_of(declared[name])) for name in columns)
    body = "".join(
        f"<tr><td>{escape(tr(labels[name]).partition(' (')[0], quote=False)}</td>"
        f"<td>{_BETWEEN.join(_shown(row.get(column)) for column in columns)}</td></tr>"
        for name, row in rows.items()
    )
    head = f'<tr><td colspan="2">{head}</td></tr>'
    return f'<table border="1" cellspacing="0" cellpadding="2">{head}{body}</table>'


def _shown(value: object) -> str:
    if value is None:
        return "-"
    values = value if isinstance(value, tuple) else (value,)
    return _AMONG.join(f"{number:g}" for number in values)
