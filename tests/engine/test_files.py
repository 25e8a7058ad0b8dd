import contextlib
import errno
import os
import pickle
import secrets
import subprocess
import sys
import time

import numpy as np
import pytest

from bare_earth import BareEarthError, Cancelled
from bare_earth.algorithms.core.errors import OutputInUse
from bare_earth.algorithms.core.files import (
    Outputs,
    check_distinct,
    check_lengths,
    check_output,
    make_work_folder,
    replacing,
    temporary_folder,
)
from bare_earth.algorithms.core.temporary import remove, remove_leftovers, shown
from bare_earth.algorithms.delivery import folder as delivery_folder
from bare_earth.algorithms.delivery.folder import exchange
from bare_earth.algorithms.engine.manifest import names_beside


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
        pytest.raises(BareEarthError, match=r"[/\\]a\.las: .*disk.* full"),
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
        start, computer, rest = temporary.name[:2], temporary.name[2:6], temporary.name[6:9]
    (tmp_path / "a.las").unlink()

    def name(process, computer=computer):
        return f"{start}{computer}{rest}{np.base_repr(process, 36).lower()}.las"

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
        theirs, far = left_by(other.pid), left_by(1, "else")
        for value in (theirs, far):
            (tmp_path / value).write_text("half")
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
            secret.append(temporary.name[6:9])
    # In each of the three places many different characters stand.
    assert all(len(set(place)) > 8 for place in zip(*secret))


def test_a_link_at_the_temporary_name_is_not_followed(tmp_path, monkeypatch):
    precious = tmp_path / "precious"
    precious.write_text("data")
    tokens = iter([1, 1, 1, 2])
    monkeypatch.setattr(secrets, "randbelow", lambda count: next(tokens))
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
    errno.ESTALE: ".*network disk",
    errno.EBUSY: ".*another program",
    errno.EXDEV: ".*two disks",
    errno.EIO: os.strerror(errno.EIO),
}


@pytest.mark.parametrize(
    ("number", "is_done"),
    [*((number, False) for number in RENAMES), (errno.ENOENT, True), (errno.ESTALE, True)],
)
def test_a_rename_that_fails_leaves_the_old_file_and_one_that_was_done_counts(
    tmp_path, monkeypatch, number, is_done
):
    target, rename = tmp_path / "a.las", os.replace
    target.write_text("old")

    def fail(source, target):
        if is_done:
            rename(source, target)
        raise OSError(number, os.strerror(number), str(source), None, str(target))

    monkeypatch.setattr(os, "replace", fail)
    sentence = rf"[/\\]a\.las: {RENAMES.get(number)}"
    refused = pytest.raises(BareEarthError, match=sentence)
    with contextlib.nullcontext() if is_done else refused, replacing(target) as temporary:
        temporary.write_text("new")
    assert target.read_text() == ("new" if is_done else "old")
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
    with pytest.raises(BareEarthError, match="no permission"):
        check_output(tmp_path / "a.las")
    tmp_path.chmod(0o700)


def test_two_outputs_of_one_name_are_refused(tmp_path):
    (tmp_path / "folder").mkdir()
    same = tmp_path / "folder" / ".." / "dtm.tif"
    check_distinct([tmp_path / "a.las", None, same, None])
    with pytest.raises(BareEarthError, match=r"outputs .*same file, .*dtm\.tif"):
        check_distinct([tmp_path / "dtm.tif", None, same])
    with pytest.raises(BareEarthError, match="same file"):  # none of them is there yet
        check_output(tmp_path / "dtm.tif", (same,))


def test_messages_are_one_line_without_what_steers_a_terminal():
    error = BareEarthError("\x1b[31mno\nsuch \udcff file\x07 in Zürich")
    assert str(error) == "\\x1b[31mno\\nsuch \\xff file\\x07 in Zürich"
    assert str(pickle.loads(pickle.dumps(error))) == str(error)


