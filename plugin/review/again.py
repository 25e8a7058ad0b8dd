"""Runs the classification again with the answers as corrections, and finds the places anew."""

from __future__ import annotations

from functools import partial
from typing import Any, Callable, Mapping, Sequence

import numpy as np
from qgis.core import QgsProcessingUtils, QgsProject, QgsVectorLayer
from qgis.PyQt.QtCore import QObject, QTimer

from ...algorithms.classes.corrections import Corrections
from ...algorithms.core.errors import BareEarthError
from ...algorithms.rasters.geotiff import HeightBand, read_raster
from ...algorithms.tools.contours import corners_of
from ...algorithms.tools.review.answered import changes_of
from ...algorithms.tools.review.places import Rasters
from ..i18n import tr
from ..processing.runs import PastRun, Sources, runs_of
from ..styles.loaded import file_of
from .session import GROUND, NOT_GROUND, ReviewPlace, Session, has_places

_SEEN = 15  # cells round the largest change that its link shows
# Of a classification where no run is known.
_USUAL = "bareearth:tindensification"


class Again(QObject):
    """The runs that led to places, each in the dialog of its algorithm, now with corrections."""

    def __init__(self, session: Session, sources: Sources, done: Callable[[str], None]) -> None:
        super().__init__()
        self._runs, self._done = list(sources.runs), done
        self._is_known = bool(self._runs)
        self._runs = self._runs or [PastRun(_USUAL, {"INPUT": sources.cloud}, {})]
        self._layer, self._places = session.layer.id(), list(session.places)
        self._corrections = _with_own(self._layer, self._runs[0])
        self._before, self._dtm = _read(sources.dtm), ""
        self._made: dict[object, object] = {}  # results of now by those of before

    def start(self) -> None:
        """Open the dialog of the next run, filled in, and run it unless no run is known."""
        from qgis import processing

        run = self._runs.pop(0)
        values = {name: self._now(value) for name, value in run.parameters.items()}
        if run.can_be_corrected or run.is_review:
            values["CORRECTIONS"] = self._layer if run.is_review else self._corrections
        self._dialog = processing.createAlgorithmDialog(run.algorithm, values)
        self._dialog.algorithmFinished.connect(partial(self._ended, run))
        self._dialog.show()
        if self._is_known:
            self._dialog.runButton().click()

    def _now(self, value: object) -> object:
        """Return the new result in place of the one of the last run."""
        layer = QgsProject.instance().mapLayer(value) if isinstance(value, str) else None
        path = str(layer and file_of(layer)) if layer else value
        return self._made.get(path, value) if isinstance(path, str) else value

    def _ended(self, run: PastRun, is_done: bool, results: Mapping[str, Any]) -> None:
        """Go on with the next run, or tell what changed."""
        if not is_done:
            return
        QTimer.singleShot(0, self._dialog.close)
        self._made.update((run.results.get(name), value) for name, value in results.items())
        self._dtm = str(results.get("DTM") or self._dtm)
        if self._runs:
            QTimer.singleShot(0, self.start)
        else:
            self._done(text_of(self._before, _read(self._dtm), self._places))


def _with_own(layer: str, run: PastRun) -> str:
    """Return a layer of places; together with the user's own corrections, if runs had any."""
    from qgis import processing

    project = QgsProject.instance()
    for one in reversed(runs_of(project)):
        is_same = (one.algorithm, one.path("INPUT")) == (run.algorithm, run.path("INPUT"))
        own = one.path("CORRECTIONS") if is_same else ""
        if own and not has_places(QgsVectorLayer(own)):
            path = QgsProcessingUtils.generateTempFilename("corrections.fgb")
            both = {"LAYERS": [own, layer], "OUTPUT": "TEMPORARY_OUTPUT"}  # the answer counts
            merged = processing.run("native:mergevectorlayers", both)["OUTPUT"]
            # Places of the last round can hold the same polygons.
            once = {"INPUT": merged, "OUTPUT": path}
            return str(processing.run("native:deleteduplicategeometries", once)["OUTPUT"])
    return layer


def _read(path: str) -> HeightBand | None:
    """Return a terrain model; None if it is missing or can't be read."""
    try:
        return read_raster(path) if path else None
    except BareEarthError:
        return None


def text_of(
    before: HeightBand | None, after: HeightBand | None, places: Sequence[ReviewPlace]
) -> str:
    """Return in words what answers changed in the terrain, with links to the places."""
    if before is None or after is None:
        return tr("What changed is not known: one of the two runs has no terrain model.")
    if (before.whole, before.geotransform) != (after.whole, after.geotransform):
        return tr("What changed is not known: the new terrain model has other cells.")
    up, (cell, _) = after.frame.vertical_unit, after.cell_metres
    rasters = Rasters(after.heights, after.heights * np.float32(up), None, cell)
    corrected = [place for place in places if place.answer in (GROUND, NOT_GROUND)]
    outlines = [(place, rings) for place in corrected for rings in place.polygons]
    corrections = Corrections(
        tuple(rings for _, rings in outlines),
        (None,) * len(outlines),
        tuple(place.answer for place, _ in outlines),
    )
    total, *changes = changes_of(rasters, before.heights * np.float32(up), after, corrections)
    if not total.cells:
        return tr("The terrain has not changed.")
    most = np.nanargmax(np.abs(after.heights - before.heights))
    [(x, y)] = corners_of(np.array([np.unravel_index(most, after.whole)]), after).tolist()
    around = _SEEN * abs(after.geotransform[1])
    box = f"{x - around!r} {y - around!r} {x + around!r} {y + around!r}"
    largest = f'<a href="{box}">{total.largest:+.2f} m</a>'
    text = tr("The terrain changed on {} m², by {} m on average and {} at most.")
    lines = [text.format(f"{total.area:,.0f}", f"{total.mean:+.2f}", largest)]
    for (place, _), change in zip(outlines, changes):
        address = " ".join(map(repr, place.extent.toRectF().getCoords()))
        name = f'<a href="{address}">{tr("Place {}").format(place.rank)}</a>'
        figures = tr("{} m² by {} m, at most {} m").format(
            f"{change.area:,.0f}", f"{change.mean:+.2f}", f"{change.largest:+.2f}"
        )
        lines.append(f"{name}: {figures}" if change.cells else f"{name}: {tr('no change')}")
    return "<br>".join(lines)
