"""The tests of the benchmarks leave long ones out, as those in tests/core do."""

from conftest import pytest_runtest_setup  # noqa: F401
