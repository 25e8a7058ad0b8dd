"""What the pages quote of commands and algorithms is there."""

import ast
import re
from functools import cache
from pathlib import Path
from typing import Iterator

import pytest
from shipped import SHIPPED, tree_of

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


NUMBER = re.compile(r"-?\d[\d,]*(?:\.\d+)?")
# Words of a table of messages: its first head, and what introduces a message in a line.
MESSAGES = re.compile(r"^\| *(?:Warning|Message|Error) *\|", re.M)
STATED = rf"({NUMBER.pattern})(?: ?[m°%])?"
DEFAULT = re.compile(
    rf"\bdefault[^.|`;()]{{0,25}}?({NUMBER.pattern})|{STATED},? (?:by|is the) default"
    rf"|{STATED} \(default",
    re.I,
)


def without_numbers(text: str) -> str:
    """Return a text with # in place of each number, in one line."""
    return " ".join(NUMBER.sub("#", text).split())


def texts_of(path: Path) -> Iterator[str]:
    """Yield the texts of a module, with # where something is put in."""
    for node in ast.walk(tree_of(path)):
        if isinstance(node, ast.JoinedStr):
            parts = (part.value if isinstance(part, ast.Constant) else "#" for part in node.values)
            yield without_numbers("".join(map(str, parts)))
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield without_numbers(re.sub(r"\{[^}]*\}|%\d|%[sdg]", "#", node.value))


@cache
def texts_of_the_code() -> str:
    """Return all texts of algorithms and plugin."""
    return "\n".join(text for path in SHIPPED for text in texts_of(path))


def messages(text: str) -> list[str]:
    """Return what a page presents as messages: first cells of tables of these, lines of code."""
    blocks = re.findall(r"^ *```\w*\n(.*?)^ *```$", text, re.M | re.S)
    said = [
        re.sub(r"^\s*(?:Warning|Error|bare-earth: error): ", "", line).strip()
        for block in blocks
        for line in block.splitlines()
        if re.match(r"\s*(?:Warning|Error|bare-earth: error): ", line)
    ]
    for table in MESSAGES.finditer(text):
        rows = text[table.start() :].split("\n\n")[0].splitlines()[2:]
        said += [row.split("|")[1].strip(' *`"') for row in rows]
    return said


def unknown_messages(text: str) -> list[str]:
    """Return the messages of a page that the code does not say."""
    known = texts_of_the_code()
    return [one for one in messages(text) if without_numbers(one) not in known]


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_messages_that_a_page_quotes_are_those_of_the_code(page):
    assert unknown_messages(page.read_text("utf-8")) == []


def test_warnings_are_quoted_and_one_that_the_code_does_not_say_is_found():
    assert len(messages((ROOT / "docs/which-method.md").read_text("utf-8"))) >= 3
    row = "| *Hardly any ground was found: fewer than 2 % of the* | x |"
    right = f"| Warning | When |\n|---|---|\n{row}\n"
    assert unknown_messages(right) == []
    old = right.replace("Hardly any", "Nearly no")
    assert unknown_messages(old) == ["Nearly no ground was found: fewer than 2 % of the"]
    assert unknown_messages("```\nWarning: The cow is 3 m wide.\n```\n") == ["The cow is 3 m wide."]


@cache
def parameters() -> dict[str, str]:
    """Return what the page of parameters says of each, by its flag, its name and its label; it is
    made from the declarations (tests/project/test_pages.py).
    """
    found: dict[str, str] = {}
    for line in (ROOT / "docs/parameters.md").read_text("utf-8").splitlines():
        named = re.match(r"\| \*\*(.+?)\*\* `([A-Z_0-9]+)` \| (.*)", line)
        if named:
            label, name, text = named.groups()
            for key in (label.lower(), name, f"--{name.lower().replace('_', '-')}"):
                found[key] = f"{found.get(key, '')} {text}"
    return found


def named_in(text: str) -> str:
    """Return what is known of the parameters that a paragraph names."""
    keys = re.findall(r"`(--[a-z-]+|[A-Z_0-9]{3,})", text)
    keys += [label.lower() for label in re.findall(r"\*{1,2}([^*]+)\*{1,2}", text)]
    anchors = re.findall(r"\[([^\]]+)\]\(parameters\.md", text)
    known = parameters()
    starting = [key for key in known for word in anchors if key.startswith(word.lower())]
    return " ".join(known[key] for key in (*keys, *starting) if key in known)


def wrong_defaults(text: str) -> list[str]:
    """Return the defaults that a page states and no parameter has that is named beside them."""
    wrong = []
    for paragraph in re.split(r"\n\s*\n", re.sub(r"```.*?```", "", text, flags=re.S)):
        told = named_in(paragraph)
        for match in DEFAULT.finditer(" ".join(paragraph.split())) if told else ():
            number = next(filter(None, match.groups()))
            if number.rstrip(".,") not in {one.rstrip(".,") for one in NUMBER.findall(told)}:
                wrong.append(match[0])
    return wrong


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_defaults_that_a_page_states_are_those_of_the_parameters(page):
    assert wrong_defaults(page.read_text("utf-8")) == []


def test_a_default_that_no_parameter_has_is_found():
    page = "Low noise (`--low-noise-depth`) begins by default from {} m below the ground on."
    assert wrong_defaults(page.format("1")) == []
    assert wrong_defaults(page.format("1.5")) == ["default from 1.5"]
    table = "| `--ground-tolerance-below` | a |\n|---|---|\n| {} m (default) | 1 % |"
    assert wrong_defaults(table.format("0.6")) == []
    assert wrong_defaults(table.format("0.5")) == ["0.5 m (default"]
    assert wrong_defaults("*Raster no-data* (`--raster-nodata`): -9998 by default.") == [
        "-9998 by default"
    ]
