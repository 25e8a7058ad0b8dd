"""The contract of a step: what it can override is listed, in order, where `step.py` begins."""

import re
from pathlib import Path

from bare_earth.algorithms.engine import step
from bare_earth.algorithms.engine.step import PointResult, PointStep, Sink, Step

# Made of the others.
DERIVED = {"gives_classes", "settings"}


def test_the_list_has_everything_that_a_step_can_override():
    kinds = Step, PointStep, Sink, PointResult
    names = {
        name for kind in kinds for name in (*vars(kind), *getattr(kind, "__annotations__", ()))
    }
    names = {name for name in names if not name.startswith("_")} - DERIVED
    text = Path(step.__file__).read_text(encoding="utf-8")
    listed = text[text.index("# What a step can") : text.index("_Step = TypeVar")]
    data, calls = listed.split("\n#\n# Then the calls")
    of_data = re.findall(r"^# +(?:[A-Z]\w+ +)?((?:\w+, )*\w+)  ", data, re.MULTILINE)
    found = {name for line in of_data for name in line.split(", ")}
    found |= set(re.findall(r"^# +[A-Z]\w+\.(\w+)", calls, re.MULTILINE))
    assert found == names
    assert len(names) == 25 and f"{len(names)} things" in listed
