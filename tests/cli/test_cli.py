import json
import os
import re
import subprocess
import sys

import numpy as np
import pytest
from runs import command, environment
from surveys import ORIGIN, classes_of, write_points

from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.classes.selection import Selection
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.parameters import ParameterSet
from bare_earth.algorithms.engine.run import Run
from bare_earth.algorithms.filters import METHODS
from bare_earth.algorithms.tools.ground.step import LabelGround
from bare_earth.algorithms.tools.ground.summary import Summary
from bare_earth.algorithms.tools.rasters.parameters import TerrainModel
from bare_earth.algorithms.tools.rasters.rows import RasterFiles
from bare_earth.algorithms.tools.rasters.step import MakeRasters
from benchmarks.scenes.simple import village

EAST, NORTH = ORIGIN[:2]
# Another value than the default for each kind of parameter, and how it is written.
OTHER_VALUES = {
    "boolean": lambda known: (not known.default, None),
    "choice": lambda known: next((key, key) for key in known.choices if key != known.default),
    "integer": lambda known: ((known.default or 14) + 3, str((known.default or 14) + 3)),
    "number": lambda known: ((known.default or 2.0) * 0.75, str((known.default or 2.0) * 0.75)),
    "integers": lambda known: ((1, 5), "1 5"),
    "numbers": lambda known: ((4.0, 1.5), "4 1.5"),
}


@pytest.fixture(scope="module")
def scene():
    return village(size=60.0)


@pytest.fixture
def file(scene, tmp_path):
    points, _ = scene
    return write_points(tmp_path / "in.las", points.x, points.y, points.z)


@pytest.fixture
def out(file):
    return file.with_name("out.las")


def run(*words):
    return main([str(word) for word in words])


class FakeTerminal:
    """Standard error that says it is a terminal."""

    def __init__(self, stream):
        self._stream = stream

    def isatty(self):
        return True

    def __getattr__(self, name):
        return getattr(self._stream, name)


# How it ends


def test_what_steers_a_terminal_is_shown_as_text(las, tmp_path, capsys):
    source = las.make("a\x1b[31m\nb.las")
    assert run("info", source) == 0
    assert run("classify", tmp_path / "\udcff\x07.las", tmp_path / "out.las") == 1
    told = capsys.readouterr()
    assert "\x1b" not in told.out + told.err and "\x07" not in told.err
    assert "a\\x1b[31m\\nb.las" in told.out
    assert "\\xff\\x07.las does not exist" in told.err.splitlines()[-1]


@pytest.mark.rest
def test_done_is_0_and_quiet_where_no_terminal_listens(file, out, capsys):
    assert run("classify", file, out) == 0
    assert set(np.unique(classes_of(out))) == {1, 2}
    told = capsys.readouterr()
    assert told.out == ""
    # The CRS is not stated: a warning is told all the same, and nothing else.
    assert told.err.count("\n") == 1 and told.err.startswith("Warning: in.las does not say")


@pytest.mark.rest
def test_verbose_tells_what_is_done(file, out, capsys):
    assert run("classify", file, out, "--verbose") == 0
    told = capsys.readouterr()
    assert "points take part." in told.err and "points are ground" in told.out
    assert "stage: lowest points" in told.err


