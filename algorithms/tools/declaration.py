"""The declaration of a tool, from which its command, function and dialog are made."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Callable, Mapping, NamedTuple, Sequence

from ..classes.ground_classes import GroundClasses
from ..core.parameters import ParameterSet
from ..core.progress import Progress
from ..engine.step import PointStep, Step
from ..survey.files import Inputs
from .listing import listed

# Search words of the toolbox that several tools share; each text is translated as a whole.
CLOUD = "lidar,laser scanning,als,uav,drone,las,laz,copc,ept,point cloud"
GROUND = (
    "ground,bare earth,ground filter,ground classification,classify ground,extract ground,"
    "ground points,noise,outliers,vegetation removal,smrf,pmf,csf,mcc,lasground,classifyground"
)
TERRAIN = "terrain,terrain model,elevation model,dtm,dem,dsm,hillshade,relief"
CANOPY = "chm,ndsm,canopy,vegetation,vegetation height,normalize,normalise,hag,lasheight"
TIN = "tin,triangulation"
RASTER = "grid,raster,rasterize,interpolate"
TILES = "vpc,tiles,batch,survey,folder,many files"


@dataclass(frozen=True)
class Input:
    """An input of a tool; of one for points, one beside the points."""

    name: str  # of the argument of the work, or the field of the step, and of the option
    # One of these; in brackets, what a tool gets:
    # "cloud": a point cloud file (a path); "clouds": files of a survey (paths), in a dialog a file
    # or a list of files; "files": the same, in a dialog several files or a folder; "survey": the
    # same, in a dialog a file or a folder;
    # "address": of a remote file, or a path (text);
    # "raster": a file with a band of heights (its path, or another name that GDAL knows);
    # "crs": the CRS of the points, if the user states it (text; "clouds" know it);
    # "area" (an `Area`) and "polygons" (what `of` makes): of tools for points only;
    # "extent": a rectangle in the CRS of the points (a `Box`);
    # "words": several words (a tuple of text);
    # "checkpoints", "constraints", "corrections" and "target": see `input_groups.py`, whose parts
    # can be "points", "lines", "attribute" and "text", too.
    kind: str
    # Makes the value of the field of a step from polygons, or from a raster and the progress.
    of: Callable[..., Any] = lambda value, *progress: value
    # A sentence or several, for option, argument and field, which add what their kind needs, such
    # as file formats; it may name tools and options as `in_words` has them. Of an area, {area} is
    # its extent or its boundary.
    help: str = ""
    label: str = ""  # of the field in the dialog; empty if there is none
    named: str = ""  # the field and the argument, if not as the name in upper case
    optional: bool = False  # otherwise a cloud or a raster is an argument of the command
    advanced: bool = False
    is_last: bool = False  # whether the field is below the parameters
    may_be_empty: bool = False  # of polygons: whether a file or a layer may hold none
    # Finds the value in place of `ToFind`, where the user gives no polygons, or the word automatic:
    # given files, which of their points are ground, and the progress.
    found: Callable[[Inputs, GroundClasses, Progress], object] | None = None

    @property
    def field_name(self) -> str:
        """The name of the field in the dialog, and of the argument in the help of the command."""
        return self.named or self.name.upper()


class ToFind(NamedTuple):
    """In place of the value of an input: it is found before the work, beside what is given."""

    given: Any = None


# The points and their CRS, as most tools have them.
POINTS = Input("input", "clouds", help="Classified points.", label="Classified point cloud")
CRS = Input(
    "crs",
    "crs",
    help="The CRS of the points, for files that state none or a wrong one. It replaces what files"
    " state: it decides the units of lengths and heights, and rasters and layers get it. Written"
    " point clouds keep the records that the files have. Empty: what the files state.",
    label="CRS of the points",
    optional=True,
    advanced=True,
)
CLASSIFIED = replace(POINTS, name="sources", named="INPUT")


def with_note(help: str, note: str) -> str:
    """Return a help text with a further sentence before the one on what is empty."""
    first, empty, last = help.partition("Empty:")
    return " ".join(filter(None, (first.strip(), note, f"{empty}{last}")))


def help_of_area(help: str) -> tuple[str, str]:
    """Return the help of the extent and of the boundary of an area, given that of the input."""
    boundary = with_note(help, "With an extent, only what lies in both counts.")
    return help.format(area="this rectangle"), boundary.format(area="these polygons")


@dataclass(frozen=True)
class Output:
    """A file that a tool writes, or a folder of rasters; the work gets its temporary path."""

    # All outputs are checked before the work begins, and get their names together when it ends.
    name: str  # of the argument of the work, and of the option
    # "raster", "features", "page", "table" or "folder"; of points "cloud", "points" for LAZ, or
    # for a new folder of such files, and "list" for the virtual point cloud of many files.
    kind: str
    help: str = ""  # a sentence or several, as of an input
    label: str = ""  # of the field in the dialog; empty if there is none
    named: str = ""  # the field and the argument, if not as the name in upper case
    flag: str = ""  # of the command, if it is not made of the name
    is_main: bool = False  # whether the command needs it, as an argument without a flag
    optional: bool = True  # whether the dialog can do without it
    advanced: bool = False  # whether it is folded away, and the last in the help of the command
    by_default: bool = True  # whether the dialog makes it unless the user says no
    look: str = ""  # how QGIS shows it: a name in `LOOKS` of plugin/styles/layers.py
    needs: str = ""  # the input without which dialogs and deliveries do not make it
    # Another tool draws it when the points are done: its command, and the output that it reads.
    drawn_by: str = ""
    drawn_of: str = ""
    # Of a folder: the rasters that the tool writes, by their names, in the folder that the user
    # gives, or that file alone. The work gets their temporary paths by name.
    files: Callable[[Path, Sequence[ParameterSet]], dict[str, Path]] | None = None
    # Names and labels of these rasters that models in QGIS can use.
    layers: Mapping[str, str] = field(default_factory=dict)
    page: str = ""  # the label of the page in a folder, which models can use

    @property
    def field_name(self) -> str:
        """The name of the field in the dialog, and of the argument in the help of the command."""
        return self.named or self.name.upper()

    @property
    def option(self) -> str:
        """The option of the command, without dashes."""
        return self.flag or self.name.replace("_", "-")

    def paths(self, path: Path, sets: Sequence[ParameterSet]) -> dict[str, Path]:
        """Return the files that are written, by their names: of a folder several."""
        return {self.name: path} if self.files is None else self.files(path, sets)

    @property
    def file_kind(self) -> str:
        """The kind of its files."""
        return self.kind if self.files is None else "raster"


# The points that tools for the ground write, and the list of the files of a survey.
CLOUD_OUTPUT = Output(
    "output",
    "cloud",
    "The same points with their new classes.",
    label="Classified point cloud",
    is_main=True,
)
LIST_OUTPUT = Output(
    "vpc",
    "list",
    "Of many files: the list of the classified ones, which QGIS 3.32 and newer shows as one layer."
    " Without a name it is classified.vpc in their folder.",
    label="Virtual point cloud",
    named="OUTPUT_VPC",
    by_default=False,
)


@dataclass(frozen=True)
class Tool:
    """What all tools declare."""

    command: str
    sets: tuple[type[ParameterSet], ...]  # in the order of the command
    about: str = ""  # the paragraphs of its help that follow its line
    own_line: str = ""  # of a dialog, in place of the one in the list of tools

    identifier: str = ""  # second half of the id in the toolbox, which never changes; may be empty
    title: str = ""
    section: str = "Products"  # of the toolbox
    page: str = ""  # in the folder docs, perhaps with a section, as in "heights#model-key-points"
    words: tuple[str, ...] = ()  # for the search of the toolbox, separated by commas
    run_name: str = ""  # of the group of layers, if it is not the title
    # Outputs that are numbers: their names, in lower case those of fields of the summary, and
    # labels.
    numbers: tuple[tuple[str, str], ...] = ()
    texts: tuple[tuple[str, str], ...] = ()  # outputs that are sentences, named in the same way
    inputs: tuple[Input, ...] = ()
    titles: tuple[str, ...] = ()  # of the sets, in the help of the command
    list_name: str = "classified.vpc"  # of the virtual point cloud of many written files
    json: str | None = "what was done"  # what --json prints; None if there is nothing to tell
    # If the dialog has another order, or other defaults: derived classes of those of the command.
    dialog_sets: tuple[type[ParameterSet], ...] = ()
    # Parameters that are not advanced in the dialog, if not as declared.
    shown: tuple[str, ...] | None = None

    @property
    def line(self) -> str:
        """A sentence on it."""
        return self.own_line or listed(self.command).line

    @property
    def help(self) -> str:
        """The paragraphs of its help, in command, dialog and library."""
        return f"{self.line}\n{self.about}".rstrip()

    @property
    def sets_of_dialog(self) -> tuple[type[ParameterSet], ...]:
        """The parameter sets in the order of the dialog."""
        return self.dialog_sets or self.sets

    @property
    def writes_points(self) -> bool:
        """Whether it writes the points, those of many files into a folder."""
        return False

    @property
    def all_inputs(self) -> tuple[Input, ...]:
        """The inputs with those that all tools of its kind have."""
        return self.inputs

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The outputs."""
        return ()


