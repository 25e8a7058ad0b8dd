"""A tool for points as somebody would add it: all that it is stands here."""

from __future__ import annotations

import sys
import types
from dataclasses import dataclass, field

import numpy as np

from bare_earth.algorithms.classes.ground_classes import GroundClasses, GroundCounts
from bare_earth.algorithms.core.parameters import ParameterSet, parameter
from bare_earth.algorithms.engine.blocks import Blocks
from bare_earth.algorithms.engine.step import PointStep, with_classes
from bare_earth.algorithms.engine.store import Marks
from bare_earth.algorithms.engine.summary import TileSummary
from bare_earth.algorithms.tools.declaration import CLOUD, PointTool
from bare_earth.algorithms.tools.listing import POINT_TOOLS, Listed


@dataclass(frozen=True)
class NewClass(ParameterSet):
    """Which class the ground gets."""

    new_class: int = parameter(
        31, label="New class", minimum=0, maximum=255, help="The class that ground points get."
    )


@dataclass(frozen=True, order=True)
class ToySummary(TileSummary):
    """The points of a file with the new class."""

    name: str
    point_count: int
    new_count: int
    class_counts: dict = field(default_factory=dict)

    @property
    def text(self):
        return f"{self.name}: {self.new_count:,} of {self.point_count:,} points have a new class"


@dataclass(frozen=True)
class RenameGround(PointStep):
    """Gives the ground another class."""

    parameters: NewClass = field(default_factory=NewClass)
    ground: GroundClasses = field(default_factory=GroundClasses)

    counts = GroundCounts
    blocks = Blocks.of(1.0)
    summary_type = ToySummary

    def marks(self, part, counts):
        self.ground.of(part, counts)
        none = np.zeros(part.count, dtype=bool)
        return Marks(none, none, none)

    def applied(self, part, values):
        ground = self.ground.points_of(part, self.ground.ground_classes)
        new = np.uint8(self.parameters.new_class)
        return with_classes(part, np.where(ground, new, part.classification))

    def numbers(self, part, after, values):
        is_new = after.classification == self.parameters.new_class
        return {"new_count": int(np.count_nonzero(is_new))}


TOOL = PointTool(
    step=RenameGround,
    list_name="toy.vpc",
    sets=(NewClass, GroundClasses),
    command="rename-ground",
    identifier="renameground",
    title="Rename ground",
    about="Nothing else changes.",
    page="index",
    words=(CLOUD, "toy"),
    output_label="Point cloud with renamed ground",
    output_help="The same points, with another class of the ground.",
    numbers=(("POINT_COUNT", "Points"), ("NEW_COUNT", "Points with the new class")),
)


def add_toy(monkeypatch):
    """Do what a file in `algorithms/tools/` and its line in the list of tools do."""
    module = types.ModuleType("bare_earth.algorithms.tools.rename_ground")
    module.TOOL = TOOL
    monkeypatch.setitem(sys.modules, module.__name__, module)
    listed = Listed("rename_ground", "Gives ground points another class.")
    monkeypatch.setitem(POINT_TOOLS, TOOL.command, listed)
