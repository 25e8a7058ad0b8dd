"""What `make test` runs every day leaves out no tool."""

import ast

import pytest
from shipped import ROOT, tree_of

from bare_earth.algorithms.library import tool_commands

# Each function by its command, and the folders whose tests need no QGIS.
FUNCTIONS = {command: name for name, command in tool_commands().items()}
MARKS = {"rest", "long"}
FILES = [path for path in (ROOT / "tests").rglob("test_*.py") if path.parent.name != "qgis"]


def _marks(node):
    """Return the names of marks of a test; one with an exception is a mark of other cases only."""
    return {each.attr for each in node.decorator_list if isinstance(each, ast.Attribute)}


def _called(node):
    """Return the functions and the first words that are called, and all names, below a node."""
    called, names = set(), set()
    for each in ast.walk(node):
        if isinstance(each, ast.Call):
            called.add(getattr(each.func, "attr", getattr(each.func, "id", "")))
        first = getattr(each, "args" if isinstance(each, ast.Call) else "elts", None)
        if isinstance(first, list) and first and isinstance(first[0], ast.Constant):
            called.add(first[0].value)
        names |= {getattr(each, "id", ""), getattr(each, "arg", "")}
    return called, names


def _called_daily(tree):
    """Return what the daily tests of a file call, with their fixtures and helpers."""
    code = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    waiting = [name for name in code if name[:5] == "test_" and not _marks(code[name]) & MARKS]
    seen, found = set(), set()
    while waiting:
        name = waiting.pop()
        seen.add(name)
        called, names = _called(code[name])
        found |= called
        waiting += [name for name in names & {*code} if name not in seen]
    return found


@pytest.fixture(scope="module")
def called():
    return set().union(*(_called_daily(tree_of(path)) for path in FILES))


@pytest.mark.parametrize("command", FUNCTIONS)
def test_a_daily_test_runs_each_tool(called, command):
    assert {command, FUNCTIONS[command]} & called, "only tests of `make test-all` run it"


def test_a_test_with_a_mark_is_none_of_them():
    text = """
        def made(): return relief()
        {mark}
        def test_it(): made(); said("check")
    """.replace("        ", "")
    assert {"relief", "check"} <= _called_daily(ast.parse(text.format(mark="")))
    assert _called_daily(ast.parse(text.format(mark="@pytest.mark.rest"))) == set()
