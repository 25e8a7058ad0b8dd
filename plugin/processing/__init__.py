"""The Processing algorithms, each a thin wrapper of the classifier."""

from .assess import AssessAlgorithm
from .grid_minimum import GridMinimumAlgorithm
from .slope_filter import SlopeFilterAlgorithm
from .tin_densification import TinDensificationAlgorithm

ALGORITHMS = (
    TinDensificationAlgorithm,
    GridMinimumAlgorithm,
    SlopeFilterAlgorithm,
    AssessAlgorithm,
)
