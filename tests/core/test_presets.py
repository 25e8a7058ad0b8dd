"""The defaults and the presets have the values that the pages tell."""

import inspect
import re
from pathlib import Path

import pytest

import bare_earth
from bare_earth.algorithms.filters import METHODS
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
    declared = {
        parameter.name: parameter for parameter in METHODS[method].parameters.declarations()
    }
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


# The functions whose parameters the tables of a page tell, by the names that QGIS has for them.
TABLES = {
    **{PAGES[method].stem: bare_earth.classify for method in NAMES},
    "above-ground": bare_earth.above_ground,
    "model-key-points": bare_earth.key_points,
    "remove-off-terrain-objects": bare_earth.remove_off_terrain_objects,
}


@pytest.mark.parametrize("page", TABLES)
def test_the_pages_tell_the_defaults(page):
    text = (DOCS / f"{page}.md").read_text("utf-8")
    told = dict(re.findall(r"^\| \*\*.+?\*\* `([A-Z_]+)` \| (.+?) \|", text, re.MULTILINE))
    defaults = {
        name: parameter.default
        for name, parameter in inspect.signature(TABLES[page]).parameters.items()
    }
    for method in (method for method in NAMES if PAGES[method].stem == page):
        points, _ = village()
        chosen = METHODS[method].parameters().resolve(points)
        defaults.update(
            (declared.name, getattr(chosen, declared.name)) for declared in chosen.declarations()
        )
    compared = 0
    for name, default in defaults.items():
        value = re.match(r"`?([\d.]+|(?:on|off)\b|[a-z-]+`)", told.get(name.upper(), ""))
        if value and default is not None:
            assert _text(default) == value[1].strip("`"), name
            compared += 1
        elif name == "ground_tolerance":
            assert default is None and told[name.upper()].startswith("automatic")
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