@pytest.mark.rest
def test_a_terminal_gets_a_bar_and_messages(file, out, capsys, monkeypatch):
    pytest.importorskip("tqdm")
    monkeypatch.setattr(sys, "stderr", FakeTerminal(sys.stderr))
    assert run("classify", file, out) == 0
    told = capsys.readouterr()
    assert "%" in told.err and "points take part." in told.err


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["classify", "missing.las", "out.las"], "missing.las"),
        (["classify", "{in}", "{in}"], "same file"),
        (["classify", "{in}", "out.txt"], "out.txt"),
        (["classify", "{in}", "o.las", "--dtm", "a.tif", "--hillshade", "a.tif"], "same file"),
        (["classify", "{in}", "nowhere/out.las"], "does not exist"),
        (["classify", "{in}", "out.las", "--from-classes", "6"], "has only the class 1."),
        (["classify", "{in}", "out.las", "--extent", "0", "0", "9", "9"], "lies in the area"),
        (["classify", "{in}", "out.las", "--boundary", "missing.wkt"], "missing.wkt"),
        (["classify", "{in}", "out.las", "--boundary", "{in}"], "GeoJSON"),
        (["info", "missing.las"], "missing.las"),
        (["assess", "{in}", "missing.las"], "missing.las"),
    ],
)
def test_what_fails_is_1_and_one_line(words, text, file, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(*(word.replace("{in}", str(file)) for word in words)) == 1
    told = capsys.readouterr()
    lines = [line for line in told.err.splitlines() if not line.startswith("Warning: ")]
    assert len(lines) == 1 and lines[0].startswith("bare-earth: ") and text in lines[0]
    assert lines[0].endswith(".") and told.out == ""
    assert os.listdir(tmp_path) == ["in.las"]


@pytest.mark.parametrize(
    ("words", "text"),
    [
        ([], "COMMAND"),
        (["clasify"], "invalid choice"),
        (["classify", "in.las"], "OUTPUT"),
        (["classify", "in.las", "out.las", "--method", "magic"], "invalid choice: 'magic'"),
        (["classify", "in.las", "out.las", "--no-such-option"], "--no-such-option"),
        (["classify", "in.las", "out.las", "--to-class", "300"], "at most 255, not 300"),
        (["classify", "in.las", "out.las", "--to-class", "2.5"], "must be a whole number"),
        (["classify", "in.las", "out.las", "--max-building-size", "x"], "must be a number"),
        (["classify", "in.las", "out.las", "--from-classes", "x"], "number, not 'x'"),
        (["classify", "in.las", "out.las", "--returns", "first"], "invalid choice: 'first'"),
        (["classify", "in.las", "out.las", "--extent", "1", "2", "3"], "expected 4 arguments"),
        (["classify", "in.las", "out.las", "--extent", "9", "0", "1", "5"], "XMIN below XMAX"),
        (["classify", "in.las", "out.las", "--search-radius", "9"], "--search-radius"),
    ],
)
def test_wrong_usage_is_2(words, text, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run(*words) == 2
    told = capsys.readouterr()
    assert text in told.err and "Traceback" not in told.err
    assert not os.listdir(tmp_path)


def failing(monkeypatch, error):
    def fail(*_, **__):
        raise error

    monkeypatch.setattr(Run, "work", fail)


@pytest.mark.parametrize(
    ("error", "text"),
    [
        (BareEarthError("The disk is full."), "The disk is full."),
        (MemoryError(), "memory"),
        (Cancelled(), "nothing was written"),
        (KeyboardInterrupt(), "nothing was written"),
        (KeyError("x"), "KeyError: 'x'.* --verbose"),
    ],
)
def test_any_error_is_1_and_one_line(error, text, file, out, capsys, monkeypatch):
    failing(monkeypatch, error)
    assert run("classify", file, out) == 1
    (line,) = capsys.readouterr().err.splitlines()
    assert re.search(f"^bare-earth: .*{text}", line)


@pytest.mark.parametrize("error", [BareEarthError("The disk is full."), KeyError("x")])
def test_verbose_tells_where_an_error_arose(error, file, out, capsys, monkeypatch):
    failing(monkeypatch, error)
    assert run("classify", file, out, "--verbose") == 1
    told = capsys.readouterr().err
    assert "Traceback" in told and "in fail" in told
    assert told.splitlines()[-1].startswith("bare-earth: ")


@pytest.mark.parametrize(("words", "code"), [(["--version"], 0), (["info", "x"], 1)])
def test_as_a_command(words, code):
    done = subprocess.run(command(*words), env=environment(), capture_output=True, text=True)
    assert done.returncode == code and "Traceback" not in done.stderr
    assert done.stdout.startswith(("bare-earth", "usage")) == (code == 0)


# What it says


@pytest.mark.rest
def test_json_is_the_counts_and_nothing_else(file, out, scene, capsys):
    assert run("classify", file, out, "--json") == 0
    counts = json.loads(capsys.readouterr().out)
    found = classes_of(out)
    assert counts == {
        "name": out.name,
        "point_count": scene[0].count,
        "area_count": scene[0].count,
        "selected_count": scene[0].count,
        "ground_count": int((found == 2).sum()),
        "area_ground_count": int((found == 2).sum()),
        "by_hand_count": 0,
        "overlap_count": 0,
        "input_class_counts": {"1": scene[0].count},
        "reserved_class_counts": {},
        "class_counts": {"1": int((found == 1).sum()), "2": int((found == 2).sum())},
        "found_ground": True,
        "why_no_ground": "",
    }


@pytest.mark.rest
def test_info_and_assess_speak_text_and_json(file, out, capsys):
    assert run("classify", file, out) == 0
    capsys.readouterr()
    for words in (["info", out], ["assess", out, out]):
        assert run(*words) == 0
        assert len(capsys.readouterr().out.splitlines()) > 3
        assert run(*words, "--json") == 0
        assert isinstance(json.loads(capsys.readouterr().out), dict)


def help_of(capsys, *words):
    assert run("classify", *words, "--help") == 0
    return " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize("method", METHODS.values(), ids=METHODS)
def test_the_help_names_each_option_with_its_default(method, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "1000")
    text = help_of(capsys, "--method", method.name)
    for declared in (method.parameters, Selection, TerrainModel):
        for declaration in declared.declarations():
            assert f"--{declaration.name.replace('_', '-')} " in text
            assert " ".join(declaration.help.split()) in text


def test_an_empty_parameter_is_automatic_as_its_help_says(capsys):
    for method in METHODS.values():
        for declared in method.parameters.declarations():
            if declared.default is None:
                assert declared.empty == "automatic", declared.name
    empty = "at least 1 m (0.5 m in the preset for sites). (default: automatic)"
    assert empty in help_of(capsys, "--method", "slope")
    text = help_of(capsys)
    assert "(default: 0 to 6, 8 and 12)" in text and "(default: none)" in text
    assert "(default: 1.0 m)" in text and "(default: off)" in text
    assert "give the word none" in text


# What reaches the classifier


def steps_of_runs(monkeypatch):
    """Return a list that gets the steps of each run by their types, in place of its work."""
    calls = []

    def work(run, *_):
        calls.append({type(step): step for step in run.steps})
        return Summary("out.las", 1, 1, 1, 1, 1)

    monkeypatch.setattr(Run, "work", work)
    return calls


def options():
    for method in METHODS.values():
        for declaration in method.parameters.declarations():
            yield pytest.param(
                method, method.parameters, declaration, id=f"{method.name}-{declaration.name}"
            )
    for place, declared in enumerate((Selection, TerrainModel)):
        for declaration in declared.declarations():
            yield pytest.param(
                METHODS["slope"], declared, declaration, id=f"{place}-{declaration.name}"
            )


@pytest.mark.parametrize(("method", "declared", "known"), list(options()))
def test_each_parameter_reaches_the_classifier(method, declared, known, monkeypatch):
    calls = steps_of_runs(monkeypatch)
    value, text = OTHER_VALUES[known.kind](known)
    flag = known.name.replace("_", "-")
    words = [f"--{flag}", *text.split()] if text else [f"--{flag}" if value else f"--no-{flag}"]
    words += ["--method", method.name, "--dtm", "a.tif"]
    assert run("classify", "in.las", "out.las", *words) == 0
    expected = [
        kind(**{known.name: value}) if kind is declared else kind()
        for kind in (method.parameters, Selection, TerrainModel)
    ]
    ground, rasters = calls[0][LabelGround], calls[0][MakeRasters]
    chosen = [ground.parameters, ground.selection, rasters.model]
    assert chosen == expected
    assert all(isinstance(one, ParameterSet) for one in chosen)


@pytest.mark.parametrize("word", ["none", "automatic", "None"])
def test_a_parameter_can_be_left_empty(word, monkeypatch):
    calls = steps_of_runs(monkeypatch)
    assert run("classify", "in.las", "out.las", "--stop-edge", word) == 0
    assert calls[0][LabelGround].parameters.stop_edge is None
    assert run("classify", "in.las", "out.las", "--from-classes", word) == 0
    assert calls[1][LabelGround].selection.from_classes is None


def test_rasters_and_area_reach_the_classifier(monkeypatch, tmp_path):
    calls = steps_of_runs(monkeypatch)
    boundary = tmp_path / "a.geojson"
    boundary.write_text('{"type": "Polygon", "coordinates": [[[0, 0], [5, 0], [5, 5], [0, 0]]]}')
    words = "classify in.las out.las --dtm a.tif --hillshade b.tif --extent -1.5 -2 3 4e0"
    assert run(*words.split(), "--boundary", boundary) == 0
    rasters, area = calls[0][MakeRasters].files, calls[0][LabelGround].area
    assert rasters == RasterFiles(dtm="a.tif", hillshade="b.tif")
    assert area.box == (-1.5, -2.0, 3.0, 4.0) and len(area.polygons) == 1
    assert run("classify", "in.las", "out.las") == 0
    assert calls[1][LabelGround].area is None


# What comes out


def test_all_subcommands_are_documented(capsys):
    assert run("--help") == 0
    text = capsys.readouterr().out
    several = "classify", "info", "assess", "height", "key-points", "terrain"
    names = (*several, "remove-off-terrain-objects")
    assert all(f"    {name} " in text or f"    {name}\n" in text for name in names)
    for name in names:
        assert run(name, "--help") == 0
        assert "--verbose" in capsys.readouterr().out


def test_the_list_of_commands_loads_nothing_slow():
    code = (
        "import sys; from bare_earth.algorithms.cli import main; main(['--help']);"
        " sys.exit(' '.join({'numpy', 'scipy', 'laspy', 'lazrs'} & set(sys.modules)) or 0)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "key-points" in done.stdout
