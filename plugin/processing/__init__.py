"""The Processing algorithms, each a thin wrapper of the classifier."""

from .tin_densification import TinDensificationAlgorithm

ALGORITHMS = (TinDensificationAlgorithm,)
