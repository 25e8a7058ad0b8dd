"""Plain things: small scenes with one thing on a piece of land, whose truth is known by point.

`KINDS` is the matrix. A kind has rows such as ``5x1.5/20/8``, which are the sizes of a thing in
metres (the arguments of its shape), the slope of the land in percent, and points per square metre.
Each row is made at two places of the grid. At "a" the thing lies along the grid on smooth land,
below points scattered at random from straight above. At "b" it is turned, on rough land, and a
scanner sees its walls from two sides.
"""

from __future__ import annotations

import zlib
from typing import Callable, NamedTuple

import numpy as np

from bare_earth.algorithms.core.points import Points

from . import plain_shapes as shapes
from .classes import BUILDING, GROUND, HIGH_NOISE, HIGH_VEGETATION, LOW_NOISE, LOW_VEGETATION
from .relief import waves
from .scene import SCALE, Scene
from .settings import Settings

PLACES = "a", "b"
# Metres of land round a thing, and the least side of a scene.
_ROUND, _LEAST = 22.0, 60.0
_NOISE = 0.025
# Metres that pulses slant per metre of height, to both sides, at the two places.
_SLANTS = {"a": 0.02, "b": 0.18}
# Share of the pulses that strike a crown, and of these, that end on the ground below.
_CROWNS, _THROUGH = 0.7, 0.4
# Share of the pulses that strike leaves where there are any, and of those that strike plants, that
# have a second return from the ground.
_LEAVES, _SECOND = 0.85, 0.4
# Above this, points of an object can be told from the ground.
_TOLD, _TOLD_OF_PLANTS = 0.3, 0.2
# A house that stands beside earth: its sides, its height, and how far its middle is from the thing.
_HOUSE, _BESIDE = (12.0, 10.0, 6.0), 8.0


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


class Plain(NamedTuple):
    """The scene of a row, which points are the thing, and the direction of its length."""

    scene: Scene
    thing: np.ndarray
    angle: float


def _turned(x, y, angle):
    cos, sin = np.cos(angle), np.sin(angle)
    return x * cos + y * sin, y * cos - x * sin


class _Site:
    """The land of a row, its dice, and the places of its pulses."""

    def __init__(self, row: Row, side: float) -> None:
        self.random = random = np.random.default_rng(zlib.crc32(row.name.encode()))
        self.row, self.side, is_rough = row, side, row.place == "b"
        slope, density = map(float, row.text.split("/")[1:])
        self.angle = random.uniform(0.1, 1.4) if is_rough else random.integers(2) * np.pi / 2
        up = random.uniform(0.0, 2 * np.pi)
        self._up = slope / 100.0 * np.array((np.cos(up), np.sin(up)))
        self._roll = waves(random, 0.12 if is_rough else 0.03, 22.0)
        self._bumps = waves(random, 0.03 if is_rough else 0.0, 3.0)
        self.x, self.y = random.uniform(-side / 2, side / 2, (2, int(density * side**2)))
        if is_rough:
            step = density**-0.5
            across = np.arange(-0.75 * side, 0.75 * side, step)
            lattice = np.array(np.meshgrid(across * 1.3, across / 1.3)).reshape(2, -1)
            lattice += random.uniform(-0.4, 0.4, lattice.shape) * step
            x, y = _turned(*lattice, random.uniform(0.1, 1.4))
            inside = np.maximum(np.abs(x), np.abs(y)) < side / 2
            self.x, self.y = x[inside], y[inside]
        self.count = len(self.x)

    def land(self, x, y):
        """Return the height of the land without the thing."""
        rolling = self._roll(x, y) + self._bumps(x, y)
        return 100.0 + self._up[0] * x + self._up[1] * y + rolling

    def rise(self, x, y):
        """Return how far the thing rises above what it stands on."""
        return self.row.kind.shape(*_turned(x, y, self.angle), *self.row.sizes)

    def plain(self, x, y, z, classes, thing, terrain, number=None, count=None) -> Plain:
        """Return the scene of some points, with noise and a few birds."""
        one, random, side = np.ones(len(x)), self.random, self.side / 2
        birds = random.uniform(-side, side, (2, 4))
        high = self.land(*birds) + random.uniform(15.0, 60.0, 4)
        corner = tuple(np.round(random.uniform(200.0, 900.0, 2), 2).tolist())
        z = z + random.normal(0.0, _NOISE, len(z))
        xyz = np.column_stack((np.array((x, y, z)), (*birds, high))) + np.array([[*corner, 0.0]]).T
        columns = (
            np.append(column, [value] * 4).astype(np.uint8)
            for column, value in (
                (classes, HIGH_NOISE),
                (one if number is None else number, 1),
                (one if count is None else count, 1),
            )
        )
        points = Points(*(np.rint(xyz / SCALE) * SCALE))
        scene = Scene(points, *columns, self.row.name, 0, Settings(), corner, terrain)
        return Plain(scene, np.append(thing, [False] * 4), self.angle)


