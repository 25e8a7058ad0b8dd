"""Writes which rule of a filter decided each of its cells, as a raster.

`python -m benchmarks.deciding_rules tile.laz rules.tif` takes a file as a run does: last and single
returns, all classes. A cell has the number of the rule, and 100 more if it is not ground; the
description of the band names the rules. The command prints how many cells each of them decided.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Sequence

import numpy as np

from bare_earth.algorithms.classes.point_counts import PointCounts
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.core.errors import BareEarthError
from bare_earth.algorithms.core.points import Points
from bare_earth.algorithms.core.progress import SILENT
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.method import NOT_GROUND
from bare_earth.algorithms.grids.cells import cells_at
from bare_earth.algorithms.las.cloud import PointCloud, survey_frame
from bare_earth.algorithms.rasters.geotiff import RasterGrid
from bare_earth.algorithms.rasters.scattered import ScatteredCells, write_scattered

from . import data
from .accuracy import method_name


def deciding_rules(
    cloud: PointCloud, target: Path, method: str, preset: str = "automatic"
) -> dict[str, int]:
    """Write the raster of a cloud; return how many cells each rule decided, those that are not
    ground under ``not-`` and the name.
    """
    chosen = METHODS[method]
    part = np.flatnonzero(Selection().choose(cloud, PointCounts()))
    frame = survey_frame(cloud.crs)
    points, several = cloud.points(part, frame), cloud.number_of_returns[part] > 1
    decided = chosen.ground(
        points, chosen.parameters(preset=preset), multi_return=several, explains=True
    ).decided
    if decided is None or not decided.codes.any():
        raise BareEarthError(f"The preset {preset} decides points, not cells. Choose another one.")
    row, column = cells_at(points.x, points.y, decided.size)
    (row, column), first = np.unique(np.stack((row, column)), axis=1, return_index=True)
    codes, size = decided.codes[first], decided.size
    middles = Points((column + 0.5) * size, (row + 0.5) * size, np.zeros(len(codes)))
    names = ", ".join(f"{number} {name}" for number, name in enumerate(decided.rules, start=1))
    write_scattered(
        target,
        ScatteredCells(row.max() - row, column - column.min(), codes),
        RasterGrid.over(middles, frame, size),
        0.0,
        SILENT,
        f"rule that decided (+{NOT_GROUND}: not ground): {names}",
    )
    found = zip(*np.unique(codes, return_counts=True))
    return {name_of(int(code), decided.rules): int(count) for code, count in found}


def name_of(code: int, rules: Sequence[str]) -> str:
    """Return the name of the rule with a code."""
    number = code % NOT_GROUND
    name = rules[number - 1] if number else "none"
    return name if code < NOT_GROUND else f"not-{name}"


def main(arguments: Sequence[str] | None = None) -> None:
    """Write the raster that the command line asks for."""
    parser = argparse.ArgumentParser(
        prog="python -m benchmarks.deciding_rules",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("cloud", type=Path, help="a LAS or LAZ file")
    parser.add_argument("target", type=Path, help="the raster, a .tif")
    parser.add_argument("--method", type=method_name, default="tin-densification", help="of ours")
    parser.add_argument("--preset", default="automatic")
    chosen = parser.parse_args(arguments)
    cloud, _ = data.load(chosen.cloud)
    for name, count in deciding_rules(cloud, chosen.target, chosen.method, chosen.preset).items():
        print(f"{name:30} {count:>10,}")


if __name__ == "__main__":
    main()
