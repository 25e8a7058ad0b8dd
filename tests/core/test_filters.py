"""What every ground filter has to do, whatever its rules."""

import numpy as np
import pytest
from scenes import village

from bare_earth.algorithms.errors import Cancelled
from bare_earth.algorithms.filters import METHODS, method_of
from bare_earth.algorithms.filters.slope import SlopeFilter
from bare_earth.algorithms.points import Points
from bare_earth.algorithms.progress import Progress

PARAMETERS = [
    *(method.parameters() for method in METHODS.values()),
    SlopeFilter(preset="whitebox"),
    SlopeFilter(slope_norm=False),
]


@pytest.mark.parametrize("parameters", PARAMETERS)
@pytest.mark.parametrize("count", [1, 2, 3, 10])
def test_a_handful_of_points_is_classified_without_an_error(parameters, count):
    line = np.arange(count, dtype=float)
    points = Points(3.0 * line, 2.0 * line, 0.1 * line)
    assert method_of(parameters).classify(points, parameters).all()


@pytest.mark.parametrize("parameters", PARAMETERS)
def test_a_cancel_ends_the_classification(parameters):
    class Stop(Progress):
        def report(self, fraction):
            if fraction > 0.3:
                raise Cancelled

    with pytest.raises(Cancelled):
        method_of(parameters).classify(village()[0], parameters, Stop())
