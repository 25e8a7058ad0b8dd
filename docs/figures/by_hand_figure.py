"""The figure of the page on corrections by hand, drawn by the project's own code."""

from __future__ import annotations

from functools import partial

import numpy as np
from drawing import draw_errors, save, shade
from matplotlib import pyplot
from scipy import ndimage
from scipy.spatial import ConvexHull

from bare_earth.algorithms.classes.corrections import Corrections
from bare_earth.algorithms.core.parameters import ParameterSet
from bare_earth.algorithms.core.points import Frame
from bare_earth.algorithms.filters.grid_minimum import GridMinimum
from bare_earth.algorithms.filters.tin import TinDensification
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from benchmarks.clouds import classify_cloud
from benchmarks.generated import TrueModel
from benchmarks.scenes import Scene, make
from benchmarks.scenes.scene import ORIGIN

GROUND = 2
# Of each place what makes the scene, the method, what is wrong, and the class of the polygon on it.
PLACES = (
    (partial(make, "complex_on_slope", 903), TinDensification(), "a building is kept", 6),
    (partial(make, "sea_cliff", 1), GridMinimum(), "a rock is lost", GROUND),
)
# Metres by which the terrain is wrong where somebody would draw.
WRONG = 0.7
# Share of the largest place that is wrong, from which on others belong to it.
LARGE = 0.2


def by_hand() -> None:
    """Draw terrain models without and with a polygon on what is wrong."""
    figure, axes = pyplot.subplots(len(PLACES), 3, figsize=(8.2, 5.6), layout="constrained")
    for row, (make_scene, parameters, words, value) in zip(axes, PLACES):
        scene = make_scene()
        model = TrueModel.of(scene)
        before = _error(scene, model, parameters, Corrections())
        ring = _drawn_round(before < -WRONG if value == GROUND else before > WRONG)
        grid = RasterGrid.over(scene.points.take(scene.ground), Frame(), 1.0)
        polygon = np.column_stack((grid.x[ring[:, 0]], grid.y[ring[:, 1]])) + ORIGIN
        after = _error(scene, model, parameters, Corrections(((polygon,),), (value,)))
        for panel, error in zip(row, (before, after)):
            draw_errors(panel, model.heights, error)
            panel.plot(*ring[[*range(len(ring)), 0]].T, color="black", linewidth=1.2)
        shade(row[2], model.heights)
        titles = f"Filter alone: {words}", f"With the polygon, class {value}", "True terrain"
        for panel, title in zip(row, titles):
            panel.set_title(title)
    save(figure, "by-hand")


def _error(
    scene: Scene, model: TrueModel, parameters: ParameterSet, corrections: Corrections
) -> np.ndarray:
    """Return the terrain model of the points that are ground minus the truth."""
    classes, _ = classify_cloud(scene.cloud(), parameters, corrections=corrections)
    return model.error(scene, classes == GROUND)


def _drawn_round(wrong: np.ndarray) -> np.ndarray:
    """Return column and row of the corners of a polygon round the large places that are wrong."""
    numbers, count = ndimage.label(ndimage.binary_closing(wrong, iterations=2))
    sizes = np.bincount(numbers[wrong], minlength=count + 1)
    large = np.flatnonzero(sizes > LARGE * sizes[1:].max())
    near = ndimage.binary_dilation(np.isin(numbers, large[large > 0]), iterations=4)
    places = np.argwhere(near)[:, ::-1]
    return places[ConvexHull(places).vertices]
