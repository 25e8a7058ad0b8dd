"""Makes pictures of the relief of any elevation raster."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Iterable, Iterator

import numpy as np

from ..core.errors import BareEarthError
from ..core.files import Outputs, new_folder
from ..core.parameters import ParameterSet, parameter, parameter_of
from ..core.progress import SILENT, Progress
from ..core.threads import available_cpus, may_use
from ..rasters.geotiff import NO_CELLS, NODATA, Raster, read_raster
from ..rasters.writing import Rows, check_raster_output, raster_file, write_geotiff
from .rasters.parameters import MapTerrain, TerrainModel
from .rasters.rows import RASTERS, How
from .rasters.rows import Raster as Row

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
        ("vat", "sky-view", "local-relief"),
        kind="choices",
        label="Kinds of relief",
        choices={kind: RASTERS[name].title for kind, name in KINDS.items()},
        help="What to make, a raster for each. Archaeological topography (VAT) shows the most in"
        " one picture.",
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
        """The same as parameters of rasters of the terrain."""
        return TerrainModel(**{each.name: getattr(self, each.name) for each in self.declarations()})


def write_relief(
    source: str | Path,
    target: Path,
    kind: str = "local-relief",
    parameters: ReliefPictures = ReliefPictures(),
    progress: Progress = SILENT,
    nodata: float = NODATA,
) -> None:
    """Write a picture of the relief of a terrain model, which need not fit into memory.

    Parameters
    ----------
    source, target : Path
        The terrain model, and the GeoTIFF to make.
    kind : str
        "local-relief", "multi-scale-relief", "slope" (degrees), "sky-view", "openness" and
        "negative-openness" (degrees), "local-dominance", "vat" (1 to 255), "red-relief" (three
        bands, 1 to 255) or "hillshade" (1 to 255).
    parameters : ReliefPictures
        The size of the features, and the light.
    progress : Progress
        Receives progress and messages.
    nodata : float
        The value of cells without data; 0 where cells are bytes.

    Raises
    ------
    BareEarthError
        If there is no such kind, the raster cannot be read, or the output cannot be written.
    """
    if kind not in KINDS:
        raise BareEarthError(
            f"There is no kind of relief '{kind}'. Choose one of {', '.join(KINDS)}."
        )
    check_raster_output(target, (Path(source),))
    row = RASTERS[KINDS[kind]]
    raster, nodata = read_raster(source, progress=progress, window=NO_CELLS), row.nodata(nodata)
    strips = _strips(source, raster, row, parameters.terrain, nodata, progress)
    rows = Rows(raster.whole, row.kind, strips, row.bands)
    with may_use(available_cpus()):
        write_geotiff(target, rows, raster, nodata, progress, row.shows)
    progress(1.0)


def write_reliefs(
    source: str | Path,
    folder: Path,
    kinds: Iterable[str],
    parameters: ReliefPictures = ReliefPictures(),
    progress: Progress = SILENT,
) -> dict[str, Path]:
    """Write pictures of the relief of a terrain model, of kinds as in `write_relief`, into a folder
    that need not exist, all or none, and return their files, such as vat.tif.
    """
    targets = {kind: Path(folder) / f"{kind}.tif" for kind in kinds}
    shares = progress.shares(*[1.0] * len(targets))
    with Outputs() as outputs:
        outputs.enter_context(new_folder(Path(folder)))
        for target in targets.values():
            check_raster_output(target, (Path(source),))
        for (kind, target), part in zip(targets.items(), shares):
            temporary = raster_file(outputs, target)
            write_relief(source, temporary, kind, parameters, part)
    return targets


def _strips(
    source: str | Path,
    raster: Raster,
    row: Row,
    model: TerrainModel,
    nodata: float,
    progress: Progress,
) -> Iterator[np.ndarray]:
    """Yield the relief of a raster, some rows at a time."""
    (count, columns), how = raster.whole, How(raster.cell_metres, model)
    unit, reach = raster.frame.vertical_unit, row.margin(how)
    rows = max(_CELLS // columns, 1)
    for start in range(0, count, rows):
        first, last = max(start - reach, 0), min(start + rows + reach, count)
        heights = read_raster(source, window=(0, first, columns, last - first)).heights
        metres = heights.astype(np.float64) * unit
        made = row.rows(metres, how=how, unit=unit, nodata=nodata)
        yield made[..., start - first : start - first + rows, :]
        progress(0.05 + 0.85 * min(start + rows, count) / count)
