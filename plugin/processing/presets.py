"""The values of the presets, to be seen before a run."""

from __future__ import annotations

import dataclasses
from html import escape
from typing import Any, Collection, Sequence

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.engine.options import TileMethod
from ...algorithms.filters import METHODS
from ...algorithms.filters.method import Method
from ..i18n import tr
from .fields import title_of

_BETWEEN = " / "


def presets_of(sets: Sequence[type[ParameterSet]]) -> str:
    """Return what the presets among some parameters stand for, in HTML; empty if there are none."""
    is_short = TileMethod in sets
    methods = [each for each in METHODS.values() if each.parameters in sets or is_short]
    # In short there are neither fields for the values, nor the presets of one method alone.
    offered = next(each.choices for each in TileMethod.declarations() if each.name == "preset")
    tables = "".join(
        f"{tr(each.label)}:{_table(each, offered if is_short else each.presets)}"
        for each in methods
        if each.presets
    )
    words = tr("<b>Values of the presets</b> for fields that are left empty")
    if is_short:
        words = tr("<b>Values of the presets</b>")
    return f"{words}<br/>{tables}" if tables else ""


def _table(method: Method, offered: Collection[str]) -> str:
    declared = {each.name: each for each in method.parameters.declarations()}
    labels = declared["preset"].choices
    rows = {name: _values_of(preset) for name, preset in method.presets.items() if name in offered}
    # Too many columns do not fit; a classic preset alone, which differs in all, needs none.
    usual = [row for name, row in rows.items() if name != method.classic]
    columns = [name for name in declared if len({row.get(name) for row in usual}) > 1]
    # All values in one column, and its title above both: beside the fields of a dialog, they would
    # be narrower than a word else.
    head = _BETWEEN.join(escape(title_of(declared[name])) for name in columns)
    body = "".join(
        f"<tr><td>{escape(tr(labels[name]).partition(' (')[0], quote=False)}</td>"
        f"<td>{_BETWEEN.join(_shown(row.get(each)) for each in columns)}</td></tr>"
        for name, row in rows.items()
    )
    head = f'<tr><td colspan="2">{head}</td></tr>'
    return f'<table border="1" cellspacing="0" cellpadding="2">{head}{body}</table>'


def _values_of(preset: Any) -> dict[str, Any]:
    return dataclasses.asdict(preset) if dataclasses.is_dataclass(preset) else preset._asdict()


def _shown(value: Any) -> str:
    if value is None:
        return "-"
    values = value if isinstance(value, tuple) else (value,)
    return ", ".join(f"{each:g}" for each in values)
