"""Which tests are left out, and how many."""

import sys
from types import SimpleNamespace

import pytest

# What tests of the project itself and of the benchmarks find out does not depend on the Python.
_SAME_IN_ANY_PYTHON = ("tests/project", "benchmarks/tests")
# But its NumPy and SciPy are older.
_NOT_THE_SAME = "test_goldens.py"


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item):
    """Leave out in Python 3.9 what newer ones run."""
    folder = item.path.parent.as_posix()
    is_same = folder.endswith(_SAME_IN_ANY_PYTHON) and item.path.name != _NOT_THE_SAME
    if sys.version_info < (3, 10) and is_same:
        pytest.skip("not in Python 3.9: it is the same in any Python")


def pytest_itemcollected(item):
    """Leave a case in the daily tests for which `rest` makes an exception by a part of its name."""
    case = getattr(getattr(item, "callspec", None), "id", "")
    for mark in [mark for mark in item.own_markers if mark.name == "rest" and mark.kwargs]:
        if mark.kwargs["but"] in case:
            item.own_markers.remove(mark)


def pytest_deselected(items):
    """Count what markers leave out, where one of several processes does it."""
    getattr(items[0].config, "workeroutput", {})["left_out"] = len(items)


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node):
    """Let the last line say how many these are: each process leaves out the same."""
    stats = node.config.pluginmanager.get_plugin("terminalreporter").stats
    count = getattr(node, "workeroutput", {}).get("left_out", 0)
    stats["deselected"] = [SimpleNamespace()] * count
