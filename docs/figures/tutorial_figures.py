"""The figures of the tutorials: their pages are run, and what they make is drawn."""

from __future__ import annotations

import json
import shutil
import tempfile
from pathlib import Path
from typing import Callable, NamedTuple

import laspy
import numpy as np
import rasterio
from drawing import ADDED, FEW_COLOURS, GROUND, LINE, OTHER, save
from matplotlib import pyplot
from matplotlib.axes import Axes

from demo.pages import commands_of, steps

_PAGE = Path(__file__).parents[1] / "jobs.md"
_CLASSES = {
    1: (OTHER, "1 unclassified"), 2: (GROUND, "2 ground"), 3: ("#b5d46a", "3 low plants"),
    4: ("#6fae4f", "4 medium plants"), 5: ("#2f7d43", "5 high plants"), 6: (LINE, "6 building"),
    17: ("#7a4fc0", "17 bridge"),
}  # fmt: skip
# Of the section of each tutorial: the axis along it (0 is from west to east), where it lies on the
# other one, and from where to where it is drawn, in metres from the south-west of the tile.
_SECTIONS = {
    "survey": (1, 55.0, (110.0, 190.0)), "archaeology": (0, 22.0, (5.0, 85.0)),
    "forestry": (0, 12.0, (0.0, 100.0)), "drone-site": (0, 34.0, (5.0, 95.0)),
}  # fmt: skip


class Raster(NamedTuple):
    """Values of a raster, and where they lie in metres from the south-west of the tile."""

    values: np.ndarray
    extent: tuple[float, float, float, float]


class Tutorial(NamedTuple):
    """What a tutorial makes: the folder of its reader, and deliveries before and after."""

    folder: Path
    first: Path
    second: Path
    corner: np.ndarray

    def raster(self, delivery: Path, name: str) -> Raster:
        """Return a raster of a delivery."""
        with rasterio.open(delivery / f"{name}.tif") as file:
            values = file.read(1, masked=True).astype(float).filled(np.nan)
            box = file.bounds
        west, south = self.corner
        extent = box.left - west, box.right - west, box.bottom - south, box.top - south
        return Raster(values, extent)

    def points(self, delivery: Path) -> tuple[np.ndarray, ...]:
        """Return x, y, z and the classes of all points."""
        files = [laspy.read(path) for path in sorted((delivery / "points").glob("*.laz"))]
        xyz = np.concatenate([np.asarray(cloud.xyz) for cloud in files])
        classes = np.concatenate([np.asarray(cloud.classification) for cloud in files])
        x, y = (xyz[:, :2] - self.corner).T
        return x, y, xyz[:, 2], classes

    def drawn(self, name: str) -> list[np.ndarray]:
        """Return the polygons or lines that the reader draws."""
        found = json.loads((self.folder / name).read_text(encoding="utf-8"))["features"]
        shapes = (feature["geometry"]["coordinates"] for feature in found)
        return [np.array(part[0] if np.ndim(part) > 2 else part) - self.corner for part in shapes]


def tutorial_figures(job: str) -> None:
    """Run the tutorial of a job, and make its figures."""
    with tempfile.TemporaryDirectory() as name:
        tutorial = _run(job, Path(name))
        _FIRST[job](tutorial)
        _corrected(job, tutorial)


def _run(job: str, folder: Path) -> Tutorial:
    sections = _PAGE.read_text(encoding="utf-8").split("\n## ")
    page = next(section for section in sections if f"make demo JOB={job}\n" in section)
    kept: list[Path] = []
    for block, _ in steps(page, folder):
        if block.kind == "sh" and any("deliver" in words for words in commands_of(block)):
            kept.append(folder / f"delivery-{len(kept)}")
            shutil.copytree("hand-over", kept[-1])
    with rasterio.open(kept[0] / "dtm.tif") as file:
        corner = np.array((file.bounds.left, file.bounds.bottom))
    return Tutorial(folder / "demo-output" / job, kept[0], kept[-1], np.round(corner, -1))


def _grey(panel: Axes, raster: Raster) -> None:
    low, high = np.nanpercentile(raster.values, (0.5, 99.5))
    values = np.ma.masked_equal(raster.values, 0)
    panel.imshow(values, cmap="gray", extent=raster.extent, vmin=low, vmax=high)


