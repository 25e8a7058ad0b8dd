"""Figures of what each method does, drawn by its own code from the side of a scene."""

from __future__ import annotations

import math
from typing import TypeVar

import matplotlib as mpl
import numpy as np
from drawing import ADDED, GROUND, LINE, OTHER, save, shade
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from bare_earth.algorithms.core.parameters import ParameterSet
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.progress import SILENT
from bare_earth.algorithms.filters import grid_minimum
from bare_earth.algorithms.filters import slope as slope_filter
from bare_earth.algorithms.filters import tin as tin_densification
from bare_earth.algorithms.filters.method import Method
from bare_earth.algorithms.filters.pipeline import Stage
from bare_earth.algorithms.filters.stages.height_steps import HeightSteps
from bare_earth.algorithms.filters.stages.objects import RaisedObjects
from bare_earth.algorithms.filters.state import State, covered
from bare_earth.algorithms.grids.inpaint import inpaint
from bare_earth.algorithms.grids.morphology import erosion
from benchmarks.scenes import Scene, make

Value = TypeVar("Value")
# The stages after which the seeds, and the vertices and their limits, are known.
LAST_STAGES = Stage.SEEDS, Stage.ACCEPTED


def chosen(value: Value | None) -> Value:
    """Return a parameter that `resolve` has set, where its user left it open."""
    if value is None:
        raise ValueError("The parameters are not resolved: call their `resolve` first.")
    return value


class Strip:
    """The points of a scene that take part by default, and a strip of it from west to east."""

    def __init__(self, scene: Scene, northing: float, span: tuple[float, float], half: float):
        self.points = scene.points.take(scene.return_number == scene.number_of_returns)
        self.west, self.south = (middle - scene.settings.size / 2 for middle in scene.corner)
        self.northing, self.half = northing + self.south, half
        self.span = span[0] + self.west, span[1] + self.west
        self.inside = np.abs(self.points.y - self.northing) < half
        self.inside &= (self.points.x > self.span[0]) & (self.points.x < self.span[1])

    def draw(self, panel: Axes, which: np.ndarray, colour: str, size: float = 3) -> None:
        """Draw those of some points that lie in the strip."""
        here = which[self.inside[which]]
        x, z = self.points.x[here] - self.west, self.points.z[here]
        panel.scatter(x, z, size, colour, linewidths=0)

    def frame(self, panel: Axes, title: str, **labels: str) -> None:
        """Give a panel its title, its frame, and the names of the colours."""
        handles = [
            Line2D([], [], color=colour, marker="o", linewidth=0, markersize=4, label=label)
            for label, colour in labels.items()
        ]
        panel.legend(handles=handles, loc="upper left", ncols=len(handles), frameon=False)
        panel.set_title(title)
        panel.set_xlim(self.span[0] - self.west, self.span[1] - self.west)
        low, high = panel.get_ylim()
        panel.set_ylim(low, high + 0.15 * (high - low))
        panel.grid(color="#dddddd", linewidth=0.4)
        panel.set_axisbelow(True)

    def line(self, count: int = 900) -> tuple[np.ndarray, np.ndarray]:
        """Return places along the middle of the strip."""
        x = np.linspace(*self.span, count)
        return x, np.full(count, self.northing)


def of_stage(method: Method, points: Points, parameters: ParameterSet, stage: Stage) -> State:
    """Return what a method has found out about points after a stage."""
    return method.pipeline(points, parameters, SILENT).through(stage).run(points)