@dataclass(frozen=True)
class PointTool(Tool):
    """A tool that writes classified files with a value or a class of each point."""

    step: type[PointStep] = PointStep  # its fields are the sets, and the inputs by their names
    output_label: str = ""
    output_help: str = ""
    shows: str = "classes"  # how QGIS shows the output: "classes", "key points" or "heights"
    writes_points = True

    @property
    def all_inputs(self) -> tuple[Input, ...]:
        """The points, the further inputs, and the CRS."""
        return POINTS, *self.inputs, CRS

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The classified file, or the folder for those of a survey."""
        return (replace(CLOUD_OUTPUT, help=self.output_help, label=self.output_label),)

    def steps(
        self,
        sets: Sequence[ParameterSet],
        inputs: Mapping[str, object],
        outputs: Mapping[str, Path],
    ) -> tuple[Step, ...]:
        """Return its step, given its sets, and inputs and outputs by their names."""
        names = {type(default): name for name, default in vars(self.step()).items()}
        fields = {names[type(values)]: values for values in sets if type(values) in names}
        given = (declared.name for declared in self.inputs if declared.name in inputs)
        return (self.step(**fields, **{name: inputs[name] for name in given}),)


def _nothing(*given: object, **named: object) -> Any:
    """Do nothing."""


@dataclass(frozen=True)
class FileTool(Tool):
    """A tool that reads files and writes others, or only tells what it finds."""

    # Gets inputs and outputs by their names, None for those that are not given, the sets by the
    # types of its defaults, and `progress`; returns what to tell: a dataclass or an object with
    # `as_dict`, with `text` (a sentence) or `lines` (figures, which are always printed).
    work: Callable[..., Any] = _nothing
    outputs: tuple[Output, ...] = ()
    # Says what a user of the command did not give, from the inputs and the sets; empty for nothing.
    lacks: Callable[[Mapping[str, object], Sequence[ParameterSet]], str] = lambda inputs, sets: ""
    # Further flags of parameters, which take one value.
    flags: Mapping[str, str] = field(default_factory=dict)
    always_tells: bool = False  # whether the command prints the text, not only with --verbose

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The outputs."""
        return self.outputs


