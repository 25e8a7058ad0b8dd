"""Where the grids of the filters start relative to the points, moved in fixed ways.

A filter that puts points into cells depends on where the cells begin. One figure of one phase can
be luck, so each is the mean of the phases below, given with its range.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np

from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.tools.assess import Assessment

# Metres by which the points are moved to the east and the north: as they came, then spread evenly
# over a cell of 1 m (the R2 sequence of Roberts 2018, in whole centimetres).
PHASES = (
    (0.00, 0.00), (0.75, 0.57), (0.51, 0.14), (0.26, 0.71), (0.02, 0.28), (0.77, 0.85),
    (0.53, 0.42), (0.28, 0.99), (0.04, 0.56), (0.79, 0.13), (0.55, 0.70), (0.30, 0.27),
)  # fmt: skip


def shifted(cloud: PointCloud, east: float, north: float) -> PointCloud:
    """Return the cloud moved by metres; its integers, columns and order stay what they are.

    The cells of the filters begin at the zero of the CRS, so that the points move against them.
    """
    unit = cloud.crs.horizontal_unit
    x, y, z = cloud.offset
    return replace(cloud, offset=(x + east / unit, y + north / unit, z))


class Range(NamedTuple):
    """A figure over the phases."""

    mean: float
    least: float
    most: float

    @classmethod
    def of(cls, values: np.ndarray) -> Range:
        """Return mean, least and most of some values."""
        return cls(float(np.mean(values)), float(np.min(values)), float(np.max(values)))


def _mean_of(figure: str) -> property:
    return property(lambda phased: phased.range(figure).mean, doc="Mean over the phases.")


class Phased(NamedTuple):
    """The assessments of one filter on one sample, one for each phase, that as it came first.

    The figures have the names that those of an assessment have, and are means over the phases.
    """

    assessments: tuple[Assessment, ...]

    def values(self, figure: str) -> np.ndarray:
        """Return one figure of all phases."""
        return np.array([getattr(assessment, figure) for assessment in self.assessments])

    def range(self, figure: str) -> Range:
        """Return one figure over the phases."""
        return Range.of(self.values(figure))

    total_error = _mean_of("total_error")
    kappa = _mean_of("kappa")
    type_1_error = _mean_of("type_1_error")
    type_2_error = _mean_of("type_2_error")


def over_samples(results: dict[str, Phased], figure: str) -> Range:
    """Return the mean of one figure over the samples: over the phases, the least and the most."""
    return Range.of(np.mean([phased.values(figure) for phased in results.values()], axis=0))
