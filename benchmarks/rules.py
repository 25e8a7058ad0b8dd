"""The rules of the filters that can be switched off one by one, and groups of them."""

from __future__ import annotations

import contextlib
from dataclasses import replace
from typing import Any, Callable, Iterable, Sequence

import numpy as np

from bare_earth.algorithms.filters.shared.allowance import Allowance
from bare_earth.algorithms.filters.shared.lowest_points import _OBJECT_HEIGHTS, CellBlocks
from bare_earth.algorithms.filters.shared.objects import PLATEAU_HEIGHT, Objects, raised_objects

from .switches import NO_CODE, Change, Rule, module_named, watched, without


def _nothing(places: str | Sequence[str], shape: Callable[..., Any]) -> tuple[Change, ...]:
    """Return changes by functions that return no True of the shape that their arguments give."""
    return _returns(places, lambda *given, **named: np.zeros(shape(*given, **named), dtype=bool))


def _returns(places: str | Sequence[str], by: Callable[..., Any]) -> tuple[Change, ...]:
    places = (places,) if isinstance(places, str) else places
    return tuple(Change(place, lambda _: by, True) for place in places)


def _is(place: str, value: object) -> tuple[Change, ...]:
    return (Change(place, lambda _: value),)


def _allowing(**fields: object) -> tuple[Change, ...]:
    """Return changes by which cells of the ground are found with another allowance."""

    def by(found: Callable[..., np.ndarray]) -> Callable[..., np.ndarray]:
        def changed(heights, size, objects, window, allowance=Allowance(), *rest, **named):
            allowance = replace(allowance, **fields)
            return found(heights, size, objects, window, allowance, *rest, **named)

        return changed

    return tuple(Change(place, by) for place in _GROUND_CELLS)


def _judging(**fields: object) -> tuple[Change, ...]:
    """Return a change by which the borders of regions are judged with another allowance."""

    def by(found: Callable[..., np.ndarray]) -> Callable[..., np.ndarray]:
        return lambda *given: found(*given[:-1], replace(given[-1], **fields))

    return (Change(f"{_GENTLE}:_joined", by, True),)


def _small_windows(found: Callable[..., np.ndarray]) -> Callable[..., np.ndarray]:
    def changed(heights, size, objects, window, *rest, **named):
        return found(heights, size, objects, min(window, Allowance.usual_window), *rest, **named)

    return changed


def _without_plateaus(found: Callable[..., Objects]) -> Callable[..., Objects]:
    def changed(*given: Any) -> Objects:
        objects = found(*given)
        return objects._replace(plateaus=np.zeros_like(objects.plateaus))

    return changed


def _on_doubled_cells(found: Callable[..., Objects]) -> Callable[..., Objects]:
    """Replace `LowestPoints.objects`: what is found on doubled cells is certain."""

    def changed(self: Any, max_size: float, progress: Any) -> Objects:
        cells, heights = self._wide()
        blocks = CellBlocks.over(cells, 2.0 * cells.size)
        lowest, place = blocks.lowest(heights), blocks.first_block
        on_blocks = raised_objects(
            lowest, blocks.size, _OBJECT_HEIGHTS, max_size, progress, place, False, PLATEAU_HEIGHT
        )
        wide = (blocks.repeated(each, heights.shape) for each in on_blocks)
        return Objects(*(cells.resampled(each, self.cells) for each in wide))

    return changed


def _on_single_cells(found: Callable[..., Objects]) -> Callable[..., Objects]:
    """Replace `raised_objects` where the lowest points use it: nothing is found on doubled cells.

    The search on doubled cells is the one with plateaus.
    """

    def changed(heights: np.ndarray, *given: Any, **named: Any) -> Objects:
        if "plateau_height" in named:
            return Objects(*np.zeros((4, *heights.shape), dtype=bool))
        return found(heights, *given, **named)

    return changed


def _no_trend(found: Callable[..., Any]) -> Callable[..., Any]:
    return lambda heights, *given: found(np.zeros_like(heights), *given)


def _uneven(curvature: np.ndarray, known: np.ndarray) -> np.ndarray:
    return np.full(curvature.shape, np.inf)


