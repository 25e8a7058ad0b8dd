"""Inputs that belong to one run, such as an expected error and its terrain model."""

from __future__ import annotations

from pathlib import Path
from typing import Iterable, Iterator

from qgis.core import QgsApplication, QgsProcessingParameterDefinition, QgsProject

from ...algorithms.classes.ground_classes import GroundClasses
from ...algorithms.classes.selection import Selection
from ...algorithms.delivery.parameters import DeliveryChoice
from ...algorithms.filters import METHODS
from ...algorithms.remote.addresses import is_address
from ...algorithms.tools.ground.method import TileMethod
from ...algorithms.tools.input_groups import GROUPS
from .. import compat
from ..i18n import mark
from ..styles.loaded import is_same, sources_of
from .feedback import Refusal
from .runs import PastRun, chain_to, maker_of, runs_of

_OTHERS = mark('"{}" is from the run "{}", and "{}" from "{}": choose both from one run.')
# What decides about the ground and the terrain: the source, what is drawn by hand, and these sets.
_SETS = (
    TileMethod, Selection, GroundClasses, DeliveryChoice,
    *(method.parameters for method in METHODS.values()),
)  # fmt: skip
_SOURCES = ("INPUT", "INPUT_FOLDER")
_BY_HAND = tuple(
    part.field_name for group in ("corrections", "constraints") for part in GROUPS[group]
)
# Seconds between the end of a run and changes of its files that are not its own.
_AFTERWARDS = 2.0


def refuse_two_runs(paths: Iterable[str], project: QgsProject) -> None:
    """Refuse files if it is known that runs with another ground made them."""
    made = [*_made(paths, runs_of(project))]
    for other in made[1:]:
        if _is_other(made[0][1], other[1]):
            raise Refusal(_OTHERS, *_in_words(*made[0], project), *_in_words(*other, project))


def _made(paths: Iterable[str], runs: list[PastRun]) -> Iterator[tuple[str, list[PastRun]]]:
    """Yield the files that runs made that classified their points, and the runs that led there."""
    for path in filter(None, paths):
        run, file = maker_of(path, runs), Path(path)
        # Another program may have written the file since then.
        if run is None or not file.exists() or file.stat().st_mtime > run.ended + _AFTERWARDS:
            continue
        chain = chain_to(path, runs)
        # Of other points it is not known where their ground comes from.
        if chain[0].can_be_corrected:
            yield path, chain


def _in_words(path: str, chain: list[PastRun], project: QgsProject) -> tuple[str, str]:
    """Return the name of a layer, or its file, and the run that made it."""
    layers = sources_of(project, [Path(path)])
    name = project.mapLayer(layers[0].layer).name() if layers else path
    algorithm = QgsApplication.processingRegistry().algorithmById(chain[-1].algorithm)
    source = chain[0].path("INPUT") or chain[0].path("INPUT_FOLDER")
    return name, f"{algorithm.displayName()}, {Path(source).name}"


def _is_other(first: list[PastRun], second: list[PastRun]) -> bool:
    """Return whether two chains of runs give another ground; False if that is not known."""
    one, other = first[0], second[0]
    if one.algorithm != other.algorithm:
        return True
    algorithm = QgsApplication.processingRegistry().algorithmById(one.algorithm)
    names = {
        declared.name.upper()
        for kind in algorithm.parameter_sets()
        if issubclass(kind, _SETS)
        for declared in kind.declarations()
    }
    names.update((*_SOURCES, *_BY_HAND))
    fields = filter(None, map(algorithm.parameterDefinition, sorted(names)))
    return any(_is_other_value(one, other, field) for field in fields)


def _is_other_value(one: PastRun, other: PastRun, field: QgsProcessingParameterDefinition) -> bool:
    name = field.name()
    values = [run.parameters.get(name, field.defaultValue()) for run in (one, other)]
    first, second = ("" if compat.is_null(value) else str(value) for value in values)
    if first == second:
        return False
    if name not in (*_SOURCES, *_BY_HAND):
        return True
    # Of a layer that is no file, or no longer in the project, only the name is known.
    paths = [run.path(name) for run in (one, other)]
    if not all(not path or is_address(path) or Path(path).exists() for path in paths):
        return False
    return not all(paths) or not is_same(*map(Path, paths))
