"""The runs that the project remembers, so that a review finds their points and repeats them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, Iterable, Mapping, NamedTuple, Sequence

from qgis.core import (
    QgsApplication,
    QgsMapLayer,
    QgsProcessingAlgorithm,
    QgsProcessingOutputLayerDefinition,
    QgsProject,
    QgsProperty,
)

from ...algorithms.remote.addresses import shown
from .. import compat
from ..styles.loaded import file_of, is_same

# Of the list in the project file.
_PLACE = "bare_earth", "runs"
# Older runs are forgotten.
_MOST = 20
# Fields of the algorithms whose runs are remembered, and the results that are classified points.
_NAMES = ("CORRECTIONS", "EXPECTED_ERROR")
_CLOUDS = ("OUTPUT", "OUTPUT_VPC", "OUTPUT_FOLDER")
# In the metadata of a field: the result of the last run that a dialog shows first.
MADE_AS = "made_as"


class PastRun(NamedTuple):
    """A run of an algorithm, with values that a project file can hold."""

    algorithm: str  # its id
    parameters: Mapping[str, object]
    results: Mapping[str, object]
    ended: float = 0.0  # seconds since 1970; 0 in projects of older versions

    @property
    def is_review(self) -> bool:
        """Whether it found places to review."""
        return self.algorithm == "bareearth:review"

    @property
    def can_be_corrected(self) -> bool:
        """Whether it classified points, so that corrections change its terrain."""
        algorithm = QgsApplication.processingRegistry().algorithmById(self.algorithm)
        has_field = algorithm is not None and algorithm.parameterDefinition("CORRECTIONS")
        return bool(has_field) and not self.is_review

    def path(self, name: str) -> str:
        """Return the file of a result, or of a parameter; empty if it was not made."""
        value = self.results.get(name) or self.parameters.get(name) or ""
        layer = QgsProject.instance().mapLayer(str(value))
        return str((layer and file_of(layer)) or value)

    @property
    def cloud(self) -> str:
        """The points of the run with their classes."""
        names = () if self.is_review else _CLOUDS
        made = (str(self.results[name]) for name in names if self.results.get(name))
        # Points that a run classifies have their old classes in its input.
        is_input = not (self.is_review or self.can_be_corrected)
        return next(made, self.path("INPUT") if is_input else "")

    def made(self, path: str) -> bool:
        """Return whether a file is a result of the run, or lies in a folder that is one."""
        places = Path(path), *Path(path).parents
        made = (Path(value) for value in self.results.values() if isinstance(value, str) and value)
        return any(is_same(value, place) for value in made for place in places)


class Sources(NamedTuple):
    """Where places to review come from; paths are empty if they are not known."""

    cloud: str = ""  # the classified points: a file, a list or a folder
    dtm: str = ""
    error: str = ""  # the expected error
    # That led from the classification to the places, in their order; empty if none can be
    # corrected.
    runs: tuple[PastRun, ...] = ()


def is_remembered(algorithm: QgsProcessingAlgorithm) -> bool:
    """Return whether the runs of an algorithm are remembered."""
    return any(algorithm.parameterDefinition(name) for name in _NAMES)


def plain_values(
    algorithm: QgsProcessingAlgorithm, parameters: Mapping[str, object]
) -> dict[str, object]:
    """Return the values of a run as a project file can hold them; those of outputs that are left
    out are None.
    """
    fields = (
        field.name()
        for field in algorithm.parameterDefinitions()
        if field.isDestination() or field.name() in parameters
    )
    return {name: _plain(parameters.get(name)) for name in fields}


def _plain(value: Any) -> object:
    if isinstance(value, QgsProcessingOutputLayerDefinition):
        value = value.sink
    if isinstance(value, QgsProperty):
        value = value.staticValue()
    if isinstance(value, QgsMapLayer):
        return value.id()
    if isinstance(value, (list, tuple)):
        return [_plain(part) for part in value]
    if compat.is_null(value) or isinstance(value, (bool, int, float)):
        return None if compat.is_null(value) else value
    if hasattr(value, "authid"):
        return value.authid() or value.toWkt()
    return shown(str(value))  # of an address, without its signature


def remember(project: QgsProject | None, run: PastRun) -> None:
    """Add a run to those of the project; only in the main thread."""
    if project is not None:
        kept = [*runs_of(project), run][-_MOST:]
        project.writeEntry(*_PLACE, json.dumps([one._asdict() for one in kept]))


def runs_of(project: QgsProject) -> list[PastRun]:
    """Return the runs of the project, the last one at the end."""
    text, _ = project.readEntry(*_PLACE, "[]")
    return [PastRun(**run) for run in json.loads(text)]


def made_last(name: str, project: QgsProject) -> str:
    """Return the file of a result of the last run with an expected error that is still there; that
    of its points is called OUTPUT.
    """
    for run in reversed(runs_of(project)):
        if Path(str(run.results.get("EXPECTED_ERROR") or "?")).is_file():
            path = run.cloud if name == "OUTPUT" else str(run.results.get(name) or "")
            return path if path and Path(path).exists() else ""
    return ""


def maker_of(path: str, runs: Iterable[PastRun]) -> PastRun | None:
    """Return the last run with this file among its results."""
    return next((run for run in reversed(list(runs)) if run.made(path)), None)


def chain_to(path: str, runs: Sequence[PastRun]) -> list[PastRun]:
    """Return the runs that led to a file, from the one that classified points."""
    chain: list[PastRun] = []
    while path and (run := maker_of(path, runs)) is not None:
        chain.insert(0, run)
        runs, path = runs[: runs.index(run)], run.path("INPUT")
        if run.can_be_corrected:
            break
    return chain


def sources_of(places: str, project: QgsProject) -> Sources:
    """Return where the places of a file come from, by the runs of the project."""
    chain = chain_to(places, runs_of(project))
    if not chain:
        return Sources()
    review = chain[-1] if chain[-1].is_review else PastRun("", {}, {})
    maker = next((run for run in reversed(chain) if not run.is_review), PastRun("", {}, {}))
    return Sources(
        review.path("POINTS") or maker.cloud,
        review.path("DTM") or maker.path("DTM"),
        review.path("INPUT") or maker.path("EXPECTED_ERROR"),
        tuple(chain) if chain[0].can_be_corrected else (),
    )
