import doctest
from dataclasses import dataclass

import pytest

from bare_earth import BareEarthError
from bare_earth.algorithms.core import parameters
from bare_earth.algorithms.core.parameters import ParameterSet, parameter
from bare_earth.algorithms.filters import METHODS


@dataclass(frozen=True)
class Example(ParameterSet):
    angle: float = parameter(8.0, label="Angle", help="Some.", unit="deg", minimum=0, maximum=90)
    count: int = parameter(3, label="Count", help="A count.", minimum=0)
    edge: float = parameter(None, kind="number", label="Edge", help="An edge.", minimum=0)
    which: str = parameter("last", label="Which", help="Which.", choices={"last": "L", "all": "A"})
    heights: tuple = parameter((5.0, 2.0), label="Heights", help="Heights.", unit="m", minimum=0)


def test_defaults_are_valid_and_kinds_follow_from_them():
    kinds = {declaration.name: declaration.kind for declaration in Example.declarations()}
    assert kinds == {
        "angle": "number",
        "count": "integer",
        "edge": "number",
        "which": "choice",
        "heights": "numbers",
    }
    assert Example().heights == (5.0, 2.0)


def test_text_from_a_command_line_becomes_numbers():
    example = Example(angle="12.5", count="4", heights=["3", "1"])
    assert (example.angle, example.count, example.heights) == (12.5, 4, (3.0, 1.0))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"angle": -1}, "Angle .* at least 0 deg, not -1"),
        ({"angle": 91}, "Angle .* at most 90 deg, not 91"),
        ({"angle": float("nan")}, "Angle .* finite .* nan"),
        ({"angle": "steep"}, "Angle .* number, not 'steep'"),
        ({"angle": None}, "Angle .* value"),
        ({"count": 2.5}, r"Count .* whole number, not 2\.5"),
        ({"which": "first"}, "Which .* last, all, not first"),
        ({"heights": [1, -2]}, "Heights .* at least 0 m, not -2"),
        ({"heights": "12"}, "Heights .* list .* '12'"),
    ],
)
def test_values_that_are_not_allowed_are_refused_with_a_sentence(values, message):
    with pytest.raises(BareEarthError, match=message):
        Example(**values)


def test_an_optional_parameter_may_be_left_out():
    assert Example(edge=None).edge is None


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_every_method_declares_label_help_and_limits(method):
    method.parameters()
    for declaration in method.parameters.declarations():
        assert declaration.label and declaration.help.endswith("."), declaration.name
        if declaration.kind in ("number", "integer", "numbers", "integers"):
            assert declaration.minimum is not None and declaration.maximum is not None, (
                declaration.name
            )


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_no_length_angle_or_count_is_below_zero(method):
    tried = 0
    for declaration in method.parameters.declarations():
        if declaration.kind in ("number", "integer"):
            below = -1 if declaration.kind == "integer" else -1e-6
            with pytest.raises(BareEarthError, match=declaration.label):
                method.parameters(**{declaration.name: below})
            tried += 1
    assert tried >= 4


def test_the_documented_example_is_right():
    assert doctest.testmod(parameters).failed == 0
