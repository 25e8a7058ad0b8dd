"""Where the cells of rasters lie: by default, or as a given raster or extent asks."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from ..core.box_order import in_order, valid_box
from ..core.errors import BareEarthError
from ..core.points import Box, Frame, box_in_words
from ..core.progress import SILENT, Progress
from ..core.words import option
from ..crs.matching import described, is_same_map
from ..crs.stated import how_to_state
from ..crs.system import Crs, crs_of_wkt, unit_symbol
from ..grids.cell_window import CellWindow
from .content import NO_CELLS, Content, Source, read_content
from .geotiff import RasterGrid

MOST_CELLS = 4_000_000_000
# A corner of a given raster so near a multiple of the cell size, as a share of it, is one.
_ROUNDING = 1e-6
# Sides of cells, and corners, may be off by this share of a cell over the whole raster.
_OFF = 0.01


@dataclass(frozen=True)
class RasterTarget:
    """Which cells the rasters of a run get, beside their size."""

    # A raster whose grid they get: CRS, size and position of the cells, extent. It replaces the
    # cell size.
    like: Source | None = None
    # Smallest x and y, largest x and y in units of the CRS: the rasters cover this rectangle, wider
    # by up to a cell on each side, as their cells stay where they are. It replaces the extent of
    # `like`.
    extent: Box | None = None
    was_given: ClassVar[bool] = True  # whether the order of its numbers was given so

    def __post_init__(self) -> None:
        if self.extent is None:
            return
        box = valid_box(self.extent)
        if box is None:
            raise BareEarthError(
                "The extent of the rasters must be smallest x and y, then largest x and y, not"
                f" {' '.join(f'{end:.10g}' for end in self.extent)}."
            )
        object.__setattr__(self, "was_given", box == tuple(map(float, self.extent)))
        object.__setattr__(self, "extent", box)


ANYWHERE = RasterTarget()


@dataclass(frozen=True)
class CellGrid:
    """The cells of the rasters of a run."""

    metres: float  # side of a cell
    size: float  # the same in units of the CRS
    # x and y, in units of the CRS, from which columns and rows are counted: that of the frame of
    # the rasters and of their blocks; (0, 0), or less than a cell north and east of it
    origin: tuple[float, float] = (0.0, 0.0)
    anchor: tuple[float, float] = (0.0, 0.0)  # x and y of a corner of cells, as exactly as known
    anchor_column: int = 0  # of the cell northeast of the anchor
    anchor_row: int = 0
    window: CellWindow | None = None  # that the rasters cover; None for the cells with points
    wkt: str | None = None  # the CRS of the rasters, if the points state none

    def of(self, window: CellWindow, frame: Frame) -> RasterGrid:
        """Return the grid of a raster that covers a window of cells."""
        west = self.anchor[0] + (window.column - self.anchor_column) * self.size
        north = self.anchor[1] + (window.row + window.rows - self.anchor_row) * self.size
        frame = replace(frame, wkt=self.wkt or frame.wkt)
        return RasterGrid(west, north, self.size, window.columns, window.rows, frame)


def cell_grid(
    target: RasterTarget,
    usual: CellGrid,
    crs: Crs,
    box: Box | None = None,
    progress: Progress = SILENT,
) -> CellGrid:
    """Return the cells of the rasters of a run on points with an extent, as far as known, in units
    of the CRS; `usual` has their size if no raster gives it.
    """
    # An error says if the raster is unsuitable, or the rasters would hold no point or too many
    # cells.
    cells = usual
    if target.like is not None:
        content = read_content(target.like, window=NO_CELLS)
        cells = _cells_of(target.like, content, crs.horizontal_unit)
        cells = replace(cells, wkt=_wkt_of(target.like, content.wkt, crs, progress))
    if target.extent is not None:
        extent = target.extent
        if box is not None:
            extent = in_order(extent, box, target.was_given, progress)
        (x, y), (west, south, east, north) = cells.origin, extent
        inside = CellWindow.around((west - x, south - y, east - x, north - y), cells.size)
        cells = replace(cells, window=inside)
    if cells.window is not None:
        _check(cells, cells.window, box, crs)
    return cells


def no_points(box: Box, extent: Box) -> BareEarthError:
    """Return the error for rasters that would hold no points, given both extents."""
    return BareEarthError(
        f"No point lies in the rasters ({box_in_words(box)}): the points lie in"
        f" {box_in_words(extent)}. Give a raster with {option('like')}, or an"
        f" extent with {option('raster_extent')}, that meets them."
    )


def _cells_of(source: Source, content: Content, unit: float) -> CellGrid:
    """Return the cells of a raster file; refuse cells that are not square with north up."""
    (rows, columns), (west, width, tilt, north, lean, height) = content.shape, content.geotransform
    if height > 0.0 and width > 0.0 and not tilt and not lean:
        raise BareEarthError(
            f"{source} states no place on the map, or has south up. Give a raster with north up."
        )
    most = max(columns, rows)
    if max(abs(tilt), abs(lean)) * most > _OFF * abs(width):
        raise BareEarthError(
            f"The cells of {source} are rotated. Give a raster with north up, such as gdalwarp"
            " makes."
        )
    if width <= 0.0 or abs(width + height) * most > _OFF * width:
        raise BareEarthError(
            f"The cells of {source} are not square ({width:.10g} x {abs(height):.10g}). Give a"
            " raster with square cells, such as gdalwarp -tr makes."
        )
    (column, x), (top, y) = (_counted(place, width) for place in (west, north))
    return CellGrid(
        metres=width * unit,
        size=width,
        origin=(x, y),
        anchor=(west, north),
        anchor_column=column,
        anchor_row=top,
        window=CellWindow(top - rows, column, rows, columns),
    )


def _counted(place: float, size: float) -> tuple[int, float]:
    """Return a place as a number of cells, and where these are counted from."""
    number = math.floor(place / size + _ROUNDING)
    rest = place - number * size
    return number, rest if abs(rest) > _ROUNDING * size else 0.0


def _wkt_of(like: Source, wkt: str, crs: Crs, progress: Progress) -> str | None:
    """Check the CRS of a given raster; return it if the points state none."""
    stated = crs_of_wkt(wkt) if wkt else None
    if stated is None:
        progress.warning(f"{like} does not say its CRS: that of the points is used.")
        return None
    if crs == Crs():
        if stated.is_geographic or not math.isclose(stated.horizontal_unit, 1.0):
            raise BareEarthError(
                f"The points do not say their CRS, and that of {like} is not in metres"
                f" ({described(stated)}). Give the CRS of the points: {how_to_state()}."
            )
        progress.warning(f"The points are taken to be in the CRS of {like}, {stated.name}.")
        return wkt
    if not is_same_map(stated, crs):
        raise BareEarthError(
            f"{like} is in another CRS ({described(stated)}) than the points ({described(crs)})."
            " Give a raster in the CRS of the points. If they are in that of the raster, say so:"
            f" {how_to_state()}."
        )
    return None


def _check(cells: CellGrid, window: CellWindow, box: Box | None, crs: Crs) -> None:
    """Refuse rasters without points, or with too many cells."""
    grid = cells.of(window, Frame())
    if grid.columns * grid.rows > MOST_CELLS:
        raise BareEarthError(
            f"The rasters would have {grid.columns:,} x {grid.rows:,} cells of {cells.size:g}"
            f" {unit_symbol(crs.horizontal_unit)}. Choose a larger cell size, or a smaller extent."
        )
    west, south, east, north = covered = grid.box
    if box is not None and (west > box[2] or east < box[0] or south > box[3] or north < box[1]):
        raise no_points(covered, box)
