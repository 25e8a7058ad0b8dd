"""What docstrings hold: numpydoc for what `bare_earth` exports, one sentence for all else."""

import ast
import re

import pytest
from shipped import ROOT, SHIPPED, name_of, tree_of
from stub import stubs

_DEFINITIONS = (ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
_SECTION = re.compile(r"^\s*-{3,}\s*$", re.MULTILINE)
# A sentence that another one follows; initials of names end none.
_END = re.compile(r"(?<!\b[A-Z])[.!?][\"'`)]*\s+(?=[A-Z`])")
_MOST_LINES = 3


def _file_of(module):
    return module / "__init__.py" if module.is_dir() else module.with_suffix(".py")


def _exported():
    """Return the file and the name there of all that `bare_earth` exports or returns."""
    return {
        (_file_of(ROOT.joinpath(*node.module.split("."))), name.name)
        for text in stubs().values()
        for node in ast.parse(text).body
        if isinstance(node, ast.ImportFrom) and node.level == 1
        for name in node.names
    }


def _definitions(node, exported, is_public=False):
    """Yield classes and functions inside a node, each with whether users see its docstring."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.expr):
            continue
        if not isinstance(child, _DEFINITIONS):
            yield from _definitions(child, exported, is_public)
            continue
        name = child.name
        if isinstance(node, ast.Module):
            shown = name in exported
        else:
            hidden = name.startswith("_") and not name.endswith("__")
            shown = is_public and isinstance(node, ast.ClassDef) and not hidden
        yield child, shown
        yield from _definitions(child, exported, shown)


def _too_long(tree, exported):
    """Return the lines of definitions that are not exported and say more than a sentence."""
    return [
        node.lineno
        for node, shown in _definitions(tree, exported)
        if not shown and not _is_sentence(ast.get_docstring(node) or "")
    ]


def _is_sentence(text):
    is_short = len(text.splitlines()) <= _MOST_LINES
    return is_short and "\n\n" not in text and not _SECTION.search(text) and not _END.search(text)


def test_only_what_is_exported_has_a_long_docstring():
    exported, wrong = _exported(), []
    assert len(exported) > 15
    for path in SHIPPED:
        names = {name for place, name in exported if place == path}
        wrong += [f"{name_of(path)}:{line}" for line in _too_long(tree_of(path), names)]
    assert not wrong, f"more than one sentence, see CONTRIBUTING.md: {wrong}"


def test_what_is_exported_describes_its_parameters():
    for path, name in sorted(_exported()):
        found = {node.name: node for node in tree_of(path).body if isinstance(node, _DEFINITIONS)}
        node = found.get(name)  # none for `__version__`
        if isinstance(node, ast.FunctionDef):
            text = ast.get_docstring(node) or ""
            assert "\nParameters\n---" in text, f"{name_of(path)}:{node.lineno}"


@pytest.mark.parametrize(
    ("text", "is_right"),
    [
        ("Return the slope of a surface, rise over run; NaN where there is none.", True),
        ("Blend as Horn, B. K. P. Horn, does, e.g. by `weights`.", True),
        ("Return the slope. It is a rise over run.", False),
        ("Return the slope.\n\n    NaN where there is none.", False),
        ("Return the slope.\n    Returns\n    -------\n    float", False),
        ("Return\n    a slope,\n    which\n    is long.", False),
    ],
)
def test_what_counts_as_a_sentence(text, is_right):
    tree = ast.parse(f'def exported():\n    """{text}"""\n    def inner():\n        """{text}"""\n')
    assert len(_too_long(tree, {"exported"})) == (0 if is_right else 1)
    assert len(_too_long(tree, set())) == (0 if is_right else 2)


def test_private_methods_of_what_is_exported_say_a_sentence():
    text = '"""Return a slope. It is a rise."""'
    names = ["public", "_private", "__call__"]
    methods = [f" def {name}(self):\n  {text}\n" for name in names]
    assert _too_long(ast.parse("class A:\n" + "".join(methods)), {"A"}) == [4]