def _extent(shape: Callable[..., np.ndarray], sizes: tuple[float, ...]) -> float:
    """Return how wide an object is, whatever its direction."""
    axis = np.arange(-150.0, 150.5, 1.5)
    u, v = np.meshgrid(axis, axis)
    return 1.8 * float(np.hypot(u, v)[np.isfinite(shape(u, v, *sizes))].max(initial=3.0))


def _breadth(row: Row) -> float:
    """Return how wide earth is, across what is long; 0 for what has no other side."""
    axis, zero = np.arange(-100.0, 100.5, 0.5), np.zeros(401)
    rises = (np.abs(row.kind.shape(*places, *row.sizes)) for places in ((axis, zero), (zero, axis)))
    least = min(float(np.ptp(axis[rise > 0.1 * rise.max()])) for rise in rises if rise.any())
    return least if least < 99.0 else 0.0


def _struck(site: _Site, floor: Callable, top: Callable) -> tuple[np.ndarray, ...]:
    """Return x, y, z and what is solid of pulses from two sides, some of which strike walls."""
    x, y, land = site.x, site.y, floor(site.x, site.y)
    slant = _SLANTS[site.row.place] * site.random.choice((-1.0, 1.0), site.count)
    highest = max(float((top(x, y) - land).max()), 0.0) + 0.01
    z, is_solid, before = land.copy(), np.zeros(site.count, dtype=bool), highest
    for above in np.linspace(highest, 0.0, 11):
        roof = top(x + slant * above, y) - land
        hit = ~is_solid & (roof >= above)
        met = np.where(roof > before, site.random.uniform(above, before, site.count), roof)
        z[hit] += met[hit]
        is_solid, before = is_solid | hit, above
    return np.where(is_solid, x + slant * (z - land), x), y, z, is_solid


def earth(row: Row, has_house: bool = False) -> Plain:
    """Return earth in the open."""
    site = _Site(row, max(_LEAST, _breadth(row) + 2 * _ROUND))

    def terrain(x, y):
        return site.land(x, y) + site.rise(x, y)

    x, y, solid = site.x, site.y, np.zeros(site.count, dtype=bool)
    z = terrain(x, y)
    if has_house:
        place = _turned(0.0, _BESIDE, -site.angle)
        base = float(terrain(*(np.array([axis]) for axis in place))[0])

        def house(x, y):
            u, v = _turned(x, y, site.angle)
            return base + shapes.flat(u, v - _BESIDE, *_HOUSE)

        x, y, z, solid = _struck(site, terrain, house)
    rise = np.abs(site.rise(x, y))
    if has_house:  # what is raised near it
        near = np.hypot(*(a - b for a, b in zip((x, y), place))) < 2.0 * _HOUSE[0]
        rise = rise * near
    thing = ~solid & (rise > 0.1 * rise.max())
    return site.plain(x, y, z, np.where(solid, BUILDING, GROUND), thing, terrain)


def by_house(row: Row) -> Plain:
    """Return earth with a house on it."""
    return earth(row, has_house=True)