@pytest.mark.parametrize("number", [5, 32])
def test_an_output_that_a_program_has_open_is_refused_before_any_work(number, windows, tmp_path):
    target = tmp_path / "dtm.tif"
    target.write_text("old")
    windows.hold(target, number)
    with pytest.raises(OutputInUse, match=r"dtm\.tif: another program.* QGIS"):
        check_output(target)
    target.chmod(0o444)
    with pytest.raises(OutputInUse, match=r"dtm\.tif: .*read-only"):
        check_output(target)
    assert os.listdir(tmp_path) == ["dtm.tif"]


def test_what_was_made_is_kept_where_a_program_has_an_old_output_open_at_the_end(windows, tmp_path):
    names = ["dtm.tif", "dsm.tif", "lines.shp", "lines.dbf", "lines.shx", "dtm.tif.aux.xml"]
    for name in [*names, "dsm-new.tif"]:
        (tmp_path / name).write_text("old")
    windows.hold(tmp_path / "lines.dbf")
    with pytest.raises(OutputInUse) as told, Outputs() as outputs:
        outputs.file(tmp_path / "dtm.tif", ["dtm.tif.aux.xml"]).write_text("new")
        outputs.file(tmp_path / "dsm.tif").write_text("new")
        lines = outputs.files(tmp_path / "lines.shp", ["lines.dbf", "lines.shx"])
        for ending in (".shp", ".dbf"):
            lines.with_suffix(ending).write_text("new")
    # Nothing is half new.
    assert all((tmp_path / name).read_text() == "old" for name in names)
    kept = ["dtm-new.tif", "dsm-new2.tif", "lines-new.dbf", "lines-new.shp"]
    assert all((tmp_path / path).read_text() == "new" for path in kept)
    assert "Cannot write" in str(told.value) and "lines.dbf: another program uses" in str(
        told.value
    )
    assert all(str(tmp_path / path) in str(told.value) for path in kept)
    assert len(os.listdir(tmp_path)) == len([*names, *kept, "dsm-new.tif"])


def test_outputs_get_their_names_together_and_what_they_outdate_goes(tmp_path):
    for name in ("dtm.tif", "dtm.tif.aux.xml", "lines.shp", "lines.qix"):
        (tmp_path / name).write_text("old")
    with Outputs() as outputs:
        outputs.file(tmp_path / "dtm.tif", ["dtm.tif.aux.xml"]).write_text("new")
        lines = outputs.files(tmp_path / "lines.shp", ["lines.dbf", "lines.qix"])
        for ending in (".shp", ".dbf"):
            lines.with_suffix(ending).write_text("new")
        assert (tmp_path / "dtm.tif").read_text() == "old"
    assert sorted(os.listdir(tmp_path)) == ["dtm.tif", "lines.dbf", "lines.shp"]
    assert all(path.read_text() == "new" for path in tmp_path.iterdir())


def test_a_virus_scanner_that_has_files_open_for_a_moment_is_waited_for(windows, tmp_path):
    target = tmp_path / "dtm.tif"
    target.write_text("old")
    windows.hold(target, 5, tries=3)
    with replacing(target) as temporary:
        temporary.write_text("new")
        windows.hold(temporary, 32, tries=3)
    assert target.read_text() == "new" and windows.tries == 6
    (tmp_path / "folder" / "within").mkdir(parents=True)
    (tmp_path / "folder" / "within" / "a.las").write_text("points")
    windows.hold(target, 32, tries=3)
    remove(target)
    remove(tmp_path / "folder")
    assert not os.listdir(tmp_path) and windows.tries == 9


