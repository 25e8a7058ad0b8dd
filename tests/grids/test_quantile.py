"""Quantiles of values that come in parts."""

import numpy as np
import pytest

from bare_earth.algorithms.grids.quantile import quantile_of


@pytest.mark.parametrize("share", [0.0, 0.3, 0.95, 1.0])
@pytest.mark.parametrize("count", [1, 2, 20, 1001])
def test_a_quantile_of_parts_is_that_of_all_values(share, count):
    values = np.random.default_rng(count).normal(0.1, 1.0, count).astype(np.float32)
    values[::7] = values[0]  # many are equal
    values = np.insert(values, [0, count // 2], np.nan)
    found = quantile_of(lambda: np.array_split(values, 3), share)
    assert found == pytest.approx(np.nanquantile(values.astype(np.float64), share), abs=1e-12)


def test_there_is_no_quantile_without_values():
    assert np.isnan(quantile_of(lambda: [np.full(3, np.nan, np.float32)], 0.5))
