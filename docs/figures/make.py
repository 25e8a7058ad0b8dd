"""Makes the figures of the pages, by the project's own code on generated scenes and real land.

    tools/environment python docs/figures/make.py            all of them, in about two minutes
    tools/environment python docs/figures/make.py slope      those whose names begin so

The same points come of the same seeds, so that the figures are the same on each run.
"""

from __future__ import annotations

import math
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Callable

import laspy
import matplotlib as mpl
import numpy as np
import rasterio
from matplotlib import pyplot
from matplotlib.cm import ScalarMappable
from PIL import Image

sys.path.insert(0, str(Path(__file__).parents[2]))

from above_ground_figure import above_ground
from by_hand_figure import by_hand
from change_figure import change_tutorial
from drawing import FEW_COLOURS, IMAGES, OTHER, draw_errors, save, shade, shrink
from expected_error_figure import expected_and_found
from method_figures import grid_minimum_steps, slope_filter_steps, tin_densification_steps
from noise_figure import noise
from outline_figures import canopy_pits, terrain_outline
from relief_figure import relief, walls
from tutorial_figures import JOBS, tutorial_figures
from water_figure import water

import bare_earth
from bare_earth.algorithms.filters.tin import PRESETS
from bare_earth.algorithms.grids.cells import Cells
from bare_earth.algorithms.grids.inpaint import inpaint
from bare_earth.algorithms.relief.smoothing import without_noise
from benchmarks.data import real
from benchmarks.generated import TrueModel, score_scene
from benchmarks.measure import Filter
from benchmarks.scenes import make
from demo.land import LANDS, write_unclassified
from demo.picture import draw as draw_demo

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
PRESET_SCENES = (
    "hedges", "terraces", "steep_forest", "sea_cliff", "hall_flat", "complex_on_slope",
    "greenhouses", "dense_canopy",
)  # fmt: skip
SEED = 1


def main() -> None:
    """Make the figures that the command line names, or all."""
    mpl.rcParams.update({"font.size": 8, "axes.titlesize": 8, "axes.titlelocation": "left"})
    figures: dict[str, Callable[[], None]] = {
        "before-after": tutorial,
        "tin-densification-steps": tin_densification_steps,
        "slope-filter-steps": slope_filter_steps,
        "grid-minimum-steps": grid_minimum_steps,
        "above-ground": above_ground,
        "by-hand": by_hand,
        "change": change_tutorial,
        "expected-error": expected_and_found,
        "noise": noise,
        "relief-smoothing": relief_smoothing,
        "relief-pictures": relief,
        "relief-walls": walls,
        "terrain-outline": terrain_outline,
        "canopy-pits": canopy_pits,
        "presets": print_presets,
        **{f"which-method-{name}": partial(small_multiples, name) for name in TERRAIN},
        "water": water,
        **{f"tutorial-{job}": partial(tutorial_figures, job) for job in JOBS},
    }
    for name, make_figure in figures.items():
        if name.startswith(tuple(sys.argv[1:]) or ("",)):
            make_figure()


# The tile of `make demo LAND=campus`, from raw points to maps.

CELL = 0.5
# Where its section lies, in metres from the south: it cuts the building, the wall and a tree.
SECTION = 14.6