def tin_densification_steps() -> None:
    """Draw lowest points, seeds and their TIN, the TIN that has grown, and the labels."""
    strip = Strip(make("dense_canopy", 1), 94.0, (20.0, 100.0), 2.5)
    points = strip.points
    method, parameters = tin_densification.METHOD, tin_densification.TinDensification()
    before, after = (of_stage(method, points, parameters, stage) for stage in LAST_STAGES)
    (grid,) = after.grids
    seeds, waiting, vertices = before.seeds, before.candidates, after.seeds
    joined, limits, cells = np.setdiff1d(vertices, seeds), after.limits, grid.cells
    ground = method.classify(points, parameters)

    figure, axes = pyplot.subplots(4, 1, figsize=(8.2, 8.6), layout="constrained", sharex=True)
    everything = np.arange(points.count)
    strip.draw(axes[0], everything, OTHER)
    strip.draw(axes[0], grid.lowest, LINE, 5)
    strip.frame(axes[0], "Lowest point of each cell", others=OTHER, lowest=LINE)
    for panel, some in ((axes[1], seeds), (axes[2], vertices)):
        strip.draw(panel, waiting, OTHER)
        x, y = strip.line()
        panel.plot(x - strip.west, tin_height(points.take(some), x, y), color="black", linewidth=1)
        strip.draw(panel, seeds, GROUND, 9)
    strip.draw(axes[2], joined, ADDED, 16)
    strip.frame(
        axes[1], "Seeds, and the TIN through them (a cut through its middle)",
        candidates=OTHER, seeds=GROUND,
    )  # fmt: skip
    strip.frame(
        axes[2], "Candidates that joined, as distance and angle to the TIN were small enough",
        candidates=OTHER, seeds=GROUND, joined=ADDED,
    )  # fmt: skip
    x, y = strip.line()
    below, above = (cells.interpolated(limits[..., side], x, y) for side in (0, 1))
    axes[3].fill_between(x - strip.west, below, above, color="#f0d9a8", linewidth=0)
    strip.draw(axes[3], np.flatnonzero(~ground), OTHER)
    strip.draw(axes[3], np.flatnonzero(ground), GROUND, 6)
    strip.frame(
        axes[3], "Labels: all points within the tolerance of the final surface",
        other=OTHER, ground=GROUND,
    )  # fmt: skip
    for panel in axes[1:]:
        low = points.z[vertices[strip.inside[vertices]]]
        panel.set_ylim(low.min() - 1.5, low.max() + 5.0)
    axes[-1].set_xlabel("metres")
    save(figure, "tin-densification-steps")


