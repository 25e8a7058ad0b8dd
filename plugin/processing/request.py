"""A run of a dialog as values: what QGIS hands over, and what it is resolved to."""

from __future__ import annotations

from pathlib import Path
from types import MappingProxyType
from typing import Any, Mapping, NamedTuple, Sequence, Union

from qgis.core import (
    QgsMapLayer,
    QgsProcessingAlgorithm,
    QgsProcessingContext,
    QgsProcessingUtils,
)

from ...algorithms.core.parameters import ParameterSet
from ...algorithms.core.progress import SILENT
from ...algorithms.survey.files import Inputs
from ...algorithms.tools.declaration import Input
from .. import compat
from ..i18n import mark
from .cloud_crs import CloudCrs, text_of
from .feedback import Refusal
from .remote import Remote

# Values of options of the command line, by their names without dashes; empty values are left out.
Options = Mapping[str, Union[str, tuple[str, ...], None]]


class Request(NamedTuple):
    """The fields of a dialog with their values."""

    algorithm: QgsProcessingAlgorithm
    parameters: dict[str, object]
    context: QgsProcessingContext
    progress: Any = SILENT  # a `Progress`, in a run that of its feedback

    def is_empty(self, name: str) -> bool:
        """Return whether a field is empty."""
        return bool(compat.is_empty(self.parameters.get(name)))

    def read(self, kind: str, name: str, *arguments: object) -> Any:
        """Return the value of a field as QGIS reads it, by `parameterAsString` and so on."""
        read = getattr(self.algorithm, f"parameterAs{kind}")
        return read(self.parameters, name, self.context, *arguments)

    def layer_named(self, text: str) -> QgsMapLayer | None:
        """Return the layer of the project that a text names, without making one."""
        return QgsProcessingUtils.mapLayerFromString(text, self.context, False)

    @property
    def stated_crs(self) -> str | None:
        """The known CRS that the user states, as tools take it; None if the field is empty."""
        if self.algorithm.parameterDefinition("CRS") is None or self.is_empty("CRS"):
            return None
        crs = self.read("Crs", "CRS")
        if not crs.isValid():
            text = mark("{} is no known CRS. Choose one from the list.")
            raise Refusal(text, self.parameters["CRS"])
        return text_of(crs)


class GivenInput(NamedTuple):
    """The value of an input in a dialog."""

    value: Any  # as the tool gets it; None for an empty field
    options: Options = MappingProxyType({})  # of the command line
    # Of an input that the command needs: its words, files and name.
    arguments: tuple[str, ...] = ()
    paths: tuple[Path, ...] = ()
    name: str = ""
    remotes: tuple[Remote, ...] = ()  # point clouds that are not on this computer


class Resolved(NamedTuple):
    """What a run works with, as plain values."""

    declared: Sequence[Input]
    sets: Sequence[ParameterSet]
    stated: str | None  # the CRS that the user states
    # By the names of the inputs; some are read only after a download, or in the thread of the work.
    given: Mapping[str, GivenInput] = MappingProxyType({})
    points: Inputs = Inputs(())  # the files on this computer
    crs: CloudCrs = CloudCrs()  # of the points, or of the raster that is the input
    far: Sequence[str] = ()  # names of the inputs whose points are to be downloaded
    brought: Mapping[Path, str] = MappingProxyType({})  # files of the cache, and their addresses

    @property
    def subject(self) -> str:
        """The name of the input."""
        return next((found.name for found in self.given.values() if found.name), "")

    @property
    def values(self) -> dict[str, Any]:
        """The values of the inputs."""
        return {name: found.value for name, found in self.given.items()}

    @property
    def arguments(self) -> list[str]:
        """The arguments of the command for files."""
        return [word for found in self.given.values() for word in found.arguments]

    @property
    def options(self) -> dict[str, str | tuple[str, ...] | None]:
        """The options of the command for inputs."""
        # Several inputs have an option for the CRS, which one of them gives.
        pairs = (pair for found in self.given.values() for pair in found.options.items())
        return {name: value for name, value in pairs if value}
