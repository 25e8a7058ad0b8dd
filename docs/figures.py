"""Makes the figures of the pages, by the project's own code on generated scenes.

    tools/environment python docs/figures.py            all of them, in about two minutes
    tools/environment python docs/figures.py slope      those whose names begin so

The same points come of the same seeds, so that the figures are the same on each run.
"""

from __future__ import annotations

import math
import sys
import tempfile
from pathlib import Path

import matplotlib as mpl
import numpy as np
import rasterio
from matplotlib import pyplot
from matplotlib.lines import Line2D
from PIL import Image

sys.path.insert(0, str(Path(__file__).parents[1]))

from bare_earth.algorithms import ClassifyRequest, RasterFiles, TerrainRequest, classify, terrain
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.progress import SILENT
from bare_earth.algorithms.filters.grid_minimum import filter as grid_minimum
from bare_earth.algorithms.filters.shared.breaks import checked_seeds
from bare_earth.algorithms.filters.shared.ground_limits import Tolerance, ground_limits
from bare_earth.algorithms.filters.shared.lowest_points import LowestPoints
from bare_earth.algorithms.filters.shared.objects import Relief, covered, raised_objects
from bare_earth.algorithms.filters.slope import filter as slope_filter
from bare_earth.algorithms.filters.tin_densification import filter as tin_densification
from bare_earth.algorithms.filters.tin_densification.densification import (
    DensificationRules,
    densified,
    with_lower,
)
from bare_earth.algorithms.filters.tin_densification.seeds import seeds_of_two_grids
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.grids.hillshade import hillshade
from bare_earth.algorithms.grids.inpaint import inpaint
from bare_earth.algorithms.grids.morphology import erosion
from bare_earth.algorithms.las.cloud import PointCloud
from benchmarks.generated import TrueModel, score_scene
from benchmarks.measure import Filter
from benchmarks.scenes import Scene, make
from demo.picture import draw as draw_demo
from demo.scene import write_scene

IMAGES = Path(__file__).parent / "images"
GROUND, OTHER, ADDED, LINE = "#a5692a", "#9aa5b1", "#d7263d", "#1565d8"
METHODS = {"tin-densification": "TIN densification", "slope": "slope", "grid-minimum": "grid"}
# A kind of scene of the reporting seeds, and what a reader calls it.
TERRAIN = {
    "land": {
        "hills": "meadows and shrubs",
        "terraces": "terraces",
        "steep_forest": "steep forest",
        "sea_cliff": "sea cliff",
    },
    "built": {
        "city_blocks": "city blocks",
        "hillside_village": "village on a slope",
        "complex_on_slope": "halls on a slope",
        "stepped_city": "city on levels",
    },
    "special": {
        "dense_canopy": "dense forest",
        "bridge_over_river": "bridge",
        "dyke_and_ditch": "dyke and ditches",
        "drone_50": "drone, 50 pulses/m²",
    },
}
SEED = 1
COLOURS = 128


def main() -> None:
    """Make the figures that the command line names, or all."""
    mpl.rcParams.update({"font.size": 8, "axes.titlesize": 8, "axes.titlelocation": "left"})
    figures = {
        "before-after": lambda: tutorial(),
        "tin-densification-steps": tin_densification_steps,
        "slope-filter-steps": slope_filter_steps,
        "grid-minimum-steps": grid_minimum_steps,
    }
    figures |= {f"which-method-{name}": lambda name=name: small_multiples(name) for name in TERRAIN}
    for name, make_figure in figures.items():
        if name.startswith(tuple(sys.argv[1:]) or ("",)):
            make_figure()


def save(figure: pyplot.Figure, name: str, dots_per_inch: int = 110) -> None:
    """Save a figure with few colours, which makes it small."""
    target = IMAGES / f"{name}.png"
    figure.savefig(target, dpi=dots_per_inch, metadata={"Software": None})
    pyplot.close(figure)
    with Image.open(target) as image:
        image.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE).save(target, optimize=True)
    print(f"{target.name}: {target.stat().st_size // 1000} kB")


