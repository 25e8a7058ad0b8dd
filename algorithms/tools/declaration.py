"""The declaration of a tool, from which its command, function and dialog are made."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Callable, Mapping, NamedTuple, Sequence

from ..classes.ground_classes import GroundClasses
from ..core.parameters import ParameterSet
from ..core.progress import Progress
from ..engine.memory import Resources
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
    """An input of a tool; the points of a tool for points are not declared as an input."""

    name: str  # of the argument of `work` or the field of the step, and of the option
    # One of these kinds; in brackets, the type of the value that a tool gets:
    # "cloud": a point cloud file (a path); "clouds": files of a survey (paths), in a dialog a file
    # or a list of files; "files": the same, in a dialog several files or a folder; "survey": the
    # same, in a dialog a file or a folder;
    # "address": of a remote file, or a path (text);
    # "raster": a file with a band of heights (its path, or another name that GDAL knows);
    # "terrain": the same, or a point cloud, a file or a folder;
    # "crs": the CRS of the points, if the user states it (text; "clouds" know it);
    # "area" (an `Area`) and "polygons" (what `of` returns): only of tools for points;
    # "extent": a rectangle in the CRS of the points (a `Box`);
    # "words": several words (a tuple of text);
    # "checkpoints", "constraints", "corrections" and "target": groups of inputs, as
    # `input_groups.py` lists them, such as "points", "lines", "attribute" and "text".
    kind: str
    # Converts polygons, or a raster and the progress, to the value that the tool gets.
    of: Callable[..., Any] = lambda value, *progress: value
    # A few sentences for the option, the argument and the field, to which these add file formats.
    # `in_words` replaces names of tools and options in it; {area} is the extent or the boundary.
    help: str = ""
    label: str = ""  # of the field in the dialog; empty without a field
    named: str = ""  # name of the field and of the argument, if not `name` in upper case
    optional: bool = False  # a cloud or a raster that is not is an argument of the command
    advanced: bool = False
    is_last: bool = False  # whether the field is below the parameters
    may_be_empty: bool = False  # whether a file or a layer of polygons may contain none
    # The result of the last run that a dialog shows first; inputs with one belong to one run.
    made_as: str = ""
    # Returns the value in place of `Automatic`, which stands for polygons that the user leaves out,
    # or for the word automatic, given the files, which points are ground, and the progress.
    found: Callable[[Inputs, GroundClasses, Progress], Any] | None = None

    @property
    def field_name(self) -> str:
        """The name of the field in the dialog, and of the argument in the help of the command."""
        return self.named or self.name.upper()


class Automatic(NamedTuple):
    """Stands for the value of an input that `Input.found` returns before the work."""

    given: Any = None  # the `Constraints` of the user, to which the value is added


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
    """Return a help text with another sentence, before the one that begins with "Empty:"."""
    first, empty, last = help.partition("Empty:")
    return " ".join(filter(None, (first.strip(), note, f"{empty}{last}")))


def help_of_area(help: str) -> tuple[str, str]:
    """Return the help texts of the extent and of the boundary, from the help of an area."""
    boundary = with_note(help, "With an extent, only what lies in both counts.")
    return help.format(area="this rectangle"), boundary.format(area="these polygons")


@dataclass(frozen=True)
class Output:
    """A file that a tool writes, or a folder of rasters; `work` gets a temporary path."""

    # All outputs are checked before the work, and are moved to their places together at its end.
    name: str  # of the argument of `work`, and of the option
    # "raster", "features", "page", "table" or "folder"; for points "cloud", "points" (a LAZ file,
    # or a new folder of such files), and "list" (the virtual point cloud of many files).
    kind: str
    help: str = ""  # as `Input.help`
    label: str = ""  # of the field in the dialog; empty without a field
    named: str = ""  # name of the field and of the argument, if not `name` in upper case
    flag: str = ""  # of the command, if it is not made of `name`
    is_main: bool = False  # whether the command needs it, as an argument without a flag
    optional: bool = True  # whether it can be left empty in the dialog
    advanced: bool = False  # whether it is folded away, and at the end of the help of the command
    by_default: bool = True  # whether the dialog writes it unless the user switches it off
    look: str = ""  # how QGIS shows it: a name in `LOOKS` of plugin/styles/layers.py
    needs: str = ""  # an input; without it, dialogs and deliveries do not write this output
    # The command of another tool that makes it afterwards as its main output, and which outputs are
    # the inputs of that tool, by the names of these.
    drawn_by: str = ""
    drawn_of: Mapping[str, str] = field(default_factory=dict)
    # For a folder of rasters: returns their paths by their names, in the folder that the user
    # gives, or that path if it is a file. `work` gets temporary paths by the same names.
    files: Callable[[Path, Sequence[ParameterSet]], dict[str, Path]] | None = None
    # Names and labels of these rasters that models in QGIS can use.
    layers: Mapping[str, str] = field(default_factory=dict)
    page: str = ""  # the label of the page that a folder contains, for models

    @property
    def field_name(self) -> str:
        """The name of the field in the dialog, and of the argument in the help of the command."""
        return self.named or self.name.upper()

    @property
    def option(self) -> str:
        """The option of the command, without dashes."""
        return self.flag or self.name.replace("_", "-")

    def paths(self, path: Path, sets: Sequence[ParameterSet]) -> dict[str, Path]:
        """Return the files that are written by their names, for a folder its rasters."""
        return {self.name: path} if self.files is None else self.files(path, sets)

    @property
    def file_kind(self) -> str:
        """The kind of the files that are written."""
        return self.kind if self.files is None else "raster"


# The points that ground filters write, and the list of the files of a survey.
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
    """Base of the declarations of tools."""

    command: str
    sets: tuple[type[ParameterSet], ...]  # in the order of the command
    about: str = ""  # the paragraphs of the help after its first line
    own_line: str = ""  # first line in a dialog, if it differs from the one in `listing.py`

    identifier: str = ""  # second half of the id in the toolbox, which never changes; may be empty
    title: str = ""
    section: str = "Products"  # of the toolbox
    page: str = ""  # in the folder docs, perhaps with a section, as in "heights#model-key-points"
    words: tuple[str, ...] = ()  # for the search of the toolbox, separated by commas
    run_name: str = ""  # of the group of layers, if it is not the title
    # Outputs that are numbers: names, which are fields of the summary in upper case, and labels.
    numbers: tuple[tuple[str, str], ...] = ()
    texts: tuple[tuple[str, str], ...] = ()  # outputs that are sentences, in the same way
    inputs: tuple[Input, ...] = ()
    titles: tuple[str, ...] = ()  # headings of the sets in the help of the command
    list_name: str = "classified.vpc"  # name of the virtual point cloud of many written files
    json: str | None = "what was done"  # what --json prints; None if there is no result
    # The sets of the dialog if its order differs; derived classes if its defaults differ.
    dialog_sets: tuple[type[ParameterSet], ...] = ()
    looks_around: bool = True  # whether it measures, and points round an area matter
    # Parameters that the dialog does not fold away; None: all parameters that are not advanced.
    shown: tuple[str, ...] | None = None

    @property
    def line(self) -> str:
        """The first line of its help, a sentence."""
        return self.own_line or listed(self.command).line

    @property
    def help(self) -> str:
        """The help text in command, dialog and library."""
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
        """The inputs in the order of the dialog, with the common ones of all tools of its kind."""
        return self.inputs

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The outputs."""
        return ()


