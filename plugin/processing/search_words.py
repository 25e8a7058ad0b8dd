"""Words for the search of the toolbox, for each algorithm that is no tool with a declaration."""

from __future__ import annotations

from typing import Iterable

from ...algorithms.filters import METHODS
from ...algorithms.tools.declaration import CANOPY as _CANOPY
from ...algorithms.tools.declaration import CLOUD as _CLOUD
from ...algorithms.tools.declaration import GROUND as _GROUND
from ...algorithms.tools.declaration import RASTER as _RASTER
from ...algorithms.tools.declaration import TERRAIN as _TERRAIN
from ...algorithms.tools.declaration import TIN as _TIN
from ..i18n import mark, tr

_TILES = mark("vpc,tiles,batch,survey,folder,many files")

# Groups of words, by the second half of the id.
_WORDS = {
    "pointcloudtoterrain": (
        _CLOUD, _GROUND, _TERRAIN, _CANOPY, _TILES, mark("contours,workflow"),
        mark("deliverables,archaeology,forestry,flood,drone"),
    ),
    **{
        each.toolbox.identifier: (_CLOUD, _GROUND, _TERRAIN, *each.toolbox.words)
        for each in METHODS.values()
    },
    "classifytiles": (_CLOUD, _GROUND, _TERRAIN, _TILES),
    "terrainmodel": (_CLOUD, _TERRAIN, _CANOPY, _TIN, _RASTER),
    "terraincontours": (_CLOUD, _GROUND, _TERRAIN, mark("contours,workflow")),
    "cloudheights": (_CLOUD, _GROUND, _CANOPY, mark("height,extra bytes")),
    "twomethods": (_CLOUD, _GROUND, mark("preview,try,test,preset,parameters,compare,profile")),
}  # fmt: skip


def words_of(identifier: str) -> list[str]:
    """Return the words for an algorithm, by half of its id, in English and the user's language."""
    return words_in(_WORDS[identifier])


def words_in(groups: Iterable[str]) -> list[str]:
    """Return the words of groups, separated by commas, in English and the user's language."""
    words = (word for group in groups for text in (group, tr(group)) for word in text.split(","))
    return list(dict.fromkeys(words))
