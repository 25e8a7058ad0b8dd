"""Arguments of functions on arrays: points in memory, and their attributes."""

from __future__ import annotations

from . import arguments
from .arguments import REQUIRED, Argument, Kind

_TABLE = (
    "X of the points in units of the CRS; or x, y and z as one array of shape (n, 3); or a"
    " laspy.LasData, its points or a chunk of them; or a table with the columns X, Y, Z and, where"
    " they are, Classification, ReturnNumber, NumberOfReturns, Withheld and Overlap: a structured"
    " array, such as PDAL has, a dict of arrays, a table of pandas, polars or pyarrow, or a"
    " GeoDataFrame of points with z, whose CRS counts; of terrain() also blocks()."
)
_NUMBERS = "array of int, shape (n,)"
_FLAGS = "array of bool, shape (n,)"


def _array(name: str, help: str, words: str = "array of float, shape (n,)") -> Argument:
    return Argument(name, Kind("ArrayLike", words), help)


POINTS = (
    Argument("points", Kind("Any", "array, laspy.LasData or table"), _TABLE, REQUIRED),
    _array("y", "Y of the points, if `points` is x."),
    _array("z", "Z of the points, if `points` is x."),
)
ATTRIBUTES = (
    _array("classification", "The classes of the points, in place of those of a table.", _NUMBERS),
    _array("return_number", "The return numbers, from 1 on.", _NUMBERS),
    _array("number_of_returns", "How many returns the pulse of each point has.", _NUMBERS),
    _array("withheld", "Which points are left out of everything.", _FLAGS),
    _array("in_overlap", "Which points lie in the overlap of flight strips.", _FLAGS),
)
GROUND = _array(
    "ground",
    "Which points are ground, as ground() returns them, in place of their classes.",
    _FLAGS,
)
_CRS = Argument.of(
    "crs",
    "crs",
    "The CRS. It replaces that of a laspy.LasData, and without both coordinates are metres.",
)
LAST = (_CRS, arguments.PROGRESS)