@dataclass(frozen=True)
class PointTool(Tool):
    """A tool that writes classified files with a value or a class of each point."""

    step: type[PointStep] = PointStep  # its fields are the sets, and the inputs by name
    points: Input = POINTS
    output_label: str = ""
    output_help: str = ""
    shows: str = "classes"  # how QGIS shows the output: "classes", "key points" or "heights"
    writes_points = True

    @property
    def sets_of_dialog(self) -> tuple[type[ParameterSet], ...]:
        """The parameter sets in the order of the dialog, and threads and memory."""
        return (*super().sets_of_dialog, Resources)

    @property
    def all_inputs(self) -> tuple[Input, ...]:
        """The points, the other inputs, and the CRS."""
        return self.points, *self.inputs, CRS

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The classified file, or the folder for the files of a survey."""
        return (replace(CLOUD_OUTPUT, help=self.output_help, label=self.output_label),)

    def steps(
        self,
        sets: Sequence[ParameterSet],
        inputs: Mapping[str, object],
        outputs: Mapping[str, Path],
    ) -> tuple[Step, ...]:
        """Return the step of the tool, from its sets, and inputs and outputs by name."""
        names = {type(default): name for name, default in vars(self.step()).items()}
        fields = {names[type(values)]: values for values in sets if type(values) in names}
        names_given = (declared.name for declared in self.inputs if declared.name in inputs)
        return (self.step(**fields, **{name: inputs[name] for name in names_given}),)


def _nothing(*arguments: object, **named: object) -> Any:
    """Do nothing."""


@dataclass(frozen=True)
class FileTool(Tool):
    """A tool that reads files and writes others, or only reports figures."""

    # Its arguments are inputs and outputs by name, None where the user leaves one out, the
    # sets, recognised by the types of their defaults, and `progress`. It returns a summary: a
    # dataclass or an object with `as_dict`, with `text` (a sentence) or `lines()` (figures, which
    # are always printed).
    work: Callable[..., Any] = _nothing
    outputs: tuple[Output, ...] = ()
    # Returns, from the inputs and the sets, what the command line lacks; empty if it is complete.
    lacks: Callable[[Mapping[str, object], Sequence[ParameterSet]], str] = lambda inputs, sets: ""
    # Other flags for parameters with several values, which take one value.
    flags: Mapping[str, str] = field(default_factory=dict)
    always_reports: bool = False  # whether the command prints the text also without --verbose

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The outputs."""
        return self.outputs


