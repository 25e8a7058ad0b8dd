"""The tests of the benchmarks run as those in tests/core do: long ones only if they are asked for."""

from conftest import pytest_runtest_setup  # noqa: F401