def tin_height(vertices: Points, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Return the heights of the TIN of some points."""
    from scipy.interpolate import LinearNDInterpolator

    return LinearNDInterpolator(np.column_stack(vertices[:2]), vertices.z)(x, y)


def slope_filter_steps() -> None:
    """Draw the opening, the test on some scales, and the labels."""
    scene = make("mixed_land", 2004)
    strip = Strip(scene, 67.0, (90.0, 215.0), 1.0)
    points = strip.points
    parameters = slope_filter.SlopeFilter().resolve(points)
    (grid,) = of_stage(slope_filter.METHOD, points, parameters, Stage.OUTLIERS).grids
    cells, known = grid.cells, grid.heights.known
    heights = np.where(known, grid.heights.values, np.inf)
    radius = chosen(parameters.search_radius) / cells.size
    eroded = erosion(heights, radius)
    opened = -erosion(np.where(np.isfinite(eroded), -eroded, np.inf), radius)
    above = np.where(known, heights - opened, np.inf)
    ground = slope_filter.METHOD.classify(points, parameters)

    figure, axes = pyplot.subplots(3, 1, figsize=(8.2, 6.9), layout="constrained", sharex=True)
    row = int(strip.northing // cells.size) - cells.first_row
    x = (np.arange(cells.columns) + cells.first_column + 0.5) * cells.size - strip.west
    strip.draw(axes[0], np.arange(points.count), OTHER)
    strip.draw(axes[0], grid.lowest, LINE, 5)
    axes[0].plot(x, opened[row], color="black", linewidth=1)
    strip.frame(
        axes[0], "Lowest points, and their opening with the search radius (line)",
        others=OTHER, lowest=LINE,
    )  # fmt: skip
    here = np.where(known[row], above[row], np.nan)
    objects = np.zeros(cells.columns, dtype=bool)
    slope = math.tan(math.radians(chosen(parameters.slope_threshold)))
    least = chosen(parameters.height_threshold)
    for scale, style in ((radius, "-"), (radius / 4.0, "--"), (radius / 16.0, ":")):
        allowed = max(slope * scale * cells.size, least)
        limit = erosion(above, scale)[row] + allowed
        objects |= here > limit
        label = f"limit within {scale * cells.size:.1f} m"
        axes[1].plot(x, limit, "black", linestyle=style, linewidth=0.9, label=label)
    axes[1].scatter(x, here, 9, np.where(objects, ADDED, GROUND), linewidths=0)
    axes[1].set_ylim(-0.5, 13.0)
    axes[1].set_xlim(strip.span[0] - strip.west, strip.span[1] - strip.west)
    axes[1].legend(loc="upper left", frameon=False, ncols=3)
    axes[1].set_title(
        "Height above the opening: red cells stand above a limit, the lowest neighbour and what"
        " the slope allows"
    )
    strip.draw(axes[2], np.flatnonzero(~ground), OTHER)
    strip.draw(axes[2], np.flatnonzero(ground), GROUND)
    strip.frame(axes[2], "Labels, after large buildings, breaks and tolerance", other=OTHER,
                ground=GROUND)  # fmt: skip
    axes[2].set_xlabel("metres")
    save(figure, "slope-filter-steps")


def grid_minimum_steps() -> None:
    """Draw lowest heights, regions between rims, and what goes, from above and from the side."""
    scene = make("mixed_land", 2004)
    strip = Strip(scene, 67.0, (90.0, 215.0), 1.0)
    points = strip.points
    parameters = grid_minimum.GridMinimum().resolve(points)
    (grid,) = of_stage(grid_minimum.METHOD, points, parameters, Stage.OUTLIERS).grids
    cells, heights = grid.cells, grid.heights.values
    thresholds, largest = chosen(parameters.height_thresholds), chosen(parameters.max_object_size)
    last = thresholds[-1]
    steps = HeightSteps(grid.heights, covered(grid.heights.known))
    regions, rims = steps.regions_and_rims(last, 1.0)
    tall = RaisedObjects(largest, thresholds).find(grid.heights).raised
    ground = grid_minimum.METHOD.classify(points, parameters)

    figure = pyplot.figure(figsize=(8.2, 6.2), layout="constrained")
    upper, lower = figure.subfigures(2, 1, squeeze=False, height_ratios=(1.9, 4.0)).ravel()
    maps, profiles = upper.subplots(1, 3), lower.subplots(2, 1, sharex=True)
    row = int(strip.northing // cells.size) - cells.first_row
    west = int(strip.span[0] // cells.size) - cells.first_column
    part = np.s_[row - 35 : row + 35, west : west + 125]
    number = np.random.default_rng(4).permutation(regions.number.max() + 1)[regions.number]
    shade(maps[0], inpaint(heights)[part][::-1])
    maps[0].set_title("Lowest height of each cell")
    colours = mpl.colormaps["tab20c"](number[part] % 20)
    colours[rims[part]] = (0, 0, 0, 1)
    maps[1].imshow(colours[::-1], interpolation="nearest")
    maps[1].set_title(f"Rims of {last:g} m (black) and regions")
    shade(maps[2], inpaint(heights)[part][::-1], faint=True)
    maps[2].imshow(
        np.ma.masked_equal(tall[part][::-1], False),
        cmap=mpl.colors.ListedColormap([ADDED]), alpha=0.7, interpolation="nearest",
    )  # fmt: skip
    maps[2].set_title("Regions bounded by a drop go")
    for panel in maps:
        panel.axhline(34.5, color=LINE, linewidth=0.9)
        panel.set(xticks=[], yticks=[])
    x = (np.arange(cells.columns) + cells.first_column + 0.5) * cells.size - strip.west
    low = np.where(tall[row], np.nan, heights[row])
    profiles[0].step(x, heights[row], where="mid", color=ADDED, linewidth=1.2)
    profiles[0].step(x, low, where="mid", color=GROUND, linewidth=1.4)
    strip.frame(profiles[0], "Lowest heights along the blue line", kept=GROUND, removed=ADDED)
    strip.draw(profiles[1], np.flatnonzero(~ground), OTHER)
    strip.draw(profiles[1], np.flatnonzero(ground), GROUND)
    strip.frame(profiles[1], "Labels, after low objects, growing back, breaks and tolerance",
                other=OTHER, ground=GROUND)  # fmt: skip
    profiles[1].set_xlabel("metres")
    save(figure, "grid-minimum-steps")
