"""Files of a survey without ground: they are written and told, unless no file has any."""

from __future__ import annotations

from collections import defaultdict
from typing import NamedTuple, Sequence

from ..core.errors import BareEarthError
from ..core.progress import Progress
from ..core.words import counted, first_of

# What is done with the points of a file that does not change.
UNCHANGED = "written with unchanged classes"
# Most files that a message names.
_MOST = 10


class WithoutGround(NamedTuple):
    """A file of a survey that has no ground."""

    name: str
    points: int  # their number
    fate: str  # what is done with these, such as `UNCHANGED`
    why: str = ""  # a sentence, if the reason is known


def report_groundless(
    files: Sequence[WithoutGround], progress: Progress, ground: str = "ground", where: str = ""
) -> None:
    """Warn of files without ground, with their numbers of points, in one line for all alike."""
    alike: dict[tuple[str, str], list[WithoutGround]] = defaultdict(list)
    for file in files:
        alike[file.fate, file.why].append(file)
    there = " there" if where else ""
    for (fate, why), group in alike.items():
        count = sum(file.points for file in group)
        fate = f"{counted(count, f'point{there} is', f'points{there} are')} {fate}."
        if len(group) == 1:
            text = f"{group[0].name} has no {ground}{where}: its {fate}"
        else:
            names = first_of([f"{file.name} ({file.points:,})" for file in group], _MOST)
            text = f"{len(group):,} files have no {ground}{where}: {names}. Their {fate}"
        progress.warning(f"{text} {why}".rstrip())


def refuse_groundless(names: Sequence[str], ground: str, advice: str) -> None:
    """Refuse files if none has ground."""
    one, many = f"{names[0]} has no", f"None of the {len(names):,} files has"
    raise BareEarthError(f"{one if len(names) == 1 else many} {ground}. {advice}")