def _bare(panel: Axes, title: str) -> None:
    panel.set(title=title, xticks=[], yticks=[])


# What is corrected: the raster, the files of what is drawn, and the part of the tile.
_CORRECTED: dict[str, tuple[str, tuple[str, ...], tuple[float, ...] | None]] = {
    "survey": ("hillshade", ("corrections.geojson",), (15.0, 95.0, 120.0, 180.0)),
    "archaeology": ("vat", ("corrections.geojson",), None),
    "forestry": ("chm", ("corrections.geojson",), (0.0, 100.0, 0.0, 50.0)),
    "flood": ("hillshade", ("water.geojson", "rivers.geojson"), None),
    "drone-site": ("hillshade", ("corrections.geojson",), (0.0, 75.0, 10.0, 80.0)),
}
_NAMES = {"archaeology": "vat", "flood": "corrected"}


def _corrected(job: str, tutorial: Tutorial) -> None:
    """Draw the same raster before and after the correction, and what was drawn."""
    name, files, part = _CORRECTED[job]
    west, east, south, north = part or tutorial.raster(tutorial.first, name).extent
    high = 4.1 * (north - south) / (east - west) + 0.2
    figure, panels = pyplot.subplots(1, 2, figsize=(8.2, high), layout="constrained")
    for panel, delivery, title in zip(
        panels, (tutorial.first, tutorial.second), ("before", "after")
    ):
        raster = tutorial.raster(delivery, name)
        if name == "chm":
            panel.imshow(raster.values, cmap="YlGn", extent=raster.extent, vmin=0, vmax=8)
        else:
            _grey(panel, raster)
        for file in files:
            for shape in tutorial.drawn(file):
                panel.plot(*shape.T, color=LINE, lw=1.0)
        _bare(panel, f"{title}: {name}.tif")
        panel.set(xlim=(west, east), ylim=(south, north))
    save(figure, f"tutorial-{job}-{_NAMES.get(job, 'corrected')}", colours=48)


def _section(panel: Axes, job: str, tutorial: Tutorial) -> None:
    """Draw the points of a strip 2 m wide by their classes, and the terrain model."""
    axis, middle, limits = _SECTIONS[job]
    x, y, z, classes = tutorial.points(tutorial.first)
    along, across = (x, y) if axis == 0 else (y, x)
    near = (np.abs(across - middle) < 1.0) & (along > limits[0]) & (along < limits[1])
    for value, (colour, label) in _CLASSES.items():
        some = near & (classes == value)
        if some.any():
            panel.scatter(along[some], z[some], 2.4, colour, lw=0, label=label)
    terrain = tutorial.raster(tutorial.first, "dtm")
    west, east, south, north = terrain.extent
    rows, columns = terrain.values.shape
    if axis == 0:
        row = terrain.values[int((north - middle) * rows / (north - south))]
        places = west + (np.arange(columns) + 0.5) * (east - west) / columns
    else:
        row = terrain.values[::-1, int((middle - west) * columns / (east - west))]
        places = south + (np.arange(rows) + 0.5) * (north - south) / rows
    panel.plot(places, row, color="black", lw=0.7, label="terrain model")
    shown = z[near & np.isin(classes, list(_CLASSES))]
    panel.set(xlim=limits, ylim=(shown.min() - 1.0, shown.max() + 0.3 * np.ptp(shown)), ylabel="m")
    way = "west to east" if axis == 0 else "south to north"
    panel.set_title(f"section of the first run, 2 m wide, {way}")
    panel.legend(fontsize=6, markerscale=3, loc="upper right", ncols=2)


def _beside(wide: float) -> tuple[Axes, Axes, Callable[[str], None]]:
    """Return a panel for a map and a wide one for a section, and what saves their figure."""
    figure, (left, right) = pyplot.subplots(
        1, 2, figsize=(8.6, 3.5), layout="constrained", width_ratios=(1.0, wide)
    )
    return left, right, lambda name: save(figure, name, colours=128)


