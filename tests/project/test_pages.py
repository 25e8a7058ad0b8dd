"""Pages name files that are there and parameters as declared; tests call no private function."""

import ast
import re
from pathlib import Path

import parameter_page
import pytest
from shipped import tree_of

ROOT = Path(__file__).parents[2]
# Of named tuples, of the system, and of these tests themselves.
_NOT_PRIVATE = ("_replace", "_exit", "_on_full_disks")
_NAMED = re.compile(r"`((?:algorithms|plugin|tests|tools|benchmarks|docs)/[\w/.\-]*)`")


@pytest.mark.parametrize("page", ["ARCHITECTURE.md", "CONTRIBUTING.md"])
def test_the_files_that_a_page_names_are_there(page):
    named = _NAMED.findall((ROOT / page).read_text(encoding="utf-8"))
    assert named
    assert [path for path in named if not (ROOT / path).exists()] == []


def test_the_architecture_names_every_room():
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    rooms = {path.parent.name for path in (ROOT / "algorithms").glob("*/__init__.py")}
    assert {room for room in rooms if f"`algorithms/{room}/`" not in text} == set()


def test_the_page_of_all_parameters_is_what_is_declared():
    page = parameter_page.PAGE.read_text(encoding="utf-8")
    assert page == parameter_page.text(), "run tools/parameter_page.py"


def test_a_page_explains_each_noun_of_the_engine_once():
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    table = text.split("## The nouns of the engine")[1].split("\n## ")[0]
    explained = re.findall(r"`([A-Z]\w+)`", re.sub(r"; `\w+` chooses", "", table))
    nouns = []
    for path in (ROOT / "algorithms" / "engine").glob("*.py"):
        nouns += [node.name for node in tree_of(path).body if isinstance(node, ast.ClassDef)]
    assert len(nouns) <= 57
    assert sorted(explained) == sorted(name for name in nouns if name[0] != "_")


def _private_calls(path):
    """Yield what a test calls or replaces of others that begins with one underscore."""
    # Most files have no such name at all, and to look through all of them takes seconds.
    if not re.search(r"""[.'"]_[a-z]""", path.read_text(encoding="utf-8")):
        return
    for node in ast.walk(tree_of(path)):
        names = []
        if isinstance(node, ast.Attribute) and getattr(node.value, "id", "") not in ("self", "cls"):
            names = [node.attr]
        elif isinstance(node, ast.Call) and getattr(node.func, "attr", "") in ("setattr", "patch"):
            names = [argument.value for argument in node.args if isinstance(argument, ast.Constant)]
        for name in map(str, names):
            if re.match(r"_[a-z]", name) and name not in _NOT_PRIVATE:
                yield f"{path.name}:{node.lineno}: {name}"


def test_tests_call_and_replace_no_private_function():
    """Sizes, which are written in capitals, they may set: so a small cloud has many pieces."""
    found = [
        call for path in sorted((ROOT / "tests").rglob("*.py")) for call in _private_calls(path)
    ]
    assert found == []


def _rows(path, filters):
    """Return the cells of the first rows of a page that begin with the names of filters."""
    rows = {}
    for line in (ROOT / path).read_text(encoding="utf-8").splitlines():
        name, *values = [cell.strip() for cell in line.strip("|").split("|")]
        if name in filters and name not in rows:
            rows[name] = values
    return rows


def test_pages_tell_the_errors_that_the_report_has():
    filters = "**TIN densification**", "**Grid minimum**", "**Slope filter**"
    report = _rows("benchmarks/results/accuracy.md", filters)
    page = _rows("docs/how-accurate.md", filters)
    readme = _rows("README.md", filters)
    for name in filters:
        mean = report[name][-1]
        assert page[name][0] == mean
        assert readme[name][0] == f"{mean.split()[0]} %"
        assert readme[name][1] == f"{page[name][3]} %"
