"""The tests of the benchmarks leave out what costs much, as those in tests/ do."""

from left_out import (  # noqa: F401
    pytest_deselected,
    pytest_itemcollected,
    pytest_runtest_setup,
    pytest_testnodedown,
)
