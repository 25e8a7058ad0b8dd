"""The presets have the values that the pages tell."""

import re
from pathlib import Path

import pytest

from bare_earth.algorithms.filters import METHODS
from benchmarks.scenes.simple import village

DOCS = Path(__file__).parents[2] / "docs"
NAMES = {
    "tin-densification": ("max_building_size", "iteration_angle", "iteration_distance"),
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


def test_the_page_of_the_slope_filter_tells_its_values_for_most_land():
    points, _ = village()
    text = PAGES["slope"].read_text("utf-8")
    chosen = METHODS["slope"].parameters().resolve(points)
    for label, name in (
        ("Search radius", "search_radius"),
        ("Slope threshold", "slope_threshold"),
        ("Height threshold", "height_threshold"),
        ("Cell size", "cell_size"),
        ("Maximum building size", "max_building_size"),
    ):
        value = re.search(rf"\*\*{label}\*\* `{name.upper()}` \| ([\d.]+)", text)
        assert getattr(chosen, name) == float(value[1]), name
    sizes = re.findall(r"(\d+) m in \*(\w+)\*", re.sub(r"It is (\d+)", r"\1", text))
    assert [preset for _, preset in sizes] == ["hilly", "steep", "city"]
    for size, preset in sizes:
        chosen = METHODS["slope"].parameters(preset=preset).resolve(points)
        assert chosen.max_building_size == float(size)
