"""The tools that write classified files anew: all follows from the declaration of each."""

import inspect
import json
import subprocess
import sys

import laspy
import numpy as np
import pytest
from runs import said
from surveys import write
from toy_tool import TOOL, add_toy

import bare_earth
from bare_earth.algorithms.core.words import Flags, Keywords, in_words, use_names
from bare_earth.algorithms.tools import any_tool
from bare_earth.algorithms.tools.input_groups import GROUPS
from bare_earth.algorithms.tools.listing import COMPOSITIONS, FILE_TOOLS, MAP_TOOLS, POINT_TOOLS


@pytest.fixture
def toy(monkeypatch):
    add_toy(monkeypatch)
    return TOOL


@pytest.fixture
def ground(tmp_path):
    (tmp_path / "in").mkdir()
    place = 100 * np.arange(400)
    points = np.column_stack((place % 2_000, place // 20, place // 400))
    return write(tmp_path / "in" / "in.laz", points, classes=np.resize([2, 1], 400))


def test_a_new_tool_is_found_in_the_command_line(toy, ground, tmp_path):
    _, listed, _ = said("--help")
    assert f"{toy.command}       {toy.line}" in listed
    code, shown, _ = said(toy.command, "--help")
    assert code == 0 and f"{toy.line} {toy.about}" in " ".join(shown.split())
    assert "--new-class" in shown and "--ground-classes" in shown and "--resume" in shown
    words = toy.command, ground, tmp_path / "out.laz", "--new-class", "40", "--json"
    code, printed, _ = said(*words)
    assert code == 0 and json.loads(printed)["new_count"] == 200
    before, after = (laspy.read(value).classification for value in (ground, tmp_path / "out.laz"))
    assert np.array_equal(after, np.where(np.asarray(before) == 2, 40, before))


def test_a_new_tool_is_a_function_of_the_library(toy, ground, tmp_path):
    function = bare_earth.rename_ground
    assert "rename_ground" in dir(bare_earth)
    assert f"{toy.line}\n\n{toy.about}" in function.__doc__ and "ToySummary" in function.__doc__
    assert inspect.signature(function).parameters["new_class"].default == 31
    one = function(ground, tmp_path / "out.laz", new_class=40)
    many = function([ground.parent], tmp_path / "many", new_class=40)
    assert one.new_count == many.class_counts[40] == 200
    again = function([ground.parent], tmp_path / "many", new_class=40, resume=True)
    assert again.kept_count == 1


@pytest.mark.parametrize("name", (*POINT_TOOLS, *MAP_TOOLS, *FILE_TOOLS, *COMPOSITIONS))
def test_each_text_of_a_tool_is_sentences_for_command_library_and_dialog(name):
    tool = any_tool(name)
    dialog = getattr(tool, "dialog_outputs", tuple)
    declared = (*tool.all_inputs, *tool.inputs, *tool.all_outputs, *dialog())
    parts = [part for one in declared for part in GROUPS.get(one.kind, ())]
    for text in (tool.line, *tool.help.split("\n"), *(one.help for one in (*declared, *parts))):
        assert text == "" or (text[0].isupper() and text.endswith(".") and "--" not in text), text


def test_a_help_names_tools_and_options_as_its_reader_knows_them():
    text = "As `remove_off_terrain_objects()` does, with `max_edge`."
    before = use_names(Flags())
    try:
        there = in_words(text)
        use_names(Keywords())
        here = in_words(text)
    finally:
        use_names(before)
    assert there == "As 'bare-earth remove-off-terrain-objects' does, with --max-edge."
    assert here == "As bare_earth.remove_off_terrain_objects() does, with 'max_edge'."


@pytest.mark.rest
def test_a_command_imports_no_other_tool():
    code = (
        "import sys; from bare_earth.algorithms.cli import main; main(['height', '--help']);"
        "print(*(name for name in sys.modules if '.tools.' in name), file=sys.stderr)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = {name.split(".tools.")[1] for name in done.stderr.split()}
    tools = {listed.file for listed in (*POINT_TOOLS.values(), *FILE_TOOLS.values())}
    assert loaded & tools == {"heights"}
