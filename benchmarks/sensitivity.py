"""Measures what becomes of the errors when one default is halved or doubled."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import NamedTuple, Sequence

import numpy as np

from bare_earth.algorithms.classes.point_counts import PointCounts
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.core.parameters import Declaration
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.tools.assess import AssessmentOptions, compare

from . import data
from .measure import Filter, mean
from .phases import PHASES, shifted
from .work import side_by_side

FACTORS = (0.5, 2.0)
# Which phases of the samples are measured, for time's sake.
SOME = slice(None, None, len(PHASES) // 2)


@dataclass(frozen=True)
class Change:
    """What becomes of the mean errors when one default is multiplied.

    Attributes
    ----------
    values : tuple of str
        The value on each sample, as text; one if it is the same on all.
    is_limited : bool
        Whether the value stopped at the parameter's limit.
    total_error, kappa : float
        Means over the samples; NaN if the filter refuses.
    problem : str
        Why it refuses.
    """

    values: tuple[str, ...]
    is_limited: bool
    total_error: float
    kappa: float
    problem: str = ""


class Sensitivity(NamedTuple):
    """How one parameter matters: its default, then each change."""

    declaration: Declaration
    defaults: tuple[str, ...]
    changes: tuple[Change, ...]


class Place(NamedTuple):
    """Labelled files on which defaults are moved together.

    Attributes
    ----------
    paths : tuple of Path
        The files.
    phases : tuple
        Those of the grid that each file is measured in.
    left_out : tuple of int
        Classes of the reference that do not count.
    """

    paths: tuple[Path, ...]
    phases: tuple[tuple[float, float], ...] = PHASES[:1]
    left_out: tuple[int, ...] = ()

    def clouds(self) -> Labelled:
        """Return every file in each phase, its reference, and what of it counts."""
        options = AssessmentOptions(ignored_classes=self.left_out)
        loaded = [data.load(path) for path in self.paths]
        return [
            (shifted(cloud, *phase), reference, options)
            for cloud, reference in loaded
            for phase in self.phases
        ]


Labelled = Sequence[tuple[PointCloud, np.ndarray, AssessmentOptions]]


class _Job(NamedTuple):
    """What one process does at a time: one default on all files of a place."""

    method: str
    where: str
    declaration: Declaration
    place: Place


# Method, then name of the place, then one for each parameter.
Moved = dict[str, dict[str, list[Sensitivity]]]


def sensitivity(methods: Sequence[str], places: dict[str, Place]) -> Moved:
    """Return what halving and doubling does, for each parameter that is a number above 0."""
    jobs = [
        _Job(method, where, declaration, place)
        for method in methods
        for where, place in places.items()
        for declaration in METHODS[method].parameters.declarations()
    ]
    results: Moved = {method: {where: [] for where in places} for method in methods}
    for job, moved in zip(jobs, side_by_side(_move, jobs)):
        if moved is not None:
            results[job.method][job.where].append(moved)
    return results


def _move(job: _Job) -> Sensitivity | None:
    """Return what halving and doubling one default does; None if it cannot be moved."""
    method, declaration, clouds = job.method, job.declaration, job.place.clouds()
    values = [_default(method, declaration, cloud) for cloud, _, _ in clouds]
    if not all(_is_movable(value) for value in values):
        return None
    changes = tuple(_change(method, declaration, values, factor, clouds) for factor in FACTORS)
    return Sensitivity(declaration, tuple(dict.fromkeys(map(as_text, values))), changes)


def as_text(value: object) -> str:
    """Return a number or a list of numbers in few digits."""
    if isinstance(value, tuple):
        return ", ".join(as_text(number) for number in value)
    return f"{value:g}"


def scaled(declaration: Declaration, value: object, factor: float) -> tuple[object, bool]:
    """Return a number, or a list as a whole, times a factor, and whether a limit cut it."""
    if isinstance(value, tuple):
        parts = [scaled(declaration, number, factor) for number in value]
        return tuple(part[0] for part in parts), any(part[1] for part in parts)
    wanted = value * factor
    least = -np.inf if declaration.minimum is None else declaration.minimum
    most = np.inf if declaration.maximum is None else declaration.maximum
    result = float(np.clip(wanted, least, most))
    is_limited = result != wanted
    if declaration.kind in ("integer", "integers"):
        return round(result), is_limited
    return result, is_limited


def _default(method: str, declaration: Declaration, cloud: PointCloud) -> object:
    """Return the default; where it is chosen from the points, what is chosen for these."""
    parameters = METHODS[method].parameters()
    if getattr(parameters, declaration.name) is None and hasattr(parameters, "resolve"):
        parameters = parameters.resolve(cloud.points(Selection().choose(cloud, PointCounts())))
    return getattr(parameters, declaration.name)


def _is_movable(value: object) -> bool:
    if isinstance(value, tuple):
        return bool(value) and all(map(_is_movable, value))
    return isinstance(value, (int, float)) and not isinstance(value, bool) and value > 0


def _change(
    method: str, declaration: Declaration, values: Sequence, factor: float, clouds: Labelled
) -> Change:
    moved = [scaled(declaration, value, factor) for value in values]
    texts = tuple(dict.fromkeys(as_text(value) for value, _ in moved))
    is_limited = any(limited for _, limited in moved)
    try:
        assessments = {
            str(number): compare(
                Filter(method, **{declaration.name: value}).ground(cloud), reference, options
            )
            for number, ((value, _), (cloud, reference, options)) in enumerate(zip(moved, clouds))
        }
    except BareEarthError as error:
        return Change(texts, is_limited, float("nan"), float("nan"), str(error))
    figures = (mean(assessments, figure) for figure in ("total_error", "kappa"))
    return Change(texts, is_limited, *figures)