def test_a_rename_that_failed_does_not_count_where_a_disk_numbers_no_files(tmp_path, monkeypatch):
    target, stat = tmp_path / "a.las", os.stat
    target.write_text("old")

    def unnumbered(path, **named):
        values = list(stat(path, **named))
        values[1] = 0
        return os.stat_result(values)

    def refuse(*_):
        raise OSError(errno.EIO, os.strerror(errno.EIO))

    monkeypatch.setattr(os, "stat", unnumbered)
    monkeypatch.setattr(os, "replace", refuse)
    with pytest.raises(BareEarthError, match="Cannot write"), replacing(target) as temporary:
        temporary.write_text("new")
    assert target.read_text() == "old"


def test_names_of_temporary_files_are_short_and_none_is_within_another(tmp_path):
    target = tmp_path / f"{'long' * 20}.copc.laz"
    with temporary_folder(tmp_path) as work, temporary_folder(work / "below") as other:
        assert other.parent == work.parent == tmp_path
        with replacing(work / target.name) as temporary, replacing(temporary) as again:
            assert temporary.parent == again.parent == work
            lengths = [len(path.name) for path in (work, other, temporary, again)]
            assert max(lengths) <= 14 + len(".copc.laz") and again.name.endswith(".copc.laz")
            # Users read the names that they know.
            text = f"Cannot write {again}: it is full."
            assert shown(text) == f"Cannot write {tmp_path / target.name}: it is full."


def test_a_path_that_becomes_too_long_is_refused_before_any_work(tmp_path, monkeypatch):
    make = os.open

    def of_windows(path, *arguments, **named):
        if len(os.path.abspath(path)) > 259:
            raise FileNotFoundError(errno.ENOENT, "The system cannot find the path", str(path))
        return make(path, *arguments, **named)

    monkeypatch.setattr(os, "open", of_windows)
    folder = tmp_path / ("f" * (224 - len(str(tmp_path))))
    folder.mkdir()
    check_output(folder / "a.las")
    check_lengths(folder, names_beside("a.las"))
    with pytest.raises(BareEarthError, match="its path is too long"):
        check_output(folder / f"{'a' * 20}.las")
    with pytest.raises(BareEarthError, match="its path is too long"):
        check_lengths(folder / "new", names_beside("a.las"))
    assert not os.listdir(folder)


def test_work_folders_are_no_links(tmp_path):
    (tmp_path / "precious").mkdir()
    (tmp_path / ".bare-earth").symlink_to(tmp_path / "precious", target_is_directory=True)
    with pytest.raises(BareEarthError, match=r"\.bare-earth is a link"):
        make_work_folder(tmp_path / ".bare-earth")
    make_work_folder(tmp_path / "new")
    make_work_folder(tmp_path / "new")
    assert (tmp_path / "new").is_dir()


@pytest.mark.parametrize("number", [5, 32])
def test_folders_are_exchanged_as_a_whole_or_not_at_all(number, windows, tmp_path, monkeypatch):
    new, old, aside = (tmp_path / name for name in ("new", "old", "aside"))
    for folder in (new, old, aside):
        folder.mkdir()
    for folder, names in ((new, "abc"), (old, "bcd")):
        for name in names:
            (folder / name).write_text(folder.name)
    moves, outdated = [(new / name, old / name) for name in "abc"], [old / "d"]
    windows.hold(old / "c", number)
    with pytest.raises(OutputInUse):
        exchange(moves, outdated, aside)
    windows.in_use.clear()
    # Seen only in the middle.
    windows.hold(old / "d", number)
    with monkeypatch.context() as patch:
        patch.setattr(delivery_folder, "check_free", lambda path: None)
        with pytest.raises(BareEarthError):
            exchange(moves, outdated, aside)
    assert {path.name: path.read_text() for path in old.iterdir()} == dict.fromkeys("bcd", "old")
    assert {path.name: path.read_text() for path in new.iterdir()} == dict.fromkeys("abc", "new")
    windows.in_use.clear()
    for file in aside.iterdir():
        file.unlink()
    exchange(moves, outdated, aside)
    assert {path.name: path.read_text() for path in old.iterdir()} == dict.fromkeys("abc", "new")
