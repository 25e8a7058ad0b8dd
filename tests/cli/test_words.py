"""Messages name options and tools in the words of who reads them."""

import re

import pytest

import bare_earth
from bare_earth.algorithms.cli import main
from bare_earth.algorithms.core.words import option, tool


def test_options_are_flags_in_a_terminal_and_keywords_in_the_library(tmp_path, capsys):
    assert option("to_utm", True, of="fetch") == "to_utm=True of bare_earth.fetch()"
    assert option("from_classes", "all") == "from_classes='all'" and option("like") == "'like'"
    assert tool("key-points") == "bare_earth.key_points()"
    path = tmp_path / "points.csv"
    path.write_text("1,2,3\n")
    words = ["check", str(path)]
    assert main(words) == 2
    assert re.search("--checkpoints.* --hold-out", capsys.readouterr().err)
    with pytest.raises(bare_earth.BareEarthError, match=r"'checkpoints'.* 'hold_out'"):
        bare_earth.check(path)


def test_digits_that_matter_are_shown(capsys, tmp_path):
    words = ["terrain", str(tmp_path / "a.laz"), "--dtm", str(tmp_path / "a.tif"), "--extent"]
    assert main([*words, "6861000.25", "1", "6861000.25", "2"])
    assert "6861000.25 1 6861000.25 2" in capsys.readouterr().err