@dataclass(frozen=True)
class MapTool(Tool):
    """A tool that makes rasters and contour lines of points, in a run of several steps."""

    # Returns the steps, given sets, and inputs and outputs by their names, none of which need be
    # there but the points.
    steps: Callable[..., tuple[Step, ...]] = _nothing
    # Without the points that it writes; asked for anew, since rows of rasters can be added.
    outputs: Callable[[], tuple[Output, ...]] = tuple
    points: Input = POINTS  # in the dialog
    # In the order of the dialog, if it is not that of the command; outputs with points.
    dialog_inputs: tuple[Input, ...] = ()
    dialog_outputs: Callable[[], tuple[Output, ...]] = tuple
    method: str = ""  # the ground filter of the dialog, if it has only one
    # Whether it finds the ground, by any filter, and writes points; otherwise they are classified.
    classifies: bool = False

    @property
    def writes_points(self) -> bool:
        """Whether it classifies points."""
        return self.classifies

    @property
    def all_inputs(self) -> tuple[Input, ...]:
        """The points, their CRS, and the further inputs, in the order of the dialog."""
        return self.points, CRS, *(self.dialog_inputs or self.inputs)

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The outputs."""
        return self.outputs()


@dataclass(frozen=True)
class Composition(Tool):
    """Tools that work one after another, by one of several tables, and fill one folder."""

    # Gets the sources, the folder, the name of a table, the sets, the inputs by their names,
    # `progress` and `workers`; returns what `FileTool.work` does, with `failures` of files.
    work: Callable[..., Any] = _nothing
    tables: Mapping[str, Any] = field(default_factory=dict)  # by name; `about` is a sentence each
    chosen: str = ""  # the argument for the name of a table
    default: str = ""  # of it, in the function
    chosen_help: str = ""
    outputs: tuple[Output, ...] = ()
    # In the dialog, which can also make single outputs.
    dialog_inputs: tuple[Input, ...] = ()
    dialog_outputs: Callable[[], tuple[Output, ...]] = tuple

    @property
    def all_inputs(self) -> tuple[Input, ...]:
        """The inputs in the order of the dialog."""
        return self.dialog_inputs

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The outputs."""
        return self.outputs
