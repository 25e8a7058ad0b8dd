"""The declaration of a tool, from which its command, function and dialog are made."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Sequence

from ..core.parameters import ParameterSet
from ..core.progress import Progress
from ..engine.step import PointStep
from ..survey.ground_classes import GroundClasses

# Search words of the toolbox that several tools share; each text is translated as a whole.
CLOUD = "lidar,laser scanning,als,uav,drone,las,laz,copc,point cloud"
TERRAIN = "terrain,terrain model,elevation model,dtm,dem,dsm,hillshade,relief"
CANOPY = "chm,ndsm,canopy,vegetation,vegetation height,normalize,normalise,hag,lasheight"
TIN = "tin,triangulation"


@dataclass(frozen=True)
class Input:
    """A further input of a tool, beside the points."""

    name: str  # of the field of the step and of the option, and in upper case of the dialog
    kind: str  # "area", "polygons" or "raster" (a file)
    # Makes the value of the field of the polygons, or of the path of the raster and the progress.
    of: Callable[..., Any]
    help: str  # of the option; of an area, what starts the help; {formats} are those of vectors
    more: str = ""  # of an area: what ends the help of its options
    label: str = ""  # of the field in the dialog; empty if there is none
    field_help: str = ""
    is_last: bool = False  # whether the field is below the outputs
    # Finds the value where the user gives no polygons, or the word automatic: given files, which of
    # their points are ground, their CRS if it is stated, and the progress.
    found: Callable[[Sequence[Path], GroundClasses, str | None, Progress], Any] | None = None


@dataclass(frozen=True)
class PointTool:
    """A tool that writes classified files with a value or a class of each point."""

    step: type[PointStep]  # its fields are the parameter sets, and the inputs by their names
    sets: tuple[type[ParameterSet], ...]  # in the order of the command

    command: str
    command_about: str  # its help; one line on it is in the list of all tools
    writes: str  # what its function in the library does, after "Write classified files with"

    identifier: str  # second half of the id in the toolbox, which never changes
    title: str
    summary: str  # the tooltip
    about: str  # first paragraphs of the help
    page: str  # in the folder docs
    words: tuple[str, ...]  # for the search of the toolbox, separated by commas
    output_label: str
    output_help: str
    # Outputs that are numbers: their names, in lower case those of fields of the summary, and
    # labels.
    numbers: tuple[tuple[str, str], ...]
    inputs: tuple[Input, ...] = ()
    dialog_sets: tuple[type[ParameterSet], ...] = ()  # if the dialog has another order
    shows: str = "classes"  # how QGIS shows the output: "classes", "key points" or "heights"
