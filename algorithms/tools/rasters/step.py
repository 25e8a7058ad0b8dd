"""The step that makes rasters."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Mapping, Sequence

import numpy as np

from ...classes.ground_classes import ROADS_FLAG, GroundClasses, GroundCounts
from ...classes.kept_classes import BOTTOM, NOISE, SUBMERGED, WATER_SURFACES
from ...classes.point_counts import count_classes
from ...core.errors import BareEarthError
from ...core.files import Outputs, split_name
from ...core.points import Frame
from ...core.progress import SILENT, Progress
from ...core.words import counted
from ...crs.measurable import require_measurable
from ...engine.blocks import Blocks, Visit
from ...engine.memory import Cost
from ...engine.step import ReadPoints, Sink
from ...engine.store import OTHERS, Marks
from ...grids.cell_window import CellWindow
from ...grids.cells import first_of_each
from ...las.cloud import PointCloud, survey_frame
from ...las.lasfile import FIRST_EXTENDED_FORMAT, LasFile
from ...rasters.cell_grid import cell_grid
from ...rasters.libraries import library_name
from ...survey.shapes import Place
from ...tin.dense_surface import VERTICES_A_SIDE
from ...tin.height_above_ground import with_roads
from .block import LAYERS, BlockRasters
from .block_view import BlockView
from .constraints import NO_CONSTRAINTS, Constraints
from .fixed_terrain import fixed_terrain
from .output import RasterJob, RasterSize, write_rasters

# Points are thinned to one a cell unless there are more than ten cells a point: then hardly two
# points would share a cell.
_MOST_THINNED = 10
# Bytes that a block takes for each point in it and its buffer, and for each cell.
_BYTES_A_POINT = 130.0
_BYTES_A_CELL = 120.0
# By how much the classes of topo-bathymetric lidar (40 to 45) are lower in files of NOAA that have
# a point format of 0 to 5.
_NOAA = 14


@dataclass
class RasterCounts(GroundCounts):
    """Counts of points so far, beside those of `GroundCounts`."""

    top: int = 0  # points of the surface
    excluded: int = 0  # ground points that the constraints exclude
    # int64 (256,), points of classes of water that make no surface.
    wet: np.ndarray = field(default_factory=lambda: np.zeros(256, dtype=np.int64))


def _old(part: PointCloud, classes: Sequence[int]) -> list[int]:
    """Return the classes that NOAA writes for those of water in point formats 0 to 5."""
    is_extended = part.point_format >= FIRST_EXTENDED_FORMAT
    return [] if is_extended else [value - _NOAA for value in classes]


@dataclass(frozen=True)
class MakeRasters(RasterJob, Sink):
    """Makes rasters from classified points."""

    ground: GroundClasses = field(default_factory=GroundClasses)
    roads: tuple[int, ...] = ()  # classes that are ground as well, where they lie on it
    covers_ground: bool = False  # not all points without noise
    constraints: Constraints = NO_CONSTRAINTS  # breaklines, water, and areas without ground

    counts = RasterCounts
    imports = "scipy.ndimage", "scipy.spatial", *library_name()

    @property
    def weight(self) -> float:
        """Share of the progress, which grows with the number of rasters."""
        return 3.0 + len(self.files.wanted)

    @property
    def outputs(self) -> list[tuple[str, Path]]:
        """The kinds and paths of the rasters."""
        return self.files.outputs(self.per_file)

    @property
    def needs_ground(self) -> bool:
        """Whether any of the rasters needs ground."""
        return any(LAYERS[name].of_ground for name in self.files.layers)

    @property
    def needs_all(self) -> bool:
        """Whether any of the rasters needs points that are not ground."""
        return any(LAYERS[name].of_all for name in self.files.layers)

    @property
    def needs_surface(self) -> bool:
        """Whether any of the rasters needs the surface."""
        return not {"surface", "canopy"}.isdisjoint(self.files.layers)

    def in_crs(self, place: Place, progress: Progress = SILENT) -> MakeRasters:
        """Return the step for points at a place; see `cell_grid`."""
        require_measurable(*place)
        usual = self.model.cells(place.crs.horizontal_unit)
        cells = cell_grid(self.target, usual, place.crs, place.box, progress)
        return replace(self, placed_cells=cells)

    def with_all_points(
        self, read: ReadPoints, frame: Frame, progress: Progress = SILENT
    ) -> MakeRasters:
        """Return the step with the vertices of its constraints; see `fixed_terrain`."""
        if not self.constraints.any:
            return self
        cell = self.cell / VERTICES_A_SIDE
        fixed = fixed_terrain(self.constraints, read(), frame, self.ground, cell, progress)
        return replace(self, fixed=fixed)

    @property
    def blocks(self) -> Blocks:
        """The blocks in which the rasters are made, from the origin of the cells."""
        cost = Cost(_BYTES_A_POINT, _BYTES_A_CELL / self.cell**2)
        return Blocks.of(self.of_block.reach, cost, self.cells.origin)

    def marks(self, part: PointCloud, counts: RasterCounts) -> Marks:
        """Return which points the rasters cover, which are ground, and which are of the surface."""
        nothing = np.zeros(part.count, dtype=bool)
        ground = self.ground.of(part, counts)
        if not self.needs_ground:
            ground = nothing
        roads = self.ground.roads_of(part, self.roads if self.needs_ground else ())
        if self.constraints.any:
            stays = self.constraints.is_ground(part, ground)
            counts.excluded += int(np.count_nonzero(ground & ~stays))
            ground, roads = stays, self.constraints.is_ground(part, roads)
        if self.covers_ground:
            return Marks(ground | roads, ground, nothing, {ROADS_FLAG: roads})
        shown = ground | (~np.isin(part.classification, NOISE) & self.ground.used(part))
        if not self.needs_all:
            # The others only show where the survey is.
            shown = ground | roads | self._thinned(part, shown & ~ground & ~roads)
        top = shown & self.needs_surface & self._is_surface(part, ground, counts)
        counts.top += int(np.count_nonzero(top))
        return Marks(shown, ground, top, {ROADS_FLAG: roads})

    def _is_surface(self, part: PointCloud, ground: np.ndarray, counts: RasterCounts) -> np.ndarray:
        """Return which points are of the classes and returns of the surface."""
        if self.surface.surface_classes:
            surface = np.isin(part.classification, self.surface.surface_classes)
        else:
            surface = ~np.isin(part.classification, self._left_out(part))
            counts.wet += count_classes(part.classification[~surface])
        if self.surface.surface_returns == "first":
            # The first returns of pulses that reach the bottom of a water are of the water.
            bottom = ground & np.isin(part.classification, (BOTTOM, *_old(part, (BOTTOM,))))
            surface &= (part.return_number <= 1) | bottom
        return surface

    def _left_out(self, part: PointCloud) -> list[int]:
        """Return the classes that make no surface, unless the user names them."""
        # If the bottom is terrain, the water above it is no canopy.
        wet, classes = (*WATER_SURFACES, *SUBMERGED), self.ground.ground_classes
        is_old = not {*_old(part, (BOTTOM,))}.isdisjoint(classes)
        return [*(wet if BOTTOM in classes else SUBMERGED), *(_old(part, wet) if is_old else ())]

    def _thinned(self, part: PointCloud, shown: np.ndarray) -> np.ndarray:
        """Return one point of each cell that is shown."""
        indices = np.flatnonzero(shown)
        if len(indices):
            x, y = part.places(indices, survey_frame(part.crs, self.cells.origin))
            cells = CellWindow.around((x.min(), y.min(), x.max(), y.max()), self.of_block.cell)
            cells = cells.wider(1)
            row, column = cells.places(x, y, (0.0, 0.0), self.of_block.cell)
            if cells.rows * cells.columns > _MOST_THINNED * len(indices):
                return shown
            indices = indices[
                first_of_each(row * cells.columns + column, cells.rows * cells.columns)
            ]
        kept = np.zeros_like(shown)
        kept[indices] = True
        return kept

    def report_counts(self, counts: RasterCounts, path: Path, progress: Progress) -> None:
        """Refuse a file without points for the rasters."""
        if self.needs_ground:
            self.ground.check(counts, path)
            if counts.ground == counts.excluded:
                raise BareEarthError(
                    f"All ground points of {path} lie in polygons of water or without ground."
                    " Check the polygons."
                )
        if self.needs_surface and not counts.top:
            if self.surface.surface_classes:
                raise BareEarthError(
                    f"{path} has no points to make a surface of. Choose other classes for the"
                    " surface, or take all returns."
                )
            raise BareEarthError(
                f"{path} has no first returns to make a surface of. Take all returns instead."
            )
        if self.needs_surface and counts.wet.any():
            words = "point on or in water is", "points on or in water are"
            classes = ", ".join(map(str, np.flatnonzero(counts.wet)))
            progress.info(
                f"{counted(int(counts.wet.sum()), *words)} left out of the surface model (classes"
                f" {classes})."
            )

    def in_block(self, visit: Visit, progress: Progress) -> dict[str, Any]:
        """Return the arrays of `BlockRasters`."""
        block, corner = visit.block, visit.corner
        # The ground that other steps see is the same, unless constraints change it.
        is_same = self.needs_ground and not self.constraints.any
        thinned = visit.findings.get((self.ground, self.roads)) if is_same else None
        lacks_ground = thinned is not None and not self.needs_all
        contents = visit.contents(progress.part(0.0, 0.1), OTHERS if lacks_ground else None)
        points, roads, ground = contents.points, contents.flags[ROADS_FLAG], contents.known
        core = np.ones(points.count, bool) if visit.is_only else block.holds(points, corner)
        if not lacks_ground:
            ground = with_roads(points, ground, roads, progress.part(0.1, 0.2))
        known = None if thinned is None else (thinned, block.holds(thinned.points, corner))
        view = BlockView(points, ground, contents.wanted, core, corner, None, known, lacks_ground)
        if self.fixed is not None and points.count:
            view = self.fixed.added_to(view)
        return self.of_block.of(view, block.box, progress.part(0.2, 1.0)).arrays

    def finish(
        self,
        results: Sequence[Mapping[str, Any]],
        frame: Frame,
        outputs: Outputs,
        progress: Progress,
        tiles: Sequence[LasFile] | None = None,
    ) -> RasterSize:
        """Write the rasters, those of each file if the user asks for it."""
        files = None
        if self.per_file and tiles is not None:
            files = {split_name(tile.path)[0]: tile.box for tile in tiles}
        blocks = [BlockRasters.of(arrays) for arrays in results]
        return write_rasters(blocks, frame, self, outputs, progress, files)
