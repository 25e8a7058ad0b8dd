"""Plain things: small scenes with one thing on a piece of land, whose truth is known by point.

`KINDS` is the matrix. A kind has rows such as ``5x1.5/20/8``, which are the sizes of a thing in
metres (the arguments of its shape), the slope of the land in percent, and points per square metre.
Each row is made at two places of the grid. At "a" the thing lies along the grid on smooth land,
below points scattered at random from straight above. At "b" it is turned, on rough land, and a
scanner sees its walls from two sides.
"""

from __future__ import annotations

from typing import Callable, NamedTuple

import numpy as np

from . import plain_shapes as shapes
from .plain_things import (
    Plain,
    afloat,
    by_house,
    cut_off,
    earth,
    layers,
    leafy,
    loose,
    numbered,
    outliers,
    plants,
    solid,
    terraced,
    understory,
    whole,
    wooded,
)

PLACES = "a", "b"


class Kind(NamedTuple):
    """Things of a kind, and what may be wrong with them."""

    name: str
    make: Callable[[Row], Plain]
    shape: Callable[..., np.ndarray] | None
    rows: tuple[str, ...]
    stays: bool
    wrong: float  # percent of the points of a thing
    off: float  # metres between the terrain models; a tenth of the height of earth is added


class Row(NamedTuple):
    """One scene of the matrix."""

    kind: Kind
    text: str
    place: str

    @property
    def name(self) -> str:
        """What it is, as the command prints it."""
        sizes, slope, density = self.text.split("/")
        return f"{self.kind.name}-{sizes}-slope{slope}-{density}pm2-{self.place}"

    @property
    def sizes(self) -> tuple[float, ...]:
        """The arguments of the shape."""
        return tuple(map(float, self.text.split("/")[0].split("x")))

    def make(self) -> Plain:
        """Return the scene."""
        return self.kind.make(self)


