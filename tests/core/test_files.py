import errno

import pytest

from bare_earth.algorithms.core.errors import BareEarthError, Cancelled
from bare_earth.algorithms.core.files import check_output, replacing


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
