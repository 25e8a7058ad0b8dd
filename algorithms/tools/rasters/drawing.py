"""What rasters are drawn of points, and where their cells lie."""

from __future__ import annotations

from dataclasses import dataclass, field

from ...rasters.cell_grid import ANYWHERE, CellGrid, RasterTarget
from ...survey.area import Area
from .block import RasterStep
from .fixed_terrain import FixedTerrain
from .parameters import SurfaceModel, TerrainModel
from .rows import RasterFiles


@dataclass(frozen=True)
class Drawing:
    """The rasters to make, and all that their cells depend on beside the points."""

    files: RasterFiles = field(default_factory=RasterFiles)
    model: TerrainModel = field(default_factory=TerrainModel)
    surface: SurfaceModel = field(default_factory=SurfaceModel)
    per_file: bool = False  # each of many files gets its own rasters
    fixed: FixedTerrain | None = None  # the vertices of the constraints, once they are found
    target: RasterTarget = ANYWHERE  # a grid or an extent that the rasters must have
    placed_cells: CellGrid | None = None  # where the cells lie, once the CRS is known
    area: Area | None = None  # without values outside, where points still take part

    @property
    def cells(self) -> CellGrid:
        """Where the cells lie; before that is known, as in metres."""
        return self.placed_cells or self.model.cells(1.0)

    @property
    def cell(self) -> float:
        """Side of a cell in metres."""
        return self.cells.metres

    @property
    def of_block(self) -> RasterStep:
        """Makes the rasters of a single block."""
        return RasterStep(self.cell, self.files.layers, self.surface.max_edge)
