"""The defaults and the presets have the values that the pages tell."""

import re
from pathlib import Path

import pytest

from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.filters.grid_minimum import GridMinimum
from bare_earth.algorithms.filters.slope import SlopeFilter
from bare_earth.algorithms.filters.tin import TinDensification
from bare_earth.algorithms.grids.model_key_points import ModelKeyPoints
from bare_earth.algorithms.survey.ground_classes import GroundClasses
from bare_earth.algorithms.survey.selection import Selection
from bare_earth.algorithms.tools.above_ground.classes import AboveGround
from bare_earth.algorithms.tools.off_terrain import OffTerrain
from benchmarks.scenes.simple import village

DOCS = Path(__file__).parents[2] / "docs"
NAMES = {
    "tin-densification": (
        "max_building_size",
        "iteration_angle",
        "iteration_distance",
        "cell_size",
    ),
    "grid-minimum": ("cell_size", "height_thresholds", "final_height", "max_object_size"),
    "slope": ("search_radius", "slope_threshold", "height_threshold"),
}
PAGES = {method: DOCS / f"{method.replace('slope', 'slope-filter')}.md" for method in NAMES}


def numbers(text):
    return tuple(map(float, re.findall(r"[\d.]+", text)))


def told(method):
    """Return the values of each preset that the table of a page has."""
    declared = {each.name: each for each in METHODS[method].parameters.declarations()}
    found = {}
    for line in PAGES[method].read_text("utf-8").splitlines():
        first, *others = line.strip("| ").split(" | ")
        name = re.match(r"`(\w+)`", first)
        if others and name and name[1] in declared["preset"].choices:
            found[name[1]] = list(map(numbers, others))
    return found


@pytest.mark.parametrize("method", NAMES)
def test_the_pages_tell_the_values_of_each_preset(method):
    points, _ = village()  # dense enough for any of them
    table = told(method)
    assert len(table) >= 5
    for preset, values in table.items():
        chosen = METHODS[method].parameters(preset=preset).resolve(points)
        for name, value in zip(NAMES[method], values):
            found = getattr(chosen, name)
            assert (found if isinstance(found, tuple) else (found,)) == value, (preset, name)


# The sets of parameters that the tables of a page tell, by the names that QGIS has for them.
TABLES = {
    "tin-densification": (TinDensification, Selection),
    "slope-filter": (SlopeFilter,),
    "grid-minimum": (GridMinimum,),
    "above-ground": (AboveGround, GroundClasses),
    "model-key-points": (ModelKeyPoints, GroundClasses),
    "remove-off-terrain-objects": (OffTerrain,),
}


@pytest.mark.parametrize("page", TABLES)
def test_the_pages_tell_the_defaults(page):
    text = (DOCS / f"{page}.md").read_text("utf-8")
    told = dict(re.findall(r"^\| \*\*.+?\*\* `([A-Z_]+)` \| (.+?) \|", text, re.MULTILINE))
    points, _ = village()
    compared = 0
    for parameters in TABLES[page]:
        chosen = parameters()
        for each in chosen.declarations():
            value = re.match(r"`?([\d.]+|on|off|[a-z-]+`)", told.get(each.name.upper(), ""))
            if value:
                resolve = getattr(chosen, "resolve", lambda points, same=chosen: same)
                assert _text(getattr(resolve(points), each.name)) == value[1].strip("`"), each.name
                compared += 1
    assert compared >= 3


def _text(value):
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, tuple):
        return ", ".join(map(_text, value))
    return value if isinstance(value, str) else f"{value:g}"


def test_the_presets_of_the_slope_filter_have_the_sizes_of_its_page():
    points, _ = village()
    text = PAGES["slope"].read_text("utf-8")
    sizes = re.findall(r"(\d+) m in \*(\w+)\*", text)
    assert [preset for _, preset in sizes] == ["hilly", "steep", "city", "site"]
    for size, preset in sizes:
        chosen = METHODS["slope"].parameters(preset=preset).resolve(points)
        assert chosen.max_building_size == float(size)