_GROUND_CELLS = tuple(
    f"{module}:ground_cells"
    for module in ("tin_densification.seeds", "slope.filter", "grid_minimum.filter")
)
_SUPPORTED = ("shared.outliers", "shared.scattered", "slope.low_clusters", "grid_minimum.filter")
_PITS = "shared.lowest_points", "grid_minimum.filter"
_SEEDS, _CELLS, _GENTLE, _LIMITS = (
    "tin_densification.filter",
    "shared.ground_cells",
    "shared.gentle_regions",
    "shared.ground_limits",
)


def _first(grid: np.ndarray, *rest: Any, **named: Any) -> tuple[int, ...]:
    return grid.shape


_NO_LIMIT = _returns(
    f"{_CELLS}:_standing_out",
    lambda filled, *_: (np.zeros(filled.shape, bool), np.full(filled.shape, -np.inf, np.float32)),
)
_NOT_STRICT = Change(
    f"{_CELLS}:_standing_out",
    lambda found: lambda *given: (lambda pair: (np.zeros_like(pair[0]), pair[1]))(found(*given)),
)
_ONE_GRID = (
    Change(f"{_SEEDS}:in_threads", lambda run: lambda of, all_: run(of, all_[:1]) * len(all_)),
    Change(
        f"{_SEEDS}:seeds_of_two_grids",
        lambda _: (
            lambda count, grids, *rest: module_named(_SEEDS).seeds_of_one_grid(grids[0], *rest)
        ),
    ),
)
_OPEN = _returns("shared.breaks:openness", lambda points, cells, rise: np.ones(cells.shape))
_NO_NOISE = (
    *_returns(f"{_LIMITS}:middle_of_noise", lambda _, __, surface, *___: (0 * surface.ravel(), 0)),
    *_returns(f"{_LIMITS}:noise_of_squares", lambda *_: 0.0),
)
_NOT_EVEN = (*_is(f"{_LIMITS}:_EVEN_LESS", 0.0), *_returns(f"{_LIMITS}:_unevenness", _uneven))