def wooded(row: Row, below: Callable[[Row], Plain] = earth) -> Plain:
    """Return earth below trees: at the second place without return numbers."""
    plain = below(row)
    scene, random = plain.scene, np.random.default_rng(zlib.crc32(row.name.encode()) + 1)
    x, y, z = scene.points
    crown = (_patches(random, x, y, 5.0) < _CROWNS) & (scene.classes != HIGH_NOISE)
    kept, top = ~crown | (random.random(len(x)) < _THROUGH), np.flatnonzero(crown)
    leaves = Points(x[top], y[top], z[top] + random.uniform(5.0, 14.0, len(top)))
    is_numbered = row.place == "a" and below is earth
    counted, several = np.where(crown & is_numbered, 2, 1)[kept], kept[top] & is_numbered
    columns = (
        np.append(scene.classes[kept], np.full(len(top), HIGH_VEGETATION)),
        np.append(counted, np.ones(len(top))),
        np.append(counted, np.where(several, 2, 1)),
    )
    points = Points(*(np.append(axis[kept], more) for axis, more in zip(scene.points, leaves)))
    classes, number, count = (column.astype(np.uint8) for column in columns)
    scene = Scene(
        points, classes, number, count, scene.kind, 0, scene.settings, scene.corner,
        scene.bare_earth,
    )  # fmt: skip
    return Plain(scene, np.append(plain.thing[kept], np.zeros(len(top), bool)), plain.angle)


def _patches(random: np.random.Generator, x, y, length: float) -> np.ndarray:
    """Return numbers from 0 to 1, evenly spread, that are alike within some metres."""
    field = waves(random, 1.0, 2.0 * length, 9)(x, y)
    return np.argsort(np.argsort(field)) / max(len(field) - 1, 1)


def solid(row: Row, is_level: bool = True) -> Plain:
    """Return what stands on a level floor, with its eaves above the highest ground below it."""
    shape, sizes = row.kind.shape, row.sizes
    site = _Site(row, max(_LEAST, _extent(shape, sizes) + 2 * _ROUND))
    rise = site.rise(site.x, site.y)
    on = np.isfinite(rise)
    highest = float(site.land(site.x, site.y)[on].max())
    lowest = float(rise[on].min())
    floor = max(float(site.land(*np.zeros((2, 1)))[0]), highest + min(2.2, lowest) - lowest)

    def top(x, y):
        return site.rise(x, y) + (floor if is_level else site.land(x, y))

    x, y, z, is_solid = _struck(site, site.land, top)
    thing = is_solid & (z > site.land(x, y) + _TOLD)
    return site.plain(x, y, z, np.where(is_solid, BUILDING, GROUND), thing, site.land)


def loose(row: Row) -> Plain:
    """Return what stands on the land as it is: rows of things, and small ones."""
    return solid(row, is_level=False)


def plants(row: Row, is_numbered: bool = False) -> Plain:
    """Return plants all over the land: of a height, and a cover in percent."""
    tall, cover = row.sizes[:2]
    site = _Site(row, _LEAST if float(row.text.split("/")[2]) < 100 else _LEAST / 2)
    random, count, land = site.random, site.count, site.land(site.x, site.y)
    dice = random.random(count)
    if row.place == "b":  # in tufts
        dice = np.argsort(np.argsort(dice + _patches(random, site.x, site.y, 1.0))) / count
    plant = dice < cover / 100.0
    if row.kind.shape is not None:
        plant = np.isfinite(site.rise(site.x, site.y)) & (dice < 0.95)
    height = np.where(plant, tall * random.uniform(0.5, 1.0, count), 0.0)
    below = np.flatnonzero(plant & is_numbered & (random.random(count) < _SECOND))
    counts, twos = np.ones(count), np.full(len(below), 2)
    counts[below] = 2
    return site.plain(
        np.append(site.x, site.x[below]), np.append(site.y, site.y[below]),
        np.append(land + height, land[below]),
        np.append(np.where(plant, LOW_VEGETATION, GROUND), np.full(len(below), GROUND)),
        np.append(height > _TOLD_OF_PLANTS, below < 0), site.land,
        np.append(np.ones(count), twos), np.append(counts, twos),
    )  # fmt: skip


