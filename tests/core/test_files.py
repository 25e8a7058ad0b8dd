import errno
import os
import pickle
import secrets
import subprocess
import sys
import time

import pytest

from bare_earth.algorithms.core.errors import BareEarthError, Cancelled
from bare_earth.algorithms.core.files import (
    check_distinct,
    check_output,
    replacing,
    temporary_folder,
)
from bare_earth.algorithms.core.temporary import remove_leftovers


def test_the_target_appears_only_at_the_end(tmp_path):
    target = tmp_path / "cloud.copc.laz"
    with replacing(target) as temporary:
        temporary.write_text("new")
        assert not target.exists()
        assert temporary.parent == target.parent and temporary.name.endswith(".copc.laz")
    assert target.read_text() == "new"
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.parametrize("error", [Cancelled, KeyboardInterrupt, ValueError])
def test_any_error_leaves_the_old_target_and_no_temporary_file(tmp_path, error):
    target = tmp_path / "a.las"
    target.write_text("old")
    with pytest.raises(error), replacing(target) as temporary:
        temporary.write_text("half")
        raise error
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


def test_a_full_disk_is_told_in_a_sentence_that_names_the_target(tmp_path):
    target = tmp_path / "a.las"
    with (
        pytest.raises(BareEarthError, match=r"Cannot write .*[/\\]a\.las: the disk is full\."),
        replacing(target) as outer,
        replacing(outer),
    ):
        raise OSError(errno.ENOSPC, "No space left on device")


def test_a_missing_folder_a_folder_and_the_input_itself_are_refused(tmp_path):
    source = tmp_path / "in.las"
    source.write_text("points")
    (tmp_path / "link.las").symlink_to(source)
    with pytest.raises(BareEarthError, match="does not exist"):
        check_output(tmp_path / "none" / "out.las")
    with pytest.raises(BareEarthError, match="it is a folder"):
        check_output(tmp_path)
    for same in (source, tmp_path / "link.las", tmp_path / "." / "in.las"):
        with pytest.raises(BareEarthError, match="same file"):
            check_output(same, (source,))


@pytest.fixture
def left_by(tmp_path):
    """Return the name of what a process that was killed leaves beside a target."""
    with replacing(tmp_path / "a.las") as temporary:
        computer, _, rest = temporary.name.rpartition(f"-{os.getpid()}-")
    (tmp_path / "a.las").unlink()

    def name(process, computer=computer):
        return f"{computer}-{process}-{rest}"

    return name


@pytest.fixture
def gone():
    """Return the number of a process that has ended."""
    done = subprocess.Popen([sys.executable, "-c", ""])
    done.wait()
    return done.pid


def test_what_killed_runs_left_is_removed_before_any_work(tmp_path, gone, left_by):
    (tmp_path / left_by(gone)).write_text("half")
    (tmp_path / left_by(os.getpid())).write_text("of an earlier process with this number")
    folder = tmp_path / f"{left_by(gone)}.folder"
    (folder / "within").mkdir(parents=True)
    (folder / "within" / "b.las").write_text("half")
    check_output(tmp_path / "b.las")
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(not os.path.exists("/proc/self/stat"), reason="asks Linux")
def test_a_process_that_ended_holds_nothing_though_nobody_asked_how(tmp_path, left_by):
    with subprocess.Popen([sys.executable, "-c", ""], stdout=-1) as other:
        other.stdout.read()  # to its end, but it is waited for only behind this block
        (tmp_path / left_by(other.pid)).write_text("half")
        end = time.monotonic() + 30
        while list(tmp_path.iterdir()) and time.monotonic() < end:
            remove_leftovers(tmp_path)
        assert not list(tmp_path.iterdir())


