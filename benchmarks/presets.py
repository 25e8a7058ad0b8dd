"""Measures the presets, each where it is meant, against automatic: `python -m benchmarks.presets`.

Prints total error and kappa in percent on labelled data, and the root mean square error in metres
of the terrain model where the ground of the reference is thinned.
"""

from __future__ import annotations

import argparse
from typing import Iterator, NamedTuple, Sequence

from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tools.assess import AssessmentOptions, compare

from . import data, measure

AUTOMATIC = "automatic"
# What each preset is meant for, by what is seen in the data.
MEANT_FOR = {
    "flat": ("nrw_rural", "samp21"),
    "hilly": ("forest_topography", "mixed_conifer", "oregon_conifer"),
    "steep": ("samp11", "samp24", "samp52", "samp61"),
    "town": ("samp21", "samp31", "ahn3_urban", "ign_sparse_urban"),
    "city": ("samp31", "samp42", "samp54", "ahn3_urban"),
}


class Row(NamedTuple):
    """One preset on one piece of land, with what automatic gives there."""

    preset: str
    where: str
    figures: tuple[str, ...]

    def text(self) -> str:
        """Return the row of the table."""
        return f"| `{self.preset}` | {self.where} | {' | '.join(self.figures)} |"


class Land:
    """Labelled data by its title, without a file if they are not here."""

    def __init__(self, name: str) -> None:
        tile = next((real for real in data.REAL if real.title == name), None)
        path = data.real(tile.name) if tile else data.find(f"isprs/{name}.laz")
        self.is_here = path.exists()
        if self.is_here:
            self._cloud, self._reference = data.load(path)
            self._options = AssessmentOptions(ignored_classes=tile.left_out if tile else ())
            thinned = tile is not None and not tile.is_trusted
            self._model = measure.ReferenceModel(self._cloud, self._reference) if thinned else None

    def figures(self, method: str, preset: str) -> tuple[str, str]:
        """Return total error and kappa, or the error of the terrain model and nothing."""
        ground = measure.Filter(method, preset=preset).ground(self._cloud)
        if self._model is not None:
            return f"{self._model.error(ground).rmse:.2f} m", ""
        found = compare(ground, self._reference, self._options)
        return f"{found.total_error:.1f}", f"{found.kappa:.1f}"


def rows(method: str, presets: Sequence[str], names: Sequence[str] = ()) -> Iterator[Row]:
    """Yield the figures of each preset where it is meant, or on the named data."""
    wanted = {preset: names or MEANT_FOR[preset] for preset in presets}
    for where in dict.fromkeys(name for lands in wanted.values() for name in lands):
        land = Land(where)
        if land.is_here:
            base = land.figures(method, AUTOMATIC)
            for preset, lands in wanted.items():
                if where in lands:
                    yield Row(preset, where, (*land.figures(method, preset), *base))


def main(arguments: Sequence[str] | None = None) -> None:
    """Print the table of each method."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.presets", description=__doc__)
    parser.add_argument("--method", nargs="+", choices=list(METHODS), default=list(METHODS))
    parser.add_argument("--data", nargs="+", default=(), help="every preset on these instead")
    options = parser.parse_args(arguments)
    for method in options.method:
        presets = next(
            declaration.choices
            for declaration in METHODS[method].parameters.declarations()
            if declaration.name == "preset"
        )
        print(f"\n{method}\n")
        print("| Preset | Measured on | Total error | Kappa | Automatic: total error | Kappa |")
        print("|---|---|---|---|---|---|")
        wanted = [preset for preset in presets if preset in MEANT_FOR or options.data]
        found = rows(method, [preset for preset in wanted if preset != AUTOMATIC], options.data)
        for row in sorted(found, key=lambda row: wanted.index(row.preset)):
            print(row.text(), flush=True)


if __name__ == "__main__":
    main()