def _survey(tutorial: Tutorial) -> None:
    plan, side, finish = _beside(1.4)
    _grey(plan, tutorial.raster(tutorial.first, "hillshade"))
    heights = tutorial.raster(tutorial.first, "dtm")
    plan.imshow(heights.values, cmap="gist_earth", extent=heights.extent, alpha=0.45)
    rows = np.genfromtxt(
        tutorial.folder / "checkpoints.csv", delimiter=",", names=True, dtype=None, encoding="utf-8"
    )
    x, y = rows["East"] - tutorial.corner[0], rows["North"] - tutorial.corner[1]
    for cover, colour in (("open", "#ffffff"), ("forest", "#2f7d43")):
        some = rows["Land_cover"] == cover
        plan.scatter(x[some], y[some], 16, colour, ec="black", lw=0.6, label=f"checkpoint, {cover}")
    _, middle, limits = _SECTIONS["survey"]
    plan.plot((middle, middle), limits, color=LINE, ls="--", lw=1.2)
    plan.legend(fontsize=6, loc="lower left")
    _bare(plan, "terrain model of the first run")
    _section(side, "survey", tutorial)
    finish("tutorial-survey-map")


def _archaeology(tutorial: Tutorial) -> None:
    figure, panel = pyplot.subplots(figsize=(8.4, 3.2), layout="constrained")
    _section(panel, "archaeology", tutorial)
    save(figure, "tutorial-archaeology-section")


def _forestry(tutorial: Tutorial) -> None:
    plan, side, finish = _beside(1.6)
    canopy = tutorial.raster(tutorial.first, "chm")
    drawn = plan.imshow(canopy.values, cmap="YlGn", extent=canopy.extent, vmin=0)
    plan.figure.colorbar(drawn, ax=plan, shrink=0.7, label="m")
    _, middle, limits = _SECTIONS["forestry"]
    plan.plot(limits, (middle, middle), color=LINE, ls="--", lw=1.2)
    _bare(plan, "chm.tif of the first run")
    _section(side, "forestry", tutorial)
    finish("tutorial-forestry-canopy")


def _flood(tutorial: Tutorial) -> None:
    figure, panel = pyplot.subplots(figsize=(8.4, 2.8), layout="constrained")
    line = tutorial.drawn("rivers.geojson")[0]
    for delivery, colour, label in (
        (tutorial.first, ADDED, "first run"), (tutorial.second, LINE, "with your polygons"),
    ):  # fmt: skip
        terrain = tutorial.raster(delivery, "dtm")
        west, east, south, north = terrain.extent
        rows, columns = terrain.values.shape
        x = np.linspace(0.5, 149.5, 300)
        y = np.interp(x, *line.T)
        row = ((north - y) * rows / (north - south)).astype(int)
        column = ((x - west) * columns / (east - west)).astype(int)
        panel.plot(x, terrain.values[row, column], color=colour, label=label)
    panel.set(xlabel="m from west to east", ylabel="m", title="dtm.tif along the river")
    panel.legend()
    panel.grid(color="#dddddd", lw=0.5)
    save(figure, "tutorial-flood-river", colours=FEW_COLOURS)


def _drone_site(tutorial: Tutorial) -> None:
    plan, side, finish = _beside(1.6)
    _grey(plan, tutorial.raster(tutorial.first, "hillshade"))
    heights = tutorial.raster(tutorial.first, "dtm")
    levels = np.arange(np.floor(np.nanmin(heights.values)), np.nanmax(heights.values), 1.0)
    plan.contour(
        heights.values[::-1], levels, extent=heights.extent, colors="#9a5b1c", linewidths=0.5
    )
    _, middle, limits = _SECTIONS["drone-site"]
    plan.plot(limits, (middle, middle), color=LINE, ls="--", lw=1.2)
    _bare(plan, "hillshade, and contour lines every metre")
    _section(side, "drone-site", tutorial)
    finish("tutorial-drone-site-map")


_FIRST: dict[str, Callable[[Tutorial], None]] = {
    "survey": _survey,
    "archaeology": _archaeology,
    "forestry": _forestry,
    "flood": _flood,
    "drone-site": _drone_site,
}
JOBS = tuple(_FIRST)
