"""The CRS that the files of a survey have in common."""

from __future__ import annotations

from typing import Sequence

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..core.words import first_of
from ..crs.matching import described, has_same_units, is_other_datum, is_same_crs, is_same_map
from ..crs.stated import how_to_state
from ..crs.system import Crs
from ..las.lasfile import LasFile


def common_crs(tiles: list[LasFile], stated: list[Crs], progress: Progress) -> Crs:
    """Return the common CRS of tiles, given the CRS of each; refuse tiles that differ."""
    groups: dict[Crs, list[LasFile]] = {}
    # CRS with a vertical datum come first, since a CRS without one is equal to any of them.
    for tile, crs in sorted(zip(tiles, stated), key=lambda pair: pair[1].datum is None):
        same = next((group for group in groups if is_same_crs(group, crs)), crs)
        groups.setdefault(same, []).append(tile)
    known, unstated = [crs for crs in groups if crs != Crs()], groups.get(Crs(), [])
    # For one file, the same words as when it is read.
    say, their = ("do not say", "their") if len(unstated) > 1 else ("does not say", "its")
    lack = f"{names_of(unstated)} {say} {their} CRS:"
    if not known:
        progress.warning(
            f"{lack} {their} coordinates are taken as metres. If they are not, give the CRS:"
            f" {how_to_state()}."
        )
        return Crs()
    if len(known) > 1 or (unstated and not has_same_units(known[0], Crs())):
        problem, hint = "The files are not in the same CRS", f"{how_to_state()}."
        if not unstated and all(is_same_map(known[0], crs) for crs in known[1:]):
            problem = "The heights of the files are not in the same unit or above the same datum"
            hint = f"{how_to_state()}, or with heights, such as EPSG:25832+7837."
        raise BareEarthError(
            f"{problem}: "
            + "; ".join(f"{described(crs)}: {names_of(members)}" for crs, members in groups.items())
            + ". Reproject them to one CRS, or work on each group alone. If they are in one CRS all"
            f" the same, give it: {hint}"
        )
    if unstated:
        progress.warning(f"{lack} that of the others is used, {known[0].name}.")
    _report_datums(tiles, stated, known[0], progress)
    return known[0]


def _report_datums(
    tiles: list[LasFile], stated: list[Crs], common: Crs, progress: Progress
) -> None:
    """Report vertical datums that may differ, and files that state none."""
    if common.datum is None:
        return
    others: dict[str, list[LasFile]] = {}
    for tile, crs in zip(tiles, stated):
        if crs != Crs() and is_other_datum(crs.datum, common.datum) is None:
            others.setdefault(crs.datum.crs if crs.datum else "", []).append(tile)
    silent = others.pop("", [])
    if silent:
        text = f"No vertical datum is stated by {names_of(silent)}: that of the others is used,"
        if common.datum.is_ellipsoid:
            # Heights above the sea differ from heights above the ellipsoid by up to 100 m.
            progress.warning(f"{text} {common.datum.crs}. Check that their heights fit together.")
        else:
            progress.info(f"{text} {common.datum.crs}.")
    if others:
        progress.warning(
            f"The vertical datum of most files is {common.datum.crs}; others name it"
            + "; ".join(f" {name}: {names_of(members)}" for name, members in others.items())
            + ". Their heights are used as they are: check that they fit together."
        )


def names_of(tiles: Sequence[LasFile]) -> str:
    """Return the names of the first files, and how many more there are."""
    return first_of([tile.path.name for tile in tiles])
