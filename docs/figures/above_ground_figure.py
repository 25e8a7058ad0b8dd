"""The figure of the page about classes above the ground: a section, and a village from above."""

from __future__ import annotations

import numpy as np
from drawing import ADDED, GROUND, LINE, OTHER, save
from matplotlib import pyplot

from bare_earth.algorithms.tools.above_ground.classes import AboveGround, classes_above_ground
from benchmarks.scenes import make

_SEED, _HALF_WIDTH = 1, 1.5
# Class, colour, name.
_SHOWN = (
    (2, GROUND, "ground 2"), (3, "#c5e1a5", "low 3"), (4, "#8bc34a", "medium 4"),
    (5, "#3c8d40", "high 5"), (6, "#d9736a", "building 6"),
)  # fmt: skip


def above_ground() -> None:
    """Draw the classes of a village, what differs from the truth, and a section."""
    scene = make("village", seed=_SEED, size=110.0, density=8.0)
    several = scene.number_of_returns > 1
    found = classes_above_ground(scene.points, scene.ground, several, AboveGround("ign"))
    x, y, z = scene.points
    x, y = x - x.min(), y - y.min()
    figure, panels = pyplot.subplots(1, 3, figsize=(8.4, 3.0), layout="constrained")
    for value, colour, _ in _SHOWN:
        which = found == value
        panels[0].scatter(x[which], y[which], 0.6, colour, lw=0)
    panels[0].set_title("classes found")
    is_building, was = found == 6, scene.classes == 6
    for which, colour, name in (
        (is_building & was, OTHER, "right"), (is_building & ~was, ADDED, "too many"),
        (~is_building & was, LINE, "missed"),
    ):  # fmt: skip
        panels[1].scatter(x[which], y[which], 1.0, colour, lw=0, label=name)
    panels[1].set_title("buildings against the truth")
    panels[1].legend(fontsize=6, markerscale=4, loc="upper right")
    for panel in panels[:2]:
        panel.set_aspect("equal")
        panel.set_xticks([])
        panel.set_yticks([])
    middle = np.median(y[was])
    near = np.abs(y - middle) <= _HALF_WIDTH
    for value, colour, name in _SHOWN:
        which = near & (found == value)
        panels[2].scatter(x[which], z[which] - z.min(), 2.0, colour, lw=0, label=name)
    panels[2].set_title("section")
    panels[2].set_xlabel("m")
    panels[2].legend(fontsize=6, markerscale=2.5, loc="upper right")
    save(figure, "above-ground")