_STAYS, _GOES = True, False
# How it is made, whether it stays, what may be wrong; then kinds with their rows, one on a line. A
# kind whose shape has another name gives it: "barges=boxes".
_MATRIX: tuple[tuple[Callable[[Row], Plain], bool, float, float, str], ...] = (
    (earth, _STAYS, 5.0, 0.15, """
bowl 3x0.5/0/8 4x1/0/8 5x1.5/0/4 5x1.5/20/8 6x2.5/10/8 8x3/0/4 10x4/30/4 10x2/0/2
crater 4x1/0/20 5x1.5/0/8 6x2/20/8 8x3/0/4 10x4/10/2
funnel 4x2/0/8 6x3/0/4 8x6/10/8 10x5/0/2
pit 3x2/0/20 4x3/0/8 6x4/10/8 8x6/0/8 10x5/20/4
cellar 5x2x8/0/8 8x3x12/5/4 10x4x10/0/2
ramp 2.5x2/0/8 3x3/0/8 4.4x3.5/0/8 6x4/10/4
trench 2.5x1.5/0/8 3x3.5/0/8 4x3/10/8 6x4/0/4
ditch 3x1/0/4 5x2/5/2 8x3/0/1
hollow-way 4x1.5/10/8 6x3/20/4
cutting 6x4/5/4 10x8/0/2
crest 10x4/0/4 15x3/10/2 20x8/20/2 30x12/0/1 40x7/5/1
crag 8x4/10/8 14x6/30/4
rock 8x2/0/8 15x5/20/4 25x8/10/2
dyke 2x1.5/0/4 3x3/0/2 5x6/5/4
embankment 8x3/0/2 12x6/5/1
levee 4x3/0/1 6x6/2/2
bank 3x0.6/10/8 5x1.2/20/4
terraces 10x1.5/10/4 8x2.5/20/8 15x1/5/2
scarp 2x4/0/4 6x12/10/2 0.5x3/5/8
plateau 40x2x12/0/4 60x3.5x20/0/2
benches 8x5/0/4 10x8/5/2
ruin 15x0.8/5/8 25x1.2/0/4
mound 12x1.5/0/4 25x4/0/1 15x3/15/2
heap 15x4/0/4 30x9/0/2
table 50x20x8/0/4 50x20x12/5/2
butte 40x8/0/4 60x13/10/2 75x13/0/4 90x20/5/1
bund 0.6x1.5/0/8 0.5x0.8/0/8 0.6x1/10/20 1x1.2/5/4
"""),
    (whole, _STAYS, 5.0, 0.3, """
approach 8x4/0/8 14x6/0/2 10x5/3/4 14x4/0/8
bend 9x4/0/8 12x6/3/4
"""),
    (cut_off, _STAYS, 5.0, 0.3, """
moat 32x7x3/0/8 24x5x2/10/4 50x6x2.5/0/2
channels 26x4x2.5/0/8 15x4x1.5/5/4 40x6x3/0/2
fissures 10x1x3/0/16 14x1.5x2/5/8
"""),
    (wooded, _STAYS, 5.0, 0.2, """
bowl-under-trees=bowl 5x1.5/0/8 8x2/20/8 6x2/0/20 10x4/10/4
pit-under-trees=pit 6x3/0/20 8x4/10/8 24x8/0/8
ditch-under-trees=ditch 4x1.5/5/8
hollow-way-under-trees=hollow_way 5x2/20/8
mound-under-trees=mound 15x2/0/8
ruin-under-trees=ruin 20x1/10/20
"""),
    (by_house, _STAYS, 5.0, 0.15, """
terrace-by-house=scarp 0.3x1.5/0/8 0.3x2.5/5/4 0.3x3.5/0/8
bank-by-house=scarp 4x3/0/4
terraces-by-house=terraces 12x1.5/10/8
court-by-house=plateau 24x1.5x8/0/8 30x3x20/3/4
"""),
    (solid, _GOES, 2.0, 0.3, """
flat-roof=flat 10x8x3/0/8 20x12x4/5/4 40x25x3/0/2 30x15x3/10/20
hall=flat 60x40x3.2/0/2 60x60x3/2/8 80x50x3.2/0/2 80x60x4/5/4 100x60x3.2/0/4 100x60x4/5/2\
 100x70x3.2/0/2 125x60x3.2/0/2 125x78x2.5/0/2 125x78x4/0/2 125x78x5/2/1.5 120x80x9/5/2\
 120x80x8/10/2 60x40x6/15/4 150x80x6/0/1 150x100x10/3/2 200x100x9/0/1.5
low-gable 60x30x3/0/2 100x50x3/2/2 120x60x4/5/2
gable-roof=gable 10x8x3/0/8 16x10x3/10/4 40x15x3/5/2 80x20x4/0/2 12x9x4/15/1
lean-to 30x20x3/0/4 80x40x3/2/2
court-roof=court 40x40x6/0/4 70x60x4/0/2 90x70x8/5/2
angled 60x50x3/0/4 120x90x5/3/1.5
stepped 100x50x4/0/2 60x30x3/5/4
aisled 60x45x4x3/0/4 70x50x4x5/2/4 110x70x5x3/3/2 110x70x5x5/3/2
drum 12x6/0/4 30x10/3/2
hemisphere 40/0/8 24/5/4 60/3/2
arch=vaults 60x30x12x0x1/0/8 80x40x16x0x1/2/4
blocks=boxes 30x20x6x5x2/0/4 40x25x9x8x2/5/2 25x15x5x3x3/0/8
grandstand=lean_to 14x50x2.2/0/4 40x20x2.5/3/8
"""),
    (terraced, _GOES, 5.0, 0.3, """
terraced-halls 90x60x6x12x3x3/0/2 60x40x5x16x3x2/2/4
"""),
    (afloat, _GOES, 2.0, 0.3, """
ship 120x14x4/0/4 60x10x3/0/2
"""),
    (solid, _GOES, 5.0, 0.3, """
a-frame 16x10x8/0/8 12x8x7/5/4 20x12x8/0/2 10x6x5/10/8
"""),
    (loose, _GOES, 5.0, 0.3, """
polytunnels=vaults 40x8x3.2x1x4/0/8 70x8x3.2x1x4/0/7 60x8x3.5x1x8/3/4\
 50x6x2.5x1x5/0/8 60x9x4x1.5x3/5/2
glasshouses 60x6x4x0x8/0/4 60x8x4.5x1x5/2/8 40x10x3x3x4/0/2
panels 40x4x0.8x0.4x4x6/0/8 50x4x2x0x1.5x6/5/4 60x2.2x0.6x0.2x2x10/10/8
solar-park=panels 76x3.6x0.7x0.36x3.4x8/0/15 40x3x0.5x0.36x3.5x6/5/8 60x4x0.8x0.36x4x7/10/4
stacks=boxes 10x8x1.2x4x2/0/8 10x8x2.4x5x2/3/4
barges=boxes 50x9x2.5x2x3/0/2 40x8x3x1x4/0/2
containers=boxes 12.2x2.5x2.6x1x4/0/8 6x2.5x2.6x0.5x6/2/4
sheds=boxes 3x3x2.4x6x4/5/4
cushions 4x1.8x8/0/20 5x2x6/15/30 3x1.2x10/5/12
cars=boxes 4.5x1.8x1.5x1x6/0/8 4.5x1.8x1.5x1.5x5/5/4
lorries=boxes 14x2.5x3.6x1.5x4/0/4
wood-stacks=boxes 12x1.5x2.2x3x3/5/8
bales=boxes 1.5x1.5x1.4x4x5/3/8
walls=boxes 25x0.5x2x10x2/0/12 30x0.6x1.5x10x2/5/8
"""),
    (leafy, _GOES, 5.0, 0.3, """
hedges=boxes 40x1.5x1.8x15x2/0/8 40x2.5x2.5x15x2/10/4
bushes=domes 2.5x1.5x3x6/0/8 4x3x4x5/10/4
shrubs=domes 2x1.3x2x8/35/6 2x1.5x3x6/25/12
low-hedges=boxes 40x1.5x1x15x2/0/20 40x2x1.5x15x2/0/8
thicket=flat 30x15x2/0/8
"""),
    (plants, _GOES, 5.0, 0.15, """
grass= 0.3x40/0/20 0.5x60/5/8 0.8x60/0/20 1x70/0/10 1.2x80/0/50 0.6x50/0/400 0.8x30/0/5
crop-rows 0.6x50x0.75/0/30 1.2x60x1.5/3/100
"""),
    (understory, _GOES, 5.0, 0.15, """
understory= 1x70/0/10 0.7x50/5/20
"""),
    (numbered, _GOES, 5.0, 0.15, """
numbered-grass= 0.5x60/5/8 0.8x80/0/20 1.2x70/0/10 0.4x50/0/100
"""),
    (outliers, _GOES, 5.0, 0.15, """
low-clumps= 0.5x2x8/0/4 1x5x15/0/8 2x10x30/0/8 0.3x1x5/0/20 0.8x3x10/10/8 3x4x40/0/4\
 1.5x1.5x12/0/8
"""),
    (layers, _GOES, 5.0, 0.15, """
layers= 20x12x10/0/8 40x12x10/0/8 30x8x20/5/4 12x5x60/0/20 6x6x100/0/8
"""),
    (outliers, _GOES, 0.0, 0.15, """
low-points= 0.1x1.5x1/0/4 0.1x8x1/10/2 0.1x4x1/0/20
high-points= 0.1x-8x1/0/4 1x-25x6/0/8
"""),
)  # fmt: skip


def _kinds() -> list[Kind]:
    found = []
    for make, stays, wrong, off, text in _MATRIX:
        for line in text.strip().splitlines():
            names, *rows = line.split()
            name, _, shape = names.partition("=")
            shape = shape if "=" in names else name.replace("-", "_")
            drawn = getattr(shapes, shape) if shape else None
            found.append(Kind(name, make, drawn, tuple(rows), stays, wrong, off))
    return found


KINDS = _kinds()


def rows() -> list[Row]:
    """Return all rows of the matrix, in the order of the kinds."""
    return [Row(kind, text, place) for kind in KINDS for text in kind.rows for place in PLACES]