def numbered(row: Row) -> Plain:
    """Return plants of which some pulses have two returns."""
    return plants(row, is_numbered=True)


def understory(row: Row) -> Plain:
    """Return plants below trees, without return numbers."""
    return wooded(row, plants)


def leafy(row: Row) -> Plain:
    """Return bushes and hedges, through which some pulses see the ground."""
    site = _Site(row, max(_LEAST, _extent(row.kind.shape, row.sizes) + 2 * _ROUND))
    rise = site.rise(site.x, site.y)
    leaf = np.isfinite(rise) & (site.random.random(site.count) < _LEAVES)
    height = np.where(leaf, rise, 0.0) * site.random.uniform(0.4, 1.0, site.count)
    z, classes = site.land(site.x, site.y) + height, np.where(leaf, LOW_VEGETATION, GROUND)
    return site.plain(site.x, site.y, z, classes, height > _TOLD, site.land)


def outliers(row: Row) -> Plain:
    """Return 16 groups of points, which are below the ground if the second size is positive."""
    width, depth, many = row.sizes
    site = _Site(row, 80.0)
    random, several = site.random, int(many)
    middles = np.array(np.meshgrid(*[np.linspace(-28.0, 28.0, 4)] * 2)).reshape(2, -1)
    middles += random.uniform(-4.0, 4.0, middles.shape)
    x, y = np.repeat(middles, several, axis=1)
    x, y = np.array((x, y)) + width * random.uniform(-0.5, 0.5, (2, len(x)))
    deep = np.repeat(depth * random.uniform(0.8, 1.2, 16), several)
    low = site.land(x, y) - deep + random.normal(0.0, 0.05 * width, len(x))
    classes = np.append(np.full(site.count, GROUND), np.full(len(x), LOW_NOISE))
    x, y = np.append(site.x, x), np.append(site.y, y)
    z = np.append(site.land(site.x, site.y), low)
    return site.plain(x, y, z, classes, classes == LOW_NOISE, site.land)


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
"""),
    (wooded, _STAYS, 5.0, 0.2, """
bowl-under-trees=bowl 5x1.5/0/8 8x2/20/8 6x2/0/20 10x4/10/4
pit-under-trees=pit 6x3/0/20 8x4/10/8
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
drum 12x6/0/4 30x10/3/2
"""),
    (solid, _GOES, 5.0, 0.3, """
a-frame 16x10x8/0/8 12x8x7/5/4 20x12x8/0/2 10x6x5/10/8
"""),
    (loose, _GOES, 5.0, 0.3, """
polytunnels=vaults 40x8x3.2x1x4/0/8 70x8x3.2x1x4/0/7 60x8x3.5x1x8/3/4\
 50x6x2.5x1x5/0/8 60x9x4x1.5x3/5/2
glasshouses 60x6x4x0x8/0/4 60x8x4.5x1x5/2/8 40x10x3x3x4/0/2
panels 40x4x0.8x0.4x4x6/0/8 50x4x2x0x1.5x6/5/4 60x2.2x0.6x0.2x2x10/10/8
barges=boxes 50x9x2.5x2x3/0/2 40x8x3x1x4/0/2
containers=boxes 12.2x2.5x2.6x1x4/0/8 6x2.5x2.6x0.5x6/2/4
sheds=boxes 3x3x2.4x6x4/5/4
cars=boxes 4.5x1.8x1.5x1x6/0/8 4.5x1.8x1.5x1.5x5/5/4
lorries=boxes 14x2.5x3.6x1.5x4/0/4
wood-stacks=boxes 12x1.5x2.2x3x3/5/8
bales=boxes 1.5x1.5x1.4x4x5/3/8
walls=boxes 25x0.5x2x10x2/0/12 30x0.6x1.5x10x2/5/8
"""),
    (leafy, _GOES, 5.0, 0.3, """
hedges=boxes 40x1.5x1.8x15x2/0/8 40x2.5x2.5x15x2/10/4
bushes=domes 2.5x1.5x3x6/0/8 4x3x4x5/10/4
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
