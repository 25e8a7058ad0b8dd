"""Functions on arrays that evaluate the ground: errors at checkpoints, and water."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Sequence

from ..classes.ground_classes import GroundClasses
from ..core.errors import BareEarthError
from ..core.parameters import ParameterSet
from ..core.threads import available_cpus, may_use
from ..survey.files import Survey
from ..tools import file_tool
from ..tools.check.accuracy import Accuracy
from ..tools.check.checking import CheckInputs, CheckOptions, check_points
from ..tools.check.residuals import layer_of, residuals_of
from ..tools.check.results import Check
from ..tools.check.survey_ground import SurveyGround
from ..tools.water.finding import Water
from ..tools.water.tool import water_of
from . import arguments
from .arguments import Argument, Kind
from .array_arguments import ATTRIBUTES, GROUND, LAST, POINTS
from .features import Features
from .functions import Function
from .given import checkpoints_of, progress_of
from .points import cloud_with_ground


def _ground_points(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> SurveyGround:
    """Return the ground points in the arguments of a function."""
    ground = GroundClasses.among(sets)
    cloud = cloud_with_ground(values, ground, progress_of(values.progress))
    return SurveyGround(Survey.of_cloud(cloud), ground)


def _check(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> Check:
    """Return the errors at checkpoints, or at held-out points."""
    with may_use(available_cpus()):
        inputs = CheckInputs(
            Accuracy.among(sets), CheckOptions.among(sets), GroundClasses.among(sets),
            _ground_points(values, sets), checkpoints_of(values), vegetated=values.vegetated,
        )  # fmt: skip
        return check_points(inputs, progress_of(values.progress))


_VEGETATED = Argument.of(
    "vegetated", "words", "land covers with one of these words are vegetated, and no others"
)


def of_check() -> Function:
    """Return the function `check`."""
    return Function(
        "check",
        "Compare the ground with checkpoints, or with ground points that are held out.\nThe figures"
        " are those of check() for a file with the same points.",
        POINTS,
        (
            GROUND, *ATTRIBUTES, *arguments.of_group("checkpoints"), _VEGETATED, *LAST,
        ),
        (Accuracy, CheckOptions, GroundClasses),
        _check,
        Check,
    )  # fmt: skip


def _residuals(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> Features:
    points, options = _ground_points(values, sets), CheckOptions.among(sets)
    checkpoints = checkpoints_of(values)
    if checkpoints is None:
        raise BareEarthError("Give checkpoints.")
    with may_use(available_cpus()):
        residuals = residuals_of(
            points, checkpoints, (None, None), (), tuple(values.vegetated or ()),
            options.max_edge, progress_of(values.progress),
        )  # fmt: skip
    return Features.of(*layer_of(residuals, points.survey.crs))


def of_residuals() -> Function:
    """Return the function `residuals`."""
    return Function(
        "residuals",
        "Measure the error of the ground at each checkpoint.\nThe values are those of the layer"
        " that check() writes.",
        POINTS,
        (GROUND, *ATTRIBUTES, *arguments.of_group("checkpoints"), _VEGETATED, *LAST),
        (CheckOptions, GroundClasses),
        _residuals,
        gives=Kind("Features", "The checkpoints: STATE, and where it is counted ERROR in metres."),
    )


def _water(values: SimpleNamespace, sets: Sequence[ParameterSet]) -> dict[str, Features]:
    classes, progress = GroundClasses.among(sets), progress_of(values.progress)
    with may_use(available_cpus()):
        points = _ground_points(values, sets)
        water, _ = water_of(points, Water.among(sets), classes, progress=progress)
    return {layer.name: Features.of(layer, features) for layer, features in water.layers()}


def of_water() -> Function:
    """Return the function `water`."""
    return Function(
        "water",
        f"{file_tool('water').line}\nThe polygons and lines are as water() writes them for a"
        " file with the same points.",
        POINTS,
        (GROUND, *ATTRIBUTES, *LAST),
        (Water, GroundClasses),
        _water,
        gives=Kind(
            "dict[str, Features]",
            '"water", polygons, and "breaklines", lines with heights: shores, islands, rivers.',
        ),
    )
