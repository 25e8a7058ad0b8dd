"""A sink as somebody would add it: it counts the points of each block, and draws nothing."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bare_earth.algorithms.classes.ground_classes import GroundCounts
from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.engine.step import Sink
from bare_earth.algorithms.engine.store import Marks


@dataclass(frozen=True)
class CountPoints(Sink):
    """Writes how many points each block has, and how many of them are ground."""

    target: Path

    counts = GroundCounts
    blocks = Blocks(40.0, 5.0)

    @property
    def outputs(self):
        return [("table", self.target)]

    def marks(self, part, counts):
        return Marks(np.ones(part.count, dtype=bool), part.classification == 2)

    def in_block(self, visit, progress):
        contents = visit.contents(progress)
        core = visit.core(contents)
        counts = np.count_nonzero(core), np.count_nonzero(core & contents.known)
        return {"row": np.array([*visit.block[:2], *counts])}

    def finish(self, results, frame, outputs, progress, tiles=None):
        rows = sorted(arrays["row"].tolist() for arrays in results if arrays["row"][2])
        text = "\n".join(",".join(map(str, row)) for row in rows)
        outputs.file(self.target).write_text(text)
        return len(rows)
