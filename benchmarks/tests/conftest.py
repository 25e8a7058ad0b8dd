"""The tests of the benchmarks leave long ones out, as those in tests/ do."""

from left_out import pytest_runtest_setup  # noqa: F401