# The tile of `make demo`, from raw points to maps.


def tutorial() -> None:
    """Draw what the pages on the first run show: the tile before, and what is made of it."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cloud, truth, ground = (folder / f"{each}.las" for each in ("scene", "truth", "ground"))
        write_scene(cloud, truth)
        rasters = {each: folder / f"{each}.tif" for each in ("dtm", "hillshade", "dsm", "chm")}
        classify(
            cloud,
            ground,
            ClassifyRequest(
                rasters=RasterFiles(dtm=rasters["dtm"], hillshade=rasters["hillshade"])
            ),
        )
        terrain(
            ground, TerrainRequest(rasters=RasterFiles(dsm=rasters["dsm"], chm=rasters["chm"]))
        )
        grids, extent = {}, None
        for each, path in rasters.items():
            with rasterio.open(path) as raster:
                grids[each] = raster.read(1, masked=True).astype(float).filled(np.nan)
                extent = raster.bounds[0], raster.bounds[2], raster.bounds[1], raster.bounds[3]
        target = IMAGES / "tutorial-classes.png"
        draw_demo(ground, rasters["dtm"], rasters["hillshade"], target, northing=5_931_196.0)
        with Image.open(target) as image:
            image = image.convert("RGB")
            image.thumbnail((1000, 1000))
            image.quantize(COLOURS, dither=Image.Dither.NONE).save(target, optimize=True)
    before_after(grids)
    maps(grids, extent)


def before_after(grids: dict[str, np.ndarray]) -> None:
    """Draw the surface that the laser met beside the terrain."""
    figure, axes = pyplot.subplots(1, 2, figsize=(8.2, 4.3), layout="constrained")
    low, high = np.nanpercentile(grids["dtm"], (1, 99))
    for panel, name, title in zip(
        axes, ("dsm", "dtm"), ("Before: what the laser met", "After: the bare earth")
    ):
        shade(panel, grids[name])
        panel.imshow(grids[name], cmap="gist_earth", alpha=0.35, vmin=low - 2, vmax=high + 8)
        panel.set_title(title, fontsize=10)
    save(figure, "before-after")


def maps(grids: dict[str, np.ndarray], extent: tuple[float, ...]) -> None:
    """Draw terrain with contours, and canopy height over the hillshade."""
    figure, axes = pyplot.subplots(1, 2, figsize=(8.2, 4.3), layout="constrained")
    for panel in axes:
        shade(panel, grids["dtm"])
    image = axes[0].imshow(grids["dtm"], cmap="gist_earth", alpha=0.35)
    figure.colorbar(image, ax=axes[0], shrink=0.7, pad=0.01, label="m").solids.set_alpha(1)
    levels = np.arange(math.floor(np.nanmin(grids["dtm"])), np.nanmax(grids["dtm"]) + 1, 1.0)
    thick = np.where(levels % 5 == 0, 0.9, 0.35)
    axes[0].contour(grids["dtm"], levels=levels, colors="#5b3a1a", linewidths=thick)
    axes[0].set_title("Terrain model, hillshade and contour lines of 1 m")
    canopy = np.ma.masked_less(grids["chm"], 0.5)
    image = axes[1].imshow(canopy, cmap="YlGn", vmin=0, vmax=20)
    figure.colorbar(image, ax=axes[1], shrink=0.7, pad=0.01, label="m")
    axes[1].set_title("Canopy height (buildings too) over the hillshade")
    save(figure, "tutorial-maps")


def shade(panel: pyplot.Axes, heights: np.ndarray, cell_size: float = 1.0, faint: bool = False):
    """Draw the hillshade of a grid whose first row is the north."""
    grey = np.ma.masked_equal(hillshade(heights, cell_size), 0)
    panel.imshow(grey, cmap="gray", vmin=-200 if faint else 1, vmax=255, interpolation="nearest")
    panel.set_xticks([])
    panel.set_yticks([])


# Small multiples: kinds of terrain, and what each method makes of them.


def small_multiples(group: str) -> None:
    """Draw the surface, the truth, and the terrain of each method with its errors."""
    kinds = TERRAIN[group]
    columns = 2 + len(METHODS)
    figure, axes = pyplot.subplots(
        len(kinds), columns, figsize=(9.6, 2.12 * len(kinds)), layout="constrained"
    )
    for row, (kind, words) in zip(axes, kinds.items()):
        scene = make(kind, SEED)
        model = TrueModel.of(scene)
        first = scene.points.take(scene.return_number == 1)
        highest = -Cells.over(first, 1.0).minimum(-first.z)
        shade(row[0], inpaint(highest)[::-1])
        row[0].set_title(words)
        shade(row[1], model.heights)
        row[1].set_title("true terrain")
        for panel, (method, label) in zip(row[2:], METHODS.items()):
            ground = Filter(method).ground(scene.cloud())
            draw_errors(panel, model, model.error(scene, ground))
            score = score_scene(scene, ground, model, with_dtm=False)
            panel.set_title(f"{label}: I {score.type_1:.1f}, II {score.type_2_high:.1f} %")
    save(figure, f"which-method-{group}", 100)


def draw_errors(panel: pyplot.Axes, model: TrueModel, error: np.ndarray) -> None:
    """Draw a terrain model: red where it is too high, blue where it is too low."""
    shade(panel, model.heights + error, faint=True)
    colours = np.zeros((*error.shape, 4))
    colours[error > 0] = mpl.colors.to_rgba(ADDED)
    colours[error <= 0] = mpl.colors.to_rgba(LINE)
    # Errors of less than 0.2 m are not shown; from 1 m on they are so in full colour.
    colours[..., 3] = np.clip((np.abs(np.nan_to_num(error)) - 0.2) / 0.8, 0, 0.9)
    panel.imshow(colours, interpolation="nearest")


# What the methods do, in a strip of a scene seen from its side.


def strip(points: Points, northing: float, half: float, span: tuple[float, float]) -> np.ndarray:
    """Return which points lie in a strip from west to east."""
    near = np.abs(points.y - northing) < half
    return np.flatnonzero(near & (points.x > span[0]) & (points.x < span[1]))


def last_returns(scene: Scene) -> tuple[PointCloud, Points]:
    """Return a scene as a cloud, and the points that take part by default."""
    return scene.cloud(), scene.points.take(scene.return_number == scene.number_of_returns)


def legend(panel: pyplot.Axes, **labels: str) -> None:
    """Name the colours of dots."""
    dots = [
        Line2D([], [], color=colour, marker="o", linewidth=0, markersize=4, label=label)
        for label, colour in labels.items()
    ]
    panel.legend(handles=dots, loc="upper left", ncols=len(dots), frameon=False)


def tin_densification_steps() -> None:
    """Draw lowest points, seeds and their TIN, the TIN that has grown, and the labels."""
    _, points = last_returns(make("dense_canopy", SEED))
    parameters = tin_densification.TinDensification().resolve(points)
    survey = LowestPoints(points, 1.0)
    found = seeds_of_two_grids(points, survey, parameters.max_building_size, SILENT)
    seeds, waiting = checked_seeds(points, *found, survey.cells, survey.spacing)
    heights = with_lower(np.full(survey.cells.shape, np.nan), survey.cells, points, seeds)
    rules = DensificationRules(
        **{name: getattr(parameters, name) for name in DensificationRules.__dataclass_fields__}
    )
    joined = densified(
        points, seeds, waiting, heights, survey.cells, survey.spacing, rules, SILENT
    )
    print(len(seeds), len(waiting), len(joined))
    return points, survey, seeds, waiting, joined, parameters


def slope_filter_steps() -> None:
    """Draw."""


def grid_minimum_steps() -> None:
    """Draw."""


if __name__ == "__main__":
    main()
