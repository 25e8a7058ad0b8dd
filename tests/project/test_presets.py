"""The presets have the values that the pages tell."""

import re
from pathlib import Path

import pytest

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


def test_the_presets_of_the_slope_filter_have_the_sizes_of_its_page():
    points, _ = village()
    text = PAGES["slope"].read_text("utf-8")
    sizes = re.findall(r"(\d+) m in \*(\w+)\*", text)
    assert [preset for _, preset in sizes] == ["hilly", "steep", "city", "site"]
    for size, preset in sizes:
        chosen = METHODS["slope"].parameters(preset=preset).resolve(points)
        assert chosen.max_building_size == float(size)
