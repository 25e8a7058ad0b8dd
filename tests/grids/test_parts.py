"""Tests of the parts of a grid that hold wanted cells."""

import numpy as np
import pytest

from bare_earth.algorithms.grids.parts import parts_with

_RNG = np.random.default_rng(5)


def _corridor(shape):
    y, x = np.indices(shape)
    return np.abs(y - x - 60 * np.sin(y / 50)) < 25


@pytest.mark.parametrize("margin", [0, 7, 40])
@pytest.mark.parametrize(
    "wanted",
    [
        np.zeros((30, 40), dtype=bool), np.ones((300, 170), dtype=bool), _corridor((700, 500)),
        _RNG.random((500, 900)) < 1e-4, np.ones((1, 1), dtype=bool),
    ],
)  # fmt: skip
def test_parts_hold_all_wanted_cells_once_and_have_a_margin(wanted, margin):
    times, surrounded = np.zeros((2, *wanted.shape), dtype=int)
    for part in parts_with(wanted, margin):
        times[part.core] += 1
        surrounded[part.around] += 1
        assert np.array_equal(times[part.around][part.inner], times[part.core])
        for core, around, count in zip(part.core, part.around, wanted.shape):
            assert around.start == max(core.start - margin, 0)
            assert around.stop == min(core.stop + margin, count)
    assert times.max() <= 1
    assert times[wanted].all()


def test_parts_of_a_corridor_have_few_cells_beside_it():
    wanted = _corridor((1400, 1400))
    cells = sum(wanted[part.around].size for part in parts_with(wanted, 8))
    assert cells < 0.35 * wanted.size
    assert len(list(parts_with(np.ones((900, 900), dtype=bool), 8))) == 1
