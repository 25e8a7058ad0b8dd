"""Declared parameters as Processing parameters, and back."""

import re
from dataclasses import dataclass
from typing import Optional

import pytest
from qgis.core import QgsProcessingContext, QgsProperty

from bare_earth import BareEarthError
from bare_earth.algorithms.core.parameters import ParameterSet, parameter
from bare_earth.algorithms.tools.declaration import FileTool
from bare_earth.plugin.processing.algorithm import ToolAlgorithm
from bare_earth.plugin.processing.commands import command_line
from bare_earth.plugin.processing.request import Request


@dataclass(frozen=True)
class Example(ParameterSet):
    size: float = parameter(0.5, label="Size", unit="m", minimum=0.0005, maximum=9.0, help="S.")
    rounds: int = parameter(3, label="Rounds", minimum=1, maximum=9, help="R.")
    careful: bool = parameter(True, label="Careful", help="C.")
    way: str = parameter("up", label="Way", choices={"up": "Upwards", "down": "Down"}, help="W.")
    sizes: tuple = parameter((1.0, 2.5), label="Sizes", minimum=0.0, help="S.")
    classes: Optional[tuple] = parameter(None, kind="integers", label="Classes", help="C.")
    edge: Optional[float] = parameter(5.0, kind="number", optional=True, label="Edge", help="E.")
    stop: Optional[float] = parameter(None, kind="number", label="Stop", minimum=0.0, help="S.")
    light: str = parameter(
        "a", label="Light", choices={"a": "A", "b": "B"}, help="L.", advanced=True
    )


TOOL = FileTool("example", (Example,), own_line="An example.")


@pytest.fixture
def example():
    return ToolAlgorithm(TOOL).create()


def chosen(example, values):
    return example.sets_of(Request(example, values, QgsProcessingContext()))[0]


def test_without_values_the_defaults_are_taken(example):
    assert chosen(example, {}) == Example()


def test_a_choice_that_a_stored_model_does_not_know_is_the_default(example):
    assert example.checkParameterValues({}, QgsProcessingContext())[0]
    assert example.parameterDefinition("LIGHT").checkValueIsAcceptable(None)
    assert not example.parameterDefinition("WAY").checkValueIsAcceptable("sideways")
    assert chosen(example, {"LIGHT": None}).light == "a"
    assert chosen(example, {"LIGHT": "b"}).light == "b"


def test_the_defaults_of_the_dialog_are_those(example):
    defaults = {
        definition.name(): definition.defaultValue()
        for definition in example.parameterDefinitions()
    }
    assert chosen(example, defaults) == Example()


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({"SIZE": 2}, {"size": 2.0}),
        ({"SIZE": "2.5"}, {"size": 2.5}),
        ({"SIZE": QgsProperty.fromExpression("1 + 2")}, {"size": 3.0}),
        ({"ROUNDS": 4}, {"rounds": 4}),
        ({"CAREFUL": False}, {"careful": False}),
        ({"CAREFUL": "false"}, {"careful": False}),
        ({"WAY": "down"}, {"way": "down"}),
        ({"WAY": 1}, {"way": "down"}),  # as qgis_process help counts them
        ({"WAY": "0"}, {"way": "up"}),
        ({"SIZES": "3, 4.5"}, {"sizes": (3.0, 4.5)}),
        ({"SIZES": [3, 4.5]}, {"sizes": (3.0, 4.5)}),
        ({"CLASSES": "1; 2 3"}, {"classes": (1, 2, 3)}),
        ({"CLASSES": ""}, {"classes": None}),
        ({"EDGE": None}, {"edge": None}),
        ({"EDGE": ""}, {"edge": None}),
        ({"STOP": 0}, {"stop": 0.0}),
    ],
)
def test_values_arrive(example, values, expected):
    assert chosen(example, values) == Example(**expected)
    assert example.checkParameterValues(values, QgsProcessingContext())[0]


@pytest.mark.parametrize(
    ("values", "word"),
    [
        ({"SIZE": 0}, r"Size .* 0\.0005 m"),
        ({"SIZE": "large"}, "Size .* number"),
        ({"SIZE": None}, "Size .* value"),
        ({"ROUNDS": 2.5}, "Rounds .* whole number"),
        ({"ROUNDS": 10}, "Rounds .* at most 9"),
        ({"WAY": "left"}, "Way .* up, down"),
        ({"WAY": 2}, "Way .* up, down"),
        ({"WAY": "-1"}, "Way .* up, down"),
        ({"SIZES": "1, x"}, "Sizes .* number"),
        ({"CLASSES": "1.5"}, "Classes .* whole number"),
    ],
)
def test_wrong_values_are_refused_by_one_line(example, values, word):
    with pytest.raises(BareEarthError, match=word):
        chosen(example, values)
    possible, text = example.checkParameterValues(values, QgsProcessingContext())
    assert not possible and re.search(word, text) and "\n" not in text


def test_the_dialog_shows_as_many_decimals_as_are_needed(example):
    metadata = example.parameterDefinition("SIZE").metadata()
    assert metadata["widget_wrapper"]["decimals"] == 4


def test_the_command_line_says_what_differs_from_the_defaults():
    text = command_line(
        "classify",
        ["a b.las", "c.las"],
        [Example(size=2, careful=False, sizes=(1, 2), edge=None)],
        {"method": "example", "dtm": ""},
    )
    assert text == (
        "bare-earth classify 'a b.las' c.las --method example --size 2.0 --no-careful --sizes 1 2"
        " --edge none"
    )
