"""Writes lines, polygons and points as ASCII DXF of AutoCAD R12, which every CAD program reads."""

from __future__ import annotations

from pathlib import Path
from typing import Iterable, Iterator, Mapping, NamedTuple, TextIO

import numpy as np

# Bits of the group 70 of polylines and their corners.
_CLOSED = 1
_IN_SPACE = 8
_CORNER_IN_SPACE = 32
_WHITE = 7  # the number of the colour that is white on black and black on white


class Drawn(NamedTuple):
    """A polyline or a point."""

    layer: str
    # float64, (n, 3); of a closed line, the last corner is the first. A line whose corners have one
    # height is a 2D polyline with an elevation, any other one a 3D polyline.
    corners: np.ndarray


def write_dxf(target: Path, shapes: Iterable[Drawn], colours: Mapping[str, int], about: str) -> int:
    """Write shapes and a comment, given the layers with the numbers of their colours; return the
    number of shapes.
    """
    count = 0
    with target.open("w", encoding="ascii", errors="replace", newline="\r\n") as file:
        _put(file, [(999, about), (0, "SECTION"), (2, "HEADER"), (9, "$ACADVER"), (1, "AC1009")])
        _put(file, [(0, "ENDSEC"), *_tables(colours), (0, "SECTION"), (2, "ENTITIES")])
        for shape in shapes:
            _put(file, _entity(shape))
            count += 1
        _put(file, [(0, "ENDSEC"), (0, "EOF")])
    return count


def _put(file: TextIO, groups: Iterable[tuple[int, object]]) -> None:
    file.write("".join(f"{code:3d}\n{value}\n" for code, value in groups))


def _tables(colours: Mapping[str, int]) -> Iterator[tuple[int, object]]:
    """Yield the table of line types and the table of layers."""
    yield from ((0, "SECTION"), (2, "TABLES"), (0, "TABLE"), (2, "LTYPE"), (70, 1))
    yield from ((0, "LTYPE"), (2, "CONTINUOUS"), (70, 0), (3, "Solid line"), (72, 65), (73, 0))
    yield from ((40, 0.0), (0, "ENDTAB"), (0, "TABLE"), (2, "LAYER"), (70, len(colours) + 1))
    for name, colour in {"0": _WHITE, **colours}.items():
        yield from ((0, "LAYER"), (2, name), (70, 0), (62, colour), (6, "CONTINUOUS"))
    yield from ((0, "ENDTAB"), (0, "ENDSEC"))


def _entity(shape: Drawn) -> Iterator[tuple[int, object]]:
    """Yield the groups of a polyline, or of a point."""
    corners = shape.corners
    if len(corners) == 1:
        yield from ((0, "POINT"), (8, shape.layer), *_place(corners[0]))
        return
    is_level = bool((corners[:, 2] == corners[0, 2]).all())
    is_closed = len(corners) > 3 and bool((corners[0] == corners[-1]).all())
    flags = (0 if is_level else _IN_SPACE) + (_CLOSED if is_closed else 0)
    elevation = np.array([0.0, 0.0, corners[0, 2] if is_level else 0.0])
    yield from ((0, "POLYLINE"), (8, shape.layer), (66, 1), *_place(elevation), (70, flags))
    for corner in corners[:-1] if is_closed else corners:
        yield from ((0, "VERTEX"), (8, shape.layer), *_place(corner))
        if not is_level:
            yield 70, _CORNER_IN_SPACE
    yield from ((0, "SEQEND"), (8, shape.layer))


def _place(corner: np.ndarray) -> list[tuple[int, object]]:
    return [(code, f"{value:.4f}") for code, value in zip((10, 20, 30), corner)]