def tutorial() -> None:
    """Draw what the pages on the first run show: the tile before, and what is made of it."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        cloud, ground = folder / "campus.las", folder / "ground.las"
        write_unclassified(LANDS["campus"].path, cloud)
        rasters = {stem: folder / f"{stem}.tif" for stem in ("dtm", "hillshade", "dsm", "chm")}
        maps_of_ground = {name: rasters[name] for name in ("dtm", "hillshade")}
        bare_earth.classify(cloud, ground, **maps_of_ground, dtm_cell_size=CELL)
        bare_earth.terrain(ground, dsm=rasters["dsm"], chm=rasters["chm"], dtm_cell_size=CELL)
        grids = {}
        for stem, path in rasters.items():
            with rasterio.open(path) as raster:
                grids[stem] = raster.read(1, masked=True).astype(float).filled(np.nan)
        raw_points(cloud)
        target = IMAGES / "tutorial-classes.png"
        northing = SECTION + float(laspy.read(cloud).header.mins[1])
        draw_demo(ground, rasters["dtm"], rasters["hillshade"], target, northing=northing)
        with Image.open(target) as image:
            small = image.convert("RGB")
        small.thumbnail((1000, 1000))
        shrink(small, target)
    before_after(grids)
    maps(grids)


def raw_points(cloud: Path) -> None:
    """Draw a cloud as it comes: from above by height, and a strip from the side."""
    las = laspy.read(cloud)
    x, y, z = (np.asarray(axis) for axis in (las.x, las.y, las.z))
    x, y = x - x.min(), y - y.min()
    figure = pyplot.figure(figsize=(8.2, 2.4), layout="constrained")
    plan, side = figure.subplots(1, 2, width_ratios=(1.0, 1.7))
    low, high = np.percentile(z, (0.5, 99.5))
    order = np.argsort(z)
    plan.scatter(
        x[order], y[order], 1.0, z[order], cmap="viridis", vmin=low, vmax=high, linewidths=0
    )
    plan.set(xticks=[], yticks=[], aspect="equal", title="From above, coloured by height")
    plan.axhline(SECTION, color="black", linewidth=0.8, linestyle=(0, (6, 4)))
    near = np.abs(y - SECTION) < 0.5
    side.scatter(x[near], z[near], 1.5, OTHER, linewidths=0)
    side.set(ylim=(low - 4, high + 8), title="From the side, along the dashed line; metres")
    side.grid(color="#dddddd", linewidth=0.4)
    save(figure, "tutorial-raw")


def before_after(grids: dict[str, np.ndarray]) -> None:
    """Draw the surface that the laser met beside the terrain."""
    figure, axes = pyplot.subplots(1, 2, figsize=(8.2, 3.0), layout="constrained")
    low, high = np.nanpercentile(grids["dtm"], (1, 99))
    for panel, name, title in zip(
        axes, ("dsm", "dtm"), ("Before: what the laser met", "After: the bare earth")
    ):
        shade(panel, grids[name], CELL)
        panel.imshow(grids[name], cmap="gist_earth", alpha=0.35, vmin=low - 2, vmax=high + 8)
        panel.set_title(title, fontsize=10)
    save(figure, "before-after")


def maps(grids: dict[str, np.ndarray]) -> None:
    """Draw terrain with contours, and canopy height over the hillshade."""
    figure, axes = pyplot.subplots(1, 2, figsize=(8.2, 3.0), layout="constrained")
    for panel in axes:
        shade(panel, grids["dtm"], CELL)
    image = axes[0].imshow(grids["dtm"], cmap="gist_earth", alpha=0.35)
    # A bar of the image would be as pale as it.
    colours = ScalarMappable(image.norm, image.cmap)
    figure.colorbar(colours, ax=axes[0], shrink=0.7, pad=0.01, label="m")
    levels = np.arange(math.floor(np.nanmin(grids["dtm"])), np.nanmax(grids["dtm"]) + 1, 1.0)
    thick = np.where(levels % 5 == 0, 0.9, 0.35)
    axes[0].contour(grids["dtm"], levels=levels, colors="#5b3a1a", linewidths=thick)
    axes[0].set_title("Terrain model, hillshade and contour lines of 1 m")
    canopy = np.ma.masked_less(grids["chm"], 0.5)
    image = axes[1].imshow(canopy, cmap="YlGn", vmin=0, vmax=20)
    figure.colorbar(image, ax=axes[1], shrink=0.7, pad=0.01, label="m")
    axes[1].set_title("Canopy height (buildings too) over the hillshade")
    save(figure, "tutorial-maps")


def relief_smoothing() -> None:
    """Draw hillshades of a forest and of fields, as the points are and smoothed; of real tiles."""
    figure, axes = pyplot.subplots(2, 2, figsize=(8.2, 8.4), layout="constrained")
    places = {"hawaii_forest": (300, 300), "nrw_rural": (700, 900)}
    for row, (name, (top, left)) in zip(axes, places.items()):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "dtm.tif"
            bare_earth.terrain(real(f"{name}.laz"), dtm=path, dtm_cell_size=0.5)
            with rasterio.open(path) as raster:
                heights = raster.read(1, masked=True).astype(float).filled(np.nan)
        window = np.s_[top : top + 360, left : left + 360]
        shade(row[0], heights[window], 0.5)
        shade(row[1], without_noise(heights, 0.5)[window], 0.5)
        row[0].set_title(f"{name}, cells of 0.5 m: not smoothed")
        row[1].set_title("automatic")
    save(figure, "relief-smoothing", 75, FEW_COLOURS)


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
            draw_errors(panel, model.heights, model.error(scene, ground))
            score = score_scene(scene, ground, model, with_dtm=False)
            panel.set_title(f"{label}: I {score.type_1:.1f}, II {score.type_2_high:.1f} %")
    save(figure, f"which-method-{group}", 90, FEW_COLOURS)


def print_presets() -> None:
    """Print the errors of each preset of TIN densification on some scenes as a table."""
    presets = list(PRESETS)
    print("| Scene |", " | ".join(f"`{preset}`" for preset in presets), "|")
    print("|---" * (len(presets) + 1) + "|")
    for kind in PRESET_SCENES:
        scene = make(kind, SEED)
        row = [kind]
        for preset in presets:
            ground = Filter("tin-densification", preset=preset).ground(scene.cloud())
            score = score_scene(scene, ground, with_dtm=False)
            row.append(f"{score.type_1:.1f} / {score.type_2_high:.1f}")
        print("|", " | ".join(row), "|")


if __name__ == "__main__":
    main()
