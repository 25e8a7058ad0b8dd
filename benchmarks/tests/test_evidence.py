"""Each page of figures says whether the code that it speaks of has changed since."""

import re

import pytest

from benchmarks import evidence, manual, marked
from benchmarks.evidence import PARTS, RESULTS, Part, digest, is_current, stamp_of, stamped

PAGE = "# Figures\n\n| | metres |\n| --- | ---: |\n| slope | 0.1 |\n"


def test_what_a_page_says_about_itself_is_right():
    for part in PARTS:
        told = stamp_of(part.path)
        assert told is not None, f"{part.path.name}: run python -m benchmarks.evidence --mark"
        changed = told.digest != digest(part.rooms)
        assert told.has_changed == changed, (
            f"{part.path.name}: run python -m benchmarks.evidence --mark"
        )


def test_pages_of_labels_speak_of_all_that_filters_import_of_grids():
    rooms = evidence.ROOT / "algorithms"
    told = {path.stem for path in map(rooms.joinpath, evidence.LABELS) if path.suffix}
    theirs = re.compile(r"^ *from \.+grids\.(\w+) import", re.M)
    within = re.compile(r"^ *from \.(\w+) import", re.M)
    found = set()
    for room in ("filters", "tin"):
        for path in (rooms / room).rglob("*.py"):
            found |= set(theirs.findall(path.read_text("utf-8")))
    for name in sorted(told):
        found |= set(within.findall((rooms / "grids" / f"{name}.py").read_text("utf-8")))
    assert found == told


def test_every_page_of_figures_is_a_part():
    assert {part.path for part in PARTS} == set(RESULTS.glob("*.md"))


def test_tables_of_the_manual_are_those_of_the_pages():
    for path, name, lines in manual.made(manual.read(manual.ACCURACY)):
        assert marked.held(path, name) == lines, (
            f"{path.name}: run python -m benchmarks.evidence --mark"
        )


def test_the_table_of_speed_is_that_of_the_page_that_was_measured():
    lines = manual.speeds()
    held = [line.split("|")[1].strip() for line in marked.held(manual.MANUAL, "speed")[2:]]
    assert [line.split("|")[1].strip() for line in lines[2:]] == held
    page = manual.PERFORMANCE.read_text("utf-8")
    figure = lines[2].split("|")[2].strip()
    assert f"{figure} (" in page.split("| **TIN densification** ")[1].splitlines()[0]


@pytest.fixture
def parts(tmp_path, monkeypatch):
    """Two parts whose command makes a page, and one whose command fails."""
    monkeypatch.setattr(evidence, "RESULTS", tmp_path)
    monkeypatch.setattr(evidence, "LOGS", tmp_path / "logs")
    monkeypatch.setattr(evidence, "fetch", lambda: None)
    monkeypatch.setattr(manual, "write", lambda with_speeds: None)
    found = tuple(
        Part(name, ("core",), (command,))
        for name, command in (("one", "data list"), ("bad", "data nothing"), ("two", "data list"))
    )
    for part in found:
        part.path.write_text(PAGE, "utf-8")
    monkeypatch.setattr(evidence, "PARTS", found)
    return found


@pytest.mark.rest
def test_a_run_that_was_stopped_goes_on_with_what_is_left(parts, capsys):
    assert evidence.main(["--run", "one"]) == 0
    assert [is_current(part) for part in parts] == [True, False, False]
    capsys.readouterr()
    assert evidence.main(["--run"]) == 1
    printed = capsys.readouterr().out
    assert "one: python" not in printed and "two: python" in printed
    assert re.search(rf"bad .*\b2\b.* {re.escape(str(evidence.LOGS / 'bad.log'))}", printed)
    assert [is_current(part) for part in parts] == [True, False, True]
    assert "invalid choice" in (evidence.LOGS / "bad.log").read_text("utf-8")


def test_a_page_says_that_the_code_has_changed_and_when_it_is_current_again(tmp_path, parts):
    part, page = parts[0], parts[0].path
    old = stamped(part)._replace(digest="0123456789ab")
    evidence.write_stamp(page, old)
    assert not stamp_of(page).has_changed
    evidence.mark(part)
    assert stamp_of(page) == old._replace(has_changed=True)
    assert page.read_text("utf-8").count("Measured on") == 1
    assert page.read_text("utf-8").startswith("# Figures\n\n*Measured on 20")
    evidence.write_stamp(page, stamped(part))
    evidence.mark(part)
    assert is_current(part) and not stamp_of(page).has_changed
    assert page.read_text("utf-8").endswith(PAGE[len("# Figures\n\n") :])


def test_line_endings_and_other_rooms_change_no_digest(tmp_path):
    room = tmp_path / "algorithms" / "core"
    room.mkdir(parents=True)
    (room / "code.py").write_bytes(b"a = 1\n")
    first = digest(["core"], tmp_path)
    (room / "code.py").write_bytes(b"a = 1\r\n")
    assert digest(["core"], tmp_path) == first
    (room / "code.py").write_bytes(b"a = 2\n")
    assert digest(["core"], tmp_path) != first
    changed = digest(["core/code.py"], tmp_path)
    (room / "other.py").write_bytes(b"a = 2\n")
    assert digest(["core/code.py"], tmp_path) == changed
