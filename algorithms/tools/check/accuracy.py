"""Figures of the vertical accuracy of heights, and the statement of the ASPRS standard.

The checkpoints, the error of their survey, land cover, and how accuracy is stated follow ASPRS
(2023): Positional Accuracy Standards for Digital Geospatial Data, edition 2, version 1.0.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...core.parameters import ParameterSet, parameter

# Fewest checkpoints for a test by the standard.
NEEDED = 30
_STANDARD = "ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 2 (2023)"


@dataclass(frozen=True)
class Accuracy(ParameterSet):
    """The accuracy class to test, and the error of the checkpoints."""

    accuracy_class: float | None = parameter(
        None,
        kind="number",
        label="Accuracy class",
        unit="m",
        minimum=0.001,
        maximum=100.0,
        empty="only figures",
        help="The vertical accuracy class that the data are to meet, as RMSE: 0.1 for the 10 cm"
        " class. It is tested by the checkpoints on land without vegetation. Empty: the figures are"
        " only reported.",
    )
    survey_error: float = parameter(
        0.0,
        label="Error of the checkpoints",
        unit="m",
        minimum=0.0,
        maximum=10.0,
        advanced=True,
        help="RMSE of the heights of the checkpoints themselves, as their survey states it. The"
        " standard adds it to that of the data: square root of the sum of the squares.",
    )


@dataclass(frozen=True)
class Figures:
    """Errors of heights in metres: height of the data minus that of the checkpoint."""

    count: int  # at least one
    rmse: float  # root mean square
    total_rmse: float  # root mean square with the error of the checkpoints
    mean: float
    median: float
    standard_deviation: float  # 0 for one error
    minimum: float
    maximum: float
    percentile_95: float  # the absolute error that 95 % of the errors do not exceed

    @property
    def text(self) -> str:
        """All figures in words."""
        return (
            f"RMSE {self.total_rmse:.3f} m, mean {self.mean:+.3f} m, of {self.count:,} (median"
            f" {self.median:+.3f}, standard deviation {self.standard_deviation:.3f},"
            f" {self.minimum:+.3f} to {self.maximum:+.3f}, 95 % within {self.percentile_95:.3f} m)"
        )

    @classmethod
    def of(cls, errors: np.ndarray, survey_error: float = 0.0) -> Figures | None:
        """Return the figures of errors in metres, shape (n,); None if there are none."""
        if not len(errors):
            return None
        square = float(np.mean(errors**2))
        values = (
            np.sqrt(square), np.sqrt(square + survey_error**2), errors.mean(), np.median(errors),
            errors.std(ddof=1) if len(errors) > 1 else 0.0, errors.min(), errors.max(),
            np.percentile(np.abs(errors), 95.0),
        )  # fmt: skip
        return cls(len(errors), *(round(float(value), 6) for value in values))


def statement(nva: Figures | None, vva: Figures | None, accuracy_class: float | None) -> str:
    """Return the statement on the accuracy of data without (`nva`) and with vegetation, in the
    words of the standard, for a class in metres if there is one.
    """
    if nva is None:
        return (
            f"No checkpoint lies on land without vegetation: this is no test by {_STANDARD}."
            f"{_accuracy('Vegetated', 'VVA', vva)}"
        )
    few = nva.count < NEEDED
    accuracies = _accuracy("Non-Vegetated", "NVA", nva) + _accuracy("Vegetated", "VVA", vva)
    reduced = (
        f" Although the Standards call for a minimum of thirty ({NEEDED}) checkpoints, this test"
        f" was performed using ONLY {nva.count} checkpoints."
    )
    tested = f"This data set was tested as required by {_STANDARD}.{reduced if few else ''}"
    if accuracy_class is None:
        return f"{tested}{accuracies}"
    named = f"a {_cm(accuracy_class)} cm RMSEV Vertical Accuracy Class"
    if nva.total_rmse > accuracy_class:
        return f"{tested} It does not meet {named}.{accuracies}"
    if few:
        return f"{tested} This data set was produced to meet {named}.{accuracies}"
    return f"This data set was tested to meet {_STANDARD} for {named}.{accuracies}"


def _accuracy(land: str, short: str, figures: Figures | None) -> str:
    if figures is None:
        return ""
    few = " using the reduced number of checkpoints" if figures.count < NEEDED else ""
    return (
        f" The {land} Vertical Accuracy ({short}) was found to be RMSEV ="
        f" {_cm(figures.total_rmse)} cm{few}."
    )


def _cm(metres: float) -> str:
    """Return metres as centimetres, with a decimal if it is not 0."""
    return f"{100.0 * metres:.1f}".removesuffix(".0")
