"""The algorithms of the toolbox for all ground filters."""

from __future__ import annotations

from ...algorithms.filters import METHODS
from ...algorithms.tools.declaration import CLOUD, GROUND, TERRAIN
from .classification import ClassificationAlgorithm

GROUND_FILTERS = tuple(
    type(
        method.toolbox.identifier,
        (ClassificationAlgorithm,),
        {
            "__doc__": method.toolbox.title,
            "method": method.name,
            **method.toolbox._asdict(),
            "words": (CLOUD, GROUND, TERRAIN, *method.toolbox.words),
        },
    )
    for method in METHODS.values()
)
