"""Units and names of a CRS given as well-known text, WKT 1 and WKT 2.

PROJ is not used, since a Python outside QGIS may not have it, and a classification only needs the
units.
"""

from __future__ import annotations

import math
import re
from typing import NamedTuple, Sequence

_TOKEN = re.compile(r'"((?:[^"]|"")*)"|([A-Za-z_][A-Za-z0-9_]*)\s*[\[(]|([^\s,"\[\]()]+)|([\])])')

_COMPOUND = {"COMPD_CS", "COMPOUNDCRS"}
_BOUND = {"BOUNDCRS", "SOURCECRS"}
_PROJECTED = {"PROJCS", "PROJCRS", "PROJECTEDCRS", "DERIVEDPROJCRS"}
_LOCAL = {"LOCAL_CS", "ENGCRS", "ENGINEERINGCRS"}
_SECOND_VERSION = ("PROJCRS", "PROJECTEDCRS", "DERIVEDPROJCRS", "ENGCRS", "ENGINEERINGCRS", "BOUND")
_GEOGRAPHIC = {"GEOGCS", "GEOGCRS", "GEOGRAPHICCRS", "GEODCRS", "GEODETICCRS", "GEOCCS"}
_VERTICAL = {"VERT_CS", "VERTCS", "VERTCRS", "VERTICALCRS"}
_VERTICAL_DATUMS = {"VERT_DATUM", "VDATUM", "VERTICALDATUM", "VRF", "ENSEMBLE"}
# The type of a datum of WKT 1 for heights above the ellipsoid.
_ELLIPSOIDAL_HEIGHTS = "2002"
_NO_NAME = re.compile(
    r"\W*(unknown|unnamed|undefined|unspecified|not (specified|known|defined)|none\b|n/?a\b|$)",
    re.IGNORECASE,
)
_CARTESIAN_3 = re.compile(r"\bCS\[\s*Cartesian\s*,\s*3\s*\]", re.IGNORECASE)
_UNITS = {"UNIT", "LENGTHUNIT"}
_VERTICAL_UNIT = re.compile(r'(VERT_CS\[.*?\bUNIT\["[^"]*",([-+.0-9eE]+))(?=\])', re.DOTALL)
_UNIT_CODES = {9001: 1.0, 9002: 0.3048, 9003: 1200 / 3937}
_UPWARDS = {"up", "down"}
# Metres in one unit. Smaller or larger ones are no useful units of length.
_SMALLEST_UNIT = 1e-6
_LARGEST_UNIT = 1e6
# Most levels of nested brackets; the CRS of a file has about eight.
_DEEPEST = 50
_CODE = re.compile(r"[0-9]{1,9}")


class Node(NamedTuple):
    """A keyword of well-known text and the contents of its brackets."""

    keyword: str
    values: list[str | Node]

    @property
    def name(self) -> str:
        """The first text in the brackets."""
        return self.values[0] if self.values and isinstance(self.values[0], str) else ""

    def children(self, keywords: set[str]) -> list[Node]:
        """Return the direct children that have one of the keywords."""
        return [node for node in self.values if isinstance(node, Node) and node.keyword in keywords]


class VerticalDatum(NamedTuple):
    """What heights are measured from."""

    crs: str  # name of the vertical CRS
    name: str = ""  # of the datum; empty if it is not stated
    epsg: int | None = None  # of the datum
    crs_epsg: int | None = None  # of the vertical CRS
    is_ellipsoid: bool = False


class WktFacts(NamedTuple):
    """The properties of a CRS that a classification needs; a unit is None if not stated."""

    name: str
    horizontal_unit: float | None  # metres
    vertical_unit: float | None  # metres
    has_vertical: bool  # a vertical CRS
    is_geographic: bool  # in degrees, or geocentric
    epsg: int | None  # of the horizontal CRS
    map_name: str = ""  # of the horizontal CRS
    datum: VerticalDatum | None = None  # None if it is not stated


def read_wkt(text: str) -> WktFacts | None:
    """Return the CRS that `text` describes, or None if it describes none."""
    roots = [node for node in _parse(text) if isinstance(node, Node)]
    parts = [part for root in roots for part in _parts(root)]
    horizontal = next((p for p in parts if p.keyword in _PROJECTED | _LOCAL | _GEOGRAPHIC), None)
    if horizontal is None:
        return None
    vertical = next((part for part in parts if part.keyword in _VERTICAL), None)
    flat, upwards = _axis_units(horizontal)
    if vertical is not None:
        upwards = _unit_of(vertical) or _axis_units(vertical)[1]
    return WktFacts(
        name=roots[0].name or horizontal.name,
        horizontal_unit=_unit_of(horizontal) or flat,
        vertical_unit=upwards,
        has_vertical=vertical is not None or upwards is not None,
        is_geographic=horizontal.keyword in _GEOGRAPHIC,
        epsg=_epsg_of(horizontal),
        map_name=horizontal.name,
        datum=_datum_of(vertical) if vertical else _ellipsoid_of(horizontal, upwards),
    )


def is_wkt2(text: str) -> bool:
    """Return whether a text of a projected or local CRS, such as ENGCRS, is WKT 2."""
    return text.lstrip().upper().startswith(_SECOND_VERSION)


