"""What the pages quote of commands and algorithms is there."""

import re
from functools import cache
from pathlib import Path

import pytest

from benchmarks.goldens.running import command_names, said_by

ROOT = Path(__file__).parents[2]
PAGES = sorted([ROOT / "README.md", *(ROOT / "docs").glob("*.md")])
METHODS = "tin-densification", "slope", "grid-minimum"
# Programs whose flags are not ours.
OTHERS = re.compile(
    r"\b(pip|pdal|pytest|python -m (?!bare_earth)|qgis_process|make|conda|git|dask|flatpak|filters"
    r"|docker|podman|las\w+64|Lidar\w+)\b"
)
FLAGS_OF_OTHERS = {"no-dashboard", "noversioncheck"}
FLAG = re.compile(r"(?<![\w-])--([a-z][a-z-]+)")


@cache
def flags_of(command: str) -> set[str]:
    """Return the flags of a command, in all methods."""
    takes_method = "--method" in said_by([command, "--help"])[1]
    helps = [[command, "--method", name, "--help"] for name in METHODS * takes_method]
    return {
        flag for words in helps or [[command, "--help"]] for flag in FLAG.findall(said_by(words)[1])
    }


def quoted(page: Path) -> list[str]:
    """Return the code of a page: spans and lines of blocks."""
    text = page.read_text(encoding="utf-8")
    blocks = re.findall(r"^ *```\w*\n(.*?)^ *```$", text, re.M | re.S)
    spans = re.findall(r"`([^`\n]+)`", re.sub(r"```.*?```", "", text, flags=re.S))
    return [line for block in blocks for line in block.replace("\\\n", " ").splitlines()] + spans


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_flags_that_a_page_quotes_are_those_of_the_command(page):
    everywhere = {flag for command in command_names() for flag in flags_of(command)}
    wrong = []
    for code in quoted(page):
        named = re.match(r"(?:\$ )?(?:bare-earth|python -m bare_earth\.algorithms) ([a-z-]+)", code)
        known = flags_of(named[1]) if named and named[1] in command_names() else everywhere
        if not OTHERS.search(code):
            flags = FLAG.findall(code.split("#")[0])
            wrong += [f"{code}: --{flag}" for flag in flags if flag not in known | FLAGS_OF_OTHERS]
    assert wrong == []


def test_algorithms_that_pages_quote_are_there():
    # The names that a test in QGIS compares with those of the provider.
    provider = (ROOT / "tests/qgis/test_provider.py").read_text(encoding="utf-8")
    named = {
        name
        for page in PAGES
        for name in re.findall(r"bareearth:([a-z]+)", page.read_text("utf-8"))
    }
    assert len(named) > 20
    assert {name for name in named if f'"bareearth:{name}"' not in provider} == set()
