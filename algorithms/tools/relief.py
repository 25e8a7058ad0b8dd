"""Makes pictures of the relief of any elevation raster."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Iterator, Mapping, Sequence

import numpy as np

from ..core.parameters import ParameterSet, parameter, parameter_of
from ..core.progress import SILENT, Progress
from ..core.threads import available_cpus, may_use
from ..rasters.content import NO_CELLS, Source
from ..rasters.geotiff import NODATA, HeightBand, read_raster
from ..rasters.sparse import RasterPart
from ..rasters.writing import RasterCells, write_geotiff
from .declaration import RASTER, TERRAIN, FileTool, Input, Output
from .rasters.parameters import MapTerrain, TerrainModel
from .rasters.rows import RASTERS, How, RasterRow

# Cells that are worked on at a time.
_CELLS = 4_000_000
# The names of the rasters, by those of the kinds of relief.
KINDS = {
    row.relief_name or name.replace("_", "-"): name
    for name, row in RASTERS.items()
    if row.is_relief
}


@dataclass(frozen=True)
class ReliefKinds(ParameterSet):
    """The kinds of relief to make."""

    kinds: tuple[str, ...] = parameter(
        ("local-relief",),
        kind="choices",
        label="Kinds of relief",
        choices={kind: RASTERS[name].title for kind, name in KINDS.items()},
        help="What to make, a raster for each. Archaeological topography (VAT) shows the most in"
        " one picture.",
    )


@dataclass(frozen=True)
class FolderKinds(ReliefKinds):
    """The kinds of relief to make in a folder, whatever its name is."""

    kinds: tuple[str, ...] = parameter_of(
        ReliefKinds, "kinds", default=("vat", "sky-view", "local-relief")
    )


@dataclass(frozen=True)
class ReliefPictures(ParameterSet):
    """The size of the features that pictures of the relief show, their smoothing, and the light."""

    relief_radius: float = parameter_of(TerrainModel, "relief_radius", advanced=False)
    relief_smoothing: str = parameter_of(TerrainModel, "relief_smoothing")
    hillshade_light: str = parameter_of(MapTerrain, "hillshade_light")
    hillshade_azimuth: float = parameter_of(TerrainModel, "hillshade_azimuth")
    hillshade_altitude: float = parameter_of(TerrainModel, "hillshade_altitude")

    @property
    def terrain(self) -> TerrainModel:
        """Its values as parameters of rasters of the terrain."""
        return TerrainModel(**vars(self))


def draw_reliefs(
    source: Source,
    output: Mapping[str, Path],
    parameters: ReliefPictures = ReliefPictures(),
    progress: Progress = SILENT,
    write: Callable[..., None] = write_geotiff,
    no_data: float = NODATA,
) -> None:
    """Write pictures of the relief of a terrain model into new files, by the rasters."""
    raster = read_raster(source, progress=progress, window=NO_CELLS)
    for (name, path), part in zip(output.items(), progress.shares(*[1.0] * len(output))):
        row = RASTERS[name]
        nodata = row.nodata(no_data)
        how = How(raster.cell_metres, parameters.terrain)
        parts = _parts(raster, row, how, nodata, part)
        made = raster.stored.cells_of(_CELLS, row.margin(how))
        cells = RasterCells(raster.whole, row.kind, parts, row.bands, made)
        with may_use(available_cpus()):
            write(path, cells, raster, nodata, part, row.shows)
    raster.report(progress)


def files_of(output: Path, sets: Sequence[ParameterSet]) -> dict[str, Path]:
    """Return the rasters to make: one file, or several in a folder, such as vat.tif."""
    kinds = ReliefKinds.among(sets)
    is_file = len(kinds.kinds) == 1 and output.suffix and not output.is_dir()
    if is_file and not isinstance(kinds, FolderKinds):
        return {KINDS[kinds.kinds[0]]: output}
    return {KINDS[kind]: output / f"{kind}.tif" for kind in kinds.kinds}


def _parts(
    raster: HeightBand, row: RasterRow, how: How, nodata: float, progress: Progress
) -> Iterator[RasterPart]:
    """Yield the relief of a raster, some rows at a time, where it has data near."""
    unit, reach, count = raster.frame.vertical_unit, row.margin(how), raster.whole[0]
    stored = raster.stored
    for start, end in stored.strips(_CELLS):
        for first, last in stored.runs(start, end, reach):
            south, west = max(start - reach, 0), max(first - reach, 0)
            heights = raster.rows(south, end + reach, west, last + reach)
            metres = heights.astype(np.float64) * unit
            relief = row.rows(metres, how=how, unit=unit, nodata=nodata)
            rows, columns = slice(start - south, end - south), slice(first - west, last - west)
            yield RasterPart(start, first, relief[..., rows, columns])
        progress(0.05 + 0.85 * end / count)


TOOL = FileTool(
    work=draw_reliefs,
    sets=(ReliefKinds, ReliefPictures),
    dialog_sets=(FolderKinds, ReliefPictures),
    inputs=(
        Input(
            "source",
            "raster",
            help="A raster file with a band of heights.",
            label="Terrain model",
            named="INPUT",
        ),
    ),
    outputs=(
        Output(
            "output",
            "folder",
            help="The folder for the rasters (GeoTIFF), which are named after what they show, such"
            " as vat.tif and sky-view.tif; or the file (.tif) of a single one.",
            label="Folder of the rasters",
            named="OUTPUT_FOLDER",
            is_main=True,
            files=files_of,
            layers={name: RASTERS[name].title for name in KINDS.values()},
        ),
    ),
    flags={"kinds": "kind"},
    json=None,
    command="relief",
    identifier="relief",
    title="Relief of a terrain model",
    about="The pictures of the relief of any elevation raster, on the same grid, are sky-view"
    " factor, openness, local dominance, local relief, slope, hillshade, archaeological topography"
    " (VAT) and red relief. They show small features that a hillshade of one light hides.\n"
    "For walls and banks make the terrain model in cells of 0.25 to 0.5 m.",
    page="relief",
    run_name="relief",
    words=(
        TERRAIN,
        RASTER,
        "sky-view factor,svf,openness,local dominance,local relief model,lrm,vat,red relief,"
        "rrim,slope,archaeology,rvt,relief visualization toolbox,visualization",
    ),
)