def of_map(text: str) -> str:
    """Return the well-known text of the horizontal CRS of a text, without an axis of heights."""
    spans = _spans(text)
    horizontal = _PROJECTED | _LOCAL | _GEOGRAPHIC
    start, end = min((span for name, *span in spans if name in horizontal), default=(0, len(text)))
    if not _CARTESIAN_3.search(text, start, end):
        return text[start:end]
    # The ellipsoidal heights of a CRS with three axes.
    whole = text[start:end]
    for name, first, last in spans:
        axis = text[first:last]
        if name == "AXIS" and start < first < end and _UPWARDS & set(re.findall(r"\w+", axis)):
            whole = re.sub(r",\s*" + re.escape(axis), "", whole)
    return _CARTESIAN_3.sub("CS[Cartesian,2]", whole)


def with_unit_of_heights(text: str) -> str:
    """Return WKT 1 whose vertical unit has its EPSG code, without which GeoTIFF cannot state it."""
    vertical = _VERTICAL_UNIT.search(text)
    metres = _number(vertical[2]) if vertical else None
    for code, size in _UNIT_CODES.items():
        if vertical and metres and math.isclose(metres, size, rel_tol=1e-8):
            end = vertical.end()
            return f'{text[:end]},AUTHORITY["EPSG","{code}"]{text[end:]}'
    return text


def _parse(text: str) -> list[str | Node]:
    """Return the nodes of the text, none if brackets are nested deeper than in any CRS; brackets
    that are not closed end with the text.
    """
    top: list[str | Node] = []
    open_lists = [top]
    for quoted, keyword, bare, closing in _TOKEN.findall(text):
        if keyword:
            node = Node(keyword.upper(), [])
            open_lists[-1].append(node)
            open_lists.append(node.values)
            if len(open_lists) > _DEEPEST:
                return []
        elif closing:
            if len(open_lists) > 1:
                open_lists.pop()
        else:
            open_lists[-1].append(bare or quoted.replace('""', '"'))
    return top


def _spans(text: str) -> list[tuple[str, int, int]]:
    """Return the keywords of a text, and where they begin and their brackets end."""
    spans, still_open = [], []
    for token in _TOKEN.finditer(text):
        if token[2]:
            still_open.append((token[2].upper(), token.start()))
        elif token[4] and still_open:
            spans.append((*still_open.pop(), token.end()))
    return spans


def _parts(node: Node) -> Sequence[Node]:
    """Return the parts of a compound or bound CRS."""
    if node.keyword in _COMPOUND | _BOUND:
        inside = [value for value in node.values if isinstance(value, Node)]
        return [part for value in inside for part in _parts(value)]
    return [node]


def _unit_of(node: Node) -> float | None:
    """Return the unit that is a direct child of a CRS or an axis."""
    # Units deeper inside belong to the base CRS or to parameters of the projection.
    for unit in node.children(_UNITS):
        numbers = [_number(value) for value in unit.values[1:2] if isinstance(value, str)]
        if numbers and numbers[0] is not None:
            return numbers[0]
    return None


def _axis_units(node: Node) -> tuple[float | None, float | None]:
    """Return the unit of the first horizontal and of the first vertical axis."""
    horizontal = vertical = None
    for axis in node.children({"AXIS"}):
        is_vertical = any(value in _UPWARDS for value in axis.values if isinstance(value, str))
        if is_vertical:
            # WKT 2 has a unit for each axis, or one for all; WKT 1 always has one for all.
            vertical = vertical or _unit_of(axis) or _unit_of(node)
        else:
            horizontal = horizontal or _unit_of(axis)
    return horizontal, vertical


def _datum_of(vertical: Node) -> VerticalDatum | None:
    """Return the datum of a vertical CRS; None if that is a placeholder such as "unknown"."""
    datum = next(iter(vertical.children(_VERTICAL_DATUMS)), Node("", []))
    name = "" if _NO_NAME.match(datum.name) else datum.name
    is_ellipsoid = _ELLIPSOIDAL_HEIGHTS in datum.values or "ellips" in name.lower()
    # A vertical CRS of ESRI can be based on the datum of the horizontal CRS.
    is_ellipsoid |= bool(vertical.children({"DATUM"}))
    codes = _epsg_of(datum), _epsg_of(vertical)
    if not (name or is_ellipsoid or any(codes)):
        return None
    return VerticalDatum(vertical.name or name, name, *codes, is_ellipsoid)


def _ellipsoid_of(horizontal: Node, upwards: float | None) -> VerticalDatum | None:
    """Return the datum of the third axis of a horizontal CRS, if it has one."""
    is_flat = upwards is None or horizontal.keyword not in _PROJECTED
    return None if is_flat else VerticalDatum("ellipsoidal height", is_ellipsoid=True)


def _number(text: str) -> float | None:
    try:
        number = float(text)
    except ValueError:
        return None
    return number if is_unit(number) else None


def is_unit(metres: float) -> bool:
    """Return whether a size in metres is allowed for a unit."""
    return _SMALLEST_UNIT <= metres <= _LARGEST_UNIT


def _epsg_of(node: Node) -> int | None:
    for authority in node.children({"AUTHORITY", "ID"}):
        values = [value for value in authority.values if isinstance(value, str)]
        if len(values) >= 2 and values[0].upper() == "EPSG" and _CODE.fullmatch(values[1]):
            return int(values[1])
    return None
