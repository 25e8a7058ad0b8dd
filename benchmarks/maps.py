"""Pictures for results/accuracy.md: where a filter errs, and terrain models in relief."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.grids.cells import Cells, spacing
from bare_earth.algorithms.grids.inpaint import inpaint
from bare_earth.algorithms.las.cloud import PointCloud
from bare_earth.algorithms.relief.hillshade import hillshade
from bare_earth.algorithms.tools.assess import Assessment

from .generated import SceneScore, TrueModel
from .measure import GROUND, ReferenceModel
from .scenes import Scene

TYPE_1, TYPE_2 = "#1565d8", "#e02020"
_INCHES, _DOTS_PER_INCH = 7.5, 110
# Inches below and above a map, for legend and title.
_MARGIN = 0.7
# Dots of wrong points are about as wide as the distance between points, but never a mere speck.
_SMALLEST_DOT = 1.2
# Metres of error that are not drawn, and above these, those that are drawn in full colour.
_SMALL_ERROR, _LARGE_ERROR = 0.2, 1.0
# Cells of the model that are a longer way off are skipped in the picture of a large tile.
_MOST_CELLS = 900


def error_map(
    cloud: PointCloud,
    ground: np.ndarray,
    reference: np.ndarray,
    assessment: Assessment,
    title: str,
    target: Path,
) -> None:
    """Draw the wrong points over the relief of the lowest points."""
    points = cloud.points(np.ones(cloud.count, dtype=bool))
    truth = reference == GROUND
    cells = Cells.over(points, max(1.0, float(np.ceil(spacing(points)))))
    relief = hillshade(inpaint(cells.minimum(points.z))[::-1], cells.size).astype(float)
    west, south = cells.first_column * cells.size, cells.first_row * cells.size
    extent = (west, west + cells.columns * cells.size, south, south + cells.rows * cells.size)
    figure, axes = _figure(1, cells.rows / cells.columns)
    axes = axes[0]
    axes.imshow(relief, cmap="gray", extent=extent, vmin=-120, vmax=255, interpolation="nearest")
    longer = max(extent[1] - extent[0], extent[3] - extent[2])
    width = max(72.0 * _INCHES * cells.size / longer, _SMALLEST_DOT)
    for wrong, colour, label in (
        (truth & ~ground, TYPE_1, f"type I: ground missed, {assessment.type_1_error:.1f} %"),
        (~truth & ground, TYPE_2, f"type II: other kept, {assessment.type_2_error:.1f} %"),
    ):
        where: Points = points.take(wrong)
        axes.scatter(where.x, where.y, s=width**2, c=colour, marker="s", linewidths=0, label=label)
    axes.set_xlim(extent[:2])
    axes.set_ylim(extent[2:])
    axes.set_title(f"{title}: total error {assessment.total_error:.1f} %", fontsize=10, loc="left")
    axes.legend(
        loc="upper center", bbox_to_anchor=(0.5, -0.01), ncol=2, frameon=False, fontsize=9,
        markerscale=max(6.0 / width, 1.0),
    )  # fmt: skip
    _save(figure, target)


def relief_pair(
    model: ReferenceModel, ground: np.ndarray, titles: tuple[str, str], target: Path
) -> None:
    """Draw the terrain model of a ground mask and that of the reference, side by side."""
    heights = model.heights
    step = max(-(-max(heights.shape) // _MOST_CELLS), 1)
    own = np.where(np.isfinite(heights), model.of(ground), np.nan)
    figure, axes = _figure(2, heights.shape[0] / heights.shape[1])
    for panel, values, title in zip(axes, (own, heights), titles):
        values = values[::step, ::step]
        shade = np.ma.masked_equal(hillshade(values, model.cell_size * step), 0)
        panel.imshow(shade, cmap="gray", vmin=1, vmax=255, interpolation="nearest")
        panel.set_title(title, fontsize=10, loc="left")
    _save(figure, target)


def scene_map(
    scene: Scene,
    model: TrueModel,
    ground: np.ndarray,
    score: SceneScore,
    title: str,
    target: Path,
) -> None:
    """Draw the terrain model of a ground mask in relief, and its errors beside it."""
    from matplotlib.colors import to_rgba

    error = model.error(scene, ground)
    own = model.heights + error
    figure, axes = _figure(2, own.shape[0] / own.shape[1])
    shade = np.ma.masked_equal(hillshade(own, 1.0), 0)
    axes[0].imshow(shade, cmap="gray", vmin=1, vmax=255, interpolation="nearest")
    axes[0].set_title(f"{title}, terrain model", fontsize=10, loc="left")
    truth = hillshade(model.heights, 1.0).astype(float)
    axes[1].imshow(truth, cmap="gray", vmin=-120, vmax=255, interpolation="nearest")
    # Blue where ground is missing, red where something was kept; up to _SMALL_ERROR it is clear.
    colours = np.where((error < 0)[..., None], to_rgba(TYPE_1), to_rgba(TYPE_2))
    colours[..., 3] = np.clip((np.abs(np.nan_to_num(error)) - _SMALL_ERROR) / _LARGE_ERROR, 0, 0.9)
    axes[1].imshow(colours, interpolation="nearest")
    axes[1].set_title(
        f"{scene.kind}: type I {score.type_1:.1f} %, II {score.type_2:.1f} %, RMSE"
        f" {score.dtm_rmse:.2f} m; red too high, blue too low",
        fontsize=9, loc="left",
    )  # fmt: skip
    _save(figure, target)


def _figure(columns: int, ratio: float):
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    # The longer side of a single map, or of two side by side the width, is what is given.
    width = _INCHES * min(1.0, 1.0 / ratio) if columns == 1 else 1.4 * _INCHES
    size = max(width, 4.5), width / columns * ratio + _MARGIN
    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(1, columns, squeeze=False)[0]
    for panel in axes:
        panel.set_axis_off()
        panel.set_aspect("equal")
    return figure, axes


def _save(figure, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    # Without the software's name: the same picture whatever version drew it.
    figure.savefig(
        target, dpi=_DOTS_PER_INCH, metadata={"Software": None}, pil_kwargs={"optimize": True}
    )
