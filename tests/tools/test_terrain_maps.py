"""Local relief, and the step from a point cloud to all maps."""

import numpy as np
import pytest

from bare_earth import BareEarthError
from bare_earth.algorithms.relief.local_relief import local_relief
from bare_earth.algorithms.tools.contours import Contours, Interval


def test_relief_shows_a_mound_and_not_the_slope_it_stands_on():
    y, x = np.mgrid[0:100.0, 0:120.0]
    mound = 0.4 * np.exp(-((x - 60) ** 2 + (y - 50) ** 2) / 8)
    relief = local_relief(1000 + 0.2 * x - 0.1 * y + mound, (1.0, 1.0), 20.0)
    assert np.unravel_index(relief.argmax(), relief.shape) == (50, 60)
    assert relief.max() == pytest.approx(0.4, abs=0.05)
    inner = relief[35:65, 80:85]
    assert np.abs(inner).max() < 0.01


def test_relief_does_not_see_cells_without_a_height():
    heights = np.full((40, 40), 500.0)
    heights[:, 20:] = np.nan
    relief = local_relief(heights, (1.0, 1.0), 10.0)
    assert np.array_equal(np.isnan(relief), np.isnan(heights))
    assert np.abs(relief[:, :20]).max() < 1e-3
    assert np.isnan(local_relief(np.full((3, 3), np.nan), (1.0, 1.0), 10.0)).all()


@pytest.mark.parametrize(
    ("low", "high", "interval"),
    [(130.0, 172.0, 2.0), (0.0, 1000.0, 50.0), (-1.0, 1.2, 0.2), (5.0, 5.0, 0.2)],
)
def test_the_interval_of_contours_is_a_round_number_for_about_twenty_lines(low, high, interval):
    assert Contours().interval(low, high) == pytest.approx(interval)
    assert Contours(contour_interval=0.3).interval(low, high) == 0.3


def test_an_interval_tells_its_unit_if_it_has_one():
    assert Interval(2.5, "US survey ft").in_words(5) == "12.5 US survey ft"
    assert Interval(0.25).in_words() == "0.25"


def test_an_interval_must_be_positive():
    with pytest.raises(BareEarthError, match="Contour interval"):
        Contours(contour_interval=0.0)