# Methods that search objects among the lowest points of two sizes of cells.
_ON_POINTS = "tin-densification", "slope"
# fmt: off
_ALL = (
    Rule("scattered lows", _nothing("method:scattered_lows", lambda points: points.count),
         ("shared.scattered",)),
    Rule("low groups", _nothing("shared.low_groups:LowGroups.find",
         lambda self, points: points.count), ("shared.low_groups",)),
    Rule("low outliers", _nothing([f"{each}:low_outliers" for each in _PITS], _first),
         ("shared.outliers:low_outliers", "shared.outliers:depth_of_pits")),
    Rule("supported", _nothing([f"{each}:supported" for each in _SUPPORTED], _first),
         ("shared.outliers:supported", "shared.outliers:_witnesses")),
    Rule("lone points", _nothing("shared.lowest_points:lone_points", _first)),
    Rule("under canopy", _nothing([f"{each}:under_canopy" for each in _PITS], _first),
         ("shared.outliers:under_canopy",)),
    Rule("low clusters", _nothing("slope.filter:low_clusters", _first),
         ("slope.low_clusters",)),
    Rule("noise", _nothing("shared.height_steps:HeightSteps.pits",
         lambda self, candidates, *_: candidates.shape), ("grid_minimum.filter:_noise",
         "shared.height_steps:HeightSteps.pits"), ("grid-minimum",)),
    Rule("objects on single cells",
         (Change("shared.lowest_points:LowestPoints.objects", _on_doubled_cells),),
         methods=_ON_POINTS),
    Rule("objects on doubled cells",
         (Change("shared.lowest_points:raised_objects", _on_single_cells),),
         methods=_ON_POINTS),
    Rule("halls", _nothing("shared.objects:halls", lambda steps, heights, *_: heights.shape),
         ("shared.halls",)),
    Rule("mountains", _nothing("shared.regions:Regions.mountains",
         lambda self, *_: self.number.shape)),
    Rule("plateaus", (Change("shared.lowest_points:LowestPoints.objects", _without_plateaus),
         Change("grid_minimum.filter:_tall_objects", _without_plateaus)),
         ("shared.regions:Regions.plateaus",)),
    Rule("cut plateaus", _nothing(f"{_CELLS}:_of_cut_plateaus",
         lambda numbers, raised: raised.shape)),
    Rule("cliff faces", _returns("shared.regions:Regions._is_no_cliff",
         lambda self: np.ones(len(self.width), bool)), ("shared.regions:Border.faces",
         "shared.regions:Regions._is_no_cliff",
         "shared.height_steps:HeightSteps._face_slopes")),
    Rule("trend of steps", (Change("shared.height_steps:Trend", _no_trend),)),
    Rule("openings", _NO_LIMIT),
    Rule("strict opening", (_NOT_STRICT,)),
    Rule("second slope", _allowing(slopes_taken=1)),
    Rule("large windows", tuple(Change(each, _small_windows) for each in _GROUND_CELLS)),
    Rule("gentle regions", _returns(f"{_CELLS}:gentle_regions",
         lambda _, known, *__: np.zeros((2, *known.shape), bool)), (_GENTLE,)),
    *(
        Rule(name, _nothing(f"shared.landforms:_Regions.{name}", lambda self, _: len(self._area)))
        for name in ("rocks", "ramps", "links")
    ),
    Rule("house share", _is(f"{_GENTLE}:_HOUSE_SHARE", 0.0)),
    Rule("wide share", _judging(wide_share=Allowance.gentle_share), NO_CODE),
    Rule("rising borders", _judging(rise_counts=False), NO_CODE),
    Rule("border of the survey", _judging(border_area=np.inf), NO_CODE),
    Rule("on slopes", _nothing(f"{_GENTLE}:on_slope", lambda _, __, one, *___: len(one)),
         ("shared.slopes",)),
    Rule("trend of edges", _is(f"{_CELLS}:Trend", lambda *_: None)),
    Rule("islands", _nothing(f"{_CELLS}:islands", _first)),
    Rule("flat roofs", _nothing(f"{_CELLS}:flat_roofs", _first), ("shared.roofs",)),
    Rule("courtyards", _nothing(f"{_CELLS}:courtyards", _first)),
    Rule("pits in roofs", _nothing(f"{_CELLS}:pits_in_roofs", _first)),
    Rule("between ditches", _nothing(f"{_CELLS}:between_ditches", _first),
         ("shared.between_ditches",)),
    Rule("gaps are judged", _allowing(judges_gaps=False)),
    Rule("second grid", _ONE_GRID, ("tin_densification.seeds:seeds_of_two_grids",)),
    Rule("plants at planes", _nothing("shared.breaks:_wrong", lambda _, seeds, *__:
         len(seeds))),
    Rule("level seeds at breaks", (*_OPEN, *_nothing("shared.breaks:_level",
         lambda _, __, waiting, *___: len(waiting))),
         ("shared.breaks:_level", "shared.openness")),
    Rule("openness", _OPEN, ("shared.openness",)),
    Rule("densification", _returns(f"{_SEEDS}:densified", lambda *_: np.zeros(0, np.intp)),
         ("tin_densification.densification",)),
    Rule("level neighbour", _returns("tin_densification.densification:_has_level_neighbour",
         lambda above, _: np.ones(above.shape, bool))),
    Rule("tolerance of noise", _NO_NOISE, ("shared.noise",)),
    Rule("tolerance at breaks", _is(f"{_LIMITS}:_BREAK_FACTOR", 0.0)),
    Rule("even ground", _NOT_EVEN),
    Rule("slope tolerance by spacing", _is(f"{_LIMITS}:_DENSE", 1.0)),
    Rule("banks", _nothing("shared.near_ground:banks", lambda points, *_: points.count),
         ("shared.banks", "shared.bank_sections")),
)
# fmt: on
RULES = {each.name: each for each in _ALL}
_J4 = (
    "objects on single cells", "pits in roofs", "islands", "flat roofs", "courtyards",
    "between ditches", "mountains", "links", "level neighbour", "strict opening", "second slope",
    "trend of edges",
)  # fmt: skip
GROUPS = {
    "J4": _J4,
    "J4, house share, gaps": (*_J4, "house share", "gaps are judged"),
    "J4, halls, ramps, rocks": (*_J4, "halls", "ramps", "rocks"),
    "low outliers but groups": (
        "scattered lows", "low outliers", "lone points", "under canopy", "low clusters", "noise",
    ),
    "landforms": ("mountains", "rocks", "ramps", "links"),
    "enclosed and roofs": ("islands", "flat roofs", "courtyards", "pits in roofs"),
}  # fmt: skip


def switched_off(names: Iterable[str]) -> contextlib.AbstractContextManager[None]:
    """Run the filters without some rules."""
    return without(RULES[name] for name in names)


def acting() -> contextlib.AbstractContextManager[set[str]]:
    """Run the filters with all rules, and tell at the end which of them found something."""
    return watched(RULES.values())
