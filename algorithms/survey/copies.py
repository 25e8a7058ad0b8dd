"""Files of a survey that hold the same points: copies in another format, or of another name."""

from __future__ import annotations

from pathlib import Path
from typing import Sequence

from ..core.files import split_name
from ..core.progress import Progress
from ..core.words import first_of
from ..las.lasfile import LasFile


def copies_in(tiles: Sequence[LasFile], are_named: Sequence[bool], progress: Progress) -> set[Path]:
    """Return the files that hold the same points as a file with the same name but another ending in
    the same folder, and report them; files that the user named are not among them.
    """
    # QGIS writes such a .copc.laz file beside each file that it shows. The file with the shortest
    # ending is used.
    first: dict[tuple[object, ...], LasFile] = {}
    copies: dict[Path, str] = {}
    pairs = zip(are_named, tiles)
    for is_named, tile in sorted(pairs, key=lambda pair: (not pair[0], len(pair[1].path.name))):
        name = split_name(tile.path)[0].lower()
        original = first.setdefault((tile.path.parent, name, _content(tile)), tile)
        if original is not tile and not is_named:
            copies[tile.path] = original.path.name
    if copies:
        names = first_of([f"{path.name} (as {copies[path]})" for path in sorted(copies)])
        progress.info(
            f"Left out, since a file of the same name holds the same points: {names}. To use one of"
            " them, give the file itself."
        )
    return set(copies)


def report_twins(tiles: Sequence[LasFile], progress: Progress) -> None:
    """Warn of files that seem to hold the same points, such as copies with other names."""
    seen: dict[tuple[float, ...], LasFile] = {}
    for tile in tiles:
        twin = seen.setdefault(_content(tile), tile)
        if twin is not tile:
            progress.warning(
                f"{twin.path.name} and {tile.path.name} have the same extent and number of points."
                " If these are the same points, remove one of the files."
            )


def _content(tile: LasFile) -> tuple[float, ...]:
    """Return number and extent of the points of a file, which are equal for copies of it."""
    return tile.count, *(round(coordinate, 2) for coordinate in (*tile.minimum, *tile.maximum))
