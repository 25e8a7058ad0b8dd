"""The figure of the page on corrections by hand, drawn by the project's own code."""

from __future__ import annotations

from functools import partial

import numpy as np
from drawing import draw_errors, save, shade
from matplotlib import pyplot
from scipy import ndimage
from scipy.spatial import ConvexHull

from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.engine.one_file import classify_cloud
from bare_earth.algorithms.filters.tin_densification.filter import TinDensification
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.survey.corrections import Corrections
from benchmarks.generated import TrueModel
from benchmarks.scenes import Scene, make
from benchmarks.scenes.scene import ORIGIN

GROUND = 2
# Of each place what makes the scene, what is wrong there, and the class of the polygon on it.
PLACES = (
    (partial(make, "complex_on_slope", 1), "a building is kept", 6),
    (partial(make, "mesa", 501, density=1.0), "a mountain is lost", GROUND),
)
# Metres by which the terrain is wrong where somebody would draw.
WRONG = 0.7


def by_hand() -> None:
    """Draw terrain models without and with a polygon on what is wrong."""
    figure, axes = pyplot.subplots(len(PLACES), 3, figsize=(8.2, 5.6), layout="constrained")
    for row, (make_scene, words, value) in zip(axes, PLACES):
        scene = make_scene()
        model = TrueModel.of(scene)
        before = _error(scene, model, Corrections())
        ring = _drawn_round(before < -WRONG if value == GROUND else before > WRONG)
        grid = RasterGrid.over(scene.points.take(scene.ground), Frame(), 1.0)
        polygon = np.column_stack((grid.x[ring[:, 0]], grid.y[ring[:, 1]])) + ORIGIN
        after = _error(scene, model, Corrections(((polygon,),), (value,)))
        for panel, error in zip(row, (before, after)):
            draw_errors(panel, model.heights, error)
            panel.plot(*ring[[*range(len(ring)), 0]].T, color="black", linewidth=1.2)
        shade(row[2], model.heights)
        titles = f"Filter alone: {words}", f"With the polygon, class {value}", "True terrain"
        for panel, title in zip(row, titles):
            panel.set_title(title)
    save(figure, "by-hand")


def _error(scene: Scene, model: TrueModel, corrections: Corrections) -> np.ndarray:
    """Return the terrain model of the points that are ground minus the truth."""
    classes, _ = classify_cloud(scene.cloud(), TinDensification(), corrections=corrections)
    return model.error(scene, classes == GROUND)


def _drawn_round(wrong: np.ndarray) -> np.ndarray:
    """Return column and row of the corners of a polygon round the largest place that is wrong."""
    numbers, count = ndimage.label(ndimage.binary_closing(wrong, iterations=2))
    sizes = ndimage.sum(wrong, numbers, range(1, count + 1))
    places = np.argwhere(ndimage.binary_dilation(numbers == 1 + np.argmax(sizes), iterations=4))[
        :, ::-1
    ]
    return places[ConvexHull(places).vertices]
