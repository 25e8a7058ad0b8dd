"""Qt 6 knows its values only by the names of their enumerations: Qt.Align.Left, not Qt.Left."""

import ast
import enum
import importlib

import pytest
from support import ROOT

FILES = sorted((ROOT / "plugin").rglob("*.py"))


def unscoped_values(source):
    """Return the values of enumerations in source code that are named without these."""
    tree, known = ast.parse(source), {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and (node.module or "").partition(".")[0] == "qgis":
            module = importlib.import_module(node.module)
            known.update({name.asname or name.name: getattr(module, name.name, None)
                          for name in node.names})  # fmt: skip
    found = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            owner = known.get(node.value.id)
            value = getattr(owner, node.attr, None) if isinstance(owner, type) else None
            kind = type(value)
            is_value = isinstance(value, enum.Enum) or (
                # Before Python's enumerations, those of Qt were numbers with a type of their own.
                isinstance(value, int) and kind not in (int, bool)
            )
            # A name that is asked of the enumeration itself is as it should be.
            if is_value and kind is not owner:
                found.append(ast.unparse(node))
    return found


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_values_are_named_with_their_enumeration(file):
    assert unscoped_values(file.read_text(encoding="utf-8")) == []


def test_one_that_is_not_is_found():
    source = """
from qgis.PyQt.QtCore import Qt
from qgis.core import QgsUnitTypes as Units
right = Qt.AlignmentFlag.AlignLeft, Units.RenderUnit.RenderPixels
wrong = Qt.AlignLeft, Units.RenderPixels
"""
    assert unscoped_values(source) == ["Qt.AlignLeft", "Units.RenderPixels"]