@dataclass(frozen=True)
class MapTool(Tool):
    """A tool that makes rasters and contour lines of points, in a run of several steps."""

    # Returns the steps. Its arguments are the sets, and inputs and outputs by name. Only the
    # points are required.
    steps: Callable[..., tuple[Step, ...]] = _nothing
    # Without the written points; a function, since rows of rasters can be added.
    outputs: Callable[[], tuple[Output, ...]] = tuple
    points: Input = POINTS  # in the dialog
    # In the order of the dialog if it differs from that of the command; outputs with the points.
    dialog_inputs: tuple[Input, ...] = ()
    dialog_outputs: Callable[[], tuple[Output, ...]] = tuple
    method: str = ""  # the ground filter of the dialog, if it has only one
    # Whether it finds the ground by a filter and writes points; otherwise it reads classified ones.
    classifies: bool = False

    @property
    def writes_points(self) -> bool:
        """Whether it classifies points."""
        return self.classifies

    @property
    def all_inputs(self) -> tuple[Input, ...]:
        """The points, their CRS, and the other inputs, in the order of the dialog."""
        return self.points, CRS, *(self.dialog_inputs or self.inputs)

    @property
    def all_outputs(self) -> tuple[Output, ...]:
        """The outputs."""
        return self.outputs()


@dataclass(frozen=True)
class Composition(Tool):
    """Tools that work one after another and fill one folder, as one of several tables says."""

    # Its arguments are the sources, the folder, the name of a table, the sets, the inputs by name,
    # `progress` and `workers`. It returns a summary as `FileTool.work` does, with `failures`.
    work: Callable[..., Any] = _nothing
    tables: Mapping[str, Any] = field(default_factory=dict)  # by name; `about` is a sentence
    chosen: str = ""  # name of the argument that chooses a table
    default: str = ""  # the default of this argument
    chosen_help: str = ""
    outputs: tuple[Output, ...] = ()
    # In the dialog, which can also write single outputs.
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
