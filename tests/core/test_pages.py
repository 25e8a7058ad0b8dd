"""The pages for contributors name files that are there."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
_NAMED = re.compile(r"`((?:algorithms|plugin|tests|tools|benchmarks|docs)/[\w/.\-]*)`")


@pytest.mark.parametrize("page", ["ARCHITECTURE.md", "CONTRIBUTING.md"])
def test_the_files_that_a_page_names_are_there(page):
    named = _NAMED.findall((ROOT / page).read_text(encoding="utf-8"))
    assert named
    assert [each for each in named if not (ROOT / each).exists()] == []


def test_the_architecture_names_every_room():
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    rooms = {path.parent.name for path in (ROOT / "algorithms").glob("*/__init__.py")}
    assert {room for room in rooms if f"`algorithms/{room}/`" not in text} == set()