def test_what_another_run_writes_right_now_is_left_alone(tmp_path, left_by):
    code = "import sys; print(flush=True); sys.stdin.read()"
    with subprocess.Popen([sys.executable, "-c", code], stdin=-1, stdout=-1) as other:
        other.stdout.readline()
        theirs, far = left_by(other.pid), left_by(1, ".elsewhere")
        for each in (theirs, far):
            (tmp_path / each).write_text("half")
        with replacing(tmp_path / "mine.las") as mine:
            beside = mine.with_name(f"{mine.name}.index")  # what a library makes beside it
            beside.write_text("half")
            remove_leftovers(tmp_path)
            names = {theirs, far, mine.name, beside.name}
            assert {path.name for path in tmp_path.iterdir()} == names
            beside.unlink()
        other.communicate()
    remove_leftovers(tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == {"mine.las", far}
    os.utime(tmp_path / far, (0, 0))  # of another computer: when nobody wrote to it for a day
    remove_leftovers(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.las"]


def test_no_name_of_a_temporary_file_tells_the_next(tmp_path):
    secret = []
    for _ in range(100):
        with replacing(tmp_path / "a.las") as temporary:
            rest = temporary.name.rpartition(f"-{os.getpid()}-")[2]
            secret.append(rest.removesuffix(".part.a.las"))
    # Sixteen digits, in each of whose places many different ones stand.
    assert all(len(set(place)) > 8 for place in zip(*secret)) and len(secret[0]) == 16


def test_a_link_at_the_temporary_name_is_not_followed(tmp_path, monkeypatch):
    precious = tmp_path / "precious"
    precious.write_text("data")
    tokens = iter(["known", "known", "known", "another"])
    monkeypatch.setattr(secrets, "token_hex", lambda count: next(tokens))
    with replacing(tmp_path / "a.las") as temporary:
        foreseen = temporary
    foreseen.symlink_to(precious)
    with replacing(tmp_path / "a.las") as temporary, open(temporary, "w+b") as file:
        file.write(b"points")
    assert temporary != foreseen and precious.read_text() == "data"
    assert (tmp_path / "a.las").read_bytes() == b"points"


def test_a_link_among_what_was_left_is_removed_and_not_what_it_leads_to(tmp_path, gone, left_by):
    precious = tmp_path / "precious"
    precious.mkdir()
    (precious / "a.las").write_text("data")
    (tmp_path / left_by(gone)).symlink_to(precious)
    remove_leftovers(tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["precious"]
    assert (precious / "a.las").read_text() == "data"


def test_a_temporary_folder_goes_with_all_in_it_and_is_told_where_it_cannot_be(tmp_path):
    with pytest.raises(ValueError), temporary_folder(tmp_path) as folder:
        (folder / "a" / "b").mkdir(parents=True)
        remove_leftovers(tmp_path)
        assert (folder / "a" / "b").is_dir()
        raise ValueError
    assert not list(tmp_path.iterdir())
    with pytest.raises(BareEarthError, match="Cannot write"), temporary_folder(tmp_path / "none"):
        pass


RENAMES = {
    errno.ESTALE: "the network disk lost the file",
    errno.EBUSY: "another program uses it",
    errno.EXDEV: "the folder spans two disks",
    errno.EIO: os.strerror(errno.EIO),
}


@pytest.mark.parametrize("number", RENAMES)
def test_a_rename_that_fails_is_told_and_leaves_the_old_file(tmp_path, monkeypatch, number):
    target = tmp_path / "a.las"
    target.write_text("old")

    def refuse(source, target):
        raise OSError(number, os.strerror(number), str(source), None, str(target))

    monkeypatch.setattr(os, "replace", refuse)
    sentence = rf"Cannot write .*[/\\]a\.las: {RENAMES[number]}[^.]*\."
    with pytest.raises(BareEarthError, match=sentence), replacing(target) as temporary:
        temporary.write_text("new")
    assert target.read_text() == "old"
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.parametrize("number", [errno.ENOENT, errno.ESTALE])
def test_a_rename_that_was_done_counts_though_an_error_is_reported(tmp_path, monkeypatch, number):
    target, rename = tmp_path / "a.las", os.replace
    target.write_text("old")

    def lose_the_answer(source, target):
        rename(source, target)
        raise OSError(number, os.strerror(number), str(source), None, str(target))

    monkeypatch.setattr(os, "replace", lose_the_answer)
    with replacing(target) as temporary:
        temporary.write_text("new")
    assert target.read_text() == "new"
    assert list(tmp_path.iterdir()) == [target]


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such permissions")
def test_the_permissions_of_an_old_target_stay(tmp_path):
    target = tmp_path / "a.las"
    target.write_text("old")
    for mode in (0o600, 0o640, 0o444):
        target.chmod(mode)
        with replacing(target) as temporary:
            assert temporary.stat().st_mode & 0o077 == mode & 0o077
            temporary.write_text("new")
        assert target.stat().st_mode & 0o777 == mode


def test_names_as_long_as_can_be_are_written_and_longer_ones_refused_at_once(tmp_path):
    target = tmp_path / ("ä" * 125 + ".las")
    check_output(target)
    with replacing(target) as temporary:
        temporary.write_text("new")
        assert temporary.suffix == ".las"
    assert [path.name for path in tmp_path.iterdir()] == [target.name]
    with pytest.raises(BareEarthError, match="the name is too long"):
        check_output(tmp_path / ("a" * 300 + ".las"))
    with pytest.raises(BareEarthError, match="Cannot write"):
        check_output(tmp_path / "a\0b.las")


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes with names here")
def test_a_pipe_is_no_output(tmp_path):
    os.mkfifo(tmp_path / "a.las")
    with pytest.raises(BareEarthError, match="a pipe, not a file"):
        check_output(tmp_path / "a.las")


@pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write where it likes"
)
def test_a_folder_that_must_not_be_written_to_is_refused_at_once(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(BareEarthError, match="no permission to write"):
        check_output(tmp_path / "a.las")
    tmp_path.chmod(0o700)


def test_two_outputs_of_one_name_are_refused(tmp_path):
    (tmp_path / "folder").mkdir()
    same = tmp_path / "folder" / ".." / "dtm.tif"
    check_distinct([tmp_path / "a.las", None, same, None])
    with pytest.raises(BareEarthError, match=r"Two outputs are the same file, .*dtm\.tif"):
        check_distinct([tmp_path / "dtm.tif", None, same])
    with pytest.raises(BareEarthError, match="same file"):  # none of them is there yet
        check_output(tmp_path / "dtm.tif", (same,))


def test_messages_are_one_line_without_what_steers_a_terminal():
    error = BareEarthError("\x1b[31mno\nsuch \udcff file\x07 in Zürich")
    assert str(error) == "\\x1b[31mno\\nsuch \\xff file\\x07 in Zürich"
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


@pytest.mark.parametrize(("number", "exists"), [(5, True), (32, True), (5, False)])
def test_windows_says_that_a_layer_has_the_file_open(number, exists, tmp_path, monkeypatch):
    target = tmp_path / "dtm.tif"
    if exists:
        target.write_text("old")

    def denied(*_):
        error = PermissionError(errno.EACCES, "Access is denied")
        error.winerror = number
        raise error

    monkeypatch.setattr(os, "replace", denied)
    with pytest.raises(BareEarthError) as told, replacing(target) as temporary:
        temporary.write_text("new")
    assert ("QGIS shows it as a layer" in str(told.value)) == exists
    assert ("no permission" in str(told.value)) != exists
    assert [each.read_text() for each in tmp_path.iterdir()] == ["old"] * exists
