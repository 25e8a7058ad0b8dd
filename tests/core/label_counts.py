"""How many points of generated scenes become ground, square by square, as it was last agreed.

After a rule was changed on purpose, this writes them anew:

    PYTHONPATH=. tools/environment python tests/core/label_counts.py
"""

import functools
import json
from pathlib import Path

import numpy as np

from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.grids.bridge_decks import bridge_decks
from bare_earth.algorithms.grids.confidence import confidence
from benchmarks.scenes import make

AGREED = Path(__file__).with_name("label_counts.json")
_SQUARE, _SURE = 20.0, 0.8

# Kinds of land, with how many points a square metre: each has something that others have not.
SCENES = {
    "hills": 0.25, "gorge": 10.0, "sea_cliff": 3.0, "mesa": 3.0, "boulders": 3.0,
    "vineyard_terraces": 3.0, "steep_forest": 1.0, "hall_courtyard": 1.0, "complex_on_slope": 2.0,
    "plaza": 3.0, "city_blocks": 2.0, "sparse_village": 1.0, "embankment_and_cutting": 3.0,
    "bridge_over_road": 4.0, "bridge_over_railway": 10.0,
    "bridge_over_river": 2.0, "viaduct": 3.0, "ramps": 3.0, "dense_canopy": 3.0, "water_gaps": 3.0,
    "multipath": 3.0, "field_banks": 4.0, "drone_noisy": 8.0, "photogrammetry": 12.0,
}  # fmt: skip
# What else than the usual values changes the rules.
PRESETS = [("tin-densification", "lidar360"), ("slope", "whitebox"), ("grid-minimum", "paper")]
PRESETS += [(method, preset) for method in METHODS for preset in ("automatic", "steep", "city")]
BRIDGES = ("bridge_over_road", "bridge_over_railway", "bridge_over_river", "viaduct", "plaza")
UNSURE = ("gorge", "steep_forest", "sparse_village", "water_gaps")
SOME = ("sparse_village", "complex_on_slope")


@functools.lru_cache(maxsize=1)
def scene_of(kind):
    """Return one scene, small enough to be classified in a moment."""
    return make(kind, seed=11, density=SCENES[kind], size=60.0 if SCENES[kind] > 4.0 else 80.0)


@functools.lru_cache(maxsize=12)
def _ground(kind, method, preset):
    parameters = METHODS[method].parameters(preset=preset)
    return METHODS[method].classify(scene_of(kind).points, parameters)


def counts_of(kind, method, preset):
    """Return the points of each square that a method makes ground, row by row.

    Or those that lie on decks, or where the terrain is rather sure, with the ground of a method.
    """
    points, is_filter = scene_of(kind).points, preset not in ("decks", "confidence")
    found = _ground(kind, method, preset if is_filter else "automatic")
    if preset == "decks":
        found = bridge_decks(points, found)
    elif preset == "confidence":
        sure = confidence(points, found)
        found = (sure.values >= _SURE).ravel()[sure.cells.index]
    x, y = (
        np.floor((values - values.min()) / _SQUARE).astype(int) for values in (points.x, points.y)
    )
    counts = np.zeros((y.max() + 1, x.max() + 1), dtype=int)
    np.add.at(counts, (y[found], x[found]), 1)
    return counts.ravel().tolist()


def runs():
    """Yield each scene, method and preset that is counted, by names."""
    for kind in SCENES:
        for method, preset in PRESETS:
            if preset == "automatic" or kind in SOME:
                yield kind, method, preset
        if kind in BRIDGES:
            yield kind, "slope", "decks"
        if kind in UNSURE:
            yield kind, "slope", "confidence"


if __name__ == "__main__":
    lines = [
        f'"{kind} {method} {preset}": {counts_of(kind, method, preset)}'
        for kind, method, preset in runs()
    ]
    AGREED.write_text("{\n" + ",\n".join(lines) + "\n}\n", encoding="utf-8")
    print(f"{len(json.loads(AGREED.read_text(encoding='utf-8')))} runs are in {AGREED}")
