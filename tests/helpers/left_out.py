"""Which tests are left out unless they are asked for."""

import sys

import pytest

# What tests of the project itself and of the benchmarks find out does not depend on the Python.
_SAME_IN_ANY_PYTHON = ("tests/project", "benchmarks/tests")
# But its NumPy and SciPy are older.
_NOT_THE_SAME = "test_goldens.py"


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item):
    """Leave long tests out, and tell of it, unless `-m` asks for them; in Python 3.9 also those
    that newer ones run.
    """
    folder = item.path.parent.as_posix()
    is_same = folder.endswith(_SAME_IN_ANY_PYTHON) and item.path.name != _NOT_THE_SAME
    if sys.version_info < (3, 10) and is_same:
        pytest.skip("not in Python 3.9: it is the same in any Python")
    if item.get_closest_marker("long") and "long" not in item.config.option.markexpr:
        pytest.skip("long: `make test-long` runs it")
